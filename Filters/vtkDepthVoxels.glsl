// Kernel of vtkDepthBuffers: the voxels that lie between all pairs of depth buffers. A cell is set as
// a whole where all of its columns agree; elsewhere, near the surface, 32 columns are compared at
// once, by the planes of their bits.
//
// HAS_X, HAS_Y, HAS_Z     defined: there is a pair along that axis
// SHELLS                  defined: only the voxels that a pair sees on the surface
// BITS, PLANES            those of vtkDepthPlanes.glsl
// CELL_ROWS, CELL_SLICES  of a cell, which is one word wide, powers of two of up to 1 << LOW_BITS
//
// EndsX             those of vtkDepthRanges.glsl, or with SHELLS of vtkDepthShells.glsl, of the whole
//                   grid
// PlanesY, PlanesZ  those of vtkDepthPlanes.glsl
// Blocks...         those of vtkDepthBlocks.glsl, of the columns of a cell
// First             the first voxel of the slicemap, counted from that of the whole grid
// Size              voxels of the slicemap
// WordsInUse        words of a row that hold some of them

uniform ivec3 First;
uniform ivec3 Size;
uniform int WordsInUse;

#ifdef HAS_X
uniform usampler2D EndsX;
uniform usampler2D BlocksX;
#endif
#ifdef HAS_Y
uniform usamplerBuffer PlanesY;
uniform usampler2D BlocksY;
#endif
#ifdef HAS_Z
uniform usamplerBuffer PlanesZ;
uniform usampler2D BlocksZ;
#endif

const int LOW_BITS = 3;

// Voxels inside, and with SHELLS those that are not on the surface; the ends of both ranges.
#ifdef SHELLS
#define VOXELS uvec2
#define ENDS uvec4
#else
#define VOXELS uint
#define ENDS uvec2
#endif

// What all columns of a cell agree on, if they do.
struct Cell
{
  bool IsInside;
  bool IsOutside;
  bool IsInner;
  bool IsOuter;
};

void ask(inout Cell cell, uvec4 block, int first, int end)
{
  ivec4 smallest = ivec4(block & 0xffffu);
  ivec4 largest = ivec4(block >> 16);
  cell.IsInside = cell.IsInside && first >= largest.x && end <= smallest.y;
  cell.IsOutside = cell.IsOutside || end <= smallest.x || first >= largest.y;
  cell.IsInner = cell.IsInner && first >= largest.z && end <= smallest.w;
  cell.IsOuter = cell.IsOuter || end <= smallest.z || first >= largest.w;
}

// Whether voxels differ in the cell of a word; if not, the word.
bool isMixed(ivec3 word, out uint bits)
{
  ivec3 cellSize = ivec3(32, CELL_ROWS, CELL_SLICES);
  ivec3 place = ivec3(word.x, word.y / CELL_ROWS, word.z / CELL_SLICES);
  ivec3 first = place * cellSize;
  ivec3 end = min(first + cellSize, Size);
  Cell cell = Cell(true, word.x >= WordsInUse, true, false);
#ifdef HAS_X
  ask(cell, texelFetch(BlocksX, place.yz, 0), first.x, end.x);
#endif
  place.x = min(place.x, WordsInUse - 1);
#ifdef HAS_Y
  ask(cell, texelFetch(BlocksY, place.xz, 0), first.y, end.y);
#endif
#ifdef HAS_Z
  ask(cell, texelFetch(BlocksZ, place.xy, 0), first.z, end.z);
#endif
  bool isEmpty = cell.IsOutside;
  bool isFull = cell.IsInside;
#ifdef SHELLS
  isEmpty = isEmpty || cell.IsInner;
  isFull = isFull && cell.IsOuter;
#endif
  bits = isEmpty ? 0u : slicemapRange(uint(word.x), 0, Size.x);
  return !isEmpty && !isFull;
}

#ifdef HAS_X
uint wordOfRange(uint range, int word)
{
  return slicemapRange(uint(word), int(range & 0xffffu) - First.x, int(range >> 16) - First.x);
}

VOXELS alongX(ivec3 word)
{
  uvec2 ends = texelFetch(EndsX, First.yz + word.yz, 0).rg;
#ifdef SHELLS
  return uvec2(wordOfRange(ends.r, word.x), wordOfRange(ends.g, word.x));
#else
  return wordOfRange(ends.r, word.x);
#endif
}
#endif

#if defined(HAS_Y) || defined(HAS_Z)
// The ends of 32 columns, compared with the voxels that share all bits but the lowest LOW_BITS.
struct Columns
{
  ENDS Beyond; // the end is beyond all of these voxels
  ENDS Within; // it is one of them, by its lowest bits:
  ENDS Low[LOW_BITS];
};

uint planeOf(uvec4 planes[PLANES], int plane)
{
  return planes[plane / 4][plane % 4];
}

ENDS endsOf(uvec4 planes[PLANES], int bit)
{
#ifdef SHELLS
  return uvec4(planeOf(planes, bit), planeOf(planes, bit + BITS), planeOf(planes, bit + 2 * BITS),
    planeOf(planes, bit + 3 * BITS));
#else
  return uvec2(planeOf(planes, bit), planeOf(planes, bit + BITS));
#endif
}

Columns columnsAt(usamplerBuffer source, ivec2 word, int voxel)
{
  uvec4 planes[PLANES];
  for (int p = 0; p < PLANES; ++p)
  {
    planes[p] = texelFetch(source, (word.y * WordsInUse + word.x) * PLANES + p);
  }
  Columns columns;
  columns.Beyond = ENDS(0u);
  columns.Within = ENDS(FULL_WORD);
  for (int bit = BITS - 1; bit >= LOW_BITS; --bit)
  {
    ENDS ends = endsOf(planes, bit);
    uint mask = uint(-((voxel >> bit) & 1));
    columns.Beyond |= columns.Within & ends & ~mask;
    columns.Within &= ~(ends ^ mask);
  }
  for (int bit = 0; bit < LOW_BITS; ++bit)
  {
    columns.Low[bit] = endsOf(planes, bit);
  }
  return columns;
}

// The columns that have one of these voxels in their range.
VOXELS inRange(Columns columns, int voxel)
{
  ENDS beyond = ENDS(0u);
  for (int bit = 0; bit < LOW_BITS; ++bit)
  {
    uint mask = uint(-((voxel >> bit) & 1));
    beyond = (columns.Low[bit] & (beyond | ~mask)) | (beyond & ~mask);
  }
  beyond = columns.Beyond | (columns.Within & beyond);
#ifdef SHELLS
  return beyond.yw & ~beyond.xz;
#else
  return beyond.y & ~beyond.x;
#endif
}
#endif

uint wordOf(VOXELS voxels)
{
#ifdef SHELLS
  return voxels.x & ~voxels.y;
#else
  return voxels;
#endif
}

#ifdef COMPUTE

// The words of a cell whose voxels differ.
void compare(ivec3 first, ivec3 end, uint bits)
{
#ifdef HAS_Z
  Columns rows[CELL_ROWS];
  for (int i = 0; i < CELL_ROWS; ++i)
  {
    rows[i] = columnsAt(PlanesZ, ivec2(first.x, min(first.y + i, Size.y - 1)), first.z);
  }
#endif
  for (int z = first.z; z < end.z; ++z)
  {
#ifdef HAS_Y
    Columns slice = columnsAt(PlanesY, ivec2(first.x, z), first.y);
#endif
    for (int i = 0; i < CELL_ROWS; ++i)
    {
      ivec3 word = ivec3(first.x, min(first.y + i, Size.y - 1), z);
      VOXELS voxels = VOXELS(bits);
#ifdef HAS_X
      voxels &= alongX(word);
#endif
#ifdef HAS_Y
      voxels &= inRange(slice, word.y);
#endif
#ifdef HAS_Z
      voxels &= inRange(rows[i], z);
#endif
      put(uvec3(word), wordOf(voxels));
    }
  }
}

void cell(uvec3 quad)
{
  ivec3 first = ivec3(quad);
  ivec3 end = min(first + ivec3(4, CELL_ROWS, CELL_SLICES), ivec3(WordsInUse, Size.yz));
  uvec4 words = uvec4(0u);
  uint mixed = 0u;
  for (int x = first.x; x < end.x; ++x)
  {
    uint word;
    uint bit = 1u << uint(x - first.x);
    mixed |= isMixed(ivec3(x, first.yz), word) ? bit : 0u;
    words |= word * uvec4(equal(uvec4(bit), uvec4(1u, 2u, 4u, 8u)));
  }
  for (int z = first.z; z < end.z; ++z)
  {
    for (int y = first.y; y < end.y; ++y)
    {
      putQuad(uvec3(quad.x, y, z), words);
    }
  }
  while (mixed != 0u)
  {
    int i = findLSB(mixed);
    mixed &= mixed - 1u;
    int x = first.x + i;
    compare(ivec3(x, first.yz), end, slicemapRange(uint(x), 0, Size.x));
  }
}

#else

uint kernel(uvec3 word)
{
  ivec3 place = ivec3(word);
  uint bits;
  if (isMixed(place, bits))
  {
    VOXELS voxels = VOXELS(bits);
#ifdef HAS_X
    voxels &= alongX(place);
#endif
#ifdef HAS_Y
    voxels &= inRange(columnsAt(PlanesY, place.xz, place.y), place.y);
#endif
#ifdef HAS_Z
    voxels &= inRange(columnsAt(PlanesZ, place.xy, place.z), place.z);
#endif
    bits = wordOf(voxels);
  }
  return bits;
}

#endif
