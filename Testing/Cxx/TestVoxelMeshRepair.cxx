// Proves that vtkVoxelMeshRepair leaves one of the polygons at the same corners, whichever way
// round they are, none of walls within a solid, and none without an area unless edges need it:
// voxels are those of the mesh before it was spoiled; that its counts are those of a comparison of
// all pairs; and that points, data, lines and the order of cells survive.

#include "VoxelComparison.h"
#include "VoxelSolidTests.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkVoxelMeshRepair.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <random>

using namespace VoxelReference;
using namespace VoxelTestMeshes;

namespace
{
struct Counts
{
  vtkIdType Degenerates = 0;
  vtkIdType Duplicates = 0;
  vtkIdType Opposites = 0;
  vtkIdType Walls = 0;
};

void CheckCounts(VoxelTestChecks& checks, const std::string& name, vtkVoxelMeshRepair* repair,
  const Counts& expected)
{
  checks.Equal(name + ": degenerates", repair->GetNumberOfDegenerates(), expected.Degenerates);
  checks.Equal(name + ": duplicates", repair->GetNumberOfDuplicates(), expected.Duplicates);
  checks.Equal(name + ": opposites", repair->GetNumberOfOpposites(), expected.Opposites);
  checks.Equal(name + ": walls", repair->GetNumberOfWalls(), expected.Walls);
  checks.Equal(name + ": polygons left", repair->GetOutput()->GetNumberOfPolys(),
    repair->GetNumberOfPolygons() - repair->GetNumberOfDroppedPolygons());
}

/// That the solid of the mended mesh is that of `good`, and closed.
void CheckSolid(
  VoxelTestChecks& checks, const std::string& name, vtkPolyData* mended, vtkPolyData* good)
{
  const auto grid = Grid::FromImage(VoxelSolidTests::MakeGridAround(good, 40));
  const Volume found = CrossingParityReference(mended, grid);
  const Volume expected = CrossingParityReference(good, grid);
  checks.Equal(name + ": wrong voxels", Compare(found, expected).Count(), std::size_t(0));
  checks.Check(name + ": there are voxels", expected.CountNonZero() > 0);
  checks.Equal(name + ": open edges", CountOpenEdges(mended), CountOpenEdges(good));
}

vtkSmartPointer<vtkVoxelMeshRepair> Repair(vtkDataObject* mesh)
{
  auto repair = vtkSmartPointer<vtkVoxelMeshRepair>::New();
  repair->SetInputDataObject(mesh);
  repair->Update();
  return repair;
}

bool TestDoubled(vtkPolyData* bunny)
{
  const int seed = 3;
  VoxelTestChecks checks;
  const std::vector<std::pair<std::string, Mesh>> meshes = { { "bunny_7k", bunny },
    { "soup", Unshared(TorusKnot(10.0, 12, 60)) },
    { "ends with bridged holes", HoledPrism({ 30, 30, 30 }, 20.0, 33.0, false) },
    { "concave ends", StarPrism({ 30, 30, 30 }, 27.0, 40.0, 9) } };
  for (const auto& [name, mesh] : meshes)
  {
    const vtkIdType n = mesh->GetNumberOfPolys();
    const auto plain = Repair(mesh);
    CheckCounts(checks, name, plain, {});
    checks.Check(name + ": nothing to mend",
      plain->GetSummary() == "nothing to mend in " + std::to_string(n) + " polygons");

    const auto twice = Repair(Appended({ mesh, Reversed(mesh), mesh }));
    CheckCounts(checks, name + " and its reverse", twice, { 0, n, n, 0 });
    CheckSolid(checks, name + " and its reverse", twice->GetOutput(), mesh);

    // One orientation or the other comes first now, and cycles begin anywhere.
    const auto mixed = Repair(Shuffled(Appended({ mesh, Reversed(mesh) }), seed));
    CheckCounts(checks, name + " shuffled, seed 3", mixed, { 0, 0, n, 0 });
    if (name != "ends with bridged holes" && name != "concave ends")
    {
      CheckSolid(checks, name + " shuffled, seed 3", mixed->GetOutput(), mesh);
    }
  }
  // Where only a part is doubled its rim says that one must stay.
  Mesh half;
  half.TakeReference(vtkPolyData::New());
  half->SetPoints(bunny->GetPoints());
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIdList> cell;
  for (vtkIdType i = 0; i < bunny->GetNumberOfPolys() / 2; ++i)
  {
    bunny->GetPolys()->GetCellAtId(i, cell);
    cells->InsertNextCell(cell);
  }
  half->SetPolys(cells);
  const auto partly = Repair(Appended({ bunny, Reversed(half) }));
  CheckCounts(checks, "half doubled", partly, { 0, 0, half->GetNumberOfPolys(), 0 });
  CheckSolid(checks, "half doubled", partly->GetOutput(), bunny);
  // A hole is no reason to drop what is around it.
  const Mesh holed = WithHoles(bunny, seed, 5);
  const auto open = Repair(Appended({ holed, Reversed(holed) }));
  CheckCounts(checks, "with holes, doubled", open, { 0, 0, holed->GetNumberOfPolys(), 0 });
  return checks.Passed();
}

bool TestWalls()
{
  VoxelTestChecks checks;
  const Mesh left = QuadBox({ 0, 0, 0 }, { 10, 10, 10 });
  const Mesh right = QuadBox({ 10, 0, 0 }, { 25, 10, 10 });
  const Mesh both = QuadBox({ 0, 0, 0 }, { 25, 10, 10 });
  const auto wall = Repair(Appended({ left, right }));
  CheckCounts(checks, "two boxes", wall, { 0, 0, 0, 2 });
  CheckSolid(checks, "two boxes", wall->GetOutput(), both);

  // A wall of several polygons, to be dropped together: the right box is the left one mirrored.
  vtkNew<vtkPolyData> mirrored;
  mirrored->DeepCopy(Reversed(Triangulated(left)));
  for (vtkIdType i = 0; i < mirrored->GetNumberOfPoints(); ++i)
  {
    const double* p = mirrored->GetPoint(i);
    mirrored->GetPoints()->SetPoint(i, 20.0 - p[0], p[1], p[2]);
  }
  const auto triangles = Repair(Appended({ Triangulated(left), mirrored.Get() }));
  CheckCounts(checks, "two boxes of triangles", triangles, { 0, 0, 0, 4 });
  CheckSolid(
    checks, "two boxes of triangles", triangles->GetOutput(), QuadBox({ 0, 0, 0 }, { 20, 10, 10 }));
  const Mesh doubled = Appended({ left, Reversed(left), Reversed(right), right });
  const auto doubledWall = Repair(doubled);
  CheckCounts(checks, "two doubled boxes", doubledWall, { 0, 0, 10, 4 });
  CheckSolid(checks, "two doubled boxes", doubledWall->GetOutput(), both);

  const auto far = Repair(Appended({ left, Moved(right, { 1, 0, 0 }) }));
  CheckCounts(checks, "two boxes with a gap", far, {});
  return checks.Passed();
}

bool TestDegenerates()
{
  const int seed = 5;
  VoxelTestChecks checks;
  const Mesh knot = TorusKnot(10.0, 12, 60);
  constexpr int count = 200;
  const auto mended = Repair(WithDegenerates(knot, seed, count));
  CheckCounts(checks, "degenerates, seed 5", mended, { count, 0, 0, 0 });
  CheckSolid(checks, "degenerates, seed 5", mended->GetOutput(), knot);

  // Two triangles on one side of an edge, one on the other, and one without an area between them.
  const Vector a{ 0, 0, 0 };
  const Vector b{ 4, 0, 0 };
  const Vector m{ 2, 0, 0 };
  const Vector top{ 2, 3, 1 };
  const Vector bottom{ 2, -3, 1 };
  const Vector back{ 2, 0, 5 };
  const std::vector<std::array<Vector, 3>> parts = { { a, m, top }, { m, b, top }, { b, a, bottom },
    { a, top, back }, { top, b, back }, { b, bottom, back }, { bottom, a, back } };
  std::vector<std::array<Vector, 3>> filled = parts;
  filled.push_back({ a, b, m });
  const auto junction = Repair(FromTriangles(filled));
  CheckCounts(checks, "between unequal edges", junction, {});
  checks.Equal("open edges there", CountOpenEdges(junction->GetOutput()), 0);
  std::vector<std::array<Vector, 3>> stray = parts;
  stray.push_back({ a, top, Vector{ 1, 1.5, 0.5 } });
  stray.push_back({ Vector{ 7, 0, 0 }, Vector{ 8, 0, 0 }, Vector{ 9, 0, 0 } });
  CheckCounts(checks, "of no use", Repair(FromTriangles(stray)), { 2, 0, 0, 0 });
  return checks.Passed();
}

std::vector<Vector> CornersOf(vtkPolyData* mesh, vtkIdType polygon)
{
  vtkNew<vtkIdList> ids;
  mesh->GetPolys()->GetCellAtId(polygon, ids);
  std::vector<Vector> corners;
  for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
  {
    Vector corner;
    mesh->GetPoint(ids->GetId(i), corner.data());
    corners.push_back(corner);
  }
  return corners;
}

bool AreRotations(const std::vector<Vector>& a, std::vector<Vector> b)
{
  for (std::size_t i = 0; i < b.size(); ++i)
  {
    if (a == b)
    {
      return true;
    }
    std::rotate(b.begin(), b.begin() + 1, b.end());
  }
  return false;
}

/// Beside a comparison of all pairs of polygons; the tetrahedra touch nowhere, so that no walls
/// are.
bool TestPairs()
{
  VoxelTestChecks checks;
  for (const int seed : { 1, 2, 3, 4 })
  {
    const Mesh soup = RandomTetrahedra(seed, 12, 50.0);
    std::mt19937 random(seed);
    std::vector<Mesh> parts = { soup };
    for (int i = 0; i < 4; ++i)
    {
      const Mesh part =
        WithHoles(soup, static_cast<int>(random()), static_cast<int>(random() % 40));
      parts.push_back(random() % 2 == 0 ? part : Reversed(part));
    }
    const Mesh mesh = Shuffled(Appended(parts), seed);
    Counts expected;
    vtkNew<vtkIdList> kept;
    for (vtkIdType i = 0; i < mesh->GetNumberOfPolys(); ++i)
    {
      const auto corners = CornersOf(mesh, i);
      bool isFirst = true;
      for (vtkIdType k = 0; k < kept->GetNumberOfIds() && isFirst; ++k)
      {
        auto other = CornersOf(mesh, kept->GetId(k));
        const bool same = AreRotations(corners, other);
        std::reverse(other.begin(), other.end());
        const bool opposite = AreRotations(corners, other);
        expected.Duplicates += same ? 1 : 0;
        expected.Opposites += opposite ? 1 : 0;
        isFirst = !same && !opposite;
      }
      if (isFirst)
      {
        kept->InsertNextId(i);
      }
    }
    const std::string name = "all pairs, seed " + std::to_string(seed);
    const auto mended = Repair(mesh);
    CheckCounts(checks, name, mended, expected);
    CheckSolid(checks, name, mended->GetOutput(), soup);
    for (vtkIdType k = 0; k < kept->GetNumberOfIds(); ++k)
    {
      checks.Check(
        name + ": order", CornersOf(mesh, kept->GetId(k)) == CornersOf(mended->GetOutput(), k));
    }
  }
  return checks.Passed();
}

bool TestData()
{
  VoxelTestChecks checks;
  const Mesh mesh =
    Appended({ Box({ 0, 0, 0 }, { 1, 2, 3 }), Reversed(Box({ 0, 0, 0 }, { 1, 2, 3 })) });
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1 });
  mesh->SetLines(lines);
  vtkNew<vtkIdTypeArray> cells;
  cells->SetName("cell");
  vtkNew<vtkIdTypeArray> points;
  points->SetName("point");
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    cells->InsertNextValue(100 + i);
  }
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    points->InsertNextValue(i);
  }
  mesh->GetCellData()->AddArray(cells);
  mesh->GetPointData()->AddArray(points);
  const auto mended = Repair(mesh);
  vtkPolyData* output = mended->GetOutput();
  checks.Equal("lines", output->GetNumberOfLines(), vtkIdType(1));
  checks.Equal("points", output->GetNumberOfPoints(), mesh->GetNumberOfPoints());
  checks.Check("point data", output->GetPointData()->GetArray("point") == points);
  vtkDataArray* left = output->GetCellData()->GetArray("cell");
  checks.Check("cell data", left && left->GetNumberOfTuples() == 13);
  for (vtkIdType i = 0; left && i < left->GetNumberOfTuples(); ++i)
  {
    // The line, and then the triangles of the first box.
    checks.Equal("cell data", left->GetComponent(i, 0), 100.0 + static_cast<double>(i));
  }

  const Mesh strips = AsStrips(TorusKnot(10.0, 12, 60));
  const auto ofStrips = Repair(Appended({ strips, strips }));
  checks.Equal("strips: left", ofStrips->GetOutput()->GetNumberOfPolys(), vtkIdType(2 * 12 * 60));
  CheckSolid(checks, "strips", ofStrips->GetOutput(), TorusKnot(10.0, 12, 60));

  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, Box({ 0, 0, 0 }, { 1, 2, 3 }));
  blocks->SetBlock(2, Reversed(Box({ 0, 0, 0 }, { 1, 2, 3 })));
  CheckCounts(checks, "composite", Repair(blocks), { 0, 0, 12, 0 });
  return checks.Passed();
}

bool TestBadInput()
{
  VoxelTestChecks checks;
  CheckCounts(checks, "empty", Repair(vtkSmartPointer<vtkPolyData>::New()), {});
  CheckCounts(checks, "empty composite", Repair(vtkSmartPointer<vtkMultiBlockDataSet>::New()), {});

  const Mesh wrong = Box({ 0, 0, 0 }, { 1, 1, 1 });
  wrong->GetPolys()->InsertNextCell({ 0, 1, 1000 });
  vtkNew<vtkVoxelMeshRepair> repair;
  VoxelTestObserver observer(repair);
  repair->SetInputData(wrong);
  repair->Update();
  observer.ExpectOneError(checks, "wrong ids", "a point that does not exist");
  checks.Equal("wrong ids: output", repair->GetOutput()->GetNumberOfCells(), vtkIdType(0));

  const Mesh nan = Box({ 0, 0, 0 }, { 1, 1, 1 });
  nan->GetPoints()->SetPoint(3, std::numeric_limits<double>::quiet_NaN(), 0, 0);
  CheckCounts(checks, "points that are no numbers", Repair(nan), {});
  return checks.Passed();
}
}

int TestVoxelMeshRepair(int argc, char* argv[])
{
  const Mesh bunny = ReadPLY("bunny_7k.ply", argc, argv);
  if (!bunny)
  {
    std::cerr << "bunny_7k.ply is missing\n";
    return EXIT_FAILURE;
  }
  bool good = TestDoubled(bunny);
  good &= TestWalls();
  good &= TestDegenerates();
  good &= TestPairs();
  good &= TestData();
  good &= TestBadInput();
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
