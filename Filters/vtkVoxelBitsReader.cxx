// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelBitsReader.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSlicemapImage.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVoxelBitsFile.h"
#include "vtkVoxelFileError.h"
#include "vtkVoxelLargeArray.h"

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkVoxelBitsReader);

/// An open file, after its header.
class vtkVoxelBitsReader::File
{
public:
  explicit File(const char* name)
    : Stream(vtkVoxelFileError::OpenFile(name))
    , Name(name)
  {
    try
    {
      this->Header = vtkVoxelBitsFile::Read(this->Stream);
    }
    catch (const std::runtime_error& error)
    {
      this->Fail(error.what());
    }
    this->Begin = this->Stream.tellg();
  }

  const vtkVoxelBitsFile& GetHeader() const { return this->Header; }

  void CheckVariant(int variant) const
  {
    if (variant < 0 || variant >= this->Header.NumberOfVariants)
    {
      throw vtkVoxelFileError(vtkErrorCode::UserError,
        "The file " + this->Name + " has " + std::to_string(this->Header.NumberOfVariants) +
          " variants, and Variant is " + std::to_string(variant) + ".");
    }
  }

  void Read(std::int64_t variant, unsigned char* values)
  {
    std::vector<unsigned char> bytes(this->Header.GetNumberOfBytes());
    this->Stream.seekg(this->Begin + variant * static_cast<std::streamoff>(bytes.size()));
    if (!this->Stream.read(
          reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
    {
      this->Fail("its data can't be read");
    }
    vtkVoxelBitsFile::Unpack(bytes.data(), this->Header.Grid.GetNumberOfVoxels(), values);
  }

  [[noreturn]] void RefuseMemory() const
  {
    throw vtkVoxelFileError(vtkErrorCode::FileFormatError,
      "There is no memory for the " + std::to_string(this->Header.Grid.GetNumberOfVoxels()) +
        " voxels of " + this->Name + ".");
  }

private:
  [[noreturn]] void Fail(const std::string& what) const
  {
    throw vtkVoxelFileError(vtkErrorCode::FileFormatError,
      "The file " + this->Name + " is no .bits file, or is damaged: " + what + ".");
  }

  std::ifstream Stream;
  std::string Name;
  std::streamoff Begin = 0;
  vtkVoxelBitsFile Header;
};

vtkVoxelBitsReader::vtkVoxelBitsReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkVoxelBitsReader::~vtkVoxelBitsReader()
{
  this->SetFileName(nullptr);
}

bool vtkVoxelBitsReader::CanReadFile(const char* fileName)
{
  const std::string signature = vtkVoxelBitsFile::Signature;
  std::ifstream stream(fileName ? fileName : "", std::ios::binary);
  std::string start(signature.size(), ' ');
  return stream.read(start.data(), static_cast<std::streamsize>(start.size())) &&
    start == signature;
}

bool vtkVoxelBitsReader::Guard(const std::function<void()>& work)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  try
  {
    work();
    return true;
  }
  catch (const vtkVoxelFileError& error)
  {
    this->SetErrorCode(error.Code);
    vtkErrorMacro(<< error.what());
    return false;
  }
}

int vtkVoxelBitsReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  const auto work = [&]
  {
    const File file(this->FileName);
    const vtkVoxelBitsFile& header = file.GetHeader();
    this->NumberOfVariants = header.NumberOfVariants;
    this->FirstVariant = header.FirstVariant;
    this->Seed = header.Seed;
    this->Label = header.Label;
    file.CheckVariant(this->Variant);
    vtkInformation* output = outputs->GetInformationObject(0);
    output->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), header.Grid.Extent.data(), 6);
    header.Grid.ApplyTo(output);
    vtkDataObject::SetPointDataActiveScalarInfo(output, VTK_UNSIGNED_CHAR, 1);
  };
  return this->Guard(work) ? 1 : 0;
}

int vtkVoxelBitsReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkImageData* output = vtkImageData::GetData(outputs);
  const auto work = [&]
  {
    File file(this->FileName);
    file.CheckVariant(this->Variant);
    const vtkVoxelGrid& grid = file.GetHeader().Grid;
    const auto array = vtkVoxelNewLargeArray<vtkUnsignedCharArray>(
      vtkSlicemapImage::ArrayName, grid.GetNumberOfVoxels());
    if (!array)
    {
      file.RefuseMemory();
    }
    file.Read(this->Variant, array->GetPointer(0));
    grid.ApplyTo(output);
    output->GetPointData()->SetScalars(array);
  };
  if (!this->Guard(work))
  {
    output->Initialize();
    return 0;
  }
  return 1;
}

bool vtkVoxelBitsReader::ReadBatch(vtkUnsignedCharArray* array)
{
  if (!array)
  {
    vtkErrorMacro("There is no array for the voxels of the batch.");
    return false;
  }
  const auto work = [&]
  {
    File file(this->FileName);
    const vtkVoxelBitsFile& header = file.GetHeader();
    const std::int64_t voxels = header.Grid.GetNumberOfVoxels();
    array->SetName(vtkSlicemapImage::ArrayName);
    array->SetNumberOfComponents(1);
    array->SetNumberOfTuples(voxels * header.NumberOfVariants);
    if (array->GetNumberOfTuples() != voxels * header.NumberOfVariants)
    {
      file.RefuseMemory();
    }
    for (std::int64_t i = 0; i < header.NumberOfVariants; ++i)
    {
      file.Read(i, array->GetPointer(i * voxels));
      this->UpdateProgress(double(i + 1) / double(header.NumberOfVariants));
    }
  };
  if (!this->Guard(work))
  {
    array->Initialize();
    return false;
  }
  return true;
}

void vtkVoxelBitsReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Variant: " << this->Variant << "\n";
  os << indent << "NumberOfVariants: " << this->NumberOfVariants << "\n";
  os << indent << "FirstVariant: " << this->FirstVariant << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Label: " << this->Label << "\n";
}
