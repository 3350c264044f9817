// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVDBLattice.h
 * Private header: where the voxels of an OpenVDB grid are, as a vtkVoxelGrid.
 */

#ifndef vtkVDBLattice_h
#define vtkVDBLattice_h

#include "vtkVoxelGrid.h"

#include <openvdb/openvdb.h>

namespace vtkVDBLattice
{
/**
 * Throws vtkVoxelFileError when voxels have no size or their axes are not at right angles.
 */
void Check(const vtkVoxelGrid& lattice);

/**
 * Gives a grid the transform of the lattice, and its extent as metadata. Throws what Check does.
 */
void ApplyTo(const vtkVoxelGrid& lattice, openvdb::GridBase& grid);

/**
 * Spacing, origin and direction of a grid, with an empty extent. Throws vtkVoxelFileError when its
 * transform is no such lattice: perspective or sheared.
 */
vtkVoxelGrid From(const openvdb::GridBase& grid);

///@{
/**
 * The extent of a grid as its metadata have it, which are this module's or OpenVDB's: false when
 * there is none; and the one of its active voxels.
 */
bool GetStoredExtent(const openvdb::GridBase& grid, std::array<int, 6>& extent);
std::array<int, 6> GetActiveExtent(const openvdb::GridBase& grid);
///@}

/**
 * An extent as OpenVDB has it.
 */
openvdb::CoordBBox ToBox(const std::array<int, 6>& extent);
}

#endif
// VTK-HeaderTest-Exclude: vtkVDBLattice.h
