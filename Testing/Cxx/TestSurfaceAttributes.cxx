// Proves that attributes at voxels are what a plain loop over triangles and voxels on the CPU
// gives: values of points and cells of triangles, polygons, strips and blocks, averaged, smallest,
// largest and first; that two runs and all strategies give identical results; and that the list and
// the image hold the same.

#include "VoxelReference.h"
#include "VoxelSolidTests.h"
#include "VoxelSurfaceReference.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkHybridSurfaceVoxelizer.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <random>

using namespace VoxelReference;
using namespace VoxelTestMeshes;

namespace
{
constexpr int Seed = 29;
constexpr double ToleranceOfRange = 1e-3;

/// Two triangles whose distances to a cube differ from a half by less may be rounded either way.
constexpr double Undecided = 2e-5;

using Voxelizer = vtkHybridSurfaceVoxelizer;

struct Samples
{
  std::vector<double> Values; // of the triangles in a voxel, in their order
  bool Decided = true;
};

/// Barycentric coordinates of the triangle's point nearest to p.
Vector NearestWeights(const Vector& p, const Triangle& t)
{
  const auto minus = [](const Vector& a, const Vector& b) -> Vector {
    return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
  };
  const auto dot = [](const Vector& a, const Vector& b)
  { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const Vector ab = minus(t[1], t[0]);
  const Vector ac = minus(t[2], t[0]);
  const Vector ap = minus(p, t[0]);
  const double bb = dot(ab, ab);
  const double bc = dot(ab, ac);
  const double cc = dot(ac, ac);
  const double pb = dot(ap, ab);
  const double pc = dot(ap, ac);
  const double determinant = bb * cc - bc * bc;
  if (determinant > 0.0)
  {
    const double v = (cc * pb - bc * pc) / determinant;
    const double w = (bb * pc - bc * pb) / determinant;
    if (v >= 0.0 && w >= 0.0 && v + w <= 1.0)
    {
      return { 1.0 - v - w, v, w };
    }
  }
  Vector best{};
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
  {
    const int j = (i + 1) % 3;
    const Vector edge = minus(t[j], t[i]);
    const double square = dot(edge, edge);
    const double s = square > 0.0 ? std::clamp(dot(minus(p, t[i]), edge) / square, 0.0, 1.0) : 0.0;
    Vector rest = minus(p, t[i]);
    for (int axis = 0; axis < 3; ++axis)
    {
      rest[axis] -= s * edge[axis];
    }
    if (dot(rest, rest) < least)
    {
      least = dot(rest, rest);
      best = {};
      best[i] = 1.0 - s;
      best[j] = s;
    }
  }
  return best;
}

/// All values at all voxels, of the triangles of a mesh of triangles alone.
std::map<Voxel, Samples> SampleMesh(
  vtkPolyData* mesh, const Grid& grid, vtkDataArray* values, bool ofPoints, int component)
{
  const IndexMesh triangles(mesh, grid);
  std::map<Voxel, Samples> samples;
  for (std::int64_t id = 0; id < triangles.GetNumberOfTriangles(); ++id)
  {
    const Triangle t = triangles.GetTriangle(id);
    std::array<int, 6> range{};
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto [low, high] = std::minmax({ t[0][axis], t[1][axis], t[2][axis] });
      range[2 * axis] = std::max(grid.Extent[2 * axis], int(std::floor(low - 0.6)));
      range[2 * axis + 1] = std::min(grid.Extent[2 * axis + 1], int(std::ceil(high + 0.6)));
    }
    for (int z = range[4]; z <= range[5]; ++z)
    {
      for (int y = range[2]; y <= range[3]; ++y)
      {
        for (int x = range[0]; x <= range[1]; ++x)
        {
          const Vector centre{ double(x), double(y), double(z) };
          const double distance = CubeDistanceToTriangle(centre, t);
          if (distance > 0.5 + Undecided)
          {
            continue;
          }
          Samples& voxel = samples[{ x, y, z }];
          voxel.Decided = voxel.Decided && std::abs(distance - 0.5) > Undecided;
          const vtkTypeInt64* ids = triangles.GetPointIds(id);
          const Vector weights = NearestWeights(centre, t);
          double value = 0.0;
          for (int corner = 0; corner < 3 && ofPoints; ++corner)
          {
            value += weights[corner] * values->GetComponent(ids[corner], component);
          }
          voxel.Values.push_back(ofPoints ? value : values->GetComponent(id, component));
        }
      }
    }
  }
  return samples;
}

double Combined(const std::vector<double>& values, int combination)
{
  switch (combination)
  {
    case Voxelizer::COMBINE_MIN:
      return *std::min_element(values.begin(), values.end());
    case Voxelizer::COMBINE_MAX:
      return *std::max_element(values.begin(), values.end());
    case Voxelizer::COMBINE_FIRST:
      return values.front();
    default:
      double sum = 0.0;
      for (const double value : values)
      {
        sum += value;
      }
      return sum / values.size();
  }
}

void AddArray(vtkDataSetAttributes* data, const char* name, vtkIdType tuples, int components,
  const std::function<double(vtkIdType, int)>& value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      array->SetComponent(i, c, value(i, c));
    }
  }
  data->AddArray(array);
}

/// Arrays "points" (three components, far from zero) and "cells".
void AddArrays(vtkPolyData* mesh)
{
  std::mt19937 random(Seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  AddArray(mesh->GetPointData(), "points", mesh->GetNumberOfPoints(), 3,
    [&](vtkIdType, int c) { return 500.0 * c + unit(random); });
  AddArray(mesh->GetCellData(), "cells", mesh->GetNumberOfCells(), 1,
    [&](vtkIdType i, int) { return double(i); });
}

vtkSmartPointer<Voxelizer> MakeVoxelizer(vtkDataObject* mesh, vtkImageData* grid)
{
  auto voxelizer = vtkSmartPointer<Voxelizer>::New();
  voxelizer->SetInputDataObject(mesh);
  voxelizer->SetReferenceImage(grid);
  voxelizer->AddAttribute("points");
  voxelizer->AddAttribute("cells");
  return voxelizer;
}

void CheckArray(VoxelTestChecks& checks, const std::string& name, vtkPolyData* list,
  const std::map<Voxel, Samples>& samples, const char* arrayName, int component, int combination)
{
  auto* indices = vtkIntArray::SafeDownCast(list->GetPointData()->GetArray("VoxelIndex"));
  vtkDataArray* array = list->GetPointData()->GetArray(arrayName);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const auto& [voxel, sample] : samples)
  {
    const auto [least, most] = std::minmax_element(sample.Values.begin(), sample.Values.end());
    low = std::min(low, *least);
    high = std::max(high, *most);
  }
  vtkIdType undecided = 0;
  double worst = 0.0;
  for (vtkIdType i = 0; i < list->GetNumberOfPoints(); ++i)
  {
    const int* ijk = indices->GetPointer(3 * i);
    const auto found = samples.find({ ijk[0], ijk[1], ijk[2] });
    if (found == samples.end() || !found->second.Decided)
    {
      ++undecided;
      continue;
    }
    const double expected = Combined(found->second.Values, combination);
    worst = std::max(worst, std::abs(array->GetComponent(i, component) - expected));
  }
  checks.Check(name + ": worst difference of " + std::to_string(worst) + " in a range of " +
      std::to_string(high - low),
    worst <= ToleranceOfRange * (high - low));
  checks.Check(name + ": " + std::to_string(undecided) + " undecided of " +
      std::to_string(list->GetNumberOfPoints()),
    undecided * 100 < list->GetNumberOfPoints());
}

void TestCombinations(VoxelTestChecks& checks)
{
  const Mesh mesh = Rotated(TorusKnot(20.0, 10, 60));
  AddArrays(mesh);
  const auto grid = VoxelSolidTests::MakeGridAround(mesh, 40);
  const Grid reference = Grid::FromImage(grid);
  vtkDataArray* points = mesh->GetPointData()->GetArray("points");
  vtkDataArray* cells = mesh->GetCellData()->GetArray("cells");
  const auto pointSamples = SampleMesh(mesh, reference, points, true, 2);
  const auto cellSamples = SampleMesh(mesh, reference, cells, false, 0);
  const auto voxelizer = MakeVoxelizer(mesh, grid);
  for (const int combination : { Voxelizer::COMBINE_AVERAGE, Voxelizer::COMBINE_MIN,
         Voxelizer::COMBINE_MAX, Voxelizer::COMBINE_FIRST })
  {
    voxelizer->SetAttributeCombination(combination);
    voxelizer->Update(1);
    const std::string name = "combination " + std::to_string(combination);
    vtkPolyData* list = voxelizer->GetVoxelList();
    CheckArray(checks, name + " of points", list, pointSamples, "points", 2, combination);
    CheckArray(checks, name + " of cells", list, cellSamples, "cells", 0, combination);
  }
}

bool IsSame(vtkDataArray* a, vtkDataArray* b)
{
  bool same = a && b && a->GetNumberOfValues() == b->GetNumberOfValues();
  for (vtkIdType i = 0; same && i < a->GetNumberOfValues(); ++i)
  {
    same = a->GetVariantValue(i) == b->GetVariantValue(i);
  }
  return same;
}

void TestRepetition(VoxelTestChecks& checks)
{
  const Mesh mesh = Rotated(TorusKnot(20.0, 24, 160));
  AddArrays(mesh);
  const auto grid = VoxelSolidTests::MakeGridAround(mesh, 30);
  vtkNew<vtkPolyData> first;
  for (const int backend : VoxelSolidTests::Backends)
  {
    for (const int strategy : { Voxelizer::STRATEGY_AUTO, Voxelizer::STRATEGY_TRIANGLE,
           Voxelizer::STRATEGY_FRAGMENT, Voxelizer::STRATEGY_HYBRID })
    {
      const auto voxelizer = MakeVoxelizer(mesh, grid);
      voxelizer->SetBackend(backend);
      voxelizer->SetStrategy(strategy);
      voxelizer->SetCutoffArea(4.0);
      voxelizer->Update(1);
      vtkPolyData* list = voxelizer->GetVoxelList();
      if (!first->GetNumberOfPoints())
      {
        first->ShallowCopy(list);
      }
      for (const char* array : { "points", "cells", "VoxelIndex" })
      {
        checks.Check(VoxelSolidTests::NameOf(backend) + ", strategy " + std::to_string(strategy) +
            ": same " + array,
          IsSame(list->GetPointData()->GetArray(array), first->GetPointData()->GetArray(array)));
      }
    }
  }
}

void TestImage(VoxelTestChecks& checks)
{
  const Mesh mesh = Rotated(TorusKnot(20.0, 10, 60));
  AddArrays(mesh);
  const auto grid = VoxelSolidTests::MakeGridAround(mesh, 40);
  const auto voxelizer = MakeVoxelizer(mesh, grid);
  voxelizer->Update(1);
  vtkNew<vtkPolyData> list;
  list->ShallowCopy(voxelizer->GetVoxelList());
  voxelizer->Update();
  vtkImageData* image = voxelizer->GetOutput();
  checks.Equal(
    "voxels of the image", voxelizer->GetNumberOfFilledVoxels(), list->GetNumberOfPoints());
  auto* indices = vtkIntArray::SafeDownCast(list->GetPointData()->GetArray("VoxelIndex"));
  vtkDataArray* ofImage = image->GetPointData()->GetArray("points");
  vtkDataArray* ofList = list->GetPointData()->GetArray("points");
  bool same = ofImage && ofImage->GetNumberOfTuples() == image->GetNumberOfPoints();
  double sum = 0.0;
  for (vtkIdType i = 0; same && i < list->GetNumberOfPoints(); ++i)
  {
    int ijk[3];
    indices->GetTypedTuple(i, ijk);
    const vtkIdType voxel = image->ComputePointId(ijk);
    double position[3];
    image->GetPoint(voxel, position);
    const double* centre = list->GetPoint(i);
    for (int c = 0; c < 3; ++c)
    {
      same = same && ofImage->GetComponent(voxel, c) == ofList->GetComponent(i, c) &&
        std::abs(position[c] - centre[c]) < 1e-5;
      sum += ofList->GetComponent(i, c);
    }
  }
  checks.Check("values and places of the image are those of the list", same);
  double total = 0.0;
  for (vtkIdType i = 0; same && i < ofImage->GetNumberOfValues(); ++i)
  {
    total += ofImage->GetComponent(i / 3, int(i % 3));
  }
  checks.Equal("sum over the image, zero elsewhere", std::abs(total - sum) < 1e-6 * sum, true);
}

/// Cells of every kind with the cells' numbers: a value must be that of a cell that is there.
void TestKindsOfCells(VoxelTestChecks& checks)
{
  const Mesh prism = StarPrism({ 10, 10, 10 }, 9.0, 14.0, 5);
  AddArrays(prism);
  const Mesh strips = AsStrips(TorusKnot(20.0, 10, 60));
  AddArrays(strips);
  for (const auto& [name, mesh] :
    std::vector<std::pair<std::string, Mesh>>{ { "polygons", prism }, { "strips", strips } })
  {
    const auto grid = VoxelSolidTests::MakeGridAround(mesh, 24);
    const auto voxelizer = MakeVoxelizer(mesh, grid);
    voxelizer->SetAttributeCombinationToFirst();
    voxelizer->Update(1);
    vtkPolyData* list = voxelizer->GetVoxelList();
    vtkDataArray* cells = list->GetPointData()->GetArray("cells");
    const Grid reference = Grid::FromImage(grid);
    vtkIdType wrong = 0;
    for (vtkIdType i = 0; i < list->GetNumberOfPoints(); ++i)
    {
      int ijk[3];
      vtkIntArray::SafeDownCast(list->GetPointData()->GetArray("VoxelIndex"))
        ->GetTypedTuple(i, ijk);
      Mesh one = Mesh::New();
      one->SetPoints(mesh->GetPoints());
      vtkNew<vtkIdList> ids;
      mesh->GetCellPoints(static_cast<vtkIdType>(cells->GetComponent(i, 0)), ids);
      vtkNew<vtkCellArray> cell;
      cell->InsertNextCell(ids);
      mesh->GetNumberOfStrips() > 0 ? one->SetStrips(cell) : one->SetPolys(cell);
      const Volume touched = TouchedVoxelsReference(one, reference);
      wrong += touched.At({ ijk[0], ijk[1], ijk[2] }) == 0;
    }
    checks.Check(name + ": some voxels", list->GetNumberOfPoints() > 100);
    checks.Equal(name + ": voxels whose cell is elsewhere", wrong, 0);
  }
}

void TestBlocks(VoxelTestChecks& checks)
{
  const Mesh left = Box({ 0.2, 0.2, 0.2 }, { 5.3, 5.3, 5.3 });
  const Mesh right = Box({ 10.2, 0.2, 0.2 }, { 15.3, 5.3, 5.3 });
  AddArray(
    left->GetCellData(), "side", left->GetNumberOfCells(), 1, [](vtkIdType, int) { return 1.0; });
  AddArray(
    right->GetCellData(), "side", right->GetNumberOfCells(), 1, [](vtkIdType, int) { return 2.0; });
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, left);
  blocks->SetBlock(1, right);
  vtkNew<Voxelizer> voxelizer;
  voxelizer->SetInputDataObject(blocks);
  voxelizer->SetVoxelSize(1.0);
  voxelizer->AddAttribute("side");
  voxelizer->Update(1);
  vtkPolyData* list = voxelizer->GetVoxelList();
  vtkIdType wrong = 0;
  for (vtkIdType i = 0; i < list->GetNumberOfPoints(); ++i)
  {
    const double expected = list->GetPoint(i)[0] < 8.0 ? 1.0 : 2.0;
    wrong += list->GetPointData()->GetArray("side")->GetComponent(i, 0) != expected;
  }
  checks.Check("blocks: some voxels", list->GetNumberOfPoints() > 100);
  checks.Equal("blocks: wrong sides", wrong, 0);
}

void TestColors(VoxelTestChecks& checks)
{
  const Mesh mesh = Box({ 0.2, 0.2, 0.2 }, { 9.3, 9.3, 9.3 });
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("colors");
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    colors->InsertNextTuple3(255, 128, 7);
  }
  mesh->GetCellData()->AddArray(colors);
  vtkNew<Voxelizer> voxelizer;
  voxelizer->SetInputData(mesh);
  voxelizer->AddAttribute("colors");
  voxelizer->Update(1);
  vtkDataArray* result = voxelizer->GetVoxelList()->GetPointData()->GetArray("colors");
  checks.Check("colours stay unsigned char", vtkUnsignedCharArray::SafeDownCast(result) != nullptr);
  vtkIdType wrong = 0;
  for (vtkIdType i = 0; i < result->GetNumberOfTuples(); ++i)
  {
    const double* color = result->GetTuple3(i);
    wrong += color[0] != 255 || color[1] != 128 || color[2] != 7;
  }
  checks.Equal("colours that changed", wrong, 0);
}
}

int TestSurfaceAttributes(int, char*[])
{
  VoxelTestChecks checks;
  TestCombinations(checks);
  TestRepetition(checks);
  TestImage(checks);
  TestKindsOfCells(checks);
  TestBlocks(checks);
  TestColors(checks);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
