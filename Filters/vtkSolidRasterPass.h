// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkSolidRasterPass.h
 * Private header: solid voxelization by rasterization (OpenGL 3.2), as in Eisemann & Decoret 2008.
 *
 * The mesh is drawn along the columns into integer render targets, 128 slices each, as many targets
 * at once as the context has (eight at most), and combined by logic operations. Longer columns take
 * more passes, wider grids more tiles. Then the targets are turned to the words of the slicemap.
 *
 * With Ties::UpperInside, which is for parity alone, triangles are drawn as rectangles whose
 * fragments find the covered columns and the crossings in pairs of floats: 48 bits, so that the
 * voxels are those of vtkSolidComputePass unless a crossing is within some 2^-40 of a voxel of one.
 */

#ifndef vtkSolidRasterPass_h
#define vtkSolidRasterPass_h

#include "vtkSolidPass.h"

class vtkSolidRasterPass : public vtkSolidPass
{
public:
  explicit vtkSolidRasterPass(vtkVoxelGL::Context context, Ties ties = Ties::LowerInside);

  bool FillSolid(const vtkVoxelMesh& mesh, vtkSlicemap* target, int axis, Rule rule,
    const Progress& progress) override;
  bool Touch(const vtkVoxelMesh& mesh, vtkSlicemap* target, TouchedVoxels operation,
    const Progress& progress) override;
  double EstimateCost(
    const vtkVoxelGrid& grid, int axis, const glm::dvec3& projectedAreas) const override;

private:
  enum class Content
  {
    Parity,
    PairParity,
    Winding,
    Touched
  };
  struct Stages;
  struct Tile;
  class Targets;

  static Stages GetStages(Content content);
  bool Fill(const vtkVoxelMesh& mesh, vtkSlicemap* target, int axis, Content content,
    const Progress& progress);
  void Draw(const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, const Tile& tile, Content content,
    Targets& targets);
  void Resolve(vtkSlicemap* target, const Tile& tile, Content content, const Targets& targets);

  vtkVoxelGL::Context Context;
  Ties OnSurface;
};

#endif
// VTK-HeaderTest-Exclude: vtkSolidRasterPass.h
