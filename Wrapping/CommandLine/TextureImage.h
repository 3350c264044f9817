// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file TextureImage.h
 * Reads the image that colours a mesh.
 */

#ifndef TextureImage_h
#define TextureImage_h

#include "vtkSmartPointer.h"

#include <string>

class Messages;
class vtkImageData;

namespace TextureImage
{
/**
 * A flat image of unsigned char. Throws Failure with ExitCode::Input when there is none, or only a
 * part of it.
 */
vtkSmartPointer<vtkImageData> Read(const std::string& file, Messages& messages);

/// What can be read, for messages: ".png, .jpg ...".
std::string GetExtensions();
}

#endif
