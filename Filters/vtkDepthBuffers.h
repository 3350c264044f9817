// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkDepthBuffers.h
 * Private header: the pairs of depth buffers behind vtkDepthBufferVoxelizer, and what is between
 * them.
 *
 * All methods want the context to be current within a vtkVoxelContext::Scope, and throw
 * std::runtime_error with a message for the user.
 */

#ifndef vtkDepthBuffers_h
#define vtkDepthBuffers_h

#include "vtkDepthView.h"
#include "vtkVoxelGLObjects.h"

#include <glm/glm.hpp>
#include <vector>

class vtkSlicemap;
class vtkVoxelMesh;
struct vtkVoxelGrid;

class vtkDepthBuffers
{
public:
  using Side = vtkDepthView::Side;

  /// Neighbours of a column that the surface must not shine through to.
  enum class Neighbours
  {
    Four = 4,
    Eight = 8
  };

  /// What is nearest to both sides of a view. Depth is 1 where there is nothing.
  struct Pair
  {
    int Axis; ///< the index axis that it looks along, or Oblique
    vtkDepthView View;
    vtkVoxelGL::Framebuffer Near;
    vtkVoxelGL::Framebuffer Far;
    vtkVoxelGL::Texture NearDepth;
    vtkVoxelGL::Texture FarDepth;

    const vtkVoxelGL::Framebuffer& GetFramebuffer(Side side) const
    {
      return side == Side::Near ? this->Near : this->Far;
    }
  };
  static constexpr int Oblique = -1;

  /// Forgets all pairs.
  void Start(vtkVoxelGL::Context context);

  /// Adds a pair of buffers in which there is nothing.
  void Add(int axis, const vtkDepthView& view);

  const std::vector<Pair>& GetPairs() const { return this->Pairs; }

  /// Draws a mesh into all buffers.
  void Draw(const vtkVoxelMesh& mesh) const;

  ///@{
  /// Fills `target`, which is allocated and begins at voxel `first` of the grid that the views
  /// along axes look at: with the voxels between all pairs, or with those of them that are on the
  /// surface.
  void FillSolid(vtkSlicemap* target, const glm::ivec3& first) const;
  void FillSurface(vtkSlicemap* target, const glm::ivec3& first, Neighbours neighbours) const;
  ///@}

  /// How much of each voxel of `grid`, which begins at voxel `first`, lies between the pairs along
  /// axes, from 0 to 1, in the order of an image's points.
  void ReadDensity(const vtkVoxelGrid& grid, const glm::ivec3& first, float* values) const;

  /// The depths of one side of a pair as OpenGL stores them, pixel by pixel.
  std::vector<float> ReadDepth(const Pair& pair, Side side) const;

private:
  struct Columns;

  void CheckSize(const vtkDepthView& view) const;
  vtkVoxelGL::Framebuffer MakeBuffer(const vtkDepthView& view, vtkVoxelGL::Texture& depth) const;
  vtkVoxelGL::Texture MakeRanges(const Pair& pair) const;
  vtkVoxelGL::Texture MakeShells(
    const Pair& pair, const vtkVoxelGL::Texture& ranges, Neighbours neighbours) const;
  vtkVoxelGL::Texture MakeBlocks(const Columns& columns, int first, int count) const;
  bool HasObliquePairs() const;
  void Carve(vtkSlicemap* target, const Pair& pair) const;
  void KeepBoundary(vtkSlicemap* target, Neighbours neighbours) const;
  void Fill(vtkSlicemap* target, const glm::ivec3& first, const std::vector<Columns>& columns,
    vtkVoxelGL::Program::Defines defines) const;

  vtkVoxelGL::Context Context;
  std::vector<Pair> Pairs;
};

#endif
// VTK-HeaderTest-Exclude: vtkDepthBuffers.h
