// The frame of a kernel of vtkSlicemapQuadKernel; follows vtkSlicemapLayout.glsl, precedes the
// kernel.
//
// A run fills NumberOfQuads quads, of four words each, from FirstQuad on. The compute stage writes
// them to storage buffer 0, which begins with the first of them; the fragment stage to an RGBA32UI
// render target, row after row of QuadsPerLine pixels. With PLANES, each call of
// the kernel makes that many quads, which follow one another; the compute stage counts calls then.
// With RUNS, which only the compute stage has, a call of run() puts as many of these groups as it
// likes, wherever they belong.

uniform uint FirstQuad;

#ifdef PLANES
void kernel(uint quad, out uvec4 planes[PLANES]);
#else
uvec4 kernel(uint quad);
#endif

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

#ifdef PLANES
void put(uint group, uvec4 planes[PLANES])
{
  for (int p = 0; p < PLANES; ++p)
  {
    Quads[group * uint(PLANES) + uint(p)] = planes[p];
  }
}
#endif

#ifdef RUNS
void run(uint call);
#endif

void main()
{
  uint index =
    gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
  if (index < NumberOfQuads)
  {
#ifdef RUNS
    run(index);
#elif defined(PLANES)
    uvec4 planes[PLANES];
    kernel(FirstQuad + index, planes);
    put(index, planes);
#else
    Quads[index] = kernel(FirstQuad + index);
#endif
  }
}

#else

uniform uint QuadsPerLine;

out uvec4 Quad;

void main()
{
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  uint index = FirstQuad + pixel.y * QuadsPerLine + pixel.x;
#ifdef PLANES
  uvec4 planes[PLANES];
  kernel(index / uint(PLANES), planes);
  Quad = planes[index % uint(PLANES)];
#else
  Quad = kernel(index);
#endif
}

#endif
