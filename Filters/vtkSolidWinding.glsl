// From signed crossings to solid: a voxel is set where the running sum of the crossings of its column
// is not zero.
//
// Follows vtkSlicemapLayout.glsl.
//
// COLUMN_AXIS  0, 1 or 2: the columns run along x, y or z; u and v are the other two, in order.
//
// storage buffer 0 one int a voxel of the slab and one more at the end of each column, at
//                  (v * (nd + 1) + d) * nu + u
// storage buffer 1 the words of the slicemap; the slab's first voxel is in word FirstWord
// storage buffer 2 one bit a column, set where the sum at its end is not zero, at bit u % 32 of word
//                  (FirstRow + v) * EndWordsPerRow + u / 32; zeros before
//
// Size is the slab's number of voxels along (u, v, depth).

layout(local_size_x = 64) in;

uniform ivec3 Size;
uniform uint WordsPerRow;
uniform uint RowsPerSlice;
uniform uint FirstWord;
uniform uint FirstRow;
uniform uint EndWordsPerRow;

layout(std430, binding = 0) readonly buffer Counters
{
  int Counts[];
};
layout(std430, binding = 1) writeonly buffer Slicemap
{
  uint Words[];
};
layout(std430, binding = 2) buffer ColumnEnds
{
  uint Leaks[];
};

uint invocation()
{
  return gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
}

int countAt(int u, int v, int d)
{
  return Counts[(v * (Size.z + 1) + d) * Size.x + u];
}

#if COLUMN_AXIS == 0

void main()
{
  uint column = invocation();
  if (column >= uint(Size.x * Size.y))
  {
    return;
  }
  int u = int(column) % Size.x;
  int v = int(column) / Size.x;
  int winding = 0;
  for (uint word = 0u; word < WordsPerRow; ++word)
  {
    uint bits = 0u;
    for (uint bit = 0u; bit < WORD_BITS; ++bit)
    {
      int d = int(word * WORD_BITS + bit);
      if (d < Size.z)
      {
        winding += countAt(u, v, d);
        bits |= winding != 0 ? 1u << bit : 0u;
      }
    }
    Words[FirstWord + slicemapWord(uvec3(word * WORD_BITS, u, v), WordsPerRow, RowsPerSlice)] = bits;
  }
  if (winding + countAt(u, v, Size.z) != 0)
  {
    uvec3 end = uvec3(u, v + int(FirstRow), 0);
    atomicOr(Leaks[slicemapWord(end, EndWordsPerRow, 0u)], slicemapBit(end.x));
  }
}

#else

void main()
{
  uint column = invocation();
  if (column >= WordsPerRow * uint(Size.y))
  {
    return;
  }
  uint word = column % WordsPerRow;
  int v = int(column / WordsPerRow);
  int first = int(word * WORD_BITS);
  int columns = clamp(Size.x - first, 0, int(WORD_BITS));
  int winding[WORD_BITS];
  for (int i = 0; i < int(WORD_BITS); ++i)
  {
    winding[i] = 0;
  }
  for (int d = 0; d < Size.z; ++d)
  {
    uint bits = 0u;
    for (int i = 0; i < columns; ++i)
    {
      winding[i] += countAt(first + i, v, d);
      bits |= winding[i] != 0 ? 1u << uint(i) : 0u;
    }
#if COLUMN_AXIS == 1
    uvec3 voxel = uvec3(first, d, v);
#else
    uvec3 voxel = uvec3(first, v, d);
#endif
    Words[FirstWord + slicemapWord(voxel, WordsPerRow, RowsPerSlice)] = bits;
  }
  uint leaks = 0u;
  for (int i = 0; i < columns; ++i)
  {
    leaks |= winding[i] + countAt(first + i, v, Size.z) != 0 ? 1u << uint(i) : 0u;
  }
  Leaks[(FirstRow + uint(v)) * EndWordsPerRow + word] = leaks;
}

#endif
