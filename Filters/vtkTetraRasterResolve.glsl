// From layers of one texel a voxel to the words of a slicemap; a kernel of vtkSlicemapKernel.
//
// Layers      the render target, a layer a slice
// TileFirst   the voxel (x, y, z) at texel (0, 0) of layer 0, counted from the first voxel of the grid
// Columns     number of voxels of the grid along x

uniform usampler2DArray Layers;
uniform ivec3 TileFirst;
uniform int Columns;

uint kernel(uvec3 word)
{
  int x = int(word.x * WORD_BITS);
  ivec3 texel = ivec3(x, word.yz) - TileFirst;
  int end = min(Columns - x, 32);
  uint bits = 0u;
  for (int i = 0; i < end; ++i)
  {
    bits |= texelFetch(Layers, texel + ivec3(i, 0, 0), 0).x << uint(i);
  }
  return bits;
}
