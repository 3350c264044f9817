// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkRasterMeshBinding.h
 * Private header: what vtkRasterMeshFetch.glsl wants of a mesh and a grid.
 *
 * Coordinates are voxels relative to an anchor near the grid, a voxel that parts of a grid have in
 * common with the whole, so that both see the same numbers.
 */

#ifndef vtkRasterMeshBinding_h
#define vtkRasterMeshBinding_h

#include "vtkSolidPass.h" // for vtkColumnAxes
#include "vtkVoxelGLObjects.h"

#include <array>
#include <glm/glm.hpp>

class vtkVoxelMesh;
struct vtkVoxelGrid;

class vtkRasterMeshBinding
{
public:
  vtkRasterMeshBinding(
    const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, const vtkColumnAxes& axes);

  /// Binds the textures from `unit` on and sets the uniforms; the program must be in use.
  void Bind(vtkVoxelGL::Program& program, unsigned int unit) const;

  /// Sets the uniforms of vtkPairMeshFetch.glsl, beside those.
  void BindPairs(vtkVoxelGL::Program& program) const;

  /// The first voxel of the grid, relative to the anchor, in the order of the axes.
  const glm::ivec3& GetFirstVoxel() const { return this->FirstVoxel; }

  /// A point in world coordinates, in those of the shader.
  glm::vec3 GetVoxels(const glm::dvec3& world) const;

  /// Largest sum of terms, without their signs, that makes a coordinate of the mesh.
  double GetLargestTerms() const;

private:
  const vtkVoxelMesh& Mesh;
  glm::ivec3 FirstVoxel;
  glm::dvec3 Anchor; ///< in world coordinates
  std::array<glm::dvec3, 3> VoxelsFromWorld;
  std::array<double, 3> Offsets; ///< of the origin of the world from the anchor, in voxels
};

#endif
// VTK-HeaderTest-Exclude: vtkRasterMeshBinding.h
