// Bit layout of a slicemap; every shader that touches the words includes this file.
//
// A slicemap is an array of 32-bit words. Voxel (x, y, z), counted from the first voxel of the
// grid, is bit x % 32, least significant first, of word (z * rowsPerSlice + y) * wordsPerRow + x / 32.
// wordsPerRow is a multiple of 4; the bits past the end of a row are zero.

const uint WORD_BITS = 32u;
const uint FULL_WORD = 0xffffffffu;

uint slicemapWord(uvec3 voxel, uint wordsPerRow, uint rowsPerSlice)
{
  return (voxel.z * rowsPerSlice + voxel.y) * wordsPerRow + voxel.x / WORD_BITS;
}

uint slicemapBit(uint x)
{
  return 1u << (x % WORD_BITS);
}

// The bits of word `word` of a row that belong to voxels first <= x < end.
uint slicemapRange(uint word, int first, int end)
{
  int low = clamp(first - int(word * WORD_BITS), 0, 32);
  int high = clamp(end - int(word * WORD_BITS), 0, 32);
  uint belowHigh = high == 32 ? FULL_WORD : (1u << uint(high)) - 1u;
  uint belowLow = low == 32 ? FULL_WORD : (1u << uint(low)) - 1u;
  return belowHigh & ~belowLow;
}
