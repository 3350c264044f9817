// Proves vtkImageToSlicemap bit for bit against plain loops: every mode, for scalars of all types
// with values at and beyond the ends of these, NaN and infinities, on awkward grids, points and
// cells, components and layouts of arrays; that one pass over many values, and volumes of several
// slabs, give the same; label maps; chains without a transfer; progress, abort, and one error for
// each bad use.

#include "VoxelComparison.h"
#include "VoxelFilterTests.h"
#include "VoxelTestObservers.h"

#include <vtkBitArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkImageToSlicemap.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkSOADataArrayTemplate.h>
#include <vtkShortArray.h>
#include <vtkSlicemap.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>
#include <vtkVoxelGrid.h>
#include <vtkVoxelMorphology.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <random>
#include <vector>

using namespace VoxelFilterTests;
using VoxelReference::Compare;
using VoxelReference::Volume;

namespace
{
using Filter = vtkImageToSlicemap;
using Range = std::array<double, 2>;
using Array = vtkSmartPointer<vtkDataArray>;

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr std::array<int, 3> Modes = { Filter::MODE_ISO_VALUES, Filter::MODE_RANGES,
  Filter::MODE_LABELS };

/// Scalars of any type, where those of 64 bits are exact.
using Exact = long double;
using Scalars = std::vector<Exact>;

bool IsIn(Exact scalar, int mode, const Range& range)
{
  switch (mode)
  {
    case Filter::MODE_ISO_VALUES:
      return scalar >= range[0];
    case Filter::MODE_RANGES:
      return range[0] <= scalar && scalar <= range[1];
    default:
      return scalar == range[0];
  }
}

/// In, at and beyond the ends of all types, between integers and between floats.
std::vector<Range> MakeRanges()
{
  std::vector<Range> ranges{ { 299.5, 300.25 }, { -Infinity, Infinity }, { 3, 3 }, { -0.0, 0.0 },
    { 0.25, 0.75 }, { 1, 77 }, { -5.5, 1e300 }, { -1e300, -3 }, { Infinity, Infinity },
    { -Infinity, -1e39 }, { 0.1, 0.3 } };
  for (const int bits : { 7, 8, 15, 16, 31, 32, 53, 63, 64 })
  {
    const double power = std::ldexp(1.0, bits);
    const double below = bits < 53 ? power - 1.0 : std::nextafter(power, 0.0);
    ranges.insert(ranges.end(),
      { { below, power }, { power, power }, { below + 0.5, 2 * power }, { -power, -below },
        { -power - 0.5, -power + 0.5 } });
  }
  return ranges;
}

/// Small ones mostly, some of any size, some at the ends of the type.
template <typename T>
T RandomScalar(std::mt19937_64& random)
{
  using Limits = std::numeric_limits<T>;
  const auto small =
    static_cast<T>(static_cast<int>(random() % 400) - (Limits::is_signed ? 99 : 0));
  const std::uint64_t kind = random() % 8;
  if constexpr (Limits::is_integer)
  {
    const std::array<T, 4> ends{ Limits::min(), Limits::max(), T(Limits::min() + 1),
      T(Limits::max() - 1) };
    const int shift = 1 + static_cast<int>(random() % (Limits::digits - 1));
    const T power = static_cast<T>(std::uint64_t(1) << shift);
    const std::array<T, 3> nearPowers{ T(power - 1), power, T(power + 1) };
    return kind == 0 ? ends[random() % 4]
      : kind == 1    ? static_cast<T>(random())
      : kind == 2    ? nearPowers[random() % 3]
                     : small;
  }
  else
  {
    const std::array<T, 10> odd{ Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(),
      Limits::max(), Limits::lowest(), Limits::denorm_min(), T(-0.0), T(0.1), T(0.3),
      static_cast<T>(1.8446744073709552e19) };
    return kind < 3 ? odd[random() % 10] : small / T(4);
  }
}

/// An array of the type with random values, and these.
Array RandomArray(int type, vtkIdType count, int components, unsigned int seed, Scalars& scalars)
{
  std::mt19937_64 random(seed);
  const Array array = Array::Take(vtkDataArray::CreateDataArray(type));
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(count);
  scalars.resize(count);
  const auto fill = [&](auto* values, auto next)
  {
    for (vtkIdType i = 0; i < count * components; ++i)
    {
      const auto value = next();
      values->SetValue(i, value);
      if (i % components == 0)
      {
        scalars[i / components] = static_cast<Exact>(value);
      }
    }
  };
  switch (type)
  {
    vtkTemplateMacro(fill(vtkAOSDataArrayTemplate<VTK_TT>::FastDownCast(array),
      [&] { return RandomScalar<VTK_TT>(random); }));
    default:
      fill(vtkBitArray::SafeDownCast(array), [&] { return static_cast<int>(random() % 2); });
  }
  return array;
}

/// An image on the grid, with the array for its active scalars.
Image MakeImage(vtkImageData* grid, vtkDataArray* array, bool cells)
{
  Image image =
    MakeMask(grid, MakeVoxels(grid, [](std::size_t) { return false; }), VTK_UNSIGNED_CHAR, cells);
  vtkDataSetAttributes* attributes = image->GetPointData();
  if (cells)
  {
    attributes = image->GetCellData();
  }
  attributes->SetScalars(array);
  return image;
}

void SetRanges(Filter* filter, int mode, const std::vector<Range>& ranges)
{
  filter->SetMode(mode);
  filter->SetNumberOfValues(static_cast<int>(ranges.size()));
  for (std::size_t i = 0; i < ranges.size(); ++i)
  {
    filter->SetRange(static_cast<int>(i), ranges[i][0], ranges[i][1]);
  }
}

/// All outputs of a filter that has been run, against plain loops.
void CheckOutputs(VoxelTestChecks& checks, const std::string& what, Filter* filter,
  vtkImageData* grid, const Scalars& scalars)
{
  for (int i = 0; i < filter->GetNumberOfValues(); ++i)
  {
    const Range range{ filter->GetRange(i)[0], filter->GetRange(i)[1] };
    const Volume expected = MakeVoxels(
      grid, [&](std::size_t offset) { return IsIn(scalars[offset], filter->GetMode(), range); });
    const std::string title = what + ", mode " + std::to_string(filter->GetMode()) + ", range " +
      std::to_string(range[0]) + " to " + std::to_string(range[1]);
    checks.Check(title, VoxelReference::Report(title, Compare(filter->GetOutput(i), expected)));
  }
}

void TestTypes(VoxelTestChecks& checks)
{
  unsigned int seed = 100;
  const auto ranges = MakeRanges();
  for (const int type : { VTK_BIT, VTK_CHAR, VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT,
         VTK_UNSIGNED_SHORT, VTK_INT, VTK_UNSIGNED_INT, VTK_LONG, VTK_UNSIGNED_LONG, VTK_LONG_LONG,
         VTK_UNSIGNED_LONG_LONG, VTK_ID_TYPE, VTK_FLOAT, VTK_DOUBLE })
  {
    for (const auto& [name, grid] : AwkwardGrids())
    {
      const bool cells = ++seed % 2 == 0;
      const int components = seed % 4 == 0 ? 3 : 1;
      const int mode = Modes[seed % Modes.size()];
      const std::string what = name + ", type " + std::to_string(type) +
        (cells ? " of cells, " : " of points, ") + std::to_string(components) +
        " components, seed " + std::to_string(seed);
      Scalars scalars;
      const Image image = MakeImage(
        grid, RandomArray(type, grid->GetNumberOfPoints(), components, seed, scalars), cells);
      vtkNew<Filter> filter;
      filter->SetInputData(image);
      SetRanges(filter, mode, ranges);
      filter->Update();
      CheckOutputs(checks, what, filter, grid, scalars);
      vtkImageData* last = filter->GetOutput(filter->GetNumberOfValues() - 1);
      checks.Check(what + ": geometry",
        vtkVoxelGrid::FromImage(last).IsSameAs(vtkVoxelGrid::FromImage(image)));
      checks.Check(
        what + ": cells for cells", (last->GetCellData()->GetScalars() != nullptr) == cells);
    }
  }
}

/// An array of doubles that doesn't show how they lie in memory.
class HiddenArray : public vtkDoubleArray
{
public:
  static HiddenArray* New();
  vtkTypeMacro(HiddenArray, vtkDoubleArray);
  int GetArrayType() const override { return vtkAbstractArray::DataArray; }
};
vtkStandardNewMacro(HiddenArray);

void TestLayouts(VoxelTestChecks& checks)
{
  const Image grid = AwkwardGrids()[3].Grid;
  Scalars scalars;
  const Array plain = RandomArray(VTK_DOUBLE, grid->GetNumberOfPoints(), 2, 5, scalars);
  vtkNew<vtkSOADataArrayTemplate<double>> byComponents;
  vtkNew<HiddenArray> hidden;
  for (vtkDataArray* array :
    { static_cast<vtkDataArray*>(byComponents.Get()), static_cast<vtkDataArray*>(hidden.Get()) })
  {
    array->DeepCopy(plain);
    vtkNew<Filter> filter;
    filter->SetInputData(MakeImage(grid, array, false));
    SetRanges(filter, Filter::MODE_RANGES, MakeRanges());
    filter->Update();
    CheckOutputs(checks, array->GetClassName(), filter, grid, scalars);
  }

  // Uploads of masks share the code, where NaN is not zero.
  for (const int type : { VTK_SHORT, VTK_DOUBLE, VTK_BIT })
  {
    const Array array = RandomArray(type, grid->GetNumberOfPoints(), 1, 9, scalars);
    vtkNew<vtkSlicemap> slicemap;
    slicemap->Upload(MakeImage(grid, array, false));
    vtkNew<vtkImageData> image;
    slicemap->Download(image);
    const Volume expected =
      MakeVoxels(grid, [&](std::size_t offset) { return scalars[offset] != 0; });
    checks.Check("upload", VoxelReference::Report("upload", Compare(image, expected)));
  }
}

/// Longer than what is loaded at a time.
void TestLongRows(VoxelTestChecks& checks)
{
  const auto grid = Image::New();
  grid->SetExtent(-4, 2500, 0, 2, 1, 2);
  for (const int type : { VTK_UNSIGNED_CHAR, VTK_FLOAT, VTK_BIT })
  {
    for (const int components : { 1, 2 })
    {
      Scalars scalars;
      vtkNew<Filter> filter;
      filter->SetInputData(MakeImage(
        grid, RandomArray(type, grid->GetNumberOfPoints(), components, 6, scalars), false));
      SetRanges(filter, Filter::MODE_RANGES, { { -2, 0.5 }, { 3, 50 } });
      filter->Update();
      CheckOutputs(checks, "long rows, type " + std::to_string(type), filter, grid, scalars);
    }
  }
}

/// Several slabs, whose ends are not those of slices.
void TestSlabs(VoxelTestChecks& checks)
{
  constexpr int nx = 250;
  constexpr int ny = 199;
  constexpr int nz = 211;
  const auto grid = Image::New();
  grid->SetExtent(-7, nx - 8, 3, ny + 2, 0, nz - 1);
  Scalars scalars;
  const Array array = RandomArray(VTK_UNSIGNED_CHAR, grid->GetNumberOfPoints(), 1, 77, scalars);
  vtkNew<Filter> filter;
  filter->SetInputData(MakeImage(grid, array, false));
  SetRanges(filter, Filter::MODE_RANGES, { { 3, 90 }, { 100.5, 300 } });

  std::vector<double> progress;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&progress);
  observer->SetCallback([](vtkObject*, unsigned long, void* data, void* fraction)
    { static_cast<std::vector<double>*>(data)->push_back(*static_cast<double*>(fraction)); });
  filter->AddObserver(vtkCommand::ProgressEvent, observer);
  const vtkIdType uploads = vtkSlicemap::GetNumberOfUploads();
  filter->Update();
  checks.Equal("uploads of two values", vtkSlicemap::GetNumberOfUploads(), uploads + 2);
  CheckOutputs(checks, "several slabs", filter, grid, scalars);
  checks.Check("progress of slabs", progress.size() > 4);
  checks.Check("progress goes forward", std::is_sorted(progress.begin(), progress.end()));
  checks.Check("progress is a fraction", progress.front() >= 0.0 && progress.back() <= 1.0);
}

void TestOnePass(VoxelTestChecks& checks)
{
  const Image grid = AwkwardGrids()[8].Grid;
  Scalars scalars;
  const Image image =
    MakeImage(grid, RandomArray(VTK_SHORT, grid->GetNumberOfPoints(), 1, 8, scalars), false);
  vtkNew<Filter> all;
  all->SetInputData(image);
  const std::vector<double> values{ -50, 0, 33, 299.5 };
  for (int i = 0; i < 4; ++i)
  {
    all->SetValue(i, values[i]);
  }
  checks.Equal("number of ports", all->GetNumberOfOutputPorts(), 4);
  const vtkIdType uploads = vtkSlicemap::GetNumberOfUploads();
  all->Update();
  for (int i = 0; i < 4; ++i)
  {
    all->Update(i);
  }
  checks.Equal("uploads of four values", vtkSlicemap::GetNumberOfUploads(), uploads + 4);
  for (int i = 0; i < 4; ++i)
  {
    vtkNew<Filter> one;
    one->SetInputData(image);
    one->SetValue(0, values[i]);
    one->Update();
    checks.Check("all values, or one at a time",
      Compare(all->GetOutput(i), VoxelReference::OccupancyOf(one->GetOutput())).IsNone());
  }

  // Fewer values again.
  all->SetNumberOfValues(1);
  checks.Equal("number of ports", all->GetNumberOfOutputPorts(), 1);
  all->Update();
  CheckOutputs(checks, "fewer values", all, grid, scalars);

  all->ThresholdBetween(-3.5, 20);
  all->Update();
  CheckOutputs(checks, "ThresholdBetween", all, grid, scalars);
  all->ThresholdByUpper(40);
  all->Update();
  checks.Equal("upper end of ThresholdByUpper", all->GetRange(0)[1], Infinity);
  CheckOutputs(checks, "ThresholdByUpper", all, grid, scalars);
  all->ThresholdByLower(40);
  all->Update();
  checks.Equal("lower end of ThresholdByLower", all->GetValue(0), -Infinity);
  CheckOutputs(checks, "ThresholdByLower", all, grid, scalars);
  checks.Check("a value that there is not", std::isnan(all->GetValue(1)));
}

/// Every voxel has one label.
void TestLabels(VoxelTestChecks& checks)
{
  constexpr int numberOfLabels = 40;
  const Image grid = AwkwardGrids()[9].Grid;
  std::mt19937 random(11);
  vtkNew<vtkTypeInt64Array> labels;
  labels->SetNumberOfTuples(grid->GetNumberOfPoints());
  // Labels that neither float nor double part.
  const vtkTypeInt64 first = (vtkTypeInt64(1) << 53) - numberOfLabels + 1;
  for (vtkIdType i = 0; i < labels->GetNumberOfTuples(); ++i)
  {
    labels->SetValue(i, first + random() % (numberOfLabels + 20));
  }
  vtkNew<Filter> filter;
  filter->SetInputData(MakeImage(grid, labels, true));
  filter->SetModeToLabels();
  for (int i = 0; i < numberOfLabels; ++i)
  {
    filter->SetValue(i, double(first + i));
  }
  filter->HostOutputOff();
  filter->Update();
  for (int i = 0; i < numberOfLabels; ++i)
  {
    vtkSlicemap* slicemap = vtkSlicemap::GetFromImage(filter->GetOutput(i));
    const vtkTypeInt64* values = labels->GetPointer(0);
    checks.Equal("voxels of label " + std::to_string(i), slicemap->GetNumberOfFilledVoxels(),
      static_cast<vtkIdType>(std::count(values, values + labels->GetNumberOfTuples(), first + i)));
  }
}

void TestArraySelection(VoxelTestChecks& checks)
{
  const Image grid = AwkwardGrids()[1].Grid;
  Scalars active;
  Scalars other;
  Scalars ofCells;
  const Image image =
    MakeImage(grid, RandomArray(VTK_SHORT, grid->GetNumberOfPoints(), 1, 1, active), false);
  const Array otherArray = RandomArray(VTK_FLOAT, grid->GetNumberOfPoints(), 2, 2, other);
  otherArray->SetName("other");
  image->GetPointData()->AddArray(otherArray);
  const Array cellArray = RandomArray(VTK_INT, image->GetNumberOfCells(), 1, 3, ofCells);
  cellArray->SetName("of cells");
  image->GetCellData()->AddArray(cellArray);
  vtkNew<Filter> filter;
  filter->SetInputData(image);
  filter->SetValue(0, 7);
  filter->Update();
  CheckOutputs(checks, "active scalars", filter, grid, active);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "other");
  filter->Update();
  CheckOutputs(checks, "array of points by name", filter, grid, other);
  filter->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, "of cells");
  filter->Update();
  const auto cells = Image::New();
  vtkVoxelGrid::FromImage(image).CellsToVoxels().ApplyTo(cells);
  CheckOutputs(checks, "array of cells by name", filter, cells, ofCells);
}

/// Inside is what it is for the contour filters: the sets of growing values lie within each other.
void TestChain(VoxelTestChecks& checks)
{
  constexpr int n = 50;
  const auto ball = Image::New();
  ball->SetDimensions(n, n, n);
  ball->AllocateScalars(VTK_FLOAT, 1);
  auto* scalars = static_cast<float*>(ball->GetScalarPointer());
  for (int i = 0; i < n * n * n; ++i)
  {
    const double x = double(i % n) - 24.5;
    const double y = double(i / n % n) - 24.5;
    const double z = double(i / n / n) - 24.5;
    scalars[i] = static_cast<float>(20.0 - std::sqrt(x * x + y * y + z * z));
  }
  vtkNew<Filter> sets;
  sets->SetInputData(ball);
  sets->HostOutputOff();
  const vtkIdType uploads = vtkSlicemap::GetNumberOfUploads();
  const vtkIdType readBacks = vtkSlicemap::GetNumberOfReadBacks();
  for (int i = 0; i < 3; ++i)
  {
    sets->SetValue(i, 5.0 * i);
  }
  std::array<vtkSmartPointer<vtkVoxelMorphology>, 3> opened;
  for (int i = 0; i < 3; ++i)
  {
    vtkNew<vtkVoxelMorphology> open;
    open->SetInputConnection(sets->GetOutputPort(i));
    open->SetOperationToOpen();
    open->HostOutputOff();
    open->Update();
    opened[i] = open;
  }
  checks.Equal("uploads of a chain", vtkSlicemap::GetNumberOfUploads(), uploads + 3);
  checks.Equal("read-backs of a chain", vtkSlicemap::GetNumberOfReadBacks(), readBacks);
  vtkIdType before = vtkIdType(n) * n * n;
  for (const auto& open : opened)
  {
    const vtkIdType voxels = open->GetNumberOfFilledVoxels();
    checks.Check("larger values, smaller sets", voxels > 0 && voxels < before);
    before = voxels;
  }
}

void TestAbort(VoxelTestChecks& checks)
{
  const Image grid = AwkwardGrids()[1].Grid;
  Scalars scalars;
  vtkNew<Filter> filter;
  filter->SetInputData(
    MakeImage(grid, RandomArray(VTK_SHORT, grid->GetNumberOfPoints(), 1, 8, scalars), false));
  filter->SetValue(0, 1);
  filter->SetValue(1, 2);
  {
    const VoxelTestAbort abort(filter);
    filter->Update();
    for (int i = 0; i < 2; ++i)
    {
      checks.Equal(
        "arrays after an abort", filter->GetOutput(i)->GetPointData()->GetNumberOfArrays(), 0);
      checks.Check(
        "slicemap after an abort", vtkSlicemap::GetFromImage(filter->GetOutput(i)) == nullptr);
    }
  }
  filter->Modified();
  filter->Update();
  CheckOutputs(checks, "a run after an abort", filter, grid, scalars);
}

void TestError(VoxelTestChecks& checks, const std::string& name,
  const std::function<void(Filter*)>& spoil, const std::string& says)
{
  const Image grid = AwkwardGrids()[1].Grid;
  Scalars scalars;
  const Image good =
    MakeImage(grid, RandomArray(VTK_SHORT, grid->GetNumberOfPoints(), 1, 4, scalars), false);
  vtkNew<Filter> filter;
  filter->SetInputData(good);
  filter->SetValue(0, 3);
  filter->SetValue(1, 4);
  filter->Update();
  {
    VoxelTestObserver observer(filter);
    spoil(filter);
    filter->Update();
    observer.ExpectOneError(checks, name, says);
    for (int i = 0; i < filter->GetNumberOfOutputPorts(); ++i)
    {
      checks.Equal(name + ": arrays of the output",
        filter->GetOutput(i)->GetPointData()->GetNumberOfArrays(), 0);
      checks.Check(name + ": slicemap of the output",
        vtkSlicemap::GetFromImage(filter->GetOutput(i)) == nullptr);
    }
    checks.Equal(name + ": filled voxels", filter->GetNumberOfFilledVoxels(), vtkIdType(-1));
  }
  filter->SetInputData(good);
  filter->SetMemoryLimit(0);
  filter->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  SetRanges(filter, Filter::MODE_ISO_VALUES, { { 3, 3 } });
  filter->Update();
  CheckOutputs(checks, name + ": voxels afterwards", filter, grid, scalars);
}

void TestErrors(VoxelTestChecks& checks)
{
  const auto image = [](vtkAbstractArray* array)
  {
    auto made = Image::New();
    made->SetDimensions(3, 4, 5);
    if (array)
    {
      array->SetName("array");
      made->GetPointData()->AddArray(array);
    }
    return made;
  };
  TestError(
    checks, "no values", [](Filter* f) { f->SetNumberOfValues(0); }, "no values");
  TestError(
    checks, "a value that was not set", [](Filter* f) { f->SetNumberOfValues(3); }, "Value 2 of 3");
  TestError(
    checks, "NaN", [](Filter* f) { f->SetValue(1, std::nan("")); }, "Value 1 of 2");
  TestError(
    checks, "wrong order", [](Filter* f) { f->ThresholdBetween(4.5, -3); }, "from 4.5 to -3");
  TestError(
    checks, "empty image", [](Filter* f) { f->SetInputData(Image::New()); }, "is empty");
  TestError(
    checks, "no scalars", [&](Filter* f) { f->SetInputData(image(nullptr)); }, "no scalars");
  TestError(
    checks, "no such array",
    [](Filter* f)
    { f->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "density"); },
    "\"density\"");
  TestError(
    checks, "strings",
    [&](Filter* f)
    {
      vtkNew<vtkStringArray> strings;
      strings->SetNumberOfTuples(60);
      f->SetInputData(image(strings));
      f->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "array");
    },
    "vtkStringArray");
  TestError(
    checks, "too few scalars",
    [&](Filter* f)
    {
      vtkNew<vtkShortArray> scalars;
      scalars->SetNumberOfTuples(59);
      const Image small = image(scalars);
      small->GetPointData()->SetScalars(scalars);
      f->SetInputData(small);
    },
    "59 values");
  // One of 37 * 11 * 7 = 2849 bytes would fit.
  TestError(
    checks, "memory limit", [](Filter* f) { f->SetMemoryLimit(3000); }, "MemoryLimit");

  vtkNew<Filter> filter;
  VoxelTestObserver observer(filter);
  filter->SetValue(-1, 3);
  filter->SetValue(Filter::MAXIMUM_NUMBER_OF_VALUES, 3);
  filter->SetNumberOfValues(-1);
  filter->SetNumberOfValues(Filter::MAXIMUM_NUMBER_OF_VALUES + 1);
  checks.Equal("errors of wrong numbers", observer.Errors.size(), std::size_t(4));
  checks.Equal("values after wrong numbers", filter->GetNumberOfValues(), 0);
}
}

int TestImageToSlicemap(int /*argc*/, char* /*argv*/[])
{
  VoxelTestChecks checks;
  TestTypes(checks);
  TestLayouts(checks);
  TestLongRows(checks);
  TestSlabs(checks);
  TestOnePass(checks);
  TestLabels(checks);
  TestArraySelection(checks);
  TestChain(checks);
  TestAbort(checks);
  TestErrors(checks);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
