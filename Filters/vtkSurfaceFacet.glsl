// A triangle ready for vtkSurfaceOverlap.glsl, which this file precedes and vtkVoxelMeshFetch.glsl (index
// coordinates in the order x, y, z) goes before.
//
// First, End  the box of voxels to do, index coordinates, half open
// Margin      by how much voxels are grown, larger than any rounding error of the triangle's points, so
//             that no touched voxel is missed

uniform ivec3 First;
uniform ivec3 End;
uniform double Margin;

// Triangles within so many voxels are tested in single precision; what it rounds is below NEAR_MARGIN.
const float NEAR_VOXELS = 14.0;
const double NEAR_MARGIN = 3.0e-6lf;

// Beyond, single precision does not tell voxels apart.
const float LARGEST_NEAR_INDEX = 4194304.0;
const float LARGEST_INDEX = 1.0e9;

const float ROUNDING = 1.2e-7;

// A triangle whose numbers depend on it alone, so that all boxes and all ways see the same ones.
struct Facet
{
  // The points, in voxels from the centre of the voxel in the middle of their bounds.
  dvec3 A;
  dvec3 B;
  dvec3 C;
  uint Triangle;
  // The axis closest to the normal. What follows is turned so that it comes third, (u, v, w).
  int Axis;
  vec3 Normal;
  // The plane, w = Height + dot(Slope, (u, v)), and what rounding may have done to it, which counts for
  // triangles that are nearly segments.
  dvec2 Slope;
  double Height;
  double Uncertainty;
  // The voxel in the middle, and the voxels of the box that the bounds overlap, counted from there, half open;
  // without Near some more.
  ivec3 Base;
  ivec3 First;
  ivec3 End;
  bool Near;
};

vec3 turned(vec3 p, int axis)
{
  return axis == 0 ? p.yzx : axis == 1 ? p.zxy : p;
}

dvec3 turned(dvec3 p, int axis)
{
  return axis == 0 ? p.yzx : axis == 1 ? p.zxy : p;
}

ivec3 turned(ivec3 p, int axis)
{
  return axis == 0 ? p.yzx : axis == 1 ? p.zxy : p;
}

ivec3 turnedBack(ivec3 p, int axis)
{
  return axis == 0 ? p.zxy : axis == 1 ? p.yzx : p;
}

int dominantAxis(vec3 normal)
{
  vec3 size = abs(normal);
  return size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
}

float largestOf(vec3 v)
{
  return max(v.x, max(v.y, v.z));
}

int boundedCeil(float x, int low, int high)
{
  return int(clamp(ceil(x), float(low), float(high)));
}

// Slopes are one at most. A triangle without area has any plane.
void setUpPlane(inout Facet f, dvec3 normal, double extent)
{
  const double roundings = 8.0lf * 2.3e-16lf;
  dvec3 n = turned(normal, f.Axis);
  dvec3 a = turned(f.A, f.Axis);
  double error = roundings * extent * extent * extent;
  double size = abs(n.z);
  bool isFlat = error < size * extent;
  precise double inverse = 1.0lf / n.z;
  precise dvec2 slope = -n.xy * inverse;
  f.Slope = isFlat ? slope : dvec2(0.0lf);
  precise double height = a.z - f.Slope.x * a.x - f.Slope.y * a.y;
  f.Height = height;
  f.Uncertainty = isFlat ? error / size : 2.0lf * extent + 1.0lf;
}

void setUpBounds(inout Facet f, float reach)
{
  vec3 a = vec3(f.A);
  vec3 b = vec3(f.B);
  vec3 c = vec3(f.C);
  vec3 low = turned(min(a, min(b, c)), f.Axis) - reach;
  vec3 high = turned(max(a, max(b, c)), f.Axis) + reach;
  f.First = ivec3(ceil(clamp(low, -LARGEST_INDEX, LARGEST_INDEX)));
  f.End = ivec3(floor(clamp(high, -LARGEST_INDEX, LARGEST_INDEX))) + 1;
  f.First = max(f.First, turned(First, f.Axis) - f.Base);
  f.End = min(f.End, turned(End, f.Axis) - f.Base);
}

// False when the triangle overlaps no voxel of the box.
bool facetOf(uint triangle, out Facet f)
{
  StoredTriangle stored = fetchTriangle(triangle);
  dvec3 a = indexOf(stored.A);
  dvec3 b = indexOf(stored.B);
  dvec3 c = indexOf(stored.C);
  vec3 low = min(vec3(a), min(vec3(b), vec3(c)));
  vec3 high = max(vec3(a), max(vec3(b), vec3(c)));
  float largest = max(largestOf(abs(low)), largestOf(abs(high)));
  precise float extent = largestOf(high - low) + ROUNDING * largest;
  ivec3 base = ivec3(round(clamp(0.5 * (low + high), -LARGEST_INDEX, LARGEST_INDEX)));
  precise dvec3 origin = dvec3(base);
  f.A = a - origin;
  f.B = b - origin;
  f.C = c - origin;
  precise dvec3 normal = cross(f.B - f.A, f.C - f.A);
  f.Triangle = triangle;
  f.Axis = dominantAxis(vec3(normal));
  f.Normal = turned(vec3(normal), f.Axis);
  f.Base = turned(base, f.Axis);
  f.Near = extent < NEAR_VOXELS && largest < LARGEST_NEAR_INDEX;
  setUpPlane(f, normal, double(extent) + 1.0lf);
  setUpBounds(f, 0.5 + float(Margin + NEAR_MARGIN) + (f.Near ? 0.0 : ROUNDING * extent));
  return all(lessThan(f.First, f.End));
}

// Columns of the rectangle that the triangle's bounds overlap, as a measure of the work.
float columnsOf(Facet f)
{
  ivec2 size = f.End.xy - f.First.xy;
  return float(size.x) * float(size.y);
}

// The voxels of f.First and f.End that the bounds overlap exactly.
void tightenBounds(Facet f, inout ivec3 first, inout ivec3 end)
{
  dvec3 a = turned(f.A, f.Axis);
  dvec3 b = turned(f.B, f.Axis);
  dvec3 c = turned(f.C, f.Axis);
  double reach = 0.5lf + Margin;
  for (int i = 0; i < 3; ++i)
  {
    double low = lesser(a[i], lesser(b[i], c[i])) - reach;
    double high = greater(a[i], greater(b[i], c[i])) + reach;
    first[i] = boundedCeil(low, f.First[i], f.End[i]);
    end[i] = 1 - boundedCeil(-high, 1 - f.End[i], 1 - f.First[i]);
  }
}

ivec3 voxelOf(Facet f, ivec3 local)
{
  return turnedBack(f.Base + local, f.Axis);
}

// What becomes of a voxel that the triangle overlaps, (u, v, w) counted from Base.
void visit(Facet f, ivec3 local);
