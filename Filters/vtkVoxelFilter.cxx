// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelFilter.h"

#include "vtkAlgorithmOutput.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPointData.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapImage.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkVoxelContext.h"
#include "vtkVoxelGrid.h"

#include <algorithm>
#include <stdexcept>

namespace
{
bool IsEmptyRequest(vtkInformation* outputInfo)
{
  vtkVoxelGrid asked;
  if (!outputInfo->Has(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()))
  {
    return false;
  }
  outputInfo->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), asked.Extent.data());
  return asked.IsEmpty();
}
}

/// The voxels of an image, and whether they are its cells.
struct vtkVoxelFilter::InputVoxels
{
  vtkVoxelGrid Grid;
  bool AreCells = false;
};

struct vtkVoxelFilter::Internals
{
  /// The scalars of one input, as bits on the GPU.
  struct Upload
  {
    vtkVoxelGrid Grid;
    vtkMTimeType ScalarsTime = 0;
    vtkSmartPointer<vtkSlicemap> Slicemap;
  };
  std::vector<Upload> Uploads; // by input

  vtkSlicemap* UploadOnce(
    std::size_t input, vtkImageData* image, const vtkVoxelGrid& grid, vtkVoxelContext* context)
  {
    const vtkMTimeType time = vtkSlicemapImage::GetScalars(image)->GetMTime();
    Upload& upload = this->Uploads[input];
    const bool known = upload.Slicemap && upload.Slicemap->IsIn(context) &&
      upload.ScalarsTime == time && upload.Grid == grid;
    if (!known)
    {
      upload.Slicemap = vtkSmartPointer<vtkSlicemap>::New();
      upload.Slicemap->SetContext(context);
      if (!upload.Slicemap->Upload(image))
      {
        upload.Slicemap = nullptr;
        throw std::runtime_error("The input could not be sent to OpenGL.");
      }
      upload.ScalarsTime = time;
      upload.Grid = grid;
    }
    return upload.Slicemap;
  }
};

vtkVoxelFilter::vtkVoxelFilter()
  : Kept(std::make_unique<Internals>())
{
}

vtkVoxelFilter::~vtkVoxelFilter() = default;

void vtkVoxelFilter::SetOutputAttributeType(int type)
{
  const bool follows = type >= ATTRIBUTE_INPUT;
  if (this->FollowsInput != follows)
  {
    this->FollowsInput = follows;
    this->Modified();
  }
  if (!follows)
  {
    this->Superclass::SetOutputAttributeType(type);
  }
}

int vtkVoxelFilter::GetOutputAttributeType()
{
  return this->FollowsInput ? ATTRIBUTE_INPUT : this->Superclass::GetOutputAttributeType();
}

bool vtkVoxelFilter::HasCellVoxels()
{
  return this->FollowsInput ? this->InputHasCellVoxels : this->Superclass::HasCellVoxels();
}

int vtkVoxelFilter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

vtkVoxelGrid vtkVoxelFilter::GetOutputGrid(const vtkVoxelGrid& input)
{
  return input;
}

void vtkVoxelFilter::CheckInputs(const std::vector<vtkVoxelGrid>&) {}

bool vtkVoxelFilter::Process(const std::vector<vtkSlicemap*>&, vtkSlicemap*)
{
  return false;
}

bool vtkVoxelFilter::Execute(
  const std::vector<vtkSlicemap*>& inputs, const std::vector<vtkImageData*>& outputs)
{
  vtkSlicemap* slicemap = this->TakeSlicemap();
  if (!this->Process(inputs, slicemap))
  {
    return false;
  }
  this->FillOutput(outputs[0], slicemap);
  return true;
}

bool vtkVoxelFilter::ExecuteOnImages(
  const std::vector<vtkImageData*>&, const std::vector<vtkImageData*>& outputs)
{
  return this->Execute(this->GetInputSlicemaps(), outputs);
}

vtkDataArray* vtkVoxelFilter::FindScalars(vtkImageData* image, bool& ofCells)
{
  vtkDataArray* scalars = vtkSlicemapImage::GetScalars(image);
  ofCells = scalars != image->GetPointData()->GetScalars();
  return scalars;
}

vtkVoxelFilter::InputVoxels vtkVoxelFilter::FindVoxels(vtkImageData* image)
{
  const auto grid = vtkVoxelGrid::FromImage(image);
  if (grid.IsEmpty())
  {
    throw std::runtime_error("The input image is empty: " + grid.Describe() +
      ". Update its source first, or give it dimensions.");
  }
  bool areCells = false;
  if (vtkDataArray* scalars = this->FindScalars(image, areCells))
  {
    const auto voxels = areCells ? grid.CellsToVoxels() : grid;
    if (scalars->GetNumberOfTuples() != voxels.GetNumberOfVoxels())
    {
      throw std::runtime_error("The scalars of the input have " +
        std::to_string(scalars->GetNumberOfTuples()) + " values, but its " + grid.Describe() +
        " takes " + std::to_string(voxels.GetNumberOfVoxels()) + ".");
    }
    return { voxels, areCells };
  }
  if (vtkSlicemap* slicemap = vtkSlicemap::GetFromImage(image))
  {
    return { slicemap->GetGrid(), slicemap->GetGrid().Extent != grid.Extent };
  }
  throw std::runtime_error("The input image has no scalars. Give it active point or cell scalars.");
}

vtkVoxelGrid vtkVoxelFilter::GetOutputImage(const vtkVoxelGrid& inputImage, bool inputHasCellVoxels)
{
  this->InputHasCellVoxels = inputHasCellVoxels;
  const auto grid =
    this->GetOutputGrid(inputHasCellVoxels ? inputImage.CellsToVoxels() : inputImage);
  return this->HasCellVoxels() ? grid.VoxelsToCells() : grid;
}

int vtkVoxelFilter::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const auto image = vtkVoxelGrid::FromInformation(inputs[0]->GetInformationObject(0));
  if (image.IsEmpty())
  {
    return this->FailInformation("The input image is empty: " + image.Describe() +
        ". Update its source first, or give it dimensions.",
      outputs);
  }
  bool cells = false;
  const bool canHaveCells = !image.CellsToVoxels().IsEmpty();
  if (canHaveCells &&
    !this->GetOutputImage(image, false).IsSameAs(this->GetOutputImage(image, true)))
  {
    // Only the data itself tells for sure whether it has its voxels in points or in cells.
    if (vtkAlgorithm* producer = this->GetInputAlgorithm(0, 0))
    {
      producer->Update(this->GetInputConnection(0, 0)->GetIndex());
    }
    try
    {
      cells = this->FindVoxels(vtkImageData::SafeDownCast(this->GetInputDataObject(0, 0))).AreCells;
    }
    catch (const std::runtime_error&)
    {
      // RequestData says what is wrong.
    }
  }
  this->InputHasCellVoxels = cells;
  const auto grid = this->GetOutputGrid(cells ? image.CellsToVoxels() : image);
  for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
  {
    vtkInformation* output = outputs->GetInformationObject(port);
    this->PublishGrid(grid, output);
    output->Remove(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT());
  }
  return 1;
}

int vtkVoxelFilter::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* input = inputs[port]->GetInformationObject(i);
      const auto whole = vtkVoxelGrid::FromInformation(input).Extent;
      input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), whole.data(), 6);
    }
  }
  return 1;
}

std::vector<vtkImageData*> vtkVoxelFilter::GetInputImages()
{
  std::vector<vtkImageData*> images;
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < this->GetNumberOfInputConnections(port); ++i)
    {
      images.push_back(vtkImageData::SafeDownCast(this->GetInputDataObject(port, i)));
    }
  }
  return images;
}

std::vector<vtkSlicemap*> vtkVoxelFilter::GetInputSlicemaps()
{
  const auto images = this->GetInputImages();
  this->Kept->Uploads.resize(images.size());
  std::vector<vtkSlicemap*> slicemaps;
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    vtkSlicemap* slicemap = vtkSlicemap::GetFromImage(images[i]);
    if (slicemap && slicemap->IsIn(this->GetContext()))
    {
      this->Kept->Uploads[i] = {};
      slicemaps.push_back(slicemap);
    }
    else if (vtkSlicemapImage::GetScalars(images[i]))
    {
      slicemaps.push_back(
        this->Kept->UploadOnce(i, images[i], this->FindVoxels(images[i]).Grid, this->GetContext()));
    }
    else
    {
      throw std::runtime_error(
        "The input image has no scalars, and its bits are in another OpenGL context. Give both "
        "filters the same render window, or set HostOutput of the first one.");
    }
  }
  return slicemaps;
}

int vtkVoxelFilter::RequestData(
  vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputs)
{
  std::vector<vtkImageData*> outputImages;
  for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
  {
    outputImages.push_back(vtkImageData::GetData(outputs, port));
    EmptyOutput(outputImages.back());
  }
  const int askedPort = std::max(0, request->Get(vtkDemandDrivenPipeline::FROM_OUTPUT_PORT()));
  std::vector<vtkImageData*> images;
  bool finished = false;
  const int result = this->RunInContext(
    "working on voxels",
    [&]
    {
      if (IsEmptyRequest(outputs->GetInformationObject(askedPort)))
      {
        return false;
      }
      images = this->GetInputImages();
      std::vector<vtkVoxelGrid> grids;
      for (vtkImageData* image : images)
      {
        const auto voxels = this->FindVoxels(image);
        this->InputHasCellVoxels = grids.empty() ? voxels.AreCells : this->InputHasCellVoxels;
        grids.push_back(voxels.Grid);
      }
      this->CheckInputs(grids);
      this->CheckMemory(this->GetOutputGrid(grids.front()));
      return true;
    },
    [&]
    {
      finished = this->ExecuteOnImages(images, outputImages);
      return finished;
    });
  if (!finished || !result)
  {
    for (vtkImageData* image : outputImages)
    {
      EmptyOutput(image);
    }
  }
  return result;
}

void vtkVoxelFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "InputHasCellVoxels: " << this->InputHasCellVoxels << "\n";
}
