// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelBitsFile.h
 * Private header: what vtkVoxelBitsWriter and vtkVoxelBitsReader know of the format, which the
 * former documents.
 */

#ifndef vtkVoxelBitsFile_h
#define vtkVoxelBitsFile_h

#include "vtkVoxelGrid.h"

#include <cstdint>
#include <istream>
#include <string>
#include <vector>

struct vtkVoxelBitsFile
{
  static constexpr char Signature[] = "#voxelbits 1";

  vtkVoxelGrid Grid;
  std::int64_t NumberOfVariants = 1;
  std::int64_t FirstVariant = 0;
  std::int64_t Seed = 0;
  std::string Label;

  /// Of a variant.
  std::int64_t GetNumberOfBytes() const { return (this->Grid.GetNumberOfVoxels() + 7) / 8; }

  std::string MakeHeader() const;

  /// Leaves the stream at the first byte of the data, of which there are enough. Throws
  /// std::runtime_error with what is wrong.
  static vtkVoxelBitsFile Read(std::istream& stream);

  /// From words as vtkSlicemap has them to the bytes of a variant.
  static std::vector<unsigned char> Pack(const std::uint32_t* words, const vtkVoxelGrid& grid);

  /// From bytes of a variant to one value a voxel.
  static void Unpack(const unsigned char* bytes, std::int64_t voxels, unsigned char* values);
};

#endif
// VTK-HeaderTest-Exclude: vtkVoxelBitsFile.h
