// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkSlicemapPacker.h
 * Private header: packs scalars into the words of slicemaps, on the host, with all threads of
 * vtkSMPTools. Any number of criteria are applied in one pass over the scalars.
 *
 * Scalars are compared in their own type: the bounds of a criterion are rounded to it once, towards
 * the inside, which changes no comparison. So 299.5 is right for integers, 2^63 for 64-bit ones.
 * Only arrays of other layouts than VTK's two, by tuples or by components, go through double.
 */

#ifndef vtkSlicemapPacker_h
#define vtkSlicemapPacker_h

#include "vtkVoxelGrid.h"

#include <cstdint>
#include <functional>
#include <vector>

class vtkDataArray;

class vtkSlicemapPacker
{
public:
  /**
   * Which scalars set a voxel: those from Lower to Upper, both included, or all others. NaN is not
   * between any bounds.
   */
  struct Criterion
  {
    double Lower;
    double Upper;
    bool Inverted = false;

    static Criterion NotZero() { return { 0.0, 0.0, true }; }
  };

  /**
   * The first component of `scalars`, which has one tuple for each voxel of `grid`; both are
   * referred to as long as this lives.
   */
  vtkSlicemapPacker(
    vtkDataArray* scalars, const vtkVoxelGrid& grid, const std::vector<Criterion>& criteria);

  /**
   * Fills all words, padding included, of so many rows of voxels from `firstRow` on. `words[i]` are
   * those of criterion i, in the layout of vtkSlicemap.
   */
  void Pack(
    std::int64_t firstRow, std::int64_t rows, const std::vector<std::uint32_t*>& words) const;

private:
  using Rows = std::function<void(
    std::int64_t firstRow, std::int64_t rows, const std::vector<std::uint32_t*>& words)>;

  Rows PackRows;
  std::int64_t WordsPerRow;
};

#endif
// VTK-HeaderTest-Exclude: vtkSlicemapPacker.h
