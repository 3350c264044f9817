// A fragment flips all voxels of its column from the crossing on: Eisemann & Decoret 2008, section 5.2.
//
// Follows vtkSolidMasks.glsl, for parity by the logic operation XOR. With WINDING the render targets
// are eight of RGBA16F, one slice a channel, and 1 or -1 is added to the slices.
//
// TileFirst    the column at pixel (0, 0), relative to the anchor
// FirstSlice   the slice at bit 0 of the first target, relative to the anchor
// LastSlice    the last slice of the columns, relative to FirstSlice; crossings behind all voxels
//              flip this one, which is one more than there are voxels
//
// The depth is interpolated between the two edges of the triangle in the row of the column, so that it is
// right even where the triangle is seen edge-on.

uniform ivec2 TileFirst;
uniform int FirstSlice;
uniform int LastSlice;

flat in vec3 Lowest;
flat in vec3 Middle;
flat in vec3 Highest;

#ifdef WINDING
out vec4 Winding[8];
#endif

vec3 pointOnEdge(vec3 low, vec3 high, float v)
{
  float d = high.y - low.y;
  return d > 0.0 ? mix(low, high, clamp((v - low.y) / d, 0.0, 1.0)) : low;
}

void main()
{
  vec2 column = floor(gl_FragCoord.xy) + vec2(TileFirst);
  float v = clamp(column.y, Lowest.y, Highest.y);
  vec3 along = pointOnEdge(Lowest, Highest, v);
  vec3 across = v < Middle.y ? pointOnEdge(Lowest, Middle, v) : pointOnEdge(Middle, Highest, v);
  float width = across.x - along.x;
  float share = width != 0.0 ? clamp((column.x - along.x) / width, 0.0, 1.0) : 0.0;
  float depth = mix(along.z, across.z, share);
  int slice = int(clamp(ceil(depth) - float(FirstSlice), -1.0, float(LastSlice)));
#ifdef WINDING
  float direction = gl_FrontFacing ? 1.0 : -1.0;
  for (int target = 0; target < 8; ++target)
  {
    vec4 slices = vec4(4 * target) + vec4(0.0, 1.0, 2.0, 3.0);
    Winding[target] = direction * step(vec4(float(slice)), slices);
  }
#else
  for (int target = 0; target < TARGETS; ++target)
  {
    Masks[target] = slicesFrom(slice, target);
  }
#endif
}
