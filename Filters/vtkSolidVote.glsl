// The vote of the three column axes, for meshes with holes: in each voxel the axes whose column does not
// leak have a vote each. Where neither side leads by two votes, the mesh with caps on its holes
// decides. A kernel of vtkSlicemapKernel.
//
// AlongX, AlongY, AlongZ  solids by parity along each axis, words, four a texel
// Caps                    the caps' solid along x, likewise: AlongX and Caps together are that of the
//                         capped mesh
// LeaksX, LeaksY, LeaksZ  words of one bit a column, four a texel, set where the column leaks, in the
//                         layout of vtkSolidPass::GetColumnEnds
// Size                    number of voxels along x, y and z
// WordsOfY                words per row of LeaksX, whose rows run along y

uniform usamplerBuffer AlongX;
uniform usamplerBuffer AlongY;
uniform usamplerBuffer AlongZ;
uniform usamplerBuffer Caps;
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

  uint capped = x ^ sourceWord(Caps, word);
  uint inside = (x & votesX) | (y & votesY) | (z & votesZ);
  uint outside = (~x & votesX) | (~y & votesY) | (~z & votesZ);
  uint insideLeads = atLeastTwo(x & votesX, y & votesY, z & votesZ) & ~outside;
  uint outsideLeads = atLeastTwo(~x & votesX, ~y & votesY, ~z & votesZ) & ~inside;
  return (insideLeads | (capped & ~outsideLeads)) & slicemapRange(word.x, 0, Size.x);
}
