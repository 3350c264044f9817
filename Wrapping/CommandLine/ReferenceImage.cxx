// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceImage.h"

#include "FileNames.h"
#include "InputFile.h"
#include "Messages.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMatrix3x3.h"
#include "vtkMetaImageReader.h"
#include "vtkNrrdReader.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredPointsReader.h"
#include "vtkXMLImageDataReader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
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

/// The direction matrix whose columns are the nine numbers, made unit vectors.
Direction FromColumns(const std::vector<double>& numbers)
{
  Direction direction = Identity;
  if (numbers.size() != direction.size())
  {
    return direction;
  }
  for (const int axis : { 0, 1, 2 })
  {
    const double* column = numbers.data() + std::ptrdiff_t(3) * axis;
    const double length = std::hypot(column[0], column[1], column[2]);
    for (const int row : { 0, 1, 2 })
    {
      direction[3 * row + axis] = column[row] / length;
    }
  }
  return direction;
}

// VTK's readers of these two formats leave the direction out.
Direction ReadMetaImageDirection(const std::string& file)
{
  for (const char* key : { "TransformMatrix", "Rotation", "Orientation" })
  {
    const auto numbers = ReadNumbers(file, key, "ElementDataFile");
    if (!numbers.empty())
    {
      return FromColumns(numbers);
    }
  }
  return Identity;
}

Direction ReadNrrdDirection(const std::string& file)
{
  return FromColumns(ReadNumbers(file, "space directions", ""));
}

struct Format
{
  const char* Extension;
  vtkSmartPointer<vtkAlgorithm> (*MakeReader)(const std::string& file);
  Direction (*ReadDirection)(const std::string& file);
};

constexpr Format Formats[] = {
  { ".vti", MakeReader<vtkXMLImageDataReader>, nullptr },
  { ".mha", MakeReader<vtkMetaImageReader>, ReadMetaImageDirection },
  { ".mhd", MakeReader<vtkMetaImageReader>, ReadMetaImageDirection },
  { ".nrrd", MakeReader<vtkNrrdReader>, ReadNrrdDirection },
  { ".nhdr", MakeReader<vtkNrrdReader>, ReadNrrdDirection },
  { ".vtk", MakeReader<vtkStructuredPointsReader>, nullptr },
};
}

vtkSmartPointer<vtkImageData> ReferenceImage::Read(const std::string& file, Messages& messages)
{
  InputFile::CheckReadable(file);
  const std::string extension = FileNames::GetExtension(file);
  const auto* const format = std::find_if(std::begin(Formats), std::end(Formats),
    [&](const Format& known) { return extension == known.Extension; });
  if (format == std::end(Formats))
  {
    InputFile::Refuse(file, "a reference image is one of " + ReferenceImage::GetExtensions());
  }

  // VTK's reader takes any text for a header.
  const bool isMeta = extension == ".mha" || extension == ".mhd";
  if (isMeta && ReadNumbers(file, "NDims", "ElementDataFile").empty())
  {
    InputFile::Refuse(file, "it has no header of a MetaImage");
  }
  const auto reader = format->MakeReader(file);
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
  if (format->ReadDirection)
  {
    image->SetDirectionMatrix(format->ReadDirection(file).data());
  }
  else if (information->Has(vtkDataObject::DIRECTION()))
  {
    image->SetDirectionMatrix(information->Get(vtkDataObject::DIRECTION()));
  }
  return image;
}

std::string ReferenceImage::GetExtensions()
{
  std::string extensions;
  for (const Format& format : Formats)
  {
    extensions += (extensions.empty() ? "" : ", ") + std::string(format.Extension);
  }
  return extensions;
}
