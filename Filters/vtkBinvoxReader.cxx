// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBinvoxReader.h"

#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkSlicemapImage.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVoxelFileError.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelLargeArray.h"
#include "vtkVoxelTextHeader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
const std::string Signature = "#binvox";

constexpr std::int64_t LongestRun = 255;
constexpr std::int64_t BytesPerRun = 2;

/// Makes rows along x of values that come with y fastest, then z, then x: some planes at a time, so
/// that neighbours of a row are written together.
class PlaneTurner
{
public:
  PlaneTurner(const glm::ivec3& dimensions, unsigned char* voxels)
    : RowLength(dimensions.x)
    , Rows(std::int64_t(dimensions.y) * dimensions.z)
    , Voxels(voxels)
    , Planes(this->Rows * std::min<std::int64_t>(PlanesAtOnce, dimensions.x))
  {
  }

  void Append(unsigned char value, std::int64_t count)
  {
    while (count > 0)
    {
      const std::int64_t planes = std::min(PlanesAtOnce, this->RowLength - this->FirstPlane);
      const std::int64_t room = planes * this->Rows - this->Filled;
      const std::int64_t part = std::min(count, room);
      std::fill_n(this->Planes.begin() + this->Filled, part, value);
      this->Filled += part;
      count -= part;
      if (part == room)
      {
        this->Turn(planes);
      }
    }
  }

private:
  static constexpr std::int64_t PlanesAtOnce = 64;

  void Turn(std::int64_t planes)
  {
    vtkSMPTools::For(0, this->Rows,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType row = begin; row < end; ++row)
        {
          unsigned char* out = this->Voxels + row * this->RowLength + this->FirstPlane;
          for (std::int64_t plane = 0; plane < planes; ++plane)
          {
            out[plane] = this->Planes[plane * this->Rows + row];
          }
        }
      });
    this->FirstPlane += planes;
    this->Filled = 0;
  }

  std::int64_t RowLength;
  std::int64_t Rows;
  unsigned char* Voxels;
  std::vector<unsigned char> Planes;
  std::int64_t FirstPlane = 0;
  std::int64_t Filled = 0;
};

/// An open file, after its header.
class BinvoxFile
{
public:
  explicit BinvoxFile(const char* name)
    : Stream(vtkVoxelFileError::OpenFile(name))
    , Name(name)
  {
    this->ReadHeader();
  }

  const vtkVoxelGrid& GetGrid() const { return this->Grid; }

  /// Expands all runs into the rows of an image; `progress` may stop it.
  template <typename Progress>
  void ReadVoxels(unsigned char* voxels, const Progress& progress)
  {
    const std::int64_t total = this->Grid.GetNumberOfVoxels();
    PlaneTurner turner(this->Grid.GetDimensions(), voxels);
    std::int64_t done = 0;
    std::array<char, 1 << 16> block;
    while (done < total && progress(double(done) / total))
    {
      this->Stream.read(block.data(), block.size());
      const std::streamsize bytes = this->Stream.gcount() / BytesPerRun * BytesPerRun;
      if (bytes == 0)
      {
        this->FailOnCount(done);
      }
      for (std::streamsize i = 0; i < bytes && done < total; i += BytesPerRun)
      {
        const std::int64_t count = static_cast<unsigned char>(block[i + 1]);
        done += count;
        if (done > total)
        {
          this->FailOnCount(done);
        }
        turner.Append(static_cast<unsigned char>(block[i]), count);
      }
    }
  }

private:
  [[noreturn]] void Fail(const std::string& what) const
  {
    throw vtkVoxelFileError(vtkErrorCode::FileFormatError,
      "The file " + this->Name + " is no .binvox file, or is damaged: " + what + ".");
  }

  [[noreturn]] void FailOnCount(std::int64_t found) const
  {
    this->Fail("its runs have " + std::to_string(found) + " voxels or end there, and its header " +
      std::to_string(this->Grid.GetNumberOfVoxels()));
  }

  void ReadHeader()
  {
    std::array<std::int64_t, 3> dim{ 0, 0, 0 };
    std::array<double, 3> corner{ 0.0, 0.0, 0.0 };
    std::array<double, 1> scale{ 1.0 };
    try
    {
      const vtkVoxelTextHeader header(this->Stream, Signature);
      header.Get("dim", dim);
      header.Get("translate", corner);
      header.Get("scale", scale);
    }
    catch (const std::runtime_error& error)
    {
      this->Fail(error.what());
    }
    this->SetGrid({ dim[0], dim[2], dim[1] }, { corner[0], corner[1], corner[2] }, scale[0]);
  }

  void SetGrid(const std::array<std::int64_t, 3>& n, const glm::dvec3& corner, double scale)
  {
    constexpr std::int64_t longest = VTK_INT_MAX / 2;
    const std::string text =
      std::to_string(n[0]) + " " + std::to_string(n[2]) + " " + std::to_string(n[1]);
    if (std::any_of(n.begin(), n.end(), [](std::int64_t i) { return i < 1 || i > longest; }))
    {
      this->Fail("its dimensions are " + text);
    }
    const double spacing = scale / double(*std::max_element(n.begin(), n.end()));
    const glm::dvec3 end = corner + scale;
    const bool isFinite =
      std::isfinite(scale) && std::isfinite(end.x) && std::isfinite(end.y) && std::isfinite(end.z);
    if (!isFinite || spacing <= 0.0)
    {
      this->Fail("its scale is not positive, or its place is not finite");
    }
    const auto begin = this->Stream.tellg();
    this->Stream.seekg(0, std::ios::end);
    const std::int64_t bytes = this->Stream.tellg() - begin;
    this->Stream.seekg(begin);
    const double mostVoxels = double(bytes / BytesPerRun) * LongestRun;
    if (double(n[0]) * double(n[1]) * double(n[2]) > mostVoxels)
    {
      this->Fail("it is too short for its dimensions, " + text);
    }
    this->Grid.Extent = { 0, static_cast<int>(n[0]) - 1, 0, static_cast<int>(n[1]) - 1, 0,
      static_cast<int>(n[2]) - 1 };
    this->Grid.Spacing = glm::dvec3(spacing);
    this->Grid.Origin = corner + 0.5 * this->Grid.Spacing;
  }

  std::ifstream Stream;
  std::string Name;
  vtkVoxelGrid Grid;
};
}

vtkStandardNewMacro(vtkBinvoxReader);

vtkBinvoxReader::vtkBinvoxReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkBinvoxReader::~vtkBinvoxReader()
{
  this->SetFileName(nullptr);
}

bool vtkBinvoxReader::CanReadFile(const char* fileName)
{
  std::ifstream stream(fileName ? fileName : "", std::ios::binary);
  std::string start(Signature.size(), ' ');
  return stream.read(&start[0], static_cast<std::streamsize>(start.size())) && start == Signature;
}

int vtkBinvoxReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  try
  {
    const vtkVoxelGrid grid = BinvoxFile(this->FileName).GetGrid();
    vtkInformation* output = outputs->GetInformationObject(0);
    output->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), grid.Extent.data(), 6);
    output->Set(vtkDataObject::SPACING(), &grid.Spacing[0], 3);
    output->Set(vtkDataObject::ORIGIN(), &grid.Origin[0], 3);
    vtkDataObject::SetPointDataActiveScalarInfo(output, VTK_UNSIGNED_CHAR, 1);
    return 1;
  }
  catch (const vtkVoxelFileError& error)
  {
    this->SetErrorCode(error.Code);
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

int vtkBinvoxReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkImageData* output = vtkImageData::GetData(outputs);
  try
  {
    BinvoxFile file(this->FileName);
    const auto array = vtkVoxelNewLargeArray<vtkUnsignedCharArray>(vtkSlicemapImage::ArrayName,
      file.GetGrid().GetNumberOfVoxels(), 1, vtkVoxelInitially::Undefined);
    if (!array)
    {
      throw vtkVoxelFileError(vtkErrorCode::FileFormatError,
        "There is no memory for the " + std::to_string(file.GetGrid().GetNumberOfVoxels()) +
          " voxels of " + this->FileName + ".");
    }
    file.ReadVoxels(array->GetPointer(0),
      [this](double fraction)
      {
        this->UpdateProgress(fraction);
        return this->GetAbortExecute() == 0;
      });
    if (this->GetAbortExecute())
    {
      output->Initialize();
      return 1;
    }
    file.GetGrid().ApplyTo(output);
    output->GetPointData()->SetScalars(array);
    return 1;
  }
  catch (const vtkVoxelFileError& error)
  {
    output->Initialize();
    this->SetErrorCode(error.Code);
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

void vtkBinvoxReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
