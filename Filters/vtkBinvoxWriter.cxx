// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBinvoxWriter.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapImage.h"
#include "vtkVoxelGrid.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <locale>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
constexpr int WordBits = 32;

/// What went wrong, and the code that vtkAlgorithm knows for it.
struct WriteError : std::runtime_error
{
  WriteError(unsigned long code, const std::string& what)
    : std::runtime_error(what)
    , Code(code)
  {
  }

  unsigned long Code;
};

/// The voxels of an image where they are now: in a slicemap, or in scalars.
struct Voxels
{
  explicit Voxels(vtkImageData* image)
    : Slicemap(vtkSlicemap::GetFromImage(image))
    , Scalars(vtkSlicemapImage::GetScalars(image))
    , Grid(vtkVoxelGrid::FromImage(image))
  {
    if (this->Slicemap)
    {
      this->Grid = this->Slicemap->GetGrid();
    }
    else if (this->Scalars && this->Scalars != image->GetPointData()->GetScalars())
    {
      this->Grid = this->Grid.CellsToVoxels();
    }
  }

  void Check() const
  {
    if (this->Grid.IsEmpty() || (!this->Slicemap && !this->Scalars))
    {
      throw WriteError(vtkErrorCode::UserError,
        "The image has no voxels: " + this->Grid.Describe() +
          ". Update its source first, and give it active point or cell scalars.");
    }
    if (!this->Slicemap && this->Scalars->GetNumberOfTuples() != this->Grid.GetNumberOfVoxels())
    {
      throw WriteError(vtkErrorCode::UserError,
        "The scalars of the image have " + std::to_string(this->Scalars->GetNumberOfTuples()) +
          " values, but its " + this->Grid.Describe() + " takes " +
          std::to_string(this->Grid.GetNumberOfVoxels()) + ".");
    }
    constexpr double tolerance = 1e-6;
    const glm::dvec3 spacing = this->Grid.Spacing;
    const bool areCubes = glm::all(
      glm::lessThanEqual(glm::abs(spacing - spacing.x), glm::dvec3(tolerance * spacing.x)));
    if (!areCubes || this->Grid.Direction != glm::dmat3(1.0))
    {
      throw WriteError(vtkErrorCode::UserError,
        "A .binvox file has cubic voxels along the axes of the world, and this image is another "
        "one: " +
          this->Grid.Describe() + ". Resample it, or write a .vti file.");
    }
  }

  /// The words of the slicemap, or of the scalars packed like one, while `consume` runs.
  void Read(const std::function<void(const std::uint32_t* words)>& consume) const
  {
    if (!this->Slicemap)
    {
      std::vector<std::uint32_t> words(vtkSlicemap::GetNumberOfWords(this->Grid));
      vtkSlicemapImage::Pack(this->Scalars, this->Grid, words.data());
      consume(words.data());
    }
    else if (!this->Slicemap->Read(consume))
    {
      throw WriteError(vtkErrorCode::UserError, "The voxels could not be read from the GPU.");
    }
  }

  vtkSlicemap* Slicemap;
  vtkDataArray* Scalars;
  vtkVoxelGrid Grid;
};

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

/// A file that takes its name when it is complete, and leaves nothing behind otherwise.
class NewFile
{
public:
  NewFile(const std::string& name, bool inPlace)
    : Name(name)
    , Partial(inPlace ? name : name + ".part")
  {
    std::error_code none;
    if (std::filesystem::is_directory(this->Name, none))
    {
      throw WriteError(vtkErrorCode::CannotOpenFileError, name + " is a folder. Name a file.");
    }
    errno = 0;
    this->Stream.open(this->Partial, std::ios::binary);
    if (!this->Stream)
    {
      throw WriteError(vtkErrorCode::CannotOpenFileError,
        "The file " + name + " can't be written: " + std::strerror(errno) + ".");
    }
    this->Exists = true;
  }

  ~NewFile()
  {
    if (this->Exists)
    {
      this->Stream.close();
      std::error_code none;
      std::filesystem::remove(this->Partial, none);
    }
  }

  NewFile(const NewFile&) = delete;
  void operator=(const NewFile&) = delete;

  void Commit()
  {
    this->Stream.close();
    std::error_code error;
    if (this->Stream)
    {
      std::filesystem::rename(this->Partial, this->Name, error);
    }
    if (!this->Stream || error)
    {
      throw WriteError(vtkErrorCode::OutOfDiskSpaceError,
        "The file " + this->Name.string() +
          " can't be written: " + (error ? error.message() : "the disk may be full") + ".");
    }
    this->Exists = false;
  }

  std::ofstream Stream;

private:
  std::filesystem::path Name;
  std::filesystem::path Partial;
  bool Exists = false;
};
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
    if (!this->FileName || !*this->FileName)
    {
      throw WriteError(vtkErrorCode::NoFileNameError, "There is no file name. Set one.");
    }
    const Voxels voxels(this->GetInput());
    voxels.Check();
    NewFile file(this->FileName, this->InPlace);
    file.Stream << MakeHeader(voxels.Grid);
    bool aborted = false;
    const auto progress = [&](double fraction)
    {
      this->UpdateProgress(fraction);
      aborted = this->GetAbortExecute() != 0;
      return !aborted && file.Stream;
    };
    voxels.Read(
      [&](const std::uint32_t* words) { WriteRuns(words, voxels.Grid, file.Stream, progress); });
    if (!aborted)
    {
      file.Commit();
    }
  }
  catch (const WriteError& error)
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
