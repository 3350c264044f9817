// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelMeshDisplacement.h
 * Private header: vectors on the GPU that move the points of a vtkVoxelMesh, see
 * vtkVoxelMeshDisplacement.glsl. Nothing is uploaded for another offset.
 */

#ifndef vtkVoxelMeshDisplacement_h
#define vtkVoxelMeshDisplacement_h

#include "vtkVoxelGLObjects.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

class vtkVoxelMeshDisplacement
{
public:
  /// Uploads, for each point, the first one at its place and, if they are to be used, the normals.
  void SetPoints(const vtkVoxelGL::Context& context, const std::vector<std::uint32_t>& places,
    const std::vector<glm::vec3>& normals);

  /// Uploads the ring of vectors, and the length of the longest move that they make.
  void SetRing(
    const vtkVoxelGL::Context& context, const std::vector<glm::vec3>& ring, double largest);

  /// Where in the ring the first place begins.
  void SetFirst(std::uint32_t first) { this->First = first; }

  double GetLargest() const { return this->Largest; }
  vtkVoxelGL::Program::Defines GetDefines() const;

  /// Binds the buffer textures to units `unit` to `unit` + 2; the program must be in use.
  void Bind(vtkVoxelGL::Program& program, unsigned int unit) const;

private:
  /// A buffer and the texture that reads it.
  struct Table
  {
    void Upload(
      const vtkVoxelGL::Context& context, GLenum format, std::size_t bytes, const void* data);

    vtkVoxelGL::Buffer Buffer;
    vtkVoxelGL::Texture Texture;
  };

  Table Places;
  Table Normals;
  Table Ring;
  std::uint32_t RingSize = 0;
  std::uint32_t First = 0;
  double Largest = 0.0;
  bool AlongNormals = false;
};

#endif
// VTK-HeaderTest-Exclude: vtkVoxelMeshDisplacement.h
