// Proves that grids of more words than a storage buffer holds work: 4096 x 4096 x 512 and
// 512 x 512 x 4096 voxels, as bits, equal to the parts of them that are voxelized on their own.

#include "VoxelSolidTests.h"
#include "VoxelTestMeshes.h"

#include <vtkBitArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

using namespace VoxelSolidTests;
using namespace VoxelTestMeshes;

namespace
{
bool TestGrid(vtkPolyData* mesh, const std::array<int, 3>& n, int backend, int axis)
{
  const double* bounds = mesh->GetBounds();
  VoxelReference::Vector spacing;
  for (int i = 0; i < 3; ++i)
  {
    spacing[i] = (bounds[2 * i + 1] - bounds[2 * i]) / n[i];
  }
  const auto grid = MakeGrid({ 0, n[0] - 1, 0, n[1] - 1, 0, n[2] - 1 },
    { bounds[0] + 0.5 * spacing[0], bounds[2] + 0.5 * spacing[1], bounds[4] + 0.5 * spacing[2] },
    spacing);
  const auto voxelizer = MakeVoxelizer(mesh, grid, backend, axis);
  voxelizer->SetOutputScalarTypeToBit();
  voxelizer->Update();
  vtkNew<vtkImageData> whole;
  whole->ShallowCopy(voxelizer->GetOutput());
  auto* bits = vtkBitArray::SafeDownCast(whole->GetPointData()->GetScalars());
  const std::string name = std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " +
    std::to_string(n[2]) + " along " + "xyz"[axis] +
    (backend == vtkVoxelizer::BACKEND_COMPUTE ? " by Compute" : " by Raster");
  if (!bits || voxelizer->GetNumberOfLeakingColumns() != 0)
  {
    std::cerr << name << ": no bits, or columns leak\n";
    return false;
  }
  bool good = true;
  vtkIdType filled = 0;
  for (const double place : { 0.1, 0.5, 0.77 })
  {
    std::array<int, 6> part;
    for (int i = 0; i < 3; ++i)
    {
      part[2 * i] = static_cast<int>(place * n[i]);
      part[2 * i + 1] = std::min(part[2 * i] + 100, n[i] - 1);
    }
    voxelizer->CheckWatertightOff();
    voxelizer->UpdateExtent(part.data());
    vtkImageData* found = voxelizer->GetOutput();
    auto* partBits = vtkBitArray::SafeDownCast(found->GetPointData()->GetScalars());
    vtkIdType different = 0;
    for (vtkIdType id = 0; id < partBits->GetNumberOfTuples(); ++id)
    {
      const vtkIdType nx = part[1] - part[0] + 1;
      const vtkIdType ny = part[3] - part[2] + 1;
      const vtkIdType x = part[0] + id % nx;
      const vtkIdType y = part[2] + id / nx % ny;
      const vtkIdType z = part[4] + id / (nx * ny);
      different += partBits->GetValue(id) != bits->GetValue((z * n[1] + y) * n[0] + x);
      filled += partBits->GetValue(id);
    }
    if (different)
    {
      std::cerr << name << ": " << different << " voxels differ in the part at " << place << "\n";
      good = false;
    }
  }
  if (filled == 0)
  {
    std::cerr << name << ": nothing is filled\n";
    good = false;
  }
  return good;
}
}

int TestLargeScale(int argc, char* argv[])
{
  const Mesh bunny = ReadPLY("bunny.ply", argc, argv);
  if (!bunny)
  {
    std::cerr << "bunny.ply is missing\n";
    return EXIT_FAILURE;
  }
  bool good = true;
  const auto testGrids = [&](int backend, int axis)
  {
    good &= TestGrid(bunny, { 4096, 4096, 512 }, backend, axis);
    good &= TestGrid(bunny, { 512, 512, 4096 }, backend, axis);
  };
  for (const int axis : { 0, 1, 2 })
  {
    testGrids(vtkVoxelizer::BACKEND_COMPUTE, axis);
  }
  testGrids(vtkVoxelizer::BACKEND_RASTER, 2);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
