// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBinvoxSlabs.h"

#include "vtkSlicemap.h"
#include "vtkVoxelFileError.h"

#include <algorithm>
#include <locale>
#include <sstream>
#include <string>

namespace
{
constexpr int WordBits = 32;
constexpr int RowBits = 128; // to which slicemaps pad their rows
constexpr std::size_t BlockBytes = 1 << 16;
constexpr std::int64_t LongestRun = 255;

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

std::int64_t GetRows(const vtkVoxelGrid& grid)
{
  const glm::ivec3 n = grid.GetDimensions();
  return std::int64_t(n.y) * n.z;
}
}

void vtkBinvoxSlabs::Check(const vtkVoxelGrid& grid)
{
  // The header has one scale and no axes.
  const bool hasPositiveSpacing = glm::all(glm::greaterThan(grid.Spacing, glm::dvec3(0.0)));
  if (!hasPositiveSpacing || !grid.HasCubicVoxels() || grid.Direction != glm::dmat3(1.0))
  {
    throw vtkVoxelFileError(vtkErrorCode::UserError,
      "A .binvox file has cubic voxels along the axes of the world, and this image is another "
      "one: " +
        grid.Describe() + ". Resample it, or write a .vti file.");
  }
}

vtkBinvoxSlabs::vtkBinvoxSlabs(std::ostream& stream, const vtkVoxelGrid& whole)
  : Stream(stream)
{
  this->Plane.resize(GetRows(whole));
  this->Bytes.reserve(BlockBytes);
  this->Stream << MakeHeader(whole);
}

int vtkBinvoxSlabs::GetBestMultiple() const
{
  return RowBits;
}

std::int64_t vtkBinvoxSlabs::GetBytes() const
{
  return static_cast<std::int64_t>(this->Plane.size() * sizeof(std::uint32_t) + BlockBytes);
}

bool vtkBinvoxSlabs::Add(
  const std::uint32_t* words, const vtkVoxelGrid& slab, const Progress& progress)
{
  const int n = slab.GetDimensions().x;
  const std::int64_t wordsPerRow = vtkSlicemap::GetWordsPerRow(slab);
  const std::int64_t rows = GetRows(slab);
  for (int x = 0; x < n; ++x)
  {
    if (x % WordBits == 0)
    {
      if (!progress(double(x) / n) || !this->Stream)
      {
        return false;
      }
      const std::uint32_t* word = words + x / WordBits;
      for (std::int64_t row = 0; row < rows; ++row)
      {
        this->Plane[row] = word[row * wordsPerRow];
      }
    }
    const int bit = x % WordBits;
    for (std::int64_t row = 0; row < rows;)
    {
      const std::uint32_t value = this->Plane[row] >> bit & 1;
      const std::int64_t begin = row;
      while (row < rows && (this->Plane[row] >> bit & 1) == value)
      {
        ++row;
      }
      this->Append(value != 0, row - begin);
    }
  }
  return true;
}

bool vtkBinvoxSlabs::Finish(const Progress&)
{
  this->FlushRun();
  this->FlushBytes();
  return true;
}

void vtkBinvoxSlabs::Append(bool value, std::int64_t count)
{
  if (value != this->Value)
  {
    this->FlushRun();
    this->Value = value;
  }
  this->Count += count;
}

void vtkBinvoxSlabs::FlushRun()
{
  while (this->Count > 0)
  {
    const std::int64_t count = std::min(this->Count, LongestRun);
    this->Bytes.push_back(this->Value ? 1 : 0);
    this->Bytes.push_back(static_cast<char>(static_cast<unsigned char>(count)));
    this->Count -= count;
    if (this->Bytes.size() >= BlockBytes)
    {
      this->FlushBytes();
    }
  }
}

void vtkBinvoxSlabs::FlushBytes()
{
  this->Stream.write(this->Bytes.data(), static_cast<std::streamsize>(this->Bytes.size()));
  this->Bytes.clear();
}
