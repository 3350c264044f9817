// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkImageVoxels.h
 * Private header: the occupied voxels of an image where they are now, in a slicemap or in scalars.
 */

#ifndef vtkImageVoxels_h
#define vtkImageVoxels_h

#include "vtkVoxelGrid.h"

#include <cstdint>
#include <functional>

class vtkDataArray;
class vtkImageData;
class vtkSlicemap;

struct vtkImageVoxels
{
  /**
   * The slicemap of the image, else its active point scalars, else its active cell scalars.
   */
  explicit vtkImageVoxels(vtkImageData* image);

  /**
   * Throws vtkVoxelFileError when there are no voxels, or fewer values than voxels.
   */
  void Check() const;

  /**
   * The words of the slicemap, or of the scalars packed like one, while `consume` runs.
   */
  void Read(const std::function<void(const std::uint32_t* words)>& consume) const;

  vtkSlicemap* Slicemap;
  vtkDataArray* Scalars;
  vtkVoxelGrid Grid;
};

#endif
// VTK-HeaderTest-Exclude: vtkImageVoxels.h
