// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRasterMeshBinding.h"

#include "vtkVoxelGrid.h"
#include "vtkVoxelMesh.h"

#include <algorithm>
#include <string>

namespace
{
// The anchor is a voxel at a multiple of this.
constexpr int AnchorStep = 4096;

glm::ivec3 GetAnchor(const vtkVoxelGrid& grid)
{
  glm::ivec3 anchor = grid.GetFirst();
  for (int axis = 0; axis < 3; ++axis)
  {
    const int remainder = (anchor[axis] % AnchorStep + AnchorStep) % AnchorStep;
    anchor[axis] -= remainder;
  }
  return anchor;
}

/// GCC 12 leaves the rounding out where it makes one vector of several numbers that go to float and
/// back.
float GetRounded(double x)
{
  volatile float rounded = static_cast<float>(x);
  return rounded;
}
}

vtkRasterMeshBinding::vtkRasterMeshBinding(
  const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, const vtkColumnAxes& axes)
  : Mesh(mesh)
{
  const glm::ivec3 anchor = GetAnchor(grid);
  this->FirstVoxel = axes(grid.GetFirst() - anchor);
  this->Anchor = glm::dvec3(grid.GetIndexToWorld() * glm::dvec4(glm::dvec3(anchor), 1.0));
  const glm::dmat4 indexFromWorld = grid.GetWorldToIndex();
  const int order[3] = { axes.U, axes.V, axes.Depth };
  for (int i = 0; i < 3; ++i)
  {
    this->VoxelsFromWorld[i] = glm::dvec3(
      indexFromWorld[0][order[i]], indexFromWorld[1][order[i]], indexFromWorld[2][order[i]]);
  }
}

void vtkRasterMeshBinding::Bind(vtkVoxelGL::Program& program, unsigned int unit) const
{
  this->Mesh.Bind(program, unit);
  std::array<float, 3> high;
  std::array<float, 3> low;
  for (int axis = 0; axis < 3; ++axis)
  {
    high[axis] = GetRounded(this->Anchor[axis]);
    low[axis] = static_cast<float>(this->Anchor[axis] - high[axis]);
  }
  program.Set("AnchorHigh", high);
  program.Set("AnchorLow", low);
  for (int i = 0; i < 3; ++i)
  {
    const glm::vec3 row(this->VoxelsFromWorld[i]);
    const std::string name = "VoxelsFromWorld[" + std::to_string(i) + "]";
    program.Set(name.c_str(), std::array<float, 3>{ row.x, row.y, row.z });
  }
}

glm::vec3 vtkRasterMeshBinding::GetVoxels(const glm::dvec3& world) const
{
  glm::vec3 voxels;
  for (int i = 0; i < 3; ++i)
  {
    voxels[i] = static_cast<float>(glm::dot(this->VoxelsFromWorld[i], world - this->Anchor));
  }
  return voxels;
}

double vtkRasterMeshBinding::GetLargestTerms() const
{
  const glm::dvec3 reach = glm::dvec3(this->Mesh.GetLargestCoordinate()) + glm::abs(this->Anchor);
  double largest = 0.0;
  for (const glm::dvec3& row : this->VoxelsFromWorld)
  {
    largest = std::max(largest, glm::dot(glm::abs(row), reach));
  }
  return largest;
}
