// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkDensityArrays.h
 * Private header: the arrays of vtkVoxelDensityNormals, made of the counts of vtkDensityPass slab
 * by slab, on the host, with all threads of vtkSMPTools.
 *
 * Normals are made here, of the density: so one or two bytes a voxel cross the bus instead of
 * twelve, and memory is touched only where there is a surface.
 */

#ifndef vtkDensityArrays_h
#define vtkDensityArrays_h

#include "vtkDensityPass.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

class vtkDataArray;
class vtkFloatArray;
class vtkVoxelSpareArrays;
struct vtkVoxelGrid;

class vtkDensityArrays
{
public:
  enum class Gradient
  {
    None,
    Symmetric,
    OneSided
  };

  static constexpr char DensityName[] = "Density";

  /// `type` is VTK_UNSIGNED_CHAR or VTK_UNSIGNED_SHORT for counts that fit, or VTK_FLOAT for
  /// fractions of the largest count. Spare arrays may give their memory. Throws
  /// std::runtime_error when there is none.
  vtkDensityArrays(const vtkVoxelGrid& grid, int planes, int type, Gradient gradient,
    vtkVoxelSpareArrays* spare = nullptr);
  ~vtkDensityArrays();

  /// Slabs must come in order, without gaps.
  void Add(const vtkDensityPass::Slab& slab);

  vtkDataArray* GetDensity() const;
  /// Null without a gradient.
  vtkFloatArray* GetNormals() const;

private:
  template <typename Value>
  void Expand(const vtkDensityPass::Slab& slab, Value* density) const;
  template <typename Value>
  void MakeNormals(const Value* density, int firstSlice, int endSlice) const;

  glm::ivec3 Size;
  int Planes;
  Gradient Kind;
  glm::mat3 Outwards; ///< from a gradient along the axes of the grid to one that points outwards
  int SlicesWithNormals = 0;
  vtkSmartPointer<vtkDataArray> Density;
  vtkSmartPointer<vtkFloatArray> Normals;
};

#endif
// VTK-HeaderTest-Exclude: vtkDensityArrays.h
