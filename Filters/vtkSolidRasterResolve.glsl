// From the render targets of a pass to the words of a slicemap; a kernel of vtkSlicemapKernel.
//
// COLUMN_AXIS  0, 1 or 2: the columns of the pass run along x, y or z
// COLUMN_ENDS  defined when the kernel makes the slicemap of nu x nv x 1 voxels that holds the one slice
//              EndSlice
// WINDING      defined when the targets hold winding numbers, one slice a channel; else slice s is bit
//              s % 32 of channel s / 32 % 4 of layer s / 128
//
// Columns      the render targets as layers, a pixel a column
// TileFirst    the column at pixel (0, 0), counted from the first voxel of the grid
// FirstSlice   the slice at bit 0 of the first layer, counted likewise
// Size         number of voxels along x, y and z

#ifdef WINDING
uniform sampler2DArray Columns;
#else
uniform usampler2DArray Columns;
#endif
uniform ivec2 TileFirst;
uniform int FirstSlice;
uniform ivec3 Size;
uniform int EndSlice;

bool isSet(ivec2 column, int slice)
{
  ivec2 pixel = column - TileFirst;
  int s = slice - FirstSlice;
#ifdef WINDING
  return abs(texelFetch(Columns, ivec3(pixel, s / 4), 0)[s % 4]) > 0.5;
#else
  uint bits = texelFetch(Columns, ivec3(pixel, s / 128), 0)[s / 32 % 4];
  return (bits >> uint(s % 32) & 1u) != 0u;
#endif
}

// 32 voxels along x, of which `columns` exist; they are columns from `column` on in one slice.
uint gather(ivec2 column, int slice, int columns)
{
  uint bits = 0u;
  for (int i = 0; i < min(columns, 32); ++i)
  {
    bits |= isSet(ivec2(column.x + i, column.y), slice) ? 1u << uint(i) : 0u;
  }
  return bits;
}

uint kernel(uvec3 word)
{
  int x = int(word.x * WORD_BITS);
#if defined(COLUMN_ENDS)
  int columns = COLUMN_AXIS == 0 ? Size.y : Size.x;
  return gather(ivec2(x, word.y), EndSlice, columns - x);
#elif COLUMN_AXIS == 0
  ivec2 column = ivec2(word.yz);
#ifdef WINDING
  uint bits = 0u;
  for (int i = 0; i < clamp(Size.x - x, 0, 32); ++i)
  {
    bits |= isSet(column, x + i) ? 1u << uint(i) : 0u;
  }
  return bits;
#else
  int wordOfPass = int(word.x) - FirstSlice / 32;
  uvec4 words = texelFetch(Columns, ivec3(column - TileFirst, wordOfPass / 4), 0);
  return words[wordOfPass % 4] & slicemapRange(word.x, 0, Size.x);
#endif
#elif COLUMN_AXIS == 1
  return gather(ivec2(x, word.z), int(word.y), Size.x - x);
#else
  return gather(ivec2(x, word.y), int(word.z), Size.x - x);
#endif
}
