#include "VoxelFilterTests.h"

#include "VoxelSolidTests.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkMatrix3x3.h>
#include <vtkPointData.h>

#include <random>

using VoxelReference::Volume;

namespace VoxelFilterTests
{

std::vector<NamedGrid> AwkwardGrids()
{
  const std::array<double, 9> turned = { 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1 };
  const std::array<double, 9> mirrored = { 0, 1, 0, 1, 0, 0, 0, 0, 1 };
  const auto grid = [](const std::array<int, 6>& extent) {
    return VoxelSolidTests::MakeGrid(extent, { 0.25, -3, 10 }, { 0.5, 1.25, 2 });
  };
  return { { "one voxel", grid({ 7, 7, -3, -3, 0, 0 }) },
    { "37 x 11 x 7", grid({ 0, 36, 0, 10, 0, 6 }) },
    { "full words 128 x 8 x 4", grid({ 0, 127, 0, 7, 0, 3 }) },
    { "129 x 5 x 9 not from 0", grid({ -100, 28, 5, 9, -4, 4 }) },
    { "thin along x", grid({ 3, 3, 0, 40, -7, 13 }) },
    { "thin along y", grid({ -33, 33, 2, 2, 0, 16 }) },
    { "thin along z", grid({ 31, 94, 1, 19, 5, 5 }) }, { "a row", grid({ 1, 201, 0, 0, 0, 0 }) },
    { "turned",
      VoxelSolidTests::MakeGrid({ 2, 66, -1, 15, 0, 12 }, { 1, 2, 3 }, { 1, 2, 0.5 }, turned) },
    { "mirrored",
      VoxelSolidTests::MakeGrid({ 0, 32, 1, 17, 2, 9 }, { -1, 0, 5 }, { 1, 1, 1 }, mirrored) } };
}

Volume MakeVoxels(vtkImageData* grid, const std::function<bool(std::size_t offset)>& isSet)
{
  Volume voxels(VoxelReference::Grid::FromImage(grid));
  for (std::size_t offset = 0; offset < voxels.Grid.NumberOfVoxels(); ++offset)
  {
    voxels.Voxels[offset] = isSet(offset);
  }
  return voxels;
}

Volume RandomVoxels(vtkImageData* grid, unsigned int seed, double density)
{
  std::mt19937 random(seed);
  return MakeVoxels(grid, [&](std::size_t) { return random() < density * 4294967296.0; });
}

Image MakeMask(vtkImageData* grid, const Volume& voxels, int scalarType, bool cells)
{
  auto image = Image::New();
  int extent[6];
  grid->GetExtent(extent);
  image->SetSpacing(grid->GetSpacing());
  image->SetOrigin(grid->GetOrigin());
  image->SetDirectionMatrix(grid->GetDirectionMatrix());
  if (cells)
  {
    const double* h = grid->GetSpacing();
    const double half[3] = { -0.5 * h[0], -0.5 * h[1], -0.5 * h[2] };
    double shift[3];
    grid->GetDirectionMatrix()->MultiplyPoint(half, shift);
    const double* origin = grid->GetOrigin();
    image->SetOrigin(origin[0] + shift[0], origin[1] + shift[1], origin[2] + shift[2]);
    for (const int upper : { 1, 3, 5 })
    {
      ++extent[upper];
    }
  }
  image->SetExtent(extent);
  const auto scalars =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(scalarType));
  scalars->SetName("mask");
  scalars->SetNumberOfTuples(static_cast<vtkIdType>(voxels.Grid.NumberOfVoxels()));
  for (std::size_t offset = 0; offset < voxels.Grid.NumberOfVoxels(); ++offset)
  {
    const int value = scalarType == VTK_BIT ? 1 : 1 + static_cast<int>(offset % 100);
    scalars->SetTuple1(static_cast<vtkIdType>(offset), voxels.Voxels[offset] ? value : 0);
  }
  vtkDataSetAttributes* attributes = image->GetPointData();
  if (cells)
  {
    attributes = image->GetCellData();
  }
  attributes->SetScalars(scalars);
  return image;
}

}
