// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelizer.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapImage.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkVoxelCompatibility.h"
#include "vtkVoxelContext.h"
#include "vtkVoxelContextScope.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelMesh.h"

#include <vtksys/SystemInformation.hxx>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace
{
constexpr double BytesPerMebibyte = 1048576.0;

/// Counts of voxels within this fraction above a whole number are that number.
constexpr double CountTolerance = 1e-6;

/// Ask the system for its free memory only for outputs that could matter.
constexpr std::int64_t CarelessBytes = std::int64_t(1) << 28;

struct InvalidGrid : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

std::int64_t VoxelsAlong(double length, double size)
{
  const double count = std::ceil(length / size * (1.0 - CountTolerance));
  if (!(count < std::numeric_limits<int>::max() / 2))
  {
    throw InvalidGrid("A voxel size of " + std::to_string(size) + " cuts a length of " +
      std::to_string(length) + " into too many voxels. Choose larger voxels.");
  }
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(count));
}

std::int64_t GetFreeBytes()
{
  vtksys::SystemInformation system;
  system.RunMemoryCheck();
  return static_cast<std::int64_t>(system.GetAvailablePhysicalMemory()) * 1048576;
}
}

struct vtkVoxelizer::Internals
{
  vtkNew<vtkVoxelContext> Context;
  vtkSmartPointer<vtkSlicemap> Slicemap;
  vtkVoxelMesh Mesh;
  vtkIdType NumberOfTriangles = 0;
  vtkIdType NumberOfFilledVoxels = -1; // -1: those of the slicemap
  std::string RendererName;
};

vtkCxxSetObjectMacro(vtkVoxelizer, ReferenceImage, vtkImageData);

vtkVoxelizer::vtkVoxelizer()
  : State(std::make_unique<Internals>())
{
}

vtkVoxelizer::~vtkVoxelizer()
{
  this->SetReferenceImage(nullptr);
}

void vtkVoxelizer::SetOutputScalarType(int type)
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

void vtkVoxelizer::SetRenderWindow(vtkRenderWindow* window)
{
  if (this->State->Context->GetRenderWindow() != window)
  {
    this->State->Context->SetRenderWindow(window);
    this->Modified();
  }
}

vtkRenderWindow* vtkVoxelizer::GetRenderWindow()
{
  return this->State->Context->GetRenderWindow();
}

vtkVoxelContext* vtkVoxelizer::GetContext()
{
  return this->State->Context;
}

vtkMTimeType vtkVoxelizer::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  if (this->ReferenceImage)
  {
    time = std::max(time, this->ReferenceImage->GetMTime());
  }
  return time;
}

vtkIdType vtkVoxelizer::GetNumberOfFilledVoxels()
{
  if (this->State->NumberOfFilledVoxels >= 0)
  {
    return this->State->NumberOfFilledVoxels;
  }
  return this->State->Slicemap ? this->State->Slicemap->GetNumberOfFilledVoxels() : -1;
}

void vtkVoxelizer::SetNumberOfFilledVoxels(vtkIdType count)
{
  this->State->NumberOfFilledVoxels = count;
}

vtkIdType vtkVoxelizer::GetNumberOfTriangles()
{
  return this->State->NumberOfTriangles;
}

int vtkVoxelizer::GetNumberOfMeshUploads()
{
  return this->State->Mesh.GetNumberOfUploads();
}

const char* vtkVoxelizer::GetRendererName()
{
  this->State->RendererName = this->State->Context->GetRendererName();
  return this->State->RendererName.c_str();
}

int vtkVoxelizer::ResolveBackend()
{
  const bool compute = this->State->Context->SupportsCompute();
  if (this->Backend == BACKEND_COMPUTE && !compute)
  {
    vtkErrorMacro("The Compute backend needs OpenGL 4.3; "
      << this->GetRendererName() << " has " << this->State->Context->GetVersion() / 10.0
      << ". Set the backend to Auto or Raster.");
    return BACKEND_AUTO;
  }
  if (this->Backend != BACKEND_AUTO)
  {
    return this->Backend;
  }
  return compute ? BACKEND_COMPUTE : BACKEND_RASTER;
}

int vtkVoxelizer::FillInputPortInformation(int, vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

int vtkVoxelizer::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkImageData");
  return 1;
}

vtkVoxelGrid vtkVoxelizer::GridFromBox(const double box[6]) const
{
  const glm::dvec3 low(box[0], box[2], box[4]);
  const glm::dvec3 length = glm::dvec3(box[1], box[3], box[5]) - low;
  const double longest = std::max({ length.x, length.y, length.z });
  if (!(longest > 0.0) || !std::isfinite(longest) || !std::isfinite(glm::length(low)))
  {
    throw InvalidGrid("The box to voxelize has no size: its bounds are (" + std::to_string(box[0]) +
      ", " + std::to_string(box[1]) + ", " + std::to_string(box[2]) + ", " +
      std::to_string(box[3]) + ", " + std::to_string(box[4]) + ", " + std::to_string(box[5]) +
      "). Set ModelBounds or OutputWholeExtent.");
  }

  vtkVoxelGrid grid;
  glm::i64vec3 n(1);
  const bool bySize = this->VoxelSize != 0.0 || this->Resolution != 0;
  if (bySize)
  {
    const double size = this->VoxelSize != 0.0 ? this->VoxelSize : longest / this->Resolution;
    if (!(size > 0.0) || !std::isfinite(size))
    {
      throw InvalidGrid(this->VoxelSize != 0.0
          ? "VoxelSize is " + std::to_string(this->VoxelSize) + "; it must be positive."
          : "Resolution is " + std::to_string(this->Resolution) + "; it must be positive.");
    }
    grid.Spacing = glm::dvec3(size);
    for (int axis = 0; axis < 3; ++axis)
    {
      n[axis] = VoxelsAlong(length[axis], size);
    }
  }
  else
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      n[axis] = this->SampleDimensions[axis];
      if (n[axis] <= 0)
      {
        throw InvalidGrid("SampleDimensions are (" + std::to_string(this->SampleDimensions[0]) +
          ", " + std::to_string(this->SampleDimensions[1]) + ", " +
          std::to_string(this->SampleDimensions[2]) + "); each must be 1 at least.");
      }
    }
    grid.Spacing = length / glm::dvec3(n);
    const double coarsest = std::max({ grid.Spacing.x, grid.Spacing.y, grid.Spacing.z });
    for (int axis = 0; axis < 3; ++axis)
    {
      if (this->CubicVoxels || grid.Spacing[axis] == 0.0)
      {
        grid.Spacing[axis] = coarsest;
      }
    }
  }
  grid.Origin = low + 0.5 * (length - glm::dvec3(n - glm::i64vec3(1)) * grid.Spacing) -
    double(this->Padding) * grid.Spacing;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t count = n[axis] + 2 * std::int64_t(this->Padding);
    if (count > std::numeric_limits<int>::max() / 2)
    {
      throw InvalidGrid("The grid would have " + std::to_string(count) +
        " voxels on one axis. Choose larger voxels.");
    }
    grid.Extent[2 * axis] = 0;
    grid.Extent[2 * axis + 1] = static_cast<int>(count - 1);
  }
  return grid;
}

vtkVoxelGrid vtkVoxelizer::GetWholeGrid(vtkDataObject* input) const
{
  if (this->ReferenceImage)
  {
    const auto grid = vtkVoxelGrid::FromImage(this->ReferenceImage);
    if (grid.IsEmpty())
    {
      throw InvalidGrid("The reference image is empty: " + grid.Describe() +
        ". Update its source first, or give it dimensions.");
    }
    return grid;
  }
  vtkVoxelGrid grid;
  std::copy_n(this->OutputWholeExtent, 6, grid.Extent.begin());
  const bool extentIsSet = this->OutputWholeExtent[0] != 0 || this->OutputWholeExtent[1] != -1 ||
    this->OutputWholeExtent[2] != 0 || this->OutputWholeExtent[3] != -1 ||
    this->OutputWholeExtent[4] != 0 || this->OutputWholeExtent[5] != -1;
  if (extentIsSet)
  {
    grid.Spacing =
      glm::dvec3(this->OutputSpacing[0], this->OutputSpacing[1], this->OutputSpacing[2]);
    grid.Origin = glm::dvec3(this->OutputOrigin[0], this->OutputOrigin[1], this->OutputOrigin[2]);
    for (int i = 0; i < 9; ++i)
    {
      grid.Direction[i % 3][i / 3] = this->OutputDirection[i];
    }
    if (grid.IsEmpty())
    {
      throw InvalidGrid("The output would be empty: " + grid.Describe() +
        ". Each upper bound of OutputWholeExtent must reach the lower one.");
    }
    return grid;
  }
  if (this->ModelBounds[0] <= this->ModelBounds[1])
  {
    return this->GridFromBox(this->ModelBounds);
  }
  double bounds[6];
  if (!vtkVoxelMesh::GetBounds(input, bounds))
  {
    throw InvalidGrid("The input has no points. Connect a mesh, or set ModelBounds.");
  }
  return this->GridFromBox(bounds);
}

vtkVoxelGrid vtkVoxelizer::GetCheckedGrid(vtkDataObject* input) const
{
  const auto grid = this->GetWholeGrid(input);
  const bool positive = grid.Spacing.x > 0.0 && grid.Spacing.y > 0.0 && grid.Spacing.z > 0.0;
  if (!positive || !std::isfinite(glm::length(grid.Spacing)) ||
    !std::isfinite(glm::length(grid.Origin)))
  {
    throw InvalidGrid("The output's " + grid.Describe() +
      " can't be voxelized: spacings must be positive and all numbers finite.");
  }
  if (!(std::abs(glm::determinant(grid.Direction)) > 1e-6))
  {
    throw InvalidGrid("The direction matrix of the output is singular: " + grid.Describe() + ".");
  }
  return grid;
}

int vtkVoxelizer::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* inputInfo = inputs[0]->GetInformationObject(0);
  vtkDataObject* input = inputInfo->Get(vtkDataObject::DATA_OBJECT());
  const bool usesBounds = !this->ReferenceImage && this->ModelBounds[0] > this->ModelBounds[1];
  if (usesBounds)
  {
    // The extent of the output depends on the bounds of the input, so the input must be there.
    vtkAlgorithm* producer = this->GetInputAlgorithm(0, 0);
    if (producer)
    {
      producer->Update(this->GetInputConnection(0, 0)->GetIndex());
      input = this->GetInputDataObject(0, 0);
    }
  }
  vtkInformation* output = outputs->GetInformationObject(0);
  vtkVoxelGrid grid;
  try
  {
    grid = this->GetCheckedGrid(input);
  }
  catch (const InvalidGrid& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  if (this->OutputAttributeType == ATTRIBUTE_CELL)
  {
    grid = grid.VoxelsToCells();
  }
  output->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), grid.Extent.data(), 6);
  output->Set(vtkDataObject::SPACING(), &grid.Spacing[0], 3);
  output->Set(vtkDataObject::ORIGIN(), &grid.Origin[0], 3);
  const auto direction = grid.GetDirectionRows();
  output->Set(vtkDataObject::DIRECTION(), direction.data(), 9);
  output->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  if (this->OutputAttributeType == ATTRIBUTE_POINT && this->HostOutput)
  {
    vtkDataObject::SetPointDataActiveScalarInfo(output, this->OutputScalarType, 1);
  }
  return 1;
}

int vtkVoxelizer::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  // Any part of the output may need all of the input.
  vtkInformation* input = inputs[0]->GetInformationObject(0);
  input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
  input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  return 1;
}

void vtkVoxelizer::CheckMemory(const vtkVoxelGrid& grid)
{
  if (this->HostOutput)
  {
    const auto n = grid.GetDimensions();
    const std::int64_t voxels = grid.GetNumberOfVoxels();
    this->CheckBytes((this->OutputScalarType == VTK_BIT ? (voxels + 7) / 8 : voxels) +
        voxels * this->GetBytesOfArrays(),
      "output of " + std::to_string(n.x) + " x " + std::to_string(n.y) + " x " +
        std::to_string(n.z) + " voxels",
      "Use fewer voxels, or the scalar type VTK_BIT.");
  }
}

void vtkVoxelizer::CheckBytes(
  std::int64_t bytes, const std::string& what, const std::string& remedy) const
{
  if (this->MemoryLimit == 0 && bytes < CarelessBytes)
  {
    return;
  }
  const std::int64_t limit = this->MemoryLimit > 0 ? this->MemoryLimit : GetFreeBytes();
  if (bytes > limit)
  {
    throw InvalidGrid("The " + what + " takes " +
      std::to_string(std::llround(bytes / BytesPerMebibyte)) + " MiB, but " +
      std::to_string(std::llround(limit / BytesPerMebibyte)) +
      (this->MemoryLimit > 0 ? " MiB are allowed by MemoryLimit. " : " MiB are free. ") + remedy);
  }
}

vtkVoxelGrid vtkVoxelizer::GetRequestedPart(
  const vtkVoxelGrid& whole, vtkInformation* outputInfo) const
{
  vtkVoxelGrid part = whole;
  if (outputInfo->Has(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()))
  {
    // After a failure the pipeline still has the extent of then, which may exceed that of now.
    const int* asked = outputInfo->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT());
    const int pointsMore = this->OutputAttributeType == ATTRIBUTE_CELL ? 1 : 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      int& low = part.Extent[2 * axis];
      int& high = part.Extent[2 * axis + 1];
      low = std::max(low, asked[2 * axis]);
      high = std::min(high, asked[2 * axis + 1] - pointsMore);
    }
  }
  return part;
}

int vtkVoxelizer::RunOnMesh(vtkDataObject* input,
  const std::function<bool(const vtkVoxelGrid& whole)>& prepare,
  const std::function<bool(vtkVoxelMesh& mesh)>& work)
{
  this->State->NumberOfTriangles = 0;
  this->State->NumberOfFilledVoxels = -1;
  this->UsedBackend = BACKEND_AUTO;
  try
  {
    if (!prepare(this->GetCheckedGrid(input)))
    {
      return 1;
    }
    vtkVoxelContext* context = this->State->Context;
    vtkVoxelContext::Scope scope(context);
    if (!scope)
    {
      throw std::runtime_error(context->GetErrorMessage());
    }
    const int backend = this->ResolveBackend();
    if (backend == BACKEND_AUTO)
    {
      return 0;
    }
    this->State->Mesh.Update(context->GetRecord(), input,
      this->NeedsExactTriangulation() ? vtkVoxelMesh::Triangulation::Exact
                                      : vtkVoxelMesh::Triangulation::Fans);
    this->UsedBackend = backend;
    if (!work(this->State->Mesh))
    {
      this->State->Slicemap = nullptr;
      this->State->NumberOfFilledVoxels = -1;
      return vtkVoxelCompatibility::CheckAbort(this) ? 1 : 0;
    }
    if (!scope.Check("voxelizing"))
    {
      throw std::runtime_error(context->GetErrorMessage());
    }
    this->State->NumberOfTriangles = this->State->Mesh.GetNumberOfTriangles();
  }
  catch (const std::exception& error)
  {
    this->State->Slicemap = nullptr;
    this->State->NumberOfFilledVoxels = -1;
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

int vtkVoxelizer::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataObject* input = inputs[0]->GetInformationObject(0)->Get(vtkDataObject::DATA_OBJECT());
  vtkInformation* outputInfo = outputs->GetInformationObject(0);
  auto* output = vtkImageData::GetData(outputInfo);
  output->Initialize();
  output->GetInformation()->Remove(vtkSlicemap::SLICEMAP());
  vtkVoxelGrid part;
  const int result = this->RunOnMesh(
    input,
    [&](const vtkVoxelGrid& whole)
    {
      part = this->GetRequestedPart(whole, outputInfo);
      if (part.IsEmpty())
      {
        return false;
      }
      this->CheckMemory(part);
      return true;
    },
    [&](vtkVoxelMesh& mesh)
    {
      vtkSlicemap* slicemap = this->TakeSlicemap();
      slicemap->SetContext(this->State->Context);
      if (!this->Voxelize(mesh, part, slicemap))
      {
        return false;
      }
      this->FillOutput(output, slicemap);
      return !this->HostOutput || this->AddArrays(mesh, part, this->GetVoxelData(output));
    });
  if (!this->State->Slicemap)
  {
    output->Initialize();
  }
  return result;
}

vtkDataSetAttributes* vtkVoxelizer::GetVoxelData(vtkImageData* output) const
{
  if (this->OutputAttributeType == ATTRIBUTE_CELL)
  {
    return output->GetCellData();
  }
  return output->GetPointData();
}

vtkSlicemap* vtkVoxelizer::TakeSlicemap()
{
  // The bits of the last run are overwritten, unless somebody else still looks at them.
  auto& slicemap = this->State->Slicemap;
  if (!slicemap || slicemap->GetReferenceCount() > 1)
  {
    slicemap = vtkSmartPointer<vtkSlicemap>::New();
  }
  return slicemap;
}

void vtkVoxelizer::FillOutput(vtkImageData* output, vtkSlicemap* slicemap)
{
  const vtkVoxelGrid grid = slicemap->GetGrid();
  const bool cells = this->OutputAttributeType == ATTRIBUTE_CELL;
  (cells ? grid.VoxelsToCells() : grid).ApplyTo(output);
  if (this->HostOutput)
  {
    const auto array = vtkSlicemapImage::NewArray(grid, this->OutputScalarType);
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

bool vtkVoxelizer::ReportProgress(double fraction)
{
  // The rest is for the read-back.
  constexpr double shareOfPasses = 0.9;
  this->UpdateProgress(shareOfPasses * fraction);
  return !vtkVoxelCompatibility::CheckAbort(this);
}

void vtkVoxelizer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&](const char* name, const auto* values, int count)
  {
    os << indent << name << ":";
    for (int i = 0; i < count; ++i)
    {
      os << " " << values[i];
    }
    os << "\n";
  };
  print("SampleDimensions", this->SampleDimensions, 3);
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "VoxelSize: " << this->VoxelSize << "\n";
  print("ModelBounds", this->ModelBounds, 6);
  os << indent << "CubicVoxels: " << this->CubicVoxels << "\n";
  os << indent << "Padding: " << this->Padding << "\n";
  os << indent << "ReferenceImage: " << this->ReferenceImage << "\n";
  print("OutputWholeExtent", this->OutputWholeExtent, 6);
  print("OutputSpacing", this->OutputSpacing, 3);
  print("OutputOrigin", this->OutputOrigin, 3);
  print("OutputDirection", this->OutputDirection, 9);
  os << indent << "ForegroundValue: " << this->ForegroundValue << "\n";
  os << indent << "OutputScalarType: " << vtkImageScalarTypeNameMacro(this->OutputScalarType)
     << "\n";
  os << indent
     << "OutputAttributeType: " << (this->OutputAttributeType == ATTRIBUTE_CELL ? "Cell" : "Point")
     << "\n";
  os << indent << "HostOutput: " << this->HostOutput << "\n";
  const char* const backends[] = { "Auto", "Raster", "Compute" };
  os << indent << "Backend: " << backends[this->Backend] << "\n";
  os << indent << "UsedBackend: " << backends[this->UsedBackend] << "\n";
  os << indent << "RenderWindow: " << this->GetRenderWindow() << "\n";
  os << indent << "CheckWatertight: " << this->CheckWatertight << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "NumberOfTriangles: " << this->State->NumberOfTriangles << "\n";
}
