// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Report.h"

#include "VoxelPipeline.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPointData.h"
#include "vtkSlicemapSolidVoxelizer.h"

#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <numeric>
#include <sstream>
#include <vector>

namespace
{
std::string Join(const double* values, int count)
{
  std::ostringstream text;
  text.precision(10);
  for (int i = 0; i < count; ++i)
  {
    text << (i > 0 ? " " : "") << values[i];
  }
  return text.str();
}

std::string WithPrecision(double value, int digits)
{
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return text.str();
}

/// The voxelizers of all meshes that are of a class.
template <typename Voxelizer>
std::vector<Voxelizer*> GetVoxelizers(const VoxelPipeline& pipeline)
{
  std::vector<Voxelizer*> voxelizers;
  for (const auto& source : pipeline.GetSources())
  {
    if (auto* voxelizer = Voxelizer::SafeDownCast(source.Maker))
    {
      voxelizers.push_back(voxelizer);
    }
  }
  return voxelizers;
}

template <typename Voxelizer>
std::string Sum(const std::vector<Voxelizer*>& voxelizers, vtkIdType (Voxelizer::*count)())
{
  const vtkIdType sum = std::accumulate(voxelizers.begin(), voxelizers.end(), vtkIdType(0),
    [&](vtkIdType before, Voxelizer* voxelizer) { return before + (voxelizer->*count)(); });
  return std::to_string(sum);
}

/// Type and range of the scalars of a volume; empty for meshes.
std::string DescribeScalars(const VoxelPipeline& pipeline)
{
  auto* image =
    vtkImageData::SafeDownCast(pipeline.GetSources().front().Maker->GetInputDataObject(0, 0));
  if (!image)
  {
    return {};
  }
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  scalars = scalars ? scalars : image->GetCellData()->GetScalars();
  std::array<double, 2> range;
  scalars->GetFiniteRange(range.data(), 0);
  std::ostringstream text;
  text.precision(10);
  text << scalars->GetDataTypeAsString() << ", " << range[0] << " to " << range[1];
  return text.str();
}
}

void Report::Describe(const VoxelPipeline& pipeline, std::optional<vtkIdType> filledInSlabs)
{
  vtkVoxelAlgorithm* result = pipeline.GetResult();
  const auto grid = pipeline.GetGrid();
  int dimensions[3];
  grid->GetDimensions(dimensions);
  const bool cells = result->GetOutputAttributeType() == vtkVoxelAlgorithm::ATTRIBUTE_CELL;
  double voxels = 1.0;
  std::string size;
  for (int n : dimensions)
  {
    n -= cells ? 1 : 0;
    voxels *= n;
    size += (size.empty() ? "" : " x ") + std::to_string(n);
  }
  const double* spacing = grid->GetSpacing();
  const vtkIdType filled = filledInSlabs ? *filledInSlabs : result->GetNumberOfFilledVoxels();
  const double volume = static_cast<double>(filled) * spacing[0] * spacing[1] * spacing[2] *
    std::abs(grid->GetDirectionMatrix()->Determinant());

  const auto voxelizers = GetVoxelizers<vtkVoxelizer>(pipeline);
  const auto solid = GetVoxelizers<vtkSlicemapSolidVoxelizer>(pipeline);
  const std::string scalars = DescribeScalars(pipeline);
  if (!voxelizers.empty())
  {
    this->Add("triangles", Sum(voxelizers, &vtkVoxelizer::GetNumberOfTriangles));
  }
  if (!scalars.empty())
  {
    this->Add("scalars", scalars);
  }
  this->Add("voxels", size);
  this->Add("spacing", Join(spacing, 3));
  this->Add("origin", Join(grid->GetOrigin(), 3));
  if (!grid->GetDirectionMatrix()->IsIdentity())
  {
    this->Add("direction", Join(grid->GetDirectionMatrix()->GetData(), 9));
  }
  const int* extent = grid->GetExtent();
  if (extent[0] != 0 || extent[2] != 0 || extent[4] != 0)
  {
    this->Add("first index",
      std::to_string(extent[0]) + " " + std::to_string(extent[2]) + " " +
        std::to_string(extent[4]));
  }
  this->Add("filled voxels",
    std::to_string(filled) + " (" + WithPrecision(100.0 * static_cast<double>(filled) / voxels, 3) +
      " %)");
  this->Add("filled volume", WithPrecision(volume, 8));
  if (!solid.empty() && !filledInSlabs)
  {
    this->Add("leaking columns", Sum(solid, &vtkSlicemapSolidVoxelizer::GetNumberOfLeakingColumns));
  }
  if (!voxelizers.empty())
  {
    const int backend = voxelizers.front()->GetUsedBackend();
    this->Add("backend", backend == vtkVoxelizer::BACKEND_COMPUTE ? "compute" : "raster");
  }
  this->Add("renderer", result->GetRendererName());
}

void Report::Add(const std::string& name, const std::string& value)
{
  this->Facts.emplace_back(name, value);
}

void Report::AddTime(const std::string& name, double milliseconds)
{
  this->Times.emplace_back(name, WithPrecision(milliseconds, 3) + " ms");
}

void Report::Print() const
{
  constexpr int width = 17;
  for (const auto* lines : { &this->Facts, &this->Times })
  {
    for (const auto& [name, value] : *lines)
    {
      std::cout << std::left << std::setw(width) << name << value << "\n";
    }
  }
  std::cout.flush();
}
