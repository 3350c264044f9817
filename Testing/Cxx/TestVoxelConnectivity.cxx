// Proves vtkVoxelConnectivity bit for bit against plain floods, for every operation and
// connectivity: random voxels of all densities on awkward grids, sets that wind through the grid,
// touch by edges or corners only, or have cavities in cavities; of equal components the first; the
// numbers of components; that surfaces are filled; that a chain is read back once; memory, abort
// and errors.

#include "VoxelComparison.h"
#include "VoxelFilterTests.h"
#include "VoxelFlood.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSlicemap.h>
#include <vtkSlicemapSolidVoxelizer.h>
#include <vtkVoxelConnectivity.h>
#include <vtkVoxelMorphology.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>

using namespace VoxelFilterTests;
using VoxelReference::Compare;
using VoxelReference::Volume;
using VoxelReference::Voxel;

namespace
{
using Filter = vtkVoxelConnectivity;

constexpr int Connectivities[] = { 6, 18, 26 };
constexpr int Operations[] = { Filter::OPERATION_FILL_HOLES, Filter::OPERATION_KEEP_LARGEST };

/// What the filter promises, by floods.
Volume Reference(vtkImageData* grid, const Volume& input, int operation, int connectivity)
{
  if (operation == Filter::OPERATION_KEEP_LARGEST)
  {
    return VoxelReference::LargestFlood(input, connectivity);
  }
  const Volume outside = VoxelReference::FloodFromOutside(input, connectivity == 6 ? 26 : 6);
  return MakeVoxels(grid, [&](std::size_t offset) { return !outside.Voxels[offset]; });
}

void CheckAgainstFlood(
  VoxelTestChecks& checks, const std::string& name, vtkImageData* grid, const Volume& input)
{
  vtkNew<Filter> filter;
  filter->SetInputData(MakeMask(grid, input));
  for (const int operation : Operations)
  {
    for (const int connectivity : Connectivities)
    {
      filter->SetOperation(operation);
      filter->SetConnectivity(connectivity);
      filter->Update();
      const std::string what = name + ", operation " + std::to_string(operation) +
        ", connectivity " + std::to_string(connectivity);
      const Volume expected = Reference(grid, input, operation, connectivity);
      checks.Check(what, VoxelReference::Report(what, Compare(filter->GetOutput(), expected)));
      checks.Equal(what + ": count", filter->GetNumberOfFilledVoxels(),
        static_cast<vtkIdType>(expected.CountNonZero()));
    }
  }
}

/// Among them those with components through all of the grid, and just not.
void TestRandom(VoxelTestChecks& checks)
{
  unsigned int seed = 300;
  for (const auto& [name, grid] : AwkwardGrids())
  {
    for (const double density : { 0.0, 0.03, 0.1, 0.14, 0.31, 0.5, 0.69, 0.86, 0.9, 0.97, 1.0 })
    {
      const Volume input = RandomVoxels(grid, ++seed, density);
      CheckAgainstFlood(checks,
        name + ", density " + std::to_string(density) + ", seed " + std::to_string(seed), grid,
        input);
    }
  }
}

/// Set where isSet(x, y, z), counted from the first voxel.
template <typename Predicate>
Volume MakePattern(vtkImageData* grid, Predicate&& isSet)
{
  const auto box = VoxelReference::Grid::FromImage(grid);
  return MakeVoxels(grid,
    [&](std::size_t offset)
    {
      const Voxel voxel = box.VoxelAt(offset);
      return isSet(voxel[0] - box.Extent[0], voxel[1] - box.Extent[2], voxel[2] - box.Extent[4]);
    });
}

/// Components whose runs find each other late, or only by edges or corners.
void TestPatterns(VoxelTestChecks& checks)
{
  for (const auto& [name, grid] : AwkwardGrids())
  {
    const int* n = grid->GetDimensions();
    const auto check = [&, &name = name, &grid = grid](const std::string& pattern, auto&& isSet)
    { CheckAgainstFlood(checks, name + ", " + pattern, grid, MakePattern(grid, isSet)); };
    check("checkerboard", [](int x, int y, int z) { return (x + y + z) % 2 == 0; });
    check("corners", [](int x, int y, int z) { return x % 2 == y % 2 && y % 2 == z % 2; });
    check("shells",
      [&](int x, int y, int z)
      {
        const int depth = std::min({ x, n[0] - 1 - x, y, n[1] - 1 - y, z, n[2] - 1 - z });
        return depth % 2 == 0;
      });
    check("snake along x",
      [&](int x, int y, int z)
      { return y % 2 == 0 ? z % 2 == 0 || (x == 0 && y % 4 == 0) : z % 2 == 0 && x == n[0] - 1; });
    check("snake along y",
      [&](int x, int y, int z)
      { return z % 2 == 0 && (x % 2 == 0 || y == (x % 4 == 1 ? n[1] - 1 : 0)); });
    check("comb that joins at its end",
      [&](int x, int y, int z) { return x % 2 == 0 || (y == n[1] - 1 && z == n[2] - 1); });
    check("diagonals", [](int x, int y, int z) { return (x + 2 * y + 3 * z) % 5 == 0; });
  }
}

/// Two cubes of one size, and a larger one that is closer to the end.
void TestTies(VoxelTestChecks& checks)
{
  const Image grid = AwkwardGrids()[3].Grid;
  const auto cube = [](int x, int y, int z, int first, int size)
  { return x >= first && x < first + size && y >= 1 && y < 1 + size && z >= 1 && z < 1 + size; };
  vtkNew<Filter> filter;
  filter->SetOperationToKeepLargest();
  for (const bool hasLarger : { false, true })
  {
    const Volume input = MakePattern(grid,
      [&](int x, int y, int z) {
        return cube(x, y, z, 30, 2) || cube(x, y, z, 40, 2) || (hasLarger && cube(x, y, z, 90, 3));
      });
    const Volume expected = MakePattern(grid,
      [&](int x, int y, int z) { return hasLarger ? cube(x, y, z, 90, 3) : cube(x, y, z, 30, 2); });
    filter->SetInputData(MakeMask(grid, input));
    filter->Update();
    const std::string what = hasLarger ? "a larger one" : "two of one size";
    checks.Check(what, VoxelReference::Report(what, Compare(filter->GetOutput(), expected)));
    checks.Equal(
      what + ": components", filter->GetNumberOfComponents(), vtkIdType(hasLarger ? 3 : 2));
  }
}

void TestNumbers(VoxelTestChecks& checks)
{
  const Image grid = AwkwardGrids()[1].Grid; // 37 x 11 x 7
  vtkNew<Filter> filter;
  checks.Equal("components before a run", filter->GetNumberOfComponents(), vtkIdType(-1));
  const auto count = [&](int operation, int connectivity, const Volume& input)
  {
    filter->SetInputData(MakeMask(grid, input));
    filter->SetOperation(operation);
    filter->SetConnectivity(connectivity);
    filter->Update();
    return filter->GetNumberOfComponents();
  };
  const Volume lattice =
    MakePattern(grid, [](int x, int y, int z) { return x % 2 && y % 2 && z % 2; });
  const Volume inverse =
    MakePattern(grid, [](int x, int y, int z) { return !(x % 2 && y % 2 && z % 2); });
  const Volume boards = MakePattern(grid, [](int x, int y, int z) { return (x + y + z) % 2 == 0; });
  const Volume nothing = MakePattern(grid, [](int, int, int) { return false; });
  const int keep = Filter::OPERATION_KEEP_LARGEST;
  const int fill = Filter::OPERATION_FILL_HOLES;
  const vtkIdType points = 18 * 5 * 3;
  const vtkIdType half = (37 * 11 * 7 + 1) / 2;
  checks.Equal("single voxels", count(keep, 26, lattice), points);
  checks.Equal("single holes", count(fill, 26, inverse), points);
  checks.Equal("single holes of a 6-connected set", count(fill, 6, inverse), points);
  checks.Equal("a checkerboard by faces", count(keep, 6, boards), half);
  checks.Equal("a checkerboard by edges", count(keep, 18, boards), vtkIdType(1));
  checks.Equal("nothing", count(keep, 26, nothing), vtkIdType(0));
  checks.Equal("no holes in nothing", count(fill, 26, nothing), vtkIdType(0));
}

/// A shell that the other connectivity can't pass is filled; by a chain with one read-back.
void TestShells(VoxelTestChecks& checks)
{
  vtkNew<vtkSlicemapSolidVoxelizer> solid;
  solid->SetInputData(VoxelTestMeshes::TorusKnot(50.0, 24, 200));
  solid->SetResolution(90);
  solid->SetPadding(2);
  solid->HostOutputOff();
  vtkNew<vtkVoxelMorphology> shell;
  shell->SetInputConnection(solid->GetOutputPort());
  shell->SetOperationToInnerGradient();
  shell->HostOutputOff();
  vtkNew<Filter> fill;
  fill->SetInputConnection(shell->GetOutputPort());
  fill->HostOutputOff();
  const struct
  {
    int Kernel;
    int Connectivity;
    bool Fills;
  } cases[] = { { vtkVoxelMorphology::KERNEL_FACES6, 26, true },
    { vtkVoxelMorphology::KERNEL_FACES6, 18, true },
    { vtkVoxelMorphology::KERNEL_FACES6, 6, false },
    { vtkVoxelMorphology::KERNEL_CORNERS26, 6, true } };
  for (const auto& [kernel, connectivity, fills] : cases)
  {
    const std::string what =
      "shell " + std::to_string(kernel) + ", connectivity " + std::to_string(connectivity);
    shell->SetKernelType(kernel);
    shell->Update();
    const vtkIdType before = shell->GetNumberOfFilledVoxels();
    const vtkIdType readBacks = vtkSlicemap::GetNumberOfReadBacks();
    const vtkIdType uploads = vtkSlicemap::GetNumberOfUploads();
    fill->SetConnectivity(connectivity);
    fill->Update();
    checks.Equal(what + ": read-backs", vtkSlicemap::GetNumberOfReadBacks(), readBacks + 1);
    checks.Equal(what + ": uploads", vtkSlicemap::GetNumberOfUploads(), uploads + 1);
    checks.Equal(
      what + ": fills", fill->GetNumberOfFilledVoxels() == solid->GetNumberOfFilledVoxels(), fills);
    checks.Equal(what + ": the input is left alone", shell->GetNumberOfFilledVoxels(), before);
  }
}

void TestErrors(VoxelTestChecks& checks)
{
  const Image grid = AwkwardGrids()[1].Grid;
  vtkNew<Filter> filter;
  VoxelTestObserver observer(filter);
  filter->SetConnectivity(8);
  checks.Equal("errors of connectivity 8", observer.Errors.size(), std::size_t(1));
  checks.Equal("connectivity after it", filter->GetConnectivity(), 26);

  // The output would fit, but the runs of a checkerboard don't.
  filter->SetInputData(
    MakeMask(grid, MakePattern(grid, [](int x, int y, int z) { return (x + y + z) % 2 == 0; })));
  filter->SetMemoryLimit(4000);
  filter->Update();
  checks.Equal("errors without memory", observer.Errors.size(), std::size_t(2));
  checks.Check("which memory", observer.Errors.back().find("MemoryLimit") != std::string::npos);
  checks.Equal(
    "arrays without memory", filter->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
  checks.Equal("components after an error", filter->GetNumberOfComponents(), vtkIdType(-1));
  filter->SetMemoryLimit(0);
  filter->Update();
  checks.Equal("errors with memory", observer.Errors.size(), std::size_t(2));
  checks.Check("a run with memory works", filter->GetNumberOfFilledVoxels() > 0);
}

/// At every event of progress once.
void TestAbort(VoxelTestChecks& checks)
{
  const Image grid = AwkwardGrids()[1].Grid;
  vtkNew<Filter> filter;
  filter->SetInputData(MakeMask(grid, RandomVoxels(grid, 9)));
  for (const int events : { 0, 1, 2 })
  {
    const VoxelTestAbort abort(filter, events);
    filter->Modified();
    filter->Update();
    checks.Equal("arrays after an abort at event " + std::to_string(events),
      filter->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
    checks.Check("event " + std::to_string(events) + " came", abort.HasCome());
  }
  filter->Modified();
  filter->Update();
  checks.Check("a run after an abort works", filter->GetNumberOfFilledVoxels() > 0);
}
}

int TestVoxelConnectivity(int /*argc*/, char* /*argv*/[])
{
  VoxelTestChecks checks;
  TestRandom(checks);
  TestPatterns(checks);
  TestTies(checks);
  TestNumbers(checks);
  TestShells(checks);
  TestErrors(checks);
  TestAbort(checks);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
