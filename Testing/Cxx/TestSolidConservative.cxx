// Proves the conservative modes against brute force over all voxels and triangles:
// over-conservative and boundary miss no touched voxel, under-conservative holds none, and none is
// added that the surface does not come near.

#include "VoxelSolidTests.h"
#include "VoxelTestMeshes.h"

#include <vtkImageData.h>
#include <vtkPolyData.h>

#include <cstdlib>
#include <iostream>

using namespace VoxelSolidTests;
using namespace VoxelTestMeshes;

int TestSolidConservative(int argc, char* argv[])
{
  const int seed = 17;
  const Mesh knot = TorusKnot(40.0, 16, 96);
  bool good = true;
  for (const auto& [name, mesh] : std::vector<std::pair<std::string, Mesh>>{
         { "knot", knot },
         { "tetrahedra seed 17", RandomTetrahedra(seed, 40, 60.0) },
         { "slivers seed 17", RandomSlivers(seed, 100, 60.0) },
         { "knot with degenerate triangles", WithDegenerates(knot, seed, 100) },
         { "box", Box({ 0.1, 0.2, 0.3 }, { 20.7, 30.1, 40.9 }) },
       })
  {
    good &= CheckConservative(name, mesh, MakeGridAround(mesh, 60));
    good &= CheckConservative(name + " rotated", Rotated(mesh), MakeGridAround(mesh, 60));
  }
  good &= CheckConservative("huge tetrahedra, seed 17", RandomHugeTetrahedra(seed, 10, 60.0, 10.0),
    MakeGrid({ 0, 69, 0, 60, 0, 80 }, { 0.1, 0.2, 0.3 }, { 1, 1, 1 }));
  for (const char* file : { "bunny_7k.ply", "bunny.ply", "dragon.ply", "fandisk.ply" })
  {
    if (const Mesh mesh = ReadPLY(file, argc, argv))
    {
      for (const int n : { 64, 128, 256 })
      {
        good &=
          CheckConservative(file + (" at " + std::to_string(n)), mesh, MakeGridAround(mesh, n));
      }
    }
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
