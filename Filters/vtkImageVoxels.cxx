// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkImageVoxels.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapImage.h"
#include "vtkSlicemapPacker.h"
#include "vtkVoxelFileError.h"

#include <vector>

vtkImageVoxels::vtkImageVoxels(vtkImageData* image)
  : Slicemap(vtkSlicemap::GetFromImage(image))
  , Scalars(vtkSlicemapImage::GetScalars(image))
  , Grid(vtkVoxelGrid::FromImage(image))
{
  if (this->Slicemap)
  {
    this->Grid = this->Slicemap->GetGrid();
  }
  else if (this->Scalars && this->Scalars != image->GetPointData()->GetScalars())
  {
    this->Grid = this->Grid.CellsToVoxels();
  }
}

void vtkImageVoxels::Check() const
{
  if (this->Grid.IsEmpty() || (!this->Slicemap && !this->Scalars))
  {
    throw vtkVoxelFileError(vtkErrorCode::UserError,
      "The image has no voxels: " + this->Grid.Describe() +
        ". Update its source first, and give it active point or cell scalars.");
  }
  if (!this->Slicemap && this->Scalars->GetNumberOfTuples() != this->Grid.GetNumberOfVoxels())
  {
    throw vtkVoxelFileError(vtkErrorCode::UserError,
      "The scalars of the image have " + std::to_string(this->Scalars->GetNumberOfTuples()) +
        " values, but its " + this->Grid.Describe() + " takes " +
        std::to_string(this->Grid.GetNumberOfVoxels()) + ".");
  }
}

void vtkImageVoxels::Read(const std::function<void(const std::uint32_t* words)>& consume) const
{
  if (!this->Slicemap)
  {
    std::vector<std::uint32_t> words(vtkSlicemap::GetNumberOfWords(this->Grid));
    const glm::ivec3 n = this->Grid.GetDimensions();
    const vtkSlicemapPacker packer(
      this->Scalars, this->Grid, { vtkSlicemapPacker::Criterion::NotZero() });
    packer.Pack(0, std::int64_t(n.y) * n.z, { words.data() });
    consume(words.data());
  }
  else if (!this->Slicemap->Read(consume))
  {
    throw vtkVoxelFileError(vtkErrorCode::UserError, "The voxels could not be read from the GPU.");
  }
}
