// Triangles of a vtkVoxelMesh for compute shaders, in index coordinates of the grid.
//
// Triangles   RGB32UI buffer texture, the three point ids of each triangle
// Points      RGB32F buffer texture, world coordinates rounded to float
// PointsLow   RGB32F buffer texture, what the rounding took away; with POINTS_ARE_DOUBLE only
//
// IndexFromWorld holds the three rows (a, b, c, d) of the map a * x + b * y + c * z + d from world
// coordinates to index coordinates, in the order of the axes that the including shader works in.
// All triangles at a point or an edge must see the very same numbers, hence `precise`.

layout(local_size_x = 64) in;

uniform usamplerBuffer Triangles;
uniform samplerBuffer Points;
#ifdef POINTS_ARE_DOUBLE
uniform samplerBuffer PointsLow;
#endif
uniform dvec4 IndexFromWorld[3];
uniform uint FirstTriangle;
uniform uint NumberOfTriangles;

// One invocation a triangle; the host makes rows of at most 65,535 workgroups.
uint triangleOfInvocation()
{
  uint rowLength = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  return gl_GlobalInvocationID.y * rowLength + gl_GlobalInvocationID.x;
}

dvec3 fetchPoint(uint id)
{
  precise dvec3 world = dvec3(texelFetch(Points, int(id)).xyz);
#ifdef POINTS_ARE_DOUBLE
  world += dvec3(texelFetch(PointsLow, int(id)).xyz);
#endif
  precise dvec3 index;
  for (int axis = 0; axis < 3; ++axis)
  {
    dvec4 row = IndexFromWorld[axis];
    index[axis] = row.x * world.x + row.y * world.y + row.z * world.z + row.w;
  }
  return index;
}

void fetchTriangle(uint triangle, out dvec3 a, out dvec3 b, out dvec3 c)
{
  uvec3 ids = texelFetch(Triangles, int(triangle)).xyz;
  a = fetchPoint(ids.x);
  b = fetchPoint(ids.y);
  c = fetchPoint(ids.z);
}
