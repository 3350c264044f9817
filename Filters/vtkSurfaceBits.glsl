// What becomes of the voxels that triangles overlap: their bits are set.
//
// Follows vtkSlicemapLayout.glsl and vtkSurfaceFacet.glsl.
//
// REMOVE  defined when the bits are cleared instead
// storage buffer 0 holds the words of the slicemap from slice First.z on

uniform ivec3 GridFirst;
uniform uint WordsPerRow;
uniform uint RowsPerSlice;

layout(std430, binding = 0) buffer Slicemap
{
  uint Words[];
};

void visit(Facet f, ivec3 local)
{
  ivec3 voxel = voxelOf(f, local);
  uvec3 at = uvec3(voxel.xy - GridFirst.xy, voxel.z - First.z);
  uint word = slicemapWord(at, WordsPerRow, RowsPerSlice);
#ifdef REMOVE
  atomicAnd(Words[word], ~slicemapBit(at.x));
#else
  atomicOr(Words[word], slicemapBit(at.x));
#endif
}
