// What becomes of the voxels that triangles overlap: values of the triangles are combined there. The values
// are those at the point of the triangle nearest to the voxel's centre: Rauwendaal 2012, section 3.5, within
// the triangle. All sums are of integers, so that the order of the triangles does not matter.
//
// Follows vtkSurfaceWords.glsl.
//
// COMPONENTS   of a value
// COMBINATION  AVERAGE, MINIMUM, MAXIMUM, FIND_FIRST (of the triangles by their order), STORE_FIRST
// OF_POINTS    defined when Values are those of the points; else of the triangles
// IMAGE        defined when Values are two texture coordinates, and the value is that of the image there
// Values to be averaged lie between 0 and 1.
//
// Quads    RGBA32UI buffer texture over the words of the slicemap
// Offsets  R32UI buffer texture, the number of the first set voxel of each texel
// Values   R32F buffer texture, the components of a value side by side
// storage buffer 0  AVERAGE: for each number and component two words, the sum of value * ONE, low word first;
//                   else one word, for the minimum and maximum of order-preserving bits, for the first of
//                   the value itself
// storage buffer 1  for each number AVERAGE: how many triangles; FIND_FIRST, STORE_FIRST: the first triangle

#define AVERAGE 0
#define MINIMUM 1
#define MAXIMUM 2
#define FIND_FIRST 3
#define STORE_FIRST 4

const float ONE = 8388608.0;

uniform usamplerBuffer Quads;
uniform usamplerBuffer Offsets;
uniform samplerBuffer Values;
#ifdef IMAGE
uniform sampler2D Image;
#endif

layout(std430, binding = 0) buffer Results
{
  uint Combined[];
};
layout(std430, binding = 1) buffer Triangulation
{
  uint TrianglesOf[];
};

uint numberOf(Place place)
{
  uint quad = place.Word / 4u;
  uint wordOfQuad = place.Word % 4u;
  uvec4 words = texelFetch(Quads, int(quad));
  uint number = texelFetch(Offsets, int(quad)).x;
  for (uint i = 0u; i < wordOfQuad; ++i)
  {
    number += uint(bitCount(words[i]));
  }
  return number + uint(bitCount(words[wordOfQuad] & (place.Bit - 1u)));
}

float squareOf(vec3 v)
{
  return dot(v, v);
}

// How far along the segment from a to b the nearest point to the origin lies, from 0 to 1.
float nearestOnSegment(vec3 a, vec3 b)
{
  vec3 edge = b - a;
  float square = squareOf(edge);
  return square > 0.0 ? clamp(-dot(a, edge) / square, 0.0, 1.0) : 0.0;
}

// Barycentric coordinates of the triangle's point nearest to the origin: its foot point where that lies
// within, else the nearest point of the three edges.
vec3 nearestOf(vec3 a, vec3 b, vec3 c)
{
  vec3 normal = cross(b - a, c - a);
  vec3 foot = vec3(dot(cross(b, c), normal), dot(cross(c, a), normal), dot(cross(a, b), normal));
  float square = squareOf(normal);
  if (square > 0.0 && all(greaterThanEqual(foot, vec3(0.0))))
  {
    return foot / (foot.x + foot.y + foot.z);
  }
  float ab = nearestOnSegment(a, b);
  float bc = nearestOnSegment(b, c);
  float ca = nearestOnSegment(c, a);
  float toAB = squareOf(mix(a, b, ab));
  float toBC = squareOf(mix(b, c, bc));
  float toCA = squareOf(mix(c, a, ca));
  return toAB <= toBC && toAB <= toCA ? vec3(1.0 - ab, ab, 0.0)
    : toBC <= toCA                    ? vec3(0.0, 1.0 - bc, bc)
                                      : vec3(ca, 0.0, 1.0 - ca);
}

float valueOf(uint triangle, uvec3 ids, vec3 weights, int component, int components)
{
#ifdef OF_POINTS
  ivec3 at = ivec3(ids) * components + component;
  return dot(weights,
    vec3(texelFetch(Values, at.x).x, texelFetch(Values, at.y).x, texelFetch(Values, at.z).x));
#else
  return texelFetch(Values, int(triangle) * components + component).x;
#endif
}

uint orderedBits(float value)
{
  uint bits = floatBitsToUint(value);
  return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

void combine(uint number, int component, float value)
{
  uint at = number * uint(COMPONENTS) + uint(component);
#if COMBINATION == AVERAGE
  uint addend = uint(clamp(value, 0.0, 1.0) * ONE + 0.5);
  uint before = atomicAdd(Combined[2u * at], addend);
  if (before + addend < before)
  {
    atomicAdd(Combined[2u * at + 1u], 1u);
  }
#elif COMBINATION == MINIMUM
  atomicMin(Combined[at], orderedBits(value));
#elif COMBINATION == MAXIMUM
  atomicMax(Combined[at], orderedBits(value));
#elif COMBINATION == STORE_FIRST
  Combined[at] = floatBitsToUint(value);
#endif
}

void visit(Facet f, ivec3 local)
{
  uint number = numberOf(placeOf(f, local));
#if COMBINATION == AVERAGE
  atomicAdd(TrianglesOf[number], 1u);
#elif COMBINATION == FIND_FIRST
  atomicMin(TrianglesOf[number], f.Triangle);
#endif
#if COMBINATION != FIND_FIRST
  bool counts = true;
#if COMBINATION == STORE_FIRST
  counts = TrianglesOf[number] == f.Triangle;
#endif
  uvec3 ids = texelFetch(Triangles, int(f.Triangle)).xyz;
  dvec3 centre = dvec3(turnedBack(local, f.Axis));
  vec3 weights = nearestOf(vec3(f.A - centre), vec3(f.B - centre), vec3(f.C - centre));
#ifdef IMAGE
  vec2 place = vec2(valueOf(f.Triangle, ids, weights, 0, 2), valueOf(f.Triangle, ids, weights, 1, 2));
  vec4 color = textureLod(Image, place, 0.0);
#endif
  if (counts)
  {
    for (int component = 0; component < COMPONENTS; ++component)
    {
#ifdef IMAGE
      combine(number, component, color[component]);
#else
      combine(number, component, valueOf(f.Triangle, ids, weights, component, COMPONENTS));
#endif
    }
  }
#endif
}
