/**
 * @file   VoxelDepthReference.h
 * @brief  What vtkDepthBufferVoxelizer is to find, from the triangles in double precision.
 *
 * Each column of voxels reaches from its first crossing with a triangle to its last one. Since
 * OpenGL moves vertices by up to 1/256 voxel, columns are sampled at nine places around their
 * centre: voxels that are inside at all of them must be found, those at none must not.
 */
#ifndef VoxelDepthReference_h
#define VoxelDepthReference_h

#include "VoxelReference.h"

#include <array>
#include <string>

class vtkImageData;
class vtkPolyData;

namespace VoxelReference
{

struct DepthVoxels
{
  Volume Sure;  ///< inside whatever the rounding
  Volume Maybe; ///< inside for some rounding
};

/// The voxels that lie between the first and the last triangle along all of the axes.
DepthVoxels DepthReference(
  vtkPolyData* mesh, const Grid& grid, const std::array<bool, 3>& axes = { true, true, true });

/// True when the image holds all sure voxels and none but those that may be. Otherwise prints one
/// line that starts with `name`. No more than `allowed`, of the voxels that may be, may be unsure,
/// so that the check means something.
bool ReportDepth(const std::string& name, vtkImageData* result, const DepthVoxels& expected,
  double allowed = 0.05);

}

#endif
