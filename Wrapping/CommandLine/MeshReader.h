// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file MeshReader.h
 * Reads a mesh by VTK's reader for its extension.
 */

#ifndef MeshReader_h
#define MeshReader_h

#include "vtkBoundingBox.h"
#include "vtkSmartPointer.h"

#include <string>

class Messages;
class Terminal;
class vtkDataObject;

namespace MeshReader
{
/**
 * The mesh of a file: a vtkPolyData, or a composite of them with the transforms of their nodes
 * applied, with all arrays of points and cells that VTK reads. It has polygons or strips, and all
 * its points are finite. Throws Failure with ExitCode::Input otherwise.
 */
vtkSmartPointer<vtkDataObject> Read(
  const std::string& file, Messages& messages, Terminal& terminal);

/// The box of all points of a mesh that was read.
vtkBoundingBox GetBounds(vtkDataObject* mesh);

/// Whether a file of this name is taken for a mesh.
bool IsMesh(const std::string& file);

/// What can be read, for messages: ".stl, .ply ...".
std::string GetExtensions();
}

#endif
