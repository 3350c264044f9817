// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file TextureCoordinates.h
 * Brings what VTK's readers make of texture coordinates into one form: one array, a tuple a point,
 * with the origin at the lower left of the image.
 */

#ifndef TextureCoordinates_h
#define TextureCoordinates_h

class vtkPolyData;

namespace TextureCoordinates
{
/**
 * For OBJ files: VTK makes an array for each material, in which points without that material have
 * (-1, -1), and leaves coordinates that no face refers to at the end of the arrays.
 */
void Join(vtkPolyData* mesh);

/// For glTF files, whose origin is at the upper left.
void Flip(vtkPolyData* mesh);
}

#endif
