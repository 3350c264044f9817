// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkSurfacePass.h
 * Private header: the voxels that triangles overlap, exactly (OpenGL 4.3).
 *
 * Randall Rauwendaal: Hybrid Computational Voxelization Using the Graphics Pipeline. Master's
 * thesis, Oregon State University, 2012; chapter 3. Triangles in few columns of voxels are done by
 * one invocation each; large ones either cut into tiles of equal size, for a second dispatch, or
 * drawn, a fragment for each column. All ways run the same test on the same numbers, so that they
 * set the same voxels bit for bit.
 */

#ifndef vtkSurfacePass_h
#define vtkSurfacePass_h

#include "vtkTriangleDispatch.h"

#include "vtkVoxelGrid.h"

#include <cstdint>

class vtkSlicemap;
class vtkVoxelContext;

class vtkSurfacePass
{
public:
  /// Takes the fraction done, answers whether to go on.
  using Progress = std::function<bool(double)>;

  enum class LargeTriangles
  {
    Tiles,
    Fragments
  };

  enum class Operation
  {
    Set,
    Clear
  };

  struct Settings;

  /// CutoffArea: triangles whose bounds have more columns of voxels are large. One invocation does
  /// no more than LargestCutoffArea, since renderers in software end its loops after 65,535 turns.
  static constexpr float LargestCutoffArea = 8192.0f;
  static constexpr float AllAreLarge = -1.0f;

  /// Which triangles are small, kept on the GPU for further runs on the same mesh and grid.
  class Classification
  {
  private:
    friend class vtkSurfacePass;

    /// Whether it was made for the same triangles, voxels and settings; made ready to be filled
    /// when not.
    bool Prepare(const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, const Settings& settings);

    vtkTriangleDispatch::Classification Triangles;
    vtkVoxelGL::Buffer Deferred;
    const vtkVoxelMesh* Mesh = nullptr;
    int Upload = 0;
    vtkVoxelGrid Grid;
    float CutoffArea = 0.0f;
    LargeTriangles Large = LargeTriangles::Tiles;
  };

  struct Settings
  {
    int Separability = 26; ///< 26: all touched voxels; 6: the thin surface
    float CutoffArea = DefaultCutoffArea;
    LargeTriangles Large = LargeTriangles::Tiles;
    Operation Effect = Operation::Set;
    Classification* Classified = nullptr; ///< to use and to fill, for geometry that stays
  };
  static constexpr float DefaultCutoffArea = 1024.0f;

  explicit vtkSurfacePass(vtkVoxelGL::Context context);

  /// The pass of a context, kept there since it holds buffers worth reusing.
  static vtkSurfacePass& Get(const vtkVoxelGL::Context& context);

  /// Sets or clears the voxels of `target` that the triangles overlap and leaves the others. False
  /// when told to stop. Throws std::runtime_error.
  bool Run(const vtkVoxelMesh& mesh, vtkSlicemap* target, const Settings& settings,
    const Progress& progress);

  /// What becomes of each pair of a triangle and a voxel that it overlaps: GLSL with a function
  /// visit(), see vtkSurfaceFacet.glsl, and what it needs; vtkSurfaceWords.glsl is there. Storage
  /// buffers 2 and 3 and texture units 1 to 3 are taken.
  struct Visitor
  {
    std::string Source;
    vtkVoxelGL::Program::Defines Defines;
    std::function<void(vtkVoxelGL::Program&)> Bind;
  };

  /// Visits all pairs on the grid of `slicemap`. False when told to stop. Throws
  /// std::runtime_error.
  bool Visit(const vtkVoxelMesh& mesh, vtkSlicemap* slicemap, const Settings& settings,
    const Visitor& visitor, const Progress& progress);

  /// The cutoff at which both ways take the same time on this renderer: found by a bracketing
  /// search with triangles made for it when `mesh` first has some that may be large on `grid`, then
  /// remembered; DefaultCutoffArea as long as it has none. Throws std::runtime_error.
  float FindCutoffArea(vtkVoxelContext* context, const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid,
    LargeTriangles large);

private:
  float SearchCutoffArea(vtkVoxelContext* context, LargeTriangles large);

  struct Slab;

  void VisitSlab(
    const vtkVoxelMesh& mesh, const Settings& settings, const Visitor& visitor, const Slab& slab);
  void DrawDeferred(const vtkVoxelMesh& mesh, const Settings& settings, const Visitor& visitor,
    const Slab& slab, const vtkVoxelGL::Buffer& deferred);

  vtkVoxelGL::Context Context;
  vtkTriangleDispatch Dispatch;
  vtkVoxelGL::Buffer Deferred;
};

#endif
// VTK-HeaderTest-Exclude: vtkSurfacePass.h
