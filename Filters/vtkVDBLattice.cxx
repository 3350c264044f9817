// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVDBLattice.h"

#include "vtkVoxelFileError.h"

#include <openvdb/math/Transform.h>

#include <cmath>

namespace
{
constexpr char FirstName[] = "vtk_extent_min";
constexpr char LastName[] = "vtk_extent_max";

/// Cosines of axes at right angles, which files may hold in single precision.
constexpr double AngleTolerance = 1e-5;

/// The columns of the matrix from indices to the world.
glm::dmat3 GetAxes(const vtkVoxelGrid& lattice)
{
  return glm::dmat3(lattice.GetIndexToWorld());
}

bool IsRectangular(const glm::dmat3& axes)
{
  for (int i = 0; i < 3; ++i)
  {
    const glm::dvec3 a = axes[i];
    const glm::dvec3 b = axes[(i + 1) % 3];
    const double lengths = glm::length(a) * glm::length(b);
    if (!std::isfinite(lengths) || lengths <= 0.0 ||
      std::abs(glm::dot(a, b)) > AngleTolerance * lengths)
    {
      return false;
    }
  }
  return true;
}

/// The simplest there is for it: some tools know no more. Without a direction it is exact.
openvdb::math::Transform::Ptr MakeTransform(const vtkVoxelGrid& lattice)
{
  if (lattice.Direction == glm::dmat3(1.0))
  {
    const auto transform = openvdb::math::Transform::createLinearTransform();
    transform->preScale(openvdb::Vec3d(lattice.Spacing.x, lattice.Spacing.y, lattice.Spacing.z));
    transform->postTranslate(openvdb::Vec3d(lattice.Origin.x, lattice.Origin.y, lattice.Origin.z));
    return transform;
  }
  const glm::dmat4 matrix = lattice.GetIndexToWorld();
  openvdb::Mat4d rows; // vectors are rows there
  for (int i = 0; i < 4; ++i)
  {
    for (int j = 0; j < 4; ++j)
    {
      rows[i][j] = matrix[i][j];
    }
  }
  return openvdb::math::Transform::createLinearTransform(rows);
}

bool GetExtent(const openvdb::GridBase& grid, const std::string& firstName,
  const std::string& lastName, std::array<int, 6>& extent)
{
  const auto first = grid.getMetadata<openvdb::Vec3IMetadata>(firstName);
  const auto last = grid.getMetadata<openvdb::Vec3IMetadata>(lastName);
  if (!first || !last)
  {
    return false;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    extent[2 * axis] = first->value()[axis];
    extent[2 * axis + 1] = last->value()[axis];
  }
  return extent[0] <= extent[1] && extent[2] <= extent[3] && extent[4] <= extent[5];
}
}

void vtkVDBLattice::Check(const vtkVoxelGrid& lattice)
{
  if (!IsRectangular(GetAxes(lattice)))
  {
    throw vtkVoxelFileError(vtkErrorCode::UserError,
      "The axes of the image are not at right angles, or its spacing is zero: " +
        lattice.Describe() + ". Resample it.");
  }
}

void vtkVDBLattice::ApplyTo(const vtkVoxelGrid& lattice, openvdb::GridBase& grid)
{
  Check(lattice);
  grid.setTransform(MakeTransform(lattice));
  const auto& extent = lattice.Extent;
  grid.insertMeta(
    FirstName, openvdb::Vec3IMetadata(openvdb::Vec3i(extent[0], extent[2], extent[4])));
  grid.insertMeta(
    LastName, openvdb::Vec3IMetadata(openvdb::Vec3i(extent[1], extent[3], extent[5])));
}

vtkVoxelGrid vtkVDBLattice::From(const openvdb::GridBase& grid)
{
  const std::string name = "The grid \"" + grid.getName() + "\"";
  if (!grid.transform().isLinear())
  {
    throw vtkVoxelFileError(vtkErrorCode::FileFormatError,
      name + " has a transform of type " + grid.transform().mapType() +
        ", whose voxels are no boxes. Resample it with the tool that made it.");
  }
  const openvdb::Mat4d matrix = grid.transform().baseMap()->getAffineMap()->getMat4();
  glm::dmat3 axes;
  vtkVoxelGrid lattice;
  for (int i = 0; i < 3; ++i)
  {
    axes[i] = glm::dvec3(matrix[i][0], matrix[i][1], matrix[i][2]);
    lattice.Origin[i] = matrix[3][i];
  }
  const glm::dvec3 origin = lattice.Origin;
  if (!IsRectangular(axes) || !std::isfinite(origin.x + origin.y + origin.z))
  {
    throw vtkVoxelFileError(vtkErrorCode::FileFormatError,
      name +
        " has a sheared or damaged transform, whose voxels are no boxes. Resample it with the "
        "tool that made it.");
  }
  for (int i = 0; i < 3; ++i)
  {
    // Exactly where only one number is not zero, as along the axes.
    lattice.Spacing[i] = std::hypot(axes[i].x, axes[i].y, axes[i].z);
    lattice.Direction[i] = axes[i] / lattice.Spacing[i];
  }
  return lattice;
}

bool vtkVDBLattice::GetStoredExtent(const openvdb::GridBase& grid, std::array<int, 6>& extent)
{
  return GetExtent(grid, FirstName, LastName, extent) ||
    GetExtent(
      grid, openvdb::GridBase::META_FILE_BBOX_MIN, openvdb::GridBase::META_FILE_BBOX_MAX, extent);
}

std::array<int, 6> vtkVDBLattice::GetActiveExtent(const openvdb::GridBase& grid)
{
  const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  return { box.min().x(), box.max().x(), box.min().y(), box.max().y(), box.min().z(),
    box.max().z() };
}

openvdb::CoordBBox vtkVDBLattice::ToBox(const std::array<int, 6>& extent)
{
  return { openvdb::Coord(extent[0], extent[2], extent[4]),
    openvdb::Coord(extent[1], extent[3], extent[5]) };
}
