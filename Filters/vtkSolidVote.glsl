// The vote of the three column axes, for meshes with holes: in each voxel the axes whose column does not
// leak have a vote each, and the majority wins; a draw is decided by all three. A kernel of
// vtkSlicemapKernel.
//
// AlongX, AlongY, AlongZ  solids by parity along each axis, words, four a texel
// LeaksX, LeaksY, LeaksZ  words of one bit a column, four a texel, set where the column leaks, in the
//                         layout of vtkSolidPass::GetColumnEnds
// Size                    number of voxels along x, y and z
// WordsOfY                words per row of LeaksX, whose rows run along y

uniform usamplerBuffer AlongX;
uniform usamplerBuffer AlongY;
uniform usamplerBuffer AlongZ;
uniform usamplerBuffer LeaksX;
uniform usamplerBuffer LeaksY;
uniform usamplerBuffer LeaksZ;

uniform uint WordsOfY;
uniform ivec3 Size;

uint leakWord(usamplerBuffer leaks, uint index)
{
  return texelFetch(leaks, int(index / 4u))[index % 4u];
}

uint atLeastTwo(uint a, uint b, uint c)
{
  return (a & b) | (a & c) | (b & c);
}

uint kernel(uvec3 word)
{
  uint x = sourceWord(AlongX, word);
  uint y = sourceWord(AlongY, word);
  uint z = sourceWord(AlongZ, word);
  uint leakX = leakWord(LeaksX, word.z * WordsOfY + word.y / WORD_BITS) & slicemapBit(word.y);
  uint votesX = leakX == 0u ? FULL_WORD : 0u;
  uint votesY = ~leakWord(LeaksY, word.z * WordsPerRow + word.x);
  uint votesZ = ~leakWord(LeaksZ, word.y * WordsPerRow + word.x);

  uint inside = (x & votesX) | (y & votesY) | (z & votesZ);
  uint outside = (~x & votesX) | (~y & votesY) | (~z & votesZ);
  uint twoInside = atLeastTwo(x & votesX, y & votesY, z & votesZ);
  uint twoOutside = atLeastTwo(~x & votesX, ~y & votesY, ~z & votesZ);
  uint won = twoInside | (inside & ~outside);
  uint draw = ~twoInside & ~twoOutside & ~(inside ^ outside);
  return (won | (draw & atLeastTwo(x, y, z))) & slicemapRange(word.x, 0, Size.x);
}
