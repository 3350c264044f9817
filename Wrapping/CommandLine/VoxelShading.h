// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VoxelShading.h
 * How much light of the sky and of the sun falls on voxels and on the floor under them.
 */

#ifndef VoxelShading_h
#define VoxelShading_h

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

class VoxelSet;

/**
 * Set voxels, for pictures: at most 400 along a side, larger grids being
 * made coarser. Positions are in voxels; voxel (i, j, k) fills the cube from (i, j, k) to
 * (i + 1, j + 1, k + 1).
 */
class VoxelScene
{
public:
  /// Voxels have the colours of the attribute, if there is one of this name.
  VoxelScene(const VoxelSet& voxels, const std::string& attribute);

  bool IsSet(int i, int j, int k) const
  {
    return i >= 0 && j >= 0 && k >= 0 && i < this->Dimensions[0] && j < this->Dimensions[1] &&
      k < this->Dimensions[2] && this->Voxels[this->GetOffset(i, j, k)] != 0;
  }

  /// Linear red, green and blue of a set voxel, if it has any.
  std::optional<glm::dvec3> GetColor(int i, int j, int k) const;

  const std::array<int, 3>& GetDimensions() const { return this->Dimensions; }

  ///@{
  /**
   * Between positions in voxels and in the world; directions lose the translation.
   */
  glm::dvec3 ToWorld(const glm::dvec3& position) const
  {
    return this->Origin + this->DirectionToWorld(position);
  }
  glm::dvec3 DirectionToWorld(const glm::dvec3& direction) const
  {
    return this->ToWorldMatrix * direction;
  }
  glm::dvec3 FromWorld(const glm::dvec3& point) const
  {
    return this->DirectionFromWorld(point - this->Origin);
  }
  glm::dvec3 DirectionFromWorld(const glm::dvec3& direction) const
  {
    return this->FromWorldMatrix * direction;
  }
  ///@}

  /// Whether a ray gets out of the scene without hitting a voxel.
  bool IsFree(const glm::dvec3& position, const glm::dvec3& direction) const;

private:
  static constexpr int MaximumDimension = 400;

  std::size_t GetOffset(int i, int j, int k) const
  {
    return (static_cast<std::size_t>(k) * this->Dimensions[1] + j) * this->Dimensions[0] + i;
  }

  void SetGeometry(const VoxelSet& voxels, int step);

  std::array<int, 3> Dimensions{};
  std::vector<unsigned char> Voxels;
  std::unordered_map<std::size_t, glm::dvec3> Colors; // by offset
  glm::dvec3 Origin{ 0.0 };        // world position of the first voxel's low corner
  glm::dmat3 ToWorldMatrix{ 1.0 }; // its columns are the edges of a voxel
  glm::dmat3 FromWorldMatrix{ 1.0 };
};

/**
 * The lights of a scene; all directions are those of the world.
 */
class VoxelLighting
{
public:
  VoxelLighting(const VoxelScene& scene, const glm::dvec3& up, const glm::dvec3& sun);

  struct Light
  {
    double Sky; // 0 in a closed hole, 1 on an open plain
    double Sun; // 0 in shadow, 1 when the sun stands above the surface
  };

  /// The light on a surface at a position in voxels, with a normal in the world.
  Light GetLight(const glm::dvec3& position, const glm::dvec3& normal) const;

private:
  const VoxelScene& Scene;
  glm::dvec3 Up;
  std::vector<glm::dvec3> Sphere;
  std::vector<glm::dvec3> Suns;
};

#endif
