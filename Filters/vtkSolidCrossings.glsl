// Where the columns of a grid cross the triangles: Eisemann & Decoret 2008, section 5.2, with one
// toggled bit a crossing in place of a mask of all bits behind it; vtkSolidScan.glsl does the rest.
//
// Follows vtkSlicemapLayout.glsl, vtkVoxelMeshFetch.glsl, vtkVoxelTriangleRange.glsl and
// vtkVoxelTileQueue.glsl.
//
// COLUMN_AXIS  0, 1 or 2: the columns run along x, y or z. The other two axes are u and v, in the
//              order of x, y, z; "depth" runs along the column. Index coordinates come as (u, v, depth).
// CUT, TILES, UNCUT  defined in the stages of large triangles, see vtkVoxelTileQueue.glsl. Otherwise an
//              invocation does one triangle.
// SIEVE        defined in a first stage that only lists the triangles that may cover a column, in
//              single precision on the safe side; the stage with REST defined does them. Pays where
//              most triangles lie between the columns.
// VARIANTS     defined when the triangles are done for several variants of the mesh at once; see below
// WINDING      defined when crossings are counted with their sign instead of toggled.
// UPPER_INCLUDED  defined when solids are half open at their lower ends, see below.
//
// SingleMargin how far index coordinates in single precision may be off
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
// With VARIANTS: storage buffer 0 holds a grid a variant, one behind the other along z, SlicesPerGrid slices each;
//   nothing is kept of what lies behind the last voxels. Each invocation goes through VariantsAtOnce variants, 32 at
//   most, from FirstVariant on and up to EndVariant, and does for itself those in which its triangle may cover a
//   column, found as by SIEVE. What waits in the queue is variant * NumberOfTriangles + triangle.
//
// A row v crosses an edge when one end point lies at or before v and the other behind it. A column
// (u, v) is covered when u lies between the crossings of the two edges, the lower bound included. Both
// tests see the two end points of one edge and nothing else of the triangle, so all triangles at an
// edge agree, and the crossings of a closed mesh are even in number in every column. The depth in a
// column lies between the depths of these two edges in the row, so that it is the triangle's even where
// the triangle is seen edge-on.
//
// With UPPER_INCLUDED all of this is mirrored along each axis, bit for bit: a row crosses an edge with one
// end point before it and the other at or behind it, of the covered columns the upper bound is included,
// and a voxel at a crossing does not lie behind it.

uniform ivec3 First;
uniform ivec3 End;
uniform bool Begins;
uniform bool Ends;
uniform ivec3 GridFirst;
uniform uint WordsPerRow;
uniform uint RowsPerSlice;
uniform uint EndWordsPerRow;
uniform float SingleMargin;
#ifdef VARIANTS
uniform uint FirstVariant;
uniform uint EndVariant;
uniform uint VariantsAtOnce;
uniform uint SlicesPerGrid;
#endif

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
#ifndef VARIANTS
layout(std430, binding = 1) buffer ColumnEnds
{
  uint Behind[];
};
#endif
#endif

// Columns of a triangle's bounding rectangle that one invocation does by itself.
const int DIRECT_COLUMNS = 512;

// Read before any branch, since renderers in software read uniforms behind one number by number; expressions
// keep compilers from reading them where these are used instead.
ivec3 boxFirst = min(First, End);
ivec3 boxEnd = max(First, End);
ivec3 gridFirst = min(GridFirst, First);
uint wordsPerRow = max(WordsPerRow, 1u);
uint rowsPerSlice = max(RowsPerSlice, 1u);
uint endWordsPerRow = max(EndWordsPerRow, 1u);

// The depths at which crossings count, half open.
int firstDepth = Begins ? First.z : First.z - 1;
int endOfDepths = Ends ? End.z + 1 : End.z;

// The columns of a row that a triangle covers, and its depth along them.
struct Span
{
  int First;
  int End;
  int Direction;
  double Start;
  double Depth;
  double Gradient;
  double Nearest;
  double Farthest;
};

// A triangle seen along the columns, its points sorted by v; slopes are (u, depth) over v.
struct Outline
{
  dvec3 Lowest;
  dvec3 Middle;
  dvec3 Highest;
  dvec2 LongSlope;
  dvec2 LowerSlope;
  dvec2 UpperSlope;
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

dvec2 slopeOf(dvec3 low, dvec3 high)
{
  precise double inverse = 1.0lf / (high.y - low.y);
  precise dvec2 slope = (high.xz - low.xz) * inverse;
  return slope;
}

Outline outlineOf(StoredTriangle triangle)
{
  dvec3 a = indexOf(triangle.A);
  dvec3 b = indexOf(triangle.B);
  dvec3 c = indexOf(triangle.C);
  Outline t;
  t.Turn = 1;
  sortPair(a, b, t.Turn);
  sortPair(a, c, t.Turn);
  sortPair(b, c, t.Turn);
  t.Lowest = a;
  t.Middle = b;
  t.Highest = c;
  t.LongSlope = slopeOf(a, c);
  t.LowerSlope = slopeOf(a, b);
  t.UpperSlope = slopeOf(b, c);
  return t;
}

// The first voxel of an interval that begins at x, within bounds; so too the first one behind it.
int firstFrom(double x, int low, int high)
{
#ifdef UPPER_INCLUDED
  return boundedAfter(x, low, high);
#else
  return boundedCeil(x, low, high);
#endif
}

// Where the edges cross row v, and the columns between, within the given bounds.
Span spanOfRow(Outline t, int v, int first, int end)
{
  double y = double(v);
  // Edges are followed from the end that may lie in the row, where they are exact.
#ifdef UPPER_INCLUDED
  bool isLower = y <= t.Middle.y;
  dvec3 longStart = t.Highest;
  dvec3 start = isLower ? t.Middle : t.Highest;
#else
  bool isLower = y < t.Middle.y;
  dvec3 longStart = t.Lowest;
  dvec3 start = isLower ? t.Lowest : t.Middle;
#endif
  dvec2 slope = isLower ? t.LowerSlope : t.UpperSlope;
  precise dvec2 along = longStart.xz + (y - longStart.y) * t.LongSlope;
  precise dvec2 across = start.xz + (y - start.y) * slope;
  bool isRight = along.x < across.x;
  double width = across.x - along.x;
  Span span;
  span.First = firstFrom(isRight ? along.x : across.x, first, end);
  span.End = firstFrom(isRight ? across.x : along.x, first, end);
  span.Direction = isRight ? t.Turn : -t.Turn;
  span.Start = along.x;
  span.Depth = along.y;
  span.Gradient = width != 0.0lf ? (across.y - along.y) / width : 0.0lf;
  span.Nearest = lesser(along.y, across.y);
  span.Farthest = greater(along.y, across.y);
  return span;
}

void crossColumn(Span span, int u, int v)
{
  double depth = span.Depth + (double(u) - span.Start) * span.Gradient;
  depth = bounded(depth, span.Nearest, span.Farthest);
  int d = firstFrom(depth, firstDepth, boxEnd.z);
  if (d < boxFirst.z)
  {
    return;
  }
#ifdef WINDING
  ivec3 size = boxEnd - boxFirst;
  ivec3 at = ivec3(u, v, d) - boxFirst;
  atomicAdd(Counts[(at.y * (size.z + 1) + at.z) * size.x + at.x], span.Direction);
#else
  ivec3 at = ivec3(u, v, d) - gridFirst;
#if COLUMN_AXIS == 0
  uvec3 voxel = uvec3(at.z, at.x, v - boxFirst.y);
#elif COLUMN_AXIS == 1
  uvec3 voxel = uvec3(at.x, at.z, v - boxFirst.y);
#else
  uvec3 voxel = uvec3(at.x, at.y, d - boxFirst.z);
#endif
#ifdef VARIANTS
  voxel.z += Variant * SlicesPerGrid;
#endif
  if (d < boxEnd.z)
  {
    atomicXor(Words[slicemapWord(voxel, wordsPerRow, rowsPerSlice)], slicemapBit(voxel.x));
  }
#ifndef VARIANTS
  else if (d < endOfDepths)
  {
    uvec3 column = uvec3(at.x, v - boxFirst.y, 0u);
    atomicXor(Behind[slicemapWord(column, endWordsPerRow, 0u)], slicemapBit(column.x));
  }
#endif
#endif
}

// The rectangle of columns that a triangle may cover, rows exactly, the others with some at its rim.
void rectangleOf(Outline t, out ivec2 first, out ivec2 end)
{
  vec3 us = vec3(t.Lowest.x, t.Middle.x, t.Highest.x);
  float left = floor(min(us.x, min(us.y, us.z))) - 1.0;
  float right = ceil(max(us.x, max(us.y, us.z))) + 1.0;
  first.x = int(clamp(left, float(boxFirst.x), float(boxEnd.x)));
  end.x = int(clamp(right, float(boxFirst.x), float(boxEnd.x)));
  first.y = firstFrom(t.Lowest.y, boxFirst.y, boxEnd.y);
  end.y = firstFrom(t.Highest.y, boxFirst.y, boxEnd.y);
}

// Whether the origin is left or right of all edges, or so close to them that single precision can't tell.
bool mayCover(vec2 a, vec2 b, vec2 c)
{
  vec3 distances = vec3(a.x * b.y - a.y * b.x, b.x * c.y - b.y * c.x, c.x * a.y - c.y * a.x);
  vec3 size = vec3(abs(a.x) + abs(a.y), abs(b.x) + abs(b.y), abs(c.x) + abs(c.y));
  vec3 slack = 4.0 * SingleMargin * (size + size.yzx + SingleMargin);
  return !(any(lessThan(distances, -slack)) && any(greaterThan(distances, slack)));
}

bool mayCoverColumns(StoredTriangle stored)
{
  vec2 a = roughIndexOf(stored.A).xy;
  vec2 b = roughIndexOf(stored.B).xy;
  vec2 c = roughIndexOf(stored.C).xy;
  vec2 first = max(ceil(min(a, min(b, c)) - SingleMargin), vec2(boxFirst.xy));
  vec2 end = min(floor(max(a, max(b, c)) + SingleMargin) + 1.0, vec2(boxEnd.xy));
  vec2 size = max(end - first, vec2(0.0));
  float columns = size.x * size.y;
  return columns > 1.0 || (columns > 0.0 && mayCover(a - first, b - first, c - first));
}

// A triangle that waited in the queue.
StoredTriangle fetchItem(uint item)
{
#ifdef VARIANTS
  useVariant(item / NumberOfTriangles);
  return fetchTriangle(item % NumberOfTriangles);
#else
  return fetchTriangle(item);
#endif
}

// Crosses all columns of a triangle, or leaves it to the stages of large ones.
void crossTriangle(StoredTriangle stored, uint item)
{
  Outline t = outlineOf(stored);
  ivec2 first, end;
  rectangleOf(t, first, end);
  float columns = float(end.x - first.x) * float(end.y - first.y);
  bool isLarge = columns > float(DIRECT_COLUMNS);
  if (isLarge)
  {
    enqueueLarge(item);
  }
  int lastRow = isLarge || columns <= 0.0 ? first.y - 1 : end.y - 1;

  // Rows and columns in one loop, so that neighbouring invocations differ by their sums only.
  Span span;
  span.End = 0;
  int u = 0;
  int v = first.y - 1;
  for (;;)
  {
    while (u >= span.End && v < lastRow)
    {
      ++v;
      span = spanOfRow(t, v, first.x, end.x);
      u = span.First;
    }
    if (u >= span.End)
    {
      break;
    }
    crossColumn(span, u, v);
    ++u;
  }
}

#if defined(CUT) || defined(TILES) || defined(UNCUT)

void rectangleOf(uint item, out ivec2 first, out ivec2 end)
{
  rectangleOf(outlineOf(fetchItem(item)), first, end);
}

void doTile(uint item, uvec2 tile)
{
  Outline t = outlineOf(fetchItem(item));
  ivec2 first, end;
  rectangleOf(t, first, end);
  ivec2 corner = first + ivec2(tile * TILE_SIZE);
  int v = corner.y + int(gl_LocalInvocationID.x);
  if (v < end.y && corner.x < end.x)
  {
    Span span = spanOfRow(t, v, corner.x, min(corner.x + int(TILE_SIZE), end.x));
    for (int u = span.First; u < span.End; ++u)
    {
      crossColumn(span, u, v);
    }
  }
}

#elif defined(SIEVE)

void main()
{
  uint triangle;
  if (triangleOfInvocation(triangle) && mayCoverColumns(fetchTriangle(triangle)))
  {
    enqueueRest(triangle);
  }
}

#elif defined(VARIANTS)

void main()
{
  uint triangle = indexOfInvocation() % NumberOfTriangles;
  uint first = FirstVariant + indexOfInvocation() / NumberOfTriangles * VariantsAtOnce;
  uint end = min(first + VariantsAtOnce, EndVariant);
  StoredTriangle stored = fetchTriangle(triangle);
  uint covering = 0u;
  for (uint variant = first; variant < end; ++variant)
  {
    useVariantRoughly(variant);
    covering |= uint(mayCoverColumns(stored)) << (variant - first);
  }
  while (covering != 0u)
  {
    uint variant = first + uint(findLSB(covering));
    covering &= covering - 1u;
    useVariant(variant);
    crossTriangle(stored, variant * NumberOfTriangles + triangle);
  }
}

#else

void main()
{
  uint triangle;
#ifdef REST
  bool exists = restTriangle(triangle);
#else
  bool exists = triangleOfInvocation(triangle);
#endif
  if (exists)
  {
    crossTriangle(fetchTriangle(triangle), triangle);
  }
}

#endif
