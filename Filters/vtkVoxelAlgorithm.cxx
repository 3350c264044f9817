// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelAlgorithm.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPointData.h"
#include "vtkRenderWindow.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapImage.h"
#include "vtkSmartPointer.h"
#include "vtkVoxelCompatibility.h"
#include "vtkVoxelContext.h"
#include "vtkVoxelContextScope.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelMemory.h"
#include "vtkVoxelSpareArrays.h"

#include <stdexcept>
#include <vector>

struct vtkVoxelAlgorithm::Internals
{
  vtkNew<vtkVoxelContext> Context;
  std::vector<vtkSmartPointer<vtkSlicemap>> Slicemaps; // by output port
  vtkIdType NumberOfFilledVoxels = -1;                 // -1: those of the first slicemap
  std::string RendererName;
  vtkVoxelSpareArrays Spare; // from before a run to its end

  /// Ports may have gone.
  void ForgetBeyond(int numberOfPorts)
  {
    if (static_cast<int>(this->Slicemaps.size()) > numberOfPorts)
    {
      this->Slicemaps.resize(numberOfPorts);
    }
  }

  void ForgetResults()
  {
    this->Slicemaps.clear();
    this->NumberOfFilledVoxels = -1;
  }
};

vtkVoxelAlgorithm::vtkVoxelAlgorithm()
  : Common(std::make_unique<Internals>())
{
}

vtkVoxelAlgorithm::~vtkVoxelAlgorithm() = default;

void vtkVoxelAlgorithm::SetOutputScalarType(int type)
{
  if (type != VTK_UNSIGNED_CHAR && type != VTK_BIT)
  {
    vtkErrorMacro("OutputScalarType must be VTK_UNSIGNED_CHAR or VTK_BIT, not " << type << ".");
    return;
  }
  if (this->OutputScalarType != type)
  {
    this->OutputScalarType = type;
    this->Modified();
  }
}

void vtkVoxelAlgorithm::SetRenderWindow(vtkRenderWindow* window)
{
  if (this->Common->Context->GetRenderWindow() != window)
  {
    this->Common->Context->SetRenderWindow(window);
    this->Modified();
  }
}

vtkRenderWindow* vtkVoxelAlgorithm::GetRenderWindow()
{
  return this->Common->Context->GetRenderWindow();
}

vtkVoxelContext* vtkVoxelAlgorithm::GetContext()
{
  return this->Common->Context;
}

vtkIdType vtkVoxelAlgorithm::GetNumberOfFilledVoxels()
{
  if (this->Common->NumberOfFilledVoxels >= 0)
  {
    return this->Common->NumberOfFilledVoxels;
  }
  vtkSlicemap* slicemap = this->GetSlicemap();
  return slicemap ? slicemap->GetNumberOfFilledVoxels() : -1;
}

void vtkVoxelAlgorithm::SetNumberOfFilledVoxels(vtkIdType count)
{
  this->Common->NumberOfFilledVoxels = count;
}

const char* vtkVoxelAlgorithm::GetRendererName()
{
  this->Common->RendererName = this->Common->Context->GetRendererName();
  return this->Common->RendererName.c_str();
}

int vtkVoxelAlgorithm::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkImageData");
  return 1;
}

vtkTypeBool vtkVoxelAlgorithm::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // The last chance to see the arrays of the last run.
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_NOT_GENERATED()))
  {
    for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
    {
      if (vtkImageData* output = vtkImageData::GetData(outputs, port))
      {
        this->Common->Spare.Keep(output);
      }
    }
  }
  const vtkTypeBool result = this->Superclass::ProcessRequest(request, inputs, outputs);
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    this->Common->Spare.Clear();
  }
  return result;
}

vtkVoxelSpareArrays* vtkVoxelAlgorithm::GetSpareArrays()
{
  return &this->Common->Spare;
}

int vtkVoxelAlgorithm::RunInContext(
  const std::string& doing, const std::function<bool()>& prepare, const std::function<bool()>& work)
{
  this->Common->NumberOfFilledVoxels = -1;
  this->Common->ForgetBeyond(this->GetNumberOfOutputPorts());
  try
  {
    if (!prepare())
    {
      this->Common->ForgetResults();
      return 1;
    }
    vtkVoxelContext* context = this->Common->Context;
    vtkVoxelContext::Scope scope(context);
    if (!scope)
    {
      throw std::runtime_error(context->GetErrorMessage());
    }
    if (!work())
    {
      this->Common->ForgetResults();
      return vtkVoxelCompatibility::CheckAbort(this) ? 1 : 0;
    }
    if (!scope.Check(doing))
    {
      throw std::runtime_error(context->GetErrorMessage());
    }
  }
  catch (const std::exception& error)
  {
    this->Common->ForgetResults();
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

std::int64_t vtkVoxelAlgorithm::GetBytesOfOutput(const vtkVoxelGrid& grid)
{
  const std::int64_t voxels = grid.GetNumberOfVoxels();
  return this->OutputScalarType == VTK_BIT ? (voxels + 7) / 8 : voxels;
}

void vtkVoxelAlgorithm::CheckMemory(const vtkVoxelGrid& grid)
{
  if (this->HostOutput)
  {
    const auto n = grid.GetDimensions();
    this->CheckBytes(this->GetBytesOfOutput(grid),
      "output of " + std::to_string(n.x) + " x " + std::to_string(n.y) + " x " +
        std::to_string(n.z) + " voxels",
      "Use fewer voxels, or the scalar type VTK_BIT.");
  }
}

void vtkVoxelAlgorithm::CheckBytes(
  std::int64_t bytes, const std::string& what, const std::string& remedy) const
{
  if (!vtkVoxelMemory::Fits(bytes, this->MemoryLimit))
  {
    this->Common->Spare.Clear();
  }
  vtkVoxelMemory::CheckBytes(bytes, this->MemoryLimit, what, remedy);
}

void vtkVoxelAlgorithm::PublishGrid(const vtkVoxelGrid& grid, vtkInformation* outputInfo)
{
  const bool cells = this->HasCellVoxels();
  (cells ? grid.VoxelsToCells() : grid).ApplyTo(outputInfo);
  // What the pipeline copied from the input's.
  outputInfo->Remove(vtkDataObject::POINT_DATA_VECTOR());
  outputInfo->Remove(vtkDataObject::CELL_DATA_VECTOR());
  if (this->HostOutput)
  {
    vtkDataObject::SetActiveAttributeInfo(outputInfo,
      cells ? vtkDataObject::FIELD_ASSOCIATION_CELLS : vtkDataObject::FIELD_ASSOCIATION_POINTS,
      vtkDataSetAttributes::SCALARS, vtkSlicemapImage::ArrayName, this->OutputScalarType, 1, -1);
  }
}

int vtkVoxelAlgorithm::FailInformation(const std::string& error, vtkInformationVector* outputs)
{
  vtkErrorMacro(<< error);
  this->Common->ForgetResults();
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    if (vtkDataObject* output = vtkDataObject::GetData(outputs, port))
    {
      EmptyOutput(output);
    }
  }
  return 0;
}

vtkDataSetAttributes* vtkVoxelAlgorithm::GetVoxelData(vtkImageData* output)
{
  if (this->HasCellVoxels())
  {
    return output->GetCellData();
  }
  return output->GetPointData();
}

vtkSlicemap* vtkVoxelAlgorithm::GetSlicemap(int port)
{
  const auto& slicemaps = this->Common->Slicemaps;
  return port < static_cast<int>(slicemaps.size()) ? slicemaps[port].Get() : nullptr;
}

vtkSlicemap* vtkVoxelAlgorithm::TakeSlicemap(int port)
{
  auto& slicemaps = this->Common->Slicemaps;
  if (port >= static_cast<int>(slicemaps.size()))
  {
    slicemaps.resize(port + 1);
  }
  auto& slicemap = slicemaps[port];
  if (!slicemap || slicemap->GetReferenceCount() > 1)
  {
    slicemap = vtkSmartPointer<vtkSlicemap>::New();
  }
  slicemap->SetContext(this->Common->Context);
  return slicemap;
}

void vtkVoxelAlgorithm::FillOutput(vtkImageData* output, vtkSlicemap* slicemap)
{
  const vtkVoxelGrid& grid = slicemap->GetGrid();
  (this->HasCellVoxels() ? grid.VoxelsToCells() : grid).ApplyTo(output);
  if (this->HostOutput)
  {
    const auto array =
      vtkSlicemapImage::NewArray(grid, this->OutputScalarType, &this->Common->Spare);
    if (!array)
    {
      throw std::runtime_error("There is no memory for the " +
        std::to_string(grid.GetNumberOfVoxels()) + " voxels of the output. Use fewer voxels.");
    }
    const bool read = slicemap->Read([&](const std::uint32_t* words)
      { vtkSlicemapImage::Expand(words, grid, this->ForegroundValue, array); });
    if (!read)
    {
      throw std::runtime_error("The result could not be read back from OpenGL.");
    }
    this->GetVoxelData(output)->SetScalars(array);
  }
  slicemap->AttachTo(output);
}

void vtkVoxelAlgorithm::EmptyOutput(vtkDataObject* output)
{
  output->Initialize();
  output->GetInformation()->Remove(vtkSlicemap::SLICEMAP());
}

bool vtkVoxelAlgorithm::ReportProgress(double fraction)
{
  // The rest is for the read-back.
  constexpr double shareOfPasses = 0.9;
  this->UpdateProgress(shareOfPasses * fraction);
  return !vtkVoxelCompatibility::CheckAbort(this);
}

void vtkVoxelAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ForegroundValue: " << this->ForegroundValue << "\n";
  os << indent << "OutputScalarType: " << vtkImageScalarTypeNameMacro(this->OutputScalarType)
     << "\n";
  const char* const attributes[] = { "Point", "Cell", "Input" };
  os << indent << "OutputAttributeType: " << attributes[this->GetOutputAttributeType()] << "\n";
  os << indent << "HostOutput: " << this->HostOutput << "\n";
  os << indent << "RenderWindow: " << this->GetRenderWindow() << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
}
