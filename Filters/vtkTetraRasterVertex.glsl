// Brings the corners of triangles to a geometry shader, three vertices a triangle and no attributes.
//
// Follows vtkRasterMeshFetch.glsl.

flat out vec3 Corner;
flat out int Instance;

void main()
{
  uvec3 ids = texelFetch(Triangles, gl_VertexID / 3).xyz;
  Corner = fetchPoint(ids[gl_VertexID % 3]);
  Instance = gl_InstanceID;
  gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
