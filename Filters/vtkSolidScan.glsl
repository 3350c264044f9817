// From crossings to solid: along every column each voxel becomes the parity of the toggled bits up
// to and including its own (the running XOR of Eisemann & Decoret 2008, section 5.2).
//
// Follows vtkSlicemapLayout.glsl.
//
// COLUMN_AXIS  0, 1 or 2: the columns run along x, y or z.
//
// Quads            RGBA32UI buffer texture over the buffer that holds storage buffer 0, four words a
//                  texel; the slab begins at texel FirstQuad
// storage buffer 0 the words of the slab, four a uvec4
// storage buffer 1 one bit a column as vtkSolidCrossings.glsl leaves it; replaced by the parity of
//                  all crossings of the column, which is zero for a closed mesh
// storage buffer 2 (columns along y and z) the parity behind what was scanned of the columns before;
//                  replaced by that behind what is scanned now. Zero at first.
//
// Size is the slab's number of voxels along x, y and z. Of each column along y and z, Steps voxels from
// FirstStep on are scanned: renderers in software end loops after 65,535 turns. Ends is true when these are
// the last ones.

layout(local_size_x = 64) in;

uniform usamplerBuffer Quads;
uniform uint FirstQuad;
uniform ivec3 Size;
uniform uint QuadsPerRow;
uniform uint EndWordsPerRow;
uniform int FirstStep;
uniform int Steps;
uniform bool Ends;

layout(std430, binding = 0) buffer Slicemap
{
  uvec4 Words[];
};
#if COLUMN_AXIS == 0
layout(std430, binding = 1) buffer ColumnEnds
{
  uint Behind[];
};
#else
layout(std430, binding = 1) buffer ColumnEnds
{
  uvec4 Behind[];
};
#endif
#if COLUMN_AXIS != 0
layout(std430, binding = 2) buffer ColumnCarries
{
  uvec4 Carries[];
};
#endif

uint invocation()
{
  return gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
}

#if COLUMN_AXIS == 0

// All ones where the last bit of the word is set.
uint carryOf(uint word)
{
  return uint(int(word) >> 31);
}

void main()
{
  uint row = invocation();
  if (row >= uint(Size.y * Size.z))
  {
    return;
  }
  uint carry = 0u;
  uint texel = FirstQuad + row * QuadsPerRow;
  for (uint quad = 0u; quad < QuadsPerRow; ++quad, ++texel)
  {
    uvec4 toggles = texelFetch(Quads, int(texel));
    uvec4 bits = toggles;
    bits ^= bits << 1;
    bits ^= bits << 2;
    bits ^= bits << 4;
    bits ^= bits << 8;
    bits ^= bits << 16;
    bits.x ^= carry;
    bits.y ^= carryOf(bits.x);
    bits.z ^= carryOf(bits.y);
    bits.w ^= carryOf(bits.z);
    carry = carryOf(bits.w);
    if (carry != 0u && quad + 1u == QuadsPerRow)
    {
      for (uint i = 0u; i < 4u; ++i)
      {
        bits[i] &= slicemapRange(quad * 4u + i, 0, Size.x);
      }
    }
    if (bits != toggles)
    {
      Words[texel - FirstQuad] = bits;
    }
  }
  if (carry != 0u)
  {
    uvec3 column = uvec3(row % uint(Size.y), row / uint(Size.y), 0u);
    atomicXor(Behind[slicemapWord(column, EndWordsPerRow, 0u)], slicemapBit(column.x));
  }
}

#else

// The columns of one uvec4 side by side, a step along the column for each turn of the loop.
void main()
{
  uint column = invocation();
#if COLUMN_AXIS == 1
  uint rows = uint(Size.z);
  uint step = QuadsPerRow;
  uint texel = FirstQuad + (column / QuadsPerRow * uint(Size.y)) * QuadsPerRow + column % QuadsPerRow;
#else
  uint rows = uint(Size.y);
  uint step = QuadsPerRow * uint(Size.y);
  uint texel = FirstQuad + column;
#endif
  texel += uint(FirstStep) * step;
  if (column >= rows * QuadsPerRow)
  {
    return;
  }
  uvec4 carry = Carries[column];
  for (int i = 0; i < Steps; ++i, texel += step)
  {
    uvec4 toggles = texelFetch(Quads, int(texel));
    if (carry != uvec4(0u))
    {
      Words[texel - FirstQuad] = toggles ^ carry;
    }
    carry ^= toggles;
  }
  Carries[column] = carry;
  if (Ends)
  {
    Behind[column] ^= carry;
  }
}

#endif
