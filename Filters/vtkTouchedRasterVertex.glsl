// Draws for each triangle the rectangle of columns that it may touch.
//
// Follows vtkRasterMeshFetch.glsl and vtkColumnRectangle.glsl.
//
// HalfWidth   half the width of a voxel, with a margin

uniform float HalfWidth;

flat out vec3 A;
flat out vec3 B;
flat out vec3 C;

void main()
{
  fetchTriangle(uint(gl_VertexID / 6), A, B, C);
  gl_Position = cornerOfRectangle(A.xy, B.xy, C.xy, HalfWidth);
}
