// Triangles of a vtkVoxelMesh in double precision, in index coordinates of the grid.
//
// Triangles   RGB32UI buffer texture, the three point ids of each triangle
// Points      RGB32F buffer texture, world coordinates rounded to float
// PointsLow   RGB32F buffer texture, what the rounding took away; with POINTS_ARE_DOUBLE only
//
// Follows vtkVoxelMeshVariants.glsl, and vtkVoxelMeshDisplacement.glsl where DISPLACED is defined.
//
// IndexFromWorld holds the three rows (a, b, c, d) of the map a * x + b * y + c * z + d from world
// coordinates to index coordinates, in the order of the axes that the including shader works in.
// AXES_ALIGNED is the swizzle of these axes, such as xzy, where the grid lies along the world's axes: a
// row then is (a, -, -, d) with the one factor that is not zero.
// All triangles at a point or an edge must see the very same numbers, hence `precise`.

uniform usamplerBuffer Triangles;
uniform samplerBuffer Points;
#ifdef POINTS_ARE_DOUBLE
uniform samplerBuffer PointsLow;
#endif
#ifndef VARIANTS
uniform dvec4 IndexFromWorld[3];
#endif

// A point as it is stored, the rest that rounding took away, and what moves it.
struct StoredPoint
{
  vec3 High;
#ifdef POINTS_ARE_DOUBLE
  vec3 Low;
#endif
#ifdef DISPLACED
  MovedPoint Moved;
#endif
};

struct StoredTriangle
{
  StoredPoint A;
  StoredPoint B;
  StoredPoint C;
};

StoredPoint fetchPoint(uint id)
{
  StoredPoint point;
  point.High = texelFetch(Points, int(id)).xyz;
#ifdef POINTS_ARE_DOUBLE
  point.Low = texelFetch(PointsLow, int(id)).xyz;
#endif
#ifdef DISPLACED
  point.Moved = movedPoint(id);
#endif
  return point;
}

StoredTriangle fetchTriangle(uint triangle)
{
  uvec3 ids = texelFetch(Triangles, int(triangle)).xyz;
  return StoredTriangle(fetchPoint(ids.x), fetchPoint(ids.y), fetchPoint(ids.z));
}

dvec3 indexOf(StoredPoint point)
{
  precise dvec3 world = dvec3(point.High);
#ifdef POINTS_ARE_DOUBLE
  world += dvec3(point.Low);
#endif
#ifdef DISPLACED
  world += dvec3(displacementOf(point.Moved));
#endif
#ifdef AXES_ALIGNED
  dvec3 scale = dvec3(IndexFromWorld[0].x, IndexFromWorld[1].x, IndexFromWorld[2].x);
  dvec3 offset = dvec3(IndexFromWorld[0].w, IndexFromWorld[1].w, IndexFromWorld[2].w);
  precise dvec3 index = world.AXES_ALIGNED * scale + offset;
#else
  dvec4 u = IndexFromWorld[0];
  dvec4 v = IndexFromWorld[1];
  dvec4 w = IndexFromWorld[2];
  precise dvec3 index = dvec3(u.x * world.x + u.y * world.y + u.z * world.z + u.w,
    v.x * world.x + v.y * world.y + v.z * world.z + v.w,
    w.x * world.x + w.y * world.y + w.z * world.z + w.w);
#endif
  return index;
}

vec3 roughWorldOf(StoredPoint point)
{
#ifdef DISPLACED
  return point.High + displacementOf(point.Moved);
#else
  return point.High;
#endif
}

// The same in single precision, within SingleMargin.
#ifdef VARIANTS
vec2 roughIndexOf(StoredPoint point)
{
  vec4 w = vec4(roughWorldOf(point), 1.0);
  return vec2(dot(RoughRows[0], w), dot(RoughRows[1], w));
}
#else
vec3 roughIndexOf(StoredPoint point)
{
  vec3 world = roughWorldOf(point);
#ifdef AXES_ALIGNED
  vec3 scale = vec3(IndexFromWorld[0].x, IndexFromWorld[1].x, IndexFromWorld[2].x);
  vec3 offset = vec3(IndexFromWorld[0].w, IndexFromWorld[1].w, IndexFromWorld[2].w);
  return world.AXES_ALIGNED * scale + offset;
#else
  vec4 w = vec4(world, 1.0);
  return vec3(dot(vec4(IndexFromWorld[0]), w), dot(vec4(IndexFromWorld[1]), w),
    dot(vec4(IndexFromWorld[2]), w));
#endif
}
#endif

// The functions on doubles below avoid what renderers in software do number by number in double precision:
// ceil, min, max and clamp.

double lesser(double a, double b)
{
  return a < b ? a : b;
}

double greater(double a, double b)
{
  return a < b ? b : a;
}

double bounded(double x, double low, double high)
{
  return x > low ? (x < high ? x : high) : low;
}

// The smallest integer that is not less than x, within bounds.
int boundedCeil(double x, int low, int high)
{
  double within = bounded(x, double(low), double(high));
  int truncated = int(within);
  return truncated + (double(truncated) < within ? 1 : 0);
}

// The smallest integer that is greater than x, within bounds.
int boundedAfter(double x, int low, int high)
{
  double within = bounded(x, double(low) - 0.5lf, double(high));
  int truncated = int(within);
  return min(truncated + (double(truncated) <= within ? 1 : 0), high);
}
