// Proves that the voxel list and the hyper tree grid hold just the voxels of the image, with their
// places and attributes, whatever the grid, also when it is worked out in slabs; and that each
// output port is made when it is asked for, and only then.

#include "VoxelSolidTests.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkBitArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkHybridSurfaceVoxelizer.h>
#include <vtkHyperTreeGrid.h>
#include <vtkHyperTreeGridNonOrientedGeometryCursor.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <set>

using namespace VoxelTestMeshes;

namespace
{
using Ijk = std::array<int, 3>;

vtkSmartPointer<vtkHybridSurfaceVoxelizer> MakeVoxelizer(vtkPolyData* mesh, vtkImageData* grid)
{
  auto voxelizer = vtkSmartPointer<vtkHybridSurfaceVoxelizer>::New();
  voxelizer->SetInputData(mesh);
  voxelizer->SetReferenceImage(grid);
  return voxelizer;
}

std::set<Ijk> VoxelsOfImage(vtkImageData* image)
{
  std::set<Ijk> voxels;
  vtkDataArray* occupancy = image->GetPointData()->GetScalars();
  const int* e = image->GetExtent();
  vtkIdType id = 0;
  for (int z = e[4]; z <= e[5]; ++z)
  {
    for (int y = e[2]; y <= e[3]; ++y)
    {
      for (int x = e[0]; x <= e[1]; ++x, ++id)
      {
        if (occupancy->GetComponent(id, 0) != 0)
        {
          voxels.insert({ x, y, z });
        }
      }
    }
  }
  return voxels;
}

std::set<Ijk> VoxelsOfList(vtkPolyData* list)
{
  std::set<Ijk> voxels;
  auto* indices = vtkIntArray::SafeDownCast(list->GetPointData()->GetArray("VoxelIndex"));
  for (vtkIdType i = 0; indices && i < indices->GetNumberOfTuples(); ++i)
  {
    Ijk voxel;
    indices->GetTypedTuple(i, voxel.data());
    voxels.insert(voxel);
  }
  return voxels;
}

/// Visits the leaves that are not masked: their bounds and node.
void VisitLeaves(
  vtkHyperTreeGrid* tree, const std::function<void(const double bounds[6], vtkIdType node)>& visit)
{
  vtkHyperTreeGrid::vtkHyperTreeGridIterator trees;
  tree->InitializeTreeIterator(trees);
  vtkIdType index = 0;
  vtkNew<vtkHyperTreeGridNonOrientedGeometryCursor> cursor;
  const std::function<void()> walk = [&]()
  {
    if (cursor->IsMasked())
    {
      return;
    }
    if (cursor->IsLeaf())
    {
      double bounds[6];
      cursor->GetBounds(bounds);
      visit(bounds, cursor->GetGlobalNodeIndex());
      return;
    }
    for (unsigned char child = 0; child < cursor->GetNumberOfChildren(); ++child)
    {
      cursor->ToChild(child);
      walk();
      cursor->ToParent();
    }
  };
  while (trees.GetNextTree(index))
  {
    tree->InitializeNonOrientedGeometryCursor(cursor, index);
    walk();
  }
}

void TestAgainstImage(
  VoxelTestChecks& checks, const std::string& name, vtkPolyData* mesh, vtkImageData* grid)
{
  const auto voxelizer = MakeVoxelizer(mesh, grid);
  voxelizer->Update();
  const auto expected = VoxelsOfImage(voxelizer->GetOutput());
  checks.Check(name + ": some voxels", !expected.empty());

  voxelizer->Update(1);
  vtkPolyData* list = voxelizer->GetVoxelList();
  checks.Check(name + ": the list holds the voxels", VoxelsOfList(list) == expected);
  checks.Equal(
    name + ": points of the list", list->GetNumberOfPoints(), vtkIdType(expected.size()));
  checks.Equal(
    name + ": vertices of the list", list->GetNumberOfVerts(), vtkIdType(expected.size()));
  vtkIdType misplaced = 0;
  for (vtkIdType i = 0; i < list->GetNumberOfPoints(); ++i)
  {
    Ijk voxel;
    vtkIntArray::SafeDownCast(list->GetPointData()->GetArray("VoxelIndex"))
      ->GetTypedTuple(i, voxel.data());
    double place[3];
    grid->TransformIndexToPhysicalPoint(voxel.data(), place);
    const double* point = list->GetPoint(i);
    misplaced += std::hypot(point[0] - place[0], point[1] - place[1], point[2] - place[2]) >
      1e-4 * grid->GetSpacing()[0];
  }
  checks.Equal(name + ": misplaced points", misplaced, 0);

  const bool isRotated = !grid->GetDirectionMatrix()->IsIdentity();
  if (isRotated)
  {
    return;
  }
  voxelizer->Update(2);
  vtkHyperTreeGrid* tree = voxelizer->GetHyperTreeGrid();
  std::set<Ijk> leaves;
  VisitLeaves(tree,
    [&](const double bounds[6], vtkIdType node)
    {
      Ijk voxel;
      bool isVoxel = tree->GetCellData()->GetScalars()->GetComponent(node, 0) == 1;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double spacing = grid->GetSpacing()[axis];
        const double size = bounds[2 * axis + 1] - bounds[2 * axis];
        const double centre = 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
        isVoxel = isVoxel && std::abs(size - spacing) < 1e-6 * spacing;
        voxel[axis] = static_cast<int>(std::lround((centre - grid->GetOrigin()[axis]) / spacing));
      }
      checks.Check(name + ": a leaf is a voxel", isVoxel);
      leaves.insert(voxel);
    });
  checks.Check(name + ": the tree holds the voxels", leaves == expected);
}

void TestValues(VoxelTestChecks& checks)
{
  const Mesh mesh = Rotated(TorusKnot(20.0, 10, 60));
  vtkNew<vtkFloatArray> heights;
  heights->SetName("height");
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    heights->InsertNextValue(static_cast<float>(mesh->GetPoint(i)[2]));
  }
  mesh->GetPointData()->AddArray(heights);
  const auto grid = VoxelSolidTests::MakeGridAround(mesh, 60);
  const auto voxelizer = MakeVoxelizer(mesh, grid);
  voxelizer->AddAttribute("height");
  voxelizer->Update(2);
  vtkHyperTreeGrid* tree = voxelizer->GetHyperTreeGrid();
  vtkDataArray* values = tree->GetCellData()->GetArray("height");
  double worst = 0.0;
  vtkIdType count = 0;
  VisitLeaves(tree,
    [&](const double bounds[6], vtkIdType node)
    {
      worst =
        std::max(worst, std::abs(values->GetComponent(node, 0) - 0.5 * (bounds[4] + bounds[5])));
      ++count;
    });
  // A point of the surface in the voxel, or of a triangle that touches it nearby.
  checks.Check("height of the leaves", worst < 0.87 * grid->GetSpacing()[2]);
  checks.Check("many leaves", count > 1000);
}

void TestSlabs(VoxelTestChecks& checks)
{
  // 100 MiB of bits, more than a slab has.
  const Mesh mesh = Rotated(TorusKnot(20.0, 10, 60));
  const double* b = mesh->GetBounds();
  const std::array<int, 3> n{ 1024, 1024, 800 };
  const auto grid = VoxelSolidTests::MakeGrid({ 5, n[0] + 4, -3, n[1] - 4, 0, n[2] - 1 },
    { b[0], b[2], b[4] }, { (b[1] - b[0]) / 1000, (b[3] - b[2]) / 1000, (b[5] - b[4]) / 790 });
  const auto voxelizer = MakeVoxelizer(mesh, grid);
  voxelizer->HostOutputOff();
  voxelizer->Update();
  const vtkIdType expected = voxelizer->GetNumberOfFilledVoxels();
  voxelizer->Update(1);
  checks.Equal("voxels of slabs", voxelizer->GetVoxelList()->GetNumberOfPoints(), expected);
  auto* indices =
    vtkIntArray::SafeDownCast(voxelizer->GetVoxelList()->GetPointData()->GetArray("VoxelIndex"));
  bool ordered = true;
  std::array<int, 3> before{ 0, 0, -1 };
  for (vtkIdType i = 0; i < indices->GetNumberOfTuples(); ++i)
  {
    std::array<int, 3> ijk{};
    indices->GetTypedTuple(i, ijk.data());
    const std::array<int, 3> now{ ijk[2], ijk[1], ijk[0] };
    ordered = ordered && before < now;
    before = now;
  }
  checks.Check("voxels of slabs come in order", ordered);
}

void TestPorts(VoxelTestChecks& checks)
{
  const Mesh mesh = TorusKnot(20.0, 10, 60);
  vtkNew<vtkHybridSurfaceVoxelizer> voxelizer;
  voxelizer->SetInputData(mesh);
  voxelizer->Update(1);
  checks.Equal("image without being asked", voxelizer->GetOutput()->GetNumberOfPoints(), 0);
  checks.Check("list", voxelizer->GetVoxelList()->GetNumberOfPoints() > 0);
  voxelizer->Update(2);
  voxelizer->Update();
  checks.Check("image", voxelizer->GetOutput()->GetNumberOfPoints() > 0);
  checks.Check("tree", voxelizer->GetHyperTreeGrid()->GetNumberOfLeaves() > 0);
  checks.Equal("uploads", voxelizer->GetNumberOfMeshUploads(), 1);

  const vtkIdType before = voxelizer->GetVoxelList()->GetNumberOfPoints();
  voxelizer->SetSeparabilityTo6();
  voxelizer->Update(1);
  checks.Check(
    "a thin surface has fewer voxels", voxelizer->GetVoxelList()->GetNumberOfPoints() < before);
}
}

int TestSurfaceSparse(int, char*[])
{
  VoxelTestChecks checks;
  const Mesh knot = Rotated(TorusKnot(20.0, 10, 60));
  TestAgainstImage(checks, "knot", knot, VoxelSolidTests::MakeGridAround(knot, 50));
  TestAgainstImage(checks, "cut off", knot,
    VoxelSolidTests::MakeGrid({ -4, 11, 3, 3, -20, 9 }, { 1, 2, 3 }, { 0.7, 0.9, 0.5 }));
  TestAgainstImage(checks, "one voxel", Box({ -1, -1, -1 }, { 1.2, 1.2, 1.2 }),
    VoxelSolidTests::MakeGrid({ 7, 7, 7, 7, 7, 7 }, { -6, -6, -6 }, { 1, 1, 1 }));
  TestAgainstImage(checks, "rotated grid", knot,
    VoxelSolidTests::MakeGrid({ 2, 40, -9, 31, 0, 40 }, { -1, 2, 3 }, { 0.5, 0.6, 0.7 },
      { 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1 }));
  TestValues(checks);
  TestSlabs(checks);
  TestPorts(checks);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
