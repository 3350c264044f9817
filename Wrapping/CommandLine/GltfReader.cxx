// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GltfReader.h"

#include "vtkGLTFDocumentLoader.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(GltfReader);

int GltfReader::RequestInformation(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  const int result = this->Superclass::RequestInformation(request, input, output);
  if (result != 0)
  {
    const auto model = this->Loader->GetInternalModel();
    model->Images.clear();
    model->Textures.clear();
    model->Animations.clear();
  }
  return result;
}
