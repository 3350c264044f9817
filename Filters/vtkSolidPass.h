// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkSolidPass.h
 * Private header: the GPU passes behind vtkSlicemapSolidVoxelizer, one interface for both backends.
 *
 * All methods want the context of the slicemap to be current, take slicemaps that are allocated,
 * and throw std::runtime_error with a message for the user. They return false when they were
 * stopped.
 */

#ifndef vtkSolidPass_h
#define vtkSolidPass_h

#include "vtkSmartPointer.h"
#include "vtkVoxelGLObjects.h"

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>

class vtkSlicemap;
class vtkVoxelMesh;
struct vtkVoxelGrid;

/// Axes of a column: u and v across it, depth along it; u and v in the order of x, y, z.
struct vtkColumnAxes
{
  explicit vtkColumnAxes(int column)
    : U(column == 0 ? 1 : 0)
    , V(column == 2 ? 1 : 2)
    , Depth(column)
  {
  }

  template <typename Vector>
  auto operator()(const Vector& xyz) const
  {
    return glm::vec<3, typename Vector::value_type>(xyz[this->U], xyz[this->V], xyz[this->Depth]);
  }

  int U;
  int V;
  int Depth;
};

class vtkSolidPass
{
public:
  /// Takes the fraction done, answers whether to go on.
  using Progress = std::function<bool(double)>;

  enum class Rule
  {
    Parity,
    NonZero
  };

  enum class TouchedVoxels
  {
    Set,
    Clear
  };

  /// Which of the two voxel centres at the ends of a solid along an axis, if they lie on the
  /// surface, are inside.
  enum class Ties
  {
    LowerInside,
    UpperInside
  };

  virtual ~vtkSolidPass() = default;

  /// All words of `target`: the voxels whose centres are inside by `rule`, seen along `axis`.
  virtual bool FillSolid(const vtkVoxelMesh& mesh, vtkSlicemap* target, int axis, Rule rule,
    const Progress& progress) = 0;

  /// Sets or clears the voxels of `target` that the triangles touch and leaves the others.
  virtual bool Touch(const vtkVoxelMesh& mesh, vtkSlicemap* target, TouchedVoxels operation,
    const Progress& progress) = 0;

  /// One bit for each column of the last FillSolid, set where its crossings don't cancel: the mesh
  /// is open there. A slicemap of nu x nv x 1 voxels, which may be kept.
  vtkSmartPointer<vtkSlicemap> GetColumnEnds() const { return this->ColumnEnds; }

  /// What a column axis costs, in nanoseconds of a CPU that runs OpenGL in software; only compared.
  virtual double EstimateCost(
    const vtkVoxelGrid& grid, int axis, const glm::dvec3& projectedAreas) const = 0;

  /// The axis to take for `axis`, or another one where that can't be had on `whole`.
  virtual int GetPossibleAxis(int axis, Rule, const vtkVoxelGrid& whole) const
  {
    static_cast<void>(whole);
    return axis;
  }

  int GetCheapestAxis(const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid) const;

protected:
  /// Column ends of a run on `target` along `axes`, all zero.
  void StartColumnEnds(vtkSlicemap* target, const vtkColumnAxes& axes);

  vtkSmartPointer<vtkSlicemap> ColumnEnds;
};

#endif
// VTK-HeaderTest-Exclude: vtkSolidPass.h
