// Proves what all filters on voxels have in common, by one that inverts them and one that halves
// the grid: any input image gives the right bits on any grid, points or cells; a slicemap is taken
// without a transfer and never changed; other scalars are uploaded once; each bad input gives one
// error and an empty output.

#include "VoxelComparison.h"
#include "VoxelFilterTests.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkSlicemap.h>
#include <vtkSlicemapSolidVoxelizer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVoxelContext.h>
#include <vtkVoxelFilter.h>
#include <vtkVoxelGLObjects.h>
#include <vtkVoxelGrid.h>

#include <cstdlib>
#include <functional>

using namespace VoxelFilterTests;
using VoxelReference::Compare;
using VoxelReference::Volume;

namespace
{
class Inverter : public vtkVoxelFilter
{
public:
  static Inverter* New();
  vtkTypeMacro(Inverter, vtkVoxelFilter);

protected:
  bool Process(const std::vector<vtkSlicemap*>& inputs, vtkSlicemap* output) override
  {
    if (!output->Allocate(inputs[0]->GetGrid()))
    {
      return false;
    }
    inputs[0]->GetBuffer().CopyTo(output->GetBuffer(), 0, 0, inputs[0]->GetBuffer().GetSize());
    return this->ReportProgress(0.5) && output->Complement();
  }
};
vtkStandardNewMacro(Inverter);

/// Every second voxel along each axis, none of which is set.
class Halver : public vtkVoxelFilter
{
public:
  static Halver* New();
  vtkTypeMacro(Halver, vtkVoxelFilter);

protected:
  bool Process(const std::vector<vtkSlicemap*>& inputs, vtkSlicemap* output) override
  {
    if (!output->Allocate(this->GetOutputGrid(inputs[0]->GetGrid())))
    {
      return false;
    }
    output->GetBuffer().Fill(0);
    return true;
  }

  vtkVoxelGrid GetOutputGrid(const vtkVoxelGrid& input) override
  {
    const glm::ivec3 n = (input.GetDimensions() + 1) / 2;
    auto grid = input.WithExtent({ 0, n.x - 1, 0, n.y - 1, 0, n.z - 1 });
    grid.Spacing *= 2.0;
    return grid;
  }
};
vtkStandardNewMacro(Halver);

Volume Inverse(vtkImageData* grid, const Volume& voxels)
{
  return MakeVoxels(grid, [&](std::size_t offset) { return !voxels.Voxels[offset]; });
}

void TestInputs(VoxelTestChecks& checks)
{
  unsigned int seed = 1;
  for (const auto& [name, grid] : AwkwardGrids())
  {
    const Volume voxels = RandomVoxels(grid, ++seed);
    const Volume expected = Inverse(grid, voxels);
    for (const int type : { VTK_UNSIGNED_CHAR, VTK_BIT, VTK_SHORT, VTK_FLOAT, VTK_LONG_LONG })
    {
      for (const bool cells : { false, true })
      {
        const std::string what = name + ", type " + std::to_string(type) +
          (cells ? " of cells" : " of points") + ", seed " + std::to_string(seed);
        const Image mask = MakeMask(grid, voxels, type, cells);
        vtkNew<Inverter> filter;
        filter->SetInputData(mask);
        filter->Update();
        vtkImageData* output = filter->GetOutput();
        checks.Check(what, VoxelReference::Report(what, Compare(output, expected)));
        checks.Check(
          what + ": cells for cells", (output->GetCellData()->GetScalars() != nullptr) == cells);
        checks.Check(what + ": geometry",
          vtkVoxelGrid::FromImage(output).IsSameAs(vtkVoxelGrid::FromImage(mask)));
        checks.Equal(what + ": count", filter->GetNumberOfFilledVoxels(),
          static_cast<vtkIdType>(expected.CountNonZero()));
        // The other kind of output is at the same place.
        filter->SetOutputAttributeType(
          cells ? vtkVoxelAlgorithm::ATTRIBUTE_POINT : vtkVoxelAlgorithm::ATTRIBUTE_CELL);
        filter->Update();
        checks.Check(
          what + ": other kind", VoxelReference::Report(what, Compare(output, expected)));
        checks.Check(what + ": other kind's geometry",
          vtkVoxelGrid::FromImage(output).IsSameAs(
            vtkVoxelGrid::FromImage(MakeMask(grid, voxels, VTK_UNSIGNED_CHAR, !cells))));
        int whole[6];
        filter->GetOutputInformation(0)->Get(
          vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole);
        checks.Check(
          what + ": announced extent", std::equal(whole, whole + 6, output->GetExtent()));
      }
    }
  }
}

void TestChain(VoxelTestChecks& checks)
{
  vtkNew<vtkSlicemapSolidVoxelizer> voxelizer;
  voxelizer->SetInputData(VoxelTestMeshes::Box({ 0, 0, 0 }, { 1, 2, 3 }));
  voxelizer->SetResolution(41);
  voxelizer->SetPadding(3);
  voxelizer->CheckWatertightOff();
  for (const bool cells : { false, true })
  {
    const std::string what = cells ? "cells: " : "points: ";
    voxelizer->SetOutputAttributeType(
      cells ? vtkVoxelAlgorithm::ATTRIBUTE_CELL : vtkVoxelAlgorithm::ATTRIBUTE_POINT);
    voxelizer->HostOutputOff();
    vtkNew<Inverter> once;
    once->SetInputConnection(voxelizer->GetOutputPort());
    once->HostOutputOff();
    vtkNew<Inverter> twice;
    twice->SetInputConnection(once->GetOutputPort());
    twice->HostOutputOff();
    const vtkIdType readBacks = vtkSlicemap::GetNumberOfReadBacks();
    const vtkIdType uploads = vtkSlicemap::GetNumberOfUploads();
    twice->Update();
    checks.Equal(what + "read-backs of a chain", vtkSlicemap::GetNumberOfReadBacks(), readBacks);
    checks.Equal(what + "uploads of a chain", vtkSlicemap::GetNumberOfUploads(), uploads);
    checks.Equal(what + "arrays of the output",
      twice->GetOutput()->GetPointData()->GetNumberOfArrays() +
        twice->GetOutput()->GetCellData()->GetNumberOfArrays(),
      0);
    checks.Equal(what + "voxels", voxelizer->GetNumberOfFilledVoxels(), vtkIdType(14 * 28 * 41));
    checks.Equal(what + "voxels inverted twice", twice->GetNumberOfFilledVoxels(),
      voxelizer->GetNumberOfFilledVoxels());
    checks.Equal(what + "voxels inverted once", once->GetNumberOfFilledVoxels(),
      vtkIdType(20 * 34 * 47 - 14 * 28 * 41));

    twice->HostOutputOn();
    voxelizer->HostOutputOn();
    twice->Update();
    voxelizer->Update();
    checks.Check(what + "voxels read back",
      Compare(twice->GetOutput(), VoxelReference::OccupancyOf(voxelizer->GetOutput())).IsNone());
    checks.Check(what + "same geometry",
      vtkVoxelGrid::FromImage(twice->GetOutput())
        .IsSameAs(vtkVoxelGrid::FromImage(voxelizer->GetOutput())));
  }
}

void TestUploads(VoxelTestChecks& checks)
{
  const Image grid = AwkwardGrids()[1].Grid;
  const Image mask = MakeMask(grid, RandomVoxels(grid, 77));
  vtkNew<Inverter> filter;
  filter->SetInputData(mask);
  const vtkIdType uploads = vtkSlicemap::GetNumberOfUploads();
  filter->Update();
  filter->SetForegroundValue(7);
  filter->Update();
  checks.Equal("uploads of one input", vtkSlicemap::GetNumberOfUploads(), uploads + 1);
  mask->GetPointData()->GetScalars()->Fill(1.0);
  mask->GetPointData()->GetScalars()->Modified();
  filter->Update();
  checks.Equal("uploads after a change", vtkSlicemap::GetNumberOfUploads(), uploads + 2);
  checks.Equal("voxels after a change", filter->GetNumberOfFilledVoxels(), vtkIdType(0));
  mask->SetOrigin(5, 6, 7);
  filter->Update();
  checks.Equal("origin after a change", filter->GetOutput()->GetOrigin()[2], 7.0);
}

void TestOutputGrid(VoxelTestChecks& checks)
{
  const Image grid = AwkwardGrids()[1].Grid;
  for (const bool cells : { false, true })
  {
    vtkNew<Halver> filter;
    filter->SetInputData(MakeMask(grid, RandomVoxels(grid, 5), VTK_UNSIGNED_CHAR, cells));
    filter->UpdateInformation();
    int whole[6];
    filter->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole);
    checks.Equal("announced size of the other grid", whole[1], cells ? 19 : 18);
    filter->Update();
    const int* n = filter->GetOutput()->GetDimensions();
    checks.Equal(
      "size of the other grid", n[0] * 10000 + n[1] * 100 + n[2], cells ? 200705 : 190604);
    const double* corner = filter->GetOutput()->GetOrigin();
    checks.Equal("first point of the other grid", corner[0],
      grid->GetOrigin()[0] - (cells ? grid->GetSpacing()[0] : 0.0));
  }
}

void TestError(VoxelTestChecks& checks, const std::string& name,
  const std::function<void(Inverter*)>& spoil, const std::string& says)
{
  const Image grid = AwkwardGrids()[1].Grid;
  const Image good = MakeMask(grid, RandomVoxels(grid, 4));
  vtkNew<Inverter> filter;
  filter->SetInputData(good);
  filter->Update();
  const vtkIdType filled = filter->GetNumberOfFilledVoxels();
  {
    VoxelTestObserver observer(filter);
    spoil(filter);
    filter->Update();
    observer.ExpectOneError(checks, name, says);
    checks.Equal(
      name + ": arrays of the output", filter->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
    checks.Check(
      name + ": slicemap of the output", vtkSlicemap::GetFromImage(filter->GetOutput()) == nullptr);
    checks.Equal(name + ": filled voxels", filter->GetNumberOfFilledVoxels(), vtkIdType(-1));
  }
  filter->SetInputData(good);
  filter->SetMemoryLimit(0);
  filter->Update();
  checks.Equal(name + ": voxels afterwards", filter->GetNumberOfFilledVoxels(), filled);
}

void TestErrors(VoxelTestChecks& checks)
{
  TestError(
    checks, "empty image", [](Inverter* f) { f->SetInputData(Image::New()); }, "is empty");
  TestError(
    checks, "no scalars",
    [](Inverter* f)
    {
      const Image image = Image::New();
      image->SetDimensions(3, 4, 5);
      f->SetInputData(image);
    },
    "no scalars");
  TestError(
    checks, "too few scalars",
    [](Inverter* f)
    {
      const Image image = Image::New();
      image->SetDimensions(3, 4, 5);
      vtkNew<vtkUnsignedCharArray> scalars;
      scalars->SetNumberOfTuples(59);
      image->GetPointData()->SetScalars(scalars);
      f->SetInputData(image);
    },
    "59 values");
  TestError(
    checks, "memory limit", [](Inverter* f) { f->SetMemoryLimit(100); }, "37 x 11 x 7");

  // Bits in a window of their own: of no use without scalars.
  const auto window =
    vtkSmartPointer<vtkRenderWindow>::Take(vtkVoxelContext::NewHeadlessRenderWindow());
  vtkNew<vtkSlicemapSolidVoxelizer> elsewhere;
  elsewhere->SetInputData(VoxelTestMeshes::Box({ 0, 0, 0 }, { 1, 1, 1 }));
  elsewhere->SetResolution(10);
  elsewhere->SetRenderWindow(window);
  elsewhere->HostOutputOff();
  TestError(
    checks, "other context",
    [&](Inverter* f) { f->SetInputConnection(elsewhere->GetOutputPort()); },
    "another OpenGL context");
  elsewhere->HostOutputOn();
  vtkNew<Inverter> filter;
  filter->SetInputConnection(elsewhere->GetOutputPort());
  filter->Update();
  checks.Equal("voxels from another context", filter->GetNumberOfFilledVoxels(), vtkIdType(0));
  filter->SetRenderWindow(window);
  const vtkIdType uploads = vtkSlicemap::GetNumberOfUploads();
  filter->Update();
  checks.Equal("uploads in the same window", vtkSlicemap::GetNumberOfUploads(), uploads);

  vtkNew<Inverter> unconnected;
  VoxelTestObserver observer(unconnected);
  unconnected->Update();
  checks.Check("an unconnected filter gives nothing",
    unconnected->GetOutput()->GetPointData()->GetNumberOfArrays() == 0);
}

void TestAbort(VoxelTestChecks& checks)
{
  const Image grid = AwkwardGrids()[1].Grid;
  vtkNew<Inverter> filter;
  filter->SetInputData(MakeMask(grid, RandomVoxels(grid, 9)));
  {
    const VoxelTestAbort abort(filter);
    filter->Update();
    checks.Equal(
      "arrays after an abort", filter->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
  }
  filter->Modified();
  filter->Update();
  checks.Check("a run after an abort works", filter->GetNumberOfFilledVoxels() > 0);
}
}

int TestVoxelFilter(int, char*[])
{
  VoxelTestChecks checks;
  TestInputs(checks);
  TestChain(checks);
  TestUploads(checks);
  TestOutputGrid(checks);
  TestErrors(checks);
  TestAbort(checks);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
