// Proves that bad input gives exactly one error that says what is wrong, an empty output, no crash
// and no work, and that the same filter works afterwards; and that what is merely odd is no error.
// All of it with the voxelizers of solids.

#include "VoxelSolidTests.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTetraCoveringVoxelizer.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <limits>

using namespace VoxelSolidTests;
using namespace VoxelTestMeshes;

namespace
{
using Voxelizer = vtkVoxelizer;
using Change = std::function<void(Voxelizer*)>;

std::array<vtkSmartPointer<Voxelizer>, 2> MakeVoxelizers()
{
  return { vtkSmartPointer<vtkSlicemapSolidVoxelizer>::New(),
    vtkSmartPointer<vtkTetraCoveringVoxelizer>::New() };
}

Mesh GoodMesh()
{
  return Box({ 0, 0, 0 }, { 1, 1, 1 });
}

Mesh WithPoint(double x)
{
  Mesh mesh = WithDoublePrecision(GoodMesh());
  mesh->GetPoints()->SetPoint(3, x, 0, 0);
  return mesh;
}

Mesh LinesOnly()
{
  Mesh mesh = Mesh::New();
  mesh->SetPoints(GoodMesh()->GetPoints());
  vtkNew<vtkCellArray> lines;
  const vtkIdType line[2] = { 0, 5 };
  lines->InsertNextCell(2, line);
  mesh->SetLines(lines);
  return mesh;
}

Mesh WithWrongId()
{
  Mesh mesh = Mesh::New();
  mesh->DeepCopy(GoodMesh());
  const vtkIdType triangle[3] = { 0, 1, 1000 };
  mesh->GetPolys()->InsertNextCell(3, triangle);
  return mesh;
}

void TestError(VoxelTestChecks& checks, const std::string& error, const Change& spoil,
  const std::string& says, Voxelizer* voxelizer)
{
  const std::string name = std::string(voxelizer->GetClassName()) + ": " + error;
  voxelizer->SetInputData(GoodMesh());
  voxelizer->SetResolution(8);
  spoil(voxelizer);
  {
    VoxelTestObserver observer(voxelizer);
    voxelizer->Update();
    observer.ExpectOneError(checks, name, says);
    checks.Equal(name + ": points of the output",
      voxelizer->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
    checks.Equal(name + ": filled voxels", voxelizer->GetNumberOfFilledVoxels(), vtkIdType(-1));
  }
  // Back to good: nothing of the failure is left.
  voxelizer->SetInputData(GoodMesh());
  voxelizer->SetResolution(8);
  voxelizer->SetVoxelSize(0.0);
  voxelizer->SetMemoryLimit(0);
  voxelizer->SetReferenceImage(nullptr);
  voxelizer->SetModelBounds(0, -1, 0, -1, 0, -1);
  voxelizer->SetOutputWholeExtent(0, -1, 0, -1, 0, -1);
  voxelizer->Update();
  checks.Equal(name + ": voxels afterwards", voxelizer->GetNumberOfFilledVoxels(), 512);
}

void TestError(
  VoxelTestChecks& checks, const std::string& name, const Change& spoil, const std::string& says)
{
  for (const auto& voxelizer : MakeVoxelizers())
  {
    TestError(checks, name, spoil, says, voxelizer);
  }
}
}

int TestVoxelizerErrors(int argc, char* argv[])
{
  VoxelTestChecks checks;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto fixBounds = [](Voxelizer* v) { v->SetModelBounds(0, 1, 0, 1, 0, 1); };

  TestError(
    checks, "empty mesh", [](Voxelizer* v) { v->SetInputData(Mesh::New()); }, "no points");
  TestError(
    checks, "empty mesh on a grid",
    [&](Voxelizer* v)
    {
      v->SetInputData(Mesh::New());
      fixBounds(v);
    },
    "no polygons");
  TestError(
    checks, "lines only", [](Voxelizer* v) { v->SetInputData(LinesOnly()); }, "no polygons");
  for (const double x : { nan, infinity, -infinity, 1e200 })
  {
    TestError(
      checks, "point at " + std::to_string(x),
      [&](Voxelizer* v)
      {
        v->SetInputData(WithPoint(x));
        fixBounds(v);
      },
      "NaN, infinite");
  }
  TestError(
    checks, "wrong point id", [](Voxelizer* v) { v->SetInputData(WithWrongId()); },
    "does not exist");
  TestError(
    checks, "zero dimensions",
    [](Voxelizer* v)
    {
      v->SetResolution(0);
      v->SetSampleDimensions(4, 0, 4);
    },
    "SampleDimensions");
  TestError(
    checks, "negative resolution", [](Voxelizer* v) { v->SetResolution(-3); }, "Resolution");
  TestError(
    checks, "negative voxel size", [](Voxelizer* v) { v->SetVoxelSize(-1.0); }, "VoxelSize");
  TestError(
    checks, "bounds without a size", [](Voxelizer* v) { v->SetModelBounds(2, 2, 3, 3, 4, 4); },
    "no size");
  TestError(
    checks, "negative spacing",
    [](Voxelizer* v)
    {
      v->SetOutputWholeExtent(0, 3, 0, 3, 0, 3);
      v->SetOutputSpacing(1, -1, 1);
    },
    "spacings must be positive");
  TestError(
    checks, "empty extent", [](Voxelizer* v) { v->SetOutputWholeExtent(0, 3, 5, 2, 0, 3); },
    "empty");
  TestError(
    checks, "singular direction",
    [](Voxelizer* v)
    {
      v->SetOutputWholeExtent(0, 3, 0, 3, 0, 3);
      double flat[9] = { 1, 0, 0, 0, 1, 0, 1, 0, 0 };
      v->SetOutputDirection(flat);
    },
    "singular");
  TestError(
    checks, "empty reference image",
    [](Voxelizer* v)
    {
      vtkNew<vtkImageData> image;
      v->SetReferenceImage(image);
    },
    "reference image is empty");
  TestError(
    checks, "memory limit",
    [](Voxelizer* v)
    {
      v->SetResolution(64);
      v->SetMemoryLimit(100000);
    },
    "64 x 64 x 64");

  const auto start = std::chrono::steady_clock::now();
  TestError(
    checks, "grid beyond memory", [](Voxelizer* v) { v->SetResolution(20000); },
    "20000 x 20000 x 20000");
  TestError(
    checks, "grid beyond integers", [](Voxelizer* v) { v->SetVoxelSize(1e-12); }, "too many");
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  checks.Check("refusing large grids takes no time", elapsed.count() < 2.0);

  for (const auto& voxelizer : MakeVoxelizers())
  {
    VoxelTestObserver observer(voxelizer);
    voxelizer->SetOutputScalarType(VTK_FLOAT);
    checks.Equal("errors of a wrong scalar type", observer.Errors.size(), std::size_t(1));
    checks.Equal("scalar type", voxelizer->GetOutputScalarType(), VTK_UNSIGNED_CHAR);
    voxelizer->Update();
    checks.Check("an unconnected filter gives nothing",
      voxelizer->GetOutput()->GetPointData()->GetNumberOfArrays() == 0);
  }

  // Odd, but no error: duplicate triangles cancel, degenerate ones are nothing.
  for (const Mesh& odd :
    { Appended({ GoodMesh(), GoodMesh() }), WithDegenerates(GoodMesh(), 1, 20) })
  {
    for (const auto& voxelizer : MakeVoxelizers())
    {
      VoxelTestObserver observer(voxelizer);
      voxelizer->SetInputData(odd);
      voxelizer->SetResolution(8);
      voxelizer->Update();
      checks.Equal("errors and warnings of odd triangles",
        observer.Errors.size() + observer.Warnings.size(), std::size_t(0));
      checks.Check("odd triangles give all or nothing",
        voxelizer->GetNumberOfFilledVoxels() == 0 || voxelizer->GetNumberOfFilledVoxels() == 512);
    }
  }

  // A hole: one warning with the number of edges.
  const Mesh bunny = ReadPLY("bunny_7k.ply", argc, argv);
  const Mesh holed = WithHoles(bunny, 4, 3);
  for (const int backend : Backends)
  {
    for (const auto& voxelizer : MakeVoxelizers())
    {
      const std::string name = voxelizer->GetClassName() + (", " + NameOf(backend));
      VoxelTestObserver observer(voxelizer);
      voxelizer->SetInputData(holed);
      voxelizer->SetResolution(100);
      voxelizer->SetBackend(backend);
      voxelizer->Update();
      checks.Equal(name + ": warnings of a hole", observer.Warnings.size(), std::size_t(1));
      const int open = CountOpenEdges(holed);
      const std::string says = std::to_string(open) + " open";
      checks.Check(name + ": the warning names " + says,
        !observer.Warnings.empty() && observer.Warnings[0].find(says) != std::string::npos);
      if (auto* solid = vtkSlicemapSolidVoxelizer::SafeDownCast(voxelizer))
      {
        checks.Check(name + ": columns leak", solid->GetNumberOfLeakingColumns() > 0);
      }
      if (auto* tetrahedra = vtkTetraCoveringVoxelizer::SafeDownCast(voxelizer))
      {
        checks.Equal(name + ": open edges", tetrahedra->GetNumberOfOpenEdges(), vtkIdType(open));
      }
      voxelizer->CheckWatertightOff();
      voxelizer->Update();
      checks.Equal(name + ": warnings when not asked", observer.Warnings.size(), std::size_t(1));
    }
  }
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
