// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelGrid.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkIntArray.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace
{
constexpr char ExtentName[] = "VoxelExtent";
constexpr char SpacingName[] = "VoxelSpacing";
constexpr char OriginName[] = "VoxelOrigin";
constexpr char DirectionName[] = "VoxelDirection";

template <typename Array, typename Number>
void AddField(vtkFieldData* fields, const char* name, const Number* numbers, int count)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(count);
  array->InsertNextTypedTuple(numbers);
  fields->AddArray(array);
}

/// False when there is no such array.
template <typename Number>
bool GetField(vtkFieldData* fields, const char* name, Number* numbers, int count)
{
  vtkDataArray* array = fields->GetArray(name);
  if (!array || array->GetNumberOfTuples() != 1 || array->GetNumberOfComponents() != count)
  {
    return false;
  }
  for (int i = 0; i < count; ++i)
  {
    numbers[i] = static_cast<Number>(array->GetComponent(0, i));
  }
  return true;
}
}

vtkVoxelGrid vtkVoxelGrid::FromImage(vtkImageData* image)
{
  vtkVoxelGrid grid;
  image->GetExtent(grid.Extent.data());
  image->GetSpacing(&grid.Spacing[0]);
  image->GetOrigin(&grid.Origin[0]);
  grid.SetDirectionRows(image->GetDirectionMatrix()->GetData());
  return grid;
}

void vtkVoxelGrid::ApplyTo(vtkImageData* image) const
{
  image->SetExtent(Extent[0], Extent[1], Extent[2], Extent[3], Extent[4], Extent[5]);
  image->SetSpacing(this->Spacing.x, this->Spacing.y, this->Spacing.z);
  image->SetOrigin(this->Origin.x, this->Origin.y, this->Origin.z);
  const auto rows = this->GetDirectionRows();
  image->SetDirectionMatrix(rows.data());
}

vtkVoxelGrid vtkVoxelGrid::FromInformation(vtkInformation* info)
{
  vtkVoxelGrid grid;
  const auto get = [info](vtkInformationDoubleVectorKey* key, double* values)
  {
    if (info->Has(key))
    {
      info->Get(key, values);
    }
  };
  if (info->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
  {
    info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), grid.Extent.data());
  }
  get(vtkDataObject::SPACING(), &grid.Spacing[0]);
  get(vtkDataObject::ORIGIN(), &grid.Origin[0]);
  auto direction = grid.GetDirectionRows();
  get(vtkDataObject::DIRECTION(), direction.data());
  grid.SetDirectionRows(direction.data());
  return grid;
}

void vtkVoxelGrid::ApplyTo(vtkInformation* info) const
{
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), this->Extent.data(), 6);
  info->Set(vtkDataObject::SPACING(), &this->Spacing[0], 3);
  info->Set(vtkDataObject::ORIGIN(), &this->Origin[0], 3);
  const auto direction = this->GetDirectionRows();
  info->Set(vtkDataObject::DIRECTION(), direction.data(), 9);
}

vtkVoxelGrid vtkVoxelGrid::FromFieldData(vtkFieldData* fields)
{
  vtkVoxelGrid grid;
  std::array<double, 9> direction;
  const bool isThere = GetField(fields, ExtentName, grid.Extent.data(), 6) &&
    GetField(fields, SpacingName, &grid.Spacing[0], 3) &&
    GetField(fields, OriginName, &grid.Origin[0], 3) &&
    GetField(fields, DirectionName, direction.data(), 9);
  if (!isThere)
  {
    return vtkVoxelGrid();
  }
  grid.SetDirectionRows(direction.data());
  return grid;
}

void vtkVoxelGrid::ApplyTo(vtkFieldData* fields) const
{
  AddField<vtkIntArray>(fields, ExtentName, this->Extent.data(), 6);
  AddField<vtkDoubleArray>(fields, SpacingName, &this->Spacing[0], 3);
  AddField<vtkDoubleArray>(fields, OriginName, &this->Origin[0], 3);
  AddField<vtkDoubleArray>(fields, DirectionName, this->GetDirectionRows().data(), 9);
}

std::array<double, 9> vtkVoxelGrid::GetDirectionRows() const
{
  std::array<double, 9> rows;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      rows[3 * row + column] = this->Direction[column][row];
    }
  }
  return rows;
}

void vtkVoxelGrid::SetDirectionRows(const double rows[9])
{
  for (int i = 0; i < 9; ++i)
  {
    this->Direction[i % 3][i / 3] = rows[i];
  }
}

std::int64_t vtkVoxelGrid::GetNumberOfVoxels() const
{
  const glm::ivec3 n = this->GetDimensions();
  return this->IsEmpty() ? 0 : std::int64_t(n.x) * n.y * n.z;
}

vtkVoxelGrid vtkVoxelGrid::WithExtent(const std::array<int, 6>& extent) const
{
  vtkVoxelGrid grid = *this;
  grid.Extent = extent;
  return grid;
}

vtkVoxelGrid vtkVoxelGrid::WithSlices(int first, int count) const
{
  vtkVoxelGrid grid = *this;
  grid.Extent[4] = this->Extent[4] + first;
  grid.Extent[5] = std::min(this->Extent[5], grid.Extent[4] + count - 1);
  return grid;
}

bool vtkVoxelGrid::HasCubicVoxels() const
{
  constexpr double tolerance = 1e-6;
  const glm::dvec3 size = glm::abs(this->Spacing);
  return glm::all(glm::lessThanEqual(glm::abs(size - size.x), glm::dvec3(tolerance * size.x)));
}

vtkVoxelGrid vtkVoxelGrid::VoxelsToCells() const
{
  vtkVoxelGrid grid = *this;
  for (const int upper : { 1, 3, 5 })
  {
    ++grid.Extent[upper];
  }
  grid.Origin -= this->Direction * (0.5 * this->Spacing);
  return grid;
}

vtkVoxelGrid vtkVoxelGrid::CellsToVoxels() const
{
  vtkVoxelGrid grid = *this;
  for (const int upper : { 1, 3, 5 })
  {
    --grid.Extent[upper];
  }
  grid.Origin += this->Direction * (0.5 * this->Spacing);
  return grid;
}

glm::dmat4 vtkVoxelGrid::GetIndexToWorld() const
{
  const glm::dmat3 axes = this->Direction *
    glm::dmat3(this->Spacing.x, 0, 0, 0, this->Spacing.y, 0, 0, 0, this->Spacing.z);
  glm::dmat4 matrix(axes);
  matrix[3] = glm::dvec4(this->Origin, 1.0);
  return matrix;
}

glm::dmat4 vtkVoxelGrid::GetWorldToIndex() const
{
  // Axis by axis, so that grids along the axes get the plain (x - origin) / spacing.
  const glm::dmat3 scale(
    1.0 / this->Spacing.x, 0, 0, 0, 1.0 / this->Spacing.y, 0, 0, 0, 1.0 / this->Spacing.z);
  const glm::dmat3 axes = scale * glm::inverse(this->Direction);
  glm::dmat4 matrix(axes);
  matrix[3] = glm::dvec4(-(axes * this->Origin), 1.0);
  return matrix;
}

double vtkVoxelGrid::GetVoxelVolume() const
{
  return std::abs(glm::determinant(glm::dmat3(this->GetIndexToWorld())));
}

bool vtkVoxelGrid::IsSameAs(const vtkVoxelGrid& other) const
{
  constexpr double tolerance = 1e-9;
  const double scale = glm::length(this->Spacing);
  const auto near = [](const auto& a, const auto& b, double allowed)
  { return glm::length(a - b) <= allowed; };
  bool same = this->Extent == other.Extent &&
    near(this->Spacing, other.Spacing, tolerance * scale) &&
    near(this->Origin, other.Origin, tolerance * (scale + glm::length(this->Origin)));
  for (int column = 0; column < 3; ++column)
  {
    same = same && near(this->Direction[column], other.Direction[column], tolerance);
  }
  return same;
}

std::string vtkVoxelGrid::Describe() const
{
  std::ostringstream text;
  text << "extent (" << this->Extent[0];
  for (int i = 1; i < 6; ++i)
  {
    text << ", " << this->Extent[i];
  }
  const auto write = [&text](const char* name, const glm::dvec3& v)
  { text << ", " << name << " (" << v.x << ", " << v.y << ", " << v.z << ")"; };
  text << ")";
  write("spacing", this->Spacing);
  write("origin", this->Origin);
  if (this->Direction != glm::dmat3(1.0))
  {
    const auto rows = this->GetDirectionRows();
    text << ", direction (" << rows[0];
    for (int i = 1; i < 9; ++i)
    {
      text << ", " << rows[i];
    }
    text << ")";
  }
  return text.str();
}
