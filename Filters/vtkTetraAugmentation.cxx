// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetraAugmentation.h"

#include "vtkCounterRandom.h"
#include "vtkTetraModel.h"
#include "vtkVoxelGrid.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace
{
// What random numbers are for; never change these, or variants change.
constexpr std::uint32_t RotationStream = 0;
constexpr std::uint32_t ScaleStream = 1;
constexpr std::uint32_t OffsetStream = 2;
constexpr std::uint32_t DisplacementStream = 3;

/// A point in the unit disk without its middle, and the square of its distance from there.
struct PointInDisk
{
  explicit PointInDisk(vtkCounterRandom& random)
  {
    do
    {
      this->X = random.NextSigned();
      this->Y = random.NextSigned();
      this->Square = this->X * this->X + this->Y * this->Y;
    } while (this->Square >= 1.0 || this->Square == 0.0);
  }

  double X;
  double Y;
  double Square;
};

/// Marsaglia: Choosing a Point from the Surface of a Sphere. Annals of Mathematical Statistics
/// 1972.
glm::dmat3 MakeUniformRotation(vtkCounterRandom& random)
{
  const PointInDisk a(random);
  const PointInDisk b(random);
  const double stretch = std::sqrt((1.0 - a.Square) / b.Square);
  return glm::mat3_cast(glm::normalize(glm::dquat(a.X, a.Y, b.X * stretch, b.Y * stretch)));
}

glm::dmat3 MakeRotationAbout(const glm::dvec3& axis, vtkCounterRandom& random)
{
  const PointInDisk direction(random);
  const double length = std::sqrt(direction.Square);
  const double cosine = direction.X / length;
  const double sine = direction.Y / length;
  const glm::dvec3 n = axis / std::sqrt(glm::dot(axis, axis));
  const glm::dmat3 cross(0.0, n.z, -n.y, -n.z, 0.0, n.x, n.y, -n.x, 0.0);
  return cosine * glm::dmat3(1.0) + sine * cross + (1.0 - cosine) * glm::outerProduct(n, n);
}
}

vtkTetraAugmentation::Variant vtkTetraAugmentation::GetVariant(std::uint64_t number) const
{
  Variant variant{ this->FixedRotation, glm::dvec3(this->ScaleRange[0]), 0 };
  vtkCounterRandom rotations(this->Seed, number, RotationStream);
  if (this->Rotation == Rotations::Uniform)
  {
    variant.Rotation = MakeUniformRotation(rotations);
  }
  else if (this->Rotation == Rotations::Axis)
  {
    variant.Rotation = MakeRotationAbout(this->Axis, rotations);
  }
  vtkCounterRandom scales(this->Seed, number, ScaleStream);
  for (int axis = 0; axis < 3; ++axis)
  {
    variant.Scale[axis] += scales.NextUniform() * (this->ScaleRange[1] - this->ScaleRange[0]);
  }
  variant.FirstDisplacement =
    vtkCounterRandom(this->Seed, number, OffsetStream).Next() % NumberOfDisplacements;
  return variant;
}

std::vector<glm::vec3> vtkTetraAugmentation::MakeDisplacements() const
{
  vtkCounterRandom random(this->Seed, 0, DisplacementStream);
  const bool normal = this->Displacements == Distribution::Normal;
  std::vector<glm::vec3> ring(NumberOfDisplacements);
  for (glm::vec3& vector : ring)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double number = normal ? random.NextNormal() : random.NextSigned();
      vector[axis] = static_cast<float>(number);
    }
  }
  return ring;
}

glm::dmat4 vtkTetraAugmentation::GetTransform(const Variant& variant, const vtkTetraFrame& frame,
  double largestDisplacement, const vtkVoxelGrid* fitted)
{
  const glm::dvec3& scale = variant.Scale;
  double size = 1.0;
  glm::dvec3 target = frame.Center;
  if (fitted)
  {
    const glm::dvec3 n(fitted->GetDimensions());
    const glm::dvec3 middle = glm::dvec3(fitted->GetFirst()) + 0.5 * (n - 1.0);
    target = glm::dvec3(fitted->GetIndexToWorld() * glm::dvec4(middle, 1.0));

    // The ball in the grid, and one around the scaled model.
    const glm::dvec3 sides = n * fitted->Spacing;
    const double room = 0.5 * std::min({ sides.x, sides.y, sides.z });
    const double largestScale = std::max({ scale.x, scale.y, scale.z });
    const double radius =
      std::min(largestScale * frame.Radius, glm::length(scale * frame.HalfSize));
    const double reach = radius + largestScale * largestDisplacement;
    size = reach > 0.0 ? room / reach : 1.0;
  }
  const glm::dmat3 linear =
    size * variant.Rotation * glm::dmat3(scale.x, 0.0, 0.0, 0.0, scale.y, 0.0, 0.0, 0.0, scale.z);
  glm::dmat4 transform(linear);
  transform[3] = glm::dvec4(target - linear * frame.Center, 1.0);
  return transform;
}
