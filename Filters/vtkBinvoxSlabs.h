// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkBinvoxSlabs.h
 * Private header: the bytes of a .binvox file, for vtkBinvoxWriter and vtkVoxelSlabWriter.
 */

#ifndef vtkBinvoxSlabs_h
#define vtkBinvoxSlabs_h

#include "vtkVoxelSlabs.h"

#include <ostream>
#include <vector>

/**
 * Run lengths go along y, then z, then x, so that slabs are stacked along x.
 */
class vtkBinvoxSlabs : public vtkVoxelSlabs
{
public:
  /**
   * Throws vtkVoxelFileError for a grid that the format can't hold.
   */
  static void Check(const vtkVoxelGrid& grid);

  /**
   * Writes the header; the grid has passed Check.
   */
  vtkBinvoxSlabs(std::ostream& stream, const vtkVoxelGrid& whole);

  int GetAxis() const override { return 0; }
  int GetBestMultiple() const override;
  std::int64_t GetBytes() const override;
  bool Add(const std::uint32_t* words, const vtkVoxelGrid& slab, const Progress& progress) override;
  bool Finish(const Progress& progress) override;

private:
  void Append(bool value, std::int64_t count);
  void FlushRun();
  void FlushBytes();

  std::ostream& Stream;
  std::vector<std::uint32_t> Plane; // 32 planes of constant x
  std::vector<char> Bytes;
  bool Value = false;
  std::int64_t Count = 0;
};

#endif
// VTK-HeaderTest-Exclude: vtkBinvoxSlabs.h
