/**
 * @file   VoxelSurfaceTests.h
 * @brief  What the tests of vtkHybridSurfaceVoxelizer share: checks of its result on a grid. Each
 * prints a line and returns false when it does not hold.
 */
#ifndef VoxelSurfaceTests_h
#define VoxelSurfaceTests_h

#include "VoxelSolidTests.h"

#include <vtkHybridSurfaceVoxelizer.h>

namespace VoxelSurfaceTests
{

vtkSmartPointer<vtkHybridSurfaceVoxelizer> MakeSurfaceVoxelizer(
  vtkPolyData* mesh, vtkImageData* grid, int separability);

/// All backends and strategies give the same voxels, thick and thin; with a cutoff that leaves some
/// triangles on either side, too.
bool CheckStrategies(const std::string& name, vtkPolyData* mesh, vtkImageData* grid);

/// The thick surface against TouchedVoxelsReference, the thin one against ThinVoxelsReference; and
/// CheckStrategies. There have to be voxels unless they are not expected.
bool CheckSurface(
  const std::string& name, vtkPolyData* mesh, vtkImageData* grid, bool expectsVoxels = true);

/// A flood from outside never comes to a voxel whose centre is inside the closed mesh: over faces
/// when the surface is thin, over corners when it is thick.
bool CheckSeparation(const std::string& name, vtkPolyData* mesh, vtkImageData* grid);

/// Parts asked for by update extent equal those of the whole.
bool CheckSurfaceParts(const std::string& name, vtkPolyData* mesh, vtkImageData* grid, int seed);

}

#endif
