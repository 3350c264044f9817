// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelShading.h"

#include "VoxelColors.h"
#include "VoxelSet.h"

#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
/// Evenly spread directions: points of a Fibonacci spiral on the sphere.
std::vector<glm::dvec3> SpreadDirections(int count)
{
  const double turn = vtkMath::Pi() * (3.0 - std::sqrt(5.0));
  std::vector<glm::dvec3> directions;
  for (int i = 0; i < count; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double radius = std::sqrt(1.0 - z * z);
    directions.emplace_back(radius * std::cos(turn * i), radius * std::sin(turn * i), z);
  }
  return directions;
}
}

VoxelScene::VoxelScene(const VoxelSet& voxels, const std::string& attribute)
{
  const auto& dimensions = voxels.GetDimensions();
  const int longest = *std::max_element(dimensions.begin(), dimensions.end());
  const int step = (longest + MaximumDimension - 1) / MaximumDimension;
  std::transform(dimensions.begin(), dimensions.end(), this->Dimensions.begin(),
    [&](int n) { return (n + step - 1) / step; });
  this->Voxels.assign(this->GetOffset(0, 0, this->Dimensions[2]), 0);

  std::optional<VoxelColors> colors;
  if (vtkDataArray* values = voxels.GetAttribute(attribute))
  {
    colors.emplace(voxels, values);
  }
  voxels.ForEach(
    [&](const VoxelSet::Index& voxel, vtkIdType tuple)
    {
      const auto offset = this->GetOffset(voxel[0] / step, voxel[1] / step, voxel[2] / step);
      if (colors && this->Voxels[offset] == 0)
      {
        this->Colors.emplace(offset, colors->Get(tuple));
      }
      this->Voxels[offset] = 1;
    });
  this->SetGeometry(voxels, step);
}

void VoxelScene::SetGeometry(const VoxelSet& voxels, int step)
{
  vtkImageData* grid = voxels.GetGrid();
  std::array<int, 6> extent;
  grid->GetExtent(extent.data());
  const double shift = voxels.AreCells() ? 0.0 : 0.5; // from a voxel's point to its low corner
  grid->TransformContinuousIndexToPhysicalPoint(
    extent[0] - shift, extent[2] - shift, extent[4] - shift, &this->Origin[0]);
  const double* direction = grid->GetDirectionMatrix()->GetData();
  for (const int axis : { 0, 1, 2 })
  {
    this->ToWorldMatrix[axis] = step * grid->GetSpacing()[axis] *
      glm::dvec3(direction[axis], direction[3 + axis], direction[6 + axis]);
  }
  this->FromWorldMatrix = glm::inverse(this->ToWorldMatrix);
}

std::optional<glm::dvec3> VoxelScene::GetColor(int i, int j, int k) const
{
  const auto found = this->Colors.find(this->GetOffset(i, j, k));
  return found == this->Colors.end() ? std::nullopt : std::optional(found->second);
}

bool VoxelScene::IsFree(const glm::dvec3& position, const glm::dvec3& direction) const
{
  // From voxel to voxel, always across the face that the ray reaches first.
  std::array<int, 3> voxel;
  std::array<int, 3> step;
  std::array<double, 3> next;
  std::array<double, 3> pace;
  double entry = 0.0;
  double exit = std::numeric_limits<double>::infinity();
  for (const int axis : { 0, 1, 2 })
  {
    const double speed = direction[axis];
    if (speed == 0.0)
    {
      if (position[axis] < 0.0 || position[axis] > this->Dimensions[axis])
      {
        return true;
      }
      continue;
    }
    const double low = -position[axis] / speed;
    const double high = (this->Dimensions[axis] - position[axis]) / speed;
    entry = std::max(entry, std::min(low, high));
    exit = std::min(exit, std::max(low, high));
  }
  if (!(entry < exit))
  {
    return true;
  }
  for (const int axis : { 0, 1, 2 })
  {
    const double speed = direction[axis];
    const double start = position[axis] + entry * speed;
    voxel[axis] = std::clamp(static_cast<int>(std::floor(start)), 0, this->Dimensions[axis] - 1);
    step[axis] = speed > 0.0 ? 1 : -1;
    pace[axis] = speed == 0.0 ? exit : 1.0 / std::abs(speed);
    next[axis] =
      speed == 0.0 ? 2.0 * exit : (voxel[axis] + (speed > 0.0 ? 1 : 0) - position[axis]) / speed;
  }
  while (true)
  {
    if (this->Voxels[this->GetOffset(voxel[0], voxel[1], voxel[2])] != 0)
    {
      return false;
    }
    const auto axis = std::min_element(next.begin(), next.end()) - next.begin();
    voxel[axis] += step[axis];
    next[axis] += pace[axis];
    if (voxel[axis] < 0 || voxel[axis] >= this->Dimensions[axis])
    {
      return true;
    }
  }
}

VoxelLighting::VoxelLighting(const VoxelScene& scene, const glm::dvec3& up, const glm::dvec3& sun)
  : Scene(scene)
  , Up(up)
  , Sphere(SpreadDirections(256))
{
  constexpr double radiusOfSun = 0.06;
  const auto disk = SpreadDirections(24);
  std::transform(disk.begin(), disk.end(), std::back_inserter(this->Suns),
    [&](const glm::dvec3& offset) { return glm::normalize(sun + offset * radiusOfSun); });
}

VoxelLighting::Light VoxelLighting::GetLight(
  const glm::dvec3& position, const glm::dvec3& normal) const
{
  // The sky is brightest overhead; what comes from below is the light that the floor throws back.
  constexpr double horizon = 0.35;
  double open = 0.0;
  double all = 0.0;
  for (const glm::dvec3& direction : this->Sphere)
  {
    const double cosine = glm::dot(direction, normal);
    if (cosine <= 0.0)
    {
      continue;
    }
    const double weight =
      cosine * (horizon + (1.0 - horizon) * 0.5 * (1.0 + glm::dot(direction, this->Up)));
    all += cosine;
    if (this->Scene.IsFree(position, this->Scene.DirectionFromWorld(direction)))
    {
      open += weight;
    }
  }
  double sun = 0.0;
  for (const glm::dvec3& direction : this->Suns)
  {
    const double cosine = glm::dot(direction, normal);
    if (cosine > 0.0 && this->Scene.IsFree(position, this->Scene.DirectionFromWorld(direction)))
    {
      sun += cosine;
    }
  }
  return { open / all, sun / static_cast<double>(this->Suns.size()) };
}
