// A fragment flips all voxels of its column from the crossing on, if the triangle covers the column: what
// vtkSolidCrossings.glsl does with UPPER_INCLUDED, by the same rules and formulas, for OpenGL 3.2.
//
// Follows vtkFloatPairs.glsl, vtkSolidMasks.glsl and vtkPairMeshFetch.glsl.
//
// TileFirst    the column at pixel (0, 0), relative to the anchor
// FirstSlice   the slice at bit 0 of the first target, relative to the anchor
// LastSlice    the last slice of the columns, relative to FirstSlice; crossings behind all voxels
//              flip this one, which is one more than there are voxels

uniform ivec2 TileFirst;
uniform int FirstSlice;
uniform int LastSlice;

flat in uvec3 Ids;

vec2 uOf(PairPoint p)
{
  return vec2(p.High.x, p.Low.x);
}

vec2 vOf(PairPoint p)
{
  return vec2(p.High.y, p.Low.y);
}

vec2 depthOf(PairPoint p)
{
  return vec2(p.High.z, p.Low.z);
}

void sortPair(inout PairPoint low, inout PairPoint high)
{
  if (isLess(vOf(high), vOf(low)))
  {
    PairPoint swap = low;
    low = high;
    high = swap;
  }
}

// u and depth where the edge crosses row v, from the end that may lie in the row, where it is exact.
void crossEdge(PairPoint low, PairPoint high, vec2 v, out vec2 u, out vec2 depth)
{
  vec2 inverse = divide(vec2(1.0, 0.0), subtract(vOf(high), vOf(low)));
  vec2 rise = subtract(v, vOf(high));
  u = add(uOf(high), multiply(rise, multiply(subtract(uOf(high), uOf(low)), inverse)));
  depth = add(depthOf(high), multiply(rise, multiply(subtract(depthOf(high), depthOf(low)), inverse)));
}

void main()
{
  PairPoint lowest = fetchPairPoint(Ids.x);
  PairPoint middle = fetchPairPoint(Ids.y);
  PairPoint highest = fetchPairPoint(Ids.z);
  sortPair(lowest, middle);
  sortPair(lowest, highest);
  sortPair(middle, highest);

  vec2 column = floor(gl_FragCoord.xy) + vec2(TileFirst);
  vec2 u = vec2(column.x, 0.0);
  vec2 v = vec2(column.y, 0.0);
  if (!isLess(vOf(lowest), v) || isLess(vOf(highest), v))
  {
    discard;
  }
  bool isLower = !isLess(vOf(middle), v);
  vec2 along, across, depthAlong, depthAcross;
  crossEdge(lowest, highest, v, along, depthAlong);
  if (isLower)
  {
    highest = middle;
  }
  else
  {
    lowest = middle;
  }
  crossEdge(lowest, highest, v, across, depthAcross);
  if (!isLess(lesser(along, across), u) || isLess(greater(along, across), u))
  {
    discard;
  }
  vec2 gradient = divide(subtract(depthAcross, depthAlong), subtract(across, along));
  vec2 depth = add(depthAlong, multiply(subtract(u, along), gradient));
  depth = lesser(greater(depth, lesser(depthAlong, depthAcross)), greater(depthAlong, depthAcross));
  int slice = int(clamp(floorOf(depth) + 1.0 - float(FirstSlice), -1.0, float(LastSlice)));
  for (int target = 0; target < TARGETS; ++target)
  {
    Masks[target] = slicesFrom(slice, target);
  }
}
