#include "VoxelSolidTests.h"

#include "VoxelComparison.h"
#include "VoxelSurfaceReference.h"
#include "VoxelTestMeshes.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <iostream>
#include <random>

using namespace VoxelReference;

namespace VoxelSolidTests
{

double ToleranceOf(int backend)
{
  return backend == vtkVoxelizer::BACKEND_COMPUTE ? ComputeTolerance : RasterTolerance;
}

std::string NameOf(int backend)
{
  return backend == vtkVoxelizer::BACKEND_COMPUTE ? "Compute" : "Raster";
}

vtkSmartPointer<vtkImageData> MakeGrid(const std::array<int, 6>& extent, const Vector& origin,
  const Vector& spacing, const std::array<double, 9>& direction)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(extent[0], extent[1], extent[2], extent[3], extent[4], extent[5]);
  image->SetOrigin(origin.data());
  image->SetSpacing(spacing.data());
  image->SetDirectionMatrix(direction.data());
  return image;
}

vtkSmartPointer<vtkImageData> MakeGridAround(vtkPolyData* mesh, int n)
{
  constexpr int margin = 2;
  const double* bounds = mesh->GetBounds();
  double longest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    longest = std::max(longest, bounds[2 * axis + 1] - bounds[2 * axis]);
  }
  const double spacing = longest / n;
  std::array<int, 6> extent{};
  Vector origin;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double length = bounds[2 * axis + 1] - bounds[2 * axis];
    extent[2 * axis + 1] = static_cast<int>(length / spacing) + 2 * margin;
    origin[axis] = bounds[2 * axis] - (margin - 0.4371) * spacing;
  }
  return MakeGrid(extent, origin, { spacing, spacing, spacing });
}

vtkSmartPointer<vtkSlicemapSolidVoxelizer> MakeVoxelizer(
  vtkPolyData* mesh, vtkImageData* grid, int backend, int axis)
{
  auto voxelizer = vtkSmartPointer<vtkSlicemapSolidVoxelizer>::New();
  voxelizer->SetInputData(mesh);
  voxelizer->SetReferenceImage(grid);
  voxelizer->SetBackend(backend);
  voxelizer->SetColumnAxis(axis);
  return voxelizer;
}

bool CheckExact(const std::string& name, vtkPolyData* mesh, vtkImageData* grid,
  const std::vector<int>& backends, int fillRule)
{
  const auto rule = fillRule == vtkSlicemapSolidVoxelizer::FILL_RULE_NON_ZERO ? FillRule::NonZero
                                                                              : FillRule::Parity;
  bool good = true;
  for (const Axis axis : AllAxes)
  {
    const int column = AxisOrder(axis).C;
    const Volume expected = SolidReference(mesh, Grid::FromImage(grid), axis, rule);
    for (const int backend : backends)
    {
      const std::string label = name + ", " + NameOf(backend) + ", columns along " + "xyz"[column];
      const auto voxelizer = MakeVoxelizer(mesh, grid, backend, column);
      voxelizer->SetFillRule(fillRule);
      voxelizer->Update();
      good &=
        Report(label, Compare(voxelizer->GetOutput(), expected), mesh, ToleranceOf(backend), axis);
      if (voxelizer->GetUsedBackend() != backend)
      {
        std::cerr << label << ": ran on backend " << voxelizer->GetUsedBackend() << "\n";
        good = false;
      }
      if (voxelizer->GetNumberOfLeakingColumns() != 0)
      {
        std::cerr << label << ": " << voxelizer->GetNumberOfLeakingColumns() << " columns leak\n";
        good = false;
      }
    }
  }
  return good;
}

bool CheckConservative(const std::string& name, vtkPolyData* mesh, vtkImageData* image)
{
  constexpr double rasterMargin = 1e-2;
  const Grid grid = Grid::FromImage(image);
  bool good = true;
  for (const int backend : Backends)
  {
    const bool compute = backend == vtkVoxelizer::BACKEND_COMPUTE;
    const Volume touched =
      TouchedVoxelsReference(mesh, grid, DefaultThreads, compute ? NearMargin : rasterMargin);
    // Voxels that the surface does not come near are solid or not whatever the rounding.
    const Volume solid = SolidReference(mesh, grid);
    const auto voxelizer =
      MakeVoxelizer(mesh, image, backend, vtkSlicemapSolidVoxelizer::COLUMN_AXIS_AUTO);
    const auto run = [&voxelizer](int mode)
    {
      voxelizer->SetMode(mode);
      voxelizer->Update();
      return OccupancyOf(voxelizer->GetOutput());
    };
    const std::string label = name + ", " + NameOf(backend);
    good &= ReportOverConservative(label + ", over-conservative",
      run(vtkSlicemapSolidVoxelizer::MODE_OVER_CONSERVATIVE), touched, solid);
    good &= ReportUnderConservative(label + ", under-conservative",
      run(vtkSlicemapSolidVoxelizer::MODE_UNDER_CONSERVATIVE), touched, solid);
    good &=
      ReportBoundary(label + ", boundary", run(vtkSlicemapSolidVoxelizer::MODE_BOUNDARY), touched);
  }
  return good;
}

bool CheckParts(const std::string& name, vtkVoxelizer* voxelizer, int seed, int count)
{
  voxelizer->UpdateWholeExtent();
  vtkNew<vtkImageData> whole;
  whole->DeepCopy(voxelizer->GetOutput());
  const Volume all = OccupancyOf(whole);
  std::mt19937 random(seed);
  bool good = true;
  for (int i = 0; i < count; ++i)
  {
    std::array<int, 6> part;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int low = all.Grid.Extent[2 * axis];
      const auto size = static_cast<unsigned int>(all.Grid.Size(axis));
      const int a = low + static_cast<int>(random() % size);
      const int b = low + static_cast<int>(random() % size);
      part[2 * axis] = std::min(a, b);
      part[2 * axis + 1] = std::max(a, b);
    }
    voxelizer->Modified();
    voxelizer->UpdateExtent(part.data());
    const Volume found = OccupancyOf(voxelizer->GetOutput());
    std::size_t different = found.Grid.Extent == part ? 0 : 1;
    for (std::size_t offset = 0; different == 0 && offset < found.Grid.NumberOfVoxels(); ++offset)
    {
      different += found.Voxels[offset] != all.At(found.Grid.VoxelAt(offset));
    }
    if (different)
    {
      std::cerr << name << ", seed " << seed << ": part " << i << " (" << part[0] << ", " << part[1]
                << ", " << part[2] << ", " << part[3] << ", " << part[4] << ", " << part[5]
                << ") differs from the whole\n";
      good = false;
    }
  }
  return good;
}

bool CheckLargeMeshes(int backend, int argc, char* argv[])
{
  bool good = true;
  for (const char* file : { "bunny.ply", "bunny_7k.ply", "dragon.ply", "armadillo.ply", "gears.ply",
         "fandisk.ply", "torusknot.ply" })
  {
    const VoxelTestMeshes::Mesh mesh = VoxelTestMeshes::ReadPLY(file, argc, argv);
    if (!mesh)
    {
      std::cerr << file << " is missing\n";
      return false;
    }
    const VoxelTestMeshes::Mesh rotated = VoxelTestMeshes::Rotated(mesh);
    for (const int n : { 64, 128, 256 })
    {
      const std::string name = file + (" at " + std::to_string(n));
      good &= CheckExact(name, mesh, MakeGridAround(mesh, n), { backend });
      good &= CheckExact(name + " rotated", rotated, MakeGridAround(rotated, n), { backend });
    }
  }
  return good;
}

}
