// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkDepthView.h
 * Private header: a direction from which depth buffers look at a grid.
 *
 * View coordinates are (u, v, depth): the centre of pixel (0, 0) lies at u = v = 0, and the planes
 * of voxels that a view along an axis looks through lie at depth 0, 1, 2 ... Both buffers of a pair
 * share the pixels: seen from the far side, only depth runs the other way.
 */

#ifndef vtkDepthView_h
#define vtkDepthView_h

#include <glm/glm.hpp>

struct vtkVoxelGrid;

struct vtkDepthView
{
  enum class Side
  {
    Near,
    Far
  };

  /// A pixel for each column of voxels along an index axis.
  static vtkDepthView AlongAxis(const vtkVoxelGrid& grid, int axis);

  /// Looks at all of the grid along a direction in world coordinates, which is not zero. Pixels are
  /// as large as the smallest spacing, and so are the units of depth.
  static vtkDepthView AlongDirection(const vtkVoxelGrid& grid, const glm::dvec3& direction);

  /// Pixels and length of the viewport and of the range of depths: the powers of two from Size on,
  /// so that they scale coordinates exactly.
  glm::ivec3 GetViewport() const;

  /// From world to clip coordinates of OpenGL.
  glm::dmat4 GetWorldToClip(Side side) const;

  bool operator==(const vtkDepthView& other) const
  {
    return this->WorldToView == other.WorldToView && this->Size == other.Size;
  }

  glm::dmat4 WorldToView{ 1.0 };
  glm::ivec3 Size{ 1 };
};

#endif
// VTK-HeaderTest-Exclude: vtkDepthView.h
