// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVDBNewGrid.h
 * Private header: empty grids of OpenVDB.
 */

#ifndef vtkVDBNewGrid_h
#define vtkVDBNewGrid_h

#include <openvdb/openvdb.h>

/**
 * A grid made by OpenVDB's library, after its initialize. Grid::create would compile all that there
 * is of a type of grid here once more, which takes a minute for all types.
 */
template <typename Grid>
typename Grid::Ptr vtkVDBNewGrid()
{
  return openvdb::gridPtrCast<Grid>(openvdb::GridBase::createGrid(Grid::gridType()));
}

#endif
// VTK-HeaderTest-Exclude: vtkVDBNewGrid.h
