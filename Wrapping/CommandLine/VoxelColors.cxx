// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelColors.h"

#include "VoxelSet.h"

#include "vtkColorTransferFunction.h"
#include "vtkDataArray.h"
#include "vtkNew.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
constexpr int TableSize = 256;
constexpr double Brightest = 255.0;

double ToLinear(double encoded)
{
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

glm::dvec3 ToLinear(const glm::dvec3& encoded)
{
  return { ToLinear(encoded.x), ToLinear(encoded.y), ToLinear(encoded.z) };
}

/// From cool to warm, by way of a light gray.
std::vector<glm::dvec3> MakeTable()
{
  vtkNew<vtkColorTransferFunction> function;
  function->SetColorSpaceToDiverging();
  function->AddRGBPoint(0.0, 0.23, 0.30, 0.75);
  function->AddRGBPoint(1.0, 0.71, 0.02, 0.15);
  std::vector<glm::dvec3> table(TableSize);
  for (int i = 0; i < TableSize; ++i)
  {
    glm::dvec3 encoded(0.0);
    function->GetColor(double(i) / (TableSize - 1), &encoded[0]);
    table[i] = ToLinear(encoded);
  }
  return table;
}
}

VoxelColors::VoxelColors(const VoxelSet& voxels, vtkDataArray* attribute)
  : Attribute(attribute)
  , AreBytes(attribute->GetDataType() == VTK_UNSIGNED_CHAR)
  , Low(std::numeric_limits<double>::infinity())
  , High(-std::numeric_limits<double>::infinity())
{
  if (this->AreBytes)
  {
    return;
  }
  this->Table = MakeTable();
  voxels.ForEach(
    [&](const VoxelSet::Index&, vtkIdType tuple)
    {
      const double length = this->GetLength(tuple);
      this->Low = std::min(this->Low, length);
      this->High = std::max(this->High, length);
    });
}

glm::dvec3 VoxelColors::Get(vtkIdType tuple) const
{
  if (this->AreBytes)
  {
    const bool isGray = this->Attribute->GetNumberOfComponents() < 3;
    glm::dvec3 encoded(0.0);
    for (const int channel : { 0, 1, 2 })
    {
      encoded[channel] = this->Attribute->GetComponent(tuple, isGray ? 0 : channel) / Brightest;
    }
    return ToLinear(encoded);
  }
  const double range = this->High - this->Low;
  const double fraction = range > 0.0 ? (this->GetLength(tuple) - this->Low) / range : 0.0;
  return this->Table[std::lround(std::clamp(fraction, 0.0, 1.0) * (TableSize - 1))];
}

double VoxelColors::GetLength(vtkIdType tuple) const
{
  const int components = this->Attribute->GetNumberOfComponents();
  if (components == 1)
  {
    return this->Attribute->GetComponent(tuple, 0);
  }
  double sum = 0.0;
  for (int i = 0; i < components; ++i)
  {
    const double value = this->Attribute->GetComponent(tuple, i);
    sum += value * value;
  }
  return std::sqrt(sum);
}
