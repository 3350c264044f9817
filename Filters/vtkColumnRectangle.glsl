// Rectangles of columns, two triangles each, six vertices a rectangle and no attributes.
//
// TileFirst   the column at pixel (0, 0), relative to the anchor
// TileColumns number of columns in the tile
// TileSize    size of the viewport in pixels, powers of two

uniform ivec2 TileFirst;
uniform ivec2 TileColumns;
uniform ivec2 TileSize;

// Where the vertex at hand is, for the columns whose centres are within `margin` of the bounds of three points.
vec4 cornerOfRectangle(vec2 a, vec2 b, vec2 c, float margin)
{
  vec2 low = min(a, min(b, c)) - vec2(TileFirst);
  vec2 high = max(a, max(b, c)) - vec2(TileFirst);
  vec2 first = clamp(ceil(low - margin), vec2(0.0), vec2(TileColumns));
  vec2 end = clamp(floor(high + margin) + 1.0, vec2(0.0), vec2(TileColumns));
  int corner = gl_VertexID % 6;
  bool right = corner == 1 || corner == 2 || corner == 4;
  bool upper = corner == 2 || corner == 4 || corner == 5;
  vec2 pixel = vec2(right ? end.x : first.x, upper ? end.y : first.y);
  return vec4(2.0 * pixel / vec2(TileSize) - 1.0, 0.0, 1.0);
}
