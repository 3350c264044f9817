// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PngFileCheck.h"

#include "InputFile.h"

#include "vtkNew.h"
#include "vtkZLibDataCompressor.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <vector>

namespace
{
using Bytes = std::vector<unsigned char>;

constexpr unsigned char Signature[] = { 0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n' };
constexpr std::uint32_t LargestSide = 1000000; // as libpng has it
constexpr std::size_t LargestPalette = 768;
constexpr std::uint64_t BestCompression = 1100; // of zlib, rounded up

enum ColorType
{
  Gray = 0,
  Rgb = 2,
  Palette = 3,
  GrayAlpha = 4,
  Rgba = 6
};

/// The sum at the end of every chunk.
std::uint32_t ComputeCRC(const unsigned char* bytes, std::size_t count)
{
  constexpr std::uint32_t polynomial = 0xedb88320u;
  constexpr int bits = 8;
  std::uint32_t crc = ~0u;
  for (std::size_t i = 0; i < count; ++i)
  {
    crc ^= bytes[i];
    for (int bit = 0; bit < bits; ++bit)
    {
      crc = crc >> 1 ^ (crc & 1 ? polynomial : 0);
    }
  }
  return ~crc;
}

bool IsLetter(unsigned char character)
{
  return std::isalpha(character) != 0;
}

struct Header
{
  std::uint32_t Width;
  std::uint32_t Height;
  int Depth;
  int Color;
  bool Interlaced;

  bool HasKnownDepth() const
  {
    const bool isSmall = this->Depth == 1 || this->Depth == 2 || this->Depth == 4;
    switch (this->Color)
    {
      case Gray:
        return isSmall || this->Depth == 8 || this->Depth == 16;
      case Palette:
        return isSmall || this->Depth == 8;
      case Rgb:
      case GrayAlpha:
      case Rgba:
        return this->Depth == 8 || this->Depth == 16;
      default:
        return false;
    }
  }

  std::uint64_t GetBitsPerPixel() const
  {
    constexpr std::array<int, 7> channels = { 1, 0, 3, 1, 2, 0, 4 };
    return std::uint64_t(this->Depth) * channels[this->Color];
  }

  /// A row of pixels with its filter.
  std::uint64_t GetRowBytes(std::uint64_t width) const
  {
    return 1 + (width * this->GetBitsPerPixel() + 7) / 8;
  }
};

/// An image of every so many pixels, one of those that an interlaced file consists of.
struct Pass
{
  std::uint32_t FirstX;
  std::uint32_t FirstY;
  std::uint32_t StepX;
  std::uint32_t StepY;
};

constexpr Pass Whole[] = { { 0, 0, 1, 1 } };
constexpr Pass Adam7[] = { { 0, 0, 8, 8 }, { 4, 0, 8, 8 }, { 0, 4, 4, 8 }, { 2, 0, 4, 4 },
  { 0, 2, 2, 4 }, { 1, 0, 2, 2 }, { 0, 1, 1, 2 } };

std::uint32_t CountSteps(std::uint32_t size, std::uint32_t first, std::uint32_t step)
{
  return size > first ? (size - first + step - 1) / step : 0;
}

class PngFile
{
public:
  explicit PngFile(const std::string& file)
    : File(file)
  {
    std::ifstream stream(file, std::ios::binary);
    this->Content.assign(std::istreambuf_iterator<char>(stream), {});
  }

  void Check()
  {
    const std::size_t length = std::size(Signature);
    if (this->Content.size() < length ||
      !std::equal(std::begin(Signature), std::end(Signature), this->Content.begin()))
    {
      InputFile::Refuse(this->File, "it is no PNG file");
    }
    this->Position = length;
    this->ReadHeader(this->ReadChunk("IHDR"));
    while (!this->HasEnded)
    {
      this->CheckChunk();
    }
    this->CheckPixels();
  }

private:
  struct Chunk
  {
    std::string Name;
    const unsigned char* Data;
    std::uint32_t Size;
  };

  [[noreturn]] void RefuseDamage(const std::string& what) const
  {
    InputFile::Refuse(this->File, "it is damaged: " + what);
  }

  static std::uint32_t ReadNumber(const unsigned char* bytes)
  {
    return std::uint32_t(bytes[0]) << 24 | bytes[1] << 16 | bytes[2] << 8 | bytes[3];
  }

  Chunk ReadChunk(const std::string& wanted = {})
  {
    constexpr std::size_t around = 12; // size, name and sum
    constexpr std::size_t nameLength = 4;
    const std::size_t left = this->Content.size() - this->Position;
    const unsigned char* begin = this->Content.data() + this->Position;
    if (left < around || left - around < ReadNumber(begin))
    {
      InputFile::Refuse(this->File, "it is truncated");
    }
    const std::uint32_t size = ReadNumber(begin);
    const unsigned char* name = begin + 4;
    const unsigned char* data = name + nameLength;
    if (ReadNumber(data + size) != ComputeCRC(name, nameLength + size))
    {
      this->RefuseDamage("a chunk has another sum than it should");
    }
    this->Position += around + size;
    Chunk chunk{ std::string(name, data), data, size };
    if (!wanted.empty() && chunk.Name != wanted)
    {
      this->RefuseDamage("it does not begin with its header");
    }
    return chunk;
  }

  void ReadHeader(const Chunk& chunk)
  {
    constexpr std::uint32_t headerBytes = 13;
    if (chunk.Size != headerBytes)
    {
      this->RefuseDamage("its header has a wrong size");
    }
    const unsigned char* data = chunk.Data;
    this->Head = { ReadNumber(data), ReadNumber(data + 4), data[8], data[9], data[12] == 1 };
    const bool hasKnownMethods = data[10] == 0 && data[11] == 0 && data[12] <= 1;
    if (this->Head.Width == 0 || this->Head.Height == 0 || this->Head.Width > LargestSide ||
      this->Head.Height > LargestSide || !this->Head.HasKnownDepth() || !hasKnownMethods)
    {
      this->RefuseDamage("its header makes no sense");
    }
  }

  void CheckChunk()
  {
    const Chunk chunk = this->ReadChunk();
    const bool isName = std::all_of(chunk.Name.begin(), chunk.Name.end(), IsLetter);
    const bool isOptional = std::islower(static_cast<unsigned char>(chunk.Name[0])) != 0;
    const bool beginsPixels = this->Packed.empty();
    const bool isBehindPixels = !beginsPixels && this->Last != "IDAT";
    this->Last = chunk.Name;
    if (chunk.Name == "IDAT" && !isBehindPixels)
    {
      this->Packed.insert(this->Packed.end(), chunk.Data, chunk.Data + chunk.Size);
    }
    else if (chunk.Name == "IEND")
    {
      this->HasEnded = true;
    }
    else if (chunk.Name == "PLTE" && beginsPixels && !this->HasPalette)
    {
      this->HasPalette = chunk.Size > 0 && chunk.Size % 3 == 0 && chunk.Size <= LargestPalette;
    }
    else if (!isName || !isOptional)
    {
      this->RefuseDamage("it has a chunk that does not belong there");
    }
  }

  void CheckPixels()
  {
    if (this->Head.Color == Palette && !this->HasPalette)
    {
      this->RefuseDamage("it has no palette");
    }
    const Bytes rows = this->Unpack();
    std::size_t position = 0;
    this->ForEachPass(
      [&](std::uint64_t rowBytes, std::uint32_t count)
      {
        for (; count > 0; --count, position += rowBytes)
        {
          constexpr unsigned char lastFilter = 4;
          if (rows[position] > lastFilter)
          {
            this->RefuseDamage("its pixels make no sense");
          }
        }
      });
  }

  template <typename Function>
  void ForEachPass(const Function& function) const
  {
    const Pass* const begin = this->Head.Interlaced ? std::begin(Adam7) : std::begin(Whole);
    const Pass* const end = this->Head.Interlaced ? std::end(Adam7) : std::end(Whole);
    for (const Pass* pass = begin; pass != end; ++pass)
    {
      const auto width = CountSteps(this->Head.Width, pass->FirstX, pass->StepX);
      const auto height = CountSteps(this->Head.Height, pass->FirstY, pass->StepY);
      if (width > 0 && height > 0)
      {
        function(this->Head.GetRowBytes(width), height);
      }
    }
  }

  Bytes Unpack() const
  {
    std::uint64_t size = 0;
    this->ForEachPass(
      [&](std::uint64_t rowBytes, std::uint32_t count) { size += rowBytes * count; });
    if (size > BestCompression * this->Packed.size())
    {
      this->RefuseDamage("it has fewer pixels than its header says");
    }
    Bytes rows(size);
    vtkNew<vtkZLibDataCompressor> compressor;
    const std::size_t found =
      compressor->Uncompress(this->Packed.data(), this->Packed.size(), rows.data(), rows.size());
    if (found != size)
    {
      this->RefuseDamage("its pixels can't be unpacked");
    }
    return rows;
  }

  std::string File;
  Bytes Content;
  std::size_t Position = 0;
  std::string Last; // name of a chunk
  Header Head{};
  bool HasPalette = false;
  bool HasEnded = false;
  Bytes Packed;
};
}

void PngFileCheck::Check(const std::string& file)
{
  PngFile(file).Check();
}
