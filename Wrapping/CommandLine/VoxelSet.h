// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VoxelSet.h
 * The set voxels of what a voxelizer made, one after the other.
 */

#ifndef VoxelSet_h
#define VoxelSet_h

#include "vtkBitArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <array>
#include <string>

class vtkFieldData;
class vtkPolyData;

class VoxelSet
{
public:
  using Index = std::array<int, 3>;

  /// Of an image, whose scalars tell which of its points or cells are set.
  explicit VoxelSet(vtkImageData* image);

  /// Of a list of voxels on the grid of an image, whose points they are.
  VoxelSet(vtkPolyData* list, vtkImageData* grid);

  vtkImageData* GetGrid() const { return this->Grid; }

  bool AreCells() const { return this->Cells; }

  /// Numbers of voxels of the grid along each axis.
  const Index& GetDimensions() const { return this->Dimensions; }

  /// An attribute of the voxels; null when there is none of this name.
  vtkDataArray* GetAttribute(const std::string& name) const;

  /// Calls the function with the index of each set voxel, counted from the first one of the grid,
  /// and the number of its tuple in the attributes.
  template <typename Function>
  void ForEach(const Function& function) const
  {
    if (this->Listed)
    {
      this->ForEachListed(function);
    }
    else if (auto* bits = vtkArrayDownCast<vtkBitArray>(this->Scalars))
    {
      this->ForEachNotZero(bits, function);
    }
    else if (auto* bytes = vtkArrayDownCast<vtkUnsignedCharArray>(this->Scalars))
    {
      this->ForEachNotZero(bytes, function);
    }
  }

private:
  template <typename Function>
  void ForEachListed(const Function& function) const
  {
    const int* first = this->Grid->GetExtent();
    for (vtkIdType i = 0; i < this->Listed->GetNumberOfTuples(); ++i)
    {
      Index index;
      this->Listed->GetTypedTuple(i, index.data());
      function(Index{ index[0] - first[0], index[1] - first[2], index[2] - first[4] }, i);
    }
  }

  template <typename Array, typename Function>
  void ForEachNotZero(Array* scalars, const Function& function) const
  {
    const auto& n = this->Dimensions;
    for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
    {
      if (scalars->GetValue(i) != 0)
      {
        function(Index{ static_cast<int>(i % n[0]), static_cast<int>(i / n[0] % n[1]),
                   static_cast<int>(i / n[0] / n[1]) },
          i);
      }
    }
  }

  vtkSmartPointer<vtkImageData> Grid;
  bool Cells = false;
  Index Dimensions{};
  vtkSmartPointer<vtkFieldData> Arrays;
  vtkSmartPointer<vtkIntArray> Listed;   // of lists
  vtkSmartPointer<vtkDataArray> Scalars; // of images
};

#endif
