// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkDensityPass.h
 * Private header: how many voxels of a slicemap are set in boxes of 2^n voxels, 128 boxes at a
 * time.
 *
 * Counts are spread over planes of bits: bit b of plane p of a quad (four words) is worth 2^p in
 * the count of voxel b of that quad. So an addition of 128 numbers is a few logical operations for
 * each of their bits. Boxes are done axis by axis, and slab by slab of the result. Along y and z,
 * moving sums follow from one another where there are compute shaders, so that they cost the same
 * whatever their size; others are made of up to eight voxels at a time.
 */

#ifndef vtkDensityPass_h
#define vtkDensityPass_h

#include "vtkVoxelGLObjects.h"

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

class vtkSlicemap;

class vtkDensityPass
{
public:
  static constexpr int LargestKernel = 32; ///< voxels along one axis

  /// `kernel` has powers of two. The boxes are those of a grid as many times as coarse when
  /// `downsampled`; otherwise there is one for each voxel, which begins kernel / 2 before it.
  vtkDensityPass(vtkVoxelGL::Context context, const glm::ivec3& kernel, bool downsampled);

  /// Bits of the largest count.
  int GetNumberOfPlanes() const;

  /// Voxels of the result for so many of the source. Beyond the source they are empty.
  glm::ivec3 GetResultSize(const glm::ivec3& sourceSize) const;

  /// A slab of the result. Voxel x of a row has its bit p in bit x % 32 of the word
  /// ((row * quadsPerRow + x / 128) * planes + p) * 4 + x / 32 % 4, where quadsPerRow counts the
  /// begun quads of 128 voxels; bits beyond the row are undefined.
  struct Slab
  {
    int FirstSlice;
    int NumberOfSlices;
    const std::uint32_t* Words;
  };

  /// False stops the work.
  using Consume = std::function<bool(const Slab&)>;

  /// Reads the counts of all boxes back, slab by slab from the first slice to the last. Returns
  /// whether all was consumed; throws std::runtime_error when there is no memory.
  bool Run(vtkSlicemap* source, const Consume& consume) const;

private:
  struct Step;
  bool UsesRuns() const;
  std::vector<Step> GetSteps(const glm::ivec3& sourceSize, int firstSlice, int slices) const;
  void RunStep(
    const Step& step, const vtkVoxelGL::Texture& source, vtkVoxelGL::Buffer& target) const;

  vtkVoxelGL::Context Context;
  glm::ivec3 Kernel;
  bool Downsampled;
};

#endif
// VTK-HeaderTest-Exclude: vtkDensityPass.h
