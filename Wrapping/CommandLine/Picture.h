// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Picture.h
 * Draws set voxels.
 */

#ifndef Picture_h
#define Picture_h

#include "vtkSmartPointer.h"

#include <string>

class VoxelSet;
class vtkImageData;

namespace Picture
{
/**
 * The voxels as small cubes, seen at a slant from above, on a white floor that they shade; cropped
 * to them, in the colours of the attribute, if there is one of this name. The axis upAxis (0, 1, 2)
 * points up. Null when there is no OpenGL to draw with.
 */
vtkSmartPointer<vtkImageData> Draw(
  const VoxelSet& voxels, const std::string& attribute, int upAxis);

/**
 * Writes a picture as PNG to the staged file. Throws Failure with ExitCode::Output, which names the
 * target, when that fails.
 */
void Write(vtkImageData* picture, const std::string& staged, const std::string& target);
}

#endif
