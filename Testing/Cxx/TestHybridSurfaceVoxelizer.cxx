// Proves that surfaces are voxelized exactly: 26-separating against brute force over triangles and
// closed voxels, 6-separating against its definition; that no flood from outside passes a closed
// surface; that all strategies and both backends give the same voxels bit for bit, and parts of the
// grid those of the whole.

#include "VoxelSurfaceTests.h"
#include "VoxelTestMeshes.h"

#include <vtkImageData.h>
#include <vtkPolyData.h>

#include <cstdlib>

using namespace VoxelSolidTests;
using namespace VoxelSurfaceTests;
using namespace VoxelTestMeshes;

namespace
{
constexpr int Seed = 31;

bool TestShapes()
{
  const Mesh knot = TorusKnot(40.0, 16, 96);
  bool good = true;
  for (const auto& [name, mesh] : std::vector<std::pair<std::string, Mesh>>{
         { "knot", knot },
         { "knot in double precision", WithDoublePrecision(knot) },
         { "knot of strips", AsStrips(knot) },
         { "knot on centres and faces", OnLattice(knot, 0.5) },
         { "tetrahedra, seed 31", RandomTetrahedra(Seed, 40, 60.0) },
         { "slivers, seed 31", RandomSlivers(Seed, 100, 60.0) },
         { "knot with degenerate triangles, seed 31", WithDegenerates(knot, Seed, 100) },
         { "open knot, seed 31", WithHoles(knot, Seed, 200) },
         { "box", Box({ 0.1, 0.2, 0.3 }, { 20.7, 30.1, 40.9 }) },
         { "prism of polygons", StarPrism({ 33, 33, 33 }, 28.0, 40.0, 9) },
       })
  {
    good &= CheckSurface(name, mesh, MakeGridAround(mesh, 60));
    good &= CheckSurface(name + " rotated", Rotated(mesh), MakeGridAround(mesh, 60));
  }
  return good;
}

bool TestSizesOfTriangles()
{
  // From a hundredth of a voxel to some hundred voxels; near and beyond the limits of single
  // precision.
  bool good = true;
  for (const int resolution : { 4, 8, 12, 24, 48 })
  {
    const Mesh sphere = Rotated(Sphere({ 0, 0, 0 }, 100.0, resolution));
    good &=
      CheckSurface("sphere of " + std::to_string(resolution), sphere, MakeGridAround(sphere, 150));
  }
  good &= CheckSurface("huge tetrahedra, seed 31", RandomHugeTetrahedra(Seed, 10, 60.0, 10.0),
    MakeGrid({ 0, 69, 0, 60, 0, 80 }, { 0.1, 0.2, 0.3 }, { 1, 1, 1 }));
  return good;
}

bool TestGrids()
{
  const Mesh knot = Rotated(TorusKnot(20.0, 10, 60));
  bool good = true;
  good &= CheckSurface(
    "not from zero", knot, MakeGrid({ -20, 29, 7, 51, -40, 3 }, { 3, -25, 12 }, { 0.7, 0.8, 0.9 }));
  good &= CheckSurface("rotated grid", knot,
    MakeGrid({ 2, 40, -9, 31, 0, 40 }, { -1, 2, 3 }, { 0.5, 0.6, 0.7 },
      { 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1 }));
  good &= CheckSurface(
    "one voxel thin", knot, MakeGrid({ -40, 40, 0, 0, -40, 40 }, { 0, 0, 0 }, { 0.5, 0.5, 0.5 }));
  good &= CheckSurface("nothing there", knot,
    MakeGrid({ 0, 9, 0, 9, 0, 9 }, { 1000, 1000, 1000 }, { 1, 1, 1 }), false);
  const Mesh far = Moved(WithDoublePrecision(knot), { 3e6, -2e6, 1e6 });
  good &= CheckSurface("far away", far, MakeGridAround(far, 64));
  for (const double scale : { 1e-7, 1e7 })
  {
    const Mesh mesh = Moved(knot, { 0, 0, 0 }, scale);
    good &= CheckSurface("scale " + std::to_string(scale), mesh, MakeGridAround(mesh, 50));
  }
  return good;
}

bool TestFullQueue()
{
  // 400 triangles whose bounds have 1,024 tiles each: more than there is room for.
  return CheckStrategies("diagonals, seed 31", RandomDiagonals(Seed, 100, 2048.0),
    MakeGrid({ 0, 2047, 0, 2047, 0, 3 }, { 0.1, 0.2, 0.3 }, { 1, 1, 1 }));
}
}

int TestHybridSurfaceVoxelizer(int argc, char* argv[])
{
  bool good = TestShapes();
  good &= TestSizesOfTriangles();
  good &= TestGrids();
  good &= TestFullQueue();
  const Mesh bunny = ReadPLY("bunny_7k.ply", argc, argv);
  good &= bunny && CheckSurface("bunny_7k.ply", bunny, MakeGridAround(bunny, 64)) &&
    CheckSeparation("bunny_7k.ply", bunny, MakeGridAround(bunny, 64)) &&
    CheckSurfaceParts("bunny_7k.ply", bunny, MakeGridAround(bunny, 64), Seed);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
