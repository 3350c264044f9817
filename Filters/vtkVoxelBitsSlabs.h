// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelBitsSlabs.h
 * Private header: the bytes of a .bits file, for vtkVoxelBitsWriter and vtkVoxelSlabWriter.
 */

#ifndef vtkVoxelBitsSlabs_h
#define vtkVoxelBitsSlabs_h

#include "vtkVoxelSlabs.h"

#include <ostream>
#include <vector>

struct vtkVoxelBitsFile;

/**
 * Slabs are stacked along z, eight slices at a time, which end at a whole byte. Variants follow one
 * another as slabs do.
 */
class vtkVoxelBitsSlabs : public vtkVoxelSlabs
{
public:
  /**
   * Writes the header.
   */
  vtkVoxelBitsSlabs(std::ostream& stream, const vtkVoxelBitsFile& description);

  int GetMultiple() const override { return SlicesAtOnce; }
  std::int64_t GetBytes() const override;
  bool Add(const std::uint32_t* words, const vtkVoxelGrid& slab, const Progress& progress) override;
  bool Finish(const Progress&) override { return true; }

private:
  static constexpr int SlicesAtOnce = 8;

  std::ostream& Stream;
  std::vector<unsigned char> Bytes; // of so many slices
};

#endif
// VTK-HeaderTest-Exclude: vtkVoxelBitsSlabs.h
