// Fragment shader: a pair of depth buffers becomes the voxels between them, one pixel a column.
//
// NearDepth, FarDepth  the pair, as OpenGL stores depth, seen from the near and from the far side
// DepthOfBuffers       length of the range of depths in voxels
// Length               voxels of a column
//
// Range  the first voxel, and the end of the range in the upper 16 bits. Columns that are empty have
//        the largest first voxel, Length, and the smallest end, 0, so that for their neighbours they
//        are far from the near side and close to it from the far side.

uniform sampler2D NearDepth;
uniform sampler2D FarDepth;
uniform float DepthOfBuffers;
uniform int Length;

out uint Range;

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float near = texelFetch(NearDepth, pixel, 0).r * DepthOfBuffers - 0.5;
  float far = (1.0 - texelFetch(FarDepth, pixel, 0).r) * DepthOfBuffers - 0.5;
  int first = clamp(int(ceil(near)), 0, Length);
  int end = clamp(int(ceil(far)), 0, Length);
  Range = uint(first) | uint(end) << 16;
}
