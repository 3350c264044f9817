// Draws for each triangle a rectangle that holds the columns it covers, six vertices a triangle and no
// attributes; the fragments find out which ones these are.
//
// Follows vtkRasterMeshFetch.glsl.
//
// TileFirst   the column at pixel (0, 0), relative to the anchor
// TileColumns number of columns in the tile
// TileSize    size of the viewport in pixels, powers of two
// Margin      how far coordinates in single precision may be off

uniform ivec2 TileFirst;
uniform ivec2 TileColumns;
uniform ivec2 TileSize;
uniform float Margin;

flat out uvec3 Ids;

void main()
{
  uint triangle = uint(gl_VertexID / 6);
  vec3 a, b, c;
  fetchTriangle(triangle, a, b, c);
  Ids = texelFetch(Triangles, int(triangle)).xyz;
  vec2 low = min(a.xy, min(b.xy, c.xy)) - vec2(TileFirst);
  vec2 high = max(a.xy, max(b.xy, c.xy)) - vec2(TileFirst);
  vec2 first = clamp(ceil(low - Margin), vec2(0.0), vec2(TileColumns));
  vec2 end = clamp(floor(high + Margin) + 1.0, vec2(0.0), vec2(TileColumns));
  int corner = gl_VertexID % 6;
  bool right = corner == 1 || corner == 2 || corner == 4;
  bool upper = corner == 2 || corner == 4 || corner == 5;
  vec2 pixel = vec2(right ? end.x : first.x, upper ? end.y : first.y);
  gl_Position = vec4(2.0 * pixel / vec2(TileSize) - 1.0, 0.0, 1.0);
}
