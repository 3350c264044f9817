// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelMeshVariants.h
 * Private header: several ways to see a vtkVoxelMesh, on the GPU for shaders that do them all in
 * one dispatch, see vtkVoxelMeshVariants.glsl.
 */

#ifndef vtkVoxelMeshVariants_h
#define vtkVoxelMeshVariants_h

#include "vtkVoxelGLObjects.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

class vtkVoxelMeshVariants
{
public:
  struct Variant
  {
    glm::dmat4 IndexFromWorld;
    int ColumnAxis;                  ///< the rows go to the shader in the order of vtkColumnAxes
    std::uint32_t FirstDisplacement; ///< see vtkVoxelMeshDisplacement
  };

  void Upload(const vtkVoxelGL::Context& context, std::vector<Variant> variants);

  const std::vector<Variant>& Get() const { return this->Variants; }

  /// Binds the buffer texture to a unit; the program must be in use.
  void Bind(vtkVoxelGL::Program& program, unsigned int unit) const;

private:
  std::vector<Variant> Variants;
  vtkVoxelGL::Buffer Buffer;
  vtkVoxelGL::Texture Texture;
};

#endif
// VTK-HeaderTest-Exclude: vtkVoxelMeshVariants.h
