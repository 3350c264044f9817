// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVDBOutput.h
 * Private header: grids of OpenVDB on their way into a file.
 */

#ifndef vtkVDBOutput_h
#define vtkVDBOutput_h

#include <openvdb/openvdb.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

class vtkNewVoxelFile;

namespace vtkVDBOutput
{
using Metadata = std::map<std::string, std::string>;

/// What files say of themselves unless told otherwise.
Metadata GetDefaultMetadata();

/// The best of the compressions of vtkVDBVoxelWriter that OpenVDB was built with.
int GetDefaultCompression();

/**
 * Writes all grids, compressed as vtkVDBVoxelWriter names it. `progress` gets the fraction that is
 * done, and stops the work by returning false, which is returned. Throws vtkVoxelFileError when
 * bytes don't arrive.
 */
bool Write(vtkNewVoxelFile& file, const std::vector<openvdb::GridBase::Ptr>& grids,
  const Metadata& metadata, int compression, const std::function<bool(double)>& progress);
}

#endif
// VTK-HeaderTest-Exclude: vtkVDBOutput.h
