// Kernel of vtkDepthBuffers: the ranges of 32 columns of a row as planes of bits, so that all of them
// are compared with a voxel at once. Plane k holds bit k of the columns' first voxels, a bit a column;
// BITS planes later come those of the ends, and with SHELLS then the ends of the shell at the near side,
// and its begins at the far side. Voxels are counted from the first one of the slicemap, and what lies
// beyond it belongs to its last or first one; columns past the end of the row are empty.
//
// SHELLS  defined: there are shells, too
// BITS    of a number of voxels along the columns, even
// PLANES  quads of planes, which lie one after the other
//
// The ranges are those of vtkDepthRange.glsl, which it follows, or with SHELLS:
//
// Ends   those of vtkDepthShells.glsl, of the whole grid
//
// First  the first column of the slicemap, and its first voxel
// Size   columns of the slicemap, and voxels of each
// Words  words of a row of columns

#ifdef SHELLS
uniform usampler2D Ends;
#endif
uniform ivec3 First;
uniform ivec3 Size;
uniform uint Words;

const int PLANES_OF_RANGE = BITS / 2;

uvec4 bitsOf(uint range, int plane)
{
  ivec2 ends = clamp(ivec2(range & 0xffffu, range >> 16) - First.z, ivec2(0), ivec2(Size.z));
  uint both = uint(ends.x) | uint(ends.y) << uint(BITS);
  return uvec4(both) >> (uvec4(0u, 1u, 2u, 3u) + 4u * uint(plane)) & 1u;
}

void kernel(uint group, out uvec4 planes[PLANES])
{
  for (int p = 0; p < PLANES; ++p)
  {
    planes[p] = uvec4(0u);
  }
  ivec2 place = ivec2(int(group % Words) * 32, int(group / Words));
  int count = min(32, Size.x - place.x);
  for (int i = 0; i < count; ++i)
  {
    ivec2 column = First.xy + place + ivec2(i, 0);
#ifdef SHELLS
    uvec2 ends = texelFetch(Ends, column, 0).rg;
#else
    uvec2 ends = uvec2(rangeOf(column), 0u);
#endif
    for (int p = 0; p < PLANES_OF_RANGE; ++p)
    {
      planes[p] |= bitsOf(ends.r, p) << uint(i);
#ifdef SHELLS
      planes[p + PLANES_OF_RANGE] |= bitsOf(ends.g, p) << uint(i);
#endif
    }
  }
}
