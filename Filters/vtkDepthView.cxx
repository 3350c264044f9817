// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDepthView.h"

#include "vtkSolidPass.h" // for vtkColumnAxes
#include "vtkVoxelGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
int PowerOfTwoFrom(int n)
{
  int power = 1;
  while (power < n)
  {
    power *= 2;
  }
  return power;
}

/// Two unit vectors that are orthogonal to a unit vector and to each other.
glm::dmat3 FrameAround(const glm::dvec3& direction)
{
  const glm::dvec3 size = glm::abs(direction);
  glm::dvec3 other(0.0);
  other[size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2] = 1.0;
  const glm::dvec3 u = glm::normalize(glm::cross(other, direction));
  return { u, glm::cross(direction, u), direction };
}
}

vtkDepthView vtkDepthView::AlongAxis(const vtkVoxelGrid& grid, int axis)
{
  const vtkColumnAxes axes(axis);
  const glm::dmat4 worldToIndex = grid.GetWorldToIndex();
  vtkDepthView view;
  view.Size = axes(grid.GetDimensions());
  for (int column = 0; column < 4; ++column)
  {
    view.WorldToView[column] = glm::dvec4(axes(worldToIndex[column]), column == 3 ? 1.0 : 0.0);
  }
  view.WorldToView[3] -= glm::dvec4(glm::dvec3(axes(grid.GetFirst())), 0.0);
  return view;
}

vtkDepthView vtkDepthView::AlongDirection(const vtkVoxelGrid& grid, const glm::dvec3& direction)
{
  const double pixel = std::min({ grid.Spacing.x, grid.Spacing.y, grid.Spacing.z });
  const glm::dmat3 linear =
    glm::transpose(FrameAround(glm::normalize(direction))) * glm::dmat3(1.0 / pixel);
  const glm::dmat4 indexToWorld = grid.GetIndexToWorld();
  const glm::dvec3 first(grid.GetFirst());
  const glm::dvec3 last = first + glm::dvec3(grid.GetDimensions() - 1);
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(std::numeric_limits<double>::lowest());
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec4 index((corner & 1) != 0 ? last.x + 0.5 : first.x - 0.5,
      (corner & 2) != 0 ? last.y + 0.5 : first.y - 0.5,
      (corner & 4) != 0 ? last.z + 0.5 : first.z - 0.5, 1.0);
    const glm::dvec3 place = linear * glm::dvec3(indexToWorld * index);
    low = glm::min(low, place);
    high = glm::max(high, place);
  }
  vtkDepthView view;
  view.WorldToView = glm::dmat4(linear);
  view.WorldToView[3] = glm::dvec4(-low, 1.0);
  view.Size = glm::ivec3(glm::ceil(high - low)) + 1;
  return view;
}

glm::ivec3 vtkDepthView::GetViewport() const
{
  return { PowerOfTwoFrom(this->Size.x), PowerOfTwoFrom(this->Size.y),
    PowerOfTwoFrom(this->Size.z) };
}

glm::dmat4 vtkDepthView::GetWorldToClip(Side side) const
{
  const glm::dvec3 scale = 2.0 / glm::dvec3(this->GetViewport());
  glm::dmat4 viewToClip(1.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    viewToClip[axis][axis] = scale[axis];
    viewToClip[3][axis] = 0.5 * scale[axis] - 1.0;
  }
  if (side == Side::Far)
  {
    viewToClip[2][2] = -viewToClip[2][2];
    viewToClip[3][2] = -viewToClip[3][2];
  }
  return viewToClip * this->WorldToView;
}
