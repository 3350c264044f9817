// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVDBArrays.h
 * Private header: values of voxels between arrays of VTK and grids of OpenVDB.
 *
 *   array                               grid
 *   float, double                       float, double
 *   integers of up to 32 bits           int32 (unsigned 32 bits: int64)
 *   other integers                      int64
 *   3 components: float, double         vec3s, vec3d
 *   3 or 4 components: unsigned char    vec3s, colours of 0 to 1 without their alpha
 *   3 components: up to 32 bits         vec3i
 *   unsigned char, 0 or 1 (only back)   bool, mask
 */

#ifndef vtkVDBArrays_h
#define vtkVDBArrays_h

#include "vtkSmartPointer.h"

#include <openvdb/openvdb.h>

#include <functional>
#include <string>
#include <vector>

class vtkDataArray;
struct vtkVoxelGrid;

namespace vtkVDBArrays
{
/// Gets the fraction that is done; stops the work by returning false.
using Progress = std::function<bool(double)>;

/**
 * An empty grid of the type for such an array; the background of vectors is zero. Null when there
 * is none.
 */
openvdb::GridBase::Ptr MakeGrid(vtkDataArray* array, double background);

/**
 * Sets the voxels whose values differ from the background of a grid made by MakeGrid; the array has
 * one tuple for each voxel of the lattice.
 */
void FillImage(vtkDataArray* array, const vtkVoxelGrid& lattice, openvdb::GridBase& grid,
  const Progress& progress);

/**
 * The same for a list: all of its voxels become active. Of several in one voxel the first counts.
 */
void FillList(
  vtkDataArray* array, const std::vector<openvdb::Coord>& voxels, openvdb::GridBase& grid);

/// Whether ToImage and ToList know the type of grid.
bool IsSupported(const openvdb::GridBase& grid);

///@{
/**
 * Type and number of components of a grid's array.
 */
int GetScalarType(const openvdb::GridBase& grid);
int GetNumberOfComponents(const openvdb::GridBase& grid);
///@}

/**
 * The values of all voxels of a lattice, active or not.
 */
void ToImage(const openvdb::GridBase& grid, const vtkVoxelGrid& lattice, vtkDataArray* array,
  const Progress& progress);
}

#endif
// VTK-HeaderTest-Exclude: vtkVDBArrays.h
