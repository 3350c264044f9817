// A fragment is a column of voxels under a deferred triangle; the overlap test is the same as everywhere, so
// that what the dilated triangle covers too much is culled: Rauwendaal 2012, section 3.2.
//
// Follows vtkSlicemapLayout.glsl, vtkVoxelMeshFetch.glsl, vtkSurfaceFacet.glsl, vtkSurfaceOverlap.glsl,
// vtkSurfaceRows.glsl and the file with visit().
//
// WindowFirst as in vtkSurfaceVertex.glsl

uniform ivec2 WindowFirst;

flat in uint Triangle;

void main()
{
  Facet f;
  facetOf(Triangle, f);
  ivec2 column = ivec2(gl_FragCoord.xy) + WindowFirst + turned(First, f.Axis).xy - f.Base.xy;
  bool isInBounds =
    all(greaterThanEqual(column, f.First.xy)) && all(lessThan(column, f.End.xy));
  if (isInBounds)
  {
    visitColumn(f, column.x, column.y);
  }
}
