// Fragment shader: what holds for all columns of a block, one pixel a block. Voxels are counted from the
// first one of the slicemap, and what lies beyond it belongs to its last or first one.
//
// PLANES, BITS  defined: of vtkDepthPlanes.glsl, of which blocks are made that are 32 columns wide;
//               with SHELLS there are shells, too
//
// Planes  those of vtkDepthPlanes.glsl
// Words   words of a row of columns
//
// Without PLANES:
//
// Ends    those of vtkDepthRanges.glsl, or of vtkDepthShells.glsl, of the whole grid
// First   the first column of the slicemap, and its first voxel
//
// Size    columns of the slicemap, and voxels of each
// Side    columns of a block on both axes
//
// Block   of the first voxels of the ranges, of their ends, of the ends of the shells at the near side, and
//         of their begins at the far side: the smallest, and the largest in the upper 16 bits

uniform ivec3 Size;
uniform ivec2 Side;

out uvec4 Block;

#ifdef PLANES

uniform usamplerBuffer Planes;
uniform int Words;

#ifdef SHELLS
const int ENDS = 4;
#else
const int ENDS = 2;
#endif

// The smallest and the largest of so many columns' numbers.
ivec2 extremesOf(uvec4 planes[PLANES], int firstPlane, int count)
{
  uvec2 left = uvec2(count >= 32 ? 0xffffffffu : (1u << uint(count)) - 1u);
  uvec2 extremes = uvec2(0u, (1u << uint(BITS)) - 1u);
  for (int bit = BITS - 1; bit >= 0; --bit)
  {
    uint plane = planes[(firstPlane + bit) / 4][(firstPlane + bit) % 4];
    uvec2 those = left & uvec2(~plane, plane);
    left = uvec2(those.x == 0u ? left.x : those.x, those.y == 0u ? left.y : those.y);
    extremes.x |= those.x == 0u ? 1u << uint(bit) : 0u;
    extremes.y ^= those.y == 0u ? 1u << uint(bit) : 0u;
  }
  return ivec2(extremes);
}

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  int end = min((pixel.y + 1) * Side.y, Size.y);
  ivec4 smallest = ivec4(Size.z);
  ivec4 largest = ivec4(0);
  for (int v = pixel.y * Side.y; v < end; ++v)
  {
    uvec4 planes[PLANES];
    for (int p = 0; p < PLANES; ++p)
    {
      planes[p] = texelFetch(Planes, (v * Words + pixel.x) * PLANES + p);
    }
    for (int i = 0; i < ENDS; ++i)
    {
      ivec2 extremes = extremesOf(planes, i * BITS, Size.x - 32 * pixel.x);
      smallest[i] = min(smallest[i], extremes.x);
      largest[i] = max(largest[i], extremes.y);
    }
  }
  Block = uvec4(smallest) | uvec4(largest) << 16;
}

#else

uniform usampler2D Ends;
uniform ivec3 First;

void main()
{
  ivec2 begin = ivec2(gl_FragCoord.xy) * Side;
  ivec2 end = min(begin + Side, Size.xy);
  ivec4 smallest = ivec4(Size.z);
  ivec4 largest = ivec4(0);
  for (int v = begin.y; v < end.y; ++v)
  {
    for (int u = begin.x; u < end.x; ++u)
    {
      uvec2 column = texelFetch(Ends, First.xy + ivec2(u, v), 0).rg;
      ivec4 ends = ivec4(column.r & 0xffffu, column.r >> 16, column.g & 0xffffu, column.g >> 16);
      ends = clamp(ends - First.z, 0, Size.z);
      smallest = min(smallest, ends);
      largest = max(largest, ends);
    }
  }
  Block = uvec4(smallest) | uvec4(largest) << 16;
}

#endif
