// Proves the reference implementations that all other tests trust:
// - the scanline's voxels are those of exact arithmetic, voxel by voxel, on each axis and under
// both
//   fill rules, for meshes in general position, on ties and without area;
// - solids are half open; a 1 mm cube at 0.25 mm has 4^3 voxels, wherever the grid begins;
// - the result does not depend on how a mesh is stored, on the threads, or on the grid's extent;
//   it depends on the axis at the surface alone; no closed mesh leaks;
// - distances and touched voxels are those of brute force and of polygon clipping;
// - thin voxels are those of exact arithmetic and of hand, and touched; thin surfaces separate over
//   faces, touched ones over corners;
// - floods go over faces, edges and corners as told;
// - the comparison finds single differences, leaks and images that do not fit.

#include "VoxelComparison.h"
#include "VoxelExactInside.h"
#include "VoxelFlood.h"
#include "VoxelReference.h"
#include "VoxelSurfaceReference.h"
#include "VoxelTestMeshes.h"

#include <vtkBitArray.h>
#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkMassProperties.h>
#include <vtkMinimalStandardRandomSequence.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace VoxelReference;
using VoxelTestMeshes::Mesh;

namespace
{

using NamedMesh = std::pair<std::string, Mesh>;

const std::array<FillRule, 2> AllRules = { FillRule::Parity, FillRule::NonZero };

bool Check(const std::string& name, bool isTrue)
{
  if (!isTrue)
  {
    std::cerr << name << " does not hold\n";
  }
  return isTrue;
}

template <typename Value>
bool CheckEqual(const std::string& name, const Value& found, const Value& expected)
{
  if (found != expected)
  {
    std::cerr << name << ": found " << found << ", expected " << expected << '\n';
  }
  return found == expected;
}

std::string Name(const std::string& mesh, Axis column, FillRule rule = FillRule::Parity)
{
  return mesh + ", columns along " + "xyz"[static_cast<int>(column)] +
    (rule == FillRule::Parity ? ", parity" : ", nonzero");
}

/// The voxels (i, j, k) are the points (i, j, k).
Grid UnitGrid(const std::array<int, 6>& extent)
{
  return Grid::FromSpacing(extent, { 0, 0, 0 }, { 1, 1, 1 });
}

template <typename Predicate>
Volume VolumeWhere(const Grid& grid, Predicate&& predicate)
{
  Volume result(grid);
  for (std::size_t offset = 0; offset < grid.NumberOfVoxels(); ++offset)
  {
    result.Voxels[offset] = predicate(grid.VoxelAt(offset));
  }
  return result;
}

/// Closed meshes whose points are multiples of 1/4: every decision is exact in double.
std::vector<NamedMesh> LatticeMeshes()
{
  using namespace VoxelTestMeshes;
  const Mesh sphere = Moved(Sphere({ 0, 0, 0 }, 8.3, 20), { 9.1, 10.3, 9.7 });
  return {
    { "tetrahedra on voxel centres, seed 1", OnLattice(RandomTetrahedra(1, 40, 20), 1.0) },
    { "tetrahedra on voxel faces, seed 2", OnLattice(RandomTetrahedra(2, 40, 20), 0.5) },
    { "tetrahedra on quarters, seed 3", OnLattice(RandomTetrahedra(3, 40, 20), 0.25) },
    { "tetrahedra on coarse points, seed 4", OnLattice(RandomTetrahedra(4, 40, 20), 5.0) },
    { "huge tetrahedra on voxel centres, seed 5",
      OnLattice(RandomHugeTetrahedra(5, 20, 20, 50), 1.0) },
    { "sphere on voxel centres", OnLattice(sphere, 1.0) },
    { "sphere on voxel faces", OnLattice(sphere, 0.5) },
    { "sphere on even points", OnLattice(sphere, 2.0) },
    { "quad box", QuadBox({ 2, 3, 4 }, { 14, 15.5, 16 }) },
    { "flat box", Box({ 2, 3, 4 }, { 14, 15, 4 }) },
    { "star prism on voxel centres", OnLattice(StarPrism({ 10, 10, 10 }, 9, 12, 7), 1.0) },
    { "degenerate triangles on voxel centres, seed 6",
      WithDegenerates(OnLattice(sphere, 1.0), 6, 200) },
  };
}

/// Closed meshes in general position or nearly without area.
std::vector<NamedMesh> GeneralMeshes()
{
  using namespace VoxelTestMeshes;
  const Mesh sphere = Sphere({ 10.1, 9.8, 10.2 }, 8.3, 24);
  return {
    { "tetrahedra, seed 11", RandomTetrahedra(11, 60, 20) },
    { "slivers, seed 12", RandomSlivers(12, 300, 20) },
    { "huge tetrahedra, seed 13", RandomHugeTetrahedra(13, 30, 20) },
    { "spheres, seed 14", RandomSpheres(14, 6, 20) },
    { "crumpled sphere, seed 15", Perturbed(sphere, 15, 3.0) },
    { "nearly on voxel centres, seed 16",
      Perturbed(OnLattice(RandomTetrahedra(16, 40, 20), 1.0), 16, 1e-13) },
    { "walls nearly through voxel centres, seed 17",
      Perturbed(Triangulated(OnLattice(StarPrism({ 10, 10, 10 }, 9, 12, 7), 1.0)), 17, 3e-15) },
    { "sphere nearly on even points, seed 18", Perturbed(OnLattice(sphere, 2.0), 18, 3e-15) },
    { "rotated box", Rotated(Box({ 3, 4, 5 }, { 15, 16, 17 })) },
    { "star prism", Rotated(StarPrism({ 10, 10, 10 }, 9, 12, 7)) },
    { "nested shells", NestedShells({ 10.1, 9.8, 10.2 }, { 9, 7, 5, 3 }) },
    { "torus knot", Moved(TorusKnot(20, 8, 120), { 10, 10, 10 }) },
  };
}

/// Compares the scanline with exact arithmetic at random voxels.
Difference CompareWithExact(vtkPolyData* mesh, const Grid& grid, Axis column, FillRule rule)
{
  const Volume found = SolidReference(mesh, grid, column, rule);
  const IndexMesh triangles(mesh, grid);
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->Initialize(17);
  Difference difference;
  difference.Grid = grid;
  for (difference.Compared = 0; difference.Compared < 1500; ++difference.Compared)
  {
    Voxel voxel;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double index =
        random->GetNextRangeValue(grid.Extent[2 * axis], grid.Extent[2 * axis + 1] + 1.0);
      voxel[axis] = static_cast<int>(std::floor(index));
    }
    const bool expected = PointInMeshExact(triangles, voxel, column, rule);
    difference.Expected += expected ? 1 : 0;
    if (expected != (found.At(voxel) != 0))
    {
      (expected ? difference.Missing : difference.Extra).push_back(voxel);
    }
  }
  return difference;
}

bool TestScanlineIsExact()
{
  bool ok = true;
  const Grid grid = UnitGrid({ -2, 22, -1, 21, -2, 23 });
  const auto testAll = [&](const std::vector<NamedMesh>& meshes, double tolerance)
  {
    for (const auto& [name, mesh] : meshes)
    {
      ok &= CheckEqual("Open edges of " + name, VoxelTestMeshes::CountOpenEdges(mesh), 0);
      const Volume alongZ = CrossingParityReference(mesh, grid, Axis::Z);
      for (Axis column : AllAxes)
      {
        ok &= Report(Name(name + " as along z", column),
          Compare(CrossingParityReference(mesh, grid, column), alongZ), mesh, 1e-11, column);
        for (FillRule rule : AllRules)
        {
          const Difference difference = CompareWithExact(mesh, grid, column, rule);
          ok &= Report(Name(name, column, rule), difference, mesh, tolerance, column);
        }
      }
    }
  };
  testAll(LatticeMeshes(), 0.0);
  testAll(GeneralMeshes(), 1e-11);
  return ok;
}

bool TestBoxesAreHalfOpen()
{
  bool ok = true;
  const auto isWithin = [](const Voxel& voxel, int low, int end)
  {
    return std::all_of(
      voxel.begin(), voxel.end(), [&](int index) { return low <= index && index < end; });
  };
  for (Axis column : AllAxes)
  {
    for (FillRule rule : AllRules)
    {
      const Grid unit = UnitGrid({ -2, 6, -3, 7, -1, 5 });
      const Volume zeroToThree =
        VolumeWhere(unit, [&](const Voxel& voxel) { return isWithin(voxel, 0, 4); });
      for (const Mesh& box : { VoxelTestMeshes::Box({ 0, 0, 0 }, { 4, 4, 4 }),
             VoxelTestMeshes::QuadBox({ 0, 0, 0 }, { 4, 4, 4 }) })
      {
        ok &= Report(Name("box 0 to 4", column, rule),
          Compare(SolidReference(box, unit, column, rule), zeroToThree));
      }

      // A cube of 1 mm at 0.25 mm, from centres on its faces to faces on its faces.
      const Mesh cube = VoxelTestMeshes::Box({ 0, 0, 0 }, { 1, 1, 1 });
      for (double start : { 0.0, 0.03125, 0.125, 0.1875, -1000.0 })
      {
        const int first = start < 0 ? 4000 : 0;
        const Grid fine =
          Grid::FromSpacing({ first - 3, first + 9, first - 2, first + 9, first - 5, first + 8 },
            { start, start, start }, { 0.25, 0.25, 0.25 });
        ok &= CheckEqual<std::size_t>(Name("1 mm at 0.25 mm", column, rule),
          SolidReference(cube, fine, column, rule).CountNonZero(), 64);
      }
    }

    // A box anywhere holds a product of three counts.
    vtkNew<vtkMinimalStandardRandomSequence> random;
    random->Initialize(21);
    const Grid grid = UnitGrid({ 0, 69, 0, 40, 0, 30 });
    for (int number = 0; number < 20; ++number)
    {
      Vector low;
      Vector high;
      std::size_t expected = 1;
      for (int axis = 0; axis < 3; ++axis)
      {
        low[axis] = random->GetNextRangeValue(-5.0, 20.0);
        high[axis] = low[axis] + random->GetNextRangeValue(0.0, 60.0);
        const double begin = std::max(0.0, std::ceil(low[axis]));
        const double end = std::min<double>(grid.Size(axis), std::ceil(high[axis]));
        expected *= static_cast<std::size_t>(std::max(0.0, end - begin));
      }
      ok &= CheckEqual(Name("box " + std::to_string(number) + ", seed 21", column),
        CrossingParityReference(VoxelTestMeshes::Box(low, high), grid, column).CountNonZero(),
        expected);
    }
  }
  return ok;
}

bool TestVolumesAndAxes(int argc, char* argv[])
{
  using namespace VoxelTestMeshes;
  std::vector<NamedMesh> meshes = {
    { "sphere", Sphere({ 1, 2, 3 }, 5, 64) },
    { "torus knot", TorusKnot(20, 32, 512) },
    { "rotated star prism", Triangulated(Rotated(StarPrism({ 0, 0, 0 }, 9, 12, 7))) },
    { "tetrahedron", Tetrahedron({ { { 0, 0, 0 }, { 7, 1, 0.5 }, { 2, 8, 1 }, { 1, 2, 9 } } }) },
  };
  const Mesh bunny = ReadPLY("bunny_7k.ply", argc, argv);
  if (!Check("bunny_7k.ply is in a directory given with -D", bunny != nullptr))
  {
    return false;
  }
  meshes.emplace_back("bunny", bunny);
  meshes.emplace_back("rotated bunny", Rotated(bunny));

  bool ok = true;
  for (const auto& [name, mesh] : meshes)
  {
    double bounds[6];
    mesh->GetBounds(bounds);
    const Grid grid = Grid::AroundBounds(bounds, 100);
    vtkNew<vtkMassProperties> properties;
    properties->SetInputData(mesh);
    properties->Update();
    const double voxelsPerUnit = grid.Linear[0];
    const double volume = properties->GetVolume() * std::pow(voxelsPerUnit, 3.0);
    const double area = properties->GetSurfaceArea() * std::pow(voxelsPerUnit, 2.0);

    const Volume alongZ = CrossingParityReference(mesh, grid, Axis::Z);
    for (Axis column : AllAxes)
    {
      const Volume solid = CrossingParityReference(mesh, grid, column);
      // The errors of the voxels at the surface are independent enough to add up as a random walk.
      const double error = static_cast<double>(solid.CountNonZero()) - volume;
      ok &= Check(Name("volume of " + name, column), std::abs(error) < 3.0 * std::sqrt(area));
      ok &= Report(Name(name + " as along z", column), Compare(solid, alongZ), mesh, 1e-10);
      ok &= CheckEqual<std::size_t>(
        Name("open columns of " + name, column), CountColumnsOpenAtEnd(solid, column), 0);
      const Volume winding = CrossingNonZeroReference(mesh, grid, column);
      ok &= Report(Name(name, column, FillRule::NonZero), Compare(winding, solid));
    }
  }
  return ok;
}

bool TestStorageDoesNotMatter()
{
  using namespace VoxelTestMeshes;
  bool ok = true;
  const Grid grid = UnitGrid({ -2, 22, -1, 21, -2, 23 });
  std::vector<NamedMesh> meshes = LatticeMeshes();
  const std::vector<NamedMesh> general = GeneralMeshes();
  meshes.insert(meshes.end(), general.begin(), general.end());
  for (const auto& [name, mesh] : meshes)
  {
    const std::vector<NamedMesh> others = {
      { "unshared", Unshared(mesh) },
      { "shuffled", Shuffled(mesh, 31) },
      { "unshared and shuffled", Shuffled(Unshared(mesh), 32) },
      { "reversed", Reversed(mesh) },
      { "with degenerates", WithDegenerates(mesh, 33, 100) },
    };
    for (Axis column : AllAxes)
    {
      const Volume expected = CrossingParityReference(mesh, grid, column);
      for (const auto& [how, other] : others)
      {
        ok &= Report(Name(name + ", " + how, column),
          Compare(CrossingParityReference(other, grid, column), expected), mesh,
          how == "unshared" ? 0.0 : 1e-11);
      }
    }
  }

  const Mesh sphere = Sphere({ 10.1, 9.8, 10.2 }, 8.3);
  const Mesh strips = AsStrips(sphere);
  ok &= Check("strips were made", strips->GetNumberOfStrips() > 0);
  const Mesh star = StarPrism({ 10, 10, 10 }, 9, 12, 7);
  const Volume sphereVoxels = CrossingParityReference(sphere, grid);
  for (FillRule rule : AllRules)
  {
    ok &= Report("strips", Compare(SolidReference(strips, grid, Axis::Z, rule), sphereVoxels));
    ok &= Report("non-convex n-gons as ear-cut triangles",
      Compare(SolidReference(star, grid, Axis::Z, rule),
        SolidReference(Triangulated(star), grid, Axis::Z, rule)));
  }
  return ok;
}

bool TestExtentAndThreadsDoNotMatter()
{
  bool ok = true;
  const Mesh mesh =
    VoxelTestMeshes::Moved(VoxelTestMeshes::TorusKnot(130, 16, 300), { 66, 64, 20 });
  const Grid whole = UnitGrid({ -3, 133, -2, 131, -1, 41 });
  for (Axis column : AllAxes)
  {
    const Volume expected = CrossingParityReference(mesh, whole, column, 1);
    ok &= Check("the knot fills some voxels", expected.CountNonZero() > 1000);
    for (int threads : { 2, 3, 7 })
    {
      ok &= Report(Name("threads", column),
        Compare(CrossingParityReference(mesh, whole, column, threads), expected));
    }
    for (const std::array<int, 6>& extent :
      { std::array<int, 6>{ 20, 83, 10, 99, 5, 30 }, std::array<int, 6>{ 21, 85, 0, 128, 7, 33 },
        std::array<int, 6>{ 50, 50, 20, 90, 0, 40 }, std::array<int, 6>{ 0, 128, 64, 64, 0, 40 },
        std::array<int, 6>{ 0, 128, 0, 128, 21, 21 },
        std::array<int, 6>{ 40, 103, 30, 60, 15, 25 } })
    {
      const Grid part = UnitGrid(extent);
      const Volume cut =
        VolumeWhere(part, [&](const Voxel& voxel) { return expected.At(voxel) != 0; });
      for (FillRule rule : AllRules)
      {
        ok &= Report(
          Name("part", column, rule), Compare(SolidReference(mesh, part, column, rule), cut));
      }
    }
  }
  return ok;
}

bool TestFillRules()
{
  bool ok = true;
  const Grid grid = UnitGrid({ 0, 30, 0, 30, 0, 30 });
  const Mesh first = VoxelTestMeshes::Sphere({ 12, 13, 14 }, 9);
  const Mesh second = VoxelTestMeshes::Sphere({ 18, 16, 15 }, 10);
  const Mesh both = VoxelTestMeshes::Appended({ first, second });
  const Mesh minus = VoxelTestMeshes::Appended({ first, VoxelTestMeshes::Reversed(first) });
  for (Axis column : AllAxes)
  {
    const Volume a = CrossingParityReference(first, grid, column);
    const Volume b = CrossingParityReference(second, grid, column);
    const auto combined = [&](auto&& operation)
    {
      return VolumeWhere(
        grid, [&](const Voxel& voxel) { return operation(a.At(voxel), b.At(voxel)); });
    };
    ok &= Report(Name("two spheres", column),
      Compare(
        CrossingParityReference(both, grid, column), combined([](int x, int y) { return x ^ y; })));
    ok &= Report(Name("two spheres", column, FillRule::NonZero),
      Compare(CrossingNonZeroReference(both, grid, column),
        combined([](int x, int y) { return x | y; })));
    ok &= CheckEqual<std::size_t>(Name("sphere and its reverse", column, FillRule::NonZero),
      CrossingNonZeroReference(minus, grid, column).CountNonZero(), 0);
  }
  return ok;
}

bool TestGrids()
{
  bool ok = true;
  vtkNew<vtkImageData> image;
  image->SetExtent(-5, 20, 3, 30, -40, -10);
  image->SetOrigin(100.25, -2e5, 3.5);
  image->SetSpacing(0.5, 2.0, 0.125);
  image->SetDirectionMatrix(0.6, 0.0, 0.8, 0.0, -1.0, 0.0, 0.8, 0.0, -0.6);
  const Grid grid = Grid::FromImage(image);
  ok &= CheckEqual<std::size_t>("voxels of the image", grid.NumberOfVoxels(), 26 * 28 * 31);
  for (std::size_t offset : { std::size_t{ 0 }, std::size_t{ 5000 }, grid.NumberOfVoxels() - 1 })
  {
    const Voxel voxel = grid.VoxelAt(offset);
    ok &= CheckEqual("offset", grid.Offset(voxel), offset);
    Vector point;
    image->GetPoint(static_cast<vtkIdType>(offset), point.data());
    const Vector index = grid.ToIndex(point);
    const Vector world = grid.ToWorld(voxel);
    for (int axis = 0; axis < 3; ++axis)
    {
      ok &= Check("point to index", std::abs(index[axis] - voxel[axis]) < 1e-8);
      ok &= Check("index to point", std::abs(world[axis] - point[axis]) < 1e-8);
    }
  }

  // The same cube of 4^3 voxels, seen by an oriented grid far from the origin.
  const Vector corner = grid.ToWorld({ 2, 10, -30 });
  const Mesh unit = VoxelTestMeshes::Box({ -0.5, -0.5, -0.5 }, { 3.5, 3.5, 3.5 });
  for (vtkIdType point = 0; point < unit->GetNumberOfPoints(); ++point)
  {
    Vector p;
    unit->GetPoint(point, p.data());
    const Vector scaled{ 0.5 * p[0], 2.0 * p[1], 0.125 * p[2] };
    unit->GetPoints()->SetPoint(point, corner[0] + 0.6 * scaled[0] + 0.8 * scaled[2],
      corner[1] - scaled[1], corner[2] + 0.8 * scaled[0] - 0.6 * scaled[2]);
  }
  const Volume expected = VolumeWhere(grid,
    [](const Voxel& voxel)
    {
      return voxel[0] >= 2 && voxel[0] < 6 && voxel[1] >= 10 && voxel[1] < 14 && voxel[2] >= -30 &&
        voxel[2] < -26;
    });
  std::array<double, 16> matrix{};
  for (int row = 0; row < 3; ++row)
  {
    const Vector zero = grid.ToIndex({ 0, 0, 0 });
    std::copy_n(grid.Linear.begin() + 3 * row, 3, matrix.begin() + 4 * row);
    matrix[4 * row + 3] = zero[row];
  }
  matrix[15] = 1.0;
  const Grid same = Grid::FromMatrix(grid.Extent, matrix);
  for (Axis column : AllAxes)
  {
    ok &= Report(Name("box in an oriented image", column),
      Compare(CrossingParityReference(unit, grid, column), expected));
    ok &= Report(Name("box in a grid by matrix", column),
      Compare(CrossingParityReference(unit, same, column), expected));
  }
  return ok;
}

/// The part of a polygon on the inner side of the plane sign * x[axis] <= limit.
std::vector<Vector> Clipped(const std::vector<Vector>& polygon, int axis, double sign, double limit)
{
  std::vector<Vector> inside;
  for (std::size_t corner = 0; corner < polygon.size(); ++corner)
  {
    const Vector& a = polygon[corner];
    const Vector& b = polygon[(corner + 1) % polygon.size()];
    const double overA = sign * a[axis] - limit;
    const double overB = sign * b[axis] - limit;
    if (overA <= 0.0)
    {
      inside.push_back(a);
    }
    if ((overA < 0.0 && overB > 0.0) || (overA > 0.0 && overB < 0.0))
    {
      const double t = overA / (overA - overB);
      inside.push_back(
        { a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]) });
    }
  }
  return inside;
}

bool TouchesCubeByClipping(const Triangle& triangle, double halfSize)
{
  std::vector<Vector> polygon(triangle.begin(), triangle.end());
  for (int axis = 0; axis < 3; ++axis)
  {
    for (double sign : { -1.0, 1.0 })
    {
      polygon = Clipped(polygon, axis, sign, halfSize);
    }
  }
  return !polygon.empty();
}

bool TestTriangleDistances()
{
  bool ok = true;
  const auto isNear = [](double a, double b) { return std::abs(a - b) < 1e-12; };
  const Triangle flat = { { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 3, 0 } } };
  ok &= Check("above", isNear(DistanceToTriangle({ 1, 1, -2 }, flat), 2.0));
  ok &= Check("beside an edge", isNear(DistanceToTriangle({ 2, -3, 4 }, flat), 5.0));
  ok &= Check("beside the long edge", isNear(DistanceToTriangle({ 5, 5, 0 }, flat), 4.6));
  ok &= Check("beside a corner", isNear(DistanceToTriangle({ -1, -2, 2 }, flat), 3.0));
  ok &= Check("inside", DistanceToTriangle({ 1, 1, 0 }, flat) == 0.0);
  const Triangle segment = { { { 0, 0, 0 }, { 4, 0, 0 }, { 2, 0, 0 } } };
  ok &= Check("to a segment", isNear(DistanceToTriangle({ 3, 3, 4 }, segment), 5.0));
  const Triangle point = { { { 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 } } };
  ok &= Check("to a point", isNear(DistanceToTriangle({ 2, 3, 3 }, point), 3.0));
  ok &= Check("cube to a point", isNear(CubeDistanceToTriangle({ 2, 3, 3.5 }, point), 2.5));
  ok &= Check("cube to a plane", isNear(CubeDistanceToTriangle({ 1, 1, -2 }, flat), 2.0));

  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->Initialize(41);
  for (int number = 0; number < 20000; ++number)
  {
    // From compact triangles to needles.
    Triangle triangle;
    const double thickness = std::pow(10.0, -(number % 6));
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        triangle[corner][axis] = random->GetNextRangeValue(-3.0, 3.0);
      }
      triangle[2][axis] = triangle[1][axis] + thickness * (triangle[2][axis] - triangle[1][axis]);
    }
    const double cubeDistance = CubeDistanceToTriangle({ 0, 0, 0 }, triangle);
    ok &= Check("triangle " + std::to_string(number) + ", seed 41: touches the cube",
      TouchesCubeByClipping(triangle, cubeDistance + 1e-11));
    ok &= Check("triangle " + std::to_string(number) + ", seed 41: misses the cube",
      cubeDistance < 1e-11 || !TouchesCubeByClipping(triangle, cubeDistance - 1e-11));
    const double distance = DistanceToTriangle({ 0, 0, 0 }, triangle);
    ok &= Check("triangle " + std::to_string(number) + ", seed 41: norms",
      cubeDistance <= distance + 1e-12 && distance <= std::sqrt(3.0) * cubeDistance + 1e-12);
  }
  return ok;
}

bool TestSurfaceReference()
{
  bool ok = true;
  const Grid grid = UnitGrid({ -2, 22, -1, 21, -2, 23 });
  std::vector<NamedMesh> meshes = LatticeMeshes();
  const std::vector<NamedMesh> general = GeneralMeshes();
  meshes.insert(meshes.end(), general.begin(), general.end());
  for (const auto& [name, mesh] : meshes)
  {
    const IndexMesh triangles(mesh, grid);
    const Volume touched = TouchedVoxelsReference(mesh, grid);
    std::vector<Voxel> voxels;
    for (std::size_t offset = 0; offset < grid.NumberOfVoxels(); offset += 31)
    {
      voxels.push_back(grid.VoxelAt(grid.NumberOfVoxels() - 1 - offset));
    }
    const std::vector<double> distances = DistanceToSurface(mesh, grid, voxels, 1.5);
    const std::vector<double> one = DistanceToSurface(mesh, grid, { voxels[200] }, 1.5);
    ok &= Check("distance of a single voxel, " + name, one[0] == distances[200]);
    for (std::size_t number = 0; number < voxels.size(); ++number)
    {
      const Voxel& voxel = voxels[number];
      const Vector centre{ double(voxel[0]), double(voxel[1]), double(voxel[2]) };
      double expected = std::numeric_limits<double>::infinity();
      double cube = expected;
      for (std::int64_t cell = 0; cell < triangles.GetNumberOfTriangles(); ++cell)
      {
        const Triangle triangle = triangles.GetTriangle(cell);
        expected = std::min(expected, DistanceToTriangle(centre, triangle));
        cube = std::min(cube, CubeDistanceToTriangle(centre, triangle));
      }
      expected = expected > 1.5 ? std::numeric_limits<double>::infinity() : expected;
      ok &= CheckEqual("distance, " + name, distances[number], expected);
      const int touch = (cube <= 0.5 + NearMargin ? TouchedNearly : 0) |
        (cube <= 0.5 - SureMargin ? TouchedSurely : 0);
      ok &= CheckEqual("touch, " + name, int(touched.At(voxel)), touch);
    }
  }

  // A box from centre to centre touches the voxels of its faces, and none beside them.
  const Volume box =
    TouchedVoxelsReference(VoxelTestMeshes::Box({ 2, 3, 4 }, { 12, 13, 14 }), grid);
  const Volume faces = VolumeWhere(grid,
    [](const Voxel& voxel)
    {
      const std::array<int, 3> p = { voxel[0] - 2, voxel[1] - 3, voxel[2] - 4 };
      const auto [low, high] = std::minmax({ p[0], p[1], p[2] });
      return low >= 0 && high <= 10 && (low == 0 || high == 10);
    });
  ok &= ReportBoundary("touched by a box", faces, box);
  ok &= CheckEqual("touched by a box", box.CountNonZero(), faces.CountNonZero());

  // Faces between voxels touch both sides, but not surely.
  const Volume between =
    TouchedVoxelsReference(VoxelTestMeshes::Box({ 2.5, 2.5, 2.5 }, { 12.5, 12.5, 12.5 }), grid);
  ok &= CheckEqual<std::size_t>(
    "touched by a box between voxels", between.CountNonZero(), 12 * 12 * 12 - 8 * 8 * 8);
  ok &= Check("touched nearly",
    between.At({ 2, 7, 7 }) == TouchedNearly && between.At({ 3, 7, 7 }) == TouchedNearly);
  return ok;
}

using Integers = std::array<std::int64_t, 3>;

/// Twice the area of a triangle as seen along an axis, signed.
std::int64_t AreaAlong(int axis, const Integers& a, const Integers& b, const Integers& c)
{
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  return (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
}

Integers NormalOf(const std::array<Integers, 3>& corners)
{
  Integers normal;
  for (int axis = 0; axis < 3; ++axis)
  {
    normal[axis] = AreaAlong(axis, corners[0], corners[1], corners[2]);
  }
  return normal;
}

/// Thin overlap in exact arithmetic, lengths being counted in quarters of voxels: at least 0 where
/// all conditions hold, and 0 where one of them is a tie.
std::int64_t ThinSlack(const std::array<Integers, 3>& corners, const Integers& centre)
{
  const Integers normal = NormalOf(corners);
  std::int64_t slack = std::numeric_limits<std::int64_t>::max();
  std::int64_t height = 0;
  std::int64_t reach = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto [low, high] = std::minmax({ corners[0][axis], corners[1][axis], corners[2][axis] });
    slack = std::min({ slack, centre[axis] + 2 - low, high - centre[axis] + 2 });
    height += normal[axis] * (centre[axis] - corners[0][axis]);
    reach = std::max(reach, 2 * std::abs(normal[axis]));
    for (int edge = 0; edge < 3; ++edge)
    {
      const Integers& a = corners[edge];
      const Integers& b = corners[(edge + 1) % 3];
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      const std::int64_t left = AreaAlong(axis, a, b, centre);
      const std::int64_t inside = normal[axis] > 0 ? left
        : normal[axis] < 0                         ? -left
                                                   : -std::abs(left);
      const std::int64_t edgeReach = 2 * std::max(std::abs(b[u] - a[u]), std::abs(b[v] - a[v]));
      slack = edgeReach > 0 ? std::min(slack, inside + edgeReach) : slack;
    }
  }
  return reach > 0 ? std::min(slack, reach - std::abs(height)) : slack;
}

bool TestThinIsExact()
{
  bool ok = true;
  const Grid grid = UnitGrid({ 0, 9, -1, 8, 1, 10 });
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->Initialize(61);
  for (int number = 0; number < 3000; ++number)
  {
    // Coarse points make ties, and triangles that are parallel to axes or without area.
    const int step = 1 << (number % 5);
    std::array<Integers, 3> corners;
    Triangle triangle;
    for (int corner = 0; corner < 3; ++corner)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        corners[corner][axis] = step * std::llround(random->GetNextRangeValue(-8.0, 44.0) / step);
        triangle[corner][axis] = 0.25 * static_cast<double>(corners[corner][axis]);
      }
    }
    const bool hasArea = NormalOf(corners) != Integers{ 0, 0, 0 };
    const Volume thin = ThinVoxelsReference(VoxelTestMeshes::FromTriangles({ triangle }), grid, 1);
    const std::string name = "thin triangle " + std::to_string(number) + ", seed 61";
    for (std::size_t offset = 0; offset < grid.NumberOfVoxels(); ++offset)
    {
      const Voxel voxel = grid.VoxelAt(offset);
      const std::int64_t slack = ThinSlack(corners, { 4 * voxel[0], 4 * voxel[1], 4 * voxel[2] });
      const unsigned char touch = thin.Voxels[offset];
      ok &= CheckEqual(name + ", nearly", (touch & TouchedNearly) != 0, slack >= 0);
      if (hasArea || slack <= 0)
      {
        ok &= CheckEqual(name + ", surely", (touch & TouchedSurely) != 0, slack > 0);
      }
    }
  }
  return ok;
}

bool IsSurely(unsigned char touch)
{
  return (touch & TouchedSurely) != 0;
}

/// All voxels where the predicate holds are surely thin, and no others nearly.
template <typename Predicate>
bool CheckThin(const std::string& name, const Mesh& mesh, const Grid& grid, Predicate&& predicate)
{
  const Volume thin = ThinVoxelsReference(mesh, grid);
  const Volume expected = VolumeWhere(grid, predicate);
  const bool ok = ReportBoundary(name, expected, thin);
  return CheckEqual(name, thin.CountNonZero(), expected.CountNonZero()) &&
    Report(name,
      Compare(VolumeWhere(grid, [&](const Voxel& v) { return IsSurely(thin.At(v)); }), expected)) &&
    ok;
}

bool TestThinByHand()
{
  using VoxelTestMeshes::FromTriangles;
  bool ok = true;
  const Grid grid = UnitGrid({ -2, 14, -1, 15, -2, 16 });
  const auto within = [](int value, int low, int high) { return value >= low && value <= high; };

  ok &= CheckThin("square on voxel centres",
    FromTriangles({ { { { 2, 3, 4 }, { 6, 3, 4 }, { 6, 8, 4 } } },
      { { { 2, 3, 4 }, { 6, 8, 4 }, { 2, 8, 4 } } } }),
    grid, [&](const Voxel& v) { return within(v[0], 2, 6) && within(v[1], 3, 8) && v[2] == 4; });
  ok &= CheckThin("diagonal wall",
    FromTriangles({ { { { 2, 2, 2 }, { 6, 6, 2 }, { 6, 6, 6 } } },
      { { { 2, 2, 2 }, { 6, 6, 6 }, { 2, 2, 6 } } } }),
    grid, [&](const Voxel& v) { return within(v[0], 2, 6) && v[0] == v[1] && within(v[2], 2, 6); });
  ok &= CheckThin("edge-on triangle",
    FromTriangles({ { { { 2, 4, 2 }, { 8, 4, 2 }, { 2, 4, 8 } } } }), grid,
    [](const Voxel& v) { return v[0] >= 2 && v[1] == 4 && v[2] >= 2 && v[0] + v[2] <= 10; });
  ok &= CheckThin("diagonal triangle",
    FromTriangles({ { { { 12, 0, 0 }, { 0, 12, 0 }, { 0, 0, 12 } } } }), grid,
    [](const Voxel& v) {
      return std::min({ v[0], v[1], v[2] }) >= 0 && v[0] + v[1] + v[2] == 12;
    });
  ok &= CheckThin("segment", FromTriangles({ { { { 2, 5, 5 }, { 6, 5, 5 }, { 4, 5, 5 } } } }), grid,
    [&](const Voxel& v) { return within(v[0], 2, 6) && v[1] == 5 && v[2] == 5; });
  ok &= CheckThin("point", FromTriangles({ { { { 3, 4, 5 }, { 3, 4, 5 }, { 3, 4, 5 } } } }), grid,
    [](const Voxel& v) {
      return v == Voxel{ 3, 4, 5 };
    });

  // A square between voxels is in both layers, but surely in neither.
  const Volume between = ThinVoxelsReference(
    FromTriangles({ { { { 2, 3, 4.5 }, { 6, 3, 4.5 }, { 6, 8, 4.5 } } } }), grid);
  ok &= Check("between layers",
    between.At({ 4, 4, 4 }) == TouchedNearly && between.At({ 4, 4, 5 }) == TouchedNearly);

  // The upright edge is seen as a point: it does not cut the wall off, wherever errors turn it.
  for (const double error : { 0.0, 1e-12, -1e-12 })
  {
    const Mesh wall =
      FromTriangles({ { { { 2, 2, 2 }, { 5.6, 5.6, 2 }, { 5.6 + error, 5.6 - error, 8 } } } });
    ok &= CheckThin("wall with an upright edge, error " + std::to_string(1e12 * error), wall, grid,
      [&](const Voxel& v)
      {
        return within(v[0], 2, 6) && v[0] == v[1] && within(v[2], 2, 8) &&
          6.0 * (v[0] - 2) + 3.0 >= 3.6 * (v[2] - 2);
      });
  }

  // The planes of a segment that passes a centre at 0.4 do not all meet the octahedron.
  const Volume beside =
    ThinVoxelsReference(FromTriangles({ { { { 2, 2, 4.4 }, { 6, 6, 4.4 }, { 6, 6, 4.4 } } },
                          { { { 2, 2, 8.2 }, { 6, 6, 8.2 }, { 4, 4, 8.2 } } } }),
      grid);
  ok &= Check("beside the segment", beside.At({ 4, 4, 4 }) == TouchedNearly);
  ok &= Check("at the segment", IsSurely(beside.At({ 4, 4, 8 })));
  return ok;
}

/// The flood's voxels that are solid.
std::size_t CountFloodedSolid(const Volume& barrier, const Volume& solid, int connectivity)
{
  const Volume flooded = FloodFromOutside(barrier, connectivity);
  return VolumeWhere(
    solid.Grid, [&](const Voxel& v) { return flooded.At(v) != 0 && solid.At(v) != 0; })
    .CountNonZero();
}

bool TestSurfacesSeparate()
{
  bool ok = true;
  const Grid grid = UnitGrid({ -4, 24, -4, 25, -4, 26 });
  std::vector<NamedMesh> meshes = LatticeMeshes();
  const std::vector<NamedMesh> general = GeneralMeshes();
  meshes.insert(meshes.end(), general.begin(), general.end());
  for (const auto& [name, mesh] : meshes)
  {
    const Volume touched = TouchedVoxelsReference(mesh, grid);
    const Volume thin = ThinVoxelsReference(mesh, grid);
    const Volume outsideTouched =
      VolumeWhere(grid, [&](const Voxel& v) { return (thin.At(v) & ~touched.At(v)) != 0; });
    ok &= CheckEqual<std::size_t>("thin, not touched, " + name, outsideTouched.CountNonZero(), 0);
    if (mesh->GetLength() > 60.0) // reaches out of the grid
    {
      continue;
    }
    const Volume solid = CrossingParityReference(mesh, grid);
    ok &= CheckEqual<std::size_t>(
      "through the thin surface over faces, " + name, CountFloodedSolid(thin, solid, 6), 0);
    ok &= CheckEqual<std::size_t>(
      "through the touched voxels over corners, " + name, CountFloodedSolid(touched, solid, 26), 0);
  }

  const Mesh sphere = VoxelTestMeshes::Sphere({ 10.1, 9.8, 10.2 }, 8.3, 24);
  const Volume thin = ThinVoxelsReference(sphere, grid);
  const Volume solid = CrossingParityReference(sphere, grid);
  const Volume surely = VolumeWhere(grid, [&](const Voxel& v) { return IsSurely(thin.At(v)); });
  ok &=
    CheckEqual<std::size_t>("through a sphere over faces", CountFloodedSolid(surely, solid, 6), 0);
  ok &= Check("over corners a flood fills a thin sphere",
    CountFloodedSolid(thin, solid, 26) > solid.CountNonZero() / 2);
  return ok;
}

/// A flood made plainly: each unset voxel beside a reached one is reached, until nothing changes.
Volume PlainFlood(const Volume& barrier, int mostSteps)
{
  const Grid& grid = barrier.Grid;
  Volume reached = VolumeWhere(grid, [](const Voxel&) { return false; });
  const auto isReached = [&](const Voxel& voxel)
  { return !grid.Contains(voxel) || reached.At(voxel); };
  const auto hasReachedNeighbour = [&](const Voxel& voxel)
  {
    for (int neighbour = 0; neighbour < 27; ++neighbour)
    {
      const Voxel step{ neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1 };
      if (std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]) <= mostSteps &&
        isReached({ voxel[0] + step[0], voxel[1] + step[1], voxel[2] + step[2] }))
      {
        return true;
      }
    }
    return false;
  };
  for (std::size_t before = 1; before != reached.CountNonZero();)
  {
    before = reached.CountNonZero();
    for (std::size_t offset = 0; offset < grid.NumberOfVoxels(); ++offset)
    {
      reached.Voxels[offset] =
        barrier.Voxels[offset] == 0 && hasReachedNeighbour(grid.VoxelAt(offset));
    }
  }
  return reached;
}

bool TestFlood()
{
  bool ok = true;
  const std::vector<int> connectivities = { 6, 18, 26 };

  // A shell around one voxel, with an opening over a face, an edge, a corner, or none.
  const Grid grid = UnitGrid({ 3, 7, -1, 3, 0, 4 });
  const Voxel middle{ 5, 1, 2 };
  const std::vector<std::pair<Voxel, int>> openings = { { { 4, 1, 2 }, 6 }, { { 4, 1, 1 }, 18 },
    { { 6, 2, 3 }, 26 }, { middle, 27 } };
  for (const auto& [opening, needed] : openings)
  {
    const Volume shell = VolumeWhere(grid,
      [&, open = opening](const Voxel& v)
      {
        return v != middle && v != open && std::abs(v[0] - middle[0]) <= 1 &&
          std::abs(v[1] - middle[1]) <= 1 && std::abs(v[2] - middle[2]) <= 1;
      });
    for (const int connectivity : connectivities)
    {
      const Volume flooded = FloodFromOutside(shell, connectivity);
      const std::string name =
        "flood by " + std::to_string(connectivity) + " into the opening " + std::to_string(needed);
      ok &= CheckEqual(name, flooded.At(middle) != 0, connectivity >= needed);
      ok &= CheckEqual<std::size_t>(name + ", voxels", flooded.CountNonZero(),
        5 * 5 * 5 - 27 + (opening != middle) + (connectivity >= needed));
    }
  }

  // Halves of a grid that a wall divides are both outside; a full grid is not.
  const Volume wall = VolumeWhere(grid, [](const Voxel& v) { return v[0] == 5; });
  const Volume full = VolumeWhere(grid, [](const Voxel&) { return true; });
  const Volume almost = VolumeWhere(grid, [](const Voxel& v) { return v != Voxel{ 3, 1, 2 }; });
  for (const int connectivity : connectivities)
  {
    ok &= CheckEqual<std::size_t>(
      "both sides of a wall", FloodFromOutside(wall, connectivity).CountNonZero(), 100);
    ok &= CheckEqual<std::size_t>("full", FloodFromOutside(full, connectivity).CountNonZero(), 0);
    ok &= CheckEqual<std::size_t>(
      "one voxel in the border", FloodFromOutside(almost, connectivity).CountNonZero(), 1);
  }

  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->Initialize(62);
  for (const double density : { 0.5, 0.7, 0.85, 0.93 })
  {
    const Volume noise = VolumeWhere(UnitGrid({ -3, 11, 0, 12, 2, 18 }),
      [&](const Voxel&) { return random->GetNextRangeValue(0.0, 1.0) < density; });
    for (int steps = 1; steps <= 3; ++steps)
    {
      ok &= Report("flood of noise, seed 62, density " + std::to_string(density),
        Compare(FloodFromOutside(noise, connectivities[steps - 1]), PlainFlood(noise, steps)));
    }
  }

  bool isRefused = false;
  try
  {
    FloodFromOutside(full, 8);
  }
  catch (const std::invalid_argument&)
  {
    isRefused = true;
  }
  return Check("connectivity 8 is refused", isRefused) && ok;
}

/// What `action` prints as errors; it must print one line at least.
template <typename Action>
std::string ErrorsOf(Action&& action)
{
  std::ostringstream errors;
  std::streambuf* const original = std::cerr.rdbuf(errors.rdbuf());
  action();
  std::cerr.rdbuf(original);
  return errors.str();
}

bool TestComparison()
{
  bool ok = true;
  const Mesh mesh = VoxelTestMeshes::Sphere({ 8.1, 8.2, 8.3 }, 6);
  const Grid grid = UnitGrid({ 0, 16, 1, 15, 2, 16 });
  const Volume expected = CrossingParityReference(mesh, grid);

  vtkNew<vtkImageData> image;
  image->SetExtent(const_cast<int*>(grid.Extent.data()));
  vtkNew<vtkUnsignedCharArray> bytes;
  vtkNew<vtkBitArray> bits;
  bytes->SetName("Occupancy");
  bits->SetName("Occupancy");
  for (std::size_t offset = 0; offset < grid.NumberOfVoxels(); ++offset)
  {
    bytes->InsertNextValue(expected.Voxels[offset] ? 255 : 0);
    bits->InsertNextValue(expected.Voxels[offset]);
  }
  ok &= Check("no scalars", !Compare(image, expected).IsComparable());
  image->GetPointData()->SetScalars(bytes);
  ok &= Report("bytes", Compare(image, expected));
  image->GetPointData()->SetScalars(bits);
  ok &= Report("bits", Compare(image, expected));

  vtkNew<vtkImageData> cells;
  cells->SetExtent(0, 17, 1, 16, 2, 17);
  cells->GetCellData()->SetScalars(bytes);
  ok &= Report("cells", Compare(cells, expected));
  cells->SetExtent(1, 18, 1, 16, 2, 17);
  ok &= Check("another extent", !Compare(cells, expected).IsComparable());
  cells->SetExtent(0, 17, 1, 16, 2, 18);
  ok &= Check("too few values", !Compare(cells, expected).IsComparable());
  ok &= Check("no image", !Compare(static_cast<vtkImageData*>(nullptr), expected).IsComparable());

  // One voxel too few in the middle, one too many just outside.
  Volume wrong = VolumeWhere(grid, [&](const Voxel& voxel) { return expected.At(voxel) != 0; });
  wrong.Voxels[grid.Offset({ 8, 8, 8 })] = 0;
  wrong.Voxels[grid.Offset({ 1, 8, 8 })] = 1;
  const Difference difference = Compare(wrong, expected);
  ok &= Check("missing", difference.Missing == std::vector<Voxel>{ { 8, 8, 8 } });
  ok &= Check("extra", difference.Extra == std::vector<Voxel>{ { 1, 8, 8 } });
  const SurfaceDeviation deviation = DeviationFromSurface(difference, mesh, 1e-4);
  ok &= CheckEqual<std::size_t>("beyond", deviation.Beyond, 2);
  ok &= CheckEqual<std::size_t>("leaking columns along z", deviation.LeakingColumns, 2);
  ok &= CheckEqual<std::size_t>("leaking columns along x",
    DeviationFromSurface(difference, mesh, 1e-4, Axis::X).LeakingColumns, 1);
  const std::string line =
    ErrorsOf([&] { ok &= Check("reported", !Report("seed 5", difference, mesh, 1e-4)); });
  ok &= Check("the line names the mesh and the voxels",
    line.find("seed 5: 2 of ") == 0 && line.find("-(8, 8, 8)") != std::string::npos &&
      line.find("+(1, 8, 8)") != std::string::npos && line.find("2 columns") != std::string::npos &&
      std::count(line.begin(), line.end(), '\n') == 1);
  ErrorsOf([&] { ok &= Check("strict", !Report("strict", difference)); });

  // A voxel on the surface itself is a difference unless a tolerance is given.
  const Mesh box = VoxelTestMeshes::Box({ 2, 3, 4 }, { 10, 11, 12 });
  const Volume boxVoxels = CrossingParityReference(box, grid);
  const Difference onSurface = Compare(VolumeWhere(grid,
                                         [&](const Voxel& voxel) {
                                           return boxVoxels.At(voxel) || voxel == Voxel{ 10, 7, 7 };
                                         }),
    boxVoxels);
  ok &= Report("within the tolerance", onSurface, box, 1e-9);
  ErrorsOf([&] { ok &= Check("tolerance 0", !Report("tolerance 0", onSurface, box, 0.0)); });

  // A hole leaks to the end of its columns.
  const Mesh holed = VoxelTestMeshes::WithHoles(mesh, 51, 3);
  ok &= Check("holes", VoxelTestMeshes::CountOpenEdges(holed) > 0);
  const Volume leaking = CrossingParityReference(holed, grid);
  ok &= Check("open columns", CountColumnsOpenAtEnd(leaking, Axis::Z) > 0);
  ok &= Check("leaks", DeviationFromSurface(Compare(leaking, expected), mesh, 1e-4).Beyond > 0);

  // The conservative modes made of the references pass; with one voxel changed they do not.
  const Volume touched = TouchedVoxelsReference(mesh, grid);
  const auto changed = [&](const Volume& volume, const Voxel& at)
  {
    return VolumeWhere(
      grid, [&](const Voxel& voxel) { return (volume.At(voxel) != 0) != (voxel == at); });
  };
  const Voxel none{ -1, -1, -1 };
  const Voxel middle{ 8, 8, 8 };
  const Voxel outside{ 0, 1, 2 };
  const Volume over =
    VolumeWhere(grid, [&](const Voxel& voxel) { return expected.At(voxel) || touched.At(voxel); });
  const Volume under =
    VolumeWhere(grid, [&](const Voxel& voxel) { return expected.At(voxel) && !touched.At(voxel); });
  const auto surelyTouched = static_cast<std::size_t>(
    std::find(touched.Voxels.get(), touched.Voxels.get() + grid.NumberOfVoxels(),
      TouchedNearly | TouchedSurely) -
    touched.Voxels.get());
  const Voxel surface = grid.VoxelAt(surelyTouched);
  ok &= ReportOverConservative("over", changed(over, none), touched, expected);
  ok &= ReportUnderConservative("under", changed(under, none), touched, expected);
  ok &= ReportBoundary("boundary", changed(touched, none), touched);
  for (const Voxel& voxel : { middle, outside, surface })
  {
    ErrorsOf(
      [&]
      {
        ok &= Check(
          "over changed", !ReportOverConservative("over", changed(over, voxel), touched, expected));
        ok &= Check("under changed",
          !ReportUnderConservative("under", changed(under, voxel), touched, expected));
        ok &=
          Check("boundary changed", !ReportBoundary("boundary", changed(touched, voxel), touched));
      });
  }
  return ok;
}

}

int TestVoxelReference(int argc, char* argv[])
{
  bool ok = true;
  ok &= TestScanlineIsExact();
  ok &= TestBoxesAreHalfOpen();
  ok &= TestVolumesAndAxes(argc, argv);
  ok &= TestStorageDoesNotMatter();
  ok &= TestExtentAndThreadsDoNotMatter();
  ok &= TestFillRules();
  ok &= TestGrids();
  ok &= TestTriangleDistances();
  ok &= TestSurfaceReference();
  ok &= TestThinIsExact();
  ok &= TestThinByHand();
  ok &= TestSurfacesSeparate();
  ok &= TestFlood();
  ok &= TestComparison();
  return ok ? EXIT_SUCCESS : EXIT_FAILURE;
}
