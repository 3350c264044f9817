// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkTriangleDispatch.h
 * Private header: compute shaders over the triangles of a mesh, balanced for tiny and huge ones.
 *
 * The first stage has one invocation a triangle. It may list large triangles, which the stage with
 * CUT defined cuts into tiles of equal size (vtkVoxelTileQueue.glsl), for which the stages with
 * TILES and UNCUT defined have one workgroup each, and triangles that want other code, for which
 * the stage with TRIANGLES defined has one invocation each. The source is the same, and the GPU
 * decides how many there are. Needs OpenGL 4.3.
 */

#ifndef vtkTriangleDispatch_h
#define vtkTriangleDispatch_h

#include "vtkSolidPass.h" // for vtkColumnAxes
#include "vtkVoxelGLObjects.h"

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

class vtkVoxelMesh;
class vtkVoxelMeshVariants;
struct vtkVoxelGrid;

class vtkTriangleDispatch
{
public:
  explicit vtkTriangleDispatch(vtkVoxelGL::Context context);

  /// The triangles that a first stage left to others, all of them. As long as it is known the first
  /// stage is left out.
  struct Classification
  {
    vtkVoxelGL::Buffer Queue;
    bool IsKnown = false;
  };

  /// Several variants of the mesh in one dispatch, those from First on and up to End. Each
  /// invocation of the first stage does some of them.
  struct VariantRange
  {
    const vtkVoxelMeshVariants* Variants = nullptr; ///< none: the mesh as it is
    std::uint32_t First = 0;
    std::uint32_t End = 0;
  };

  struct Job
  {
    std::string Name;                 ///< of the program
    std::vector<std::string> Sources; ///< what follows the mesh, the triangles and the queue
    vtkVoxelGL::Program::Defines Defines;
    vtkColumnAxes Axes{ 2 }; ///< order in which the shader wants index coordinates
    std::function<void(vtkVoxelGL::Program&)> SetUniforms;
    /// Defined in a first stage that leaves triangles to a stage with REST defined; empty if none
    /// are.
    std::string FirstStage;
    Classification* Classified = nullptr; ///< to be filled, or to be used if known
    VariantRange Variants;
    bool HasTriangleStage = false;
    bool HasTileStage = true; ///< of large triangles
  };

  /// Runs the stages and makes what they wrote visible to all that follows.
  void Run(const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, const Job& job);

  /// Defines, textures and uniforms that vtkVoxelMeshFetch.glsl wants, and the uniform Margin: by
  /// how much voxels are to be grown so that rounding never makes them miss a triangle;
  /// SingleMargin is the same for single precision.
  static vtkVoxelGL::Program::Defines GetMeshDefines(
    const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, const vtkColumnAxes& axes);
  static void BindMesh(vtkVoxelGL::Program& program, const vtkVoxelMesh& mesh,
    const vtkVoxelGrid& grid, const vtkColumnAxes& axes);

private:
  void StartLaterStages();
  static void BindVariants(
    vtkVoxelGL::Program& program, const vtkVoxelMesh& mesh, const VariantRange& range);

  vtkVoxelGL::Context Context;
  vtkVoxelGL::Buffer Queue;
};

#endif
// VTK-HeaderTest-Exclude: vtkTriangleDispatch.h
