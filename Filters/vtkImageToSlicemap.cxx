// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkImageToSlicemap.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapPacker.h"
#include "vtkVoxelGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double Unset = std::numeric_limits<double>::quiet_NaN();

/// Of the run, the rest is for what becomes of the slicemaps.
constexpr double ShareOfPacking = 0.9;
}

vtkStandardNewMacro(vtkImageToSlicemap);

vtkImageToSlicemap::vtkImageToSlicemap()
  : Answer{ Unset, Unset }
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes::SCALARS);
}

void vtkImageToSlicemap::SetValue(int i, double value)
{
  this->SetRange(i, value, value);
}

double vtkImageToSlicemap::GetValue(int i)
{
  return this->GetRange(i)[0];
}

void vtkImageToSlicemap::SetRange(int i, double lower, double upper)
{
  if (i < 0 || i >= MAXIMUM_NUMBER_OF_VALUES)
  {
    vtkErrorMacro("There is no value " << i << ". They are counted from 0 to "
                                       << MAXIMUM_NUMBER_OF_VALUES - 1 << ".");
    return;
  }
  this->SetNumberOfValues(std::max(i + 1, this->GetNumberOfValues()));
  const Range range{ lower, upper };
  if (this->Ranges[i] != range)
  {
    this->Ranges[i] = range;
    this->Modified();
  }
}

double* vtkImageToSlicemap::GetRange(int i)
{
  this->Answer = this->HasValue(i) ? this->Ranges[i] : Range{ Unset, Unset };
  return this->Answer.data();
}

bool vtkImageToSlicemap::HasValue(int i)
{
  return i >= 0 && i < this->GetNumberOfValues();
}

void vtkImageToSlicemap::SetNumberOfValues(int number)
{
  if (number < 0 || number > MAXIMUM_NUMBER_OF_VALUES)
  {
    vtkErrorMacro(
      "There can't be " << number << " values, but 0 to " << MAXIMUM_NUMBER_OF_VALUES << ".");
    return;
  }
  if (number != this->GetNumberOfValues())
  {
    this->Ranges.resize(number, Range{ Unset, Unset });
    this->SetNumberOfOutputPorts(std::max(1, number));
    this->Modified();
  }
}

int vtkImageToSlicemap::GetNumberOfValues()
{
  return static_cast<int>(this->Ranges.size());
}

void vtkImageToSlicemap::ThresholdBetween(double lower, double upper)
{
  this->SetModeToRanges();
  this->SetNumberOfValues(1);
  this->SetRange(0, lower, upper);
}

void vtkImageToSlicemap::ThresholdByUpper(double value)
{
  this->ThresholdBetween(value, Infinity);
}

void vtkImageToSlicemap::ThresholdByLower(double value)
{
  this->ThresholdBetween(-Infinity, value);
}

vtkImageToSlicemap::Range vtkImageToSlicemap::GetBounds(int i)
{
  const Range& range = this->Ranges[i];
  switch (this->Mode)
  {
    case MODE_ISO_VALUES:
      return { range[0], Infinity };
    case MODE_LABELS:
      return { range[0], range[0] };
    default:
      return range;
  }
}

void vtkImageToSlicemap::CheckInputs(const std::vector<vtkVoxelGrid>&)
{
  if (this->Ranges.empty())
  {
    throw std::runtime_error(
      "There are no values. Call SetValue, SetRange or ThresholdBetween first.");
  }
  for (int i = 0; i < this->GetNumberOfValues(); ++i)
  {
    const auto [lower, upper] = this->GetBounds(i);
    if (std::isnan(lower) || std::isnan(upper))
    {
      throw std::runtime_error("Value " + std::to_string(i) + " of " +
        std::to_string(this->GetNumberOfValues()) +
        " was not set, or to NaN. Set a number, or fewer values.");
    }
    if (lower > upper)
    {
      std::ostringstream message;
      message << "Range " << i << " goes from " << lower << " to " << upper
              << ". Give the lower end first.";
      throw std::runtime_error(message.str());
    }
  }
}

vtkDataArray* vtkImageToSlicemap::FindScalars(vtkImageData* image, bool& ofCells)
{
  int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  vtkAbstractArray* array = this->GetInputAbstractArrayToProcess(0, image, association);
  vtkDataArray* scalars = vtkDataArray::SafeDownCast(array);
  if (array && !scalars)
  {
    throw std::runtime_error("The array \"" +
      std::string(array->GetName() ? array->GetName() : "") + "\" is a " + array->GetClassName() +
      ". Name an array of numbers.");
  }
  if (!scalars)
  {
    const char* name = this->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME());
    throw std::runtime_error(name
        ? "The input image has no array \"" + std::string(name) +
          "\" where SetInputArrayToProcess looks for it."
        : "The input image has no scalars. Give it active point or cell scalars, name an array by "
          "SetInputArrayToProcess, or set HostOutput of the filter that it comes from.");
  }
  ofCells = association == vtkDataObject::FIELD_ASSOCIATION_CELLS;
  return scalars;
}

std::int64_t vtkImageToSlicemap::GetBytesOfOutput(const vtkVoxelGrid& grid)
{
  return this->GetNumberOfValues() * this->Superclass::GetBytesOfOutput(grid);
}

bool vtkImageToSlicemap::ExecuteOnImages(
  const std::vector<vtkImageData*>& inputs, const std::vector<vtkImageData*>& outputs)
{
  bool ofCells = false;
  vtkDataArray* scalars = this->FindScalars(inputs[0], ofCells);
  const auto image = vtkVoxelGrid::FromImage(inputs[0]);
  const auto grid = ofCells ? image.CellsToVoxels() : image;
  std::vector<vtkSlicemapPacker::Criterion> criteria;
  std::vector<vtkSlicemap*> slicemaps;
  for (int i = 0; i < this->GetNumberOfValues(); ++i)
  {
    const auto [lower, upper] = this->GetBounds(i);
    criteria.push_back({ lower, upper });
    slicemaps.push_back(this->TakeSlicemap(i));
  }

  const vtkSlicemapPacker packer(scalars, grid, criteria);
  const glm::dvec3 n = grid.GetDimensions();
  const bool packed = vtkSlicemap::Write(grid, slicemaps,
    [&](std::int64_t firstRow, std::int64_t rows, const std::vector<std::uint32_t*>& words)
    {
      packer.Pack(firstRow, rows, words);
      return this->ReportProgress(ShareOfPacking * double(firstRow + rows) / (n.y * n.z));
    });
  if (!packed)
  {
    return false;
  }
  for (std::size_t i = 0; i < outputs.size(); ++i)
  {
    this->FillOutput(outputs[i], slicemaps[i]);
    const double share = double(i + 1) / double(outputs.size());
    if (!this->ReportProgress(ShareOfPacking + (1.0 - ShareOfPacking) * share))
    {
      return false;
    }
  }
  return true;
}

void vtkImageToSlicemap::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const modes[] = { "IsoValues", "Ranges", "Labels" };
  os << indent << "Mode: " << modes[this->Mode] << "\n";
  os << indent << "NumberOfValues: " << this->GetNumberOfValues() << "\n";
  for (int i = 0; i < this->GetNumberOfValues(); ++i)
  {
    os << indent << "Range " << i << ": " << this->Ranges[i][0] << ", " << this->Ranges[i][1]
       << "\n";
  }
}
