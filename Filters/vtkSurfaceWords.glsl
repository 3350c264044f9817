// Where the voxels that triangles overlap are in a slicemap.
//
// Follows vtkSlicemapLayout.glsl and vtkSurfaceFacet.glsl.
//
// GridFirst                  the first voxel of the slicemap; its words are counted from slice First.z on
// WordsPerRow, RowsPerSlice  of the slicemap

uniform ivec3 GridFirst;
uniform uint WordsPerRow;
uniform uint RowsPerSlice;

// Read before any branch, since renderers in software read uniforms behind one number by number; max()
// keeps compilers from reading them where these are used instead.
ivec3 firstVoxel = ivec3(GridFirst.xy, First.z);
uint wordsPerRow = max(WordsPerRow, 1u);
uint rowsPerSlice = max(RowsPerSlice, 1u);

// A voxel's word, and its bit there.
struct Place
{
  uint Word;
  uint Bit;
};

Place placeOf(Facet f, ivec3 local)
{
  uvec3 at = uvec3(voxelOf(f, local) - firstVoxel);
  return Place(slicemapWord(at, wordsPerRow, rowsPerSlice), slicemapBit(at.x));
}
