// The frame of a kernel of vtkSlicemapQuadKernel; follows vtkSlicemapLayout.glsl, precedes the
// kernel.
//
// A run fills NumberOfQuads quads, of four words each, from FirstQuad on. The compute stage writes
// them to storage buffer 0, which begins with the first of them; the fragment stage to an RGBA32UI
// render target, row after row of QuadsPerLine pixels.

uniform uint FirstQuad;

uvec4 kernel(uint quad);

uvec4 sourceQuad(usamplerBuffer source, uint quad)
{
  return texelFetch(source, int(quad));
}

#ifdef COMPUTE

layout(local_size_x = 64) in;

layout(std430, binding = 0) writeonly buffer Target
{
  uvec4 Quads[];
};

uniform uint NumberOfQuads;

void main()
{
  uint index =
    gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
  if (index < NumberOfQuads)
  {
    Quads[index] = kernel(FirstQuad + index);
  }
}

#else

uniform uint QuadsPerLine;

out uvec4 Quad;

void main()
{
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  Quad = kernel(FirstQuad + pixel.y * QuadsPerLine + pixel.x);
}

#endif
