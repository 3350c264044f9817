// Proves how the voxelizers behave in a pipeline: the mesh goes up once, progress rises, abort
// leaves an empty output, the slicemap travels with the image, a user's window gives the same
// voxels and is left as it was, parts and kinds of output agree.

#include "VoxelComparison.h"
#include "VoxelSolidTests.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkBitArray.h>
#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkSlicemap.h>
#include <vtkSmartPointer.h>
#include <vtkVoxelContext.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <sstream>

using namespace VoxelReference;
using namespace VoxelSolidTests;
using namespace VoxelTestMeshes;

namespace
{
bool SameVoxels(vtkImageData* a, vtkImageData* b)
{
  return Compare(a, OccupancyOf(b)).IsNone();
}

vtkSmartPointer<vtkImageData> CopyOf(vtkImageData* image)
{
  auto copy = vtkSmartPointer<vtkImageData>::New();
  copy->DeepCopy(image);
  return copy;
}

void TestUploads(VoxelTestChecks& checks, const Mesh& mesh)
{
  vtkNew<vtkSlicemapSolidVoxelizer> voxelizer;
  voxelizer->SetInputData(mesh);
  voxelizer->SetResolution(30);
  voxelizer->Update();
  checks.Equal("uploads after one run", voxelizer->GetNumberOfMeshUploads(), 1);
  voxelizer->SetResolution(40);
  voxelizer->Update();
  checks.Equal("uploads after a change of the grid", voxelizer->GetNumberOfMeshUploads(), 1);
  mesh->GetPoints()->Modified();
  mesh->Modified();
  voxelizer->Update();
  checks.Equal("uploads after a change of the mesh", voxelizer->GetNumberOfMeshUploads(), 2);
}

void TestProgressAndAbort(VoxelTestChecks& checks, const Mesh& mesh)
{
  vtkNew<vtkSlicemapSolidVoxelizer> voxelizer;
  voxelizer->SetInputData(mesh);
  voxelizer->SetResolution(40);
  voxelizer->SetFillRuleToVote();
  std::vector<double> seen;
  vtkNew<vtkCallbackCommand> note;
  note->SetClientData(&seen);
  note->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void*)
    {
      static_cast<std::vector<double>*>(data)->push_back(
        static_cast<vtkAlgorithm*>(caller)->GetProgress());
    });
  const auto tag = voxelizer->AddObserver(vtkCommand::ProgressEvent, note);
  voxelizer->Update();
  voxelizer->RemoveObserver(tag);
  checks.Check("progress is reported", seen.size() > 3);
  checks.Check("progress rises within 0 and 1",
    std::is_sorted(seen.begin(), seen.end()) && seen.front() >= 0.0 && seen.back() <= 1.0);

  {
    const VoxelTestAbort abort(voxelizer);
    voxelizer->Modified();
    voxelizer->Update();
    checks.Equal(
      "arrays after an abort", voxelizer->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
  }
  voxelizer->Modified();
  voxelizer->Update();
  checks.Check("a run after an abort works", voxelizer->GetNumberOfFilledVoxels() > 0);
}

void TestOutputs(VoxelTestChecks& checks, const Mesh& mesh)
{
  vtkNew<vtkSlicemapSolidVoxelizer> voxelizer;
  voxelizer->SetInputData(mesh);
  voxelizer->SetResolution(45);
  voxelizer->Update();
  const auto bytes = CopyOf(voxelizer->GetOutput());
  const vtkIdType filled = voxelizer->GetNumberOfFilledVoxels();
  checks.Equal(
    "name of the array", std::string(bytes->GetPointData()->GetScalars()->GetName()), "Occupancy");

  voxelizer->SetOutputScalarTypeToBit();
  voxelizer->Update();
  checks.Check("bits are bits",
    vtkBitArray::SafeDownCast(voxelizer->GetOutput()->GetPointData()->GetScalars()) != nullptr);
  checks.Check("bits equal bytes", SameVoxels(voxelizer->GetOutput(), bytes));
  voxelizer->SetOutputScalarTypeToUnsignedChar();

  voxelizer->SetForegroundValue(200);
  voxelizer->Update();
  checks.Equal(
    "largest value", voxelizer->GetOutput()->GetPointData()->GetScalars()->GetRange()[1], 200.0);

  voxelizer->SetOutputAttributeTypeToCell();
  voxelizer->Update();
  vtkImageData* cells = voxelizer->GetOutput();
  checks.Equal("voxels as cells", cells->GetNumberOfCells(), bytes->GetNumberOfPoints());
  const vtkDataArray* inside = cells->GetCellData()->GetScalars();
  checks.Check("cell scalars", inside != nullptr);
  double bounds[6];
  vtkIdType different = 0;
  vtkIdType displaced = 0;
  for (vtkIdType id = 0; inside && id < cells->GetNumberOfCells(); ++id)
  {
    different += (cells->GetCellData()->GetScalars()->GetTuple1(id) != 0.0) !=
      (bytes->GetPointData()->GetScalars()->GetTuple1(id) != 0.0);
    cells->GetCellBounds(id, bounds);
    const double* point = bytes->GetPoint(id);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double centre = 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
      displaced += std::abs(centre - point[axis]) > 1e-9;
    }
  }
  checks.Equal("cells that differ from points", different, 0);
  checks.Equal("cells elsewhere than their points", displaced, 0);
  voxelizer->SetOutputAttributeTypeToPoint();

  const vtkIdType readBacks = vtkSlicemap::GetNumberOfReadBacks();
  voxelizer->HostOutputOff();
  voxelizer->Update();
  checks.Equal(
    "arrays without host output", voxelizer->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
  checks.Equal("count on the GPU", voxelizer->GetNumberOfFilledVoxels(), filled);
  checks.Equal("read-backs", vtkSlicemap::GetNumberOfReadBacks(), readBacks);
  vtkSlicemap* slicemap = vtkSlicemap::GetFromImage(voxelizer->GetOutput());
  checks.Check("the image carries its slicemap", slicemap != nullptr);
  if (slicemap)
  {
    vtkNew<vtkImageData> downloaded;
    checks.Check("download", slicemap->Download(downloaded));
    checks.Check("downloaded voxels", SameVoxels(downloaded, bytes));
  }
}

void TestInputs(VoxelTestChecks& checks, const Mesh& mesh)
{
  const Mesh other = Moved(mesh, { 0.3, 0.0, 0.0 });
  const auto grid = MakeGridAround(Appended({ mesh, other }), 60);
  const auto together = MakeVoxelizer(Appended({ mesh, other }), grid, 0, -1);
  together->Update();
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, mesh);
  blocks->SetBlock(2, other);
  vtkNew<vtkSlicemapSolidVoxelizer> voxelizer;
  voxelizer->SetInputDataObject(blocks);
  voxelizer->SetReferenceImage(grid);
  voxelizer->Update();
  auto* image = vtkImageData::SafeDownCast(voxelizer->GetOutputDataObject(0));
  checks.Check("a composite gives one image", image != nullptr);
  checks.Check(
    "a composite equals its leaves together", image && SameVoxels(image, together->GetOutput()));
}

void TestWindow(VoxelTestChecks& checks, const Mesh& mesh)
{
  const auto grid = MakeGridAround(mesh, 50);
  for (const int backend : Backends)
  {
    const auto shared = MakeVoxelizer(mesh, grid, backend, -1);
    shared->Update();
    auto window =
      vtkSmartPointer<vtkRenderWindow>::Take(vtkVoxelContext::NewHeadlessRenderWindow());
    checks.Check("a headless window", window != nullptr);
    const auto own = MakeVoxelizer(mesh, grid, backend, -1);
    own->SetRenderWindow(window);
    own->Update();
    checks.Check(NameOf(backend) + ": a user's window gives the same voxels",
      SameVoxels(own->GetOutput(), shared->GetOutput()));
    window = nullptr;
    own->Modified();
    own->Update();
    checks.Check(NameOf(backend) + ": the filter outlives the window",
      SameVoxels(own->GetOutput(), shared->GetOutput()));
  }
}
}

int TestVoxelizerPipeline(int argc, char* argv[])
{
  const Mesh mesh = ReadPLY("bunny_7k.ply", argc, argv);
  if (!mesh)
  {
    std::cerr << "bunny_7k.ply is missing\n";
    return EXIT_FAILURE;
  }
  VoxelTestChecks checks;
  TestUploads(checks, mesh);
  TestProgressAndAbort(checks, mesh);
  TestOutputs(checks, mesh);
  TestInputs(checks, mesh);
  TestWindow(checks, mesh);
  vtkNew<vtkSlicemapSolidVoxelizer> voxelizer;
  std::ostringstream text;
  voxelizer->Print(text);
  checks.Check(
    "PrintSelf names the fill rule", text.str().find("FillRule: Parity") != std::string::npos);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
