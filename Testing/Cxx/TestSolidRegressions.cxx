// Proves inputs that other voxelizers got wrong: grids that must enclose the mesh, extents that
// begin anywhere, planes through vertices and edges, shells within shells, tiny, huge and far away
// units, triangles much smaller than voxels.

#include "VoxelComparison.h"
#include "VoxelSolidTests.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkCellArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

using namespace VoxelReference;
using namespace VoxelSolidTests;
using namespace VoxelTestMeshes;

namespace
{
using Voxelizer = vtkSlicemapSolidVoxelizer;

std::string DimensionsOf(vtkImageData* image)
{
  const int* n = image->GetDimensions();
  return std::to_string(n[0]) + " " + std::to_string(n[1]) + " " + std::to_string(n[2]);
}

bool Encloses(vtkImageData* image, const double* inner)
{
  const double* outer = image->GetBounds();
  bool encloses = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double half = 0.5 * image->GetSpacing()[axis];
    const double slack = 1e-5 * half;
    encloses = encloses && outer[2 * axis] - half <= inner[2 * axis] + slack &&
      outer[2 * axis + 1] + half >= inner[2 * axis + 1] - slack;
  }
  return encloses;
}

void TestGrids(VoxelTestChecks& checks)
{
  const Mesh cube = Box({ 0, 0, 0 }, { 1, 1, 1 });
  const struct
  {
    double Size;
    const char* Dimensions;
    vtkIdType Filled;
  } sizes[] = { { 0.25, "4 4 4", 64 }, { 0.3, "4 4 4", 64 }, { 0.1, "10 10 10", 1000 },
    { 1.0, "1 1 1", 1 }, { 7.0, "1 1 1", 1 } };
  for (const auto& [size, dimensions, filled] : sizes)
  {
    for (const int backend : Backends)
    {
      vtkNew<Voxelizer> voxelizer;
      voxelizer->SetInputData(cube);
      voxelizer->SetVoxelSize(size);
      voxelizer->SetBackend(backend);
      voxelizer->Update();
      const std::string name =
        "1 mm cube at " + std::to_string(size) + ", " + NameOf(backend) + ": ";
      checks.Equal(
        name + "dimensions", DimensionsOf(voxelizer->GetOutput()), std::string(dimensions));
      checks.Equal(name + "voxels", voxelizer->GetNumberOfFilledVoxels(), filled);
      checks.Check(name + "encloses", Encloses(voxelizer->GetOutput(), cube->GetBounds()));
    }
  }

  const Mesh slab = Box({ 2, 3, 4 }, { 12, 8, 5 });
  vtkNew<Voxelizer> voxelizer;
  voxelizer->SetInputData(slab);
  voxelizer->SetResolution(20);
  voxelizer->Update();
  checks.Equal("resolution", DimensionsOf(voxelizer->GetOutput()), std::string("20 10 2"));
  checks.Equal("outermost voxels are filled", voxelizer->GetNumberOfFilledVoxels(), 400);
  voxelizer->SetPadding(3);
  voxelizer->Update();
  checks.Equal("padding", DimensionsOf(voxelizer->GetOutput()), std::string("26 16 8"));
  checks.Equal("padding adds no voxels", voxelizer->GetNumberOfFilledVoxels(), 400);
  voxelizer->SetPadding(0);
  voxelizer->SetResolution(0);
  voxelizer->SetSampleDimensions(10, 10, 10);
  voxelizer->Update();
  checks.Equal("dimensions", DimensionsOf(voxelizer->GetOutput()), std::string("10 10 10"));
  checks.Equal("cubes", voxelizer->GetOutput()->GetSpacing()[2], 1.0);
  voxelizer->CubicVoxelsOff();
  voxelizer->Update();
  checks.Check("boxes", std::abs(voxelizer->GetOutput()->GetSpacing()[2] - 0.1) < 1e-6);
  checks.Equal("all boxes are filled", voxelizer->GetNumberOfFilledVoxels(), 1000);
  voxelizer->SetOutputWholeExtent(5, 14, -3, 6, 7, 7);
  voxelizer->SetOutputOrigin(0, 0, -3);
  voxelizer->Update();
  const int* extent = voxelizer->GetOutput()->GetExtent();
  checks.Check("an extent wins over dimensions",
    extent[0] == 5 && extent[2] == -3 && extent[4] == 7 && extent[5] == 7);
  const auto reference = MakeGrid({ 1, 3, 1, 4, 1, 5 }, { 2, 3, 4 }, { 1, 1, 0.1 });
  voxelizer->SetReferenceImage(reference);
  voxelizer->Update();
  checks.Equal(
    "a reference image wins over all", DimensionsOf(voxelizer->GetOutput()), std::string("3 4 5"));

  const Mesh flat = FromTriangles({ { { { 0, 0, 1 }, { 1, 0, 1 }, { 0, 1, 1 } } } });
  vtkNew<Voxelizer> plane;
  plane->SetInputData(flat);
  plane->SetResolution(8);
  plane->SetModeToBoundary();
  plane->Update();
  checks.Equal("a flat mesh", DimensionsOf(plane->GetOutput()), std::string("8 8 1"));
  checks.Check("a flat mesh is touched", plane->GetNumberOfFilledVoxels() >= 36);
}

bool TestShells()
{
  bool good = true;
  const auto grid = MakeGrid({ -30, 39, 11, 80, 0, 69 }, { 30.3, -10.7, 0.2 }, { 1, 1, 1 });
  const Mesh touching =
    Appended({ Box({ 5, 5, 5 }, { 30, 30, 30 }), Box({ 30, 5, 5 }, { 55, 30, 30 }) });
  good &= CheckExact("touching boxes", touching, grid);
  good &= CheckExact("shells", NestedShells({ 33, 33, 33 }, { 30, 24, 18, 12 }), grid);
  const Mesh edgeOn = Rotated(Box({ 20, 20, 20 }, { 50, 20.001, 50 }));
  good &= CheckExact("thin sheet", edgeOn, grid);
  good &= CheckExact("quadrilaterals", QuadBox({ 5, 5, 5 }, { 30, 31, 32 }), grid);
  good &= CheckExact("concave polygons", StarPrism({ 33, 33, 33 }, 28.0, 40.0, 9), grid);
  return good;
}

bool TestUnits()
{
  bool good = true;
  const Mesh knot = WithDoublePrecision(TorusKnot(1.0, 16, 96));
  for (const double scale : { 1e-6, 1e-3, 1e3, 1e6 })
  {
    const Mesh mesh = Moved(knot, { 0, 0, 0 }, scale);
    good &= CheckExact("scale " + std::to_string(scale), mesh, MakeGridAround(mesh, 50));
  }
  const Mesh far = Moved(knot, { 1e6, -2e6, 3e6 });
  good &= CheckExact("far away", far, MakeGridAround(far, 64));
  return good;
}

// Most of these triangles lie between the columns, some end on them, and some are large.
bool TestFineMeshes()
{
  bool good = true;
  const Mesh fine = Sphere({ 12.0, 13.0, 14.0 }, 9.25, 220);
  const Mesh beside = Appended({ fine, Box({ 26.0, 5.5, 5.5 }, { 60.0, 40.0, 40.0 }) });
  const auto grid = MakeGrid({ 0, 63, 0, 45, 0, 44 }, { 0, 0, 0 }, { 1, 1, 1 });
  const auto turned = MakeGrid({ -3, 60, 0, 45, 0, 44 }, { 0.3, 0.1, -0.2 }, { 1, 1, 1 },
    { 0.96, -0.28, 0, 0.28, 0.96, 0, 0, 0, 1 });
  good &= CheckExact("fine sphere beside a box", beside, grid);
  good &= CheckExact("fine sphere on a lattice", OnLattice(fine, 0.25), grid);
  good &= CheckExact("fine sphere in a turned grid", WithDoublePrecision(beside), turned);
  good &= CheckExact("winding of a fine sphere", beside, grid, { vtkVoxelizer::BACKEND_COMPUTE },
    Voxelizer::FILL_RULE_NON_ZERO);
  return good;
}

void TestOtherCells(VoxelTestChecks& checks)
{
  vtkNew<vtkPolyData> mixed;
  mixed->ShallowCopy(Sphere({ 30, 30, 30 }, 25.0));
  vtkNew<vtkCellArray> lines;
  const vtkIdType line[3] = { 0, 5, 9 };
  lines->InsertNextCell(3, line);
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell(1, line);
  mixed->SetLines(lines);
  mixed->SetVerts(vertices);
  checks.Check("vertices and lines are ignored",
    CheckExact("sphere with vertices and lines", mixed, MakeGridAround(mixed, 40)));
}
}

int TestSolidRegressions(int /*argc*/, char* /*argv*/[])
{
  VoxelTestChecks checks;
  TestGrids(checks);
  checks.Check("shells", TestShells());
  checks.Check("units", TestUnits());
  checks.Check("fine meshes", TestFineMeshes());
  TestOtherCells(checks);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
