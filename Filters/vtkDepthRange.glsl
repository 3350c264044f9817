// The voxels between a pair of depth buffers; included where ranges of columns are made.
//
// NearDepth, FarDepth  the pair, as OpenGL stores depth, seen from the near and from the far side
// DepthOfBuffers       length of the range of depths in voxels
// Length               voxels of a column

uniform sampler2D NearDepth;
uniform sampler2D FarDepth;
uniform float DepthOfBuffers;
uniform int Length;

// The first voxel of a column, and the end of its range in the upper 16 bits. Columns that are empty
// have the largest first voxel, Length, and the smallest end, 0, so that for their neighbours they
// are far from the near side and close to it from the far side.
uint rangeOf(ivec2 column)
{
  float near = texelFetch(NearDepth, column, 0).r * DepthOfBuffers - 0.5;
  float far = (1.0 - texelFetch(FarDepth, column, 0).r) * DepthOfBuffers - 0.5;
  int first = clamp(int(ceil(near)), 0, Length);
  int end = clamp(int(ceil(far)), 0, Length);
  return uint(first) | uint(end) << 16;
}
