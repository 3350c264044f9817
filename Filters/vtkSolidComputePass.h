// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkSolidComputePass.h
 * Private header: solid voxelization by compute shaders (OpenGL 4.3).
 *
 * An invocation takes a triangle and toggles one bit where it crosses a column; large triangles are
 * queued as tiles of equal size for a second dispatch, whose size the GPU decides. A scan along the
 * columns turns toggles to parity. Arithmetic on coordinates is double precision. Grids whose words
 * exceed what a storage buffer may hold are done in slabs along z.
 */

#ifndef vtkSolidComputePass_h
#define vtkSolidComputePass_h

#include "vtkSolidPass.h"
#include "vtkTriangleDispatch.h"
#include "vtkVoxelMeshVariants.h"

class vtkSolidComputePass : public vtkSolidPass
{
public:
  explicit vtkSolidComputePass(vtkVoxelGL::Context context, Ties ties = Ties::LowerInside);

  bool FillSolid(const vtkVoxelMesh& mesh, vtkSlicemap* target, int axis, Rule rule,
    const Progress& progress) override;
  bool Touch(const vtkVoxelMesh& mesh, vtkSlicemap* target, TouchedVoxels operation,
    const Progress& progress) override;
  int GetPossibleAxis(int axis, Rule rule, const vtkVoxelGrid& whole) const override;
  double EstimateCost(
    const vtkVoxelGrid& grid, int axis, const glm::dvec3& projectedAreas) const override;

  /// All words of `target`: a grid with the extent of `grid` for each variant, one behind the other
  /// along z, as FillSolid fills one by parity. Variants with the same column axis must follow one
  /// another. Leaves no column ends.
  void FillVariants(const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid,
    const std::vector<vtkVoxelMeshVariants::Variant>& variants, vtkSlicemap* target);

  /// How many variants FillVariants should do at once, out of so many; they share what a dispatch
  /// costs while their words stay few. One: it does not pay, or there is no room.
  static int GetVariantsAtOnce(const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, int count);

private:
  struct Box;
  struct GridRange;

  bool FillParity(
    const vtkVoxelMesh& mesh, vtkSlicemap* target, int axis, const Progress& progress);
  bool FillNonZero(
    const vtkVoxelMesh& mesh, vtkSlicemap* target, int axis, const Progress& progress);
  void RunTriangles(const vtkVoxelMesh& mesh, vtkSlicemap* target,
    const vtkVoxelGL::Program::Defines& defines, const vtkColumnAxes& axes, const Box& box);
  vtkTriangleDispatch::Job MakeJob(vtkSlicemap* target, const vtkVoxelGL::Program::Defines& defines,
    const vtkColumnAxes& axes, const Box& box) const;
  void Scan(vtkSlicemap* target, int axis, const Box& box);
  void ScanGrids(vtkSlicemap* target, int axis, const glm::ivec3& size, const GridRange& grids);
  vtkVoxelGL::Program& UseScan(
    vtkSlicemap* target, int axis, const glm::ivec3& size, vtkVoxelGL::Program::Defines defines);

  vtkVoxelGL::Context Context;
  Ties OnSurface;
  vtkTriangleDispatch Dispatch;
  vtkVoxelMeshVariants Variants;
  vtkVoxelGL::Buffer ColumnCarries;
  vtkVoxelGL::Buffer Counters;
};

#endif
// VTK-HeaderTest-Exclude: vtkSolidComputePass.h
