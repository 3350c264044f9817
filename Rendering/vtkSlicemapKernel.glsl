// The frame of a kernel of vtkSlicemapKernel; follows vtkSlicemapLayout.glsl, precedes the kernel.
//
// A run fills a box of words, RegionSize words, rows and slices from RegionFirst on. The compute
// stage writes them to storage buffer 0, which begins BaseWord words before slice RegionFirst.z of
// the target; the fragment stage to pixel (word, slice * RegionSize.y + row) of an R32UI render
// target, counted in the region.

uniform uvec3 RegionFirst;
uniform uvec3 RegionSize;
uniform uint WordsPerRow;
uniform uint RowsPerSlice;

uint kernel(uvec3 word);

uint sourceWord(usamplerBuffer source, uvec3 word)
{
  uint index = (word.z * RowsPerSlice + word.y) * WordsPerRow + word.x;
  return texelFetch(source, int(index / 4u))[index % 4u];
}

#ifdef COMPUTE

layout(local_size_x = 64) in;

layout(std430, binding = 0) writeonly buffer Target
{
  uint Words[];
};

uniform uint BaseWord;

void main()
{
  uint index =
    gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
  uint row = index / RegionSize.x;
  uvec3 at = uvec3(index % RegionSize.x, row % RegionSize.y, row / RegionSize.y);
  if (at.z < RegionSize.z)
  {
    uvec3 word = RegionFirst + at;
    Words[BaseWord + (at.z * RowsPerSlice + word.y) * WordsPerRow + word.x] = kernel(word);
  }
}

#else

out uint Word;

void main()
{
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  Word = kernel(RegionFirst + uvec3(pixel.x, pixel.y % RegionSize.y, pixel.y / RegionSize.y));
}

#endif
