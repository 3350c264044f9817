// Where the columns of a grid cross the triangles: Eisemann & Decoret 2008, section 5.2, with one
// toggled bit a crossing in place of a mask of all bits behind it; vtkSolidScan.glsl does the rest.
//
// Follows vtkSlicemapLayout.glsl, vtkVoxelMeshFetch.glsl and vtkVoxelTileQueue.glsl.
//
// COLUMN_AXIS  0, 1 or 2: the columns run along x, y or z. The other two axes are u and v, in the
//              order of x, y, z; "depth" runs along the column. Index coordinates come as (u, v, depth).
// TILES        defined in the second stage, where a workgroup does one tile of a large triangle, an
//              invocation one row of the tile. Otherwise an invocation does one triangle.
// WINDING      defined when crossings are counted with their sign instead of toggled.
//
// First, End   the box of voxels to fill, in (u, v, depth), index coordinates, half open
// Begins, Ends whether the box holds the first, and the last, voxel of the columns. Crossings before
//              the first voxel count there; those behind the last one go to the column's end.
//
// Without WINDING: storage buffer 0 holds the words of the slicemap from slice `FirstSlice` on;
//   storage buffer 1 holds one bit a column, the parity of the crossings behind its last voxel, at
//   bit u % 32 of word v * EndWordsPerRow + u / 32; a slab of rows v begins at its own first row.
// With WINDING: storage buffer 0 holds one int a voxel, at (v * (depth + 1) + d) * nu + u; the one
//   more voxel at the end of each column takes the crossings behind the last voxel.
//
// A row v crosses an edge when one end point lies at or before v and the other behind it. A column
// (u, v) is covered when u lies between the crossings of the two edges, the lower bound included. Both
// tests see the two end points of one edge and nothing else of the triangle, so all triangles at an
// edge agree, and the crossings of a closed mesh are even in number in every column.

uniform ivec3 First;
uniform ivec3 End;
uniform bool Begins;
uniform bool Ends;
uniform ivec3 GridFirst;
uniform uint WordsPerRow;
uniform uint RowsPerSlice;
uniform uint EndWordsPerRow;

#ifdef WINDING
layout(std430, binding = 0) buffer Counters
{
  int Counts[];
};
#else
layout(std430, binding = 0) buffer Slicemap
{
  uint Words[];
};
layout(std430, binding = 1) buffer ColumnEnds
{
  uint Behind[];
};
#endif

// Columns of a triangle's bounding rectangle that one invocation does by itself.
const int DIRECT_COLUMNS = 512;

struct Span
{
  int First;
  int End;
  int Direction;
};

// A triangle seen along the columns, its points sorted by v.
struct Outline
{
  dvec3 Lowest;
  dvec3 Middle;
  dvec3 Highest;
  double LongSlope;
  double LowerSlope;
  double UpperSlope;
  dvec2 Gradient;
  double Nearest;
  double Farthest;
  int Turn;
};

void sortPair(inout dvec3 low, inout dvec3 high, inout int turn)
{
  if (high.y < low.y)
  {
    dvec3 swap = low;
    low = high;
    high = swap;
    turn = -turn;
  }
}

int clampedCeil(double x, int low, int high)
{
  return int(clamp(ceil(x), double(low), double(high)));
}

Outline outlineOf(dvec3 a, dvec3 b, dvec3 c)
{
  Outline t;
  t.Turn = 1;
  sortPair(a, b, t.Turn);
  sortPair(a, c, t.Turn);
  sortPair(b, c, t.Turn);
  t.Lowest = a;
  t.Middle = b;
  t.Highest = c;
  precise double longSlope = (c.x - a.x) / (c.y - a.y);
  precise double lowerSlope = (b.x - a.x) / (b.y - a.y);
  precise double upperSlope = (c.x - b.x) / (c.y - b.y);
  t.LongSlope = longSlope;
  t.LowerSlope = lowerSlope;
  t.UpperSlope = upperSlope;
  dvec3 e = b - a;
  dvec3 f = c - a;
  double area = e.x * f.y - e.y * f.x;
  t.Gradient = area != 0.0lf
    ? dvec2(e.z * f.y - e.y * f.z, e.x * f.z - e.z * f.x) / area
    : dvec2(0.0lf);
  t.Nearest = min(a.z, min(b.z, c.z));
  t.Farthest = max(a.z, max(b.z, c.z));
  return t;
}

// The columns of row v that the triangle covers, between the given bounds.
Span spanOfRow(Outline t, int v, int first, int end)
{
  precise double y = double(v);
  precise double along = t.Lowest.x + (y - t.Lowest.y) * t.LongSlope;
  precise double lower = t.Lowest.x + (y - t.Lowest.y) * t.LowerSlope;
  precise double upper = t.Middle.x + (y - t.Middle.y) * t.UpperSlope;
  double across = y < t.Middle.y ? lower : upper;
  Span span;
  span.First = clampedCeil(min(along, across), first, end);
  span.End = clampedCeil(max(along, across), first, end);
  span.Direction = across > along ? t.Turn : -t.Turn;
  return span;
}

double depthOfRow(Outline t, int v)
{
  return t.Lowest.z + (double(v) - t.Lowest.y) * t.Gradient.y;
}

void crossColumn(Outline t, int u, int v, double depthOfRow, int direction)
{
  double depth = depthOfRow + (double(u) - t.Lowest.x) * t.Gradient.x;
  depth = clamp(depth, t.Nearest, t.Farthest);
  int d = clampedCeil(depth, First.z - 1, End.z);
  d = Begins ? max(d, First.z) : d;
  if (d < First.z)
  {
    return;
  }
#ifdef WINDING
  ivec3 size = End - First;
  ivec3 at = ivec3(u, v, d) - First;
  atomicAdd(Counts[(at.y * (size.z + 1) + at.z) * size.x + at.x], direction);
#else
  ivec3 at = ivec3(u, v, d) - GridFirst;
#if COLUMN_AXIS == 0
  uvec3 voxel = uvec3(at.z, at.x, v - First.y);
#elif COLUMN_AXIS == 1
  uvec3 voxel = uvec3(at.x, at.z, v - First.y);
#else
  uvec3 voxel = uvec3(at.x, at.y, d - First.z);
#endif
  if (d < End.z)
  {
    atomicXor(Words[slicemapWord(voxel, WordsPerRow, RowsPerSlice)], slicemapBit(voxel.x));
  }
  else if (Ends)
  {
    uvec3 column = uvec3(at.x, v - First.y, 0u);
    atomicXor(Behind[slicemapWord(column, EndWordsPerRow, 0u)], slicemapBit(column.x));
  }
#endif
}

#ifdef TILES

void main()
{
  for (uint item = gl_WorkGroupID.x; item < NumberOfItems; item += gl_NumWorkGroups.x)
  {
    uint triangle = Items[item].x;
    dvec3 a, b, c;
    fetchTriangle(triangle, a, b, c);
    Outline t = outlineOf(a, b, c);
    double left = min(a.x, min(b.x, c.x));
    double right = max(a.x, max(b.x, c.x));
    ivec2 first = ivec2(clampedCeil(left, First.x, End.x), clampedCeil(t.Lowest.y, First.y, End.y));
    ivec2 end = ivec2(clampedCeil(right, First.x, End.x), clampedCeil(t.Highest.y, First.y, End.y));
    uint tilesPerRow = tilesOf(first, end).x;
    ivec2 corner = first +
      ivec2(uvec2(Items[item].y % tilesPerRow, Items[item].y / tilesPerRow) * TILE_SIZE);
    int v = corner.y + int(gl_LocalInvocationID.x);
    if (v < end.y)
    {
      Span span = spanOfRow(t, v, corner.x, min(corner.x + int(TILE_SIZE), end.x));
      double rowDepth = depthOfRow(t, v);
      for (int u = span.First; u < span.End; ++u)
      {
        crossColumn(t, u, v, rowDepth, span.Direction);
      }
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
  dvec3 a, b, c;
  fetchTriangle(triangle, a, b, c);
  Outline t = outlineOf(a, b, c);
  int v = clampedCeil(t.Lowest.y, First.y, End.y);
  int lastRow = clampedCeil(t.Highest.y, First.y, End.y);
  double left = min(a.x, min(b.x, c.x));
  double right = max(a.x, max(b.x, c.x));
  ivec2 first = ivec2(clampedCeil(left, First.x, End.x), v);
  ivec2 end = ivec2(clampedCeil(right, First.x, End.x), lastRow);
  if (first.x >= end.x)
  {
    return;
  }
  if (double(end.x - first.x) * double(end.y - first.y) > double(DIRECT_COLUMNS) &&
    enqueueTiles(triangle, first, end))
  {
    return;
  }

  // Rows and columns in one loop, so that neighbouring invocations differ by their sums only.
  Span span = Span(0, 0, 0);
  double rowDepth = 0.0lf;
  int u = 0;
  for (--v; v < lastRow;)
  {
    if (u >= span.End)
    {
      ++v;
      span = v < lastRow ? spanOfRow(t, v, first.x, end.x) : Span(0, 0, 0);
      u = span.First;
      rowDepth = depthOfRow(t, v);
    }
    if (u < span.End)
    {
      crossColumn(t, u, v, rowDepth, span.Direction);
      ++u;
    }
  }
}

#endif
