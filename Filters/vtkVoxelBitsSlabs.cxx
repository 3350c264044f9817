// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelBitsSlabs.h"

#include "vtkDataArray.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapImage.h"
#include "vtkVoxelBitsFile.h"

#include <algorithm>
#include <new>

namespace
{
constexpr int ByteBits = 8;

std::int64_t GetBitsOfSlice(const vtkVoxelGrid& grid)
{
  const glm::ivec3 n = grid.GetDimensions();
  return std::int64_t(n.x) * n.y;
}
}

vtkVoxelBitsSlabs::vtkVoxelBitsSlabs(std::ostream& stream, const vtkVoxelBitsFile& description)
  : Stream(stream)
  , BytesAtOnce(GetBitsOfSlice(description.Grid) * SlicesAtOnce / ByteBits)
{
  this->Stream << description.MakeHeader();
}

std::int64_t vtkVoxelBitsSlabs::GetBytes() const
{
  return this->BytesAtOnce;
}

bool vtkVoxelBitsSlabs::Add(
  const std::uint32_t* words, const vtkVoxelGrid& slab, const Progress& progress)
{
  const glm::ivec3 n = slab.GetDimensions();
  const std::int64_t wordsOfSlice = vtkSlicemap::GetWordsPerRow(slab) * n.y;
  for (int z = 0; z < n.z; z += SlicesAtOnce)
  {
    if (!progress(double(z) / n.z) || !this->Stream)
    {
      return false;
    }
    auto extent = slab.Extent;
    extent[4] += z;
    extent[5] = std::min(extent[5], extent[4] + SlicesAtOnce - 1);
    const vtkVoxelGrid part = slab.WithExtent(extent);
    const auto bits = vtkSlicemapImage::NewArray(part, VTK_BIT);
    if (!bits)
    {
      throw std::bad_alloc();
    }
    vtkSlicemapImage::Expand(words + z * wordsOfSlice, part, 1, bits);
    this->Stream.write(static_cast<const char*>(bits->GetVoidPointer(0)),
      static_cast<std::streamsize>((part.GetNumberOfVoxels() + ByteBits - 1) / ByteBits));
  }
  return true;
}
