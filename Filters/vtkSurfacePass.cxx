// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfacePass.h"

#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
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
#include "vtkSurfaceWordsGLSL.h"
#include "vtkVoxelMeshFetchGLSL.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <random>
#include <utility>

using vtkVoxelGL::Program;

namespace
{
constexpr std::int64_t WordBytes = 4;
constexpr GLuint SlicemapBinding = 0;

// Those before are the mesh's.
constexpr unsigned int PresentUnit = 5;

// The search for a cutoff.
constexpr float SmallestCutoffArea = 64.0f;
constexpr int SearchSteps = 5;
constexpr int SearchRepetitions = 3;
constexpr int SearchVoxels = 256;
constexpr double SearchColumns = 262144.0;

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
    define("TIGHTENS_BOUNDS", precision == "Far" ? "1" : "0");
    return text + vtkSurfaceOverlapGLSL;
  };
  return { vtkSurfaceFacetGLSL, instance("Near", "float", "vec"), instance("Far", "double", "dvec"),
    vtkSurfaceRowsGLSL };
}

std::array<int, 3> ToArray(const glm::ivec3& v)
{
  return { v.x, v.y, v.z };
}

/// Triangles in a cube of SearchVoxels, about as many as cover the same number of columns whatever
/// their area, which is that of their bounds seen along the axis closest to their normal.
vtkSmartPointer<vtkPolyData> MakeTriangles(float area)
{
  std::mt19937 random;
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double side = std::sqrt(area);
  const int count = std::clamp(static_cast<int>(SearchColumns / area), 16, 4096);
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> triangles;
  for (int i = 0; i < count; ++i)
  {
    const glm::dvec3 corner =
      (SearchVoxels - side) * glm::dvec3(unit(random), unit(random), unit(random));
    const double slope = 0.5 * side * unit(random);
    const int axis = i % 3;
    vtkIdType ids[3];
    for (int j = 0; j < 3; ++j)
    {
      glm::dvec3 point = corner;
      point[axis] += j * slope;
      point[(axis + 1) % 3] += j == 1 ? side : 0.0;
      point[(axis + 2) % 3] += j == 2 ? side : 0.0;
      ids[j] = points->InsertNextPoint(&point[0]);
    }
    triangles->InsertNextCell(3, ids);
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  return mesh;
}

/// OpenGL 4.3 promises storage buffers to compute shaders alone.
bool CanDrawFromStorage()
{
  constexpr GLint needed = 2;
  GLint vertex = 0;
  GLint fragment = 0;
  glGetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &vertex);
  glGetIntegerv(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, &fragment);
  return vertex >= 1 && fragment >= needed;
}

Program::Defines GetDefines(
  const vtkSurfacePass::Settings& settings, const vtkSurfacePass::Visitor& visitor)
{
  auto defines = visitor.Defines;
  defines["SEPARABILITY"] = std::to_string(settings.Separability);
  return defines;
}
}

/// Slices of a slicemap, half open, counted from its first one.
struct vtkSurfacePass::Slab
{
  vtkSlicemap* Slicemap;
  int First;
  int End;

  bool IsWhole() const
  {
    return this->First == 0 && this->End == this->Slicemap->GetGrid().GetDimensions().z;
  }

  void SetUniforms(Program& program) const
  {
    const vtkVoxelGrid& grid = this->Slicemap->GetGrid();
    const glm::ivec3 n = grid.GetDimensions();
    const glm::ivec3 first = grid.GetFirst();
    program.Set("First", ToArray(first + glm::ivec3(0, 0, this->First)));
    program.Set("End", ToArray(first + glm::ivec3(n.x, n.y, this->End)));
    program.Set("GridFirst", ToArray(first));
    program.Set("WordsPerRow", static_cast<unsigned int>(this->Slicemap->GetWordsPerRow()));
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

bool vtkSurfacePass::Classification::Prepare(
  const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, const Settings& settings)
{
  const bool isSame = this->Triangles.IsKnown && this->Triangles.Queue && this->Mesh == &mesh &&
    this->Upload == mesh.GetNumberOfUploads() && this->Grid == grid &&
    this->CutoffArea == settings.CutoffArea && this->Large == settings.Large;
  if (!isSame)
  {
    this->Triangles.IsKnown = false;
    this->Mesh = &mesh;
    this->Upload = mesh.GetNumberOfUploads();
    this->Grid = grid;
    this->CutoffArea = settings.CutoffArea;
    this->Large = settings.Large;
  }
  return isSame;
}

bool vtkSurfacePass::Run(
  const vtkVoxelMesh& mesh, vtkSlicemap* target, const Settings& settings, const Progress& progress)
{
  const int slices = target->GetGrid().GetDimensions().z;
  const int slicesPerSlab = vtkSlicemapSlicesPerSlab(target);
  Visitor bits;
  bits.Source = vtkSurfaceBitsGLSL;
  if (settings.Effect == Operation::Clear)
  {
    bits.Defines["REMOVE"] = "1";
  }
  const auto present =
    slicesPerSlab == slices ? vtkSlicemapWordTexture(target) : vtkVoxelGL::Texture();
  if (present)
  {
    bits.Defines["LOOKS"] = "1";
  }
  for (int slice = 0; slice < slices; slice += slicesPerSlab)
  {
    if (!progress(double(slice) / slices))
    {
      return false;
    }
    const Slab slab{ target, slice, std::min(slice + slicesPerSlab, slices) };
    bits.Bind = [&](Program& program)
    {
      vtkSlicemapBindSlab(target, SlicemapBinding, slab.First, slab.End - slab.First);
      if (present)
      {
        present.Bind(PresentUnit);
        program.Set("Present", static_cast<int>(PresentUnit));
      }
    };
    this->VisitSlab(mesh, settings, bits, slab);
  }
  return progress(1.0);
}

bool vtkSurfacePass::Visit(const vtkVoxelMesh& mesh, vtkSlicemap* slicemap,
  const Settings& settings, const Visitor& visitor, const Progress& progress)
{
  if (!progress(0.0))
  {
    return false;
  }
  this->VisitSlab(mesh, settings, visitor, { slicemap, 0, slicemap->GetGrid().GetDimensions().z });
  return progress(1.0);
}

void vtkSurfacePass::VisitSlab(
  const vtkVoxelMesh& mesh, const Settings& settings, const Visitor& visitor, const Slab& slab)
{
  const bool draws = settings.Large == LargeTriangles::Fragments && CanDrawFromStorage();
  vtkTriangleDispatch::Job job;
  job.Name = "vtkSurfaceVoxels";
  job.Sources = GetOverlapSources();
  job.Sources.emplace_back(vtkSurfaceWordsGLSL);
  job.Sources.push_back(visitor.Source);
  job.Sources.emplace_back(vtkSurfaceVoxelsGLSL);
  job.Defines = GetDefines(settings, visitor);
  job.HasTriangleStage = true;
  job.HasTileStage = !draws;
  Classification* classified = slab.IsWhole() ? settings.Classified : nullptr;
  const bool isClassified =
    classified && classified->Prepare(mesh, slab.Slicemap->GetGrid(), settings);
  job.Classified = classified ? &classified->Triangles : nullptr;
  job.FirstStage = classified ? "CLASSIFY" : "";
  vtkVoxelGL::Buffer& deferred = classified ? classified->Deferred : this->Deferred;
  if (draws)
  {
    job.Defines["DEFER_TO_FRAGMENTS"] = "1";
    if (!isClassified)
    {
      vtkVoxelGL::Prepare(
        deferred, this->Context, sizeof(NothingDeferred) + mesh.GetNumberOfTriangles() * WordBytes);
      deferred.Upload(0, sizeof(NothingDeferred), NothingDeferred.data());
    }
    deferred.BindBase(GL_SHADER_STORAGE_BUFFER, DeferredBinding);
  }
  job.SetUniforms = [&](Program& program)
  {
    slab.SetUniforms(program);
    program.Set("CutoffArea", std::min(settings.CutoffArea, LargestCutoffArea));
    visitor.Bind(program);
  };
  this->Dispatch.Run(mesh, slab.Slicemap->GetGrid(), job);
  if (draws)
  {
    this->DrawDeferred(mesh, settings, visitor, slab, deferred);
  }
}

void vtkSurfacePass::DrawDeferred(const vtkVoxelMesh& mesh, const Settings& settings,
  const Visitor& visitor, const Slab& slab, const vtkVoxelGL::Buffer& deferred)
{
  const vtkVoxelGrid& grid = slab.Slicemap->GetGrid();
  const vtkColumnAxes axes(2);
  auto defines = GetDefines(settings, visitor);
  defines.merge(vtkTriangleDispatch::GetMeshDefines(mesh, grid, axes));
  std::vector<std::string> fragment{ vtkSlicemapLayoutGLSL, vtkVoxelMeshFetchGLSL };
  for (auto& source : GetOverlapSources())
  {
    fragment.push_back(std::move(source));
  }
  fragment.emplace_back(vtkSurfaceWordsGLSL);
  fragment.push_back(visitor.Source);
  fragment.emplace_back(vtkSurfaceFragmentGLSL);
  Program& program = vtkVoxelGetProgram(this->Context, "vtkSurfaceFragment", defines,
    { { GL_VERTEX_SHADER, { vtkVoxelMeshFetchGLSL, vtkSurfaceFacetGLSL, vtkSurfaceVertexGLSL } },
      { GL_FRAGMENT_SHADER, fragment } },
    vtkVoxelShaderVersion::StorageBuffers);
  program.Use();
  vtkTriangleDispatch::BindMesh(program, mesh, grid, axes);
  slab.SetUniforms(program);
  visitor.Bind(program);

  const glm::ivec3 n = grid.GetDimensions();
  const int longest = std::max({ n.x, n.y, slab.End - slab.First });
  const int window = std::min(longest, LargestWindow);
  vtkVoxelGL::Framebuffer framebuffer(this->Context);
  framebuffer.SetSizeWithoutAttachments(window, window);
  glViewport(0, 0, window, window);
  program.Set("WindowSize", std::array<int, 2>{ window, window });
  vtkVoxelGL::VertexArray vertices(this->Context);
  vertices.Bind();
  deferred.Bind(GL_DRAW_INDIRECT_BUFFER);
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

float vtkSurfacePass::FindCutoffArea(vtkVoxelContext* context, const vtkVoxelMesh& mesh,
  const vtkVoxelGrid& grid, LargeTriangles large)
{
  if (mesh.EstimateLargestArea(grid.GetWorldToIndex()) < SmallestCutoffArea)
  {
    return DefaultCutoffArea;
  }
  static std::mutex mutex;
  static std::map<std::pair<std::string, LargeTriangles>, float> known;
  const std::lock_guard<std::mutex> lock(mutex);
  float& area = known[{ this->Context->GetRendererName(), large }];
  if (area == 0.0f)
  {
    area = this->SearchCutoffArea(context, large);
  }
  return area;
}

float vtkSurfacePass::SearchCutoffArea(vtkVoxelContext* context, LargeTriangles large)
{
  vtkNew<vtkSlicemap> scratch;
  scratch->SetContext(context);
  vtkVoxelGrid grid;
  grid.Extent = { 0, SearchVoxels - 1, 0, SearchVoxels - 1, 0, SearchVoxels - 1 };
  if (!scratch->Allocate(grid))
  {
    return DefaultCutoffArea;
  }
  scratch->GetBuffer().Fill(0);
  float low = SmallestCutoffArea;
  float high = LargestCutoffArea;
  for (int step = 0; step < SearchSteps; ++step)
  {
    const float area = std::sqrt(low * high);
    vtkVoxelMesh mesh;
    mesh.Update(this->Context, MakeTriangles(area), vtkVoxelMesh::Triangulation::Fans);
    const auto time = [&](float cutoff)
    {
      Settings settings;
      settings.CutoffArea = cutoff;
      settings.Large = large;
      auto best = std::chrono::steady_clock::duration::max();
      for (int i = 0; i < SearchRepetitions; ++i)
      {
        const auto start = std::chrono::steady_clock::now();
        this->Run(mesh, scratch, settings, [](double) { return true; });
        glFinish();
        best = std::min(best, std::chrono::steady_clock::now() - start);
      }
      return best;
    };
    (time(LargestCutoffArea) <= time(AllAreLarge) ? low : high) = area;
  }
  return std::sqrt(low * high);
}
