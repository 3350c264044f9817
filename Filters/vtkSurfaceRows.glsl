// The columns of a triangle in the precision that it wants; for large triangles.
//
// Follows vtkSurfaceOverlap.glsl (as NearOverlap and FarOverlap).

void visitColumn(Facet f, int u, int v)
{
  if (f.Near)
  {
    NearOverlap overlap;
    setUpOverlap(overlap, f, float(NEAR_MARGIN + Margin));
    visitColumn(f, overlap, u, v);
  }
  else
  {
    FarOverlap overlap;
    setUpOverlap(overlap, f, Margin);
    ivec2 column = ivec2(u, v);
    if (all(greaterThanEqual(column, overlap.First.xy)) && all(lessThan(column, overlap.End.xy)))
    {
      visitColumn(f, overlap, u, v);
    }
  }
}

// The columns of row v from `first` on, half open.
void visitRow(Facet f, int v, int first, int end)
{
  if (f.Near)
  {
    NearOverlap overlap;
    setUpOverlap(overlap, f, float(NEAR_MARGIN + Margin));
    visitRow(f, overlap, v, first, end);
  }
  else
  {
    FarOverlap overlap;
    setUpOverlap(overlap, f, Margin);
    visitRow(f, overlap, v, first, end);
  }
}
