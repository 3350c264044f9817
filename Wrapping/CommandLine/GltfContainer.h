// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file GltfContainer.h
 * The parts of a glTF file, and of the files and data URIs that it names.
 */

#ifndef GltfContainer_h
#define GltfContainer_h

#include "vtk_jsoncpp.h"

#include <string>
#include <vector>

namespace GltfContainer
{
struct Parts
{
  Json::Value Root;
  bool IsBinary = false;
  std::vector<char> Binary; // the second chunk of a .glb file
};

/// The JSON of a file, and what a .glb file holds besides. Throws Failure with ExitCode::Input.
Parts Read(const std::string& file);

/**
 * The bytes behind the URI of a buffer, which is promised to have so many. Throws Failure with
 * ExitCode::Input unless they are there and VTK can read them.
 */
std::vector<char> ReadUri(
  const std::string& file, const std::string& place, const std::string& uri, std::size_t promised);

/// Throws Failure with ExitCode::Input: the file contradicts itself.
[[noreturn]] void RefuseDamaged(const std::string& file, const std::string& why);
}

#endif
