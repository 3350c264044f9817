// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file PngFileCheck.h
 * Looks for damage in PNG files, of which VTK's reader survives none.
 */

#ifndef PngFileCheck_h
#define PngFileCheck_h

#include <string>

namespace PngFileCheck
{
/// All chunks are whole, and hold as many pixels as the header says. Throws Failure with
/// ExitCode::Input otherwise.
void Check(const std::string& file);
}

#endif
