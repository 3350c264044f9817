// Proves that the surfaces of real meshes are voxelized exactly at 64, 128 and 256 voxels, thick
// and thin, by all strategies, as they are and rotated; and that no flood from outside passes those
// that are closed.

#include "VoxelSurfaceTests.h"
#include "VoxelTestMeshes.h"

#include <vtkImageData.h>
#include <vtkPolyData.h>

#include <cstdlib>
#include <iostream>

using namespace VoxelSolidTests;
using namespace VoxelSurfaceTests;
using namespace VoxelTestMeshes;

int TestLargeSurfaces(int argc, char* argv[])
{
  bool good = true;
  for (const char* file : { "bunny.ply", "dragon.ply", "armadillo.ply", "gears.ply", "fandisk.ply",
         "torusknot.ply", "bunny_open.ply", "teapot.ply", "suzanne.ply" })
  {
    const Mesh mesh = ReadPLY(file, argc, argv);
    if (!mesh)
    {
      std::cerr << file << " is missing\n";
      return EXIT_FAILURE;
    }
    const Mesh rotated = Rotated(mesh);
    const bool isClosed = CountOpenEdges(mesh) == 0;
    for (const int n : { 64, 128, 256 })
    {
      const std::string name = file + (" at " + std::to_string(n));
      good &= CheckSurface(name, mesh, MakeGridAround(mesh, n));
      if (isClosed)
      {
        good &= CheckSeparation(name, mesh, MakeGridAround(mesh, n));
        good &= CheckSeparation(name + " rotated", rotated, MakeGridAround(rotated, n));
      }
    }
    good &= CheckSurface(file + std::string(" rotated"), rotated, MakeGridAround(rotated, 128));
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
