// Proves that the Compute backend is exact on real meshes: the closed ones of the large data, at
// 64, 128 and 256 voxels, along each axis, as they are and rotated. See VoxelSolidTests.h for the
// tolerance.

#include "VoxelSolidTests.h"

#include <cstdlib>

int TestLargeMeshesCompute(int argc, char* argv[])
{
  const bool good = VoxelSolidTests::CheckLargeMeshes(vtkVoxelizer::BACKEND_COMPUTE, argc, argv);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
