// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelGrid.h
 * @brief The one description of a voxel grid: extent, spacing, origin and direction.
 *
 * Voxel (i, j, k) of the extent is the box of size Spacing centred at the image point (i, j, k); in
 * index coordinates it is the unit cube around that integer point. The value type is private to the
 * module's C++ code; scripts see the same fields on vtkSlicemap, vtkVoxelizer and vtkImageData.
 */

#ifndef vtkVoxelGrid_h
#define vtkVoxelGrid_h

#include "vtkVoxelizationModule.h" // for export macro

#include <array>   // for extents
#include <cstdint> // for 64-bit sizes
#include <glm/glm.hpp>
#include <string> // for Describe

class vtkFieldData;
class vtkImageData;
class vtkInformation;

struct VTKVOXELIZATION_EXPORT vtkVoxelGrid
{
  std::array<int, 6> Extent{ 0, -1, 0, -1, 0, -1 };
  glm::dvec3 Spacing{ 1.0 };
  glm::dvec3 Origin{ 0.0 };
  glm::dmat3 Direction{ 1.0 };

  static vtkVoxelGrid FromImage(vtkImageData* image);

  /// Gives the image this grid's geometry; its scalars are left alone.
  void ApplyTo(vtkImageData* image) const;

  ///@{
  /// The same for the whole extent and the geometry that a pipeline announces.
  static vtkVoxelGrid FromInformation(vtkInformation* info);
  void ApplyTo(vtkInformation* info) const;
  ///@}

  ///@{
  /// The same for data that are no image, as arrays "VoxelExtent", "VoxelSpacing", "VoxelOrigin"
  /// and "VoxelDirection" of field data. Without them the grid is empty.
  static vtkVoxelGrid FromFieldData(vtkFieldData* fields);
  void ApplyTo(vtkFieldData* fields) const;
  ///@}

  glm::ivec3 GetFirst() const { return { this->Extent[0], this->Extent[2], this->Extent[4] }; }
  glm::ivec3 GetDimensions() const
  {
    return glm::ivec3(this->Extent[1], this->Extent[3], this->Extent[5]) - this->GetFirst() + 1;
  }
  bool IsEmpty() const { return glm::any(glm::lessThan(this->GetDimensions(), glm::ivec3(1))); }
  std::int64_t GetNumberOfVoxels() const;

  /// The same lattice, restricted to another extent.
  vtkVoxelGrid WithExtent(const std::array<int, 6>& extent) const;

  /// So many slices of constant z, or as many as there are, from slice `first` on, counted from 0.
  vtkVoxelGrid WithSlices(int first, int count) const;

  /// Whether the spacing is the same on all axes, up to a millionth.
  bool HasCubicVoxels() const;

  ///@{
  /// An image with a voxel in each cell has one point more on each axis, half a voxel off.
  vtkVoxelGrid VoxelsToCells() const;
  vtkVoxelGrid CellsToVoxels() const;
  ///@}

  ///@{
  /// From index to world coordinates and back.
  glm::dmat4 GetIndexToWorld() const;
  glm::dmat4 GetWorldToIndex() const;
  ///@}

  ///@{
  /// The direction matrix row by row, as VTK has it; GLM stores columns.
  std::array<double, 9> GetDirectionRows() const;
  void SetDirectionRows(const double rows[9]);
  ///@}

  /// World volume of one voxel.
  double GetVoxelVolume() const;

  /// True when all numbers are equal.
  bool operator==(const vtkVoxelGrid& other) const
  {
    return this->Extent == other.Extent && this->Spacing == other.Spacing &&
      this->Origin == other.Origin && this->Direction == other.Direction;
  }

  /// True when both name the same voxels at the same places (up to rounding of the last digits).
  bool IsSameAs(const vtkVoxelGrid& other) const;

  /// One line for error messages: extent, spacing, origin and, when oriented, direction.
  std::string Describe() const;
};

#endif
