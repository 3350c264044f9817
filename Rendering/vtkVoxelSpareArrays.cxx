// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelSpareArrays.h"

#include "vtkCellData.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

void vtkVoxelSpareArrays::Own(vtkDataArray* array)
{
  const auto isGone = [](const vtkWeakPointer<vtkDataArray>& owned) { return !owned; };
  this->Owned.erase(
    std::remove_if(this->Owned.begin(), this->Owned.end(), isGone), this->Owned.end());
  this->Owned.emplace_back(array);
}

void vtkVoxelSpareArrays::Keep(vtkImageData* output)
{
  const auto isOwned = [this](vtkDataArray* array)
  {
    return std::any_of(this->Owned.begin(), this->Owned.end(),
      [array](const vtkWeakPointer<vtkDataArray>& owned) { return owned == array; });
  };
  for (vtkDataSetAttributes* attributes :
    { static_cast<vtkDataSetAttributes*>(output->GetPointData()),
      static_cast<vtkDataSetAttributes*>(output->GetCellData()) })
  {
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = attributes->GetArray(i);
      if (array && isOwned(array))
      {
        this->Kept.emplace_back(array);
      }
    }
  }
}
