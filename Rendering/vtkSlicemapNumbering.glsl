// Numbers the set voxels of a slicemap in the order of their words and bits.
//
// Follows vtkSlicemapLayout.glsl.
//
// Quads  RGBA32UI buffer texture over the words, NumberOfQuads texels
//
// COUNT    defined: an invocation counts the bits of a block of BLOCK_QUADS texels;
//          storage buffer 0 takes the counts, one a block
// OFFSETS  defined: storage buffer 0 holds the number of the first voxel of each block;
//          storage buffer 1 takes that of each texel
// INDICES  defined: an invocation a texel; storage buffer 1 holds the number of the first voxel of
// each
//          texel, and storage buffer 0 takes the voxels' indices x + Size.x * (y + Size.y * z) by
//          number

layout(local_size_x = 64) in;

const uint BLOCK_QUADS = 64u;

uniform usamplerBuffer Quads;
uniform uint NumberOfQuads;

layout(std430, binding = 0) buffer Numbers
{
  uint Values[];
};

#if defined(OFFSETS) || defined(INDICES)
layout(std430, binding = 1) buffer QuadOffsets
{
  uint Offsets[];
};
#endif

uint bitsOf(uvec4 quad)
{
  ivec4 bits = bitCount(quad);
  return uint(bits.x + bits.y + bits.z + bits.w);
}

uint invocation()
{
  return gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x +
    gl_GlobalInvocationID.x;
}

#if defined(INDICES)

uniform uint QuadsPerRow;
uniform ivec3 Size;

void main()
{
  uint quad = invocation();
  if (quad >= NumberOfQuads)
  {
    return;
  }
  uvec4 words = texelFetch(Quads, int(quad));
  uint row = quad / QuadsPerRow;
  uint x = (quad % QuadsPerRow) * 4u * WORD_BITS;
  uint next = Offsets[quad];
  for (uint i = 0u; i < 4u; ++i)
  {
    for (uint rest = words[i]; rest != 0u; rest &= rest - 1u)
    {
      Values[next++] = row * uint(Size.x) + x + i * WORD_BITS + uint(findLSB(rest));
    }
  }
}

#else

void main()
{
  uint block = invocation();
  uint begin = block * BLOCK_QUADS;
  uint end = min(begin + BLOCK_QUADS, NumberOfQuads);
  if (begin >= NumberOfQuads)
  {
    return;
  }
#if defined(OFFSETS)
  uint next = Values[block];
  for (uint quad = begin; quad < end; ++quad)
  {
    Offsets[quad] = next;
    next += bitsOf(texelFetch(Quads, int(quad)));
  }
#else
  uint count = 0u;
  for (uint quad = begin; quad < end; ++quad)
  {
    count += bitsOf(texelFetch(Quads, int(quad)));
  }
  Values[block] = count;
#endif
}

#endif
