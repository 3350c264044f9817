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
const int NEAR_VOXELS = 16;
const double NEAR_MARGIN = 3.0e-6lf;

// Turned so that the axis closest to the normal comes third, (u, v, w); in voxels from the centre of voxel
// Base, in the middle of the triangle's bounds, so that all boxes and all ways see the same numbers.
struct Facet
{
  dvec3 A;
  dvec3 B;
  dvec3 C;
  dvec3 Normal;
  // The plane, w = Height + dot(Slope, (u, v)), and what rounding may have done to it, which counts for
  // triangles that are nearly segments.
  dvec2 Slope;
  double Height;
  double Uncertainty;
  uint Triangle;
  int Axis;
  ivec3 Base;
  // The voxels of the box that the triangle's bounds overlap, half open.
  ivec3 First;
  ivec3 End;
  bool Near;
};

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

int dominantAxis(dvec3 normal)
{
  dvec3 size = abs(normal);
  return size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
}

int boundedCeil(float x, int low, int high)
{
  return int(clamp(ceil(x), float(low), float(high)));
}

// Slopes are one at most. A triangle without area has any plane.
void setUpPlane(inout Facet f, double extent)
{
  const double roundings = 8.0lf * 2.3e-16lf;
  double error = roundings * extent * extent * extent;
  double size = abs(f.Normal.z);
  bool isFlat = error < size * extent;
  precise double inverse = 1.0lf / f.Normal.z;
  precise dvec2 slope = -f.Normal.xy * inverse;
  f.Slope = isFlat ? slope : dvec2(0.0lf);
  precise double height = f.A.z - f.Slope.x * f.A.x - f.Slope.y * f.A.y;
  f.Height = height;
  f.Uncertainty = isFlat ? error / size : 2.0lf * extent + 1.0lf;
}

// False when the triangle overlaps no voxel of the box.
bool facetOf(uint triangle, out Facet f)
{
  const int farAway = 1 << 30;
  StoredTriangle stored = fetchTriangle(triangle);
  dvec3 a = indexOf(stored.A);
  dvec3 b = indexOf(stored.B);
  dvec3 c = indexOf(stored.C);
  precise dvec3 normal = cross(b - a, c - a);
  f.Triangle = triangle;
  f.Axis = dominantAxis(normal);
  f.Normal = turned(normal, f.Axis);
  a = turned(a, f.Axis);
  b = turned(b, f.Axis);
  c = turned(c, f.Axis);
  ivec3 boxFirst = turned(First, f.Axis);
  ivec3 boxEnd = turned(End, f.Axis);
  double halfWidth = 0.5lf + Margin + NEAR_MARGIN;
  double extent = 0.0lf;
  for (int i = 0; i < 3; ++i)
  {
    double low = lesser(a[i], lesser(b[i], c[i])) - halfWidth;
    double high = greater(a[i], greater(b[i], c[i])) + halfWidth;
    extent = greater(extent, high - low);
    f.Base[i] = boundedCeil(0.5lf * (low + high), -farAway, farAway);
    f.First[i] = boundedCeil(low, boxFirst[i], boxEnd[i]);
    f.End[i] = 1 - boundedCeil(-high, 1 - boxEnd[i], 1 - boxFirst[i]);
  }
  f.First -= f.Base;
  f.End -= f.Base;
  f.Near = extent < double(NEAR_VOXELS);
  precise dvec3 base = dvec3(f.Base);
  f.A = a - base;
  f.B = b - base;
  f.C = c - base;
  setUpPlane(f, extent);
  return all(lessThan(f.First, f.End));
}

// Columns of the rectangle that the triangle's bounds overlap, as a measure of the work.
float columnsOf(Facet f)
{
  ivec2 size = f.End.xy - f.First.xy;
  return float(size.x) * float(size.y);
}

ivec3 voxelOf(Facet f, ivec3 local)
{
  return turnedBack(f.Base + local, f.Axis);
}

// What becomes of a voxel that the triangle overlaps, (u, v, w) counted from Base.
void visit(Facet f, ivec3 local);
