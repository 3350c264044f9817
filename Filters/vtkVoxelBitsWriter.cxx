// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelBitsWriter.h"

#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkImageVoxels.h"
#include "vtkInformation.h"
#include "vtkNewVoxelFile.h"
#include "vtkObjectFactory.h"
#include "vtkTetraCoveringVoxelizer.h"
#include "vtkVoxelBitsFile.h"
#include "vtkVoxelBitsSlabs.h"
#include "vtkVoxelFileError.h"

#include <new>
#include <optional>
#include <string>

vtkStandardNewMacro(vtkVoxelBitsWriter);

namespace
{
bool GoOn(double)
{
  return true;
}
}

vtkVoxelBitsWriter::vtkVoxelBitsWriter() = default;

vtkVoxelBitsWriter::~vtkVoxelBitsWriter()
{
  this->SetFileName(nullptr);
  this->SetLabel(nullptr);
}

vtkImageData* vtkVoxelBitsWriter::GetInput()
{
  return vtkImageData::SafeDownCast(this->Superclass::GetInput());
}

int vtkVoxelBitsWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

vtkVoxelBitsFile vtkVoxelBitsWriter::MakeDescription() const
{
  vtkVoxelBitsFile description;
  description.Label = this->Label ? this->Label : "";
  if (description.Label.find_first_of("\r\n") != std::string::npos)
  {
    throw vtkVoxelFileError(
      vtkErrorCode::UserError, "The label has several lines. Make it one line.");
  }
  return description;
}

bool vtkVoxelBitsWriter::Guard(const std::function<bool()>& work)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  try
  {
    return work();
  }
  catch (const vtkVoxelFileError& error)
  {
    this->SetErrorCode(error.Code);
    vtkErrorMacro(<< error.what());
  }
  catch (const std::bad_alloc&)
  {
    this->SetErrorCode(vtkErrorCode::UserError);
    vtkErrorMacro("There is no memory for the bits of the image.");
  }
  return false;
}

void vtkVoxelBitsWriter::WriteData()
{
  this->Guard(
    [&]
    {
      const vtkImageVoxels voxels(this->GetInput());
      voxels.Check();
      vtkVoxelBitsFile description = this->MakeDescription();
      description.Grid = voxels.Grid;
      vtkNewVoxelFile file(this->FileName, this->InPlace);
      vtkVoxelBitsSlabs bits(file.GetStream(), description);
      voxels.Read([&](const std::uint32_t* words) { bits.Add(words, voxels.Grid, GoOn); });
      file.Commit();
      return true;
    });
}

bool vtkVoxelBitsWriter::WriteBatch(
  vtkTetraCoveringVoxelizer* voxelizer, vtkTypeInt64 first, int count)
{
  return this->Guard(
    [&]
    {
      if (!voxelizer)
      {
        throw vtkVoxelFileError(vtkErrorCode::UserError, "There is no voxelizer for the batch.");
      }
      vtkVoxelBitsFile description = this->MakeDescription();
      description.NumberOfVariants = count;
      description.FirstVariant = first;
      description.Seed = voxelizer->GetSeed();
      vtkNewVoxelFile file(this->FileName, this->InPlace);
      std::optional<vtkVoxelBitsSlabs> bits;
      const bool finished = voxelizer->VisitBatch(first, count,
        [&](int i, const vtkVoxelGrid& grid, const std::uint32_t* words)
        {
          if (i == 0)
          {
            description.Grid = grid;
            bits.emplace(file.GetStream(), description);
          }
          return bits->Add(words, grid, GoOn) && file.GetStream();
        });
      if (finished || !file.GetStream())
      {
        file.Commit();
      }
      return finished;
    });
}

void vtkVoxelBitsWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Label: " << (this->Label ? this->Label : "(none)") << "\n";
  os << indent << "InPlace: " << this->InPlace << "\n";
}
