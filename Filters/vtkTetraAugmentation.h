// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkTetraAugmentation.h
 * Private header: the random variants of a model, by a seed and their number.
 *
 * Nothing here depends on the machine: numbers come from vtkCounterRandom, and what is done with
 * them is sums, products, quotients and square roots in double precision, which IEEE 754 fixes to
 * the last bit. The source file is compiled without fused multiplications for the same reason.
 */

#ifndef vtkTetraAugmentation_h
#define vtkTetraAugmentation_h

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

struct vtkTetraFrame;
struct vtkVoxelGrid;

struct vtkTetraAugmentation
{
  enum class Rotations
  {
    Fixed,
    Uniform, ///< over all rotations
    Axis     ///< by any angle about Axis
  };

  enum class Distribution
  {
    Uniform,
    Normal
  };

  /// Vectors in the ring of displacements.
  static constexpr std::uint32_t NumberOfDisplacements = 65536;

  std::uint64_t Seed = 0;
  Rotations Rotation = Rotations::Fixed;
  glm::dmat3 FixedRotation{ 1.0 };
  glm::dvec3 Axis{ 0.0, 0.0, 1.0 };
  std::array<double, 2> ScaleRange{ 1.0, 1.0 };
  Distribution Displacements = Distribution::Uniform;
  float Amplitude = 0.0f; ///< of displacements, in world units

  struct Variant
  {
    glm::dmat3 Rotation; ///< after the scale
    glm::dvec3 Scale;
    std::uint32_t FirstDisplacement;
  };

  Variant GetVariant(std::uint64_t number) const;

  /// The ring of displacements in units of the amplitude. Their components have the given
  /// distribution: up to 1 to both sides, or with a standard deviation of 1.
  std::vector<glm::vec3> MakeDisplacements() const;

  /// Where a variant of a model goes: about its centre and, where there is a grid, moved to the
  /// middle of the grid and scaled so that it stays within however it is turned.
  static glm::dmat4 GetTransform(const Variant& variant, const vtkTetraFrame& frame,
    double largestDisplacement, const vtkVoxelGrid* fitted);
};

#endif
// VTK-HeaderTest-Exclude: vtkTetraAugmentation.h
