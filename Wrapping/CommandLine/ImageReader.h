// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ImageReader.h
 * Reads an image, or no more than its geometry, by VTK's reader for its extension.
 */

#ifndef ImageReader_h
#define ImageReader_h

#include "vtkSmartPointer.h"

#include <string>

class Messages;
class Terminal;
class vtkImageData;

/**
 * Coordinates are taken as they stand in the file: anatomical spaces are not converted into each
 * other.
 */
namespace ImageReader
{
/**
 * Extent, spacing, origin and direction matrix of the image, without its scalars, which are not
 * even read. Throws Failure with ExitCode::Input when there is no such image.
 */
vtkSmartPointer<vtkImageData> ReadGeometry(const std::string& file, Messages& messages);

/**
 * The same with all arrays, and active scalars of points or cells among them; those of NIfTI are
 * scaled by the slope and the intercept of the file.
 */
vtkSmartPointer<vtkImageData> Read(const std::string& file, Messages& messages, Terminal& terminal);

/// Whether a file of this name holds an image; those of .vtk are taken for meshes.
bool IsImage(const std::string& file);

///@{
/// What can be read, for messages: ".vti, .mha ..."; and the part of it that IsImage knows.
std::string GetExtensions();
std::string GetImageExtensions();
///@}
}

#endif
