// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkSlicemapImage.h
 * Private header: between the words of a slicemap and the arrays of an image, on the host, with all
 * threads of vtkSMPTools.
 */

#ifndef vtkSlicemapImage_h
#define vtkSlicemapImage_h

#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <vector>

class vtkDataArray;
class vtkImageData;
class vtkVoxelSpareArrays;
struct vtkVoxelGrid;

namespace vtkSlicemapImage
{
constexpr char ArrayName[] = "Occupancy";

/**
 * The active point scalars of an image, its active cell scalars if there are only those, or null.
 */
vtkDataArray* GetScalars(vtkImageData* image);

/**
 * Room for one value a voxel of type VTK_UNSIGNED_CHAR or VTK_BIT, for Expand to fill,
 * named ArrayName; bytes in the memory of a spare array if one fits. Null when there is no memory
 * for it.
 */
vtkSmartPointer<vtkDataArray> NewArray(
  const vtkVoxelGrid& grid, int scalarType, vtkVoxelSpareArrays* spare = nullptr);

/**
 * For each byte of bits, the eight values it stands for, in memory order.
 */
using ByteTable = std::array<std::uint64_t, 256>;
ByteTable MakeValueTable(int foregroundValue);

/**
 * Bits to an array as NewArray made it: where nothing is set, it stays untouched, and so do its
 * pages.
 */
void Expand(
  const std::uint32_t* words, const vtkVoxelGrid& grid, int foregroundValue, vtkDataArray* array);

/**
 * Bits to bytes at `out`, one a voxel.
 */
void Expand(
  const std::uint32_t* words, const vtkVoxelGrid& grid, int foregroundValue, unsigned char* out);

/**
 * The same for several such grids one after the other, each to its own place.
 */
void Expand(const std::uint32_t* words, const vtkVoxelGrid& grid, int foregroundValue,
  const std::vector<unsigned char*>& outs);

/**
 * Bits to bits as vtkBitArray has them, row after row without gaps, the most significant one of a
 * byte first.
 */
void ExpandToBits(const std::uint32_t* words, const vtkVoxelGrid& grid, unsigned char* out);

/**
 * The value of the voxels whose bits are set; other bytes stay as they are.
 */
void Overlay(const std::uint32_t* words, const vtkVoxelGrid& grid, int value, unsigned char* out);

/**
 * Number of set bits.
 */
std::int64_t Count(const std::uint32_t* words, std::int64_t numberOfWords);
}

#endif
// VTK-HeaderTest-Exclude: vtkSlicemapImage.h
