// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelSlabWriter.h"

#include "vtkBinvoxSlabs.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkImageFileSlabs.h"
#include "vtkImageVoxels.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkNewVoxelFile.h"
#include "vtkObjectFactory.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapImage.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkVoxelBitsFile.h"
#include "vtkVoxelBitsSlabs.h"
#include "vtkVoxelCompatibility.h"
#include "vtkVoxelFileError.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelMemory.h"
#include "vtkVoxelizer.h"

#ifdef VTKVOXELIZATION_HAS_OPENVDB
#include "vtkVDBSlabs.h"
#include "vtkVDBVoxelWriter.h"
#endif

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <limits>
#include <memory>
#include <new>
#include <string>

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

constexpr double ShareOfSlabs = 0.9; // of the progress
constexpr std::int64_t WordBytes = 4;

/// Larger slabs gain nothing, and OpenGL may not have them in one piece.
constexpr std::int64_t LargestSlabBytes = std::int64_t(1) << 28;

struct Aborted
{
};

/// It was reported where it failed.
struct FailedUpstream
{
};

[[noreturn]] void Refuse(const std::string& what)
{
  throw vtkVoxelFileError(vtkErrorCode::UserError, what);
}

#ifdef VTKVOXELIZATION_HAS_OPENVDB
static_assert(int(vtkVoxelSlabWriter::GRID_BOOL) == int(vtkVDBVoxelWriter::GRID_BOOL) &&
    int(vtkVoxelSlabWriter::GRID_MASK) == int(vtkVDBVoxelWriter::GRID_MASK) &&
    int(vtkVoxelSlabWriter::GRID_LEVEL_SET) == int(vtkVDBVoxelWriter::GRID_LEVEL_SET),
  "both writers name the same grids");
#endif
}

/// The output port that the writer is connected to.
class vtkVoxelSlabWriter::Source
{
public:
  explicit Source(vtkVoxelSlabWriter* writer)
    : Producer(writer->GetInputAlgorithm(0, 0, this->Port))
  {
    if (!vtkDemandDrivenPipeline::SafeDownCast(this->Producer->GetExecutive())->UpdateInformation())
    {
      throw FailedUpstream();
    }
    this->Information = this->Producer->GetOutputInformation(this->Port);
    if (int* former = this->Information->Get(Pipeline::UPDATE_EXTENT()))
    {
      this->FormerExtent.assign(former, former + 6);
    }
    this->MakesParts = this->Information->Get(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT()) != 0;
    this->FindVoxels();
    if (this->Whole.IsEmpty())
    {
      Refuse("The input has no voxels: " + this->Whole.Describe() +
        ". Update its source first, or give it dimensions.");
    }
  }

  ~Source()
  {
    // Or else the next update of the input would be one of the last slab.
    if (!this->FormerExtent.empty())
    {
      this->Information->Set(Pipeline::UPDATE_EXTENT(), this->FormerExtent.data(), 6);
    }
  }

  Source(const Source&) = delete;
  void operator=(const Source&) = delete;

  const vtkVoxelGrid& GetWhole() const { return this->Whole; }
  bool HasCells() const { return this->AreCells; }
  bool CanMakeParts() const { return this->MakesParts; }
  const char* GetName() const { return this->Producer->GetClassName(); }

  /// Bytes that a part takes while it is there, what it takes to make it included.
  std::int64_t EstimateBytes(const vtkVoxelGrid& part) const
  {
    if (auto* voxelizer = vtkVoxelizer::SafeDownCast(this->Producer))
    {
      return voxelizer->EstimateBytes(part);
    }
    return vtkSlicemap::GetNumberOfWords(part) * WordBytes +
      part.GetNumberOfVoxels() * this->GetBytesPerVoxel();
  }

  /// The image of a part, or of more than that.
  vtkImageData* Update(const vtkVoxelGrid& part)
  {
    const auto extent = (this->AreCells ? part.VoxelsToCells() : part).Extent;
    vtkNew<vtkInformationVector> requests;
    requests->SetNumberOfInformationObjects(this->Producer->GetNumberOfOutputPorts());
    requests->GetInformationObject(this->Port)->Set(Pipeline::UPDATE_EXTENT(), extent.data(), 6);
    const bool updated = this->Producer->Update(this->Port, requests) != 0;
    auto* image = vtkImageData::SafeDownCast(this->Producer->GetOutputDataObject(this->Port));
    const bool isThere = image && !vtkVoxelGrid::FromImage(image).IsEmpty();
    if (vtkVoxelCompatibility::CheckAbort(this->Producer) && (!updated || !isThere))
    {
      throw Aborted();
    }
    if (!updated || !isThere)
    {
      throw FailedUpstream();
    }
    return image;
  }

  /// For those that can't make parts: then it is certain what they make.
  void MakeWhole()
  {
    this->Update(this->Whole);
    this->FindVoxels();
  }

private:
  void FindVoxels()
  {
    this->Whole = vtkVoxelGrid::FromInformation(this->Information);
    this->AreCells = this->HasCellVoxels();
    if (this->AreCells)
    {
      this->Whole = this->Whole.CellsToVoxels();
    }
  }

  /// Of data that are there, these tell; else what is announced of them.
  bool HasCellVoxels() const
  {
    if (auto* voxelizer = vtkVoxelizer::SafeDownCast(this->Producer))
    {
      return voxelizer->GetOutputAttributeType() == vtkVoxelAlgorithm::ATTRIBUTE_CELL;
    }
    auto* image = vtkImageData::SafeDownCast(this->Producer->GetOutputDataObject(this->Port));
    if (image && (vtkSlicemap::GetFromImage(image) || vtkSlicemapImage::GetScalars(image)))
    {
      return vtkImageVoxels(image).Grid.Extent != vtkVoxelGrid::FromImage(image).Extent;
    }
    const auto has = [&](int association)
    {
      return vtkDataObject::GetActiveFieldInformation(
               this->Information, association, vtkDataSetAttributes::SCALARS) != nullptr;
    };
    return has(vtkDataObject::FIELD_ASSOCIATION_CELLS) &&
      !has(vtkDataObject::FIELD_ASSOCIATION_POINTS);
  }

  std::int64_t GetBytesPerVoxel() const
  {
    vtkInformation* scalars = vtkDataObject::GetActiveFieldInformation(this->Information,
      this->AreCells ? vtkDataObject::FIELD_ASSOCIATION_CELLS
                     : vtkDataObject::FIELD_ASSOCIATION_POINTS,
      vtkDataSetAttributes::SCALARS);
    if (!scalars || !scalars->Has(vtkDataObject::FIELD_ARRAY_TYPE()))
    {
      return 0;
    }
    const int components = std::max(1, scalars->Get(vtkDataObject::FIELD_NUMBER_OF_COMPONENTS()));
    return std::int64_t(components) *
      vtkDataArray::GetDataTypeSize(scalars->Get(vtkDataObject::FIELD_ARRAY_TYPE()));
  }

  int Port = 0;
  vtkAlgorithm* Producer;
  vtkInformation* Information = nullptr;
  std::vector<int> FormerExtent;
  bool MakesParts = false;
  bool AreCells = false;
  vtkVoxelGrid Whole;
};

/// One call of Write.
class vtkVoxelSlabWriter::Run
{
public:
  Run(vtkVoxelSlabWriter* writer, int format)
    : Writer(writer)
    , Format(format)
    , From(writer)
    , Limit(writer->MemoryLimit > 0 ? writer->MemoryLimit : vtkVoxelMemory::GetFreeBytes() / 2)
  {
  }

  void WriteAll()
  {
    this->Check();
    vtkNewVoxelFile file(this->Writer->FileName, this->Writer->InPlace);
    this->Target = this->MakeTarget(file);
    const int axis = this->Target->GetAxis();
    const auto& whole = this->From.GetWhole().Extent;
    const std::int64_t first = whole[2 * axis];
    const std::int64_t last = whole[2 * axis + 1];
    for (std::int64_t next = first; next <= last;)
    {
      const double done = double(next - first) / double(last - first + 1);
      this->Report(ShareOfSlabs * done);
      const std::int64_t end = this->WriteSlab(next, file);
      next = end + 1;
    }
    this->CheckBytes(this->Target->GetBytes() + this->Target->GetBytesToFinish(), "The file");
    const bool finished = this->Target->Finish(this->Watch(ShareOfSlabs, 1.0 - ShareOfSlabs));
    if (this->IsAborted)
    {
      throw Aborted();
    }
    if (!finished)
    {
      file.Fail("the disk may be full");
    }
    this->Report(1.0);
    file.Commit();
  }

private:
  /// What can be told before the file is opened.
  void Check()
  {
    if (!this->From.CanMakeParts())
    {
      this->CheckBytes(this->From.EstimateBytes(this->From.GetWhole()),
        std::string("The output of ") + this->From.GetName() + ", which makes it in one piece,");
      this->From.MakeWhole();
    }
    const vtkVoxelGrid& whole = this->From.GetWhole();
    if (this->Format == FORMAT_BINVOX)
    {
      vtkBinvoxSlabs::Check(whole);
    }
#ifdef VTKVOXELIZATION_HAS_OPENVDB
    if (this->Format == FORMAT_VDB)
    {
      vtkVDBSlabs::Check(whole, this->Writer->OccupancyGrid);
    }
#endif
  }

  std::unique_ptr<vtkVoxelSlabs> MakeTarget(vtkNewVoxelFile& file) const
  {
    const vtkVoxelGrid& whole = this->From.GetWhole();
#ifdef VTKVOXELIZATION_HAS_OPENVDB
    if (this->Format == FORMAT_VDB)
    {
      return vtkVDBSlabs::Make(
        file, whole, this->Writer->OccupancyGrid, this->Writer->HalfBandWidth);
    }
#endif
    if (this->Format == FORMAT_BINVOX)
    {
      return std::make_unique<vtkBinvoxSlabs>(file.GetStream(), whole);
    }
    if (this->Format == FORMAT_BITS)
    {
      vtkVoxelBitsFile description;
      description.Grid = whole;
      return std::make_unique<vtkVoxelBitsSlabs>(file.GetStream(), description);
    }
    vtkImageFileSlabs::Settings settings;
    settings.ScalarType = this->Writer->ScalarType;
    settings.ForegroundValue = this->Writer->ForegroundValue;
    settings.AreCells = this->From.HasCells();
    settings.IsCompressed = this->Writer->Compressed;
    return std::make_unique<vtkImageFileSlabs>(file.GetStream(), whole, settings);
  }

  /// Returns the last index of the slab along the axis.
  std::int64_t WriteSlab(std::int64_t first, vtkNewVoxelFile& file)
  {
    const int axis = this->Target->GetAxis();
    const vtkVoxelGrid& whole = this->From.GetWhole();
    auto extent = whole.Extent;
    extent[2 * axis] = static_cast<int>(first);
    const auto last = this->From.CanMakeParts() ? first + this->GetSlices(first) - 1
                                                : std::numeric_limits<std::int64_t>::max();
    extent[2 * axis + 1] =
      static_cast<int>(std::min<std::int64_t>(last, whole.Extent[2 * axis + 1]));
    const vtkVoxelGrid slab = whole.WithExtent(extent);
    const vtkImageVoxels voxels(this->From.Update(slab));
    voxels.Check();
    extent[2 * axis + 1] = voxels.Grid.Extent[2 * axis + 1];
    const std::int64_t slices = voxels.Grid.GetDimensions()[axis];
    const bool isLast = extent[2 * axis + 1] == whole.Extent[2 * axis + 1];
    if (voxels.Grid.Extent != extent || extent[2 * axis + 1] < slab.Extent[2 * axis + 1] ||
      (!isLast && slices % this->Target->GetMultiple() != 0))
    {
      Refuse(std::string(this->From.GetName()) + " was asked for voxels of the " + slab.Describe() +
        ", and gave others: " + voxels.Grid.Describe() + ". It can't be written in slabs.");
    }
    const double begin = double(first) - whole.Extent[2 * axis];
    const double n = whole.GetDimensions()[axis];
    bool added = false;
    voxels.Read(
      [&](const std::uint32_t* words)
      {
        this->Writer->NumberOfFilledVoxels +=
          vtkSlicemapImage::Count(words, vtkSlicemap::GetNumberOfWords(voxels.Grid));
        added = this->Target->Add(words, voxels.Grid,
          this->Watch(
            ShareOfSlabs * begin / n, ShareOfSlabs * voxels.Grid.GetDimensions()[axis] / n));
      });
    if (this->IsAborted)
    {
      throw Aborted();
    }
    if (!added || !file.GetStream())
    {
      file.Fail("the disk may be full");
    }
    ++this->Writer->NumberOfSlabs;
    return extent[2 * axis + 1];
  }

  /// How many slices the next slab may have.
  std::int64_t GetSlices(std::int64_t first) const
  {
    const int axis = this->Target->GetAxis();
    const vtkVoxelGrid& whole = this->From.GetWhole();
    const std::int64_t rest = whole.Extent[2 * axis + 1] - first + 1;
    const std::int64_t multiple = this->Target->GetMultiple();
    const std::int64_t best = this->Target->GetBestMultiple();
    const auto estimate = [&](std::int64_t slices)
    {
      auto extent = whole.Extent;
      extent[2 * axis + 1] = static_cast<int>(extent[2 * axis] + slices - 1);
      return this->From.EstimateBytes(whole.WithExtent(extent));
    };
    // Along x, rows are padded to the best multiple.
    const std::int64_t unit = std::min(axis == 0 ? best : multiple, rest);
    const std::int64_t bytesOfTarget = this->Target->GetBytes();
    const std::int64_t bytesOfOne = estimate(unit);
    const std::int64_t bytesOfMore = std::max<std::int64_t>(1, estimate(2 * unit) - bytesOfOne);
    this->CheckBytes(bytesOfTarget + bytesOfOne, "The thinnest slab");
    const std::int64_t budget =
      std::min(this->Limit - bytesOfTarget, std::max(LargestSlabBytes, bytesOfOne));
    std::int64_t slices = (1 + (budget - bytesOfOne) / bytesOfMore) * unit;
    if (this->Writer->MaximumSlices > 0)
    {
      slices = std::min<std::int64_t>(
        slices, std::max<std::int64_t>(this->Writer->MaximumSlices / multiple, 1) * multiple);
    }
    return slices >= best ? slices / best * best : slices;
  }

  void CheckBytes(std::int64_t bytes, const std::string& what) const
  {
    constexpr double mebibyte = 1048576.0;
    if (bytes > this->Limit)
    {
      throw vtkVoxelFileError(MemoryLimitError,
        what + " takes " + std::to_string(std::llround(bytes / mebibyte)) + " MiB, and " +
          std::to_string(std::llround(this->Limit / mebibyte)) + " MiB are " +
          (this->Writer->MemoryLimit > 0 ? "the limit of memory. Raise it"
                                         : "half of what is free. Set a limit of memory") +
          ", or use fewer voxels.");
    }
  }

  void Report(double fraction)
  {
    this->Writer->UpdateProgress(fraction);
    if (vtkVoxelCompatibility::CheckAbort(this->Writer))
    {
      throw Aborted();
    }
  }

  /// For what may not throw.
  vtkVoxelSlabs::Progress Watch(double from, double share)
  {
    return [this, from, share](double fraction)
    {
      this->Writer->UpdateProgress(from + share * fraction);
      this->IsAborted = this->IsAborted || vtkVoxelCompatibility::CheckAbort(this->Writer);
      return !this->IsAborted;
    };
  }

  vtkVoxelSlabWriter* Writer;
  int Format;
  Source From;
  std::int64_t Limit;
  std::unique_ptr<vtkVoxelSlabs> Target;
  bool IsAborted = false;
};

vtkStandardNewMacro(vtkVoxelSlabWriter);

vtkVoxelSlabWriter::vtkVoxelSlabWriter() = default;

vtkVoxelSlabWriter::~vtkVoxelSlabWriter()
{
  this->SetFileName(nullptr);
}

int vtkVoxelSlabWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

void vtkVoxelSlabWriter::SetScalarType(int type)
{
  if (type != VTK_UNSIGNED_CHAR && type != VTK_BIT)
  {
    vtkErrorMacro("ScalarType must be VTK_UNSIGNED_CHAR or VTK_BIT, not " << type << ".");
    return;
  }
  if (this->ScalarType != type)
  {
    this->ScalarType = type;
    this->Modified();
  }
}

int vtkVoxelSlabWriter::GetFormatOfFile(const char* fileName)
{
  std::string extension = std::filesystem::path(fileName ? fileName : "").extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".vti")
  {
    return FORMAT_VTI;
  }
  if (extension == ".binvox")
  {
    return FORMAT_BINVOX;
  }
  if (extension == ".bits")
  {
    return FORMAT_BITS;
  }
#ifdef VTKVOXELIZATION_HAS_OPENVDB
  if (extension == ".vdb")
  {
    return FORMAT_VDB;
  }
#endif
  return FORMAT_AUTO;
}

int vtkVoxelSlabWriter::Write()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  this->SetAbortExecute(0);
  this->NumberOfSlabs = 0;
  this->NumberOfFilledVoxels = 0;
  this->InvokeEvent(vtkCommand::StartEvent);
  this->UpdateProgress(0.0);
  this->WriteData();
  this->InvokeEvent(vtkCommand::EndEvent);
  return this->IsWritten ? 1 : 0;
}

void vtkVoxelSlabWriter::WriteData()
{
  this->IsWritten = false;
  try
  {
    if (this->GetNumberOfInputConnections(0) == 0)
    {
      Refuse("There is no input. Connect a voxelizer.");
    }
    const int format = this->Format == FORMAT_AUTO ? GetFormatOfFile(this->FileName) : this->Format;
    const std::string name = this->FileName ? this->FileName : "";
    if (!name.empty() && format == FORMAT_AUTO)
    {
      throw vtkVoxelFileError(vtkErrorCode::UnrecognizedFileTypeError,
        "The file " + name + " can't be written in slabs: its format is not known by its name. " +
          "Name a .vdb, .vti, .binvox or .bits file, or call SetFormat.");
    }
#ifndef VTKVOXELIZATION_HAS_OPENVDB
    if (format == FORMAT_VDB)
    {
      Refuse("There is no OpenVDB in this build. Choose another format.");
    }
#endif
    Run(this, format).WriteAll();
    this->IsWritten = true;
  }
  catch (const Aborted&)
  {
  }
  catch (const FailedUpstream&)
  {
    this->SetErrorCode(UpstreamError);
  }
  catch (const vtkVoxelFileError& error)
  {
    this->SetErrorCode(error.Code);
    vtkErrorMacro(<< error.what());
  }
  catch (const std::bad_alloc&)
  {
    this->SetErrorCode(MemoryLimitError);
    vtkErrorMacro("There is no memory for a slab. Lower the limit of memory.");
  }
  catch (const std::exception& error)
  {
    this->SetErrorCode(vtkErrorCode::UserError);
    vtkErrorMacro("The file could not be written: " << error.what());
  }
}

void vtkVoxelSlabWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const formats[] = { "Auto", "VDB", "VTI", "Binvox", "Bits" };
  const char* const grids[] = { "Bool", "Mask", "LevelSet" };
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "InPlace: " << this->InPlace << "\n";
  os << indent << "Format: " << formats[this->Format] << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "MaximumSlices: " << this->MaximumSlices << "\n";
  os << indent << "OccupancyGrid: " << grids[this->OccupancyGrid] << "\n";
  os << indent << "HalfBandWidth: " << this->HalfBandWidth << "\n";
  os << indent << "ScalarType: " << (this->ScalarType == VTK_BIT ? "bit" : "unsigned char") << "\n";
  os << indent << "ForegroundValue: " << this->ForegroundValue << "\n";
  os << indent << "Compressed: " << this->Compressed << "\n";
  os << indent << "NumberOfSlabs: " << this->NumberOfSlabs << "\n";
  os << indent << "NumberOfFilledVoxels: " << this->NumberOfFilledVoxels << "\n";
}
