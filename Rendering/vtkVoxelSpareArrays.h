// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelSpareArrays.h
 * Private header: the arrays of an output that is about to be made again. The next ones may have
 * their memory, when nobody else holds them: to fill pages that are there costs a fraction of what
 * fresh ones do.
 */

#ifndef vtkVoxelSpareArrays_h
#define vtkVoxelSpareArrays_h

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <cstdint>
#include <vector>

class vtkImageData;

class vtkVoxelSpareArrays
{
public:
  /// Says that an array is this filter's, not one that somebody put into its output.
  void Own(vtkDataArray* array);

  /// Keeps the own arrays at the points and cells of an output.
  void Keep(vtkImageData* output);

  /// Lets go of all.
  void Clear() { this->Kept.clear(); }

  /**
   * An array of this class and size that nobody else holds. Null when there is none; then all are
   * let go, to make room for a new one.
   */
  template <typename Array>
  vtkSmartPointer<Array> Take(std::int64_t tuples, int components)
  {
    const auto fits = [&](const vtkSmartPointer<vtkDataArray>& kept)
    {
      return Array::SafeDownCast(kept) && kept->GetReferenceCount() == 1 &&
        kept->GetNumberOfTuples() == tuples && kept->GetNumberOfComponents() == components;
    };
    const auto found = std::find_if(this->Kept.begin(), this->Kept.end(), fits);
    if (found == this->Kept.end())
    {
      this->Clear();
      return nullptr;
    }
    const vtkSmartPointer<Array> array = Array::SafeDownCast(*found);
    this->Kept.erase(found);
    return array;
  }

private:
  std::vector<vtkWeakPointer<vtkDataArray>> Owned;
  std::vector<vtkSmartPointer<vtkDataArray>> Kept;
};

#endif
// VTK-HeaderTest-Exclude: vtkVoxelSpareArrays.h
