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
 * Everything that something in a .gltf or .glb file refers to by index is there, its buffers hold
 * all that is taken from them, and its nodes form trees. Throws Failure with ExitCode::Input
 * otherwise. `name` is the name by which VTK reads the file, whose own name is for messages.
 */
void Check(const std::string& file, const std::string& name);
}

#endif
