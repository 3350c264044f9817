// Fragment shader: which voxels of each column belong to the surface. It reaches from both sides of
// the column so far inwards that nothing shines through between a column and its neighbours.
//
// NEIGHBOURS  4 or 8
//
// Ranges  those of vtkDepthRanges.glsl
// Size    columns along u and v, and voxels of each
//
// Column  the column's range, and its shell: the end of the surface at the near side, and in the upper 16
//         bits its begin at the far side

uniform usampler2D Ranges;
uniform ivec3 Size;

out uvec2 Column;

// Beyond the buffer there is nothing.
ivec2 rangeAt(ivec2 pixel)
{
  ivec2 within = clamp(pixel, ivec2(0), Size.xy - 1);
  uint range = texelFetch(Ranges, within, 0).r;
  return pixel == within ? ivec2(range & 0xffffu, range >> 16) : ivec2(Size.z, 0);
}

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 own = rangeAt(pixel);
  // There is one voxel of surface at least.
  int end = own.x + 1;
  int begin = own.y - 1;
  for (int dv = -1; dv <= 1; ++dv)
  {
    for (int du = -1; du <= 1; ++du)
    {
#if NEIGHBOURS == 4
      if (du * dv != 0)
      {
        continue;
      }
#endif
      ivec2 other = rangeAt(pixel + ivec2(du, dv));
      end = max(end, other.x);
      begin = min(begin, other.y);
    }
  }
  Column = uvec2(texelFetch(Ranges, pixel, 0).r,
    uint(clamp(end, 0, Size.z)) | uint(clamp(begin, 0, Size.z)) << 16);
}
