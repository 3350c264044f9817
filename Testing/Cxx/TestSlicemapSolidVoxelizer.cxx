// Proves that vtkSlicemapSolidVoxelizer samples closed meshes exactly, on both backends and along
// each axis: every voxel that differs from the reference lies on the surface within the stated
// tolerance, no column leaks, whatever the order, size, shape and number of the triangles.

#include "VoxelComparison.h"
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
    { "nested shells", NestedShells({ 30, 30, 30 }, { 28.0, 20.3, 11.1, 4.0 }) },
    { "star prism", Triangulated(StarPrism({ 30, 30, 30 }, 27.0, 40.0, 7)) },
  };
  bool good = true;
  for (const auto& [name, mesh] : meshes)
  {
    good &= CheckExact(name, mesh, MakeGridAround(mesh, 64));
  }
  return good;
}

bool TestTies()
{
  const int seed = 5;
  const auto grid = MakeGrid({ -3, 66, -3, 66, -3, 66 }, { 0, 0, 0 }, { 1, 1, 1 });
  bool good = CheckExact(
    "tetrahedra on voxel centres, seed 5", OnLattice(RandomTetrahedra(seed, 60, 60.0), 1.0), grid);
  good &= CheckExact("sphere on halves", OnLattice(Sphere({ 30, 30, 30 }, 25.0), 0.5), grid);
  good &= CheckExact("box on voxel centres", Box({ 4, 5, 6 }, { 20, 30, 40 }), grid);
  return good;
}

bool TestLargerThanTheGrid()
{
  const int seed = 3;
  const auto grid = MakeGrid({ 0, 32, 0, 69, 0, 128 }, { 0.13, 0.27, 0.41 }, { 1, 1, 0.5 });
  return CheckExact("huge tetrahedra, seed 3", RandomHugeTetrahedra(seed, 40, 60.0, 20.0), grid) &
    CheckExact("grid inside of a sphere", Sphere({ 20, 20, 20 }, 300.0), grid);
}

bool TestOrientedGrid(vtkPolyData* bunny)
{
  const double c = 0.8;
  const double s = 0.6;
  const double* bounds = bunny->GetBounds();
  const double spacing = (bounds[1] - bounds[0]) / 50.0;
  const auto grid = MakeGrid({ 100, 163, -200, -130, 7, 73 },
    { bounds[0] - 40 * spacing, bounds[2] + 170 * spacing, bounds[4] - 20 * spacing },
    { spacing, 0.9 * spacing, 1.1 * spacing }, { c, -s, 0, s, c, 0, 0, 0, 1 });
  return CheckExact("oriented grid", bunny, grid);
}

bool TestLargeTriangles()
{
  const auto grid = MakeGrid({ 0, 299, 0, 299, 0, 99 }, { 0.3, 0.4, 0.2 }, { 1, 1, 1 });
  bool good =
    CheckExact("box across the grid", Rotated(Box({ 20, 20, 10 }, { 270, 260, 80 })), grid);
  // More tiles of large triangles than their queue holds: the rest is done at once.
  const int seed = 8;
  const auto large = MakeGrid({ 0, 255, 0, 255, 0, 255 }, { 0.3, 0.4, 0.2 }, { 1, 1, 1 });
  good &= CheckExact("7000 huge tetrahedra, seed 8", RandomHugeTetrahedra(seed, 7000, 256.0, 2.0),
    large, { vtkVoxelizer::BACKEND_COMPUTE });
  return good;
}

bool TestWinding()
{
  constexpr int rule = vtkSlicemapSolidVoxelizer::FILL_RULE_NON_ZERO;
  const int seed = 21;
  const auto grid = MakeGrid({ 0, 69, 0, 65, 0, 62 }, { -2.1, -2.2, -2.3 }, { 1, 1, 1 });
  const std::vector<int> both(Backends.begin(), Backends.end());
  return CheckExact("union of spheres, seed 21", RandomSpheres(seed, 12, 60.0), grid, both, rule) &
    CheckExact("union of tetrahedra, seed 21", RandomTetrahedra(seed, 50, 60.0), grid, both, rule);
}
}

int TestSlicemapSolidVoxelizer(int argc, char* argv[])
{
  const Mesh bunny = ReadPLY("bunny_7k.ply", argc, argv);
  if (!bunny)
  {
    std::cerr << "bunny_7k.ply is missing\n";
    return EXIT_FAILURE;
  }
  bool good = TestClosedMeshes(bunny);
  good &= TestTies();
  good &= TestLargerThanTheGrid();
  good &= TestOrientedGrid(bunny);
  good &= TestLargeTriangles();
  good &= TestWinding();
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
