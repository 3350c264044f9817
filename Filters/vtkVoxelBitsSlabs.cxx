// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelBitsSlabs.h"

#include "vtkSlicemap.h"
#include "vtkSlicemapImage.h"
#include "vtkVoxelBitsFile.h"

namespace
{
constexpr int ByteBits = 8;

std::int64_t GetBytesOf(const vtkVoxelGrid& slices)
{
  return (slices.GetNumberOfVoxels() + ByteBits - 1) / ByteBits;
}
}

vtkVoxelBitsSlabs::vtkVoxelBitsSlabs(std::ostream& stream, const vtkVoxelBitsFile& description)
  : Stream(stream)
  , Bytes(GetBytesOf(description.Grid.WithSlices(0, SlicesAtOnce)))
{
  this->Stream << description.MakeHeader();
}

std::int64_t vtkVoxelBitsSlabs::GetBytes() const
{
  return static_cast<std::int64_t>(this->Bytes.size());
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
    const vtkVoxelGrid part = slab.WithSlices(z, SlicesAtOnce);
    vtkSlicemapImage::ExpandToBits(words + z * wordsOfSlice, part, this->Bytes.data());
    this->Stream.write(reinterpret_cast<const char*>(this->Bytes.data()),
      static_cast<std::streamsize>(GetBytesOf(part)));
  }
  return true;
}
