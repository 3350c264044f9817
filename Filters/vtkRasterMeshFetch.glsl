// Triangles of a vtkVoxelMesh for vertex shaders of OpenGL 3.2: the counterpart of
// vtkVoxelMeshFetch.glsl in single precision, with the same textures.
//
// Coordinates are in voxels, in the order (u, v, depth), relative to an anchor: a voxel near the grid
// whose world coordinates are AnchorHigh + AnchorLow. VoxelsFromWorld holds the three rows of the
// linear map. Follows vtkVoxelMeshDisplacement.glsl where DISPLACED is defined.

uniform usamplerBuffer Triangles;
uniform samplerBuffer Points;
#ifdef POINTS_ARE_DOUBLE
uniform samplerBuffer PointsLow;
#endif
uniform vec3 VoxelsFromWorld[3];
uniform vec3 AnchorHigh;
uniform vec3 AnchorLow;

vec3 fetchPoint(uint id)
{
  vec3 fromAnchor = texelFetch(Points, int(id)).xyz - AnchorHigh;
#ifdef POINTS_ARE_DOUBLE
  fromAnchor += texelFetch(PointsLow, int(id)).xyz - AnchorLow;
#else
  fromAnchor -= AnchorLow;
#endif
#ifdef DISPLACED
  fromAnchor += displacementOf(id);
#endif
  return vec3(dot(VoxelsFromWorld[0], fromAnchor), dot(VoxelsFromWorld[1], fromAnchor),
    dot(VoxelsFromWorld[2], fromAnchor));
}

void fetchTriangle(uint triangle, out vec3 a, out vec3 b, out vec3 c)
{
  uvec3 ids = texelFetch(Triangles, int(triangle)).xyz;
  a = fetchPoint(ids.x);
  b = fetchPoint(ids.y);
  c = fetchPoint(ids.z);
}
