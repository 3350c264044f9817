// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelPipeline.h"

#include "Failure.h"
#include "ImageReader.h"
#include "InputFile.h"
#include "MeshReader.h"
#include "Messages.h"
#include "Options.h"
#include "StepExtent.h"
#include "StepFilter.h"
#include "Terminal.h"
#include "VolumeFilter.h"
#include "VoxelizerFactory.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkVoxelFilter.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelMeshRepair.h"
#include "vtkVoxelizer.h"

#include <algorithm>
#include <array>

namespace
{
/// Whether both grids have as many voxels at the same places, whatever their indices are.
bool AreAlike(const vtkVoxelGrid& one, const vtkVoxelGrid& other)
{
  // Formats that keep coordinates in single precision are no nearer.
  constexpr double tolerance = 1e-3;
  const glm::ivec3 last = one.GetDimensions() - 1;
  if (one.GetDimensions() != other.GetDimensions())
  {
    return false;
  }
  const std::array<glm::ivec3, 4> corners = { glm::ivec3(0), glm::ivec3(last.x, 0, 0),
    glm::ivec3(0, last.y, 0), glm::ivec3(0, 0, last.z) };
  const auto otherToOne = one.GetWorldToIndex() * other.GetIndexToWorld();
  return std::all_of(corners.begin(), corners.end(),
    [&](const glm::ivec3& corner)
    {
      const glm::dvec4 found = otherToOne * glm::dvec4(glm::dvec3(other.GetFirst() + corner), 1.0);
      const glm::dvec3 wanted(one.GetFirst() + corner);
      return glm::length(glm::dvec3(found) - wanted) < tolerance;
    });
}

void RefuseErrors(Messages& messages)
{
  const auto errors = messages.TakeErrors();
  if (!errors.empty())
  {
    throw Failure(ExitCode::Voxelization, errors.front());
  }
}

vtkSmartPointer<vtkVoxelAlgorithm> MakeFirst(const Options& options, Messages& messages)
{
  if (options.HasVolume())
  {
    return VolumeFilter::Make(options);
  }
  return VoxelizerFactory::Make(options, messages);
}

vtkSmartPointer<vtkDataObject> ReadInput(
  const Options& options, Messages& messages, Terminal& terminal)
{
  if (options.HasVolume())
  {
    return ImageReader::Read(options.Input, messages, terminal);
  }
  return MeshReader::Read(options.Input, messages, terminal);
}

vtkSmartPointer<vtkDataObject> ReadStepFile(
  const std::string& file, Messages& messages, Terminal& terminal)
{
  if (ImageReader::IsImage(file))
  {
    return ImageReader::Read(file, messages, terminal);
  }
  InputFile::CheckReadable(file);
  if (!MeshReader::IsMesh(file))
  {
    InputFile::Refuse(file,
      "its name is neither that of a mesh, " + MeshReader::GetExtensions() +
        ", nor that of a mask, " + ImageReader::GetImageExtensions());
  }
  return MeshReader::Read(file, messages, terminal);
}
}

VoxelPipeline::VoxelPipeline(const Options& options, Messages& messages, Terminal& terminal)
  : Asked(options)
  , Said(messages)
  , Shown(terminal)
{
  this->Sources.push_back({ options.Input, MakeFirst(options, messages) });
}

VoxelPipeline::~VoxelPipeline() = default;

void VoxelPipeline::Read()
{
  this->Sources.front().Maker->SetInputDataObject(
    this->Mend(ReadInput(this->Asked, this->Said, this->Shown), this->Asked.Input));
  for (const Options::Step& step : this->Asked.Steps)
  {
    this->StepObjects.push_back(step.File.empty()
        ? nullptr
        : this->Mend(ReadStepFile(step.File, this->Said, this->Shown), step.File));
  }
  this->FitGrid();
  this->Connect();
  VoxelizerFactory::SetOutput(this->GetResult(), this->Asked);
  const bool hasArrays =
    this->Asked.Picture || this->Asked.Texture || !this->Asked.Attributes.empty();
  const bool takesBits = this->Asked.MemoryLimit || VoxelOutput::TakesSlicemap(this->Asked.Output);
  this->GetResult()->SetHostOutput(hasArrays || !takesBits);
}

vtkSmartPointer<vtkDataObject> VoxelPipeline::Mend(vtkDataObject* object, const std::string& file)
{
  if (!this->Asked.Repair || vtkImageData::SafeDownCast(object))
  {
    return object;
  }
  vtkNew<vtkVoxelMeshRepair> repair;
  repair->SetInputDataObject(object);
  repair->Update();
  RefuseErrors(this->Said);
  this->Shown.PrintNote(file + ": " + repair->GetSummary());
  if (repair->GetOutput()->GetNumberOfPolys() == 0)
  {
    InputFile::Refuse(file, "all its polygons are degenerate");
  }
  return repair->GetOutput();
}

void VoxelPipeline::FitGrid()
{
  auto* first = vtkVoxelizer::SafeDownCast(this->Sources.front().Maker);
  if (first && !this->Asked.Steps.empty() && !this->Asked.Reference && !this->Asked.Bounds)
  {
    const StepExtent extent(this->Asked.Steps);
    vtkBoundingBox box = MeshReader::GetBounds(first->GetInputDataObject(0, 0));
    for (std::size_t i = 0; i < this->StepObjects.size(); ++i)
    {
      vtkDataObject* object = this->StepObjects[i];
      if (object && extent.Adds(i) && !vtkImageData::SafeDownCast(object))
      {
        box.AddBox(MeshReader::GetBounds(object));
      }
    }
    std::array<double, 6> bounds;
    box.GetBounds(bounds.data());
    first->SetModelBounds(bounds.data());
    first->SetPadding(this->Asked.Padding.value_or(extent.GetMargin()));
  }
}

void VoxelPipeline::Connect()
{
  if (this->Asked.Steps.empty())
  {
    return;
  }
  vtkVoxelAlgorithm* first = this->Sources.front().Maker;
  first->HostOutputOff();
  first->UpdateInformation();
  RefuseErrors(this->Said);
  this->StepGrid = this->GetGrid();
  for (std::size_t i = 0; i < this->Asked.Steps.size(); ++i)
  {
    const Options::Step& step = this->Asked.Steps[i];
    const auto filter = StepFilter::Make(step);
    filter->SetInputConnection(this->GetResult()->GetOutputPort());
    vtkDataObject* object = this->StepObjects[i];
    if (auto* mask = vtkImageData::SafeDownCast(object))
    {
      filter->AddInputDataObject(this->PlaceMask(mask, step.File));
    }
    else if (object)
    {
      filter->AddInputConnection(this->AddSource(object, step.File)->GetOutputPort());
    }
    filter->HostOutputOff();
    this->Filters.push_back(filter);
  }
}

vtkVoxelizer* VoxelPipeline::AddSource(vtkDataObject* mesh, const std::string& file)
{
  const auto voxelizer = VoxelizerFactory::MakeOnGrid(this->Asked, this->StepGrid);
  voxelizer->SetInputDataObject(mesh);
  voxelizer->HostOutputOff();
  this->Sources.push_back({ file, voxelizer });
  return voxelizer;
}

vtkImageData* VoxelPipeline::PlaceMask(vtkImageData* mask, const std::string& file)
{
  const bool cells = !mask->GetPointData()->GetScalars();
  const auto image = vtkVoxelGrid::FromImage(mask);
  const auto there = cells ? image.CellsToVoxels() : image;
  const auto here = vtkVoxelGrid::FromImage(this->StepGrid);
  if (!AreAlike(here, there))
  {
    InputFile::Refuse(file,
      "it is not on the grid of the voxels: " + there.Describe() + " there, " + here.Describe() +
        " here; give " + (this->Asked.HasVolume() ? "" : "--reference " + file + ", or ") +
        "a mask on that grid");
  }
  (cells ? here.VoxelsToCells() : here).ApplyTo(mask);
  return mask;
}

void VoxelPipeline::Run(VoxelOutput::Kind kind)
{
  if (!this->Asked.Steps.empty())
  {
    for (const Source& source : this->Sources)
    {
      this->Update(source.Maker, kind, source.File + ": ");
    }
  }
  this->Update(this->GetResult(), kind, "");
}

void VoxelPipeline::Update(
  vtkVoxelAlgorithm* algorithm, VoxelOutput::Kind kind, const std::string& label)
{
  this->Shown.Watch(algorithm, "voxelizing");
  algorithm->Update(static_cast<int>(kind));
  RefuseErrors(this->Said);
  this->Conclude(algorithm, algorithm->GetNumberOfFilledVoxels(), label);
}

void VoxelPipeline::RunInSlabs(const std::function<vtkIdType(vtkVoxelAlgorithm* result)>& write)
{
  this->Conclude(this->GetResult(), write(this->GetResult()), "");
}

void VoxelPipeline::Conclude(
  vtkVoxelAlgorithm* algorithm, vtkIdType filled, const std::string& label)
{
  for (const std::string& warning : this->Said.TakeWarnings())
  {
    this->Shown.PrintWarning(label + warning);
  }
  if (filled == 0)
  {
    this->Shown.PrintWarning(label + "no voxel is set: " + this->ExplainEmptiness(algorithm));
  }
}

std::string VoxelPipeline::ExplainEmptiness(vtkVoxelAlgorithm* algorithm) const
{
  if (vtkVoxelizer::SafeDownCast(algorithm))
  {
    return "the mesh lies outside of the grid, or is thinner than its voxels";
  }
  if (algorithm == this->Sources.front().Maker)
  {
    return "the volume has no such scalars";
  }
  return "the steps leave none";
}

vtkVoxelAlgorithm* VoxelPipeline::GetResult() const
{
  if (this->Filters.empty())
  {
    return this->Sources.front().Maker;
  }
  return this->Filters.back();
}

vtkSmartPointer<vtkImageData> VoxelPipeline::GetGrid() const
{
  auto grid = vtkSmartPointer<vtkImageData>::New();
  vtkVoxelGrid::FromInformation(this->GetResult()->GetOutputInformation(0)).ApplyTo(grid);
  return grid;
}
