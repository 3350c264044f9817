// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVDBVoxelReader.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkVDBArrays.h"
#include "vtkVDBFile.h"
#include "vtkVDBLattice.h"
#include "vtkVoxelFileError.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelMemory.h"

#include <openvdb/io/GridDescriptor.h>

#include <algorithm>
#include <new>

namespace
{
using Entry = vtkVDBFile::Entry;

std::string GetName(const Entry& entry)
{
  return openvdb::io::GridDescriptor::nameAsString(entry.UniqueName);
}

/// A grid of the name, or with the number that tells it from others of the name.
bool HasName(const Entry& entry, const std::string& name)
{
  return entry.Name == name || GetName(entry) == name;
}

bool IsSupported(const Entry& entry)
{
  return entry.Grid && vtkVDBArrays::IsSupported(*entry.Grid);
}

void Extend(std::array<int, 6>& extent, const std::array<int, 6>& other)
{
  const bool isEmpty = extent[0] > extent[1];
  for (int i = 0; i < 6; ++i)
  {
    const int farther = i % 2 ? std::max(extent[i], other[i]) : std::min(extent[i], other[i]);
    extent[i] = isEmpty ? other[i] : farther;
  }
}
}

/// The grids of a file that are read, and their common lattice.
class vtkVDBVoxelReader::Selection
{
public:
  Selection(const char* fileName, const char* gridName)
    : File(fileName)
  {
    if (this->File.GetEntries().empty())
    {
      this->Refuse("has no grid");
    }
    for (const Entry& entry : this->File.GetEntries())
    {
      if (!gridName || HasName(entry, gridName))
      {
        (IsSupported(entry) ? this->Entries : this->Unsupported).push_back(&entry);
      }
    }
    this->Check(gridName);
    this->FindLattice();
  }

  const vtkVoxelGrid& GetLattice() const { return this->Lattice; }
  const std::vector<const Entry*>& GetEntries() const { return this->Entries; }
  vtkVDBFile& GetFile() { return this->File; }

private:
  [[noreturn]] void Refuse(const std::string& what) const
  {
    throw vtkVoxelFileError(
      vtkErrorCode::FileFormatError, "The file " + this->File.GetName() + " " + what + ".");
  }

  void Check(const char* gridName) const
  {
    if (!this->Entries.empty())
    {
      return;
    }
    if (!this->Unsupported.empty())
    {
      this->Refuse("has the grid \"" + GetName(*this->Unsupported.front()) + "\" of type " +
        this->Unsupported.front()->Type +
        ", which has no voxels of bool, float, double, int32, int64 or vec3 in 8^3 leaves. Convert "
        "it");
    }
    std::string names;
    for (const Entry& entry : this->File.GetEntries())
    {
      names += (names.empty() ? "" : ", ") + GetName(entry);
    }
    this->Refuse("has no grid \"" + std::string(gridName) + "\", but " + names);
  }

  void FindLattice()
  {
    for (const Entry* entry : this->Entries)
    {
      vtkVoxelGrid lattice = vtkVDBLattice::From(*entry->Grid);
      lattice.Extent = this->Lattice.Extent;
      if (entry == this->Entries.front())
      {
        this->Lattice = lattice;
      }
      if (!lattice.IsSameAs(this->Lattice))
      {
        this->Refuse("has grids on several lattices, among them \"" +
          GetName(*this->Entries.front()) + "\" and \"" + GetName(*entry) +
          "\". Name one by SetGridName");
      }
      std::array<int, 6> extent;
      if (!vtkVDBLattice::GetStoredExtent(*entry->Grid, extent))
      {
        extent = vtkVDBLattice::GetActiveExtent(*this->File.Read(*entry));
      }
      if (extent[0] <= extent[1])
      {
        Extend(this->Lattice.Extent, extent);
      }
    }
    if (this->Lattice.Extent[0] > this->Lattice.Extent[1])
    {
      this->Refuse("has no active voxel");
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::int64_t count =
        std::int64_t(this->Lattice.Extent[2 * axis + 1]) - this->Lattice.Extent[2 * axis] + 1;
      if (count > VTK_INT_MAX)
      {
        this->Refuse("has more voxels along an axis than an image can have");
      }
    }
  }

  vtkVDBFile File;
  std::vector<const Entry*> Entries;
  std::vector<const Entry*> Unsupported;
  vtkVoxelGrid Lattice;
};

vtkStandardNewMacro(vtkVDBVoxelReader);

vtkVDBVoxelReader::vtkVDBVoxelReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkVDBVoxelReader::~vtkVDBVoxelReader()
{
  this->SetFileName(nullptr);
  this->SetGridName(nullptr);
}

const char* vtkVDBVoxelReader::GetNameOfGrid(int i)
{
  return i >= 0 && i < this->GetNumberOfGrids() ? this->GridNames[i].c_str() : nullptr;
}

const char* vtkVDBVoxelReader::GetTypeOfGrid(int i)
{
  return i >= 0 && i < this->GetNumberOfGrids() ? this->GridTypes[i].c_str() : nullptr;
}

const char* vtkVDBVoxelReader::GetMetadata(const char* name)
{
  const auto found = this->Metadata.find(name ? name : "");
  return found == this->Metadata.end() ? nullptr : found->second.c_str();
}

bool vtkVDBVoxelReader::CanReadFile(const char* fileName)
{
  return vtkVDBFile::HasSignature(fileName);
}

int vtkVDBVoxelReader::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  return this->Superclass::FillOutputPortInformation(port, info);
}

int vtkVDBVoxelReader::Report(unsigned long code, const std::string& what)
{
  this->SetErrorCode(code);
  vtkErrorMacro(<< what);
  return 0;
}

int vtkVDBVoxelReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  this->GridNames.clear();
  this->GridTypes.clear();
  this->Metadata.clear();
  try
  {
    Selection selection(this->FileName, this->GridName);
    for (const Entry& entry : selection.GetFile().GetEntries())
    {
      this->GridNames.push_back(GetName(entry));
      this->GridTypes.push_back(entry.Type);
    }
    const openvdb::MetaMap& metadata = selection.GetFile().GetMetadata();
    for (auto item = metadata.beginMeta(); item != metadata.endMeta(); ++item)
    {
      this->Metadata[item->first] = item->second->str();
    }
    vtkInformation* output = outputs->GetInformationObject(0);
    selection.GetLattice().ApplyTo(output);
    const openvdb::GridBase& first = *selection.GetEntries().front()->Grid;
    vtkDataObject::SetPointDataActiveScalarInfo(
      output, vtkVDBArrays::GetScalarType(first), vtkVDBArrays::GetNumberOfComponents(first));
    return 1;
  }
  catch (const vtkVoxelFileError& error)
  {
    return this->Report(error.Code, error.what());
  }
  catch (const std::exception& error)
  {
    return this->Report(vtkErrorCode::FileFormatError,
      "OpenVDB could not read the file " + std::string(this->FileName) + ": " + error.what());
  }
}

int vtkVDBVoxelReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkImageData* output = vtkImageData::GetData(outputs);
  output->Initialize();
  bool aborted = false;
  try
  {
    Selection selection(this->FileName, this->GridName);
    std::array<int, 6> extent;
    vtkStreamingDemandDrivenPipeline::GetUpdateExtent(
      outputs->GetInformationObject(0), extent.data());
    const vtkVoxelGrid lattice = selection.GetLattice().WithExtent(extent);
    double bytes = 0.0;
    for (const Entry* entry : selection.GetEntries())
    {
      bytes += double(lattice.GetNumberOfVoxels()) *
        vtkVDBArrays::GetNumberOfComponents(*entry->Grid) *
        vtkDataArray::GetDataTypeSize(vtkVDBArrays::GetScalarType(*entry->Grid));
    }
    vtkVoxelMemory::CheckBytes(
      static_cast<std::int64_t>(std::min(bytes, double(VTK_TYPE_INT64_MAX / 2))), this->MemoryLimit,
      "image of " + std::string(this->FileName),
      "Read one of its grids by SetGridName, or a part by an update extent.");

    lattice.ApplyTo(output);
    const double count = double(selection.GetEntries().size());
    double done = 0.0;
    for (const Entry* entry : selection.GetEntries())
    {
      const auto grid = selection.GetFile().Read(*entry);
      vtkSmartPointer<vtkDataArray> array;
      array.TakeReference(vtkDataArray::CreateDataArray(vtkVDBArrays::GetScalarType(*grid)));
      array->SetName(GetName(*entry).c_str());
      array->SetNumberOfComponents(vtkVDBArrays::GetNumberOfComponents(*grid));
      array->SetNumberOfTuples(lattice.GetNumberOfVoxels());
      vtkVDBArrays::ToImage(*grid, lattice, array,
        [&](double fraction)
        {
          this->UpdateProgress((done + fraction) / count);
          aborted = this->GetAbortExecute() != 0;
          return !aborted;
        });
      if (aborted)
      {
        output->Initialize();
        return 1;
      }
      output->GetPointData()->AddArray(array);
      if (entry == selection.GetEntries().front())
      {
        output->GetPointData()->SetActiveScalars(array->GetName());
      }
      done += 1.0;
    }
    return 1;
  }
  catch (const vtkVoxelFileError& error)
  {
    output->Initialize();
    return this->Report(error.Code, error.what());
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    return this->Report(vtkErrorCode::FileFormatError, error.what());
  }
}

void vtkVDBVoxelReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "GridName: " << (this->GridName ? this->GridName : "(all)") << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "Grids:";
  for (const std::string& name : this->GridNames)
  {
    os << " \"" << name << "\"";
  }
  os << "\n";
}
