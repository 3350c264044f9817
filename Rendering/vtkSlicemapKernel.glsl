// The frame of a kernel of vtkSlicemapKernel; follows vtkSlicemapLayout.glsl, precedes the kernel.
//
// A run fills a box of words, RegionSize words, rows and slices from RegionFirst on. The compute
// stage writes them to storage buffer 0, which begins BaseWord words before slice RegionFirst.z of
// the target; the fragment stage to pixel (word, slice * RegionSize.y + row) of an R32UI render
// target, counted in the region.
//
// With CELL_ROWS and CELL_SLICES the compute stage calls cell() instead, for each cell of a quad of
// words by so many rows and slices. It puts all words of the cell; those beyond the region are left
// out. Regions then consist of whole rows. Invocations that run together have cells that make a
// block, so that they agree more often.

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

#if defined(CELL_ROWS) && defined(CELL_SLICES)

const uvec2 CELL = uvec2(CELL_ROWS, CELL_SLICES);
const uvec2 BLOCK = uvec2(4u, 2u);

void cell(uvec3 first);

bool isInRegion(uvec3 word)
{
  uvec2 row = word.yz - RegionFirst.yz;
  return row.x < RegionSize.y && row.y < RegionSize.z;
}

uint placeOf(uvec3 word)
{
  return BaseWord + ((word.z - RegionFirst.z) * RowsPerSlice + word.y) * WordsPerRow + word.x;
}

void put(uvec3 word, uint value)
{
  if (isInRegion(word))
  {
    Words[placeOf(word)] = value;
  }
}

void putQuad(uvec3 first, uvec4 values)
{
  if (isInRegion(first))
  {
    uint place = placeOf(first);
    Words[place] = values.x;
    Words[place + 1u] = values.y;
    Words[place + 2u] = values.z;
    Words[place + 3u] = values.w;
  }
}

void main()
{
  uint index =
    gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
  uvec2 firstCell = RegionFirst.yz / CELL;
  uvec2 cells = (RegionFirst.yz + RegionSize.yz - 1u) / CELL + 1u - firstCell;
  uint blocksPerSlice = (cells.x + BLOCK.x - 1u) / BLOCK.x;
  uvec2 within = uvec2(index % BLOCK.x, index / BLOCK.x % BLOCK.y);
  index /= BLOCK.x * BLOCK.y;
  uint quad = index % (WordsPerRow / 4u);
  index /= WordsPerRow / 4u;
  uvec2 at = uvec2(index % blocksPerSlice, index / blocksPerSlice) * BLOCK + within;
  if (at.x < cells.x && at.y < cells.y)
  {
    cell(uvec3(quad * 4u, (firstCell + at) * CELL));
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
    Words[BaseWord + (at.z * RowsPerSlice + word.y) * WordsPerRow + word.x] = kernel(word);
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
