// Whether a triangle overlaps voxels, with all that does not depend on the voxel worked out before:
// Rauwendaal 2012, chapter 3 ("Factorization") and figures 6.1 (26-separating) and 6.2 (6-separating).
//
// Included twice, for triangles of few voxels in single precision and for all others in double:
// REAL, REAL2, REAL3 are float, vec2, vec3 or double, dvec2, dvec3; EDGES and OVERLAP name the types;
// TIGHTENS_BOUNDS is 1 where the facet's bounds are not those of the triangle exactly.
// SEPARABILITY is 26 or 6. Points are (u, v, w) of a Facet, see vtkSurfaceFacet.glsl.

// Three edges of the triangle in one projection: a point is inside, as far as they can tell, where
// X * p.x + Y * p.y + Offset >= 0.
struct EDGES
{
  REAL3 X;
  REAL3 Y;
  REAL3 Offset;
};

struct OVERLAP
{
  EDGES UV;
  EDGES VW;
  EDGES WU;
  // The plane at (u, v): w = Height + dot(Slope, (u, v)), and how far from it voxels still overlap.
  REAL2 Slope;
  REAL Height;
  REAL Reach;
  // The voxels to look at, half open.
  ivec3 First;
  ivec3 End;
};

// The edges see a voxel's square, or for 6-separating voxels the diamond in it, grown by `margin`.
void setUpEdges(out EDGES edges, REAL2 a, REAL2 b, REAL2 c, bool isLeft, REAL margin)
{
  REAL side = REAL(isLeft ? 1.0 : -1.0);
  precise REAL3 x = side * REAL3(a.y - b.y, b.y - c.y, c.y - a.y);
  precise REAL3 y = side * REAL3(b.x - a.x, c.x - b.x, a.x - c.x);
  REAL3 sizeX = abs(x);
  REAL3 sizeY = abs(y);
#if SEPARABILITY == 26
  precise REAL3 reach = (REAL(0.5) + margin) * (sizeX + sizeY);
#else
  REAL3 larger = REAL3(sizeX.x < sizeY.x ? sizeY.x : sizeX.x, sizeX.y < sizeY.y ? sizeY.y : sizeX.y,
    sizeX.z < sizeY.z ? sizeY.z : sizeX.z);
  precise REAL3 reach = REAL(0.5) * larger + margin * (sizeX + sizeY);
#endif
  precise REAL3 offset = reach - x * REAL3(a.x, b.x, c.x) - y * REAL3(a.y, b.y, c.y);
  edges = EDGES(x, y, offset);
}

bool isInside(EDGES edges, REAL x, REAL y)
{
  precise REAL3 distances = edges.X * x + edges.Y * y + edges.Offset;
  return distances.x >= REAL(0.0) && distances.y >= REAL(0.0) && distances.z >= REAL(0.0);
}

void setUpOverlap(out OVERLAP overlap, Facet f, REAL margin)
{
  REAL3 a = turned(REAL3(f.A), f.Axis);
  REAL3 b = turned(REAL3(f.B), f.Axis);
  REAL3 c = turned(REAL3(f.C), f.Axis);
  setUpEdges(overlap.UV, a.xy, b.xy, c.xy, f.Normal.z >= 0.0, margin);
  setUpEdges(overlap.VW, a.yz, b.yz, c.yz, f.Normal.x >= 0.0, margin);
  setUpEdges(overlap.WU, a.zx, b.zx, c.zx, f.Normal.y >= 0.0, margin);
  overlap.Slope = REAL2(f.Slope);
  overlap.Height = REAL(f.Height);
#if SEPARABILITY == 26
  precise REAL reach = (REAL(0.5) + margin) * (abs(overlap.Slope.x) + abs(overlap.Slope.y) + REAL(1.0));
#else
  precise REAL reach = REAL(0.5) + margin;
#endif
  overlap.Reach = reach + REAL(f.Uncertainty);
  overlap.First = f.First;
  overlap.End = f.End;
#if TIGHTENS_BOUNDS
  tightenBounds(f, overlap.First, overlap.End);
#endif
}

// The voxels of column (u, v) that the plane passes, half open; none when the edges are not over the column.
ivec2 voxelsOfColumn(OVERLAP overlap, int u, int v)
{
  int first = overlap.First.z;
  int end = overlap.End.z;
  precise REAL w = overlap.Height + overlap.Slope.x * REAL(u) + overlap.Slope.y * REAL(v);
  int low = boundedCeil(w - overlap.Reach, first, end);
  int high = 1 - boundedCeil(-(w + overlap.Reach), 1 - end, 1 - first);
  return isInside(overlap.UV, REAL(u), REAL(v)) ? ivec2(low, high) : ivec2(0);
}

// What is left to ask of these voxels.
bool overlapsVoxel(OVERLAP overlap, int u, int v, int w)
{
  return isInside(overlap.VW, REAL(v), REAL(w)) && isInside(overlap.WU, REAL(w), REAL(u));
}

// The columns of row v that an edge may let through, and some more, so that rounding here takes none away.
void clipRow(inout ivec2 columns, REAL x, REAL y, REAL offset, int v)
{
  const REAL slack = REAL(1.0e-4);
  REAL rest = y * REAL(v) + offset + slack * (abs(x) + abs(y));
  if (x == REAL(0.0))
  {
    columns.y = rest < REAL(0.0) ? columns.x : columns.y;
    return;
  }
  int bound = boundedCeil(-rest / x, columns.x, columns.y);
  columns.x = x > REAL(0.0) ? max(columns.x, bound - 1) : columns.x;
  columns.y = x < REAL(0.0) ? min(columns.y, bound + 1) : columns.y;
}

ivec2 columnsOfRow(OVERLAP overlap, int v, int first, int end)
{
  if (v < overlap.First.y || v >= overlap.End.y || first >= end)
  {
    return ivec2(0);
  }
  EDGES edges = overlap.UV;
  ivec2 columns = ivec2(first, end);
  clipRow(columns, edges.X.x, edges.Y.x, edges.Offset.x, v);
  clipRow(columns, edges.X.y, edges.Y.y, edges.Offset.y, v);
  clipRow(columns, edges.X.z, edges.Y.z, edges.Offset.z, v);
  return columns;
}

void visitColumn(Facet f, OVERLAP overlap, int u, int v)
{
  ivec2 voxels = voxelsOfColumn(overlap, u, v);
  for (int w = voxels.x; w < voxels.y; ++w)
  {
    if (overlapsVoxel(overlap, u, v, w))
    {
      visit(f, ivec3(u, v, w));
    }
  }
}

void visitRow(Facet f, OVERLAP overlap, int v, int first, int end)
{
  ivec2 columns =
    columnsOfRow(overlap, v, max(first, overlap.First.x), min(end, overlap.End.x));
  for (int u = columns.x; u < columns.y; ++u)
  {
    visitColumn(f, overlap, u, v);
  }
}
