// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkTetraRasterPass.h
 * Private header: the XOR of tetrahedra by rasterization (OpenGL 3.2), in the two ways of Ogayar et
 * al. 2022, section III-B: a draw for each slice, or layers, where a geometry shader cuts a
 * tetrahedron by many slices at once.
 *
 * The render target has one byte a voxel; grids beyond what it may take are done in tiles, equal to
 * the whole bit for bit. Coordinates are single precision, and corners of sections are snapped to
 * 1/128 of a voxel.
 */

#ifndef vtkTetraRasterPass_h
#define vtkTetraRasterPass_h

#include "vtkVoxelGLObjects.h"

#include <functional>
#include <glm/glm.hpp>

class vtkSlicemap;
class vtkVoxelMesh;

class vtkTetraRasterPass
{
public:
  enum class Method
  {
    Slices,
    Layers
  };

  /// Takes the fraction done, answers whether to go on.
  using Progress = std::function<bool(double)>;

  explicit vtkTetraRasterPass(vtkVoxelGL::Context context);

  /// All words of `target`, which is allocated; `origin` is in world coordinates. The context must
  /// be current. False when stopped; throws std::runtime_error with a message for the user.
  bool FillSolid(const vtkVoxelMesh& mesh, const glm::dvec3& origin, vtkSlicemap* target,
    Method method, const Progress& progress);

private:
  struct Tile;
  void Draw(const vtkVoxelMesh& mesh, const glm::dvec3& origin, vtkSlicemap* target,
    const Tile& tile, Method method);
  void Resolve(vtkSlicemap* target, const Tile& tile);

  vtkVoxelGL::Context Context;
  vtkVoxelGL::Texture Layers;
  glm::ivec3 SizeOfLayers{ 0 };
};

#endif
// VTK-HeaderTest-Exclude: vtkTetraRasterPass.h
