// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkImageFileSlabs.h
 * Private header: the bytes of a .vti file for vtkVoxelSlabWriter.
 */

#ifndef vtkImageFileSlabs_h
#define vtkImageFileSlabs_h

#include "vtkVoxelSlabs.h"

#include <memory>
#include <ostream>
#include <vector>

/**
 * An image with the array "Occupancy" as VTK's XML format has it, appended raw, in blocks packed by
 * zlib or in one piece. The sizes of packed blocks come before the blocks: they are left free, and
 * filled in by Finish.
 */
class vtkImageFileSlabs : public vtkVoxelSlabs
{
public:
  struct Settings
  {
    int ScalarType; // VTK_UNSIGNED_CHAR or VTK_BIT
    int ForegroundValue = 1;
    bool AreCells = false;
    bool IsCompressed = true;
  };

  vtkImageFileSlabs(std::ostream& stream, const vtkVoxelGrid& whole, const Settings& settings);
  ~vtkImageFileSlabs() override;

  int GetMultiple() const override;
  std::int64_t GetBytes() const override;
  bool Add(const std::uint32_t* words, const vtkVoxelGrid& slab, const Progress& progress) override;
  bool Finish(const Progress& progress) override;

private:
  struct Packed;

  void AppendValues(const std::uint32_t* words, const vtkVoxelGrid& slices);
  void WriteBlocks(std::int64_t bytes);

  std::ostream& Stream;
  Settings Options;
  std::int64_t SliceBytes;           // rounded up
  std::int64_t TotalBytes;           // of the array
  int SlicesAtOnce;                  // whose values are made at a time
  std::vector<unsigned char> Values; // not yet written
  std::int64_t NumberOfValues = 0;
  std::int64_t SizesPosition = 0; // in the stream
  std::vector<std::uint64_t> Sizes;
  std::unique_ptr<Packed> Blocks;
};

#endif
// VTK-HeaderTest-Exclude: vtkImageFileSlabs.h
