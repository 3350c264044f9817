// Proves that a filter that runs again writes into the arrays of its last run when nobody else
// holds them, and nothing of the last result stays in them; that arrays which somebody holds, or
// has put into the output, keep their memory and their values; and that other sizes get other
// arrays.

#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSlicemapSolidVoxelizer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVoxelDensityNormals.h>
#include <vtkWeakPointer.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace
{
/// Values of an array, whatever their type.
std::vector<double> ValuesOf(vtkDataArray* array)
{
  std::vector<double> values(array->GetNumberOfValues());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = array->GetVariantValue(static_cast<vtkIdType>(i)).ToDouble();
  }
  return values;
}

vtkSmartPointer<vtkPolyData> MeshOf(double radius)
{
  return VoxelTestMeshes::Sphere({ 0.0, 0.0, 0.0 }, radius);
}

void SetUp(vtkSlicemapSolidVoxelizer* solid)
{
  solid->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  solid->SetResolution(40);
}

/// What a filter that has never run makes.
struct Fresh
{
  vtkNew<vtkSlicemapSolidVoxelizer> Solid;
  vtkNew<vtkVoxelDensityNormals> Density;

  explicit Fresh(double radius)
  {
    SetUp(this->Solid);
    this->Solid->SetInputData(MeshOf(radius));
    this->Density->SetInputConnection(this->Solid->GetOutputPort());
    this->Density->SetKernelSize(4, 4, 4);
    this->Density->Update();
  }
};

void TestScalars(VoxelTestChecks& checks, int attributeType)
{
  const std::string name = attributeType == vtkVoxelAlgorithm::ATTRIBUTE_CELL ? "cells" : "points";
  vtkNew<vtkSlicemapSolidVoxelizer> solid;
  SetUp(solid);
  solid->SetOutputAttributeType(attributeType);
  const auto run = [&](double radius)
  {
    solid->SetInputData(MeshOf(radius));
    solid->Update();
    vtkImageData* output = solid->GetOutput();
    return attributeType == vtkVoxelAlgorithm::ATTRIBUTE_CELL
      ? output->GetCellData()->GetScalars()
      : output->GetPointData()->GetScalars();
  };
  const Fresh small(0.3);
  const auto expected = ValuesOf(small.Solid->GetOutput()->GetPointData()->GetScalars());

  const vtkWeakPointer<vtkDataArray> first = run(0.9);
  const vtkMTimeType time = first->GetMTime();
  vtkDataArray* again = run(0.3);
  checks.Check(name + ": memory is used again", first == again);
  checks.Check(name + ": the array is modified", again->GetMTime() > time);
  checks.Check(name + ": nothing is left of the larger sphere", ValuesOf(again) == expected);

  const vtkSmartPointer<vtkDataArray> held = again;
  vtkDataArray* other = run(0.9);
  checks.Check(name + ": what is held is not written to", other != held);
  checks.Check(name + ": what is held stays", ValuesOf(held) == expected);

  solid->SetResolution(20);
  checks.Check(name + ": arrays of another size", run(0.9)->GetNumberOfTuples() == 20 * 20 * 20);
}

void TestForeignArray(VoxelTestChecks& checks)
{
  vtkNew<vtkSlicemapSolidVoxelizer> solid;
  SetUp(solid);
  solid->SetInputData(MeshOf(0.5));
  solid->Update();
  std::vector<unsigned char> memory(solid->GetOutput()->GetNumberOfPoints(), 7);
  vtkNew<vtkUnsignedCharArray> foreign;
  foreign->SetArray(memory.data(), static_cast<vtkIdType>(memory.size()), 1);
  solid->GetOutput()->GetPointData()->SetScalars(foreign);
  solid->Modified();
  solid->Update();
  checks.Check("an array that somebody put into the output is not written to",
    memory == std::vector<unsigned char>(memory.size(), 7));
}

void TestDensity(VoxelTestChecks& checks)
{
  const Fresh small(0.3);
  Fresh changing(0.9);
  vtkPointData* data = changing.Density->GetOutput()->GetPointData();
  const vtkWeakPointer<vtkDataArray> density = data->GetScalars();
  const vtkWeakPointer<vtkDataArray> normals = data->GetNormals();
  changing.Solid->SetInputData(MeshOf(0.3));
  changing.Density->Update();
  vtkPointData* expected = small.Density->GetOutput()->GetPointData();
  checks.Check("memory of densities is used again", density == data->GetScalars());
  checks.Check("memory of normals is used again", normals == data->GetNormals());
  checks.Check(
    "the same densities", ValuesOf(data->GetScalars()) == ValuesOf(expected->GetScalars()));
  checks.Check(
    "the same normals", ValuesOf(data->GetNormals()) == ValuesOf(expected->GetNormals()));
}
}

int TestVoxelOutputMemory(int, char*[])
{
  VoxelTestChecks checks;
  TestScalars(checks, vtkVoxelAlgorithm::ATTRIBUTE_POINT);
  TestScalars(checks, vtkVoxelAlgorithm::ATTRIBUTE_CELL);
  TestForeignArray(checks);
  TestDensity(checks);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
