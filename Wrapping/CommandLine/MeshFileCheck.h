// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file MeshFileCheck.h
 * Looks for damage that VTK's readers would not notice, or not survive.
 *
 * All functions throw Failure with ExitCode::Input, and take files that can be opened.
 */

#ifndef MeshFileCheck_h
#define MeshFileCheck_h

#include <string>

namespace MeshFileCheck
{
/// A binary file is as long as its number of triangles says, and its points are finite.
void CheckSTL(const std::string& file);

/// The header declares points and faces, and the file holds all of them.
void CheckPLY(const std::string& file);

/// Whether this is a PLY file in text that ends within its last line.
bool IsPLYWithoutLastLineEnd(const std::string& file);

/// Faces refer to points, normals and texture coordinates that the file has.
void CheckOBJ(const std::string& file);
}

#endif
