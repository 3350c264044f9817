// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Picture.h
 * Draws the voxels of an image that are set.
 */

#ifndef Picture_h
#define Picture_h

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;

namespace Picture
{
/**
 * The voxels as small cubes, seen at a slant from above, on a white floor that they shade; cropped
 * to them. The axis upAxis (0, 1, 2) points up. Null when there is no OpenGL to draw with.
 */
vtkSmartPointer<vtkImageData> Draw(vtkImageData* voxels, int upAxis);

/**
 * Writes a picture as PNG to the staged file. Throws Failure with ExitCode::Output, which names the
 * target, when that fails.
 */
void Write(vtkImageData* picture, const std::string& staged, const std::string& target);
}

#endif
