// Kernel of vtkMorphologyPass: dilation of the voxels by part of a structuring element. See
// vtkSlicemapQuadKernel.h: a quad is four words, 128 voxels along x.
//
// ROWS     defined: by a list of rows along x, at most MAX_ROWS at a time, united with Partial
// AXIS     0, 1 or 2, otherwise: by TAPS voxels at Offsets along x, y or z
//
// Source   the words of the slicemap, four a texel
// Partial  those of the rows before these ones, with HAS_PARTIAL
// Size     number of voxels along x, y and z
// QuadsPerRow number of texels of a row
// Inverted all bits set to dilate what is not set, and to invert the result: an erosion
// Border   all bits set when the voxels beyond the grid are set (after inversion)
//
// Beyond the grid TAPS find the last voxel of their line, besides Border: what a tap of a longer line
// would have found of the grid there is what an earlier pass has left in that voxel.

uniform usamplerBuffer Source;
uniform ivec3 Size;
uniform uint QuadsPerRow;
uniform uint Inverted;
uniform uint Border;

// The quad at (quad of its row, y, z).
uvec4 quadAt(ivec3 at)
{
  uint row = uint(at.z) * uint(Size.y) + uint(at.y);
  return sourceQuad(Source, row * QuadsPerRow + uint(at.x)) ^ Inverted;
}

ivec3 placeOf(uint quad)
{
  uint row = quad / QuadsPerRow;
  return ivec3(quad % QuadsPerRow, row % uint(Size.y), row / uint(Size.y));
}

// The bits of a quad that are in the grid.
uvec4 insideQuad(int x)
{
  uint word = uint(x) * 4u;
  return uvec4(slicemapRange(word, 0, Size.x), slicemapRange(word + 1u, 0, Size.x),
    slicemapRange(word + 2u, 0, Size.x), slicemapRange(word + 3u, 0, Size.x));
}

#ifdef ROWS

const int MAX_ROWS = 128;

// (y, z, first x, last x), relative to the voxel, -31 <= first x <= 0 <= last x <= 31.
uniform ivec4 Rows[MAX_ROWS];
uniform int NumberOfRows;

#ifdef HAS_PARTIAL
uniform usamplerBuffer Partial;
#endif

// A quad of a row, which may lie before it or behind it; `inside` are its bits in the grid.
uvec4 quadOfRow(ivec3 at, uvec4 inside)
{
  at.x = clamp(at.x, 0, int(QuadsPerRow) - 1);
  return (quadAt(at) & inside) | (Border & ~inside);
}

// Bit b of each word: whether one of the bits b to b + last is set, the word `after` it included.
uvec4 anyAbove(uvec4 bits, uvec4 after, int last)
{
  int covered = 1;
  while (covered <= last)
  {
    uint shift = uint(min(covered, last + 1 - covered));
    bits |= bits >> shift | after << (32u - shift);
    after |= after >> shift;
    covered += int(shift);
  }
  return bits;
}

// Bit b of each word: whether one of the bits b - first to b is set, the word `before` it included.
uvec4 anyBelow(uvec4 before, uvec4 bits, int first)
{
  int covered = 1;
  while (covered <= first)
  {
    uint shift = uint(min(covered, first + 1 - covered));
    bits |= bits << shift | before >> (32u - shift);
    before |= before << shift;
    covered += int(shift);
  }
  return bits;
}

uvec4 kernel(uint quad)
{
  ivec3 place = placeOf(quad);
  uvec4 inside = insideQuad(place.x);
  uvec4 insideBefore = uvec4(place.x > 0 ? FULL_WORD : 0u);
  uvec4 insideBehind = insideQuad(place.x + 1);
  uvec4 result = uvec4(0u);
#ifdef HAS_PARTIAL
  result = sourceQuad(Partial, quad) ^ Inverted;
#endif
  for (int i = 0; i < NumberOfRows; ++i)
  {
    ivec4 row = Rows[i];
    ivec2 yz = place.yz + row.xy;
    ivec2 within = clamp(yz, ivec2(0), Size.yz - 1);
    uvec4 middle = quadOfRow(ivec3(place.x, within), inside);
    uint before = quadOfRow(ivec3(place.x - 1, within), insideBefore).w;
    uint behind = quadOfRow(ivec3(place.x + 1, within), insideBehind).x;
    uvec4 bits = anyAbove(middle, uvec4(middle.yzw, behind), row.w) |
      anyBelow(uvec4(before, middle.xyz), middle, -row.z);
    result |= yz == within ? bits : uvec4(Border);
  }
  return (result ^ Inverted) & inside;
}

#else

uniform ivec4 Offsets;

#if AXIS == 0

uint wordAt(int word, ivec2 yz)
{
  return quadAt(ivec3(word / 4, yz))[word % 4];
}

// All bits as one voxel of a row is.
uint fill(int x, ivec2 yz)
{
  return 0u - (wordAt(x / 32, yz) >> uint(x % 32) & 1u);
}

// The 32 voxels from x on, with those beyond the row.
uint bitsFrom(int x, ivec2 yz)
{
  int lastWord = int(QuadsPerRow) * 4 - 1;
  int word = x >> 5;
  uint shift = uint(x & 31);
  uint low = wordAt(clamp(word, 0, lastWord), yz) >> shift;
  uint high = shift == 0u ? 0u : wordAt(clamp(word + 1, 0, lastWord), yz) << (32u - shift);
  uint before = x >= 0 ? 0u : x <= -32 ? FULL_WORD : (1u << uint(-x)) - 1u;
  int left = Size.x - x;
  uint behind = left >= 32 ? 0u : left <= 0 ? FULL_WORD : ~((1u << uint(left)) - 1u);
  uint inside = (low | high) & ~(before | behind);
  return inside | (before & (fill(0, yz) | Border)) |
    (behind & (fill(Size.x - 1, yz) | Border));
}

uvec4 tap(ivec3 place, int offset)
{
  int x = place.x * 128 + offset;
  return uvec4(bitsFrom(x, place.yz), bitsFrom(x + 32, place.yz), bitsFrom(x + 64, place.yz),
    bitsFrom(x + 96, place.yz));
}

#else

uvec4 tap(ivec3 place, int offset)
{
  int wanted = place[AXIS] + offset;
  place[AXIS] = clamp(wanted, 0, Size[AXIS] - 1);
  return quadAt(place) | (place[AXIS] == wanted ? 0u : Border);
}

#endif

uvec4 kernel(uint quad)
{
  ivec3 place = placeOf(quad);
  uvec4 result = tap(place, Offsets[0]);
#if TAPS > 1
  result |= tap(place, Offsets[1]);
#endif
#if TAPS > 2
  result |= tap(place, Offsets[2]);
#endif
#if TAPS > 3
  result |= tap(place, Offsets[3]);
#endif
  return (result ^ Inverted) & insideQuad(place.x);
}

#endif
