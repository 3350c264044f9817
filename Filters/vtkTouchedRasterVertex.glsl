// Draws for each triangle the rectangle of columns that it may touch, six vertices a triangle and no
// attributes.
//
// Follows vtkRasterMeshFetch.glsl.
//
// TileFirst   the column at pixel (0, 0), relative to the anchor
// TileColumns number of columns in the tile
// TileSize    size of the viewport in pixels, powers of two
// HalfWidth   half the width of a voxel, with a margin

uniform ivec2 TileFirst;
uniform ivec2 TileColumns;
uniform ivec2 TileSize;
uniform float HalfWidth;

flat out vec3 A;
flat out vec3 B;
flat out vec3 C;

void main()
{
  fetchTriangle(uint(gl_VertexID / 6), A, B, C);
  vec2 low = min(A.xy, min(B.xy, C.xy)) - vec2(TileFirst);
  vec2 high = max(A.xy, max(B.xy, C.xy)) - vec2(TileFirst);
  vec2 first = clamp(ceil(low - HalfWidth), vec2(0.0), vec2(TileColumns));
  vec2 end = clamp(floor(high + HalfWidth) + 1.0, vec2(0.0), vec2(TileColumns));
  int corner = gl_VertexID % 6;
  bool right = corner == 1 || corner == 2 || corner == 4;
  bool upper = corner == 2 || corner == 4 || corner == 5;
  vec2 pixel = vec2(right ? end.x : first.x, upper ? end.y : first.y);
  gl_Position = vec4(2.0 * pixel / vec2(TileSize) - 1.0, 0.0, 1.0);
}
