// The part of a triangle in one column of voxels, exactly: for conservative voxelization by compute and
// by fragment shaders.
//
// The including shader defines REAL, REAL2 and REAL3: double, dvec2, dvec3 or float, vec2, vec3.
// Points are (u, v, depth) in voxels; a column is the square prism |u - u0| <= halfWidth,
// |v - v0| <= halfWidth along depth.
//
// The part of the triangle in the prism is a convex polygon. Its corners are ends of the triangle's
// edges clipped to the prism, or ends of the triangle's cuts along the two sides v = const of the prism,
// clipped to the prism; the smallest and the largest depth of these bound the polygon.

// Depths seen so far.
struct Range
{
  REAL Low;
  REAL High;
};

const REAL HUGE = 1.0e30;
const Range NOTHING = Range(HUGE, -HUGE);

// A piece of a straight line, (u, depth) from one end to the other; empty when Valid is false.
struct Cut
{
  REAL2 From;
  REAL2 To;
  bool Valid;
};

void include(inout Range range, REAL x)
{
  range.Low = min(range.Low, x);
  range.High = max(range.High, x);
}

// The part of p + t * d, t from interval.x to interval.y, with low <= p + t * d <= high; empty
// intervals have x > y.
void clipTo(inout REAL2 interval, REAL p, REAL d, REAL low, REAL high)
{
  if (d == 0.0)
  {
    interval = p < low || p > high ? REAL2(1.0, 0.0) : interval;
    return;
  }
  REAL a = (low - p) / d;
  REAL b = (high - p) / d;
  interval.x = max(interval.x, min(a, b));
  interval.y = min(interval.y, max(a, b));
}

void extend(inout Cut cut, REAL3 p, REAL3 q, REAL v)
{
  REAL d = q.y - p.y;
  if (d == 0.0 || v < min(p.y, q.y) || v > max(p.y, q.y))
  {
    return;
  }
  REAL t = (v - p.y) / d;
  REAL2 at = p.xz + t * (q.xz - p.xz);
  if (!cut.Valid)
  {
    cut = Cut(at, at, true);
  }
  else if (at.x < cut.From.x)
  {
    cut.From = at;
  }
  else if (at.x > cut.To.x)
  {
    cut.To = at;
  }
}

// The triangle's section along v = const.
Cut sectionAt(REAL3 a, REAL3 b, REAL3 c, REAL v)
{
  Cut cut = Cut(REAL2(0.0), REAL2(0.0), false);
  extend(cut, a, b, v);
  extend(cut, b, c, v);
  extend(cut, c, a, v);
  return cut;
}

void includeCut(inout Range depths, Cut cut, REAL left, REAL right)
{
  REAL2 d = cut.To - cut.From;
  REAL2 interval = REAL2(0.0, 1.0);
  clipTo(interval, cut.From.x, d.x, left, right);
  if (cut.Valid && interval.x <= interval.y)
  {
    include(depths, cut.From.y + interval.x * d.y);
    include(depths, cut.From.y + interval.y * d.y);
  }
}

void includeEdge(
  inout Range depths, REAL3 p, REAL3 q, REAL left, REAL right, REAL low, REAL high)
{
  REAL3 d = q - p;
  REAL2 interval = REAL2(0.0, 1.0);
  clipTo(interval, p.x, d.x, left, right);
  clipTo(interval, p.y, d.y, low, high);
  if (interval.x <= interval.y)
  {
    include(depths, p.z + interval.x * d.z);
    include(depths, p.z + interval.y * d.z);
  }
}

void includeEdgeOfRow(inout Range reach, REAL3 p, REAL3 q, REAL low, REAL high)
{
  REAL3 d = q - p;
  REAL2 interval = REAL2(0.0, 1.0);
  clipTo(interval, p.y, d.y, low, high);
  if (interval.x <= interval.y)
  {
    include(reach, p.x + interval.x * d.x);
    include(reach, p.x + interval.y * d.x);
  }
}

// What all columns of a row v share: its bounds, and the triangle's cuts along them.
struct Row
{
  REAL Low;
  REAL High;
  Cut LowCut;
  Cut HighCut;
};

Row rowOf(REAL3 a, REAL3 b, REAL3 c, REAL v, REAL halfWidth)
{
  REAL low = v - halfWidth;
  REAL high = v + halfWidth;
  return Row(low, high, sectionAt(a, b, c, low), sectionAt(a, b, c, high));
}

// The range of u that the triangle has in the row.
Range reachInRow(REAL3 a, REAL3 b, REAL3 c, Row row)
{
  Range reach = NOTHING;
  includeEdgeOfRow(reach, a, b, row.Low, row.High);
  includeEdgeOfRow(reach, b, c, row.Low, row.High);
  includeEdgeOfRow(reach, c, a, row.Low, row.High);
  return reach;
}

// The range of depths that the triangle has in the column at u of the row; Low > High when none.
Range depthsInColumn(REAL3 a, REAL3 b, REAL3 c, Row row, REAL u, REAL halfWidth)
{
  REAL left = u - halfWidth;
  REAL right = u + halfWidth;
  Range depths = NOTHING;
  includeEdge(depths, a, b, left, right, row.Low, row.High);
  includeEdge(depths, b, c, left, right, row.Low, row.High);
  includeEdge(depths, c, a, left, right, row.Low, row.High);
  includeCut(depths, row.LowCut, left, right);
  includeCut(depths, row.HighCut, left, right);
  return depths;
}
