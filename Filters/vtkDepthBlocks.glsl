// Fragment shader: what holds for all columns of a block, one pixel a block. Voxels are counted from the
// first one of the slicemap, and what lies beyond it belongs to its last or first one.
//
// Ends   those of vtkDepthRanges.glsl, or of vtkDepthShells.glsl, of the whole grid
// First  the first column of the slicemap, and its first voxel
// Size   columns of the slicemap, and voxels of each
// Side   columns of a block on both axes
//
// Block  of the first voxels of the ranges, of their ends, of the ends of the shells at the near side, and
//        of their begins at the far side: the smallest, and the largest in the upper 16 bits

uniform usampler2D Ends;
uniform ivec3 First;
uniform ivec3 Size;
uniform ivec2 Side;

out uvec4 Block;

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
