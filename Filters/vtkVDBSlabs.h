// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVDBSlabs.h
 * Private header: the occupancy grid of a .vdb file for vtkVoxelSlabWriter.
 */

#ifndef vtkVDBSlabs_h
#define vtkVDBSlabs_h

#include "vtkVoxelSlabs.h"

#include <memory>

class vtkNewVoxelFile;

namespace vtkVDBSlabs
{
/// Throws vtkVoxelFileError for a grid that a grid of OpenVDB can't have, before any work.
void Check(const vtkVoxelGrid& whole, int occupancyGrid);

/**
 * A grid "Occupancy" of the type that vtkVDBVoxelWriter names, which is kept, as sparse as it is,
 * until it is written as a whole.
 */
std::unique_ptr<vtkVoxelSlabs> Make(
  vtkNewVoxelFile& file, const vtkVoxelGrid& whole, int occupancyGrid, double halfBandWidth);
}

#endif
// VTK-HeaderTest-Exclude: vtkVDBSlabs.h
