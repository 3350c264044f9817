// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file GltfReader.h
 * VTK's reader of glTF, without what has no shape.
 */

#ifndef GltfReader_h
#define GltfReader_h

#include "vtkGLTFReader.h"

/**
 * Leaves images, textures and animations out: they do not matter to voxels, images may be lost, and
 * VTK does not survive all damage in them.
 */
class GltfReader : public vtkGLTFReader
{
public:
  static GltfReader* New();
  vtkTypeMacro(GltfReader, vtkGLTFReader);

protected:
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
};

#endif
