// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelMemory.h
 * Private header: says no to results that don't fit into memory before there is any for them.
 */

#ifndef vtkVoxelMemory_h
#define vtkVoxelMemory_h

#include <cstdint>
#include <string>

namespace vtkVoxelMemory
{
/// What the system says is free, or can be freed at once.
std::int64_t GetFreeBytes();

/**
 * Whether so many bytes are no more than `limit`, or than are free where the limit is 0.
 */
bool Fits(std::int64_t bytes, std::int64_t limit);

/**
 * Throws std::runtime_error, which names `what` and ends with `remedy`, when so many
 * bytes don't fit.
 */
void CheckBytes(
  std::int64_t bytes, std::int64_t limit, const std::string& what, const std::string& remedy);
}

#endif
// VTK-HeaderTest-Exclude: vtkVoxelMemory.h
