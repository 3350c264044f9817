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

private:
  struct Box;

  bool FillParity(
    const vtkVoxelMesh& mesh, vtkSlicemap* target, int axis, const Progress& progress);
  bool FillNonZero(
    const vtkVoxelMesh& mesh, vtkSlicemap* target, int axis, const Progress& progress);
  void RunTriangles(const vtkVoxelMesh& mesh, vtkSlicemap* target,
    const vtkVoxelGL::Program::Defines& defines, const vtkColumnAxes& axes, const Box& box);
  void Scan(vtkSlicemap* target, int axis, const Box& box);

  vtkVoxelGL::Context Context;
  Ties OnSurface;
  vtkTriangleDispatch Dispatch;
  vtkVoxelGL::Buffer ColumnCarries;
  vtkVoxelGL::Buffer Counters;
};

#endif
// VTK-HeaderTest-Exclude: vtkSolidComputePass.h
