// Fragment shader: what holds for all of 32 columns that share a word of a slicemap, one pixel a word.
//
// Columns  the columns of vtkDepthRanges.glsl, or of vtkDepthShells.glsl
// First    first column of the slicemap along x
// Count    number of columns of the slicemap along x
//
// Block  of the first voxels of the ranges, of their ends, of the ends of the shells at the near side, and
//        of their begins at the far side: the smallest, and the largest in the upper 16 bits

uniform usampler2D Columns;
uniform int First;
uniform int Count;

out uvec4 Block;

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  int begin = pixel.x * 32;
  int end = min(begin + 32, Count);
  uvec4 smallest = uvec4(0xffffu);
  uvec4 largest = uvec4(0u);
  for (int i = begin; i < end; ++i)
  {
    uvec2 column = texelFetch(Columns, ivec2(First + i, pixel.y), 0).rg;
    uvec4 ends = uvec4(column.r & 0xffffu, column.r >> 16, column.g & 0xffffu, column.g >> 16);
    smallest = min(smallest, ends);
    largest = max(largest, ends);
  }
  Block = smallest | largest << 16;
}
