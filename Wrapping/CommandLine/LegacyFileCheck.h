// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file LegacyFileCheck.h
 * Looks for damage in legacy VTK files that VTK's reader would not survive.
 */

#ifndef LegacyFileCheck_h
#define LegacyFileCheck_h

#include <string>

namespace LegacyFileCheck
{
/**
 * The file is large enough for all that it counts, up to its first attribute of points or cells,
 * and cells of the old kind take up the space that they are said to. What is no polydata is left to
 * VTK's reader. Throws Failure with ExitCode::Input.
 */
void Check(const std::string& file);
}

#endif
