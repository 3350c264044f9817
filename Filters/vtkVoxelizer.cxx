// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelizer.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCompositeDataSet.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkSlicemap.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkVoxelContext.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelMesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace
{
/// Counts of voxels within this fraction above a whole number are that number.
constexpr double CountTolerance = 1e-6;

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

}

struct vtkVoxelizer::Internals
{
  vtkVoxelMesh Mesh;
  vtkIdType NumberOfTriangles = 0;
  vtkVoxelGrid Whole;
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

vtkMTimeType vtkVoxelizer::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  if (this->ReferenceImage)
  {
    time = std::max(time, this->ReferenceImage->GetMTime());
  }
  return time;
}

vtkIdType vtkVoxelizer::GetNumberOfTriangles()
{
  return this->State->NumberOfTriangles;
}

int vtkVoxelizer::GetNumberOfMeshUploads()
{
  return this->State->Mesh.GetNumberOfUploads();
}

int vtkVoxelizer::ResolveBackend()
{
  const bool compute = this->GetContext()->SupportsCompute();
  if (this->Backend == BACKEND_COMPUTE && !compute)
  {
    vtkErrorMacro("The Compute backend needs OpenGL 4.3; "
      << this->GetRendererName() << " has " << this->GetContext()->GetVersion() / 10.0
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

vtkVoxelGrid vtkVoxelizer::GetWholeGrid(vtkDataObject* input)
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
    grid.SetDirectionRows(this->OutputDirection);
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
  if (!this->GetInputBounds(input, bounds))
  {
    throw InvalidGrid("The input has no points. Connect a mesh, or set ModelBounds.");
  }
  return this->GridFromBox(bounds);
}

bool vtkVoxelizer::GetInputBounds(vtkDataObject* input, double bounds[6])
{
  return vtkVoxelMesh::GetBounds(input, bounds);
}

vtkVoxelGrid vtkVoxelizer::GetCheckedGrid(vtkDataObject* input)
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
  vtkDataObject* input = vtkDataObject::GetData(inputs[0], 0);
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
  catch (const std::runtime_error& error)
  {
    return this->FailInformation(error.what(), outputs);
  }
  this->PublishGrid(grid, output);
  output->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  return 1;
}

int vtkVoxelizer::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  // Any part of the output may need all of the input.
  vtkInformation* input = inputs[0]->GetInformationObject(0);
  if (!input)
  {
    return 1;
  }
  input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
  input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  return 1;
}

std::int64_t vtkVoxelizer::GetBytesOfOutput(const vtkVoxelGrid& grid)
{
  return this->Superclass::GetBytesOfOutput(grid) +
    grid.GetNumberOfVoxels() * this->GetBytesOfArrays();
}

std::int64_t vtkVoxelizer::EstimateBytes(const vtkVoxelGrid& part)
{
  constexpr std::int64_t wordBytes = 4;
  return this->GetNumberOfWorkSlicemaps() * vtkSlicemap::GetNumberOfWords(part) * wordBytes +
    (this->GetHostOutput() ? this->GetBytesOfOutput(part) : 0);
}

const vtkVoxelGrid& vtkVoxelizer::GetGridOfWhole() const
{
  return this->State->Whole;
}

vtkVoxelGrid vtkVoxelizer::GetRequestedPart(const vtkVoxelGrid& whole, vtkInformation* outputInfo)
{
  vtkVoxelGrid part = whole;
  if (outputInfo->Has(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()))
  {
    // After a failure the pipeline still has the extent of then, which may exceed that of now.
    const int* asked = outputInfo->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT());
    const int pointsMore = this->HasCellVoxels() ? 1 : 0;
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
  this->UsedBackend = BACKEND_AUTO;
  bool finished = false;
  const int result = this->RunInContext(
    "voxelizing",
    [&]
    {
      this->State->Whole = this->GetCheckedGrid(input);
      return prepare(this->State->Whole);
    },
    [&]
    {
      const int backend = this->ResolveBackend();
      if (backend == BACKEND_AUTO)
      {
        return false;
      }
      if (input)
      {
        this->State->Mesh.Update(this->GetContext()->GetRecord(), input,
          this->NeedsExactTriangulation() ? vtkVoxelMesh::Triangulation::Exact
                                          : vtkVoxelMesh::Triangulation::Fans);
      }
      else
      {
        this->State->Mesh = vtkVoxelMesh();
      }
      this->UsedBackend = backend;
      finished = work(this->State->Mesh);
      return finished;
    });
  if (finished && result)
  {
    this->State->NumberOfTriangles = this->State->Mesh.GetNumberOfTriangles();
  }
  return result;
}

int vtkVoxelizer::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataObject* input = vtkDataObject::GetData(inputs[0], 0);
  vtkInformation* outputInfo = outputs->GetInformationObject(0);
  auto* output = vtkImageData::GetData(outputInfo);
  EmptyOutput(output);
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
      return this->Prepare(whole);
    },
    [&](vtkVoxelMesh& mesh)
    {
      vtkSlicemap* slicemap = this->TakeSlicemap();
      if (!this->Voxelize(mesh, part, slicemap))
      {
        return false;
      }
      this->FillOutput(output, slicemap);
      return !this->GetHostOutput() || this->AddArrays(mesh, part, this->GetVoxelData(output));
    });
  if (!this->GetSlicemap())
  {
    EmptyOutput(output);
  }
  return result;
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
  const char* const backends[] = { "Auto", "Raster", "Compute" };
  os << indent << "Backend: " << backends[this->Backend] << "\n";
  os << indent << "UsedBackend: " << backends[this->UsedBackend] << "\n";
  os << indent << "CheckWatertight: " << this->CheckWatertight << "\n";
  os << indent << "NumberOfTriangles: " << this->State->NumberOfTriangles << "\n";
}
