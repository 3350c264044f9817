#include "VoxelSurfaceTests.h"

#include "VoxelComparison.h"
#include "VoxelFlood.h"
#include "VoxelSurfaceReference.h"
#include "VoxelTestMeshes.h"

#include <vtkImageData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <iostream>
#include <memory>

using namespace VoxelReference;
using namespace VoxelSolidTests;

namespace VoxelSurfaceTests
{
namespace
{

constexpr std::array<int, 2> Separabilities = { 26, 6 };

std::string NameOf(const std::string& mesh, int separability)
{
  return mesh + ", " + std::to_string(separability) + "-separating";
}

/// Once to classify, once to use what was classified.
bool CheckPreClassified(
  const std::string& name, vtkHybridSurfaceVoxelizer* voxelizer, const Volume& expected)
{
  bool good = true;
  voxelizer->PreClassificationOn();
  for (const char* const run : { ", classifying", ", classified" })
  {
    voxelizer->Modified();
    voxelizer->Update();
    good &= Report(NameOf(name, voxelizer->GetSeparability()) + ", " +
        VoxelSolidTests::NameOf(voxelizer->GetUsedBackend()) + ", strategy " +
        std::to_string(voxelizer->GetStrategy()) + run,
      Compare(OccupancyOf(voxelizer->GetOutput()), expected));
  }
  voxelizer->PreClassificationOff();
  return good;
}

Volume Voxelize(vtkPolyData* mesh, vtkImageData* grid, int separability)
{
  const auto voxelizer = MakeSurfaceVoxelizer(mesh, grid, separability);
  voxelizer->Update();
  return OccupancyOf(voxelizer->GetOutput());
}

}

vtkSmartPointer<vtkHybridSurfaceVoxelizer> MakeSurfaceVoxelizer(
  vtkPolyData* mesh, vtkImageData* grid, int separability)
{
  auto voxelizer = vtkSmartPointer<vtkHybridSurfaceVoxelizer>::New();
  voxelizer->SetInputData(mesh);
  voxelizer->SetReferenceImage(grid);
  voxelizer->SetSeparability(separability);
  return voxelizer;
}

bool CheckStrategies(const std::string& name, vtkPolyData* mesh, vtkImageData* grid)
{
  using Voxelizer = vtkHybridSurfaceVoxelizer;
  constexpr double someAreLarge = 20.0;
  bool good = true;
  for (const int separability : Separabilities)
  {
    std::unique_ptr<Volume> first;
    const auto voxelizer = MakeSurfaceVoxelizer(mesh, grid, separability);
    for (const int backend : Backends)
    {
      voxelizer->SetBackend(backend);
      for (const auto& [strategy, cutoff] : std::vector<std::pair<int, double>>{
             { Voxelizer::STRATEGY_AUTO, -1.0 }, { Voxelizer::STRATEGY_TRIANGLE, -1.0 },
             { Voxelizer::STRATEGY_FRAGMENT, -1.0 }, { Voxelizer::STRATEGY_HYBRID, someAreLarge } })
      {
        voxelizer->SetStrategy(strategy);
        voxelizer->SetCutoffArea(cutoff);
        voxelizer->Update();
        Volume found = OccupancyOf(voxelizer->GetOutput());
        good &= CheckPreClassified(name, voxelizer, found);
        if (!first)
        {
          first = std::make_unique<Volume>(std::move(found));
          continue;
        }
        const Difference difference = Compare(found, *first);
        good &= Report(NameOf(name, separability) + ", " + VoxelSolidTests::NameOf(backend) +
            ", strategy " + std::to_string(strategy) + " against Auto",
          difference);
      }
    }
  }
  return good;
}

bool CheckSurface(
  const std::string& name, vtkPolyData* mesh, vtkImageData* grid, bool expectsVoxels)
{
  bool good = CheckStrategies(name, mesh, grid);
  const Grid reference = Grid::FromImage(grid);
  const auto triangles = VoxelTestMeshes::Triangulated(mesh);
  for (const int separability : Separabilities)
  {
    const Volume found = Voxelize(mesh, grid, separability);
    const Volume expected = separability == 26 ? TouchedVoxelsReference(triangles, reference)
                                               : ThinVoxelsReference(triangles, reference);
    good &= ReportBoundary(NameOf(name, separability), found, expected);
    if (expectsVoxels != (found.CountNonZero() > 0))
    {
      std::cerr << NameOf(name, separability) << ": " << found.CountNonZero() << " voxels\n";
      good = false;
    }
  }
  return good;
}

bool CheckSeparation(const std::string& name, vtkPolyData* mesh, vtkImageData* grid)
{
  bool good = true;
  const Volume inside = SolidReference(mesh, Grid::FromImage(grid));
  for (const int separability : Separabilities)
  {
    const Volume surface = Voxelize(mesh, grid, separability);
    const Volume reached = FloodFromOutside(surface, separability);
    std::size_t leaks = 0;
    std::size_t enclosed = 0;
    for (std::size_t i = 0; i < inside.Grid.NumberOfVoxels(); ++i)
    {
      const bool isEnclosed = inside.Voxels[i] && !surface.Voxels[i];
      enclosed += isEnclosed;
      leaks += isEnclosed && reached.Voxels[i];
    }
    if (leaks || !enclosed)
    {
      std::cerr << NameOf(name, separability) << ": a flood reaches " << leaks << " of " << enclosed
                << " voxels inside\n";
      good = false;
    }
  }
  return good;
}

bool CheckSurfaceParts(const std::string& name, vtkPolyData* mesh, vtkImageData* grid, int seed)
{
  constexpr int parts = 12;
  bool good = true;
  for (const int separability : Separabilities)
  {
    for (const int backend : Backends)
    {
      const auto voxelizer = MakeSurfaceVoxelizer(mesh, grid, separability);
      voxelizer->SetBackend(backend);
      good &= CheckParts(NameOf(name, separability) + ", " + VoxelSolidTests::NameOf(backend),
        voxelizer, seed, parts);
    }
  }
  return good;
}

}
