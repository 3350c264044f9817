// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Report.h"

#include "VoxelPipeline.h"

#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkSlicemapSolidVoxelizer.h"

#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

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

vtkIdType CountTriangles(const VoxelPipeline& pipeline)
{
  vtkIdType count = 0;
  for (const auto& source : pipeline.GetSources())
  {
    count += source.Voxelizer->GetNumberOfTriangles();
  }
  return count;
}

vtkIdType CountLeakingColumns(const VoxelPipeline& pipeline)
{
  vtkIdType count = 0;
  for (const auto& source : pipeline.GetSources())
  {
    count += vtkSlicemapSolidVoxelizer::SafeDownCast(source.Voxelizer)->GetNumberOfLeakingColumns();
  }
  return count;
}
}

void Report::Describe(const VoxelPipeline& pipeline)
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
  const vtkIdType filled = result->GetNumberOfFilledVoxels();
  const double volume = static_cast<double>(filled) * spacing[0] * spacing[1] * spacing[2] *
    std::abs(grid->GetDirectionMatrix()->Determinant());

  this->Add("triangles", std::to_string(CountTriangles(pipeline)));
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
  vtkVoxelizer* voxelizer = pipeline.GetSources().front().Voxelizer;
  if (vtkSlicemapSolidVoxelizer::SafeDownCast(voxelizer))
  {
    this->Add("leaking columns", std::to_string(CountLeakingColumns(pipeline)));
  }
  this->Add(
    "backend", voxelizer->GetUsedBackend() == vtkVoxelizer::BACKEND_COMPUTE ? "compute" : "raster");
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
