// Draws for each triangle a rectangle that holds the columns it covers; the fragments find out which ones these
// are.
//
// Follows vtkRasterMeshFetch.glsl and vtkColumnRectangle.glsl.
//
// Margin      how far coordinates in single precision may be off

uniform float Margin;

flat out uvec3 Ids;

void main()
{
  uint triangle = uint(gl_VertexID / 6);
  vec3 a, b, c;
  fetchTriangle(triangle, a, b, c);
  Ids = texelFetch(Triangles, int(triangle)).xyz;
  gl_Position = cornerOfRectangle(a.xy, b.xy, c.xy, Margin);
}
