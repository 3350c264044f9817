// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageOutput.h"

#include "FileNames.h"
#include "Messages.h"
#include "OutputFile.h"
#include "StagedFiles.h"
#include "Terminal.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkXMLImageDataWriter.h"
#include "vtkZLibDataCompressor.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

namespace
{
/// Voxels compress so well that more effort buys nothing.
constexpr int CompressionLevel = 1;

template <typename Values>
void PrintNumbers(std::ostream& out, const char* key, const Values& values)
{
  out << key << " =";
  for (const auto value : values)
  {
    out << " " << value;
  }
  out << "\n";
}

/// The text before the data; coordinates are those of the first voxel, columns of the direction.
std::string MakeMetaImageHeader(
  vtkImageData* image, vtkIdType compressedSize, const std::string& dataFile)
{
  std::array<int, 6> extent;
  image->GetExtent(extent.data());
  std::array<double, 3> first;
  image->TransformIndexToPhysicalPoint(extent[0], extent[2], extent[4], first.data());
  std::array<double, 9> columns;
  vtkMatrix3x3::Transpose(image->GetDirectionMatrix()->GetData(), columns.data());
  std::array<int, 3> dimensions;
  image->GetDimensions(dimensions.data());
  std::array<double, 3> spacing;
  image->GetSpacing(spacing.data());

  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(std::numeric_limits<double>::max_digits10);
  out << "ObjectType = Image\n"
         "NDims = 3\n"
         "BinaryData = True\n"
         "BinaryDataByteOrderMSB = False\n"
         "CompressedData = True\n";
  out << "CompressedDataSize = " << compressedSize << "\n";
  PrintNumbers(out, "TransformMatrix", columns);
  PrintNumbers(out, "Offset", first);
  PrintNumbers(out, "CenterOfRotation", std::array<int, 3>{ 0, 0, 0 });
  PrintNumbers(out, "ElementSpacing", spacing);
  PrintNumbers(out, "DimSize", dimensions);
  out << "ElementType = MET_UCHAR\n"
         "ElementDataFile = "
      << dataFile << "\n";
  return out.str();
}

/// Whether the file ends as an XML file of VTK does; its writer doesn't notice all failures.
bool IsCompleteXML(const std::string& file)
{
  constexpr const char* end = "</VTKFile>\n";
  const auto length = static_cast<std::streamoff>(std::strlen(end));
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(-length, std::ios::end);
  std::string tail(std::strlen(end), '\0');
  stream.read(tail.data(), length);
  return stream && tail == end;
}
}

ImageOutput::ImageOutput(const std::string& target, StagedFiles& files)
  : Target(target)
  , Extension(FileNames::GetExtension(target))
{
  if (this->Extension == ".nrrd" || this->Extension == ".nhdr")
  {
    this->Refuse("VTK has no writer for NRRD; possible are " + ImageOutput::GetExtensions());
  }
  if (this->Extension != ".vti" && this->Extension != ".mha" && this->Extension != ".mhd")
  {
    this->Refuse(
      (this->Extension.empty() ? "its name has no extension"
                               : "images of type " + this->Extension + " are not known") +
      "; possible are " + ImageOutput::GetExtensions());
  }
  if (this->Extension == ".mhd")
  {
    // First, so that the header never stands there without its data.
    this->DataFile = files.Add(std::filesystem::path(target).replace_extension(".zraw").string());
  }
  this->File = files.Add(target);
}

void ImageOutput::Refuse(const std::string& why) const
{
  OutputFile::Refuse(this->Target, why);
}

void ImageOutput::Write(vtkImageData* image, Messages& messages, Terminal& terminal) const
{
  if (this->Extension == ".vti")
  {
    this->WriteXML(image, messages, terminal);
  }
  else
  {
    terminal.ShowProgress("writing", 0.0);
    this->WriteMetaImage(image);
    terminal.ShowProgress("writing", 1.0);
  }
}

void ImageOutput::WriteXML(vtkImageData* image, Messages& messages, Terminal& terminal) const
{
  vtkNew<vtkZLibDataCompressor> compressor;
  compressor->SetCompressionLevel(CompressionLevel);
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetFileName(this->File.c_str());
  writer->SetInputData(image);
  writer->SetCompressor(compressor);
  writer->EncodeAppendedDataOff();
  terminal.Watch(writer, "writing");
  errno = 0;
  const bool written = writer->Write() != 0;
  const int error = errno;
  const std::string reason = messages.TakeReason();
  const auto code = writer->GetErrorCode();
  if (code == vtkErrorCode::OutOfDiskSpaceError || (written && !IsCompleteXML(this->File)))
  {
    this->Refuse(OutputFile::Describe(error));
  }
  if (!written || code != vtkErrorCode::NoError)
  {
    this->Refuse(reason.empty() ? vtkErrorCode::GetStringFromErrorCode(code) : reason);
  }
}

void ImageOutput::WriteMetaImage(vtkImageData* image) const
{
  auto* voxels = vtkUnsignedCharArray::SafeDownCast(image->GetPointData()->GetScalars());
  vtkNew<vtkZLibDataCompressor> compressor;
  compressor->SetCompressionLevel(CompressionLevel);
  vtkSmartPointer<vtkUnsignedCharArray> compressed;
  compressed.TakeReference(
    compressor->Compress(voxels->GetPointer(0), voxels->GetNumberOfValues()));
  if (!compressed)
  {
    this->Refuse("there is no memory to compress it");
  }

  const bool hasTwoFiles = !this->DataFile.empty();
  const std::string dataName = hasTwoFiles
    ? std::filesystem::path(this->Target).replace_extension(".zraw").filename().string()
    : "LOCAL";
  const std::string header = MakeMetaImageHeader(image, compressed->GetNumberOfValues(), dataName);

  OutputFile file(this->File, this->Target);
  file.Append(header.data(), header.size());
  if (hasTwoFiles)
  {
    file.Close();
    file = OutputFile(this->DataFile, this->Target);
  }
  file.Append(compressed->GetPointer(0), compressed->GetNumberOfValues());
  file.Close();
}

bool ImageOutput::HasBits(const std::string& target)
{
  return ImageOutput::HasCells(target);
}

bool ImageOutput::HasCells(const std::string& target)
{
  const std::string extension = FileNames::GetExtension(target);
  return extension != ".mha" && extension != ".mhd";
}

std::string ImageOutput::GetExtensions()
{
  return ".vti, .mha, .mhd";
}
