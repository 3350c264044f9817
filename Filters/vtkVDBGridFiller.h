// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVDBGridFiller.h
 * Private header: from the words of slicemaps to trees of OpenVDB, without a dense array between.
 */

#ifndef vtkVDBGridFiller_h
#define vtkVDBGridFiller_h

#include <openvdb/openvdb.h>

#include <cstdint>
#include <functional>
#include <vector>

struct vtkVoxelGrid;

/**
 * Fills a BoolTree or a MaskTree slab by slab: set voxels become active, and true. Of a slab, each
 * block of 128^3 voxels is done by one thread. Full 8^3 and 128^3 are tiles from the start, and
 * what is empty takes no memory; slabs that end at a multiple of 128 slices are fastest.
 */
template <typename Tree>
class vtkVDBGridFiller
{
public:
  explicit vtkVDBGridFiller(Tree& tree)
    : Target(tree)
  {
  }

  /**
   * Adds the set voxels of a slab, or of any other part of the grid, in the layout of vtkSlicemap;
   * the extent of `slab` says where its first word is.
   */
  void Add(const std::uint32_t* words, const vtkVoxelGrid& slab);

  /**
   * The same for any number of slices, in layers of blocks; `progress` gets the fraction that is
   * done, and stops the work by returning false, which is returned.
   */
  bool AddLayers(const std::uint32_t* words, const vtkVoxelGrid& slices,
    const std::function<bool(double)>& progress);

  /**
   * Turns what is full and larger than 128^3 into tiles.
   */
  void Finish();

private:
  using Upper = typename Tree::RootNodeType::ChildNodeType;
  using Block = typename Upper::ChildNodeType;

  void Insert(Block* block);
  bool IsFull(const Block& block) const;

  Tree& Target;
};

#endif
// VTK-HeaderTest-Exclude: vtkVDBGridFiller.h
