// Proves that depth buffers are drawn once for as long as scene and grid stay, whatever is made
// from them; that one axis is chosen where it tells everything, with the voxels of three axes and
// fewer draws; that buffers of earlier runs carve later ones, as images, edited or not; and that a
// run stops between buffers when it is told to.

#include "VoxelComparison.h"
#include "VoxelDepthProps.h"
#include "VoxelSolidTests.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkAssembly.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>

#include <array>
#include <cstdlib>
#include <limits>
#include <string>

using namespace VoxelReference;
using namespace VoxelTestMeshes;
using VoxelSolidTests::MakeGrid;
using VoxelSolidTests::MakeGridAround;
using Voxelizer = vtkDepthBufferVoxelizer;

namespace
{
Volume Run(Voxelizer* voxelizer)
{
  voxelizer->Update();
  return OccupancyOf(voxelizer->GetOutput());
}

std::size_t CountDifferent(const Volume& a, const Volume& b)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.Grid.NumberOfVoxels(); ++i)
  {
    count += (a.Voxels[i] != 0) != (b.Voxels[i] != 0) ? 1 : 0;
  }
  return count;
}

vtkSmartPointer<vtkActor> ActorOf(vtkPolyData* mesh)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  return VoxelDepthProps::MakeActor(mapper.Get());
}

/// A mesh on the input port, a prop, or both: what is drawn again, and what is not.
void CheckDraws(
  VoxelTestChecks& checks, const std::string& name, vtkPolyData* input, vtkActor* prop)
{
  const auto grid = MakeGrid({ 0, 19, 0, 20, 0, 21 }, { 0, 0, 0 }, { 1, 1, 1 });
  vtkNew<Voxelizer> voxelizer;
  voxelizer->SetReferenceImage(grid);
  if (input)
  {
    voxelizer->SetInputData(input);
  }
  if (prop)
  {
    voxelizer->AddProp(prop);
  }
  const auto drawn = [&](const std::string& what, int expected)
  {
    const int before = voxelizer->GetNumberOfBufferDraws();
    const Volume found = Run(voxelizer);
    checks.Equal(
      name + ", draws of " + what, voxelizer->GetNumberOfBufferDraws() - before, expected);
    // Whatever was kept: the result is that of a filter that draws everything.
    vtkNew<Voxelizer> fresh;
    fresh->SetReferenceImage(grid);
    if (input)
    {
      fresh->SetInputData(input);
    }
    if (prop)
    {
      // Drawing by another filter would count as a change of the prop.
      const auto copy = ActorOf(vtkPolyData::SafeDownCast(prop->GetMapper()->GetInput()));
      copy->SetPosition(prop->GetPosition());
      fresh->AddProp(copy);
    }
    fresh->SetAxes(voxelizer->GetAxes());
    fresh->SetOutputMode(voxelizer->GetOutputMode());
    fresh->SetConnectivity(voxelizer->GetConnectivity());
    if (voxelizer->GetNumberOfViews() > 0)
    {
      fresh->AddView(1, 1, 1);
    }
    checks.Equal(name + ", voxels unlike a fresh run's, " + what, CountDifferent(Run(fresh), found),
      std::size_t(0));
  };
  drawn("a first run", 6);
  voxelizer->SetOutputModeToSurface();
  drawn("the surface", 0);
  voxelizer->SetConnectivity(8);
  drawn("another connectivity", 0);
  voxelizer->SetOutputModeToDensity();
  drawn("the density", 0);
  voxelizer->SetOutputModeToSolid();
  voxelizer->AddView(1, 1, 1);
  drawn("one more view", 2);
  voxelizer->RemoveAllViews();
  voxelizer->SetAxes(false, true, false);
  drawn("fewer axes", 0);
  voxelizer->SetAxes(true, true, true);
  drawn("all axes again", 0);
  if (prop)
  {
    prop->SetPosition(0.5, 0, 0);
    drawn("a prop that moved", 6);
  }
  if (input)
  {
    double place[3];
    input->GetPoints()->GetPoint(0, place);
    input->GetPoints()->SetPoint(0, place[0] + 1.0, place[1], place[2]);
    input->GetPoints()->Modified();
    input->Modified();
    drawn("a mesh that changed", 6);
  }
  grid->SetSpacing(1.1, 1, 1);
  drawn("another grid", 6);
}

/// Parts of an assembly are looked at, too.
void CheckAssembly(VoxelTestChecks& checks)
{
  vtkNew<vtkAssembly> assembly;
  const Mesh box = Box({ 1.3, 1.3, 1.3 }, { 4.3, 4.3, 4.3 });
  assembly->AddPart(ActorOf(box));
  vtkNew<Voxelizer> voxelizer;
  voxelizer->AddProp(assembly);
  voxelizer->SetReferenceImage(MakeGrid({ 0, 9, 0, 9, 0, 9 }, { 0, 0, 0 }, { 1, 1, 1 }));
  checks.Equal("voxels of an assembly", Run(voxelizer).CountNonZero(), std::size_t(27));
  for (vtkIdType i = 0; i < box->GetNumberOfPoints(); ++i)
  {
    double p[3];
    box->GetPoint(i, p);
    box->GetPoints()->SetPoint(i, p[0] > 2 ? 6.3 : p[0], p[1], p[2]);
  }
  box->GetPoints()->Modified();
  box->Modified();
  checks.Equal(
    "voxels when the mesh of its part grows", Run(voxelizer).CountNonZero(), std::size_t(45));
}

/// The axes used, the number of draws, and the voxels of all axes.
void CheckAutomatic(VoxelTestChecks& checks, const std::string& name, vtkPolyData* mesh,
  vtkImageData* grid, const std::string& expected, int draws)
{
  vtkNew<Voxelizer> all;
  all->SetInputData(mesh);
  all->SetReferenceImage(grid);
  vtkNew<Voxelizer> automatic;
  automatic->SetInputData(mesh);
  automatic->SetReferenceImage(grid);
  automatic->AutomaticAxesOn();
  const Volume reference = Run(all);
  const Volume found = Run(automatic);
  const bool* used = automatic->GetUsedAxes();
  checks.Equal(name + ", axes used",
    std::string(used[0] ? "x" : "") + (used[1] ? "y" : "") + (used[2] ? "z" : ""), expected);
  checks.Equal(name + ", draws", automatic->GetNumberOfBufferDraws(), draws);
  // Where columns touch the surface from aside, OpenGL rounds each axis on its own.
  const auto difference = Compare(automatic->GetOutput(), reference);
  checks.Check(name + ": as along all axes",
    Report(name + ", automatic", difference, mesh, VoxelSolidTests::RasterTolerance));
  automatic->SetOutputModeToSurface();
  const Volume surface = Run(automatic);
  checks.Equal(name + ", draws for the surface", automatic->GetNumberOfBufferDraws(), draws);
  checks.Check(name + ": there is a surface",
    surface.CountNonZero() > 0 && surface.CountNonZero() < found.CountNonZero());
  automatic->SetOutputModeToDensity();
  automatic->Update();
  used = automatic->GetUsedAxes();
  checks.Check(name + ": densities come from all axes", used[0] && used[1] && used[2]);
}

void CheckAllAutomatic(VoxelTestChecks& checks)
{
  const Mesh sphere = Sphere({ 0.01, 0.02, 0.03 }, 1.0, 32);
  // The columns along the longest side are the fewest.
  CheckAutomatic(checks, "sphere", sphere,
    MakeGrid({ 0, 40, 0, 50, 0, 43 }, { -1.1, -1.2, -1.15 }, { 0.055, 0.05, 0.053 }), "y", 2);
  CheckAutomatic(checks, "tetrahedron",
    Rotated(Tetrahedron({ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } })),
    MakeGrid({ 0, 40, 0, 41, 0, 42 }, { -0.5, -0.5, -0.5 }, { 0.05, 0.05, 0.05 }), "z", 2);
  // Only along its axis of symmetry is all of a torus seen; the others are tried before.
  const Mesh torus = Torus(1.0, 0.35, 12, 24);
  CheckAutomatic(checks, "torus", torus, MakeGridAround(torus, 50), "z", 4);
  CheckAutomatic(
    checks, "tilted torus", Rotated(torus), MakeGridAround(Rotated(torus), 50), "z", 4);
  const Mesh knot = TorusKnot(30.0, 24, 200);
  CheckAutomatic(checks, "knot", knot, MakeGridAround(knot, 50), "xyz", 6);

  vtkNew<Voxelizer> withProp;
  withProp->AddProp(ActorOf(sphere));
  withProp->SetResolution(20);
  withProp->AutomaticAxesOn();
  withProp->Update();
  const bool* used = withProp->GetUsedAxes();
  checks.Check("props are seen along all axes", used[0] && used[1] && used[2]);

  vtkNew<Voxelizer> restricted;
  restricted->SetInputData(sphere);
  restricted->SetResolution(20);
  restricted->AutomaticAxesOn();
  restricted->SetAxes(true, false, true);
  restricted->Update();
  used = restricted->GetUsedAxes();
  checks.Check("one of the axes that are allowed", used[0] != used[2] && !used[1]);
}

/// Buffers of one run, given to another.
void CheckSculpting(VoxelTestChecks& checks)
{
  const auto grid = MakeGrid({ 0, 23, 2, 24, -1, 20 }, { 0.1, 0.2, 0.3 }, { 1, 1, 1 });
  const Mesh block = Rotated(Box({ 3.2, 4.1, 2.3 }, { 20.2, 21.4, 17.9 }));
  const Mesh tool = Sphere({ 12, 13, 9 }, 9.0);
  vtkNew<Voxelizer> first;
  first->SetInputData(block);
  first->SetReferenceImage(grid);
  const Volume solid = Run(first);

  vtkNew<Voxelizer> carving;
  carving->SetInputData(tool);
  carving->SetReferenceImage(grid);
  const Volume ball = Run(carving);
  vtkNew<Voxelizer> restoring;
  restoring->SetReferenceImage(grid);
  std::array<vtkNew<vtkImageData>, 6> buffers;
  for (int axis = 0; axis < 3; ++axis)
  {
    first->GetDepthBuffer(axis, Voxelizer::BUFFER_NEAR, buffers[2 * axis]);
    first->GetDepthBuffer(axis, Voxelizer::BUFFER_FAR, buffers[2 * axis + 1]);
    carving->AddDepthBuffers(axis, buffers[2 * axis], buffers[2 * axis + 1]);
    restoring->AddDepthBuffers(axis, buffers[2 * axis], buffers[2 * axis + 1]);
  }
  const int draws = carving->GetNumberOfBufferDraws();
  const Volume carved = Run(carving);
  checks.Equal("draws of given buffers", carving->GetNumberOfBufferDraws(), draws);
  Volume both(solid.Grid);
  for (std::size_t i = 0; i < both.Grid.NumberOfVoxels(); ++i)
  {
    both.Voxels[i] = static_cast<unsigned char>(solid.Voxels[i] && ball.Voxels[i]);
  }
  checks.Equal("voxels unlike the intersection", CountDifferent(carved, both), std::size_t(0));
  checks.Check("the intersection is less than each",
    both.CountNonZero() > 0 && both.CountNonZero() < solid.CountNonZero() &&
      both.CountNonZero() < ball.CountNonZero());
  checks.Equal("voxels unlike those the buffers are of", CountDifferent(Run(restoring), solid),
    std::size_t(0));
  checks.Equal("draws without a scene", restoring->GetNumberOfBufferDraws(), 0);
  carving->SetOutputModeToSurface();
  checks.Check("the intersection has a surface",
    Run(carving).CountNonZero() > 0 && Run(carving).CountNonZero() < both.CountNonZero());
  carving->SetOutputModeToSolid();
  // A new pair from aside: an earlier pair alone, and what is drawn along another axis.
  carving->RemoveAllDepthBuffers();
  carving->SetAxes(true, false, false);
  carving->AddDepthBuffers(1, buffers[2], buffers[3]);
  carving->Update();
  checks.Equal("pairs", carving->GetNumberOfDepthBufferPairs(), 2);

  // Images may be worked on: half of them is emptied.
  auto* depths = buffers[4]->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < depths->GetNumberOfTuples() / 2; ++i)
  {
    depths->SetComponent(i, 0, std::numeric_limits<double>::quiet_NaN());
  }
  buffers[4]->Modified();
  const int halfOfRows = grid->GetDimensions()[1] * grid->GetDimensions()[0] / 2;
  Volume expected(solid.Grid);
  for (std::size_t i = 0; i < expected.Grid.NumberOfVoxels(); ++i)
  {
    const std::size_t column = i % (grid->GetDimensions()[0] * grid->GetDimensions()[1]);
    expected.Voxels[i] =
      static_cast<unsigned char>(solid.Voxels[i] && column >= std::size_t(halfOfRows));
  }
  checks.Equal(
    "voxels unlike the emptied half", CountDifferent(Run(restoring), expected), std::size_t(0));
}

void CheckGivenErrors(VoxelTestChecks& checks)
{
  vtkNew<vtkImageData> small;
  small->SetDimensions(3, 3, 1);
  small->AllocateScalars(VTK_FLOAT, 1);
  small->GetPointData()->GetScalars()->Fill(1.0);
  vtkNew<Voxelizer> voxelizer;
  voxelizer->SetInputData(Box({ 0, 0, 0 }, { 1, 1, 1 }));
  voxelizer->SetResolution(8);
  {
    const VoxelTestObserver observer(voxelizer);
    voxelizer->AddDepthBuffers(3, small, small);
    observer.ExpectOneError(checks, "axis of given buffers", "from 0 to 2");
  }
  {
    const VoxelTestObserver observer(voxelizer);
    voxelizer->AddDepthBuffers(0, small, nullptr);
    observer.ExpectOneError(checks, "null buffer", "two images");
  }
  voxelizer->AddDepthBuffers(0, small, small);
  {
    const VoxelTestObserver observer(voxelizer);
    voxelizer->Update();
    observer.ExpectOneError(checks, "size of given buffers", "8 x 8 columns");
    checks.Equal("voxels after that", voxelizer->GetNumberOfFilledVoxels(), vtkIdType(-1));
  }
  voxelizer->RemoveAllDepthBuffers();
  voxelizer->Update();
  checks.Equal("voxels afterwards", voxelizer->GetNumberOfFilledVoxels(), 512);
  vtkNew<Voxelizer> unplaced;
  unplaced->AddDepthBuffers(0, small, small);
  const VoxelTestObserver observer(unplaced);
  unplaced->Update();
  observer.ExpectOneError(checks, "given buffers without a grid", "no points");
}

/// Stopped after each of its reports: nothing comes out, and the next run is as if it were the
/// first.
void CheckAbort(VoxelTestChecks& checks, bool hasProp)
{
  const Mesh mesh = Sphere({ 8, 8, 8 }, 6.0);
  const Mesh box = Box({ 1.3, 1.3, 1.3 }, { 5.3, 5.3, 5.3 });
  const auto grid = MakeGrid({ 0, 15, 0, 15, 0, 15 }, { 0, 0, 0 }, { 1, 1, 1 });
  const auto prepare = [&](Voxelizer* voxelizer)
  {
    voxelizer->SetInputData(mesh);
    voxelizer->SetReferenceImage(grid);
    if (hasProp)
    {
      voxelizer->AddProp(ActorOf(box));
    }
  };
  vtkNew<Voxelizer> undisturbed;
  prepare(undisturbed);
  const Volume expected = Run(undisturbed);
  int stops = 0;
  for (bool stopped = true; stopped; ++stops)
  {
    vtkNew<Voxelizer> voxelizer;
    prepare(voxelizer);
    {
      const VoxelTestObserver observer(voxelizer);
      const VoxelTestAbort abort(voxelizer, stops);
      voxelizer->Update();
      stopped = abort.HasCome() && voxelizer->GetNumberOfFilledVoxels() < 0;
      checks.Equal("errors of a run that is stopped", observer.Errors.size(), std::size_t(0));
    }
    voxelizer->Modified();
    checks.Equal("voxels unlike an undisturbed run's, after stop " + std::to_string(stops),
      CountDifferent(Run(voxelizer), expected), std::size_t(0));
  }
  checks.Check("a run can be stopped between buffers, at " + std::to_string(stops) + " places",
    stops > (hasProp ? 12 : 6));
}
}

int TestDepthReuse(int, char*[])
{
  VoxelTestChecks checks;
  const Mesh star = StarPrism({ 10, 10, 10 }, 8.3, 7.1, 7);
  CheckDraws(checks, "mesh", Triangulated(star), nullptr);
  CheckDraws(checks, "prop", nullptr, ActorOf(Triangulated(star)));
  CheckDraws(checks, "both", Triangulated(star), ActorOf(Sphere({ 15, 14, 13 }, 4.0)));
  CheckAssembly(checks);
  CheckAllAutomatic(checks);
  CheckSculpting(checks);
  CheckGivenErrors(checks);
  CheckAbort(checks, false);
  CheckAbort(checks, true);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
