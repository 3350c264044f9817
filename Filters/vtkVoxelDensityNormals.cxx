// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelDensityNormals.h"

#include "vtkDataSetAttributes.h"
#include "vtkDensityArrays.h"
#include "vtkDensityPass.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkSlicemap.h"
#include "vtkVoxelContext.h"
#include "vtkVoxelGrid.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace
{
constexpr std::int64_t LargestCharCount = 255;

bool IsKernelSize(int size)
{
  return size > 0 && size <= vtkDensityPass::LargestKernel && (size & (size - 1)) == 0;
}

/// The grid of boxes of so many voxels.
vtkVoxelGrid Downsampled(const vtkVoxelGrid& grid, const glm::ivec3& kernel)
{
  vtkVoxelGrid coarse = grid;
  const glm::dvec3 centre = glm::dvec3(grid.GetFirst()) + 0.5 * glm::dvec3(kernel - 1);
  coarse.Origin += grid.Direction * (grid.Spacing * centre);
  coarse.Spacing *= glm::dvec3(kernel);
  const glm::ivec3 last = (grid.GetDimensions() - 1) / kernel;
  coarse.Extent = { 0, last.x, 0, last.y, 0, last.z };
  return coarse;
}
}

vtkStandardNewMacro(vtkVoxelDensityNormals);

int vtkVoxelDensityNormals::GetScalarType() const
{
  const std::int64_t largest =
    std::int64_t(this->KernelSize[0]) * this->KernelSize[1] * this->KernelSize[2];
  return this->DensityType == DENSITY_FRACTION ? VTK_FLOAT
    : largest <= LargestCharCount              ? VTK_UNSIGNED_CHAR
                                               : VTK_UNSIGNED_SHORT;
}

vtkVoxelGrid vtkVoxelDensityNormals::GetOutputGrid(const vtkVoxelGrid& input)
{
  const glm::ivec3 kernel(this->KernelSize[0], this->KernelSize[1], this->KernelSize[2]);
  const bool isKernel = std::all_of(this->KernelSize, this->KernelSize + 3, IsKernelSize);
  return this->Downsample && isKernel ? Downsampled(input, kernel) : input;
}

std::int64_t vtkVoxelDensityNormals::GetBytesOfOutput(const vtkVoxelGrid& grid)
{
  const std::int64_t normals = this->NormalMode == NORMALS_OFF ? 0 : 3 * sizeof(float);
  return grid.GetNumberOfVoxels() *
    (vtkDataArray::GetDataTypeSize(this->GetScalarType()) + normals);
}

void vtkVoxelDensityNormals::CheckInputs(const std::vector<vtkVoxelGrid>&)
{
  if (!std::all_of(this->KernelSize, this->KernelSize + 3, IsKernelSize))
  {
    throw std::runtime_error("KernelSize is " + std::to_string(this->KernelSize[0]) + ", " +
      std::to_string(this->KernelSize[1]) + ", " + std::to_string(this->KernelSize[2]) +
      ". Set a power of two up to " + std::to_string(vtkDensityPass::LargestKernel) +
      " on each axis.");
  }
  if (!this->GetHostOutput())
  {
    throw std::runtime_error(
      "Density and normals are arrays on the host, but HostOutput is off. Turn it on.");
  }
}

int vtkVoxelDensityNormals::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const int result = this->Superclass::RequestInformation(request, inputs, outputs);
  if (result && this->GetHostOutput())
  {
    vtkDataObject::SetActiveAttributeInfo(outputs->GetInformationObject(0),
      this->HasCellVoxels() ? vtkDataObject::FIELD_ASSOCIATION_CELLS
                            : vtkDataObject::FIELD_ASSOCIATION_POINTS,
      vtkDataSetAttributes::SCALARS, vtkDensityArrays::DensityName, this->GetScalarType(), 1, -1);
  }
  return result;
}

bool vtkVoxelDensityNormals::Execute(
  const std::vector<vtkSlicemap*>& inputs, const std::vector<vtkImageData*>& outputs)
{
  const glm::ivec3 kernel(this->KernelSize[0], this->KernelSize[1], this->KernelSize[2]);
  const vtkVoxelGrid grid = this->GetOutputGrid(inputs[0]->GetGrid());
  const vtkDensityPass pass(this->GetContext()->GetRecord(), kernel, this->Downsample);
  vtkDensityArrays arrays(grid, pass.GetNumberOfPlanes(), this->GetScalarType(),
    static_cast<vtkDensityArrays::Gradient>(this->NormalMode), this->GetSpareArrays());
  const double slices = grid.GetDimensions().z;
  const bool finished = pass.Run(inputs[0],
    [&](const vtkDensityPass::Slab& slab)
    {
      arrays.Add(slab);
      return this->ReportProgress((slab.FirstSlice + slab.NumberOfSlices) / slices);
    });
  if (!finished)
  {
    return false;
  }
  (this->HasCellVoxels() ? grid.VoxelsToCells() : grid).ApplyTo(outputs[0]);
  this->GetVoxelData(outputs[0])->SetScalars(arrays.GetDensity());
  this->GetVoxelData(outputs[0])->SetNormals(arrays.GetNormals());
  return true;
}

void vtkVoxelDensityNormals::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const types[] = { "Fraction", "Count" };
  const char* const modes[] = { "Off", "Symmetric", "OneSided" };
  os << indent << "KernelSize: " << this->KernelSize[0] << ", " << this->KernelSize[1] << ", "
     << this->KernelSize[2] << "\n";
  os << indent << "Downsample: " << this->Downsample << "\n";
  os << indent << "DensityType: " << types[this->DensityType] << "\n";
  os << indent << "NormalMode: " << modes[this->NormalMode] << "\n";
}
