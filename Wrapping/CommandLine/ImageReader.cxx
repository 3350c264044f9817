// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageReader.h"

#include "FileNames.h"
#include "InputFile.h"
#include "MemoryLimit.h"
#include "Messages.h"
#include "Terminal.h"

#include "vtkBinvoxReader.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkMetaImageReader.h"
#include "vtkNIFTIImageReader.h"
#include "vtkNew.h"
#include "vtkNrrdReader.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredPointsReader.h"
#include "vtkVoxelBitsReader.h"
#include "vtkVoxelGrid.h"
#include "vtkXMLImageDataReader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

namespace
{
/// The direction matrix, row by row.
using Direction = std::array<double, 9>;
constexpr Direction Identity = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };

template <typename Reader>
vtkSmartPointer<vtkAlgorithm> MakeReader(const std::string& file)
{
  auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName(file.c_str());
  return reader;
}

/// The numbers of the line of a header that begins with the key; none when there is no such line.
std::vector<double> ReadNumbers(
  const std::string& file, const std::string& key, const std::string& lastKey)
{
  std::ifstream header(file, std::ios::binary);
  for (std::string line; std::getline(header, line);)
  {
    const auto end = line.find_first_of("=:");
    std::string found = line.substr(0, end);
    found.erase(found.find_last_not_of(" \t\r") + 1);
    if (found == lastKey)
    {
      break;
    }
    if (found != key || end == std::string::npos)
    {
      continue;
    }
    std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
    std::vector<double> numbers;
    std::istringstream words(line.substr(end + 1));
    for (std::string word; words >> word;)
    {
      if (word != "none") // the axis of colors
      {
        numbers.push_back(std::strtod(word.c_str(), nullptr));
      }
    }
    return numbers;
  }
  return {};
}

/// Gives the image directions along the columns of nine numbers, whatever their lengths.
void SetColumns(vtkImageData* image, const std::vector<double>& numbers)
{
  Direction direction = Identity;
  if (numbers.size() == direction.size())
  {
    for (const int axis : { 0, 1, 2 })
    {
      const double* column = numbers.data() + std::ptrdiff_t(3) * axis;
      const double length = std::hypot(column[0], column[1], column[2]);
      for (const int row : { 0, 1, 2 })
      {
        direction[3 * row + axis] = column[row] / length;
      }
    }
  }
  image->SetDirectionMatrix(direction.data());
}

// VTK's readers of these three formats leave the direction out.
void OrientMetaImage(vtkAlgorithm*, const std::string& file, vtkImageData* image)
{
  for (const char* key : { "TransformMatrix", "Rotation", "Orientation" })
  {
    const auto numbers = ReadNumbers(file, key, "ElementDataFile");
    if (!numbers.empty())
    {
      SetColumns(image, numbers);
      return;
    }
  }
}

void OrientNrrd(vtkAlgorithm*, const std::string& file, vtkImageData* image)
{
  SetColumns(image, ReadNumbers(file, "space directions", ""));
}

/// The matrix, from millimetres along the axes to space, is the sform or else the qform.
void OrientNifti(vtkAlgorithm* algorithm, const std::string&, vtkImageData* image)
{
  auto* reader = vtkNIFTIImageReader::SafeDownCast(algorithm);
  vtkMatrix4x4* matrix = reader->GetSFormMatrix();
  matrix = matrix ? matrix : reader->GetQFormMatrix();
  if (!matrix)
  {
    return;
  }
  std::vector<double> columns;
  std::array<double, 3> spacing;
  image->GetSpacing(spacing.data());
  for (const int axis : { 0, 1, 2 })
  {
    const double column[] = { matrix->GetElement(0, axis), matrix->GetElement(1, axis),
      matrix->GetElement(2, axis) };
    spacing[axis] *= std::hypot(column[0], column[1], column[2]);
    columns.insert(columns.end(), std::begin(column), std::end(column));
  }
  image->SetSpacing(spacing.data());
  image->SetOrigin(matrix->GetElement(0, 3), matrix->GetElement(1, 3), matrix->GetElement(2, 3));
  SetColumns(image, columns);
}

/// VTK's reader leaves the scalars as they are stored; a slope of zero stands for none.
void ScaleNifti(vtkAlgorithm* algorithm, vtkImageData* image)
{
  auto* reader = vtkNIFTIImageReader::SafeDownCast(algorithm);
  const double slope = reader->GetRescaleSlope();
  const double intercept = reader->GetRescaleIntercept();
  vtkDataArray* stored = image->GetPointData()->GetScalars();
  if (!stored || slope == 0.0 || (slope == 1.0 && intercept == 0.0))
  {
    return;
  }
  vtkNew<vtkDoubleArray> scaled;
  scaled->SetName(stored->GetName());
  scaled->SetNumberOfComponents(stored->GetNumberOfComponents());
  scaled->SetNumberOfTuples(stored->GetNumberOfTuples());
  const auto from = vtk::DataArrayValueRange(stored);
  auto to = vtk::DataArrayValueRange(scaled.Get());
  std::transform(
    from.begin(), from.end(), to.begin(), [&](double value) { return value * slope + intercept; });
  image->GetPointData()->SetScalars(scaled);
}

/// VTK's reader takes any text for a header, and any number of axes.
void CheckMetaImage(const std::string& file)
{
  constexpr double mostAxes = 4;
  const auto axes = ReadNumbers(file, "NDims", "ElementDataFile");
  if (axes.empty() || !(axes[0] >= 2 && axes[0] <= mostAxes))
  {
    InputFile::Refuse(file, "it has no header of a MetaImage of 2 to 4 axes");
  }
}

/// The field that a line of a header of NRRD gives; a key of the user's own is "="; empty for
/// anything else.
std::string GetNrrdField(const std::string& line)
{
  const bool isText = std::none_of(line.begin(), line.end(),
    [](unsigned char c) { return std::iscntrl(c) && c != '\t' && c != '\r'; });
  const auto end = line.find(':');
  if (!isText || end == std::string::npos)
  {
    return {};
  }
  return line[end + 1] == '=' ? "=" : line.substr(0, end);
}

/// VTK's reader waits for ever for the end of a header that has no end, or fields unknown to it.
void CheckNrrd(const std::string& file)
{
  const std::set<std::string> known = { "=", "dimension", "type", "block size", "blocksize",
    "encoding", "endian", "content", "old min", "oldmin", "old max", "oldmax", "min", "max",
    "data file", "datafile", "line skip", "lineskip", "byte skip", "byteskip", "number",
    "sample units", "sampleunits", "sizes", "spacings", "thicknesses", "axis mins", "axismins",
    "axis maxs", "axismaxs", "centers", "centerings", "labels", "units", "kinds", "space",
    "space dimension", "space units", "space origin", "space directions", "measurement frame" };
  std::ifstream header(file, std::ios::binary);
  std::string line;
  std::getline(header, line);
  if (line.rfind("NRRD000", 0) != 0)
  {
    InputFile::Refuse(file, "it has no header of an NRRD file");
  }
  while (!header.eof() && std::getline(header, line) && !line.empty() && line != "\r")
  {
    if (line.front() != '#' && known.count(GetNrrdField(line)) == 0)
    {
      InputFile::Refuse(file, "its header has a line that is no field of an NRRD file");
    }
  }
  if (header.eof() && !line.empty())
  {
    InputFile::Refuse(file, "it is truncated: its header has no end");
  }
  const auto sizes = ReadNumbers(file, "sizes", "");
  const auto dimension = ReadNumbers(file, "dimension", "");
  if (sizes.empty() || dimension.empty() || dimension[0] != static_cast<double>(sizes.size()) ||
    !std::all_of(sizes.begin(), sizes.end(), [](double size) { return size >= 1; }))
  {
    InputFile::Refuse(file, "its header has no sizes for all of its dimensions");
  }
}

/// VTK's reader trusts numbers of a header that is none.
void CheckNifti(const std::string& file)
{
  constexpr std::streamoff magicOfFirst = 344;
  constexpr std::streamoff magicOfSecond = 4;
  std::ifstream stream(file, std::ios::binary);
  const auto has = [&](std::streamoff offset, const char* magic)
  {
    std::array<char, 3> found{};
    stream.clear();
    stream.seekg(offset);
    stream.read(found.data(), found.size());
    return std::equal(found.begin(), found.end(), magic);
  };
  if (!has(magicOfFirst, "n+1") && !has(magicOfSecond, "n+2"))
  {
    InputFile::Refuse(file, "it has no header of a NIfTI file");
  }
}

struct Format
{
  const char* Extension;
  vtkSmartPointer<vtkAlgorithm> (*MakeReader)(const std::string& file);
  /// Finds what the reader would not survive or not notice.
  void (*Check)(const std::string& file);
  /// Completes the geometry that the reader gives.
  void (*Orient)(vtkAlgorithm* reader, const std::string& file, vtkImageData* image);
  bool HasDataElsewhere = false;
  /// Turns what is stored into what it stands for.
  void (*Scale)(vtkAlgorithm* reader, vtkImageData* image) = nullptr;
};

constexpr char LegacyExtension[] = ".vtk";

constexpr Format Formats[] = {
  { ".vti", MakeReader<vtkXMLImageDataReader>, nullptr, nullptr },
  { ".mha", MakeReader<vtkMetaImageReader>, CheckMetaImage, OrientMetaImage },
  { ".mhd", MakeReader<vtkMetaImageReader>, CheckMetaImage, OrientMetaImage, true },
  { ".nrrd", MakeReader<vtkNrrdReader>, CheckNrrd, OrientNrrd },
  { ".nhdr", MakeReader<vtkNrrdReader>, CheckNrrd, OrientNrrd, true },
  { ".nii", MakeReader<vtkNIFTIImageReader>, CheckNifti, OrientNifti, false, ScaleNifti },
  { ".nii.gz", MakeReader<vtkNIFTIImageReader>, nullptr, OrientNifti, false, ScaleNifti },
  { ".binvox", MakeReader<vtkBinvoxReader>, nullptr, nullptr },
  { ".bits", MakeReader<vtkVoxelBitsReader>, nullptr, nullptr },
  { LegacyExtension, MakeReader<vtkStructuredPointsReader>, nullptr, nullptr },
};

/// Null where the extension is not known.
const Format* FindFormat(const std::string& file)
{
  std::string extension = FileNames::GetExtension(file);
  if (extension == ".gz")
  {
    extension = FileNames::GetExtension(std::filesystem::path(file).stem().string()) + extension;
  }
  const auto* const found = std::find_if(std::begin(Formats), std::end(Formats),
    [&](const Format& known) { return extension == known.Extension; });
  return found == std::end(Formats) ? nullptr : found;
}

/// The format of a file that can be read.
const Format& CheckFormat(const std::string& file)
{
  InputFile::CheckReadable(file);
  const Format* const format = FindFormat(file);
  if (!format)
  {
    InputFile::Refuse(file, "an image is one of " + ImageReader::GetExtensions());
  }
  if (format->Check)
  {
    format->Check(file);
  }
  return *format;
}

/// What the reader says of the geometry, before it reads the arrays.
vtkSmartPointer<vtkImageData> ReadGeometryBy(
  const Format& format, vtkAlgorithm* reader, const std::string& file, Messages& messages)
{
  reader->UpdateInformation();
  vtkInformation* information = reader->GetOutputInformation(0);
  std::array<int, 6> extent = { 0, -1, 0, -1, 0, -1 };
  if (information->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
  {
    information->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent.data());
  }
  const std::string reason = messages.TakeReason();
  if (extent[0] > extent[1] || extent[2] > extent[3] || extent[4] > extent[5])
  {
    InputFile::Refuse(file, reason.empty() ? "there is no image in it" : reason);
  }

  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(extent.data());
  if (information->Has(vtkDataObject::SPACING()))
  {
    image->SetSpacing(information->Get(vtkDataObject::SPACING()));
  }
  if (information->Has(vtkDataObject::ORIGIN()))
  {
    image->SetOrigin(information->Get(vtkDataObject::ORIGIN()));
  }
  if (information->Has(vtkDataObject::DIRECTION()))
  {
    image->SetDirectionMatrix(information->Get(vtkDataObject::DIRECTION()));
  }
  if (format.Orient)
  {
    format.Orient(reader, file, image);
  }
  return image;
}

bool HasScalars(vtkDataSetAttributes* data, vtkIdType count)
{
  vtkDataArray* scalars = data->GetScalars();
  return scalars && scalars->GetNumberOfTuples() == count;
}
}

vtkSmartPointer<vtkImageData> ImageReader::ReadGeometry(const std::string& file, Messages& messages)
{
  const Format& format = CheckFormat(file);
  return ReadGeometryBy(format, format.MakeReader(file), file, messages);
}

vtkSmartPointer<vtkImageData> ImageReader::Read(
  const std::string& file, Messages& messages, Terminal& terminal)
{
  const Format& format = CheckFormat(file);
  try
  {
    std::optional<MemoryLimit> limit;
    if (!format.HasDataElsewhere)
    {
      limit.emplace(file);
    }
    const auto reader = format.MakeReader(file);
    const auto geometry = ReadGeometryBy(format, reader, file, messages);
    terminal.Watch(reader, "reading");
    reader->Update();
    const std::string reason = messages.TakeReason();
    if (!reason.empty())
    {
      InputFile::Refuse(file, reason);
    }
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->ShallowCopy(reader->GetOutputDataObject(0));
    vtkVoxelGrid::FromImage(geometry).ApplyTo(image);
    if (!HasScalars(image->GetPointData(), image->GetNumberOfPoints()) &&
      !HasScalars(image->GetCellData(), image->GetNumberOfCells()))
    {
      InputFile::Refuse(file, "its points have no scalars, nor have its cells");
    }
    if (format.Scale)
    {
      format.Scale(reader, image);
    }
    return image;
  }
  catch (const Failure&)
  {
    throw;
  }
  catch (const std::exception&)
  {
    InputFile::Refuse(file, "it is damaged, or takes more memory than there is");
  }
}

bool ImageReader::IsImage(const std::string& file)
{
  const Format* const format = FindFormat(file);
  return format && format->Extension != LegacyExtension;
}

std::string ImageReader::GetExtensions()
{
  return ImageReader::GetImageExtensions() + ", " + LegacyExtension;
}

std::string ImageReader::GetImageExtensions()
{
  std::string extensions;
  for (const Format& format : Formats)
  {
    if (format.Extension != LegacyExtension)
    {
      extensions += (extensions.empty() ? "" : ", ") + std::string(format.Extension);
    }
  }
  return extensions;
}
