// The triangles of one dispatch, an invocation each.
//
// FirstTriangle, NumberOfTriangles  the range of triangles of the mesh
//
// The host makes rows of at most 65,535 workgroups.

layout(local_size_x = 64) in;

uniform uint FirstTriangle;
uniform uint NumberOfTriangles;

// False for the invocations at the end that have none; these get the last triangle.
bool triangleOfInvocation(out uint triangle)
{
  uint rowLength = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  uint index = gl_GlobalInvocationID.y * rowLength + gl_GlobalInvocationID.x;
  triangle = FirstTriangle + min(index, NumberOfTriangles - 1u);
  return index < NumberOfTriangles;
}
