// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkImageFileSlabs.h"

#include "vtkNew.h"
#include "vtkSMPTools.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapImage.h"
#include "vtkType.h"
#include "vtkVoxelFileError.h"
#include "vtkZLibDataCompressor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <locale>
#include <map>
#include <sstream>
#include <string>

namespace
{
constexpr std::int64_t BlockBytes = 1 << 16;
constexpr std::int64_t BytesAtOnce = 1 << 21; // of values
constexpr std::int64_t BitsPerByte = 8;

/// Voxels compress so well that more effort buys nothing.
constexpr int CompressionLevel = 1;

template <typename Values>
std::string Join(const Values& values)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(std::numeric_limits<double>::max_digits10);
  for (const auto value : values)
  {
    text << (text.tellp() > 0 ? " " : "") << value;
  }
  return text.str();
}

const char* GetByteOrder()
{
  const std::uint16_t one = 1;
  unsigned char first;
  std::memcpy(&first, &one, 1);
  return first ? "LittleEndian" : "BigEndian";
}

std::string MakeHeader(const vtkVoxelGrid& whole, const vtkImageFileSlabs::Settings& settings)
{
  const vtkVoxelGrid image = settings.AreCells ? whole.VoxelsToCells() : whole;
  const std::string extent = Join(image.Extent);
  const std::string attributes = settings.AreCells ? "CellData" : "PointData";
  const std::string others = settings.AreCells ? "PointData" : "CellData";
  std::ostringstream header;
  header.imbue(std::locale::classic());
  header << "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"" << GetByteOrder()
         << "\" header_type=\"UInt64\""
         << (settings.IsCompressed ? " compressor=\"vtkZLibDataCompressor\"" : "") << ">\n"
         << "  <ImageData WholeExtent=\"" << extent << "\" Origin=\""
         << Join(std::array<double, 3>{ image.Origin.x, image.Origin.y, image.Origin.z })
         << "\" Spacing=\""
         << Join(std::array<double, 3>{ image.Spacing.x, image.Spacing.y, image.Spacing.z })
         << "\" Direction=\"" << Join(image.GetDirectionRows()) << "\">\n"
         << "    <Piece Extent=\"" << extent << "\">\n"
         << "      <" << attributes << " Scalars=\"" << vtkSlicemapImage::ArrayName << "\">\n"
         << "        <DataArray type=\"" << (settings.ScalarType == VTK_BIT ? "Bit" : "UInt8")
         << "\" Name=\"" << vtkSlicemapImage::ArrayName << "\" format=\"appended\" offset=\"0\"/>\n"
         << "      </" << attributes << ">\n"
         << "      <" << others << ">\n"
         << "      </" << others << ">\n"
         << "    </Piece>\n"
         << "  </ImageData>\n"
         << "  <AppendedData encoding=\"raw\">\n"
         << "   _";
  return header.str();
}

std::int64_t GetBytesOfVoxels(std::int64_t voxels, int scalarType)
{
  return scalarType == VTK_BIT ? (voxels + BitsPerByte - 1) / BitsPerByte : voxels;
}

void WriteNumbers(std::ostream& stream, const std::vector<std::uint64_t>& numbers)
{
  stream.write(reinterpret_cast<const char*>(numbers.data()),
    static_cast<std::streamsize>(numbers.size() * sizeof(std::uint64_t)));
}

bool HoldsOneValue(const unsigned char* bytes, std::int64_t count)
{
  return std::memcmp(bytes, bytes + 1, static_cast<std::size_t>(count - 1)) == 0;
}

using Block = std::vector<unsigned char>;

/// Empty when that fails.
Block Compress(const unsigned char* bytes, std::int64_t count)
{
  vtkNew<vtkZLibDataCompressor> compressor;
  compressor->SetCompressionLevel(CompressionLevel);
  const auto size = static_cast<std::size_t>(count);
  Block packed(compressor->GetMaximumCompressionSpace(size));
  packed.resize(compressor->Compress(bytes, size, packed.data(), packed.size()));
  return packed;
}
}

/// Most blocks are the same byte over and over, and are packed once.
struct vtkImageFileSlabs::Packed
{
  std::map<unsigned char, Block> OfOneValue; // whole blocks
  std::vector<Block> Others;                 // empty where a block is none of them
};

vtkImageFileSlabs::vtkImageFileSlabs(
  std::ostream& stream, const vtkVoxelGrid& whole, const Settings& settings)
  : Stream(stream)
  , Options(settings)
  , TotalBytes(GetBytesOfVoxels(whole.GetNumberOfVoxels(), settings.ScalarType))
  , Blocks(std::make_unique<Packed>())
{
  const glm::ivec3 n = whole.GetDimensions();
  this->SliceBytes = GetBytesOfVoxels(std::int64_t(n.x) * n.y, settings.ScalarType);
  const std::int64_t slices = std::clamp<std::int64_t>(BytesAtOnce / this->SliceBytes, 1, n.z);
  const int multiple = this->GetMultiple();
  this->SlicesAtOnce = static_cast<int>((slices + multiple - 1) / multiple * multiple);
  this->Stream << MakeHeader(whole, settings);
  if (settings.IsCompressed)
  {
    const std::int64_t blocks = (this->TotalBytes + BlockBytes - 1) / BlockBytes;
    this->Sizes = { static_cast<std::uint64_t>(blocks), BlockBytes,
      static_cast<std::uint64_t>(this->TotalBytes % BlockBytes) };
    this->SizesPosition = this->Stream.tellp();
    WriteNumbers(this->Stream, std::vector<std::uint64_t>(this->Sizes.size() + blocks));
  }
  else
  {
    WriteNumbers(this->Stream, { static_cast<std::uint64_t>(this->TotalBytes) });
  }
}

vtkImageFileSlabs::~vtkImageFileSlabs() = default;

int vtkImageFileSlabs::GetMultiple() const
{
  return this->Options.ScalarType == VTK_BIT ? BitsPerByte : 1;
}

std::int64_t vtkImageFileSlabs::GetBytes() const
{
  const std::int64_t values = this->SlicesAtOnce * this->SliceBytes + BlockBytes;
  const auto sizes =
    static_cast<std::int64_t>(this->TotalBytes / BlockBytes * sizeof(std::uint64_t));
  return this->Options.IsCompressed ? 2 * values + sizes : values;
}

bool vtkImageFileSlabs::Add(
  const std::uint32_t* words, const vtkVoxelGrid& slab, const Progress& progress)
{
  const int slices = slab.GetDimensions().z;
  const std::int64_t sliceWords = vtkSlicemap::GetNumberOfWords(slab) / slices;
  for (int first = 0; first < slices; first += this->SlicesAtOnce)
  {
    if (!progress(double(first) / slices) || !this->Stream)
    {
      return false;
    }
    this->AppendValues(words + first * sliceWords, slab.WithSlices(first, this->SlicesAtOnce));
  }
  return true;
}

void vtkImageFileSlabs::AppendValues(const std::uint32_t* words, const vtkVoxelGrid& slices)
{
  const std::int64_t bytes = GetBytesOfVoxels(slices.GetNumberOfVoxels(), this->Options.ScalarType);
  this->Values.resize(std::max<std::size_t>(
    this->Values.size(), static_cast<std::size_t>(this->NumberOfValues + bytes)));
  unsigned char* const end = this->Values.data() + this->NumberOfValues;
  if (this->Options.ScalarType == VTK_BIT)
  {
    vtkSlicemapImage::ExpandToBits(words, slices, end);
  }
  else
  {
    vtkSlicemapImage::Expand(words, slices, this->Options.ForegroundValue, end);
  }
  this->NumberOfValues += bytes;
  if (this->Options.IsCompressed)
  {
    this->WriteBlocks(this->NumberOfValues / BlockBytes * BlockBytes);
  }
  else
  {
    this->Stream.write(reinterpret_cast<const char*>(this->Values.data()), this->NumberOfValues);
    this->NumberOfValues = 0;
  }
}

void vtkImageFileSlabs::WriteBlocks(std::int64_t bytes)
{
  const unsigned char* const values = this->Values.data();
  const std::int64_t blocks = (bytes + BlockBytes - 1) / BlockBytes;
  Packed& packed = *this->Blocks;
  packed.Others.assign(static_cast<std::size_t>(blocks), {});
  std::vector<char> isCommon(static_cast<std::size_t>(blocks));
  vtkSMPTools::For(0, blocks,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const unsigned char* const block = values + i * BlockBytes;
        const std::int64_t size = std::min<std::int64_t>(BlockBytes, bytes - i * BlockBytes);
        isCommon[i] = size == BlockBytes && HoldsOneValue(block, size);
        if (!isCommon[i])
        {
          packed.Others[i] = Compress(block, size);
        }
      }
    });
  for (std::int64_t i = 0; i < blocks; ++i)
  {
    const unsigned char* const first = values + i * BlockBytes;
    if (isCommon[i] && packed.OfOneValue[*first].empty())
    {
      packed.OfOneValue[*first] = Compress(first, BlockBytes);
    }
    const Block& block = isCommon[i] ? packed.OfOneValue[*first] : packed.Others[i];
    if (block.empty())
    {
      throw vtkVoxelFileError(vtkErrorCode::UserError, "The voxels could not be compressed.");
    }
    this->Sizes.push_back(block.size());
    this->Stream.write(
      reinterpret_cast<const char*>(block.data()), static_cast<std::streamsize>(block.size()));
  }
  std::copy(values + bytes, values + this->NumberOfValues, this->Values.data());
  this->NumberOfValues -= bytes;
}

bool vtkImageFileSlabs::Finish(const Progress&)
{
  if (this->Options.IsCompressed)
  {
    this->WriteBlocks(this->NumberOfValues);
  }
  this->Stream << "\n  </AppendedData>\n</VTKFile>\n";
  if (this->Options.IsCompressed)
  {
    this->Stream.seekp(this->SizesPosition);
    WriteNumbers(this->Stream, this->Sizes);
  }
  return true;
}
