// Proves that the Raster backend is exact on real meshes: the closed ones of the large data, at 64,
// 128 and 256 voxels, along each axis, as they are and rotated. See VoxelSolidTests.h for the
// tolerance.

#include "VoxelSolidTests.h"
#include "VoxelTestMeshes.h"

#include <vtkImageData.h>
#include <vtkPolyData.h>

#include <cstdlib>
#include <iostream>

using namespace VoxelSolidTests;
using namespace VoxelTestMeshes;

int TestLargeMeshesRaster(int argc, char* argv[])
{
  bool good = true;
  for (const char* file : { "bunny.ply", "bunny_7k.ply", "dragon.ply", "armadillo.ply", "gears.ply",
         "fandisk.ply", "torusknot.ply" })
  {
    const Mesh mesh = ReadPLY(file, argc, argv);
    if (!mesh)
    {
      std::cerr << file << " is missing\n";
      return EXIT_FAILURE;
    }
    const Mesh rotated = Rotated(mesh);
    for (const int n : { 64, 128, 256 })
    {
      const std::string name = file + (" at " + std::to_string(n));
      const std::vector<int> backend = { vtkVoxelizer::BACKEND_RASTER };
      good &= CheckExact(name, mesh, MakeGridAround(mesh, n), backend);
      good &= CheckExact(name + " rotated", rotated, MakeGridAround(rotated, n), backend);
    }
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
