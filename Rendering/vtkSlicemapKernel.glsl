// The frame of a kernel of vtkSlicemapKernel; follows vtkSlicemapLayout.glsl, precedes the kernel.
//
// A run fills a box of words, RegionSize words, rows and slices from RegionFirst on. The compute
// stage writes them to storage buffer 0, which begins BaseWord words before slice RegionFirst.z of
// the target; the fragment stage to pixel (word, slice * RegionSize.y + row) of an R32UI render
// target, counted in the region.
//
// With CELL_BITS the compute stage calls cell() instead, for each cell of one word by 1 << CELL_BITS
// rows and slices. It puts all words of the cell that belong to the grid. Invocations that run
// together have cells that make a block, so that they agree more often.

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

void put(uvec3 word, uint value)
{
  uvec3 at = word - RegionFirst;
  if (at.x < RegionSize.x && at.y < RegionSize.y && at.z < RegionSize.z)
  {
    Words[BaseWord + (at.z * RowsPerSlice + word.y) * WordsPerRow + word.x] = value;
  }
}

#ifdef CELL_BITS

const uvec2 BLOCK = uvec2(2u, 4u);

void cell(uvec3 first);

void main()
{
  uint index =
    gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
  uvec2 firstCell = RegionFirst.yz >> CELL_BITS;
  uvec2 cells = (RegionFirst.yz + RegionSize.yz - 1u >> CELL_BITS) + 1u - firstCell;
  uint blocksPerSlice = (cells.x + BLOCK.x - 1u) / BLOCK.x;
  uvec2 within = uvec2(index % BLOCK.x, index / BLOCK.x % BLOCK.y);
  index /= BLOCK.x * BLOCK.y;
  uint word = index % RegionSize.x;
  index /= RegionSize.x;
  uvec2 at = uvec2(index % blocksPerSlice, index / blocksPerSlice) * BLOCK + within;
  if (at.x < cells.x && at.y < cells.y)
  {
    cell(uvec3(RegionFirst.x + word, firstCell + at << CELL_BITS));
  }
}

#else

void main()
{
  uint index =
    gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
  uint row = index / RegionSize.x;
  uvec3 at = uvec3(index % RegionSize.x, row % RegionSize.y, row / RegionSize.y);
  if (at.z < RegionSize.z)
  {
    uvec3 word = RegionFirst + at;
    put(word, kernel(word));
  }
}

#endif

#else

out uint Word;

void main()
{
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  Word = kernel(RegionFirst + uvec3(pixel.x, pixel.y % RegionSize.y, pixel.y / RegionSize.y));
}

#endif
