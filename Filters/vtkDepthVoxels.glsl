// Kernel of vtkDepthBuffers: the voxels that lie between all pairs of depth buffers. Where all columns
// of a word agree, it is set as a whole; the columns are looked at one by one elsewhere, near the
// surface.
//
// HAS_X, HAS_Y, HAS_Z  defined: there is a pair along that axis
// SHELLS               defined: only the voxels that a pair sees on the surface
//
// ColumnsX, ColumnsY, ColumnsZ  those of vtkDepthRanges.glsl, or with SHELLS of vtkDepthShells.glsl, of
//                               the whole grid
// BlocksY, BlocksZ              those of vtkDepthBlocks.glsl, of the columns of the slicemap
// First                         the first voxel of the slicemap, counted from that of the whole grid
// Size                          voxels of the slicemap
// QuadsPerRow                   quads of a row of it

uniform ivec3 First;
uniform ivec3 Size;
uniform uint QuadsPerRow;

#ifdef HAS_X
uniform usampler2D ColumnsX;
#endif
#ifdef HAS_Y
uniform usampler2D ColumnsY;
uniform usampler2D BlocksY;
#endif
#ifdef HAS_Z
uniform usampler2D ColumnsZ;
uniform usampler2D BlocksZ;
#endif

// What is known of a word: the voxels that are inside, if all columns agree on that, and those on the
// surface.
struct Word
{
  uint Inside;
  uint Seen;
  bool IsSure;
};

#if defined(HAS_Y) || defined(HAS_Z)
void ask(inout Word word, uvec4 block, int depth)
{
  uvec4 smallest = block & 0xffffu;
  uvec4 largest = block >> 16;
  uint d = uint(depth);
  word.Inside = d < smallest.x || d >= largest.y ? 0u : word.Inside;
  word.IsSure = word.IsSure && d >= largest.x && d < smallest.y;
#ifdef SHELLS
  bool isSeenByAll = d < smallest.z || d >= largest.w;
  bool isSeenByNone = d >= largest.z && d < smallest.w;
  word.Seen = isSeenByAll ? FULL_WORD : word.Seen;
  word.IsSure = word.IsSure && (isSeenByAll || isSeenByNone);
#endif
}

void askOne(inout Word word, uvec2 column, int depth, uint bit)
{
  uint d = uint(depth);
  bool isInside = d >= (column.r & 0xffffu) && d < column.r >> 16;
  word.Inside &= isInside ? FULL_WORD : ~bit;
#ifdef SHELLS
  bool isSeen = d < (column.g & 0xffffu) || d >= column.g >> 16;
  word.Seen |= isSeen ? bit : 0u;
#endif
}
#endif

// A word of the row through voxel `row` of the whole grid, whose first bit is at `place` of the slicemap.
uint wordOf(ivec3 row, int place, uvec2 columnX)
{
  int x = First.x + place;
  int begin = clamp(int(columnX.r & 0xffffu) - x, 0, 32);
  int end = clamp(min(int(columnX.r >> 16) - x, Size.x - place), 0, 32);
  Word word = Word(slicemapRange(0u, begin, end), FULL_WORD, true);
#ifdef SHELLS
  word.Seen = ~slicemapRange(0u, int(columnX.g & 0xffffu) - x, int(columnX.g >> 16) - x);
#endif
#if defined(HAS_Y) || defined(HAS_Z)
  int block = min(place, Size.x - 1) / 32;
#ifdef HAS_Y
  ask(word, texelFetch(BlocksY, ivec2(block, row.z), 0), row.y);
#endif
#ifdef HAS_Z
  ask(word, texelFetch(BlocksZ, ivec2(block, row.y), 0), row.z);
#endif
  end = word.IsSure || word.Inside == 0u ? 0 : end;
  for (int i = begin; i < end; ++i)
  {
    uint bit = 1u << uint(i);
#ifdef HAS_Y
    askOne(word, texelFetch(ColumnsY, ivec2(x + i, row.z), 0).rg, row.y, bit);
#endif
#ifdef HAS_Z
    askOne(word, texelFetch(ColumnsZ, ivec2(x + i, row.y), 0).rg, row.z, bit);
#endif
  }
#endif
  return word.Inside & word.Seen;
}

uvec4 kernel(uint quad)
{
  uint index = quad / QuadsPerRow;
  int place = int(quad % QuadsPerRow) * 128;
  ivec3 row = First + ivec3(0, int(index % uint(Size.y)), int(index / uint(Size.y)));
  uvec2 columnX = uvec2(0xffff0000u);
#ifdef HAS_X
  columnX = texelFetch(ColumnsX, row.yz, 0).rg;
#endif
  uvec4 bits;
  for (int i = 0; i < 4; ++i)
  {
    bits[i] = wordOf(row, place + 32 * i, columnX);
  }
  return bits;
}
