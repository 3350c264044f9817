// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelTree.h"

#include "vtkBitArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkHyperTree.h"
#include "vtkHyperTreeGrid.h"
#include "vtkHyperTreeGridNonOrientedCursor.h"
#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace
{
constexpr int BranchFactor = 2;
constexpr int ChildrenPerCell = 8;

/// As deep as this the trees are, less where the grid is small; a code has 64 bits.
constexpr int MostLevels = 12;

/// No more root cells than this on an axis, unless the trees are deepest.
constexpr int MostTrees = 4;

std::uint64_t PathOf(const glm::ivec3& voxel, int levels)
{
  std::uint64_t path = 0;
  for (int level = levels - 1; level >= 0; --level)
  {
    const int child =
      (voxel.x >> level & 1) | (voxel.y >> level & 1) << 1 | (voxel.z >> level & 1) << 2;
    path = path << 3 | static_cast<std::uint64_t>(child);
  }
  return path;
}
}

vtkVoxelTree::vtkVoxelTree(const vtkVoxelGrid& grid)
  : Grid(grid)
{
  if (grid.Direction != glm::dmat3(1.0))
  {
    throw std::runtime_error("A vtkHyperTreeGrid can't be rotated: " + grid.Describe() +
      ". Take the image or the list of voxels instead, or a direction that is the identity.");
  }
  const glm::ivec3 n = grid.GetDimensions();
  const int longest = std::max({ n.x, n.y, n.z });
  while (this->Levels < MostLevels && (longest >> this->Levels) >= MostTrees)
  {
    ++this->Levels;
  }
  this->Trees = (n + (1 << this->Levels) - 1) >> this->Levels;
}

void vtkVoxelTree::AddVoxel(const glm::ivec3& voxel)
{
  const glm::ivec3 root = voxel >> this->Levels;
  const auto tree = static_cast<std::uint64_t>(
    (std::int64_t(root.z) * this->Trees.y + root.y) * this->Trees.x + root.x);
  this->Codes.push_back(tree << (3 * this->Levels) | PathOf(voxel, this->Levels));
}

/// One build: walks down the trees with a cursor, the voxels in the order of their codes.
class vtkVoxelTree::Builder
{
public:
  Builder(const vtkVoxelTree& tree, vtkHyperTreeGrid* output,
    const std::vector<vtkSmartPointer<vtkDataArray>>& values)
    : Tree(tree)
    , Output(output)
    , Values(values)
    , Order(tree.Codes.size())
  {
    std::iota(this->Order.begin(), this->Order.end(), std::uint32_t(0));
    std::sort(this->Order.begin(), this->Order.end(),
      [&](std::uint32_t a, std::uint32_t b) { return tree.Codes[a] < tree.Codes[b]; });
    this->Occupancy->SetName("Occupancy");
    for (const auto& array : values)
    {
      auto cells = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
      cells->SetName(array->GetName());
      cells->SetNumberOfComponents(array->GetNumberOfComponents());
      this->CellValues.push_back(cells);
    }
  }

  bool Run(const std::function<bool(double)>& progress)
  {
    const int shift = 3 * this->Tree.Levels;
    vtkNew<vtkHyperTreeGridNonOrientedCursor> cursor;
    vtkIdType firstNode = 0;
    std::size_t begin = 0;
    while (begin < this->Order.size())
    {
      if (!progress(double(begin) / this->Order.size()))
      {
        return false;
      }
      const std::uint64_t tree = this->Tree.Codes[this->Order[begin]] >> shift;
      std::size_t end = begin;
      while (end < this->Order.size() && this->Tree.Codes[this->Order[end]] >> shift == tree)
      {
        ++end;
      }
      this->Output->InitializeNonOrientedCursor(cursor, static_cast<vtkIdType>(tree), true);
      cursor->SetGlobalIndexStart(firstNode);
      this->Fill(cursor, this->Tree.Levels, begin, end);
      firstNode += cursor->GetTree()->GetNumberOfVertices();
      begin = end;
    }
    this->Output->SetMask(this->Mask);
    vtkCellData* cells = this->Output->GetCellData();
    cells->SetScalars(this->Occupancy);
    for (const auto& array : this->CellValues)
    {
      cells->AddArray(array);
    }
    return true;
  }

private:
  /// The cell under the cursor, which holds the voxels from `begin` on, `levels` above them.
  void Fill(
    vtkHyperTreeGridNonOrientedCursor* cursor, int levels, std::size_t begin, std::size_t end)
  {
    const vtkIdType node = cursor->GetGlobalNodeIndex();
    const bool isEmpty = begin == end;
    this->Mask->InsertValue(node, isEmpty);
    this->Occupancy->InsertValue(node, !isEmpty);
    const bool isVoxel = levels == 0 && !isEmpty;
    for (std::size_t i = 0; i < this->Values.size(); ++i)
    {
      if (isVoxel)
      {
        this->CellValues[i]->InsertTuple(node, this->Order[begin], this->Values[i]);
      }
      else
      {
        const std::vector<double> nothing(this->Values[i]->GetNumberOfComponents(), 0.0);
        this->CellValues[i]->InsertTuple(node, nothing.data());
      }
    }
    if (isEmpty || levels == 0)
    {
      return;
    }
    cursor->SubdivideLeaf();
    const int shift = 3 * (levels - 1);
    for (int child = 0; child < ChildrenPerCell; ++child)
    {
      std::size_t childEnd = begin;
      while (childEnd < end && this->ChildAt(childEnd, shift) == child)
      {
        ++childEnd;
      }
      cursor->ToChild(static_cast<unsigned char>(child));
      this->Fill(cursor, levels - 1, begin, childEnd);
      cursor->ToParent();
      begin = childEnd;
    }
  }

  int ChildAt(std::size_t i, int shift) const
  {
    return static_cast<int>(this->Tree.Codes[this->Order[i]] >> shift & 7);
  }

  const vtkVoxelTree& Tree;
  vtkHyperTreeGrid* Output;
  const std::vector<vtkSmartPointer<vtkDataArray>>& Values;
  std::vector<std::uint32_t> Order;
  vtkNew<vtkBitArray> Mask;
  vtkNew<vtkUnsignedCharArray> Occupancy;
  std::vector<vtkSmartPointer<vtkDataArray>> CellValues;
};

bool vtkVoxelTree::Build(vtkHyperTreeGrid* output,
  const std::vector<vtkSmartPointer<vtkDataArray>>& values,
  const std::function<bool(double)>& progress)
{
  const vtkVoxelGrid boxes = this->Grid.VoxelsToCells();
  output->Initialize();
  output->SetDimensions(this->Trees.x + 1, this->Trees.y + 1, this->Trees.z + 1);
  output->SetBranchFactor(BranchFactor);
  for (int axis = 0; axis < 3; ++axis)
  {
    vtkNew<vtkDoubleArray> coordinates;
    const double first = boxes.Origin[axis] + boxes.GetFirst()[axis] * boxes.Spacing[axis];
    for (int i = 0; i <= this->Trees[axis]; ++i)
    {
      coordinates->InsertNextValue(first + double(i << this->Levels) * boxes.Spacing[axis]);
    }
    axis == 0     ? output->SetXCoordinates(coordinates)
      : axis == 1 ? output->SetYCoordinates(coordinates)
                  : output->SetZCoordinates(coordinates);
  }
  return Builder(*this, output, values).Run(progress);
}
