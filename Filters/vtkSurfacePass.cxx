// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfacePass.h"

#include "vtkSlicemap.h"
#include "vtkSlicemapKernel.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelMesh.h"

#include "vtkSlicemapLayoutGLSL.h"
#include "vtkSurfaceBitsGLSL.h"
#include "vtkSurfaceFacetGLSL.h"
#include "vtkSurfaceFragmentGLSL.h"
#include "vtkSurfaceOverlapGLSL.h"
#include "vtkSurfaceRowsGLSL.h"
#include "vtkSurfaceVertexGLSL.h"
#include "vtkSurfaceVoxelsGLSL.h"
#include "vtkVoxelMeshFetchGLSL.h"

#include <algorithm>
#include <array>
#include <stdexcept>

using vtkVoxelGL::Program;

namespace
{
constexpr std::int64_t WordBytes = 4;
constexpr GLuint SlicemapBinding = 0;

// Windows are squares; an OpenGL renderer of today takes them in one piece.
constexpr int LargestWindow = 8192;

// As in vtkSurfaceVoxels.glsl.
constexpr std::array<std::uint32_t, 4> NothingDeferred{ 0, 1, 0, 0 };
constexpr GLuint DeferredBinding = 3;

/// The overlap test in single and in double precision.
std::vector<std::string> GetOverlapSources()
{
  const auto instance =
    [](const std::string& precision, const std::string& real, const std::string& vector)
  {
    std::string text;
    const auto define = [&](const std::string& name, const std::string& value)
    { text += "#undef " + name + "\n#define " + name + " " + value + "\n"; };
    define("REAL", real);
    define("REAL2", vector + "2");
    define("REAL3", vector + "3");
    define("EDGES", precision + "Edges");
    define("OVERLAP", precision + "Overlap");
    return text + vtkSurfaceOverlapGLSL;
  };
  return { vtkSurfaceFacetGLSL, instance("Near", "float", "vec"),
    instance("Far", "double", "dvec"), vtkSurfaceRowsGLSL };
}

std::array<int, 3> ToArray(const glm::ivec3& v)
{
  return { v.x, v.y, v.z };
}

Program::Defines GetDefines(const vtkSurfacePass::Settings& settings)
{
  Program::Defines defines{ { "SEPARABILITY", std::to_string(settings.Separability) } };
  if (settings.Effect == vtkSurfacePass::Operation::Clear)
  {
    defines["REMOVE"] = "1";
  }
  return defines;
}
}

/// Slices of the target that one storage buffer holds, half open, counted from its first slice.
struct vtkSurfacePass::Slab
{
  int First;
  int End;

  void SetUniforms(Program& program, vtkSlicemap* target) const
  {
    const vtkVoxelGrid& grid = target->GetGrid();
    const glm::ivec3 n = grid.GetDimensions();
    const glm::ivec3 first = grid.GetFirst();
    program.Set("First", ToArray(first + glm::ivec3(0, 0, this->First)));
    program.Set("End", ToArray(first + glm::ivec3(n.x, n.y, this->End)));
    program.Set("GridFirst", ToArray(first));
    program.Set("WordsPerRow", static_cast<unsigned int>(target->GetWordsPerRow()));
    program.Set("RowsPerSlice", static_cast<unsigned int>(n.y));
  }
};

vtkSurfacePass::vtkSurfacePass(vtkVoxelGL::Context context)
  : Context(std::move(context))
  , Dispatch(this->Context)
{
}

vtkSurfacePass& vtkSurfacePass::Get(const vtkVoxelGL::Context& context)
{
  auto& cached = context->GetCache()["surface pass"];
  if (!cached)
  {
    cached = std::make_shared<vtkSurfacePass>(context);
  }
  return *static_cast<vtkSurfacePass*>(cached.get());
}

bool vtkSurfacePass::Run(
  const vtkVoxelMesh& mesh, vtkSlicemap* target, const Settings& settings, const Progress& progress)
{
  const int slices = target->GetGrid().GetDimensions().z;
  const int slicesPerSlab = vtkSlicemapSlicesPerSlab(target);
  for (int slice = 0; slice < slices; slice += slicesPerSlab)
  {
    if (!progress(double(slice) / slices))
    {
      return false;
    }
    this->RunSlab(mesh, target, settings, { slice, std::min(slice + slicesPerSlab, slices) });
  }
  return progress(1.0);
}

void vtkSurfacePass::RunSlab(
  const vtkVoxelMesh& mesh, vtkSlicemap* target, const Settings& settings, const Slab& slab)
{
  const vtkVoxelGrid& grid = target->GetGrid();
  const bool draws = settings.Large == LargeTriangles::Fragments;
  const bool noneIsLarge = settings.CutoffArea == NoneIsLarge;
  vtkTriangleDispatch::Job job;
  job.Name = "vtkSurfaceVoxels";
  job.Sources = GetOverlapSources();
  job.Sources.push_back(vtkSurfaceBitsGLSL);
  job.Sources.push_back(vtkSurfaceVoxelsGLSL);
  job.Defines = GetDefines(settings);
  job.HasTriangleStage = settings.CutoffArea >= 0.0f;
  job.HasTileStage = !draws && !noneIsLarge;
  if (draws)
  {
    job.Defines["DEFER_TO_FRAGMENTS"] = "1";
    vtkVoxelGL::Prepare(this->Deferred, this->Context,
      sizeof(NothingDeferred) + mesh.GetNumberOfTriangles() * WordBytes);
    this->Deferred.Upload(0, sizeof(NothingDeferred), NothingDeferred.data());
    this->Deferred.BindBase(GL_SHADER_STORAGE_BUFFER, DeferredBinding);
  }
  vtkSlicemapBindSlab(target, SlicemapBinding, slab.First, slab.End - slab.First);
  job.SetUniforms = [&](Program& program)
  {
    slab.SetUniforms(program, target);
    program.Set("CutoffArea", settings.CutoffArea);
  };
  this->Dispatch.Run(mesh, grid, job);
  if (draws && !noneIsLarge)
  {
    this->DrawDeferred(mesh, target, settings, slab);
  }
}

void vtkSurfacePass::DrawDeferred(
  const vtkVoxelMesh& mesh, vtkSlicemap* target, const Settings& settings, const Slab& slab)
{
  const vtkVoxelGrid& grid = target->GetGrid();
  const vtkColumnAxes axes(2);
  auto defines = GetDefines(settings);
  defines.merge(vtkTriangleDispatch::GetMeshDefines(mesh, grid, axes));
  std::vector<std::string> fragment{ vtkSlicemapLayoutGLSL, vtkVoxelMeshFetchGLSL };
  for (auto& source : GetOverlapSources())
  {
    fragment.push_back(std::move(source));
  }
  fragment.push_back(vtkSurfaceBitsGLSL);
  fragment.push_back(vtkSurfaceFragmentGLSL);
  Program& program = vtkVoxelGetProgram(this->Context, "vtkSurfaceFragment", defines,
    { { GL_VERTEX_SHADER, { vtkVoxelMeshFetchGLSL, vtkSurfaceFacetGLSL, vtkSurfaceVertexGLSL } },
      { GL_FRAGMENT_SHADER, fragment } },
    vtkVoxelShaderVersion::StorageBuffers);
  program.Use();
  vtkTriangleDispatch::BindMesh(program, mesh, grid, axes);
  slab.SetUniforms(program, target);

  const glm::ivec3 n = grid.GetDimensions();
  const int longest = std::max({ n.x, n.y, slab.End - slab.First });
  const int window = std::min(longest, LargestWindow);
  vtkVoxelGL::Framebuffer framebuffer(this->Context);
  framebuffer.SetSizeWithoutAttachments(window, window);
  glViewport(0, 0, window, window);
  program.Set("WindowSize", std::array<int, 2>{ window, window });
  vtkVoxelGL::VertexArray vertices(this->Context);
  vertices.Bind();
  this->Deferred.Bind(GL_DRAW_INDIRECT_BUFFER);
  for (int v = 0; v < longest; v += window)
  {
    for (int u = 0; u < longest; u += window)
    {
      program.Set("WindowFirst", std::array<int, 2>{ u, v });
      glDrawArraysIndirect(GL_TRIANGLES, nullptr);
    }
  }
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
}
