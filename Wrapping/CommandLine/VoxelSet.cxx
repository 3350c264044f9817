// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelSet.h"

#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>

VoxelSet::VoxelSet(vtkImageData* image)
  : Grid(image)
  , Cells(image->GetPointData()->GetScalars() == nullptr)
{
  vtkDataSetAttributes* attributes = image->GetPointData();
  if (this->Cells)
  {
    attributes = image->GetCellData();
  }
  this->Arrays = attributes;
  this->Scalars = attributes->GetScalars();
  image->GetDimensions(this->Dimensions.data());
  for (int& n : this->Dimensions)
  {
    n = std::max(1, this->Cells ? n - 1 : n);
  }
}

VoxelSet::VoxelSet(vtkPolyData* list, vtkImageData* grid)
  : Grid(grid)
  , Arrays(list->GetPointData())
  , Listed(vtkIntArray::SafeDownCast(list->GetPointData()->GetArray("VoxelIndex")))
{
  grid->GetDimensions(this->Dimensions.data());
}

vtkDataArray* VoxelSet::GetAttribute(const std::string& name) const
{
  return this->Arrays->GetArray(name.c_str());
}
