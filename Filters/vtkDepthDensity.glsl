// Kernel of vtkDepthBuffers: how much of each voxel lies between the depth buffers, four voxels a
// quad, which follow one another as in an image. It is the product over the pairs along axes of how
// much of the voxel's length lies between the two depths.
//
// HAS_X, HAS_Y, HAS_Z  defined: there is a pair along that axis
//
// NearX, FarX ...  the pair, as OpenGL stores depth, seen from the near and from the far side
// DepthOfBuffers   length of the range of depths along x, y and z
// First            the first voxel, counted from that of the grid that the pairs look at
// Size             voxels along x, y and z
//
// Values are unsigned integers, ONE for a voxel that is all inside.

const float ONE = 16777216.0;

uniform vec3 DepthOfBuffers;
uniform ivec3 First;
uniform ivec3 Size;

#ifdef HAS_X
uniform sampler2D NearX;
uniform sampler2D FarX;
#endif
#ifdef HAS_Y
uniform sampler2D NearY;
uniform sampler2D FarY;
#endif
#ifdef HAS_Z
uniform sampler2D NearZ;
uniform sampler2D FarZ;
#endif

float coverage(float nearDepth, float farDepth, float length, int depth)
{
  float near = nearDepth * length - 0.5;
  float far = (1.0 - farDepth) * length - 0.5;
  return clamp(min(far, float(depth) + 0.5) - max(near, float(depth) - 0.5), 0.0, 1.0);
}

float density(ivec3 voxel)
{
  float product = 1.0;
#ifdef HAS_X
  product *= coverage(texelFetch(NearX, voxel.yz, 0).r, texelFetch(FarX, voxel.yz, 0).r,
    DepthOfBuffers.x, voxel.x);
#endif
#ifdef HAS_Y
  product *= coverage(texelFetch(NearY, voxel.xz, 0).r, texelFetch(FarY, voxel.xz, 0).r,
    DepthOfBuffers.y, voxel.y);
#endif
#ifdef HAS_Z
  product *= coverage(texelFetch(NearZ, voxel.xy, 0).r, texelFetch(FarZ, voxel.xy, 0).r,
    DepthOfBuffers.z, voxel.z);
#endif
  return product;
}

uvec4 kernel(uint quad)
{
  uint last = uint(Size.x) * uint(Size.y) * uint(Size.z) - 1u;
  uvec4 values;
  for (uint i = 0u; i < 4u; ++i)
  {
    uint voxel = min(quad * 4u + i, last);
    uint row = voxel / uint(Size.x);
    values[i] = uint(density(First + ivec3(voxel % uint(Size.x), row % uint(Size.y),
                               row / uint(Size.y))) * ONE + 0.5);
  }
  return values;
}
