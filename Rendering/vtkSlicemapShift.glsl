// Kernel of vtkSlicemap::CopyVoxels and Shift. See vtkSlicemapKernel.h.
//
// Source             the words of a slicemap, four a texel
// SourceSize         its number of voxels along x, y and z
// SourceWordsPerRow  its number of words of a row
// Size               number of voxels of the result
// Offset             whole voxels by which the set ones are moved

uniform usamplerBuffer Source;
uniform ivec3 SourceSize;
uniform uint SourceWordsPerRow;
uniform ivec3 Size;
uniform ivec3 Offset;

uint wordOrNothing(ivec3 word)
{
  bool inside = word.x >= 0 && word.x < int(SourceWordsPerRow) && word.y >= 0 &&
    word.y < SourceSize.y && word.z >= 0 && word.z < SourceSize.z;
  int index = (word.z * SourceSize.y + word.y) * int(SourceWordsPerRow) + word.x;
  return inside ? texelFetch(Source, index / 4)[index % 4] : 0u;
}

// The 32 voxels from (x, y, z) on, where x may be any number.
uint bitsFrom(ivec3 voxel)
{
  int word = voxel.x >> 5;
  int shift = voxel.x & 31;
  uint low = wordOrNothing(ivec3(word, voxel.yz)) >> uint(shift);
  uint high = shift == 0 ? 0u : wordOrNothing(ivec3(word + 1, voxel.yz)) << uint(32 - shift);
  return low | high;
}

uint kernel(uvec3 word)
{
  return bitsFrom(ivec3(word.x * WORD_BITS, word.yz) - Offset) & slicemapRange(word.x, 0, Size.x);
}
