// Proves that grids beyond one render target, one pass or one workgroup row are equal to the
// reference, and that every part of a grid asked for by update extent equals that part of the
// whole, bit for bit.

#include "VoxelSolidTests.h"
#include "VoxelTestMeshes.h"

#include <vtkImageData.h>
#include <vtkPolyData.h>

#include <cstdlib>

using namespace VoxelSolidTests;
using namespace VoxelTestMeshes;

int TestSolidTiling(int /*argc*/, char* /*argv*/[])
{
  const int seed = 2;
  bool good = true;
  const Mesh soup = RandomTetrahedra(seed, 30, 1.0);
  for (const auto& n : std::vector<std::array<int, 3>>{
         { 2050, 40, 33 }, { 40, 2050, 33 }, { 33, 40, 2100 }, { 1100, 1030, 20 } })
  {
    const auto grid = MakeGrid({ 0, n[0] - 1, 0, n[1] - 1, 0, n[2] - 1 },
      { 0.3 / n[0], 0.4 / n[1], 0.2 / n[2] }, { 1.0 / n[0], 1.0 / n[1], 1.0 / n[2] });
    good &= CheckExact("soup seed 2 at " + std::to_string(n[0]) + " x " + std::to_string(n[1]) +
        " x " + std::to_string(n[2]),
      soup, grid);
  }
  const Mesh knot = TorusKnot(40.0, 16, 96);
  const auto grid = MakeGridAround(knot, 100);
  for (const int backend : Backends)
  {
    for (const int axis : { 0, 1, 2 })
    {
      const auto voxelizer = MakeVoxelizer(knot, grid, backend, axis);
      // A part of a column need not be closed.
      voxelizer->CheckWatertightOff();
      for (const int mode : { vtkSlicemapSolidVoxelizer::MODE_CENTER,
             vtkSlicemapSolidVoxelizer::MODE_OVER_CONSERVATIVE })
      {
        voxelizer->SetMode(mode);
        good &= CheckParts(NameOf(backend) + " axis " + std::to_string(axis), voxelizer, seed, 12);
      }
    }
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
