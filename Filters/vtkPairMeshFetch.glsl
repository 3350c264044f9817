// Points of a vtkVoxelMesh as pairs of floats, for fragment shaders of OpenGL 3.2: the counterpart of
// vtkVoxelMeshFetch.glsl, with the same textures and 48 bits in place of 53.
//
// Follows vtkFloatPairs.glsl, and vtkVoxelMeshDisplacement.glsl where DISPLACED is defined.
//
// Coordinates are in voxels, in the order (u, v, depth), relative to the anchor of vtkRasterMeshBinding.
// RelativeFromWorld and RelativeFromWorldLow hold the three rows (a, b, c, d) of the map a * x + b * y + c * z
// + d from world coordinates, and what rounding took away from them.

uniform samplerBuffer Points;
#ifdef POINTS_ARE_DOUBLE
uniform samplerBuffer PointsLow;
#endif
uniform vec4 RelativeFromWorld[3];
uniform vec4 RelativeFromWorldLow[3];

// The parts of three coordinates.
struct PairPoint
{
  vec3 High;
  vec3 Low;
};

PairPoint fetchPairPoint(uint id)
{
  vec3 high = texelFetch(Points, int(id)).xyz;
#ifdef POINTS_ARE_DOUBLE
  vec3 low = texelFetch(PointsLow, int(id)).xyz;
#else
  vec3 low = vec3(0.0);
#endif
  vec2 world[3];
  for (int i = 0; i < 3; ++i)
  {
    world[i] = vec2(high[i], low[i]);
  }
#ifdef DISPLACED
  vec3 displacement = displacementOf(id);
  for (int i = 0; i < 3; ++i)
  {
    world[i] = add(world[i], vec2(displacement[i], 0.0));
  }
#endif
  PairPoint point;
  for (int row = 0; row < 3; ++row)
  {
    vec2 sum = vec2(RelativeFromWorld[row].w, RelativeFromWorldLow[row].w);
    for (int i = 2; i >= 0; --i)
    {
      sum = add(sum, multiply(world[i], vec2(RelativeFromWorld[row][i], RelativeFromWorldLow[row][i])));
    }
    point.High[row] = sum.x;
    point.Low[row] = sum.y;
  }
  return point;
}
