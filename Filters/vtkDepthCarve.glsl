// Kernel of vtkDepthBuffers: takes away the voxels that are not between a pair of depth buffers which
// looks at the grid from any direction.
//
// The centre of a voxel falls between pixels. It stays when it is between the depths nearest to
// either side of the four pixels around it, so that no voxel is lost to a slope, and a margin more,
// since a ridge may stand between the pixels: half a pixel away from
// one of them at most, it may rise by two pixels a pixel.
//
// Voxels               the slicemap
// NearDepth, FarDepth  the pair, as OpenGL stores depth, seen from the near and from the far side
// DepthOfBuffers       length of the range of depths
// Pixels               of the buffers, on both axes
// Origin               the first voxel in view coordinates
// Steps                from a voxel to the next along x, y and z in view coordinates
// Size                 voxels of the slicemap
// QuadsPerRow          quads of a row of it

uniform usamplerBuffer Voxels;
uniform sampler2D NearDepth;
uniform sampler2D FarDepth;
uniform float DepthOfBuffers;
uniform ivec2 Pixels;
uniform vec3 Origin;
uniform vec3 Steps[3];
uniform ivec3 Size;
uniform uint QuadsPerRow;

const float MARGIN = 1.0;

bool isBetween(vec3 place)
{
  ivec2 corner = ivec2(floor(place.xy));
  float nearest = 1.0;
  float farthest = 1.0;
  for (int i = 0; i < 4; ++i)
  {
    ivec2 pixel = clamp(corner + ivec2(i & 1, i >> 1), ivec2(0), Pixels - 1);
    nearest = min(nearest, texelFetch(NearDepth, pixel, 0).r);
    farthest = min(farthest, texelFetch(FarDepth, pixel, 0).r);
  }
  return place.z >= nearest * DepthOfBuffers - 0.5 - MARGIN &&
    place.z < (1.0 - farthest) * DepthOfBuffers - 0.5 + MARGIN;
}

uvec4 kernel(uint quad)
{
  uvec4 bits = sourceQuad(Voxels, quad);
  uint row = quad / QuadsPerRow;
  int x = int(quad % QuadsPerRow) * 128;
  vec3 place = Origin + float(row % uint(Size.y)) * Steps[1] + float(row / uint(Size.y)) * Steps[2];
  int count = bits == uvec4(0u) ? 0 : min(Size.x - x, 128);
  for (int i = 0; i < count; ++i)
  {
    uint bit = 1u << uint(i & 31);
    if ((bits[i >> 5] & bit) != 0u && !isBetween(place + float(x + i) * Steps[0]))
    {
      bits[i >> 5] &= ~bit;
    }
  }
  return bits;
}
