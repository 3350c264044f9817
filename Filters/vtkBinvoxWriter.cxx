// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBinvoxWriter.h"

#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkImageVoxels.h"
#include "vtkInformation.h"
#include "vtkNewVoxelFile.h"
#include "vtkObjectFactory.h"
#include "vtkSlicemap.h"
#include "vtkVoxelFileError.h"
#include "vtkVoxelGrid.h"

#include <algorithm>
#include <functional>
#include <locale>
#include <new>
#include <sstream>
#include <string>
#include <vector>

namespace
{
constexpr int WordBits = 32;

/// The header has one scale and no axes.
void CheckGrid(const vtkVoxelGrid& grid)
{
  constexpr double tolerance = 1e-6;
  const glm::dvec3 spacing = grid.Spacing;
  const bool areCubes =
    glm::all(glm::lessThanEqual(glm::abs(spacing - spacing.x), glm::dvec3(tolerance * spacing.x)));
  if (!areCubes || grid.Direction != glm::dmat3(1.0))
  {
    throw vtkVoxelFileError(vtkErrorCode::UserError,
      "A .binvox file has cubic voxels along the axes of the world, and this image is another "
      "one: " +
        grid.Describe() + ". Resample it, or write a .vti file.");
  }
}

/// The format's name for x, z and y is depth, height and width.
std::string MakeHeader(const vtkVoxelGrid& grid)
{
  const glm::ivec3 n = grid.GetDimensions();
  const double spacing = grid.Spacing.x;
  const glm::dvec3 corner = grid.Origin + spacing * (glm::dvec3(grid.GetFirst()) - 0.5);
  std::ostringstream header;
  header.imbue(std::locale::classic());
  header.precision(17);
  header << "#binvox 1\n"
         << "dim " << n.x << " " << n.z << " " << n.y << "\n"
         << "translate " << corner.x << " " << corner.y << " " << corner.z << "\n"
         << "scale " << spacing * std::max({ n.x, n.y, n.z }) << "\n"
         << "data\n";
  return header.str();
}

/// Pairs of a value and a count, in blocks.
class RunWriter
{
public:
  explicit RunWriter(std::ostream& stream)
    : Stream(stream)
  {
    this->Bytes.reserve(BlockBytes);
  }

  void Append(bool value, std::int64_t count)
  {
    if (value != this->Value)
    {
      this->Flush();
      this->Value = value;
    }
    this->Count += count;
  }

  void Finish()
  {
    this->Flush();
    this->WriteBlock();
  }

private:
  static constexpr std::size_t BlockBytes = 1 << 16;
  static constexpr std::int64_t LongestRun = 255;

  void Flush()
  {
    while (this->Count > 0)
    {
      const std::int64_t count = std::min(this->Count, LongestRun);
      this->Bytes.push_back(this->Value ? 1 : 0);
      this->Bytes.push_back(static_cast<char>(static_cast<unsigned char>(count)));
      this->Count -= count;
      if (this->Bytes.size() >= BlockBytes)
      {
        this->WriteBlock();
      }
    }
  }

  void WriteBlock()
  {
    this->Stream.write(this->Bytes.data(), static_cast<std::streamsize>(this->Bytes.size()));
    this->Bytes.clear();
  }

  std::ostream& Stream;
  std::vector<char> Bytes;
  bool Value = false;
  std::int64_t Count = 0;
};

/// One plane of constant x after the other; 32 of them are in the same words.
void WriteRuns(const std::uint32_t* words, const vtkVoxelGrid& grid, std::ostream& stream,
  const std::function<bool(double)>& progress)
{
  const glm::ivec3 n = grid.GetDimensions();
  const std::int64_t wordsPerRow = vtkSlicemap::GetWordsPerRow(grid);
  const std::int64_t rows = std::int64_t(n.y) * n.z;
  std::vector<std::uint32_t> plane(rows);
  RunWriter runs(stream);
  for (int x = 0; x < n.x; ++x)
  {
    if (x % WordBits == 0)
    {
      if (!progress(double(x) / n.x))
      {
        return;
      }
      const std::uint32_t* word = words + x / WordBits;
      for (std::int64_t row = 0; row < rows; ++row)
      {
        plane[row] = word[row * wordsPerRow];
      }
    }
    const int bit = x % WordBits;
    for (std::int64_t row = 0; row < rows;)
    {
      const std::uint32_t value = plane[row] >> bit & 1;
      const std::int64_t begin = row;
      while (row < rows && (plane[row] >> bit & 1) == value)
      {
        ++row;
      }
      runs.Append(value != 0, row - begin);
    }
  }
  runs.Finish();
}
}

vtkStandardNewMacro(vtkBinvoxWriter);

vtkBinvoxWriter::vtkBinvoxWriter() = default;

vtkBinvoxWriter::~vtkBinvoxWriter()
{
  this->SetFileName(nullptr);
}

vtkImageData* vtkBinvoxWriter::GetInput()
{
  return vtkImageData::SafeDownCast(this->Superclass::GetInput());
}

int vtkBinvoxWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

void vtkBinvoxWriter::WriteData()
{
  try
  {
    const vtkImageVoxels voxels(this->GetInput());
    voxels.Check();
    CheckGrid(voxels.Grid);
    vtkNewVoxelFile file(this->FileName, this->InPlace);
    std::ostream& stream = file.GetStream();
    stream << MakeHeader(voxels.Grid);
    bool aborted = false;
    const auto progress = [&](double fraction)
    {
      this->UpdateProgress(fraction);
      aborted = this->GetAbortExecute() != 0;
      return !aborted && stream;
    };
    voxels.Read(
      [&](const std::uint32_t* words) { WriteRuns(words, voxels.Grid, stream, progress); });
    if (!aborted)
    {
      file.Commit();
    }
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
}

void vtkBinvoxWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "InPlace: " << this->InPlace << "\n";
}
