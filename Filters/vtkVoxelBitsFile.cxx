// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelBitsFile.h"

#include "vtkSMPTools.h"
#include "vtkSlicemap.h"
#include "vtkVoxelTextHeader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <stdexcept>

namespace
{
constexpr int ByteBits = 8;
constexpr int WordBits = 32;

using ReversedBytes = std::array<unsigned char, 256>;

/// Each byte with its bits in the opposite order: the first voxel is the highest bit of a file's
/// byte and the lowest one of a word.
ReversedBytes MakeReversedBytes()
{
  ReversedBytes table{};
  for (unsigned int byte = 0; byte < table.size(); ++byte)
  {
    for (int bit = 0; bit < ByteBits; ++bit)
    {
      table[byte] |= static_cast<unsigned char>((byte >> bit & 1) << (ByteBits - 1 - bit));
    }
  }
  return table;
}
}

std::string vtkVoxelBitsFile::MakeHeader() const
{
  const glm::ivec3 n = this->Grid.GetDimensions();
  const glm::ivec3 first = this->Grid.GetFirst();
  std::ostringstream header;
  header.imbue(std::locale::classic());
  header.precision(std::numeric_limits<double>::max_digits10);
  const auto line = [&](const char* key, const auto& v)
  { header << key << " " << v.x << " " << v.y << " " << v.z << "\n"; };
  header << Signature << "\n";
  line("dim", n);
  header << "variants " << this->NumberOfVariants << "\n"
         << "first " << this->FirstVariant << "\n"
         << "seed " << this->Seed << "\n";
  line("index", first);
  line("origin", this->Grid.Origin);
  line("spacing", this->Grid.Spacing);
  header << "direction";
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      header << " " << this->Grid.Direction[column][row];
    }
  }
  header << "\n";
  if (!this->Label.empty())
  {
    header << "label " << this->Label << "\n";
  }
  header << "data\n";
  return header.str();
}

vtkVoxelBitsFile vtkVoxelBitsFile::Read(std::istream& stream)
{
  std::array<std::int64_t, 3> dim{ 0, 0, 0 };
  std::array<std::int64_t, 1> variants{ 1 };
  std::array<std::int64_t, 1> firstVariant{ 0 };
  std::array<std::int64_t, 1> seed{ 0 };
  std::array<std::int64_t, 3> index{ 0, 0, 0 };
  std::array<double, 3> origin{ 0.0, 0.0, 0.0 };
  std::array<double, 3> spacing{ 1.0, 1.0, 1.0 };
  std::array<double, 9> direction{ 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 };
  const vtkVoxelTextHeader header(stream, Signature);
  header.Get("dim", dim);
  header.Get("variants", variants);
  header.Get("first", firstVariant);
  header.Get("seed", seed);
  header.Get("index", index);
  header.Get("origin", origin);
  header.Get("spacing", spacing);
  header.Get("direction", direction);

  constexpr std::int64_t longest = std::numeric_limits<int>::max() / 2;
  vtkVoxelBitsFile file;
  double voxels = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (dim[axis] < 1 || dim[axis] > longest || std::abs(double(index[axis])) > double(longest))
    {
      throw std::runtime_error("its dimensions are " + std::to_string(dim[0]) + " " +
        std::to_string(dim[1]) + " " + std::to_string(dim[2]) + ", from index " +
        std::to_string(index[axis]) + " on");
    }
    voxels *= double(dim[axis]);
    file.Grid.Extent[2 * axis] = static_cast<int>(index[axis]);
    file.Grid.Extent[2 * axis + 1] = static_cast<int>(index[axis] + dim[axis] - 1);
    file.Grid.Origin[axis] = origin[axis];
    file.Grid.Spacing[axis] = spacing[axis];
    for (int column = 0; column < 3; ++column)
    {
      file.Grid.Direction[column][axis] = direction[3 * axis + column];
    }
  }
  const auto isFinite = [](double x) { return std::isfinite(x); };
  const double determinant = glm::determinant(file.Grid.Direction);
  if (!std::all_of(origin.begin(), origin.end(), isFinite) ||
    !std::all_of(
      spacing.begin(), spacing.end(), [](double x) { return std::isfinite(x) && x > 0; }) ||
    !std::isfinite(determinant) || determinant == 0.0)
  {
    throw std::runtime_error("its origin, spacing or direction make no grid");
  }
  const auto begin = stream.tellg();
  stream.seekg(0, std::ios::end);
  const auto bytes = static_cast<double>(stream.tellg() - begin);
  stream.seekg(begin);
  if (variants[0] < 1 || double(variants[0]) * std::ceil(voxels / ByteBits) > bytes)
  {
    throw std::runtime_error("it has " + std::to_string(static_cast<std::int64_t>(bytes)) +
      " bytes of data, too few for " + std::to_string(variants[0]) + " variants of " +
      std::to_string(dim[0]) + " x " + std::to_string(dim[1]) + " x " + std::to_string(dim[2]) +
      " voxels");
  }
  file.NumberOfVariants = variants[0];
  file.FirstVariant = firstVariant[0];
  file.Seed = seed[0];
  file.Label = header.GetText("label");
  return file;
}

std::vector<unsigned char> vtkVoxelBitsFile::Pack(
  const std::uint32_t* words, const vtkVoxelGrid& grid)
{
  static const ReversedBytes reversed = MakeReversedBytes();
  const glm::ivec3 n = grid.GetDimensions();
  const std::int64_t rows = std::int64_t(n.y) * n.z;
  const std::int64_t wordsPerRow = vtkSlicemap::GetWordsPerRow(grid);
  std::vector<unsigned char> bytes((grid.GetNumberOfVoxels() + ByteBits - 1) / ByteBits, 0);
  // Bits of rows follow each other without a gap; those behind the last voxel of a row are zero.
  std::int64_t at = 0;
  for (std::int64_t row = 0; row < rows; ++row, at += n.x)
  {
    for (int x = 0; x < n.x; x += ByteBits)
    {
      const std::uint32_t word = words[row * wordsPerRow + x / WordBits];
      const unsigned int byte = reversed[word >> (x % WordBits) & 0xffu];
      const std::int64_t bit = at + x;
      const int shift = static_cast<int>(bit % ByteBits);
      bytes[bit / ByteBits] |= static_cast<unsigned char>(byte >> shift);
      const unsigned int rest = byte << (ByteBits - shift) & 0xffu;
      if (shift != 0 && rest != 0)
      {
        bytes[bit / ByteBits + 1] |= static_cast<unsigned char>(rest);
      }
    }
  }
  return bytes;
}

void vtkVoxelBitsFile::Unpack(
  const unsigned char* bytes, std::int64_t voxels, unsigned char* values)
{
  vtkSMPTools::For(0, voxels, 1 << 16,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        values[i] = bytes[i / ByteBits] >> (ByteBits - 1 - i % ByteBits) & 1;
      }
    });
}
