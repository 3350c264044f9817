// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VoxelInput.h
 * Reads voxels from a file.
 */

#ifndef VoxelInput_h
#define VoxelInput_h

#include "vtkSmartPointer.h"

#include <string>

class Messages;
class Terminal;
class vtkImageData;

namespace VoxelInput
{
/// Whether a file of this name holds voxels, and not a mesh.
bool IsVoxels(const std::string& file);

/// Throws Failure with ExitCode::Input when the file can't be read.
vtkSmartPointer<vtkImageData> Read(const std::string& file, Messages& messages, Terminal& terminal);

/// What can be read, for messages; empty when nothing can.
std::string GetExtensions();
}

#endif
