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
#include <memory>
#include <vector>

class vtkVoxelMeshDisplacement
{
  /// A buffer and the texture that reads it.
  struct Table
  {
    void Upload(
      const vtkVoxelGL::Context& context, GLenum format, std::size_t bytes, const void* data);

    vtkVoxelGL::Buffer Buffer;
    vtkVoxelGL::Texture Texture;
  };

public:
  /// Vectors in units of an amplitude, which any mesh may use.
  class Ring
  {
  public:
    /// Their number must be a power of two.
    Ring(const vtkVoxelGL::Context& context, const std::vector<glm::vec3>& vectors);

    /// Length of the longest one, or largest first component.
    static double GetLongest(const std::vector<glm::vec3>& vectors, bool alongNormals);

  private:
    friend class vtkVoxelMeshDisplacement;
    Table Vectors;
    std::uint32_t Mask;
    double Longest;
    double LongestAlongNormals;
  };

  /// Uploads, for each point, the first one at its place and, if they are to be used, the normals.
  void SetPoints(const vtkVoxelGL::Context& context, const std::vector<std::uint32_t>& places,
    const std::vector<glm::vec3>& normals);

  void SetRing(std::shared_ptr<const Ring> ring, float amplitude);

  /// Where in the ring the first place begins.
  void SetFirst(std::uint32_t first) { this->First = first; }

  /// Length of the longest move.
  double GetLargest() const;
  vtkVoxelGL::Program::Defines GetDefines() const;

  /// Binds the buffer textures to units `unit` to `unit` + 2; the program must be in use.
  void Bind(vtkVoxelGL::Program& program, unsigned int unit) const;

private:
  Table Places;
  Table Normals;
  std::shared_ptr<const Ring> Vectors;
  float Amplitude = 0.0f;
  std::uint32_t First = 0;
  bool PlacesDiffer = false;
  bool AlongNormals = false;
};

#endif
// VTK-HeaderTest-Exclude: vtkVoxelMeshDisplacement.h
