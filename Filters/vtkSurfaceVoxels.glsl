// The voxels that triangles overlap, by compute shaders: Rauwendaal 2012, sections 3.1 (an invocation a
// triangle) and 3.3 (hybrid: small triangles at once, large ones deferred).
//
// Follows vtkVoxelMeshFetch.glsl, vtkVoxelTriangleRange.glsl, vtkVoxelTileQueue.glsl, vtkSurfaceFacet.glsl
// and vtkSurfaceOverlap.glsl; visit() is in another file.
//
// In the first stage an invocation does one triangle: a small one at once, unless it wants double precision,
// while others wait for a later stage:
//   TRIANGLES          defined: an invocation does a small triangle in double precision
//   CUT, TILES, UNCUT  defined: a workgroup does tiles of a large triangle, an invocation a row of a tile
//   fragments          with DEFER_TO_FRAGMENTS defined in the first stage, storage buffer 3 begins with the
//                      arguments of an indirect draw, six vertices a large triangle, then come their ids
// With CLASSIFY defined in the first stage small triangles wait too, for the stage
//   REST            defined: an invocation does a small triangle
// The stages are there because renderers in software run all of a shader, whatever its conditions and returns.
// So the first one has no branch around what is to be done for every triangle.
//
// CutoffArea triangles whose bounds have more columns than this are large; negative: all are

uniform float CutoffArea;

#ifdef DEFER_TO_FRAGMENTS
layout(std430, binding = 3) buffer Deferred
{
  uint NumberOfVertices;
  uint NumberOfInstances;
  uint FirstVertex;
  uint FirstInstance;
  uint DeferredTriangles[];
};
#endif

#if !defined(CUT) && !defined(TILES) && !defined(UNCUT)

#ifdef TRIANGLES
#define TRIANGLE_OVERLAP FarOverlap
#else
#define TRIANGLE_OVERLAP NearOverlap
#endif

void visitTriangle(Facet f, TRIANGLE_OVERLAP overlap)
{
  // Columns and their voxels in one loop, so that neighbouring invocations differ by their sums only.
  ivec2 column = overlap.First.xy;
  ivec2 voxels = voxelsOfColumn(overlap, column.x, column.y);
  while (column.y < overlap.End.y)
  {
    if (voxels.x < voxels.y && overlapsVoxel(overlap, column.x, column.y, voxels.x))
    {
      visit(f, ivec3(column, voxels.x));
    }
    ++voxels.x;
    if (voxels.x >= voxels.y)
    {
      column = column.x + 1 < overlap.End.x ? ivec2(column.x + 1, column.y)
                                            : ivec2(overlap.First.x, column.y + 1);
      voxels = voxelsOfColumn(overlap, column.x, column.y);
    }
  }
}

#endif

#if defined(CUT) || defined(TILES) || defined(UNCUT)

void rectangleOf(uint triangle, out ivec2 first, out ivec2 end)
{
  Facet f;
  bool exists = facetOf(triangle, f);
  first = exists ? f.First.xy : ivec2(0);
  end = exists ? f.End.xy : ivec2(0);
}

void doTile(uint triangle, uvec2 tile)
{
  Facet f;
  facetOf(triangle, f);
  ivec2 corner = f.First.xy + ivec2(tile * TILE_SIZE);
  int v = corner.y + int(gl_LocalInvocationID.x);
  visitRow(f, v, corner.x, v < f.End.y ? min(corner.x + int(TILE_SIZE), f.End.x) : corner.x);
}

#elif defined(TRIANGLES)

void main()
{
  uint triangle;
  Facet f;
  if (waitingTriangle(triangle) && facetOf(triangle, f))
  {
    FarOverlap overlap;
    setUpOverlap(overlap, f, Margin);
    visitTriangle(f, overlap);
  }
}

#else

void deferLarge(uint triangle)
{
#ifdef DEFER_TO_FRAGMENTS
  const uint verticesPerTriangle = 6u;
  uint vertex = atomicAdd(NumberOfVertices, verticesPerTriangle);
  DeferredTriangles[vertex / verticesPerTriangle] = triangle;
#else
  enqueueLarge(triangle);
#endif
}

#ifdef REST

void main()
{
  uint triangle;
  Facet f;
  if (restTriangle(triangle) && facetOf(triangle, f))
  {
    NearOverlap overlap;
    setUpOverlap(overlap, f, float(NEAR_MARGIN + Margin));
    visitTriangle(f, overlap);
  }
}

#else

void main()
{
  uint triangle;
  Facet f;
  bool exists = triangleOfInvocation(triangle);
  bool overlaps = facetOf(triangle, f) && exists;
  bool isLarge = columnsOf(f) > CutoffArea;
  if (overlaps && isLarge)
  {
    deferLarge(triangle);
  }
  if (overlaps && !isLarge && !f.Near)
  {
    enqueueTriangle(triangle);
  }
  bool isSmall = overlaps && !isLarge && f.Near;
#ifdef CLASSIFY
  if (isSmall)
  {
    enqueueRest(triangle);
  }
#else
  NearOverlap overlap;
  setUpOverlap(overlap, f, float(NEAR_MARGIN + Margin));
  overlap.End = isSmall ? overlap.End : overlap.First;
  visitTriangle(f, overlap);
#endif
}

#endif

#endif
