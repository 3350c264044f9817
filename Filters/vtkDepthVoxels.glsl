// Kernel of vtkDepthBuffers: the voxels that lie between all pairs of depth buffers.
//
// HAS_X, HAS_Y, HAS_Z  defined: there is a pair along that axis
// SHELLS               defined: only the voxels that a pair sees on the surface
//
// RangesX, RangesY, RangesZ  those of vtkDepthRanges.glsl, of the whole grid
// ShellsX, ShellsY, ShellsZ  those of vtkDepthShells.glsl
// First                      the first voxel of the slicemap, counted from that of the whole grid
// Size                       voxels of the slicemap
// QuadsPerRow                quads of a row of it

uniform ivec3 First;
uniform ivec3 Size;
uniform uint QuadsPerRow;

#ifdef HAS_X
uniform usampler2D RangesX;
#ifdef SHELLS
uniform usampler2D ShellsX;
#endif
#endif
#ifdef HAS_Y
uniform usampler2D RangesY;
#ifdef SHELLS
uniform usampler2D ShellsY;
#endif
#endif
#ifdef HAS_Z
uniform usampler2D RangesZ;
#ifdef SHELLS
uniform usampler2D ShellsZ;
#endif
#endif

bool isBetween(uint range, int depth)
{
  return uint(depth) >= (range & 0xffffu) && uint(depth) < range >> 16;
}

bool isOutOf(uint range, int depth)
{
  return uint(depth) < (range & 0xffffu) || uint(depth) >= range >> 16;
}

uvec4 kernel(uint quad)
{
  uint row = quad / QuadsPerRow;
  ivec3 place =
    ivec3(int(quad % QuadsPerRow) * 128, int(row % uint(Size.y)), int(row / uint(Size.y)));
  int left = min(Size.x - place.x, 128);
  place += First;
  int begin = 0;
  int end = left;
#ifdef HAS_X
  uint rangeX = texelFetch(RangesX, place.yz, 0).r;
  begin = max(begin, int(rangeX & 0xffffu) - place.x);
  end = min(end, int(rangeX >> 16) - place.x);
#ifdef SHELLS
  uint shellX = texelFetch(ShellsX, place.yz, 0).r;
#endif
#endif
  uvec4 bits = uvec4(0u);
  for (int i = begin; i < end; ++i)
  {
    ivec3 voxel = place + ivec3(i, 0, 0);
    bool isSet = true;
#ifdef HAS_Y
    isSet = isSet && isBetween(texelFetch(RangesY, voxel.xz, 0).r, voxel.y);
#endif
#ifdef HAS_Z
    isSet = isSet && isBetween(texelFetch(RangesZ, voxel.xy, 0).r, voxel.z);
#endif
#ifdef SHELLS
    bool isSeen = false;
#ifdef HAS_X
    isSeen = isOutOf(shellX, voxel.x);
#endif
#ifdef HAS_Y
    isSeen = isSeen || isOutOf(texelFetch(ShellsY, voxel.xz, 0).r, voxel.y);
#endif
#ifdef HAS_Z
    isSeen = isSeen || isOutOf(texelFetch(ShellsZ, voxel.xy, 0).r, voxel.z);
#endif
    isSet = isSet && isSeen;
#endif
    bits[i >> 5] |= isSet ? 1u << uint(i & 31) : 0u;
  }
  return bits;
}
