// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file GltfFileCheck.h
 * Looks for damage in glTF files that VTK's reader would not notice, or not survive.
 */

#ifndef GltfFileCheck_h
#define GltfFileCheck_h

#include <string>

namespace GltfFileCheck
{
/**
 * Everything that something in a .gltf or .glb file refers to by an index is there, its buffers
 * hold all that is taken from them, its nodes form trees, and it uses nothing that VTK cannot read.
 * Throws Failure with ExitCode::Input otherwise.
 */
void Check(const std::string& file);
}

#endif
