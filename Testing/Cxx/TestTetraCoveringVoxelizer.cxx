// Proves that vtkTetraCoveringVoxelizer gives the XOR of tetrahedra: of closed meshes the voxels of
// vtkSlicemapSolidVoxelizer and of the scanline on the CPU, n-gons taken as they are, concave and
// with holes; of open ones those of the tetrahedra flipped one by one; ties as documented; and that
// every part of a grid equals that part of the whole.

#include "VoxelComparison.h"
#include "VoxelSolidTests.h"
#include "VoxelTetraTests.h"

#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <cstdlib>
#include <iostream>

using namespace VoxelReference;
using namespace VoxelTestMeshes;
using VoxelSolidTests::MakeGrid;
using VoxelSolidTests::MakeGridAround;
using VoxelTetraTests::AllWays;
using VoxelTetraTests::CheckSame;
using VoxelTetraTests::MakeVoxelizer;
using VoxelTetraTests::NameOf;
using VoxelTetraTests::Voxelizer;

namespace
{
bool CheckClosed(const std::string& name, vtkPolyData* mesh, vtkImageData* grid)
{
  const Volume solid = VoxelTetraTests::Solid(mesh, grid);
  const Volume scanline = CrossingParityReference(mesh, Grid::FromImage(grid));
  bool good = true;
  for (const auto& way : AllWays)
  {
    const auto voxelizer = MakeVoxelizer(mesh, grid, way);
    good &= CheckSame(name + " beside vtkSlicemapSolidVoxelizer", voxelizer, solid, mesh);
    good &= CheckSame(name + " beside the scanline", voxelizer, scanline, mesh);
    if (voxelizer->GetNumberOfOpenEdges() != 0 || voxelizer->GetUsedBackend() != way.Backend)
    {
      std::cerr << name << ": " << voxelizer->GetNumberOfOpenEdges() << " open edges, backend "
                << voxelizer->GetUsedBackend() << " in place of " << way.Backend << "\n";
      good = false;
    }
  }
  return good;
}

bool TestClosedMeshes(vtkPolyData* bunny)
{
  const int seed = 11;
  const Mesh knot = TorusKnot(40.0, 24, 160);
  const std::vector<std::pair<std::string, Mesh>> meshes = {
    { "bunny_7k", bunny },
    { "bunny_7k rotated", Rotated(bunny) },
    { "knot as a soup in another order", Shuffled(Unshared(knot), seed) },
    { "knot in double precision", WithDoublePrecision(knot) },
    { "knot with degenerate triangles", WithDegenerates(knot, seed, 200) },
    { "knot as strips", AsStrips(knot) },
    { "tetrahedra seed 11", RandomTetrahedra(seed, 60, 60.0) },
    { "slivers seed 11", RandomSlivers(seed, 200, 60.0) },
    { "knot far away", Moved(WithDoublePrecision(TorusKnot(1.0, 16, 96)), { 1e6, -2e6, 3e6 }) },
    { "nested shells", NestedShells({ 30, 30, 30 }, { 28.0, 20.3, 11.1, 4.0 }) },
  };
  bool good = true;
  for (const auto& [name, mesh] : meshes)
  {
    good &= CheckClosed(name, mesh, MakeGridAround(mesh, 64));
  }
  const auto grid = MakeGrid({ 0, 32, 0, 69, 0, 128 }, { 0.13, 0.27, 0.41 }, { 1, 1, 0.5 });
  good &= CheckClosed("huge tetrahedra, seed 3", RandomHugeTetrahedra(3, 40, 60.0, 20.0), grid);
  good &= CheckClosed("grid inside of a sphere", Sphere({ 20, 20, 20 }, 300.0), grid);
  return good;
}

bool TestPolygons()
{
  const std::vector<std::tuple<std::string, Mesh, Mesh>> meshes = {
    { "concave ends", StarPrism({ 30, 30, 30 }, 27.0, 40.0, 9),
      Triangulated(StarPrism({ 30, 30, 30 }, 27.0, 40.0, 9)) },
    { "ends with bridged holes", HoledPrism({ 30, 30, 30 }, 20.0, 33.0, false),
      HoledPrism({ 30, 30, 30 }, 20.0, 33.0, true) },
    { "quadrilaterals", Rotated(QuadBox({ 3, 4, 5 }, { 50, 40, 60 })),
      Triangulated(Rotated(QuadBox({ 3, 4, 5 }, { 50, 40, 60 }))) },
  };
  bool good = true;
  for (const auto& [name, polygons, triangles] : meshes)
  {
    const auto grid = MakeGridAround(polygons, 70);
    const Volume expected = VoxelTetraTests::Solid(triangles, grid);
    for (const auto& way : AllWays)
    {
      good &= CheckSame(name, MakeVoxelizer(polygons, grid, way), expected, triangles);
    }
  }
  return good;
}

/// Open meshes, where the facets at the origin matter; closed ones, where they must not.
bool TestDefinition()
{
  const int seed = 17;
  const std::vector<std::pair<std::string, Mesh>> meshes = {
    { "sphere", Sphere({ 12, 12, 12 }, 11.0, 10) },
    { "sphere with holes, seed 17", WithHoles(Sphere({ 12, 12, 12 }, 11.0, 10), seed, 9) },
    { "soup with holes, seed 17", WithHoles(Unshared(RandomTetrahedra(seed, 12, 24.0)), seed, 7) },
    { "open star", WithHoles(StarPrism({ 12, 12, 12 }, 11.0, 15.0, 5), seed, 3) },
  };
  bool good = true;
  for (const auto& [name, mesh] : meshes)
  {
    const auto grid = MakeGridAround(mesh, 26);
    const Volume expected = VoxelTetraTests::XorOfTetrahedra(mesh, Grid::FromImage(grid));
    for (const auto& way : AllWays)
    {
      const auto voxelizer = MakeVoxelizer(mesh, grid, way);
      voxelizer->CheckWatertightOff();
      // Facets at the origin are part of the surface that voxels may lie on.
      const std::string label = name + ", " + NameOf(voxelizer);
      voxelizer->Update();
      const Difference difference = Compare(voxelizer->GetOutput(), expected);
      const std::size_t allowed =
        way.Method == Voxelizer::RASTER_LAYERS ? expected.CountNonZero() / 50 : 0;
      if (!difference.IsComparable() || difference.Count() > allowed)
      {
        std::cerr << label << ": " << difference.Summary() << "\n";
        good = false;
      }
    }
  }
  return good;
}

/// The mesh and the grid mirrored at the origin turn the rule for ties round. Where edges and
/// corners lie on voxel centres the columns' axis decides, which is one of the three.
bool CheckTies(const std::string& name, vtkPolyData* mesh)
{
  const int n = 40;
  const auto grid = MakeGrid({ -n, n, -n, n, -n, n }, { 0, 0, 0 }, { 1, 1, 1 });
  const Mesh mirrored = Moved(mesh, { 0, 0, 0 }, -1.0);
  const auto voxelizer = MakeVoxelizer(mesh, grid, vtkVoxelizer::BACKEND_COMPUTE);
  voxelizer->Update();
  const Volume found = OccupancyOf(voxelizer->GetOutput());
  Difference closest;
  for (const Axis axis : AllAxes)
  {
    const Volume lower = CrossingParityReference(mirrored, Grid::FromImage(grid), axis);
    Volume expected(lower.Grid);
    const std::size_t voxels = lower.Grid.NumberOfVoxels();
    for (std::size_t i = 0; i < voxels; ++i)
    {
      expected.Voxels[i] = lower.Voxels[voxels - 1 - i];
    }
    const Difference difference = Compare(found, expected);
    if (axis == Axis::X || difference.Count() < closest.Count())
    {
      closest = difference;
    }
  }
  return Report(name, closest);
}

bool TestTies()
{
  bool good = CheckTies("box on voxel centres", Box({ 4, -5, 6 }, { 20, 30, 40 }));
  good &= CheckTies("sphere on halves", OnLattice(Sphere({ 1, 2, 3 }, 25.0), 0.5));
  for (const auto& way : AllWays)
  {
    const auto box = MakeVoxelizer(Box({ 0, 0, 0 }, { 4, 4, 4 }),
      MakeGrid({ -2, 7, -2, 7, -2, 7 }, { 0, 0, 0 }, { 1, 1, 1 }), way);
    box->Update();
    const Volume voxels = OccupancyOf(box->GetOutput());
    for (std::size_t i = 0; i < voxels.Grid.NumberOfVoxels(); ++i)
    {
      bool inside = true;
      for (const int x : voxels.Grid.VoxelAt(i))
      {
        inside = inside && x > 0 && x <= 4;
      }
      if ((voxels.Voxels[i] != 0) != inside)
      {
        const Voxel v = voxels.Grid.VoxelAt(i);
        std::cerr << "box [0, 4]^3, " << NameOf(box) << ": wrong at " << v[0] << ", " << v[1]
                  << ", " << v[2] << "\n";
        return false;
      }
    }
  }
  return good;
}

bool TestComposite()
{
  const Mesh first = Sphere({ 10, 10, 10 }, 8.0);
  const Mesh second = StarPrism({ 30, 12, 10 }, 9.0, 15.0, 5);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, first);
  blocks->SetBlock(1, second);
  const Mesh both = Appended({ first, second });
  const auto grid = MakeGridAround(both, 50);
  bool good = true;
  for (const auto& way : AllWays)
  {
    const auto voxelizer = MakeVoxelizer(both, grid, way);
    voxelizer->SetInputDataObject(blocks);
    good &= CheckSame("composite", voxelizer, VoxelTetraTests::Solid(both, grid), both);
  }
  return good;
}

/// Grids beyond one render target, and longer than a texture has layers.
bool TestLargeGrids()
{
  const int seed = 2;
  const Mesh soup = RandomTetrahedra(seed, 30, 1.0);
  bool good = true;
  for (const auto& n : std::vector<std::array<int, 3>>{
         { 2050, 40, 33 }, { 40, 1100, 33 }, { 33, 40, 2100 }, { 1030, 1030, 70 } })
  {
    const auto grid = MakeGrid({ 0, n[0] - 1, 0, n[1] - 1, 0, n[2] - 1 },
      { 0.3 / n[0], 0.4 / n[1], 0.2 / n[2] }, { 1.0 / n[0], 1.0 / n[1], 1.0 / n[2] });
    const Volume expected = CrossingParityReference(soup, Grid::FromImage(grid));
    for (const auto& way : AllWays)
    {
      good &= CheckSame("soup seed 2 at " + std::to_string(n[0]) + " x " + std::to_string(n[1]) +
          " x " + std::to_string(n[2]),
        MakeVoxelizer(soup, grid, way), expected, soup);
    }
  }
  return good;
}

/// Both ways of rasterization draw the same sections.
bool TestRasterMethods(vtkPolyData* bunny)
{
  const auto voxelizer =
    MakeVoxelizer(bunny, MakeGridAround(bunny, 50), vtkVoxelizer::BACKEND_RASTER);
  voxelizer->SetRasterMethodToLayers();
  voxelizer->Update();
  const Volume layers = OccupancyOf(voxelizer->GetOutput());
  voxelizer->SetRasterMethodToSlices();
  voxelizer->Update();
  return Report("slices beside layers", Compare(voxelizer->GetOutput(), layers));
}

bool TestParts(vtkPolyData* bunny)
{
  const auto grid = MakeGridAround(bunny, 50);
  bool good = true;
  for (const auto& way : AllWays)
  {
    const auto voxelizer = MakeVoxelizer(bunny, grid, way);
    voxelizer->SetRotationModeToUniform();
    voxelizer->SetDisplacementAmplitude(0.01);
    voxelizer->SafeScaleToFitOn();
    const std::string name = "parts, " + NameOf(voxelizer);
    good &= VoxelSolidTests::CheckParts(name, voxelizer, 4, 6);
    voxelizer->SetShell(18);
    good &= VoxelSolidTests::CheckParts(name + ", shells", voxelizer, 5, 6);
    voxelizer->KeepInteriorOn();
    good &= VoxelSolidTests::CheckParts(name + ", labels", voxelizer, 6, 6);
  }
  return good;
}
}

int TestTetraCoveringVoxelizer(int argc, char* argv[])
{
  const Mesh bunny = ReadPLY("bunny_7k.ply", argc, argv);
  if (!bunny)
  {
    std::cerr << "bunny_7k.ply is missing\n";
    return EXIT_FAILURE;
  }
  bool good = TestClosedMeshes(bunny);
  good &= TestPolygons();
  good &= TestDefinition();
  good &= TestTies();
  good &= TestComposite();
  good &= TestLargeGrids();
  good &= TestRasterMethods(bunny);
  good &= TestParts(bunny);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
