// The voxels that triangles touch: closed unit cubes against closed triangles, exact up to `Margin`.
// This is the conservative boundary of Eisemann & Decoret 2008, section 5.3.
//
// Follows vtkSlicemapLayout.glsl, vtkVoxelMeshFetch.glsl (index coordinates in the order x, y, z),
// vtkVoxelTileQueue.glsl and, in double precision, vtkTouchedColumn.glsl.
//
// TILES        defined in the second stage, where a workgroup does one tile of a large triangle
// REMOVE       defined when touched voxels are cleared instead of set
//
// storage buffer 0 the words of the slicemap from slice First.z on
// First, End   the box of voxels to do, index coordinates, half open
// Margin       half edge of a voxel is 0.5 + Margin: larger than any rounding error of the arithmetic,
//              so that no touched voxel is missed
//
// A triangle is walked along w, the axis its normal is closest to, in columns of the other two, u and
// v; vtkTouchedColumn.glsl tells the range of w in which it touches the voxels of a column.

uniform ivec3 First;
uniform ivec3 End;
uniform ivec3 GridFirst;
uniform uint WordsPerRow;
uniform uint RowsPerSlice;
uniform double Margin;

layout(std430, binding = 0) buffer Slicemap
{
  uint Words[];
};

const int DIRECT_COLUMNS = 256;

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

int dominantAxis(dvec3 a, dvec3 b, dvec3 c)
{
  dvec3 normal = abs(cross(b - a, c - a));
  return normal.x > normal.y && normal.x > normal.z ? 0 : normal.y > normal.z ? 1 : 2;
}

// Voxels whose grown cube meets [low, high] on one axis, half open, within first and end.
ivec2 voxelsBetween(double low, double high, int first, int end)
{
  double halfWidth = 0.5lf + Margin;
  int from = boundedCeil(low - halfWidth, first, end);
  int to = 1 - boundedCeil(-(high + halfWidth), 1 - end, 1 - first);
  return ivec2(from, to);
}

void touch(ivec3 voxel)
{
  uvec3 at = uvec3(voxel.xy - GridFirst.xy, voxel.z - First.z);
  uint word = slicemapWord(at, WordsPerRow, RowsPerSlice);
#ifdef REMOVE
  atomicAnd(Words[word], ~slicemapBit(at.x));
#else
  atomicOr(Words[word], slicemapBit(at.x));
#endif
}

// A triangle, turned so that w comes third, and the box of voxels that it may touch.
struct Facet
{
  dvec3 A;
  dvec3 B;
  dvec3 C;
  int Axis;
  ivec3 First;
  ivec3 End;
};

Facet facetOf(uint triangle)
{
  Facet f;
  StoredTriangle stored = fetchTriangle(triangle);
  dvec3 a = indexOf(stored.A);
  dvec3 b = indexOf(stored.B);
  dvec3 c = indexOf(stored.C);
  f.Axis = dominantAxis(a, b, c);
  f.A = turned(a, f.Axis);
  f.B = turned(b, f.Axis);
  f.C = turned(c, f.Axis);
  ivec3 boxFirst = turned(First, f.Axis);
  ivec3 boxEnd = turned(End, f.Axis);
  dvec3 low = min(f.A, min(f.B, f.C));
  dvec3 high = max(f.A, max(f.B, f.C));
  for (int i = 0; i < 3; ++i)
  {
    ivec2 voxels = voxelsBetween(low[i], high[i], boxFirst[i], boxEnd[i]);
    f.First[i] = voxels.x;
    f.End[i] = voxels.y;
  }
  return f;
}

// All columns of row v between `first` and `end`.
void touchRow(Facet f, int v, int first, int end)
{
  double halfWidth = 0.5lf + Margin;
  Row row = rowOf(f.A, f.B, f.C, double(v), halfWidth);
  Range reach = reachInRow(f.A, f.B, f.C, row);
  ivec2 columns = reach.Low <= reach.High ? voxelsBetween(reach.Low, reach.High, first, end) : ivec2(0);
  for (int u = columns.x; u < columns.y; ++u)
  {
    Range depths = depthsInColumn(f.A, f.B, f.C, row, double(u), halfWidth);
    ivec2 voxels = depths.Low <= depths.High
      ? voxelsBetween(depths.Low, depths.High, f.First.z, f.End.z)
      : ivec2(0);
    for (int w = voxels.x; w < voxels.y; ++w)
    {
      touch(turnedBack(ivec3(u, v, w), f.Axis));
    }
  }
}

#ifdef TILES

void main()
{
  for (uint item = gl_WorkGroupID.x; item < NumberOfItems; item += gl_NumWorkGroups.x)
  {
    Facet f = facetOf(Items[item].x);
    uint tilesPerRow = tilesOf(f.First.xy, f.End.xy).x;
    uint tile = Items[item].y;
    ivec2 corner = f.First.xy + ivec2(uvec2(tile % tilesPerRow, tile / tilesPerRow) * TILE_SIZE);
    int v = corner.y + int(gl_LocalInvocationID.x);
    if (v < f.End.y)
    {
      touchRow(f, v, corner.x, min(corner.x + int(TILE_SIZE), f.End.x));
    }
  }
}

#else

void main()
{
  uint triangle = triangleOfInvocation();
  if (triangle >= NumberOfTriangles)
  {
    return;
  }
  triangle += FirstTriangle;
  Facet f = facetOf(triangle);
  ivec3 size = f.End - f.First;
  if (any(lessThanEqual(size, ivec3(0))))
  {
    return;
  }
  if (double(size.x) * double(size.y) > double(DIRECT_COLUMNS) &&
    enqueueTiles(triangle, f.First.xy, f.End.xy))
  {
    return;
  }
  for (int v = f.First.y; v < f.End.y; ++v)
  {
    touchRow(f, v, f.First.x, f.End.x);
  }
}

#endif
