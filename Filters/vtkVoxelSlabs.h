// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelSlabs.h
 * Private header: formats of files that take the voxels of a grid slab by slab.
 */

#ifndef vtkVoxelSlabs_h
#define vtkVoxelSlabs_h

#include "vtkVoxelGrid.h"

#include <cstdint>
#include <functional>

/**
 * One file, whose stream and grid the constructor of a format gets. Slabs come in the order of
 * their indices along one axis, without gaps, and hold all voxels of the grid along the others. All
 * functions but the getters throw vtkVoxelFileError when bytes don't arrive.
 */
class vtkVoxelSlabs
{
public:
  /// Gets the fraction that is done; stops the work by returning false.
  using Progress = std::function<bool(double)>;

  virtual ~vtkVoxelSlabs() = default;

  /// The axis along which slabs follow each other.
  virtual int GetAxis() const { return 2; }

  ///@{
  /**
   * Slices of all slabs but the last must be a multiple of the one, and had better be one of the
   * other.
   */
  virtual int GetMultiple() const { return 1; }
  virtual int GetBestMultiple() const { return this->GetMultiple(); }
  ///@}

  /// Bytes of memory taken now, what it takes to add a slab included.
  virtual std::int64_t GetBytes() const = 0;

  /// More bytes that Finish will take, when all slabs are there.
  virtual std::int64_t GetBytesToFinish() const { return 0; }

  ///@{
  /**
   * Adds the words of a slab, in the layout of vtkSlicemap; writes what is left. False when
   * stopped.
   */
  virtual bool Add(
    const std::uint32_t* words, const vtkVoxelGrid& slab, const Progress& progress) = 0;
  virtual bool Finish(const Progress& progress) = 0;
  ///@}

protected:
  vtkVoxelSlabs() = default;
  vtkVoxelSlabs(const vtkVoxelSlabs&) = delete;
  void operator=(const vtkVoxelSlabs&) = delete;
};

#endif
// VTK-HeaderTest-Exclude: vtkVoxelSlabs.h
