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

/// The values as floats, and what the rounding took away.
template <std::size_t N>
std::array<std::array<float, N>, 2> SplitToFloats(const double* values)
{
  std::array<std::array<float, N>, 2> parts;
  for (std::size_t i = 0; i < N; ++i)
  {
    parts[0][i] = GetRounded(values[i]);
    parts[1][i] = static_cast<float>(values[i] - parts[0][i]);
  }
  return parts;
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
    this->Offsets[i] = indexFromWorld[3][order[i]] - anchor[order[i]];
  }
}

void vtkRasterMeshBinding::Bind(vtkVoxelGL::Program& program, unsigned int unit) const
{
  this->Mesh.Bind(program, unit);
  const auto [high, low] = SplitToFloats<3>(&this->Anchor[0]);
  program.Set("AnchorHigh", high);
  program.Set("AnchorLow", low);
  for (int i = 0; i < 3; ++i)
  {
    const glm::vec3 row(this->VoxelsFromWorld[i]);
    const std::string name = "VoxelsFromWorld[" + std::to_string(i) + "]";
    program.Set(name.c_str(), std::array<float, 3>{ row.x, row.y, row.z });
  }
}

void vtkRasterMeshBinding::BindPairs(vtkVoxelGL::Program& program) const
{
  for (int i = 0; i < 3; ++i)
  {
    const glm::dvec4 row(this->VoxelsFromWorld[i], this->Offsets[i]);
    const auto [high, low] = SplitToFloats<4>(&row[0]);
    const std::string index = "[" + std::to_string(i) + "]";
    program.Set(("RelativeFromWorld" + index).c_str(), high);
    program.Set(("RelativeFromWorldLow" + index).c_str(), low);
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
