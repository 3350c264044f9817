// Proves vtkVoxelDensityNormals: counts and fractions equal plain loops over the voxels of each box
// on awkward grids, downsampled or not; normals equal the normalised gradient of those, in world
// coordinates; normals of a voxelized sphere are within 3 degrees of its own on average; a chain of
// filters before it reads nothing back; one error for each bad use.

#include "VoxelFilterTests.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMath.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSlicemap.h>
#include <vtkSlicemapSolidVoxelizer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkVoxelBoolean.h>
#include <vtkVoxelContext.h>
#include <vtkVoxelDensityNormals.h>
#include <vtkVoxelMorphology.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

using namespace VoxelFilterTests;
using VoxelReference::Volume;

namespace
{
using Filter = vtkVoxelDensityNormals;
using Triple = std::array<int, 3>;
using Vector = std::array<double, 3>;

bool HasCompute()
{
  vtkNew<vtkVoxelContext> context;
  return context->SupportsCompute();
}

/// Numbers on a grid, in the order of its points.
struct Field
{
  Triple Size;
  std::vector<int> Values;

  int At(int x, int y, int z) const
  {
    return this->Values[(std::size_t(z) * this->Size[1] + y) * this->Size[0] + x];
  }
};

Field MakeField(vtkImageData* grid, const Volume& volume)
{
  const int* n = grid->GetDimensions();
  const std::size_t count = std::size_t(n[0]) * n[1] * n[2];
  return { { n[0], n[1], n[2] }, { volume.Voxels.get(), volume.Voxels.get() + count } };
}

/// Voxels set in the box of a voxel, or in a box of the coarse grid.
Field CountsOf(const Field& voxels, const Triple& kernel, bool downsampled)
{
  Field counts;
  for (int axis = 0; axis < 3; ++axis)
  {
    counts.Size[axis] =
      downsampled ? (voxels.Size[axis] + kernel[axis] - 1) / kernel[axis] : voxels.Size[axis];
  }
  for (int z = 0; z < counts.Size[2]; ++z)
  {
    for (int y = 0; y < counts.Size[1]; ++y)
    {
      for (int x = 0; x < counts.Size[0]; ++x)
      {
        Triple first{ x, y, z };
        Triple end;
        for (int axis = 0; axis < 3; ++axis)
        {
          first[axis] = downsampled ? first[axis] * kernel[axis] : first[axis] - kernel[axis] / 2;
          end[axis] = std::min(first[axis] + kernel[axis], voxels.Size[axis]);
          first[axis] = std::max(first[axis], 0);
        }
        int count = 0;
        for (int k = first[2]; k < end[2]; ++k)
        {
          for (int j = first[1]; j < end[1]; ++j)
          {
            for (int i = first[0]; i < end[0]; ++i)
            {
              count += voxels.At(i, j, k);
            }
          }
        }
        counts.Values.push_back(count);
      }
    }
  }
  return counts;
}

/// Axes of the grid to the world; only for matrices that turn or mirror.
Vector NormalOf(const Field& counts, const Triple& at, bool symmetric, vtkImageData* output)
{
  Vector gradient;
  for (int axis = 0; axis < 3; ++axis)
  {
    Triple before = at;
    Triple behind = at;
    before[axis] = symmetric ? std::max(at[axis] - 1, 0) : at[axis];
    behind[axis] = std::min(at[axis] + 1, counts.Size[axis] - 1);
    gradient[axis] =
      (counts.At(before[0], before[1], before[2]) - counts.At(behind[0], behind[1], behind[2])) /
      output->GetSpacing()[axis];
  }
  Vector normal;
  output->GetDirectionMatrix()->MultiplyPoint(gradient.data(), normal.data());
  vtkMath::Normalize(normal.data());
  return normal;
}

int CountDifferences(vtkDataArray* density, const Field& counts, double unit)
{
  if (!density || density->GetNumberOfTuples() != vtkIdType(counts.Values.size()))
  {
    return -1;
  }
  int differences = 0;
  for (vtkIdType i = 0; i < density->GetNumberOfTuples(); ++i)
  {
    differences += density->GetComponent(i, 0) == counts.Values[i] * unit ? 0 : 1;
  }
  return differences;
}

int CountWrongNormals(
  vtkDataArray* normals, const Field& counts, bool symmetric, vtkImageData* output)
{
  if (!normals || normals->GetNumberOfTuples() != vtkIdType(counts.Values.size()))
  {
    return -1;
  }
  constexpr double tolerance = 1e-6;
  int wrong = 0;
  vtkIdType i = 0;
  for (int z = 0; z < counts.Size[2]; ++z)
  {
    for (int y = 0; y < counts.Size[1]; ++y)
    {
      for (int x = 0; x < counts.Size[0]; ++x, ++i)
      {
        const Vector expected = NormalOf(counts, { x, y, z }, symmetric, output);
        const double* found = normals->GetTuple3(i);
        wrong += vtkMath::Distance2BetweenPoints(found, expected.data()) > tolerance * tolerance;
      }
    }
  }
  return wrong;
}

void TestAgainstLoops(VoxelTestChecks& checks)
{
  const Triple kernels[] = { { 2, 2, 2 }, { 1, 1, 1 }, { 4, 1, 2 }, { 8, 8, 8 }, { 1, 16, 1 },
    { 32, 2, 1 }, { 2, 1, 32 }, { 16, 32, 16 } };
  unsigned int seed = 300;
  for (const auto& [name, grid] : AwkwardGrids())
  {
    for (const Triple& kernel : kernels)
    {
      ++seed;
      // Large homogeneous parts as well as noise.
      const Volume noise = RandomVoxels(grid, seed, 0.5);
      const Volume volume = MakeVoxels(grid,
        [&](std::size_t offset)
        { return offset % 200 < 120 ? offset % 200 < 50 : noise.Voxels[offset] != 0; });
      const Field voxels = MakeField(grid, volume);
      const int largest = kernel[0] * kernel[1] * kernel[2];
      for (const bool downsampled : { false, true })
      {
        const Field counts = CountsOf(voxels, kernel, downsampled);
        for (const int mode :
          { Filter::NORMALS_OFF, Filter::NORMALS_SYMMETRIC, Filter::NORMALS_ONE_SIDED })
        {
          const bool cells = mode == Filter::NORMALS_ONE_SIDED;
          const bool fraction = mode != Filter::NORMALS_SYMMETRIC;
          vtkNew<Filter> filter;
          filter->SetInputData(MakeMask(grid, volume, VTK_UNSIGNED_CHAR, cells));
          filter->SetKernelSize(kernel[0], kernel[1], kernel[2]);
          filter->SetDownsample(downsampled);
          filter->SetNormalMode(mode);
          filter->SetDensityType(fraction ? Filter::DENSITY_FRACTION : Filter::DENSITY_COUNT);
          filter->Update();
          const std::string what = name + ", kernel " + std::to_string(kernel[0]) + " " +
            std::to_string(kernel[1]) + " " + std::to_string(kernel[2]) + ", downsampled " +
            std::to_string(downsampled) + ", normals " + std::to_string(mode) + ", seed " +
            std::to_string(seed);
          vtkImageData* output = filter->GetOutput();
          vtkDataSetAttributes* attributes = output->GetPointData();
          if (cells)
          {
            attributes = output->GetCellData();
          }
          vtkDataArray* density = attributes->GetScalars();
          checks.Equal(what + ": densities that differ",
            CountDifferences(density, counts, fraction ? 1.0 / largest : 1.0), 0);
          checks.Equal(what + ": type of the density", density ? density->GetDataType() : -1,
            fraction           ? VTK_FLOAT
              : largest <= 255 ? VTK_UNSIGNED_CHAR
                               : VTK_UNSIGNED_SHORT);
          if (mode == Filter::NORMALS_OFF)
          {
            checks.Check(what + ": no normals", attributes->GetNormals() == nullptr);
          }
          else
          {
            checks.Equal(what + ": wrong normals",
              CountWrongNormals(
                attributes->GetNormals(), counts, mode == Filter::NORMALS_SYMMETRIC, output),
              0);
          }
        }
      }
    }
  }
}

/// Boxes of the coarse grid lie where their voxels are.
void TestGeometry(VoxelTestChecks& checks)
{
  for (const auto& [name, grid] : AwkwardGrids())
  {
    const Image mask = MakeMask(grid, RandomVoxels(grid, 1));
    vtkNew<Filter> filter;
    filter->SetInputData(mask);
    filter->SetKernelSize(4, 2, 8);
    filter->DownsampleOn();
    filter->UpdateInformation();
    int whole[6];
    filter->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole);
    filter->Update();
    vtkImageData* output = filter->GetOutput();
    checks.Check(
      name + ": the extent announced", std::equal(whole, whole + 6, output->GetExtent()));
    int extent[6];
    grid->GetExtent(extent);
    const double centre[3] = { extent[0] + 1.5, extent[2] + 0.5, extent[4] + 3.5 };
    double expected[3];
    grid->TransformContinuousIndexToPhysicalPoint(centre, expected);
    double found[3];
    output->TransformIndexToPhysicalPoint(0, 0, 0, found);
    checks.Check(name + ": the first box is in its place",
      vtkMath::Distance2BetweenPoints(found, expected) < 1e-20);
    checks.Check(
      name + ": spacing", std::abs(output->GetSpacing()[2] - 8 * grid->GetSpacing()[2]) < 1e-12);
  }
}

/// Mean angles, in degrees, to the normals of the sphere about the centre of the image.
struct NormalErrors
{
  double AtSurface = 0.0;  ///< of those where the box is neither empty nor full by an eighth
  double Everywhere = 0.0; ///< of all normals
};

NormalErrors GetErrors(vtkImageData* output, const double centre[3])
{
  constexpr double part = 0.125;
  vtkDataArray* normals = output->GetPointData()->GetNormals();
  vtkDataArray* density = output->GetPointData()->GetScalars();
  NormalErrors sum;
  double atSurface = 0.0;
  double everywhere = 0.0;
  for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
  {
    double normal[3];
    normals->GetTuple(i, normal);
    if (vtkMath::Norm(normal) > 0.0)
    {
      double outwards[3];
      output->GetPoint(i, outwards);
      vtkMath::Subtract(outwards, centre, outwards);
      const double angle =
        vtkMath::DegreesFromRadians(vtkMath::AngleBetweenVectors(normal, outwards));
      const double fraction = density->GetComponent(i, 0);
      const double counts = fraction >= part && fraction <= 1.0 - part ? 1.0 : 0.0;
      sum.AtSurface += counts * angle;
      atSurface += counts;
      sum.Everywhere += angle;
      everywhere += 1.0;
    }
  }
  return { sum.AtSurface / atSurface, sum.Everywhere / everywhere };
}

void TestSphere(VoxelTestChecks& checks)
{
  const double centre[3] = { 1.0, -2.0, 3.0 };
  vtkNew<vtkSlicemapSolidVoxelizer> solid;
  solid->SetInputData(VoxelTestMeshes::Sphere({ centre[0], centre[1], centre[2] }, 10.0, 400));
  solid->SetSampleDimensions(256, 256, 256);
  solid->HostOutputOff();
  const struct
  {
    int Kernel;
    bool Downsampled;
    double Degrees; ///< more is wrong
  } cases[] = { { 8, false, 3.0 }, { 2, false, 12.0 }, { 2, true, 12.0 } };
  for (const auto& [kernel, downsampled, degrees] : cases)
  {
    vtkNew<Filter> filter;
    filter->SetInputConnection(solid->GetOutputPort());
    filter->SetKernelSize(kernel, kernel, kernel);
    filter->SetDownsample(downsampled);
    filter->Update();
    const auto error = GetErrors(filter->GetOutput(), centre);
    const std::string what = "kernel of " + std::to_string(kernel) + "^3" +
      (downsampled ? ", downsampled" : "") + ": mean error of a sphere's normals";
    std::cout << what << " is " << error.AtSurface << " degrees at the surface, "
              << error.Everywhere << " everywhere\n";
    checks.Check(what, error.AtSurface < degrees);
  }
}

void TestChain(VoxelTestChecks& checks)
{
  const auto makeSolid = [](vtkPolyData* mesh)
  {
    auto solid = vtkSmartPointer<vtkSlicemapSolidVoxelizer>::New();
    solid->SetInputData(mesh);
    solid->SetModelBounds(-60, 60, -60, 60, -60, 60);
    solid->SetSampleDimensions(120, 120, 120);
    solid->HostOutputOff();
    return solid;
  };
  const auto knot = makeSolid(VoxelTestMeshes::TorusKnot(50.0, 24, 200));
  const auto sphere = makeSolid(VoxelTestMeshes::Sphere({ 0, 0, 0 }, 30.0));
  vtkNew<vtkVoxelBoolean> difference;
  difference->SetOperationToDifference();
  difference->SetInputConnection(sphere->GetOutputPort());
  difference->AddInputConnection(knot->GetOutputPort());
  difference->HostOutputOff();
  vtkNew<vtkVoxelMorphology> dilation;
  dilation->SetInputConnection(difference->GetOutputPort());
  dilation->SetKernelSize(7, 7, 7);
  dilation->HostOutputOff();
  vtkNew<Filter> filter;
  filter->SetInputConnection(dilation->GetOutputPort());
  filter->SetDensityTypeToCount();
  filter->SetKernelSize(1, 1, 1);
  if (!HasCompute())
  {
    // Without compute shaders, columns that leak are counted on the host.
    difference->Update();
  }
  const vtkIdType readBacks = vtkSlicemap::GetNumberOfReadBacks();
  const vtkIdType uploads = vtkSlicemap::GetNumberOfUploads();
  dilation->Update();
  checks.Equal(
    "read-backs before the end of a chain", vtkSlicemap::GetNumberOfReadBacks(), readBacks);
  filter->Update();
  checks.Equal("read-backs of a chain", vtkSlicemap::GetNumberOfReadBacks(), readBacks + 1);
  checks.Equal("uploads of a chain", vtkSlicemap::GetNumberOfUploads(), uploads);
  vtkIdType filled = 0;
  vtkDataArray* density = filter->GetOutput()->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < density->GetNumberOfTuples(); ++i)
  {
    filled += density->GetComponent(i, 0) != 0.0 ? 1 : 0;
  }
  checks.Equal("voxels of a chain", filled, dilation->GetNumberOfFilledVoxels());
}

void TestErrors(VoxelTestChecks& checks)
{
  const auto grid = AwkwardGrids()[1].Grid;
  const Image mask = MakeMask(grid, RandomVoxels(grid, 1));
  const struct
  {
    int Kernel;
    bool HostOutput;
    int MemoryLimit;
    const char* Says;
  } cases[] = { { 0, true, 0, "KernelSize" }, { -2, true, 0, "KernelSize" },
    { 3, true, 0, "power of two" }, { 64, true, 0, "up to 32" },
    { VTK_INT_MAX, true, 0, "KernelSize" }, { 2, false, 0, "HostOutput" },
    { 2, true, 37 * 11 * 7 * 16 - 1, "MemoryLimit" } };
  for (const auto& [kernel, hostOutput, limit, says] : cases)
  {
    vtkNew<Filter> filter;
    filter->SetInputData(mask);
    filter->Update();
    VoxelTestObserver observer(filter);
    filter->SetKernelSize(kernel, 2, 2);
    filter->SetHostOutput(hostOutput);
    filter->SetMemoryLimit(limit);
    filter->Update();
    checks.Check(std::string("one error that speaks of ") + says,
      observer.Errors.size() == 1 && observer.Errors[0].find(says) != std::string::npos);
    checks.Equal(std::string("arrays after an error of ") + says,
      filter->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
    filter->SetKernelSize(2, 2, 2);
    filter->HostOutputOn();
    filter->SetMemoryLimit(37 * 11 * 7 * 16);
    filter->Update();
    checks.Equal("arrays after that", filter->GetOutput()->GetPointData()->GetNumberOfArrays(), 2);
  }
}

void TestAbort(VoxelTestChecks& checks)
{
  const auto grid = AwkwardGrids()[1].Grid;
  vtkNew<Filter> filter;
  filter->SetInputData(MakeMask(grid, RandomVoxels(grid, 9)));
  {
    const VoxelTestAbort abort(filter);
    filter->Update();
    checks.Equal(
      "arrays after an abort", filter->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
  }
  filter->Modified();
  filter->Update();
  checks.Equal(
    "arrays of the next run", filter->GetOutput()->GetPointData()->GetNumberOfArrays(), 2);
}
}

int TestVoxelDensityNormals(int /*argc*/, char* /*argv*/[])
{
  VoxelTestChecks checks;
  TestAgainstLoops(checks);
  TestGeometry(checks);
  if (HasCompute())
  {
    TestSphere(checks); // slow without, and about quality
  }
  TestChain(checks);
  TestErrors(checks);
  TestAbort(checks);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
