// Proves that the voxels between depth buffers are those that the triangles in double precision
// say, from one to three axes, on all grids, for meshes and for props alike, part by part too; and
// that they are the exact solid where the method promises it.

#include "VoxelComparison.h"
#include "VoxelDepthReference.h"
#include "VoxelSolidTests.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkActor.h>
#include <vtkDepthBufferVoxelizer.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>

using namespace VoxelReference;
using namespace VoxelTestMeshes;
using VoxelSolidTests::MakeGrid;
using VoxelSolidTests::MakeGridAround;

namespace
{
using AxesUsed = std::array<bool, 3>;
using Image = vtkSmartPointer<vtkImageData>;

constexpr std::array<AxesUsed, 5> ManyAxes = { { { true, true, true }, { true, false, false },
  { false, true, false }, { false, false, true }, { true, false, true } } };

vtkSmartPointer<vtkActor> MakeActor(vtkPolyData* mesh)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

std::string NameOf(const AxesUsed& axes)
{
  return std::string(axes[0] ? " x" : "") + (axes[1] ? " y" : "") + (axes[2] ? " z" : "");
}

/// The mesh on the input port, and as a prop, along all choices of axes. VTK draws polygons that
/// are not convex wrongly, so props get triangles.
bool CheckMesh(const std::string& name, vtkPolyData* mesh, vtkImageData* grid)
{
  const Mesh triangles = Triangulated(mesh);
  bool ok = true;
  for (const AxesUsed& axes : ManyAxes)
  {
    const DepthVoxels expected = DepthReference(triangles, Grid::FromImage(grid), axes);
    for (const bool isProp : { false, true })
    {
      vtkNew<vtkDepthBufferVoxelizer> voxelizer;
      voxelizer->SetReferenceImage(grid);
      voxelizer->SetAxes(axes[0], axes[1], axes[2]);
      if (isProp)
      {
        voxelizer->AddProp(MakeActor(triangles));
      }
      else
      {
        voxelizer->SetInputData(mesh);
      }
      voxelizer->Update();
      ok &= ReportDepth(
        name + (isProp ? ", prop," : ", mesh,") + NameOf(axes), voxelizer->GetOutput(), expected);
    }
  }
  return ok;
}

/// Where the method promises the solid, it is that of the parity reference.
bool CheckExact(const std::string& name, vtkPolyData* mesh, const AxesUsed& axes)
{
  bool ok = true;
  for (const int n : { 64, 128, 256 })
  {
    const Image grid = MakeGridAround(mesh, n);
    vtkNew<vtkDepthBufferVoxelizer> voxelizer;
    voxelizer->SetInputData(mesh);
    voxelizer->SetReferenceImage(grid);
    voxelizer->SetAxes(axes[0], axes[1], axes[2]);
    voxelizer->Update();
    const Volume expected = CrossingParityReference(mesh, Grid::FromImage(grid));
    ok &= Report(name + " " + std::to_string(n) + NameOf(axes),
      Compare(voxelizer->GetOutput(), expected), mesh, VoxelSolidTests::RasterTolerance);
  }
  return ok;
}

/// The paper's kind of objects. Some are seen all over. The windings of the knot and the wheels of
/// the truck hide something from all axes, which is filled as the depth reference says; nothing of
/// theirs may be missing.
bool CheckPaperObjects()
{
  bool ok = true;
  for (const auto& [name, mesh] : PaperObjects())
  {
    for (const int n : { 64, 128, 256 })
    {
      const Image grid = MakeGridAround(mesh, n);
      vtkNew<vtkDepthBufferVoxelizer> voxelizer;
      voxelizer->SetInputData(mesh);
      voxelizer->SetReferenceImage(grid);
      voxelizer->Update();
      auto difference =
        Compare(voxelizer->GetOutput(), CrossingNonZeroReference(mesh, Grid::FromImage(grid)));
      if (name == "Knot" || name == "Truck")
      {
        std::cout << name << " " << n << ": " << difference.Extra.size() << " of "
                  << voxelizer->GetNumberOfFilledVoxels() << " voxels are hidden ones\n";
        difference.Extra.clear();
        ok &= n > 64 ||
          ReportDepth(name, voxelizer->GetOutput(), DepthReference(mesh, Grid::FromImage(grid)));
      }
      ok &=
        Report(name + " " + std::to_string(n), difference, mesh, VoxelSolidTests::RasterTolerance);
    }
  }
  return ok;
}

bool CheckTies()
{
  // Half open along depth. The two other axes are off the centres.
  bool ok = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    VoxelTestMeshes::Vector low{ 0.25, 0.25, 0.25 };
    VoxelTestMeshes::Vector high{ 3.75, 3.75, 3.75 };
    low[axis] = 1;
    high[axis] = 4;
    vtkNew<vtkDepthBufferVoxelizer> voxelizer;
    voxelizer->SetInputData(Box(low, high));
    voxelizer->SetReferenceImage(MakeGrid({ -2, 9, -2, 9, -2, 9 }, { 0, 0, 0 }, { 1, 1, 1 }));
    AxesUsed axes{};
    axes[axis] = true;
    voxelizer->SetAxes(axes[0], axes[1], axes[2]);
    voxelizer->Update();
    const Volume expected =
      CrossingParityReference(Box(low, high), Grid::FromImage(voxelizer->GetOutput()));
    ok &= Report("ties" + NameOf(axes), Compare(voxelizer->GetOutput(), expected));
  }
  return ok;
}

bool CheckMixture()
{
  // Meshes of a composite and props add up, and bounds are those of all.
  const Mesh box = Box({ 0, 0, 0 }, { 1, 1, 1 });
  const Mesh sphere = Sphere({ 3, 0.5, 0.5 }, 0.5);
  const Mesh far = Sphere({ 0.5, 0.5, 3 }, 0.7);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, box);
  blocks->SetBlock(1, sphere);
  vtkNew<vtkDepthBufferVoxelizer> voxelizer;
  voxelizer->SetInputData(blocks);
  voxelizer->AddProp(MakeActor(far));
  voxelizer->SetResolution(48);
  voxelizer->SetPadding(2);
  voxelizer->Update();
  const Mesh all = Appended({ box, sphere, far });
  bool ok = ReportDepth("mixture", voxelizer->GetOutput(),
    DepthReference(all, Grid::FromImage(voxelizer->GetOutput())), 0.1);
  double bounds[6];
  voxelizer->GetOutput()->GetBounds(bounds);
  if (bounds[1] < 3.4 || bounds[5] < 3.6)
  {
    std::cerr << "mixture: the bounds are too small\n";
    ok = false;
  }
  return ok;
}

bool CheckChanges()
{
  // A prop that moves is voxelized anew; one that does not is not.
  VoxelTestChecks checks;
  const auto actor = MakeActor(Box({ 0.3, 0.3, 0.3 }, { 4.3, 4.3, 4.3 }));
  vtkNew<vtkDepthBufferVoxelizer> voxelizer;
  voxelizer->AddProp(actor);
  voxelizer->SetReferenceImage(MakeGrid({ 0, 15, 0, 15, 0, 15 }, { 0, 0, 0 }, { 1, 1, 1 }));
  voxelizer->Update();
  checks.Equal("voxels of a box", voxelizer->GetNumberOfFilledVoxels(), 64);
  const vtkMTimeType before = voxelizer->GetOutput()->GetMTime();
  voxelizer->Update();
  checks.Equal("runs without a change", voxelizer->GetOutput()->GetMTime(), before);
  actor->SetScale(2);
  voxelizer->Update();
  checks.Equal("voxels of a box twice as large", voxelizer->GetNumberOfFilledVoxels(), 512);
  voxelizer->RemoveAllProps();
  voxelizer->SetInputData(Box({ 0.3, 0.3, 0.3 }, { 2.3, 2.3, 2.3 }));
  voxelizer->Update();
  checks.Equal("voxels of the input instead", voxelizer->GetNumberOfFilledVoxels(), 8);
  return checks.Passed();
}

bool CheckDepths()
{
  VoxelTestChecks checks;
  vtkNew<vtkDepthBufferVoxelizer> voxelizer;
  voxelizer->SetInputData(Box({ 0.6, 1.6, 2.6 }, { 3.3, 5.3, 7.3 }));
  voxelizer->SetReferenceImage(MakeGrid({ 0, 9, 0, 10, 0, 11 }, { 0, 0, 0 }, { 1, 1, 1 }));
  checks.Equal("pairs before a run", voxelizer->GetNumberOfDepthBufferPairs(), 0);
  voxelizer->SetAxes(true, false, true);
  voxelizer->Update();
  checks.Equal("pairs", voxelizer->GetNumberOfDepthBufferPairs(), 2);
  vtkNew<vtkImageData> depths;
  const auto check = [&](int pair, int side, int u, int v, double expected)
  {
    voxelizer->GetDepthBuffer(pair, side, depths);
    const double found = depths->GetScalarComponentAsDouble(u, v, 0, 0);
    checks.Check("depth " + std::to_string(pair) + " " + std::to_string(side) + " is " +
        std::to_string(found) + ", should be " + std::to_string(expected),
      std::abs(found - expected) < 1e-5);
  };
  check(0, vtkDepthBufferVoxelizer::BUFFER_NEAR, 2, 3, 0.6);
  check(0, vtkDepthBufferVoxelizer::BUFFER_FAR, 5, 7, 3.3);
  checks.Equal("pixels along y", depths->GetDimensions()[0], 11);
  checks.Equal("pixels along z", depths->GetDimensions()[1], 12);
  check(1, vtkDepthBufferVoxelizer::BUFFER_NEAR, 1, 2, 2.6);
  check(1, vtkDepthBufferVoxelizer::BUFFER_FAR, 3, 5, 7.3);
  voxelizer->GetDepthBuffer(1, vtkDepthBufferVoxelizer::BUFFER_NEAR, depths);
  checks.Check("nothing is behind all voxels", depths->GetScalarComponentAsDouble(0, 0, 0, 0) > 11);
  voxelizer->GetDepthBuffer(1, vtkDepthBufferVoxelizer::BUFFER_FAR, depths);
  checks.Check("nothing is before all voxels", depths->GetScalarComponentAsDouble(0, 0, 0, 0) < 0);
  VoxelTestObserver observer(voxelizer);
  checks.Check("no third pair", !voxelizer->GetDepthBuffer(2, 0, depths));
  checks.Equal("errors of a third pair", observer.Errors.size(), std::size_t(1));
  return checks.Passed();
}

bool CheckViews()
{
  VoxelTestChecks checks;
  // Four boxes around a square cavity leave a slit at its upper right edge, through which it is
  // seen along the diagonal, but along no axis.
  const Mesh beam = Appended(
    { Box({ 0.1, 0.1, 0.1 }, { 20.1, 4.1, 20.1 }), Box({ 0.1, 4.1, 0.1 }, { 4.1, 20.1, 20.1 }),
      Box({ 16.1, 4.1, 0.1 }, { 20.1, 13.1, 20.1 }), Box({ 4.1, 16.1, 0.1 }, { 13.1, 20.1, 20.1 }),
      Box({ 0.1, 0.1, 0.1 }, { 20.1, 20.1, 2.1 }), Box({ 0.1, 0.1, 18.1 }, { 20.1, 20.1, 20.1 }) });
  const Image grid = MakeGrid({ 0, 21, 0, 21, 0, 21 }, { 0, 0, 0 }, { 1, 1, 1 });
  const auto run = [&](bool carved, vtkDepthBufferVoxelizer* voxelizer)
  {
    voxelizer->SetInputData(beam);
    voxelizer->SetReferenceImage(grid);
    if (carved)
    {
      voxelizer->AddView(1, 1, 0);
    }
    voxelizer->Update();
    return OccupancyOf(voxelizer->GetOutput());
  };
  vtkNew<vtkDepthBufferVoxelizer> plain;
  vtkNew<vtkDepthBufferVoxelizer> carving;
  const Volume before = run(false, plain);
  const Volume after = run(true, carving);
  const DepthVoxels expected = DepthReference(beam, Grid::FromImage(grid));
  const Volume solid = CrossingNonZeroReference(beam, Grid::FromImage(grid));
  std::size_t lost = 0;
  std::size_t added = 0;
  for (std::size_t i = 0; i < before.Grid.NumberOfVoxels(); ++i)
  {
    lost += solid.Voxels[i] && !after.Voxels[i] ? 1 : 0;
    added += after.Voxels[i] && !before.Voxels[i] ? 1 : 0;
  }
  checks.Check("axes fill the cavity", ReportDepth("beam", plain->GetOutput(), expected));
  checks.Check("the cavity is filled", before.At({ 10, 10, 10 }) != 0);
  checks.Check("the view carves it", after.At({ 10, 10, 10 }) == 0);
  checks.Equal("voxels of the boxes lost", lost, std::size_t(0));
  checks.Equal("voxels that a view added", added, std::size_t(0));
  return checks.Passed();
}

/// Two spheres, one inside the other, have a hidden cavity under parity.
bool CheckHiddenVolume()
{
  VoxelTestChecks checks;
  vtkNew<vtkDepthBufferVoxelizer> voxelizer;
  checks.Equal("hidden volume without a run", voxelizer->GetHiddenVolumeEstimate(), -1.0);
  voxelizer->SetResolution(96);
  voxelizer->SetInputData(NestedShells({ 0, 0, 0 }, { 3.0, 1.5 }));
  voxelizer->Update();
  const double hidden = voxelizer->GetHiddenVolumeEstimate();
  const double ball = 4.0 / 3.0 * vtkMath::Pi() * 1.5 * 1.5 * 1.5;
  checks.Check("hidden volume " + std::to_string(hidden) + " is about " + std::to_string(ball),
    std::abs(hidden - ball) < 0.06 * ball);
  voxelizer->SetInputData(Sphere({ 0, 0, 0 }, 1.0));
  voxelizer->Update();
  checks.Check("nothing is hidden in a sphere",
    voxelizer->GetHiddenVolumeEstimate() < 1e-3 * 4.0 / 3.0 * vtkMath::Pi());
  return checks.Passed();
}
}

int TestDepthBufferVoxelizer(int argc, char* argv[])
{
  const Mesh bunny = ReadPLY("bunny_7k.ply", argc, argv);
  if (!bunny)
  {
    std::cerr << "bunny_7k.ply is missing\n";
    return EXIT_FAILURE;
  }
  bool ok = true;
  ok &= CheckMesh("bunny", bunny, MakeGridAround(bunny, 40));
  const Mesh knot = TorusKnot(30.0, 24, 200);
  ok &= CheckMesh("knot", knot, MakeGridAround(knot, 50));
  const Mesh star = StarPrism({ 10, 10, 10 }, 9.3, 7.1, 7);
  ok &=
    CheckMesh("star", star, MakeGrid({ -3, 30, 2, 17, 5, 40 }, { 0.1, 0.2, 0.3 }, { 1, 1, 0.5 }));
  ok &= CheckMesh("oriented star", star,
    MakeGrid({ 0, 33, -4, 30, 1, 22 }, { 3, -4, 1 }, { 0.7, 0.9, 1.1 },
      { 0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1 }));
  ok &= CheckMesh("mirrored star", star,
    MakeGrid({ 0, 20, 0, 21, 0, 22 }, { 20, 0, 0 }, { 1, 1, 1 }, { -1, 0, 0, 0, 1, 0, 0, 0, 1 }));
  ok &= CheckMesh("sheared star", star,
    MakeGrid(
      { -10, 25, 0, 21, 0, 22 }, { 0, 0, 0 }, { 1, 1, 1 }, { 1, 0.3, 0, 0, 1, 0, 0, 0.2, 1 }));
  // Larger than the grid on all sides but one: what lies before the grid hides nothing in it.
  ok &= CheckMesh("cut star", star, MakeGrid({ 0, 11, 8, 12, 9, 12 }, { 0, 0, 0 }, { 1, 1, 1 }));

  constexpr AxesUsed all = { true, true, true };
  ok &= CheckExact("sphere", Sphere({ 0, 0, 0 }, 1.0, 32), all);
  ok &= CheckExact("sphere", Sphere({ 0, 0, 0 }, 1.0, 32), { false, true, false });
  ok &= CheckExact("tetrahedron",
    Rotated(Tetrahedron({ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } })), all);
  ok &= CheckExact("torus", Torus(1.0, 0.35, 12, 24), all);
  ok &= CheckExact("torus", Torus(1.0, 0.35, 12, 24), { false, false, true });
  ok &= CheckPaperObjects();
  ok &= CheckTies();
  ok &= CheckMixture();
  ok &= CheckChanges();
  ok &= CheckDepths();
  ok &= CheckViews();
  ok &= CheckHiddenVolume();

  vtkNew<vtkDepthBufferVoxelizer> parts;
  parts->SetInputData(knot);
  parts->SetReferenceImage(MakeGridAround(knot, 150));
  ok &= VoxelSolidTests::CheckParts("knot in parts", parts, 1, 6);
  return ok ? EXIT_SUCCESS : EXIT_FAILURE;
}
