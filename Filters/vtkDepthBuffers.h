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

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <utility>
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

  /// How often the columns of a view are crossed by what was drawn.
  enum class Crossings
  {
    NotCounted,
    NoneOrTwo, ///< in each column: a single range of voxels is inside
    Others
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
    bool IsNearDrawn = false;
    bool IsFarDrawn = false;
    bool HasStencil = false;
    Crossings Crossed = Crossings::NotCounted;

    const vtkVoxelGL::Framebuffer& GetFramebuffer(Side side) const
    {
      return side == Side::Near ? this->Near : this->Far;
    }
    const vtkVoxelGL::Texture& GetDepth(Side side) const
    {
      return side == Side::Near ? this->NearDepth : this->FarDepth;
    }
    bool IsDrawn(Side side) const
    {
      return side == Side::Near ? this->IsNearDrawn : this->IsFarDrawn;
    }
  };
  using Pairs = std::vector<std::shared_ptr<Pair>>;
  static constexpr int Oblique = -1;

  /// A direction of a pair, an index axis or Oblique, and the view.
  using Direction = std::pair<int, vtkDepthView>;

  /// Depths of a pair along an axis that come from elsewhere, pixel by pixel, as OpenGL stores
  /// them.
  struct Given
  {
    int Axis;
    vtkDepthView View;
    std::vector<float> Near;
    std::vector<float> Far;
  };

  /// Forgets all pairs.
  void Start(vtkVoxelGL::Context context);

  /// Whether the pairs are still there, in this context.
  bool IsIn(const vtkVoxelGL::Context& context) const;

  /// From now on there are pairs in these directions, no others. What was drawn since Start is
  /// kept, for later too; buffers that have to be drawn are empty.
  void Use(const std::vector<Direction>& directions);

  ///@{
  /// Draws a mesh into all buffers that are not drawn yet, which then are; a null mesh draws
  /// nothing. False when stopped, which leaves the present buffer undrawn.
  using GoOn = std::function<bool()>;
  bool Draw(const vtkVoxelMesh* mesh, const GoOn& goOn);
  ///@}

  /// One of the directions along axes from which the whole mesh can be told: it crosses each column
  /// never or twice. The near sides are drawn one by one for that, those of fewer pixels first. The
  /// end of `directions` when there is none.
  std::vector<Direction>::const_iterator FindSufficient(
    const std::vector<Direction>& directions, const vtkVoxelMesh& mesh);

  /// Intersects the pairs in use with others, and puts them into the order of axes.
  void Intersect(const std::vector<Given>& others);

  /// Pairs that are to be drawn, and those that voxels are made from.
  const Pairs& GetDrawnPairs() const { return this->Drawn; }
  const Pairs& GetPairs() const { return this->Effective; }

  /// How many buffers were drawn.
  int GetNumberOfDraws() const { return this->NumberOfDraws; }

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
  vtkVoxelGL::Framebuffer MakeBuffer(
    const vtkDepthView& view, bool hasStencil, vtkVoxelGL::Texture& depth) const;
  std::shared_ptr<Pair> MakePair(const Direction& direction, bool hasStencil) const;
  std::shared_ptr<Pair> Find(const Direction& direction, bool counted) const;
  void DrawSide(const vtkVoxelMesh* mesh, Pair& pair, Side side);
  Crossings CountCrossings(const Pair& pair) const;
  std::shared_ptr<Pair> Merge(const Pairs& pairs) const;
  vtkVoxelGL::Texture MakeRanges(const Pair& pair) const;
  vtkVoxelGL::Texture MakeShells(
    const Pair& pair, const vtkVoxelGL::Texture& ranges, Neighbours neighbours) const;
  vtkVoxelGL::Buffer MakePlanes(
    const Pair& pair, const Columns& columns, const vtkVoxelGL::Program::Defines& defines) const;
  vtkVoxelGL::Texture MakeBlocks(
    const Columns& columns, const vtkVoxelGL::Program::Defines& defines) const;
  Columns MakeColumns(const Pair& pair, const glm::ivec3& first, const glm::ivec3& size,
    std::optional<Neighbours> neighbours, const vtkVoxelGL::Program::Defines& defines) const;
  bool HasObliquePairs() const;
  void Carve(vtkSlicemap* target, const Pair& pair) const;
  void KeepBoundary(vtkSlicemap* target, Neighbours neighbours) const;
  void Fill(
    vtkSlicemap* target, const glm::ivec3& first, std::optional<Neighbours> neighbours) const;

  vtkVoxelGL::Context Context;
  Pairs Known;     // all since Start
  Pairs Drawn;     // of these, those in use
  Pairs Effective; // after Intersect
  int NumberOfDraws = 0;
};

#endif
// VTK-HeaderTest-Exclude: vtkDepthBuffers.h
