// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelOutput.h"

#include "Failure.h"
#include "FileNames.h"
#include "Messages.h"
#include "Options.h"
#include "OutputFile.h"
#include "StagedFiles.h"
#include "Terminal.h"

#include "vtkBinvoxWriter.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkTetraCoveringVoxelizer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVoxelAlgorithm.h"
#include "vtkVoxelBitsWriter.h"
#include "vtkVoxelSlabWriter.h"
#include "vtkXMLHyperTreeGridWriter.h"
#include "vtkXMLImageDataWriter.h"
#include "vtkXMLPolyDataWriter.h"
#include "vtkZLibDataCompressor.h"

#ifdef VTKVOXELIZATION_HAS_OPENVDB
#include "vtkVDBVoxelWriter.h"
#endif

#include <algorithm>
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

template <typename Writer>
vtkSmartPointer<vtkXMLWriter> MakeWriter()
{
  return vtkSmartPointer<Writer>::New();
}

/// In version 2 of the format, VTK 9.1 writes several arrays over each other, and does not read
/// all components.
vtkSmartPointer<vtkXMLWriter> MakeOctreeWriter()
{
  auto writer = vtkSmartPointer<vtkXMLHyperTreeGridWriter>::New();
  writer->SetDataSetMajorVersion(1);
  writer->SetDataSetMinorVersion(0);
  return writer;
}

struct Format
{
  const char* Extension;
  VoxelOutput::Kind Kind;
  vtkSmartPointer<vtkXMLWriter> (*MakeWriter)(); // null for what is not XML
};

constexpr char BinvoxExtension[] = ".binvox";
constexpr char BitsExtension[] = ".bits";
constexpr char VDBExtension[] = ".vdb";

constexpr Format Formats[] = {
  { ".vti", VoxelOutput::Kind::Image, MakeWriter<vtkXMLImageDataWriter> },
  { ".mha", VoxelOutput::Kind::Image, nullptr },
  { ".mhd", VoxelOutput::Kind::Image, nullptr },
  { BinvoxExtension, VoxelOutput::Kind::Image, nullptr },
  { BitsExtension, VoxelOutput::Kind::Image, nullptr },
#ifdef VTKVOXELIZATION_HAS_OPENVDB
  { VDBExtension, VoxelOutput::Kind::Image, nullptr },
#endif
  { ".vtp", VoxelOutput::Kind::List, MakeWriter<vtkXMLPolyDataWriter> },
  { ".htg", VoxelOutput::Kind::Octree, MakeOctreeWriter },
};

/// Null where the extension is not known.
const Format* FindFormat(const std::string& file)
{
  const std::string extension = FileNames::GetExtension(file);
  const auto* const found = std::find_if(std::begin(Formats), std::end(Formats),
    [&](const Format& format) { return extension == format.Extension; });
  return found == std::end(Formats) ? nullptr : found;
}

/// Whether the format has room for more than which voxels are set.
bool IsXML(const std::string& file)
{
  const Format* const format = FindFormat(file);
  return !format || format->MakeWriter;
}

/**
 * The system's error number as it was when a writer of VTK failed; what VTK does afterwards may
 * leave another one.
 */
class WriterError
{
public:
  explicit WriterError(vtkXMLWriter* writer)
    : Writer(writer)
    , Tag(writer->AddObserver(vtkCommand::ModifiedEvent, this, &WriterError::Keep))
  {
    errno = 0;
  }
  ~WriterError() { this->Writer->RemoveObserver(this->Tag); }
  WriterError(const WriterError&) = delete;
  void operator=(const WriterError&) = delete;

  int GetNumber() const { return this->Number != 0 ? this->Number : errno; }

private:
  void Keep()
  {
    if (this->Number == 0 && this->Writer->GetErrorCode() != vtkErrorCode::NoError)
    {
      this->Number = errno;
    }
  }

  vtkXMLWriter* Writer;
  unsigned long Tag;
  int Number = 0;
};

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

VoxelOutput::VoxelOutput(const std::string& target, StagedFiles& files)
  : Target(target)
  , Extension(FileNames::GetExtension(target))
{
  if (this->Extension == ".nrrd" || this->Extension == ".nhdr")
  {
    this->Refuse("VTK has no writer for NRRD; possible are " + VoxelOutput::GetExtensions());
  }
  if (!FindFormat(target))
  {
    this->Refuse(
      (this->Extension.empty() ? "its name has no extension"
                               : "voxels of type " + this->Extension + " are not known") +
      "; possible are " + VoxelOutput::GetExtensions());
  }
  if (this->Extension == ".mhd")
  {
    // First, so that the header never stands there without its data.
    this->DataFile = files.Add(std::filesystem::path(target).replace_extension(".zraw").string());
  }
  this->File = files.Add(target);
}

void VoxelOutput::Refuse(const std::string& why) const
{
  OutputFile::Refuse(this->Target, why);
}

template <typename Writer, typename Work>
std::string VoxelOutput::RunWriter(Writer* writer, Messages& messages, const Work& work) const
{
  writer->SetFileName(this->File.c_str());
  writer->InPlaceOn();
  errno = 0;
  work();
  const int error = errno;
  const std::string reason = messages.TakeReason();
  const auto code = writer->GetErrorCode();
  if (code == vtkErrorCode::OutOfDiskSpaceError)
  {
    this->Refuse(OutputFile::Describe(error));
  }
  if (code != vtkErrorCode::NoError)
  {
    this->Refuse(reason);
  }
  return reason;
}

template <typename Writer>
void VoxelOutput::WriteInPlace(vtkDataObject* voxels, Messages& messages, Terminal& terminal) const
{
  vtkNew<Writer> writer;
  writer->SetInputDataObject(voxels);
  terminal.Watch(writer, "writing");
  this->RunWriter(writer.Get(), messages, [&] { writer->Write(); });
}

void VoxelOutput::WriteBatch(vtkTetraCoveringVoxelizer* voxelizer, vtkTypeInt64 first, int count,
  Messages& messages, Terminal& terminal) const
{
  vtkNew<vtkVoxelBitsWriter> writer;
  terminal.Watch(voxelizer, "voxelizing");
  bool finished = false;
  const std::string reason = this->RunWriter(
    writer.Get(), messages, [&] { finished = writer->WriteBatch(voxelizer, first, count); });
  if (!finished)
  {
    throw Failure(ExitCode::Voxelization, reason);
  }
}

void VoxelOutput::Write(vtkDataObject* voxels, Messages& messages, Terminal& terminal) const
{
  if (IsXML(this->Target))
  {
    this->WriteXML(voxels, messages, terminal);
  }
  else if (this->Extension == BinvoxExtension)
  {
    this->WriteInPlace<vtkBinvoxWriter>(voxels, messages, terminal);
  }
  else if (this->Extension == BitsExtension)
  {
    this->WriteInPlace<vtkVoxelBitsWriter>(voxels, messages, terminal);
  }
#ifdef VTKVOXELIZATION_HAS_OPENVDB
  else if (this->Extension == VDBExtension)
  {
    this->WriteInPlace<vtkVDBVoxelWriter>(voxels, messages, terminal);
  }
#endif
  else
  {
    terminal.ShowProgress("writing", 0.0);
    this->WriteMetaImage(vtkImageData::SafeDownCast(voxels));
    terminal.ShowProgress("writing", 1.0);
  }
}

std::int64_t VoxelOutput::WriteSlabs(
  vtkVoxelAlgorithm* voxels, const Options& options, Messages& messages, Terminal& terminal) const
{
  vtkNew<vtkVoxelSlabWriter> writer;
  writer->SetFileName(this->File.c_str());
  writer->InPlaceOn();
  writer->SetInputConnection(voxels->GetOutputPort());
  writer->SetMemoryLimit(options.MemoryLimit.value_or(0));
  writer->SetScalarType(options.ScalarType.value_or(writer->GetScalarType()));
  writer->SetForegroundValue(options.Value.value_or(writer->GetForegroundValue()));
  terminal.Watch(writer, "voxelizing");
  errno = 0;
  writer->Write();
  const int error = errno;
  switch (writer->GetErrorCode())
  {
    case vtkErrorCode::NoError:
      return writer->GetNumberOfFilledVoxels();
    case vtkErrorCode::OutOfDiskSpaceError:
      messages.TakeReason();
      this->Refuse(OutputFile::Describe(error));
    case vtkVoxelSlabWriter::MemoryLimitError:
    case vtkVoxelSlabWriter::UpstreamError:
      throw Failure(ExitCode::Voxelization, messages.TakeReason());
    default:
      this->Refuse(messages.TakeReason());
  }
}

void VoxelOutput::WriteXML(vtkDataObject* voxels, Messages& messages, Terminal& terminal) const
{
  vtkNew<vtkZLibDataCompressor> compressor;
  compressor->SetCompressionLevel(CompressionLevel);
  const auto writer = FindFormat(this->Target)->MakeWriter();
  writer->SetFileName(this->File.c_str());
  writer->SetInputDataObject(voxels);
  writer->SetCompressor(compressor);
  writer->EncodeAppendedDataOff();
  terminal.Watch(writer, "writing");
  const WriterError systemError(writer);
  const bool written = writer->Write() != 0;
  const int error = systemError.GetNumber();
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

void VoxelOutput::WriteMetaImage(vtkImageData* image) const
{
  auto* voxels = vtkUnsignedCharArray::SafeDownCast(image->GetPointData()->GetScalars());
  if (!voxels)
  {
    this->Refuse("it holds nothing but set voxels, and there are other values; write a .vti file");
  }
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

VoxelOutput::Kind VoxelOutput::GetKind(const std::string& target)
{
  const Format* const format = FindFormat(target);
  return format ? format->Kind : Kind::Image;
}

bool VoxelOutput::HasBits(const std::string& target)
{
  return VoxelOutput::HasCells(target);
}

bool VoxelOutput::HasCells(const std::string& target)
{
  return VoxelOutput::GetKind(target) == Kind::Image && IsXML(target);
}

bool VoxelOutput::HasAttributes(const std::string& target)
{
  return IsXML(target) || FileNames::GetExtension(target) == VDBExtension;
}

bool VoxelOutput::TakesSlicemap(const std::string& target)
{
  const std::string extension = FileNames::GetExtension(target);
  return extension == BinvoxExtension || extension == BitsExtension || extension == VDBExtension;
}

bool VoxelOutput::TakesVariants(const std::string& target)
{
  return FileNames::GetExtension(target) == BitsExtension;
}

bool VoxelOutput::TakesSlabs(const std::string& target)
{
  return vtkVoxelSlabWriter::GetFormatOfFile(target.c_str()) != vtkVoxelSlabWriter::FORMAT_AUTO;
}

std::string VoxelOutput::GetExtensionsOfSlabs()
{
  std::string extensions;
  for (const Format& format : Formats)
  {
    if (TakesSlabs(std::string("voxels") + format.Extension))
    {
      extensions += (extensions.empty() ? "" : ", ") + std::string(format.Extension);
    }
  }
  return extensions;
}

std::string VoxelOutput::GetExtensions()
{
  std::string extensions;
  for (const Format& format : Formats)
  {
    extensions += (extensions.empty() ? "" : ", ") + std::string(format.Extension);
  }
  return extensions;
}
