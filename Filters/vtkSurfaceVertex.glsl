// Draws each deferred triangle seen along the axis that its normal is closest to, dilated so that all
// columns it may touch have their centres inside: Rauwendaal 2012, section 3.2, "Conservative
// Rasterization". Six vertices a triangle and no attributes; slim triangles, whose dilated corners would
// lie far away, are drawn as a rectangle along their longest edge.
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

// Corner 0 to 5 of the two triangles that make a rectangle.
vec2 cornerOfRectangle(vec2 low, vec2 high, int corner)
{
  bool right = corner == 1 || corner == 2 || corner == 4;
  bool upper = corner == 2 || corner == 4 || corner == 5;
  return vec2(right ? high.x : low.x, upper ? high.y : low.y);
}

// A corner of the dilated rectangle around the triangle that lies along its longest edge.
vec2 cornerAlong(vec2 a, vec2 b, vec2 c, int corner)
{
  vec2 longest = b - a;
  longest = length(c - b) > length(longest) ? c - b : longest;
  longest = length(a - c) > length(longest) ? a - c : longest;
  vec2 along = length(longest) > 0.0 ? normalize(longest) : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  vec3 s = vec3(dot(a, along), dot(b, along), dot(c, along));
  vec3 t = vec3(dot(a, across), dot(b, across), dot(c, across));
  vec2 low = vec2(min(s.x, min(s.y, s.z)), min(t.x, min(t.y, t.z))) - DILATION;
  vec2 high = vec2(max(s.x, max(s.y, s.z)), max(t.x, max(t.y, t.z))) + DILATION;
  vec2 place = cornerOfRectangle(low, high, corner);
  return along * place.x + across * place.y;
}

float largestOf(vec2 v)
{
  return max(abs(v.x), abs(v.y));
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
  vec2 toCentres = vec2(toPixels) + 0.5;
  vec2 a = turned(vec3(f.A), f.Axis).xy + toCentres;
  vec2 b = turned(vec3(f.B), f.Axis).xy + toCentres;
  vec2 c = turned(vec3(f.C), f.Axis).xy + toCentres;
  vec2 ab = normalize(b - a);
  vec2 bc = normalize(c - b);
  vec2 ca = normalize(a - c);
  float sine = min(sineOf(ca, ab), min(sineOf(ab, bc), sineOf(bc, ca)));
  float reach = max(largestOf(a), max(largestOf(b), largestOf(c)));
  vec2 corners[3] = vec2[3](dilated(a, ca, ab), dilated(b, ab, bc), dilated(c, bc, ca));
  if (reach < LARGEST_COORDINATE)
  {
    position = sine > SMALLEST_SINE ? corners[min(corner, 2)] : cornerAlong(a, b, c, corner);
  }
  gl_Position = vec4(2.0 * position / vec2(WindowSize) - 1.0, 0.0, 1.0);
}
