// Draws the triangles of a mesh into a depth buffer; a vertex has no attributes, its index is that of the
// point. Follows vtkRasterMeshFetch.glsl.
//
// Viewport  pixels of the viewport and length of the range of depths, powers of two
// Side      1 when seen from the near side, -1 from the far side, where depth runs the other way

uniform vec3 Viewport;
uniform float Side;

void main()
{
  vec3 clip = 2.0 * (fetchPoint(uint(gl_VertexID)) + 0.5) / Viewport - 1.0;
  gl_Position = vec4(clip.xy, Side * clip.z, 1.0);
}
