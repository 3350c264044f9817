// From crossings to solid: along every column each voxel becomes the parity of the toggled bits up
// to and including its own (the running XOR of Eisemann & Decoret 2008, section 5.2).
//
// Follows vtkSlicemapLayout.glsl.
//
// COLUMN_AXIS  0, 1 or 2: the columns run along x, y or z.
// GRIDS        defined when storage buffer 0 holds several grids of Size voxels, one behind the other along z, of
//              which NumberOfGrids are scanned from FirstGrid on, in one go. Nothing is kept then of what lies
//              behind the columns: storage buffers 1 and 2 are left out.
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
#ifdef GRIDS
uniform uint FirstGrid;
uniform uint NumberOfGrids;
#endif

layout(std430, binding = 0) buffer Slicemap
{
  uvec4 Words[];
};
#ifndef GRIDS
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
layout(std430, binding = 2) buffer ColumnCarries
{
  uvec4 Carries[];
};
#endif
#endif

// What an invocation scans, each grid having so many: false for those at the end that scan nothing.
bool columnOfInvocation(uint columnsPerGrid, out uint column)
{
  uint index = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
#ifdef GRIDS
  column = FirstGrid * columnsPerGrid + index;
  return index < NumberOfGrids * columnsPerGrid;
#else
  column = index;
  return index < columnsPerGrid;
#endif
}

#if COLUMN_AXIS == 0

// All ones where the last bit of the word is set.
uint carryOf(uint word)
{
  return uint(int(word) >> 31);
}

void main()
{
  uint row;
  if (!columnOfInvocation(uint(Size.y * Size.z), row))
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
#ifndef GRIDS
  if (carry != 0u)
  {
    uvec3 column = uvec3(row % uint(Size.y), row / uint(Size.y), 0u);
    atomicXor(Behind[slicemapWord(column, EndWordsPerRow, 0u)], slicemapBit(column.x));
  }
#endif
}

#else

// The columns of one uvec4 side by side, a step along the column for each turn of the loop.
void main()
{
#if COLUMN_AXIS == 1
  uint step = QuadsPerRow;
  uint columnsPerGrid = QuadsPerRow * uint(Size.z);
#else
  uint step = QuadsPerRow * uint(Size.y);
  uint columnsPerGrid = step;
#endif
  uint column;
  if (!columnOfInvocation(columnsPerGrid, column))
  {
    return;
  }
#if COLUMN_AXIS == 1
  uint texel = column / QuadsPerRow * uint(Size.y) * QuadsPerRow + column % QuadsPerRow;
#else
  uint texel = column / columnsPerGrid * uint(Size.z) * step + column % columnsPerGrid;
#endif
  texel += FirstQuad + uint(FirstStep) * step;
#ifdef GRIDS
  uvec4 carry = uvec4(0u);
#else
  uvec4 carry = Carries[column];
#endif
  for (int i = 0; i < Steps; ++i, texel += step)
  {
    uvec4 toggles = texelFetch(Quads, int(texel));
    if (carry != uvec4(0u))
    {
      Words[texel - FirstQuad] = toggles ^ carry;
    }
    carry ^= toggles;
  }
#ifndef GRIDS
  Carries[column] = carry;
  if (Ends)
  {
    Behind[column] ^= carry;
  }
#endif
}

#endif
