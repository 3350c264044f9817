// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkSlicemapNumbering.h
 * Private header: numbers the set voxels of a slicemap on the GPU, x fastest and z slowest
 * (OpenGL 4.3), for lists of voxels and for whatever is stored for set voxels alone.
 */

#ifndef vtkSlicemapNumbering_h
#define vtkSlicemapNumbering_h

#include "vtkVoxelGLObjects.h"

#include <cstdint>

class vtkSlicemap;

class vtkSlicemapNumbering
{
public:
  /// Numbers the voxels of `slicemap`, which has fewer than 2^32 of them and must stay as it is.
  /// Throws std::runtime_error.
  explicit vtkSlicemapNumbering(vtkSlicemap* slicemap);

  /// Number of set voxels.
  std::uint64_t GetCount() const { return this->Count; }

  /// A buffer of indices x + nx * (y + ny * z) of the set voxels, by number; they must be so few
  /// that a storage buffer holds them.
  vtkVoxelGL::Buffer MakeIndices() const;

  /// An R32UI buffer texture: the number of the first voxel of each texel of the slicemap's words,
  /// four words a texel.
  const vtkVoxelGL::Texture& GetOffsets() const { return this->OffsetsTexture; }

private:
  enum class Stage
  {
    Count,
    Offsets,
    Indices
  };

  vtkVoxelGL::Program& Use(Stage stage) const;

  vtkSlicemap* Slicemap;
  vtkVoxelGL::Texture Quads;
  vtkVoxelGL::Buffer Offsets;
  vtkVoxelGL::Texture OffsetsTexture;
  std::uint64_t Count = 0;
};

#endif
// VTK-HeaderTest-Exclude: vtkSlicemapNumbering.h
