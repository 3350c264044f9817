// Proves that the surface between depth buffers is what its definition says, column by column, and
// that nothing gets through it; that densities are those of the definition, and integrate to the
// volume of a sphere.

#include "VoxelComparison.h"
#include "VoxelDepthReference.h"
#include "VoxelFlood.h"
#include "VoxelSolidTests.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkDataArray.h>
#include <vtkDepthBufferVoxelizer.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

using namespace VoxelReference;
using namespace VoxelTestMeshes;
using VoxelSolidTests::MakeGridAround;

namespace
{
struct Range
{
  int First;
  int End;
};

/// The first and the last voxel of a column of the solid; those of an empty one are far from both
/// sides, and so is all beyond the grid.
Range RangeOf(const Volume& solid, const AxisOrder& order, int u, int v)
{
  const Grid& grid = solid.Grid;
  Range range{ grid.Extent[2 * order.C + 1] + 1, grid.Extent[2 * order.C] };
  Voxel voxel{};
  voxel[order.U] = u;
  voxel[order.V] = v;
  for (int c = grid.Extent[2 * order.C]; c <= grid.Extent[2 * order.C + 1]; ++c)
  {
    voxel[order.C] = c;
    if (grid.Contains(voxel) && solid.At(voxel))
    {
      range.First = std::min(range.First, c);
      range.End = c + 1;
    }
  }
  return range;
}

/// The definition of the surface, from a solid that is convex along each column.
Volume SurfaceOf(const Volume& solid, int connectivity)
{
  Volume surface(solid.Grid);
  for (std::size_t offset = 0; offset < solid.Grid.NumberOfVoxels(); ++offset)
  {
    const Voxel voxel = solid.Grid.VoxelAt(offset);
    bool seen = false;
    for (const Axis axis : AllAxes)
    {
      const AxisOrder order(axis);
      const int u = voxel[order.U];
      const int v = voxel[order.V];
      const Range own = RangeOf(solid, order, u, v);
      int end = own.First + 1;
      int begin = own.End - 1;
      for (int dv = -1; dv <= 1; ++dv)
      {
        for (int du = -1; du <= 1; ++du)
        {
          if (connectivity == 8 || du == 0 || dv == 0)
          {
            const Range other = RangeOf(solid, order, u + du, v + dv);
            end = std::max(end, other.First);
            begin = std::min(begin, other.End);
          }
        }
      }
      seen = seen || voxel[order.C] < end || voxel[order.C] >= begin;
    }
    surface.Voxels[offset] = static_cast<unsigned char>(solid.Voxels[offset] && seen);
  }
  return surface;
}

Volume Run(vtkPolyData* mesh, vtkImageData* grid, int mode, int connectivity, bool view = false)
{
  vtkNew<vtkDepthBufferVoxelizer> voxelizer;
  voxelizer->SetInputData(mesh);
  voxelizer->SetReferenceImage(grid);
  voxelizer->SetOutputMode(mode);
  voxelizer->SetConnectivity(connectivity);
  if (view)
  {
    voxelizer->AddView(1, 1, 1);
  }
  voxelizer->Update();
  return OccupancyOf(voxelizer->GetOutput());
}

/// Voxels of the solid, outside the surface, that a flood from outside reaches.
std::size_t CountLeaks(const Volume& surface, const Volume& solid, int connectivity)
{
  const Volume flood = FloodFromOutside(surface, connectivity);
  std::size_t leaks = 0;
  for (std::size_t i = 0; i < solid.Grid.NumberOfVoxels(); ++i)
  {
    leaks += solid.Voxels[i] && flood.Voxels[i] ? 1 : 0;
  }
  return leaks;
}

bool CheckSurface(const std::string& name, vtkPolyData* mesh, vtkImageData* grid, bool isConvex)
{
  VoxelTestChecks checks;
  for (const bool view : { false, true })
  {
    const Volume solid = Run(mesh, grid, vtkDepthBufferVoxelizer::OUTPUT_MODE_SOLID, 4, view);
    for (const int connectivity : { 4, 8 })
    {
      const std::string title =
        name + ", " + std::to_string(connectivity) + " neighbours" + (view ? ", a view" : "");
      const Volume surface =
        Run(mesh, grid, vtkDepthBufferVoxelizer::OUTPUT_MODE_SURFACE, connectivity, view);
      checks.Check(title + ": inside is left free",
        surface.CountNonZero() > 0 && surface.CountNonZero() < solid.CountNonZero());
      checks.Equal(title + ": leaks", CountLeaks(surface, solid, 6), std::size_t(0));
      if (isConvex && !view)
      {
        const Volume expected = SurfaceOf(solid, connectivity);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < expected.Grid.NumberOfVoxels(); ++i)
        {
          wrong += expected.Voxels[i] != surface.Voxels[i] ? 1 : 0;
        }
        checks.Equal(title + ": voxels unlike the definition", wrong, std::size_t(0));
      }
    }
  }
  return checks.Passed();
}

/// The mean of the densities' differences from those of boxes, known exactly.
bool CheckDensityOfBox()
{
  VoxelTestChecks checks;
  const VoxelTestMeshes::Vector low{ 1.75, 2.125, 3.5 };
  const VoxelTestMeshes::Vector high{ 4.25, 6.25, 3.875 };
  vtkNew<vtkDepthBufferVoxelizer> voxelizer;
  voxelizer->SetInputData(Box(low, high));
  voxelizer->SetReferenceImage(
    VoxelSolidTests::MakeGrid({ 0, 6, 0, 7, 0, 4 }, { 0, 0, 0 }, { 1, 1, 1 }));
  voxelizer->SetOutputModeToDensity();
  for (int axis = 0; axis < 2; ++axis)
  {
    // Along z no voxel centre lies inside, so only single axes see anything.
    voxelizer->SetAxes(axis == 0, axis == 1, false);
    voxelizer->Update();
    checks.Check(
      "a thin box seen from the side has no column", voxelizer->GetNumberOfFilledVoxels() == 0);
  }
  voxelizer->SetAxes(false, false, true);
  voxelizer->Update();
  auto* density = voxelizer->GetOutput()->GetPointData()->GetArray("Density");
  checks.Check("there is a density", density != nullptr);
  for (vtkIdType i = 0; density && i < density->GetNumberOfTuples(); ++i)
  {
    double place[3];
    voxelizer->GetOutput()->GetPoint(i, place);
    const bool inColumn =
      place[0] > low[0] && place[0] < high[0] && place[1] > low[1] && place[1] < high[1];
    const double part =
      std::clamp(std::min(high[2], place[2] + 0.5) - std::max(low[2], place[2] - 0.5), 0.0, 1.0);
    const double expected = inColumn ? part : 0.0;
    if (std::abs(density->GetComponent(i, 0) - expected) > 1e-5)
    {
      checks.Equal("density of voxel " + std::to_string(i), density->GetComponent(i, 0), expected);
    }
  }
  return checks.Passed();
}

bool CheckDensityOfSphere()
{
  VoxelTestChecks checks;
  constexpr double radius = 1.0;
  vtkNew<vtkDepthBufferVoxelizer> voxelizer;
  voxelizer->SetInputData(Sphere({ 0.01, 0.02, 0.03 }, radius, 256));
  voxelizer->SetResolution(128);
  voxelizer->SetPadding(1);
  voxelizer->SetOutputModeToDensity();
  voxelizer->Update();
  auto* density = voxelizer->GetOutput()->GetPointData()->GetArray("Density");
  double sum = 0.0;
  for (vtkIdType i = 0; i < density->GetNumberOfTuples(); ++i)
  {
    sum += density->GetComponent(i, 0);
  }
  const double* spacing = voxelizer->GetOutput()->GetSpacing();
  const double volume = sum * spacing[0] * spacing[1] * spacing[2];
  const double expected = 4.0 / 3.0 * vtkMath::Pi() * radius * radius * radius;
  std::cout << "density of a sphere: " << volume / expected << " of its volume\n";
  checks.Check(
    "density integrates to " + std::to_string(volume) + " instead of " + std::to_string(expected),
    std::abs(volume - expected) < 0.01 * expected);
  return checks.Passed();
}
}

int TestDepthSurface(int argc, char* argv[])
{
  bool ok = true;
  const Mesh sphere = Sphere({ 0, 0, 0 }, 1.0, 32);
  ok &= CheckSurface("sphere", sphere, MakeGridAround(sphere, 24), true);
  const Mesh tetrahedron =
    Rotated(Tetrahedron({ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }));
  ok &= CheckSurface("tetrahedron", tetrahedron, MakeGridAround(tetrahedron, 30), true);
  // The grid cuts the solid: it is closed there too.
  ok &= CheckSurface("cut sphere", sphere,
    VoxelSolidTests::MakeGrid(
      { 0, 11, 2, 20, -3, 15 }, { 0.013, -1.01, -0.41 }, { 0.0831, 0.0831, 0.0831 }),
    true);
  const Mesh bunny = ReadPLY("bunny_7k.ply", argc, argv);
  if (!bunny)
  {
    std::cerr << "bunny_7k.ply is missing\n";
    return EXIT_FAILURE;
  }
  ok &= CheckSurface("bunny", bunny, MakeGridAround(bunny, 50), false);
  ok &= CheckDensityOfBox();
  ok &= CheckDensityOfSphere();
  return ok ? EXIT_SUCCESS : EXIT_FAILURE;
}
