// Proves vtkSlicemap against plain loops on random grids of odd sizes: upload and download, count,
// Boolean operations, complement, shift; that stale images are noticed, and different grids
// refused.

#include "VoxelTestObservers.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSlicemap.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <random>

namespace
{
using Image = vtkSmartPointer<vtkImageData>;

Image MakeRandom(const std::array<int, 3>& n, unsigned int seed)
{
  std::mt19937 random(seed);
  auto image = Image::New();
  image->SetExtent(-2, n[0] - 3, 5, n[1] + 4, 0, n[2] - 1);
  image->SetSpacing(0.5, 1.0, 2.0);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* scalars = vtkUnsignedCharArray::SafeDownCast(image->GetPointData()->GetScalars());
  for (vtkIdType id = 0; id < scalars->GetNumberOfTuples(); ++id)
  {
    scalars->SetValue(id, static_cast<unsigned char>(random() % 3 == 0 ? 1 + random() % 255 : 0));
  }
  return image;
}

bool IsSet(vtkImageData* image, vtkIdType id)
{
  return image->GetPointData()->GetScalars()->GetTuple1(id) != 0.0;
}

/// The voxels that the slicemap has otherwise than `expected` says by point id.
vtkIdType CountDifferent(vtkSlicemap* slicemap, const std::function<bool(vtkIdType)>& expected)
{
  vtkNew<vtkImageData> found;
  if (!slicemap->Download(found))
  {
    return -1;
  }
  vtkIdType different = 0;
  for (vtkIdType id = 0; id < found->GetNumberOfPoints(); ++id)
  {
    different += IsSet(found, id) != expected(id);
  }
  return different;
}

void TestSize(VoxelTestChecks& checks, const std::array<int, 3>& n)
{
  const std::string name = std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " +
    std::to_string(n[2]) + ", seeds 1 and 2: ";
  const Image a = MakeRandom(n, 1);
  const Image b = MakeRandom(n, 2);
  vtkNew<vtkSlicemap> other;
  checks.Check(name + "upload", other->Upload(b));
  const auto start = [&]
  {
    auto slicemap = vtkSmartPointer<vtkSlicemap>::New();
    checks.Check(name + "upload", slicemap->Upload(a));
    return slicemap;
  };
  vtkIdType filled = 0;
  for (vtkIdType id = 0; id < a->GetNumberOfPoints(); ++id)
  {
    filled += IsSet(a, id);
  }
  checks.Equal(name + "count", start()->GetNumberOfFilledVoxels(), filled);
  checks.Equal(
    name + "round trip", CountDifferent(start(), [&](vtkIdType id) { return IsSet(a, id); }), 0);

  auto slicemap = start();
  slicemap->Union(other);
  checks.Equal(name + "union",
    CountDifferent(slicemap, [&](vtkIdType id) { return IsSet(a, id) || IsSet(b, id); }), 0);
  slicemap = start();
  slicemap->Intersection(other);
  checks.Equal(name + "intersection",
    CountDifferent(slicemap, [&](vtkIdType id) { return IsSet(a, id) && IsSet(b, id); }), 0);
  slicemap = start();
  slicemap->Difference(other);
  checks.Equal(name + "difference",
    CountDifferent(slicemap, [&](vtkIdType id) { return IsSet(a, id) && !IsSet(b, id); }), 0);
  slicemap = start();
  slicemap->SymmetricDifference(other);
  checks.Equal(name + "symmetric difference",
    CountDifferent(slicemap, [&](vtkIdType id) { return IsSet(a, id) != IsSet(b, id); }), 0);
  slicemap = start();
  slicemap->Complement();
  checks.Equal(
    name + "complement", CountDifferent(slicemap, [&](vtkIdType id) { return !IsSet(a, id); }), 0);
  checks.Equal(name + "count of the complement", slicemap->GetNumberOfFilledVoxels(),
    a->GetNumberOfPoints() - filled);

  for (const auto& by : std::vector<std::array<int, 3>>{
         { 1, 0, 0 }, { -1, 0, 0 }, { 33, -2, 1 }, { -70, 3, -1 }, { 0, 1, 0 }, { 500, 0, 0 } })
  {
    slicemap = start();
    slicemap->Shift(by[0], by[1], by[2]);
    checks.Equal(name + "shift by " + std::to_string(by[0]),
      CountDifferent(slicemap,
        [&](vtkIdType id)
        {
          const vtkIdType x = id % n[0] - by[0];
          const vtkIdType y = id / n[0] % n[1] - by[1];
          const vtkIdType z = id / n[0] / n[1] - by[2];
          return x >= 0 && x < n[0] && y >= 0 && y < n[1] && z >= 0 && z < n[2] &&
            IsSet(a, (z * n[1] + y) * n[0] + x);
        }),
      0);
  }
}
}

int TestSlicemap(int /*argc*/, char* /*argv*/[])
{
  VoxelTestChecks checks;
  for (const auto& n : std::vector<std::array<int, 3>>{
         { 1, 1, 1 }, { 31, 7, 5 }, { 32, 4, 4 }, { 129, 3, 9 }, { 200, 1, 6 } })
  {
    TestSize(checks, n);
  }

  vtkNew<vtkSlicemap> slicemap;
  slicemap->Upload(MakeRandom({ 20, 20, 20 }, 3));
  vtkNew<vtkImageData> image;
  const vtkIdType readBacks = vtkSlicemap::GetNumberOfReadBacks();
  slicemap->Download(image);
  checks.Equal("read-backs of a download", vtkSlicemap::GetNumberOfReadBacks() - readBacks, 1);
  checks.Check("an image carries its slicemap", vtkSlicemap::GetFromImage(image) == slicemap);
  image->GetPointData()->GetScalars()->Modified();
  checks.Check("a stale slicemap is not used", vtkSlicemap::GetFromImage(image) == nullptr);

  vtkNew<vtkSlicemap> elsewhere;
  elsewhere->Upload(MakeRandom({ 20, 20, 21 }, 3));
  std::vector<std::string> errors;
  vtkNew<vtkCallbackCommand> note;
  note->SetClientData(&errors);
  note->SetCallback(
    [](vtkObject*, unsigned long, void* data, void* text) {
      static_cast<std::vector<std::string>*>(data)->emplace_back(static_cast<const char*>(text));
    });
  slicemap->AddObserver(vtkCommand::ErrorEvent, note);
  checks.Check("different grids are refused", !slicemap->Union(elsewhere));
  checks.Check("both grids are named",
    errors.size() == 1 && errors[0].find("0, 19") != std::string::npos &&
      errors[0].find("0, 20") != std::string::npos);
  vtkNew<vtkImageData> empty;
  checks.Check("an image without scalars is refused", !slicemap->Upload(empty));
  checks.Equal("errors", errors.size(), std::size_t(2));
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
