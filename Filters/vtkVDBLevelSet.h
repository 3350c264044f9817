// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVDBLevelSet.h
 * Private header: the narrow band of signed distances around solid voxels.
 */

#ifndef vtkVDBLevelSet_h
#define vtkVDBLevelSet_h

#include <openvdb/openvdb.h>

#include <cstdint>
#include <functional>

struct vtkVoxelGrid;

namespace vtkVDBLevelSet
{
/**
 * Throws vtkVoxelFileError when voxels are no cubes.
 */
void Check(const vtkVoxelGrid& lattice);

/**
 * Bytes that Make takes at most beside those of `solid`.
 */
std::int64_t EstimateBytes(const openvdb::MaskTree& solid);

/**
 * Distances, in world units, negative inside: from the centre of a voxel to the nearest centre of
 * the other kind, less half a voxel, which is exact on average and off by half a voxel at most
 * where the surface is not sharper than voxels. Active are the voxels closer than `halfWidth`,
 * at most 7, voxels; the background is that distance; a pruned level set as OpenVDB wants it.
 * `progress` gets the fraction that is done, and stops the work by returning false.
 */
openvdb::FloatGrid::Ptr Make(const openvdb::MaskTree& solid, double voxelSize, double halfWidth,
  const std::function<bool(double)>& progress);
}

#endif
// VTK-HeaderTest-Exclude: vtkVDBLevelSet.h
