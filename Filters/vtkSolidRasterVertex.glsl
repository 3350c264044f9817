// Draws the triangles of a mesh, seen along the columns, three vertices a triangle and no attributes.
//
// Follows vtkRasterMeshFetch.glsl.
//
// TileFirst   the column at pixel (0, 0), relative to the anchor
// TileSize    size of the viewport in pixels, powers of two
//
// Vertices are snapped to 1/256 of a voxel, which rasterization does anyway; done here, the snapped
// places are the same for every tile and on every GPU: all numbers from there on are exact. Depth is
// not OpenGL's business, since nothing may be clipped by it; it goes along in the three points, which
// are the snapped ones, so that fragments lie on the triangle that they interpolate.

uniform ivec2 TileFirst;
uniform ivec2 TileSize;

flat out vec3 Lowest;
flat out vec3 Middle;
flat out vec3 Highest;

const float SUBPIXELS = 256.0;

void sortPair(inout vec3 low, inout vec3 high)
{
  if (high.y < low.y)
  {
    vec3 swap = low;
    low = high;
    high = swap;
  }
}

void main()
{
  vec3 points[3];
  fetchTriangle(uint(gl_VertexID / 3), points[0], points[1], points[2]);
  for (int i = 0; i < 3; ++i)
  {
    points[i].xy = floor(points[i].xy * SUBPIXELS + 0.5) / SUBPIXELS;
  }
  vec2 pixel = points[gl_VertexID % 3].xy - vec2(TileFirst) + 0.5;
  gl_Position = vec4(2.0 * pixel / vec2(TileSize) - 1.0, 0.0, 1.0);

  Lowest = points[0];
  Middle = points[1];
  Highest = points[2];
  sortPair(Lowest, Middle);
  sortPair(Lowest, Highest);
  sortPair(Middle, Highest);
}
