// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ReferenceImage.h
 * The geometry of an image in a file.
 */

#ifndef ReferenceImage_h
#define ReferenceImage_h

#include "vtkSmartPointer.h"

#include <string>

class Messages;
class vtkImageData;

namespace ReferenceImage
{
/**
 * Extent, spacing, origin and direction matrix of the image, without its scalars, which are not
 * even read. Coordinates are taken as they stand in the file: anatomical spaces are not converted
 * into each other. Throws Failure with ExitCode::Input when there is no such image.
 */
vtkSmartPointer<vtkImageData> Read(const std::string& file, Messages& messages);

/// What can be read, for messages: ".vti, .mha ...".
std::string GetExtensions();
}

#endif
