// Draws each deferred triangle seen along the axis that its normal is closest to, dilated so that all
// columns it may touch have their centres inside: Rauwendaal 2012, section 3.2, "Conservative
// Rasterization". Six vertices a triangle and no attributes; slim triangles, whose dilated corners would
// lie far away, are drawn as the rectangle of their bounds.
//
// Follows vtkVoxelMeshFetch.glsl and vtkSurfaceFacet.glsl.
//
// storage buffer 3 as vtkSurfaceVoxels.glsl leaves it
// WindowFirst  the column at pixel (0, 0), counted from the first voxel of the box, in (u, v)
// WindowSize   of the viewport, in pixels

uniform ivec2 WindowFirst;
uniform ivec2 WindowSize;

layout(std430, binding = 3) readonly buffer Deferred
{
  uint NumberOfVertices;
  uint NumberOfInstances;
  uint FirstVertex;
  uint FirstInstance;
  uint DeferredTriangles[];
};

flat out uint Triangle;

// Half the diagonal of a voxel, and what the rasterizer's grid of 1/256 pixel may take away.
const float DILATION = 0.75;

const float SMALLEST_SINE = 0.2;

// Beyond, single precision does not tell pixels well enough.
const float LARGEST_COORDINATE = 16384.0;

float sineOf(vec2 from, vec2 to)
{
  return abs(from.x * to.y - from.y * to.x);
}

// The corner between an edge that comes along `from` and one that goes along `to`, both of length one.
vec2 dilated(vec2 corner, vec2 from, vec2 to)
{
  return corner + DILATION / sineOf(from, to) * (from - to);
}

float largestOf(vec2 v)
{
  return max(abs(v.x), abs(v.y));
}

// Corner 0 to 5 of the two triangles that make a rectangle.
vec2 cornerOfRectangle(vec2 low, vec2 high, int corner)
{
  bool right = corner == 1 || corner == 2 || corner == 4;
  bool upper = corner == 2 || corner == 4 || corner == 5;
  return vec2(right ? high.x : low.x, upper ? high.y : low.y);
}

void main()
{
  Triangle = DeferredTriangles[gl_VertexID / 6];
  int corner = gl_VertexID % 6;
  Facet f;
  facetOf(Triangle, f);
  ivec2 toPixels = f.Base.xy - turned(First, f.Axis).xy - WindowFirst;
  vec2 position =
    cornerOfRectangle(vec2(f.First.xy + toPixels), vec2(f.End.xy + toPixels), corner);

  // Columns are unit squares around integers, pixels around halves.
  vec2 a = vec2(f.A.xy) + vec2(toPixels) + 0.5;
  vec2 b = vec2(f.B.xy) + vec2(toPixels) + 0.5;
  vec2 c = vec2(f.C.xy) + vec2(toPixels) + 0.5;
  vec2 ab = normalize(b - a);
  vec2 bc = normalize(c - b);
  vec2 ca = normalize(a - c);
  float sine = min(sineOf(ca, ab), min(sineOf(ab, bc), sineOf(bc, ca)));
  float reach = max(largestOf(a), max(largestOf(b), largestOf(c)));
  if (sine > SMALLEST_SINE && reach < LARGEST_COORDINATE)
  {
    vec2 corners[3] = vec2[3](dilated(a, ca, ab), dilated(b, ab, bc), dilated(c, bc, ca));
    position = corners[min(corner, 2)];
  }
  gl_Position = vec4(2.0 * position / vec2(WindowSize) - 1.0, 0.0, 1.0);
}
