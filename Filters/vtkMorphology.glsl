// Kernel of vtkMorphologyPass: dilation of the voxels by part of a structuring element. See
// vtkSlicemapKernel.h.
//
// ROWS     defined: by a list of rows along x, at most MAX_ROWS at a time, united with Partial
// AXIS     0, 1 or 2, otherwise: by TAPS voxels at Offsets along x, y or z
//
// Source   the words of the slicemap, four a texel
// Partial  those of the rows before these ones, with HAS_PARTIAL
// Size     number of voxels along x, y and z
// Inverted all bits set to dilate what is not set, and to invert the result: an erosion
// Border   all bits set when the voxels beyond the grid are set (after inversion)
//
// Beyond the grid TAPS find the last voxel of their line, besides Border: what a tap of a longer line
// would have found of the grid there is what an earlier pass has left in that voxel.

uniform usamplerBuffer Source;
uniform ivec3 Size;
uniform uint Inverted;
uniform uint Border;

uint wordAt(int word, ivec2 yz)
{
  return sourceWord(Source, uvec3(word, yz)) ^ Inverted;
}

#ifdef ROWS

const int MAX_ROWS = 128;

// (y, z, first x, last x), relative to the voxel, -31 <= first x <= 0 <= last x <= 31.
uniform ivec4 Rows[MAX_ROWS];
uniform int NumberOfRows;

#ifdef HAS_PARTIAL
uniform usamplerBuffer Partial;
#endif

// The word of a row, which may begin before it or end behind it.
uint wordOfRow(int word, ivec2 yz)
{
  uint inside = slicemapRange(uint(max(word, 0)), 0, Size.x);
  inside = word < 0 ? 0u : inside;
  uint bits = wordAt(clamp(word, 0, int(WordsPerRow) - 1), yz);
  return (bits & inside) | (Border & ~inside);
}

// Bit b of the result: whether one of the bits b to b + last of 64 is set.
uint anyAbove(uvec2 bits, int last)
{
  int covered = 1;
  while (covered <= last)
  {
    uint shift = uint(min(covered, last + 1 - covered));
    bits |= uvec2(bits.x >> shift | bits.y << (32u - shift), bits.y >> shift);
    covered += int(shift);
  }
  return bits.x;
}

// Bit b of the result: whether one of the bits b - first to b of the upper 32 of 64 is set.
uint anyBelow(uvec2 bits, int first)
{
  int covered = 1;
  while (covered <= first)
  {
    uint shift = uint(min(covered, first + 1 - covered));
    bits |= uvec2(bits.x << shift, bits.y << shift | bits.x >> (32u - shift));
    covered += int(shift);
  }
  return bits.y;
}

uint kernel(uvec3 word)
{
  uint result = 0u;
#ifdef HAS_PARTIAL
  result = sourceWord(Partial, word) ^ Inverted;
#endif
  for (int i = 0; i < NumberOfRows; ++i)
  {
    ivec4 row = Rows[i];
    ivec2 yz = ivec2(word.yz) + row.xy;
    ivec2 within = clamp(yz, ivec2(0), Size.yz - 1);
    int x = int(word.x);
    uint middle = wordOfRow(x, within);
    uint bits = anyAbove(uvec2(middle, wordOfRow(x + 1, within)), row.w) |
      anyBelow(uvec2(wordOfRow(x - 1, within), middle), -row.z);
    result |= yz == within ? bits : Border;
  }
  return (result ^ Inverted) & slicemapRange(word.x, 0, Size.x);
}

#else

uniform ivec4 Offsets;

#if AXIS == 0

// All bits as one voxel of a row is.
uint fill(int x, ivec2 yz)
{
  return 0u - (wordAt(x / 32, yz) >> uint(x % 32) & 1u);
}

// The 32 voxels from x on, with those beyond the row.
uint tap(ivec3 voxel, int offset)
{
  int x = voxel.x + offset;
  int words = int(WordsPerRow);
  int word = x >> 5;
  uint shift = uint(x & 31);
  uint low = wordAt(clamp(word, 0, words - 1), voxel.yz) >> shift;
  uint high = shift == 0u ? 0u : wordAt(clamp(word + 1, 0, words - 1), voxel.yz) << (32u - shift);
  uint before = x >= 0 ? 0u : x <= -32 ? FULL_WORD : (1u << uint(-x)) - 1u;
  int left = Size.x - x;
  uint behind = left >= 32 ? 0u : left <= 0 ? FULL_WORD : ~((1u << uint(left)) - 1u);
  uint inside = (low | high) & ~(before | behind);
  return inside | (before & (fill(0, voxel.yz) | Border)) |
    (behind & (fill(Size.x - 1, voxel.yz) | Border));
}

#else

uint tap(ivec3 voxel, int offset)
{
  ivec3 at = voxel;
  at[AXIS] += offset;
  int within = clamp(at[AXIS], 0, Size[AXIS] - 1);
  uint beyond = at[AXIS] == within ? 0u : Border;
  at[AXIS] = within;
  return wordAt(at.x / 32, at.yz) | beyond;
}

#endif

uint kernel(uvec3 word)
{
  ivec3 voxel = ivec3(word.x * WORD_BITS, word.yz);
  uint result = tap(voxel, Offsets[0]);
#if TAPS > 1
  result |= tap(voxel, Offsets[1]);
#endif
#if TAPS > 2
  result |= tap(voxel, Offsets[2]);
#endif
#if TAPS > 3
  result |= tap(voxel, Offsets[3]);
#endif
  return (result ^ Inverted) & slicemapRange(word.x, 0, Size.x);
}

#endif
