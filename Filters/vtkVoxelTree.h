// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelTree.h
 * Private header: set voxels as a vtkHyperTreeGrid, VTK's sparse octree.
 *
 * The leaves at the deepest level are the voxels; all that lies between them is coarse, and masked.
 */

#ifndef vtkVoxelTree_h
#define vtkVoxelTree_h

#include "vtkSmartPointer.h"
#include "vtkType.h"
#include "vtkVoxelGrid.h"

#include <cstdint>
#include <functional>
#include <vector>

class vtkDataArray;
class vtkHyperTreeGrid;

class vtkVoxelTree
{
public:
  /// Throws std::runtime_error when the grid does not lie along the world's axes, as a
  /// vtkHyperTreeGrid must.
  explicit vtkVoxelTree(const vtkVoxelGrid& grid);

  /// Adds a set voxel, counted from the first voxel of the grid.
  void AddVoxel(const glm::ivec3& voxel);

  std::size_t GetNumberOfVoxels() const { return this->Codes.size(); }

  /// Fills `output` with all voxels added, and its cell data with the arrays `values` that hold one
  /// tuple a voxel in the order of their addition. `progress` takes the fraction done and answers
  /// whether to go on; false when it did not.
  bool Build(vtkHyperTreeGrid* output, const std::vector<vtkSmartPointer<vtkDataArray>>& values,
    const std::function<bool(double)>& progress);

private:
  class Builder;

  vtkVoxelGrid Grid;
  int Levels = 0;                   ///< below the root cells, which are cubes of 2^Levels voxels
  glm::ivec3 Trees{ 1 };            ///< number of root cells
  std::vector<std::uint64_t> Codes; ///< tree, then the path to the voxel, three bits a level
};

#endif
// VTK-HeaderTest-Exclude: vtkVoxelTree.h
