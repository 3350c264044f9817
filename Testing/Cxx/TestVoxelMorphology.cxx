// Proves vtkVoxelMorphology bit for bit against plain loops over all voxels of the element, for
// every operation, kernel and border on awkward grids; against vtkImageDilateErode3D; that
// iterations are repetitions, that openings are idempotent; chains without a transfer; and one
// error for each bad use.

#include "VoxelComparison.h"
#include "VoxelFilterTests.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkImageData.h>
#include <vtkImageDilateErode3D.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSlicemap.h>
#include <vtkSlicemapSolidVoxelizer.h>
#include <vtkVoxelMorphology.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

using namespace VoxelFilterTests;
using VoxelReference::Compare;
using VoxelReference::Volume;

namespace
{
using Filter = vtkVoxelMorphology;
using Offset = std::array<int, 3>;
using Elements = std::vector<Offset>;

constexpr int Neutral = Filter::BORDER_NEUTRAL;

/// By their definitions.
Elements MakeNeighbours(int kernel)
{
  Elements element;
  for (int z = -1; z <= 1; ++z)
  {
    for (int y = -1; y <= 1; ++y)
    {
      for (int x = -1; x <= 1; ++x)
      {
        const int axes = std::abs(x) + std::abs(y) + std::abs(z);
        if (axes <= kernel)
        {
          element.push_back({ x, y, z });
        }
      }
    }
  }
  return element;
}

Elements Mirrored(Elements element)
{
  for (Offset& offset : element)
  {
    offset = { -offset[0], -offset[1], -offset[2] };
  }
  return element;
}

/// Any (dilation) or all (erosion) of the voxels of the element.
std::vector<char> Apply(const std::vector<char>& voxels, const Offset& n, const Elements& element,
  bool dilates, int border)
{
  std::vector<char> result(voxels.size());
  std::size_t at = 0;
  for (int z = 0; z < n[2]; ++z)
  {
    for (int y = 0; y < n[1]; ++y)
    {
      for (int x = 0; x < n[0]; ++x, ++at)
      {
        const auto decides = [&](const Offset& offset)
        {
          const int i = x + offset[0];
          const int j = y + offset[1];
          const int k = z + offset[2];
          const bool inside = i >= 0 && i < n[0] && j >= 0 && j < n[1] && k >= 0 && k < n[2];
          const bool set = inside
            ? voxels[(std::size_t(k) * n[1] + j) * n[0] + i] != 0
            : border == Filter::BORDER_FULL || (border == Neutral && !dilates);
          return set == dilates;
        };
        const bool decided = std::any_of(element.begin(), element.end(), decides);
        result[at] = decided == dilates;
      }
    }
  }
  return result;
}

std::vector<char> Reference(const Volume& input, vtkImageData* grid, const Elements& element,
  int operation, int border, int iterations)
{
  const int* size = grid->GetDimensions();
  const Offset n{ size[0], size[1], size[2] };
  const std::size_t count = std::size_t(n[0]) * n[1] * n[2];
  const std::vector<char> voxels(input.Voxels.get(), input.Voxels.get() + count);
  const auto repeat = [&](std::vector<char> v, const Elements& e, bool dilates)
  {
    for (int i = 0; i < iterations; ++i)
    {
      v = Apply(v, n, e, dilates, border);
    }
    return v;
  };
  const auto mirrored = Mirrored(element);
  switch (operation)
  {
    case Filter::OPERATION_DILATE:
      return repeat(voxels, element, true);
    case Filter::OPERATION_ERODE:
      return repeat(voxels, element, false);
    case Filter::OPERATION_OPEN:
      return repeat(repeat(voxels, element, false), mirrored, true);
    case Filter::OPERATION_CLOSE:
      return repeat(repeat(voxels, element, true), mirrored, false);
    default:
      break;
  }
  const bool isInner = operation == Filter::OPERATION_INNER_GRADIENT;
  auto result = repeat(voxels, element, !isInner);
  for (std::size_t i = 0; i < count; ++i)
  {
    result[i] = isInner ? voxels[i] && !result[i] : result[i] && !voxels[i];
  }
  return result;
}

bool IsReference(const std::string& what, Filter* filter, vtkImageData* grid, const Volume& input,
  const Elements& element)
{
  filter->Update();
  const auto expected = Reference(input, grid, element, filter->GetOperation(),
    filter->GetBorderValue(), filter->GetIterations());
  const Volume volume = MakeVoxels(grid, [&](std::size_t offset) { return expected[offset] != 0; });
  return VoxelReference::Report(what, Compare(filter->GetOutput(), volume));
}

Elements MakeBox(const Offset& size)
{
  Elements element;
  for (int z = 0; z < size[2]; ++z)
  {
    for (int y = 0; y < size[1]; ++y)
    {
      for (int x = 0; x < size[0]; ++x)
      {
        element.push_back({ x - size[0] / 2, y - size[1] / 2, z - size[2] / 2 });
      }
    }
  }
  return element;
}

void TestOperations(VoxelTestChecks& checks)
{
  unsigned int seed = 40;
  for (const auto& [name, grid] : AwkwardGrids())
  {
    for (int operation = 0; operation <= Filter::OPERATION_OUTER_GRADIENT; ++operation)
    {
      for (int border = Neutral; border <= Filter::BORDER_FULL; ++border)
      {
        const bool grows = operation % 2 == 0 && operation != Filter::OPERATION_INNER_GRADIENT;
        const Volume input = RandomVoxels(grid, ++seed, grows ? 0.1 : 0.9);
        vtkNew<Filter> filter;
        filter->SetInputData(MakeMask(grid, input));
        filter->SetOperation(operation);
        filter->SetBorderValue(border);
        const std::string what = name + ", operation " + std::to_string(operation) + ", border " +
          std::to_string(border) + ", seed " + std::to_string(seed);
        for (const Offset& size : { Offset{ 3, 3, 3 }, { 2, 4, 1 }, { 5, 1, 2 } })
        {
          filter->SetKernelSize(size[0], size[1], size[2]);
          checks.Check(what, IsReference(what + ", box", filter, grid, input, MakeBox(size)));
        }
        for (int kernel = Filter::KERNEL_FACES6; kernel <= Filter::KERNEL_CORNERS26; ++kernel)
        {
          filter->SetKernelType(kernel);
          filter->SetIterations(1 + kernel % 2);
          const std::string title = what + ", kernel " + std::to_string(kernel);
          checks.Check(title, IsReference(title, filter, grid, input, MakeNeighbours(kernel)));
        }
      }
    }
  }
}

/// Long boxes: along one axis each, which is all that a separable one needs.
void TestLongBoxes(VoxelTestChecks& checks)
{
  unsigned int seed = 7;
  for (const auto& [name, grid] : AwkwardGrids())
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const int length : { 7, 16, 62, 63, 64, 65, 100, 253, 257, 600 })
      {
        Offset size{ 1, 1, 1 };
        size[axis] = length;
        const Volume input = RandomVoxels(grid, ++seed, 0.01);
        vtkNew<Filter> filter;
        filter->SetInputData(MakeMask(grid, input));
        filter->SetKernelSize(size[0], size[1], size[2]);
        filter->SetBorderValue(length % 3);
        const std::string what = name + ", axis " + std::to_string(axis) + ", length " +
          std::to_string(length) + ", seed " + std::to_string(seed);
        checks.Check(what, IsReference(what, filter, grid, input, MakeBox(size)));
      }
    }
  }
}

/// Spheres and boxes of VTK's filter, which leaves what lies beyond the grid out.
void TestLikeVTK(VoxelTestChecks& checks)
{
  unsigned int seed = 900;
  for (const auto& [name, grid] : AwkwardGrids())
  {
    for (const Offset& size :
      { Offset{ 3, 3, 3 }, { 7, 7, 7 }, { 9, 5, 4 }, { 2, 2, 2 }, { 13, 3, 21 } })
    {
      const Volume input = RandomVoxels(grid, ++seed, 0.03);
      const Image mask = MakeMask(grid, input);
      auto* values = static_cast<unsigned char*>(mask->GetScalarPointer());
      std::transform(values, values + mask->GetNumberOfPoints(), values,
        [](unsigned char value) { return static_cast<unsigned char>(value != 0); });
      for (const bool dilates : { true, false })
      {
        vtkNew<vtkImageDilateErode3D> rival;
        rival->SetInputData(mask);
        rival->SetKernelSize(size[0], size[1], size[2]);
        rival->SetDilateValue(dilates ? 1 : 0);
        rival->SetErodeValue(dilates ? 0 : 1);
        rival->Update();
        vtkNew<Filter> filter;
        filter->SetInputData(mask);
        filter->SetKernelTypeToSphere();
        filter->SetKernelSize(size[0], size[1], size[2]);
        filter->SetOperation(dilates ? Filter::OPERATION_DILATE : Filter::OPERATION_ERODE);
        filter->Update();
        const auto* expected = static_cast<unsigned char*>(rival->GetOutput()->GetScalarPointer());
        const Volume volume =
          MakeVoxels(grid, [&](std::size_t offset) { return expected[offset] != 0; });
        const std::string what = name + ", like VTK, size " + std::to_string(size[0]) + " " +
          std::to_string(size[1]) + " " + std::to_string(size[2]) + ", seed " +
          std::to_string(seed);
        checks.Check(what, VoxelReference::Report(what, Compare(filter->GetOutput(), volume)));
      }
    }
  }
}

void TestChain(VoxelTestChecks& checks)
{
  vtkNew<vtkSlicemapSolidVoxelizer> solid;
  solid->SetInputData(VoxelTestMeshes::TorusKnot(50.0, 24, 200));
  solid->SetResolution(90);
  solid->SetPadding(6);
  solid->HostOutputOff();
  solid->Update();
  const vtkIdType before = solid->GetNumberOfFilledVoxels();
  const vtkIdType readBacks = vtkSlicemap::GetNumberOfReadBacks();
  const vtkIdType uploads = vtkSlicemap::GetNumberOfUploads();
  vtkNew<Filter> open;
  open->SetInputConnection(solid->GetOutputPort());
  open->SetOperationToOpen();
  open->SetKernelTypeToSphere();
  open->SetKernelSize(5, 5, 4);
  open->HostOutputOff();
  vtkNew<Filter> again;
  again->SetInputConnection(open->GetOutputPort());
  again->SetOperationToOpen();
  again->SetKernelTypeToSphere();
  again->SetKernelSize(5, 5, 4);
  again->HostOutputOff();
  again->Update();
  checks.Equal("read-backs of a chain", vtkSlicemap::GetNumberOfReadBacks(), readBacks);
  checks.Equal("uploads of a chain", vtkSlicemap::GetNumberOfUploads(), uploads);
  checks.Equal("the input is left alone", solid->GetNumberOfFilledVoxels(), before);
  checks.Check("an opening takes away", open->GetNumberOfFilledVoxels() < before);
  checks.Equal(
    "an opening is idempotent", again->GetNumberOfFilledVoxels(), open->GetNumberOfFilledVoxels());
}

void TestErrors(VoxelTestChecks& checks)
{
  const auto grid = AwkwardGrids()[0].Grid;
  const Image mask = MakeMask(grid, RandomVoxels(grid, 1));
  const struct
  {
    int Kernel;
    int Size;
    int Iterations;
    std::size_t Errors;
  } cases[] = { { Filter::KERNEL_BOX, 0, 1, 1 }, { Filter::KERNEL_BOX, -3, 1, 1 },
    { Filter::KERNEL_BOX, VTK_INT_MAX, 1, 1 }, { Filter::KERNEL_BOX, 3, VTK_INT_MAX, 1 },
    { Filter::KERNEL_SPHERE, 64, 1, 1 }, { Filter::KERNEL_SPHERE, 63, 1, 0 },
    { Filter::KERNEL_FACES6, 0, 1, 0 }, { Filter::KERNEL_BOX, 100000, 3, 0 } };
  for (const auto& [kernel, size, iterations, errors] : cases)
  {
    vtkNew<Filter> filter;
    VoxelTestObserver observer(filter);
    filter->SetInputData(mask);
    filter->SetKernelType(kernel);
    filter->SetKernelSize(size, size, size);
    filter->SetIterations(iterations);
    filter->Update();
    checks.Equal("errors of size " + std::to_string(size), observer.Errors.size(), errors);
    checks.Equal("arrays of size " + std::to_string(size),
      filter->GetOutput()->GetPointData()->GetNumberOfArrays(), errors ? 0 : 1);
  }
}
}

int TestVoxelMorphology(int /*argc*/, char* /*argv*/[])
{
  VoxelTestChecks checks;
  TestOperations(checks);
  TestLongBoxes(checks);
  TestLikeVTK(checks);
  TestChain(checks);
  TestErrors(checks);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
