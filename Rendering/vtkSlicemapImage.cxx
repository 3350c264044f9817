// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSlicemapImage.h"

#include "vtkBitArray.h"
#include "vtkCellData.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkSlicemap.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelLargeArray.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bitset>
#include <cstring>

namespace
{
using vtkSlicemapImage::ByteTable;

constexpr int WordBits = 32;

template <vtkVoxelInitially Content>
void ExpandRow(const std::uint32_t* words, int n, const ByteTable& table, unsigned char* out)
{
  int x = 0;
  for (; x + WordBits <= n; x += WordBits, out += WordBits)
  {
    const std::uint32_t word = *words++;
    if (Content == vtkVoxelInitially::Zero && word == 0)
    {
      continue;
    }
    const std::array<std::uint64_t, 4> values{ table[word & 255], table[word >> 8 & 255],
      table[word >> 16 & 255], table[word >> 24] };
    std::memcpy(out, values.data(), WordBits);
  }
  for (int bit = 0; x < n; ++x, ++bit)
  {
    *out++ = static_cast<unsigned char>(table[*words >> bit & 1]);
  }
}

/// Into memory that holds what is said; where that are zeros, they are not written again.
template <vtkVoxelInitially Content>
void ExpandRows(const std::uint32_t* words, const vtkVoxelGrid& grid, int foregroundValue,
  const std::vector<unsigned char*>& outs)
{
  const glm::ivec3 n = grid.GetDimensions();
  const std::int64_t wordsPerRow = vtkSlicemap::GetWordsPerRow(grid);
  const std::int64_t rowsPerGrid = std::int64_t(n.y) * n.z;
  const ByteTable table = vtkSlicemapImage::MakeValueTable(foregroundValue);
  vtkSMPTools::For(0, rowsPerGrid * static_cast<std::int64_t>(outs.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (std::int64_t row = begin; row < end; ++row)
      {
        ExpandRow<Content>(
          words + row * wordsPerRow, n.x, table, outs[row / rowsPerGrid] + row % rowsPerGrid * n.x);
      }
    });
}

std::uint32_t ReversedBits(std::uint32_t x)
{
  x = (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
  x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
  x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
  x = (x >> 8 & 0x00ff00ffu) | (x & 0x00ff00ffu) << 8;
  return x >> 16 | x << 16;
}

/**
 * Rows one after the other without gaps, the most significant bit of a byte first, as vtkBitArray
 * has them. Begins at a byte's first bit.
 */
void ExpandRowsToBits(const std::uint32_t* words, std::int64_t wordsPerRow, std::int64_t rows,
  int n, unsigned char* out)
{
  std::uint64_t pending = 0;
  int count = 0;
  for (std::int64_t row = 0; row < rows; ++row, words += wordsPerRow)
  {
    for (int x = 0; x < n; x += WordBits)
    {
      const int bits = std::min(WordBits, n - x);
      const std::uint64_t reversed = ReversedBits(words[x / WordBits]) >> (WordBits - bits);
      pending = pending << bits | reversed;
      for (count += bits; count >= 8; count -= 8)
      {
        *out++ = static_cast<unsigned char>(pending >> (count - 8));
      }
    }
  }
  if (count)
  {
    *out = static_cast<unsigned char>(pending << (8 - count));
  }
}
}

namespace vtkSlicemapImage
{
ByteTable MakeValueTable(int foregroundValue)
{
  ByteTable table;
  for (int bits = 0; bits < 256; ++bits)
  {
    std::array<unsigned char, 8> values;
    for (int i = 0; i < 8; ++i)
    {
      values[i] = static_cast<unsigned char>((bits >> i & 1) * foregroundValue);
    }
    std::memcpy(&table[bits], values.data(), 8);
  }
  return table;
}

vtkDataArray* GetScalars(vtkImageData* image)
{
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  return scalars ? scalars : image->GetCellData()->GetScalars();
}

vtkSmartPointer<vtkDataArray> NewArray(
  const vtkVoxelGrid& grid, int scalarType, vtkVoxelSpareArrays* spare)
{
  const std::int64_t voxels = grid.GetNumberOfVoxels();
  if (scalarType == VTK_BIT)
  {
    auto* memory =
      static_cast<unsigned char*>(vtkVoxelAllocate((voxels + 7) / 8, vtkVoxelInitially::Undefined));
    if (!memory)
    {
      return nullptr;
    }
    auto bits = vtkSmartPointer<vtkBitArray>::New();
    bits->SetName(ArrayName);
    bits->SetArray(memory, voxels, 0, vtkAbstractArray::VTK_DATA_ARRAY_FREE);
    return bits;
  }
  return vtkVoxelNewLargeArray<vtkUnsignedCharArray>(
    ArrayName, voxels, 1, vtkVoxelInitially::Zero, spare);
}

void Expand(
  const std::uint32_t* words, const vtkVoxelGrid& grid, int foregroundValue, vtkDataArray* array)
{
  if (auto* bits = vtkBitArray::SafeDownCast(array))
  {
    ExpandToBits(words, grid, bits->GetPointer(0));
    return;
  }
  ExpandRows<vtkVoxelInitially::Zero>(
    words, grid, foregroundValue, { static_cast<vtkUnsignedCharArray*>(array)->GetPointer(0) });
}

void Expand(
  const std::uint32_t* words, const vtkVoxelGrid& grid, int foregroundValue, unsigned char* out)
{
  Expand(words, grid, foregroundValue, std::vector<unsigned char*>{ out });
}

void Expand(const std::uint32_t* words, const vtkVoxelGrid& grid, int foregroundValue,
  const std::vector<unsigned char*>& outs)
{
  ExpandRows<vtkVoxelInitially::Undefined>(words, grid, foregroundValue, outs);
}

void ExpandToBits(const std::uint32_t* words, const vtkVoxelGrid& grid, unsigned char* out)
{
  const glm::ivec3 n = grid.GetDimensions();
  const std::int64_t rows = std::int64_t(n.y) * n.z;
  const std::int64_t wordsPerRow = vtkSlicemap::GetWordsPerRow(grid);
  // Eight rows end at a whole byte.
  vtkSMPTools::For(0, (rows + 7) / 8,
    [&](vtkIdType begin, vtkIdType end)
    {
      const std::int64_t first = std::int64_t(begin) * 8;
      ExpandRowsToBits(words + first * wordsPerRow, wordsPerRow,
        std::min<std::int64_t>(std::int64_t(end) * 8, rows) - first, n.x, out + first * n.x / 8);
    });
}

void Overlay(const std::uint32_t* words, const vtkVoxelGrid& grid, int value, unsigned char* out)
{
  const glm::ivec3 n = grid.GetDimensions();
  const std::int64_t rows = std::int64_t(n.y) * n.z;
  const std::int64_t wordsPerRow = vtkSlicemap::GetWordsPerRow(grid);
  vtkSMPTools::For(0, rows,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType row = begin; row < end; ++row)
      {
        for (int x = 0; x < n.x; x += WordBits)
        {
          unsigned char* voxel = out + std::int64_t(row) * n.x + x;
          for (std::uint32_t word = words[row * wordsPerRow + x / WordBits]; word != 0;
               word >>= 1, ++voxel)
          {
            if (word & 1u)
            {
              *voxel = static_cast<unsigned char>(value);
            }
          }
        }
      }
    });
}

std::int64_t Count(const std::uint32_t* words, std::int64_t numberOfWords)
{
  std::atomic<std::int64_t> total{ 0 };
  vtkSMPTools::For(0, numberOfWords,
    [&](vtkIdType begin, vtkIdType end)
    {
      std::int64_t count = 0;
      for (vtkIdType i = begin; i < end; ++i)
      {
        count += static_cast<std::int64_t>(std::bitset<WordBits>(words[i]).count());
      }
      total += count;
    });
  return total;
}
}
