// Proves that grids beyond one render target, one pass or one workgroup row are equal to the
// reference, and that every part of a grid asked for by update extent equals that part of the
// whole, bit for bit.

#include "VoxelSolidTests.h"
#include "VoxelTestMeshes.h"

#include <vtkImageData.h>
#include <vtkPolyData.h>

#include <cstdlib>
#include <iostream>

using namespace VoxelSolidTests;
using namespace VoxelTestMeshes;

namespace
{
/// A box that fills the grid: columns longer than loops of renderers in software.
bool TestLongColumns()
{
  constexpr int longest = 100000;
  bool good = true;
  for (const int axis : { 0, 1, 2 })
  {
    std::array<int, 3> n{ 3, 3, 3 };
    n[axis] = longest;
    const Mesh box = Box({ -0.5, -0.5, -0.5 }, { n[0] - 0.5, n[1] - 0.5, n[2] - 0.5 });
    const auto grid = MakeGrid({ 0, n[0] - 1, 0, n[1] - 1, 0, n[2] - 1 }, { 0, 0, 0 }, { 1, 1, 1 });
    const auto voxelizer = MakeVoxelizer(box, grid, vtkVoxelizer::BACKEND_COMPUTE, axis);
    voxelizer->Update();
    if (voxelizer->GetNumberOfFilledVoxels() != 9 * longest)
    {
      std::cerr << "columns of " << longest << " voxels along axis " << axis << ": "
                << voxelizer->GetNumberOfFilledVoxels() << " voxels\n";
      good = false;
    }
  }
  return good;
}
}

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
  // 400 triangles whose bounds have 1,024 tiles of columns each: more than the queue has room for.
  good &= CheckExact("diagonals seed 2", RandomDiagonals(seed, 100, 2048.0),
    MakeGrid({ 0, 2047, 0, 2047, 0, 3 }, { 0.1, 0.2, 0.3 }, { 1, 1, 1 }),
    { vtkVoxelizer::BACKEND_COMPUTE });
  good &= TestLongColumns();
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
