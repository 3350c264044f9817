// Proves that attributes and outputs that can't be had give exactly one error that says what is
// wrong, an empty output and no crash, and that the same filter works afterwards.

#include "VoxelSolidTests.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkCellData.h>
#include <vtkDataObject.h>
#include <vtkFloatArray.h>
#include <vtkHybridSurfaceVoxelizer.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <cstdlib>
#include <functional>
#include <limits>

using namespace VoxelTestMeshes;

namespace
{
using Voxelizer = vtkHybridSurfaceVoxelizer;
using Change = std::function<void(Voxelizer*, vtkPolyData*)>;

vtkSmartPointer<vtkFloatArray> MakeArray(const char* name, vtkIdType n, float value = 1.0f)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfTuples(n);
  array->Fill(value);
  return array;
}

bool IsEmpty(vtkDataObject* output)
{
  return output->GetNumberOfElements(vtkDataObject::POINT) +
    output->GetNumberOfElements(vtkDataObject::CELL) ==
    0;
}

void TestError(VoxelTestChecks& checks, const std::string& name, int port, const Change& spoil,
  const std::string& says)
{
  const Mesh mesh = Box({ 0, 0, 0 }, { 8, 8, 8 });
  mesh->GetPointData()->AddArray(MakeArray("good", mesh->GetNumberOfPoints()));
  vtkNew<Voxelizer> voxelizer;
  voxelizer->SetInputData(mesh);
  voxelizer->SetResolution(8);
  spoil(voxelizer, mesh);
  {
    VoxelTestObserver observer(voxelizer);
    voxelizer->Update(port);
    observer.ExpectOneError(checks, name, says);
    checks.Check(name + ": output is empty", IsEmpty(voxelizer->GetOutputDataObject(port)));
  }
  voxelizer->SetInputData(Box({ 0, 0, 0 }, { 8, 8, 8 }));
  voxelizer->RemoveAllAttributes();
  voxelizer->SetTextureImage(nullptr);
  voxelizer->SetReferenceImage(nullptr);
  voxelizer->SetMemoryLimit(0);
  voxelizer->Update(port);
  checks.Check(name + ": works afterwards", !IsEmpty(voxelizer->GetOutputDataObject(port)));
}

void TestSettings(VoxelTestChecks& checks)
{
  vtkNew<Voxelizer> voxelizer;
  VoxelTestObserver observer(voxelizer);
  voxelizer->SetSeparability(18);
  checks.Equal("separability 18: errors", observer.Errors.size(), std::size_t(1));
  checks.Equal("separability 18", voxelizer->GetSeparability(), 26);
  voxelizer->AddAttribute("");
  checks.Equal("attribute without a name: errors", observer.Errors.size(), std::size_t(2));
  voxelizer->AddAttribute("a");
  voxelizer->AddAttribute("b");
  voxelizer->AddAttribute("a");
  checks.Equal("number of attributes", voxelizer->GetNumberOfAttributes(), 2);
  checks.Equal("attribute 1", std::string(voxelizer->GetAttribute(1)), std::string("b"));
  checks.Check("no attribute 2", voxelizer->GetAttribute(2) == nullptr);
}
}

int TestSurfaceErrors(int, char*[])
{
  VoxelTestChecks checks;
  for (const int port : { 0, 1, 2 })
  {
    const std::string at = " at port " + std::to_string(port);
    TestError(
      checks, "missing array" + at, port,
      [](Voxelizer* v, vtkPolyData*) { v->AddAttribute("bad"); },
      "no point or cell array named \"bad\"; its arrays are: good");
    TestError(
      checks, "short array" + at, port,
      [](Voxelizer* v, vtkPolyData* mesh)
      {
        mesh->GetCellData()->AddArray(MakeArray("short", 3));
        v->AddAttribute("short");
      },
      "has 3 tuples, but the mesh has 12 cells");
    TestError(
      checks, "array of strings" + at, port,
      [](Voxelizer* v, vtkPolyData* mesh)
      {
        vtkNew<vtkStringArray> strings;
        strings->SetName("strings");
        strings->SetNumberOfValues(mesh->GetNumberOfPoints());
        mesh->GetPointData()->AddArray(strings);
        v->AddAttribute("strings");
      },
      "only arrays of numbers");
    TestError(
      checks, "array with NaN" + at, port,
      [](Voxelizer* v, vtkPolyData* mesh)
      {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        mesh->GetPointData()->AddArray(MakeArray("nan", mesh->GetNumberOfPoints(), nan));
        v->AddAttribute("nan");
      },
      "NaN or infinite");
    TestError(
      checks, "texture without coordinates" + at, port,
      [](Voxelizer* v, vtkPolyData*)
      {
        vtkNew<vtkImageData> image;
        image->SetDimensions(2, 2, 1);
        image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
        v->SetTextureImage(image);
      },
      "no texture coordinates");
    TestError(
      checks, "texture of floats" + at, port,
      [](Voxelizer* v, vtkPolyData*)
      {
        vtkNew<vtkImageData> image;
        image->SetDimensions(2, 2, 1);
        image->AllocateScalars(VTK_FLOAT, 3);
        v->SetTextureImage(image);
      },
      "unsigned char");
    TestError(
      checks, "blocks with and without the array" + at, port,
      [](Voxelizer* v, vtkPolyData* mesh)
      {
        vtkNew<vtkMultiBlockDataSet> blocks;
        blocks->SetBlock(0, mesh);
        blocks->SetBlock(1, Box({ 10, 0, 0 }, { 12, 2, 2 }));
        v->SetInputDataObject(blocks);
        v->AddAttribute("good");
      },
      "no point or cell array named \"good\"");
    TestError(
      checks, "no polygons" + at, port,
      [](Voxelizer* v, vtkPolyData* mesh)
      {
        Mesh points = Mesh::New();
        points->SetPoints(mesh->GetPoints());
        v->SetInputData(points);
      },
      "no polygons");
  }
  TestError(
    checks, "rotated tree", 2,
    [](Voxelizer* v, vtkPolyData*)
    {
      v->SetReferenceImage(VoxelSolidTests::MakeGrid(
        { 0, 7, 0, 7, 0, 7 }, { 0, 0, 0 }, { 1, 1, 1 }, { 0, -1, 0, 1, 0, 0, 0, 0, 1 }));
    },
    "can't be rotated");
  TestError(
    checks, "image too large for its attributes", 0,
    [](Voxelizer* v, vtkPolyData*)
    {
      v->AddAttribute("good");
      v->SetMemoryLimit(8 * 8 * 8 * 3);
    },
    "allowed by MemoryLimit");
  for (const int port : { 1, 2 })
  {
    TestError(
      checks, "too many voxels at port " + std::to_string(port), port,
      [](Voxelizer* v, vtkPolyData*) { v->SetMemoryLimit(1000); }, "allowed by MemoryLimit");
  }
  TestSettings(checks);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
