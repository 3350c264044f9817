/**
 * @file   VoxelFilterTests.h
 * @brief  What the tests of filters on voxels share: awkward grids, and random voxels on them.
 */
#ifndef VoxelFilterTests_h
#define VoxelFilterTests_h

#include "VoxelReference.h"

#include <vtkImageData.h>
#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <functional>
#include <string>
#include <vector>

namespace VoxelFilterTests
{

using Image = vtkSmartPointer<vtkImageData>;

struct NamedGrid
{
  std::string Name;
  Image Grid; ///< without scalars; its points are the voxels
};

/// Sizes that are no multiples of 32, full words, one voxel thin on each axis, extents that don't
/// begin at 0, spacings that differ, oriented and mirrored.
std::vector<NamedGrid> AwkwardGrids();

/// Each voxel is set with the probability.
VoxelReference::Volume RandomVoxels(vtkImageData* grid, unsigned int seed, double density = 0.3);

/// Voxels set where `isSet` says so, which gets the offset of the voxel in the volume.
VoxelReference::Volume MakeVoxels(
  vtkImageData* grid, const std::function<bool(std::size_t offset)>& isSet);

/// An image of the voxels with scalars of any numeric type or VTK_BIT, on its points or on its
/// cells; set voxels have various values.
Image MakeMask(vtkImageData* grid, const VoxelReference::Volume& voxels,
  int scalarType = VTK_UNSIGNED_CHAR, bool cells = false);

}

#endif
