// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTriangleDispatch.h"

#include "vtkSlicemapKernel.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelMesh.h"
#include "vtkVoxelMeshVariants.h"

#include "vtkSlicemapLayoutGLSL.h"
#include "vtkVoxelMeshDisplacementGLSL.h"
#include "vtkVoxelMeshFetchGLSL.h"
#include "vtkVoxelMeshVariantsGLSL.h"
#include "vtkVoxelTileQueueGLSL.h"
#include "vtkVoxelTriangleRangeGLSL.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using vtkVoxelGL::Program;

namespace
{
// As in vtkVoxelTileQueue.glsl.
constexpr std::size_t QueueCapacity = 262144;
constexpr std::size_t WordsPerTile = 2;
constexpr std::size_t QueueHeaderWords = 21;
constexpr std::size_t WordBytes = 4;
constexpr int TileSize = 64;
constexpr GLintptr CutGroupsOffset = 0;
constexpr GLintptr TileGroupsOffset = 12;
constexpr GLintptr UncutGroupsOffset = 24;
constexpr GLintptr TriangleGroupsOffset = 36;
constexpr GLintptr RestGroupsOffset = 48;
constexpr GLuint QueueBinding = 2;

constexpr unsigned int MeshUnit = 1;
constexpr unsigned int VariantsUnit = 7;

// Of one invocation: fetching a triangle pays for many, and many invocations keep a GPU busy.
constexpr std::uint32_t VariantsAtOnce = 16;

/// The swizzle of the axes where each of them depends on one world axis alone, its own; else empty.
std::string GetAlignedAxes(const glm::dmat4& matrix, const vtkColumnAxes& axes)
{
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      if (row != column && matrix[column][row] != 0.0)
      {
        return {};
      }
    }
  }
  const char* const names = "xyz";
  return { names[axes.U], names[axes.V], names[axes.Depth] };
}

void SetIndexFromWorld(
  Program& program, const glm::dmat4& matrix, const vtkColumnAxes& axes, bool aligned)
{
  const std::array<int, 3> order{ axes.U, axes.V, axes.Depth };
  for (int i = 0; i < 3; ++i)
  {
    const int row = order[i];
    const double first = aligned ? matrix[row][row] : matrix[0][row];
    const std::string name = "IndexFromWorld[" + std::to_string(i) + "]";
    program.Set(
      name.c_str(), std::array<double, 4>{ first, matrix[1][row], matrix[2][row], matrix[3][row] });
  }
}

/// Largest sum of terms, without their signs, that makes an index coordinate of the mesh.
double GetLargestTerms(const vtkVoxelMesh& mesh, const glm::dmat4& indexFromWorld)
{
  double largest = 0.0;
  for (int row = 0; row < 3; ++row)
  {
    double sum = std::abs(indexFromWorld[3][row]);
    for (int column = 0; column < 3; ++column)
    {
      sum += std::abs(indexFromWorld[column][row]) * mesh.GetLargestCoordinate();
    }
    largest = std::max(largest, sum);
  }
  return largest;
}

/// Tiles along the longest axis: no triangle has more on either of its own.
std::uint32_t TilesOfGrid(const vtkVoxelGrid& grid)
{
  const glm::ivec3 n = grid.GetDimensions();
  return static_cast<std::uint32_t>((std::max({ n.x, n.y, n.z }) + TileSize) / TileSize + 1);
}

/// What rounding may do to an index coordinate.
template <typename Real>
Real GetMargin(double roundings, double largestTerms)
{
  constexpr double smallest = 1e-6;
  return static_cast<Real>(
    std::max(smallest, roundings * std::numeric_limits<Real>::epsilon() * largestTerms));
}
}

namespace
{
/// An empty queue with room for so many triangles, small ones too when they are to wait.
void StartQueue(vtkVoxelGL::Buffer& queue, const vtkVoxelGL::Context& context,
  std::uint32_t triangles, const vtkVoxelGrid& grid, bool leavesRest)
{
  const std::size_t words =
    QueueHeaderWords + WordsPerTile * QueueCapacity + std::size_t(triangles) * (leavesRest ? 3 : 2);
  vtkVoxelGL::Prepare(queue, context, words * WordBytes);
  const std::uint32_t tiles = TilesOfGrid(grid);
  const std::array<std::uint32_t, QueueHeaderWords> header{ 0, 1, 1, 0, 1, 1, tiles, tiles, 0, 0, 1,
    1, 0, 1, 1, 0, 0, 0, 0, 0, triangles };
  queue.Upload(0, sizeof(header), header.data());
}
}

vtkTriangleDispatch::vtkTriangleDispatch(vtkVoxelGL::Context context)
  : Context(std::move(context))
{
}

Program::Defines vtkTriangleDispatch::GetMeshDefines(
  const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, const vtkColumnAxes& axes)
{
  Program::Defines defines = mesh.GetDefines();
  const std::string aligned = GetAlignedAxes(grid.GetWorldToIndex(), axes);
  if (!aligned.empty())
  {
    defines["AXES_ALIGNED"] = aligned;
  }
  return defines;
}

void vtkTriangleDispatch::BindMesh(
  Program& program, const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, const vtkColumnAxes& axes)
{
  const glm::dmat4 indexFromWorld = grid.GetWorldToIndex();
  mesh.Bind(program, MeshUnit);
  SetIndexFromWorld(program, indexFromWorld, axes, !GetAlignedAxes(indexFromWorld, axes).empty());
  const double largestTerms = GetLargestTerms(mesh, indexFromWorld);
  program.Set("Margin", GetMargin<double>(64.0, largestTerms));
  program.Set("SingleMargin", GetMargin<float>(16.0, largestTerms));
}

void vtkTriangleDispatch::BindVariants(
  Program& program, const vtkVoxelMesh& mesh, const VariantRange& range)
{
  mesh.Bind(program, MeshUnit);
  range.Variants->Bind(program, VariantsUnit);
  double largestTerms = 0.0;
  for (const auto& variant : range.Variants->Get())
  {
    largestTerms = std::max(largestTerms, GetLargestTerms(mesh, variant.IndexFromWorld));
  }
  program.Set("SingleMargin", GetMargin<float>(16.0, largestTerms));
  program.Set("FirstVariant", range.First);
  program.Set("EndVariant", range.End);
  program.Set("VariantsAtOnce", VariantsAtOnce);
}

void vtkTriangleDispatch::StartLaterStages()
{
  Program& program = vtkVoxelGetProgram(this->Context, "vtkVoxelTileQueue",
    { { "ARGUMENTS", "1" } }, { { GL_COMPUTE_SHADER, { vtkVoxelTileQueueGLSL } } });
  program.Use();
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void vtkTriangleDispatch::Run(const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, const Job& job)
{
  vtkVoxelGL::Buffer& queue = job.Classified ? job.Classified->Queue : this->Queue;
  const bool leavesRest = !job.FirstStage.empty();
  const bool isClassified = job.Classified && job.Classified->IsKnown;
  const VariantRange& range = job.Variants;
  const std::uint32_t triangles = mesh.GetNumberOfTriangles();
  if (!isClassified)
  {
    StartQueue(queue, this->Context,
      range.Variants ? triangles * static_cast<std::uint32_t>(range.Variants->Get().size())
                     : triangles,
      grid, leavesRest);
  }
  queue.BindBase(GL_SHADER_STORAGE_BUFFER, QueueBinding);

  std::vector<std::string> sources{ vtkSlicemapLayoutGLSL, vtkVoxelMeshVariantsGLSL,
    vtkVoxelMeshDisplacementGLSL, vtkVoxelMeshFetchGLSL, vtkVoxelTriangleRangeGLSL,
    vtkVoxelTileQueueGLSL };
  sources.insert(sources.end(), job.Sources.begin(), job.Sources.end());
  auto defines = job.Defines;
  if (range.Variants)
  {
    defines["VARIANTS"] = "1";
    defines.merge(mesh.GetDefines());
  }
  else
  {
    defines.merge(GetMeshDefines(mesh, grid, job.Axes));
  }
  const auto use = [&]
  {
    Program& program =
      vtkVoxelGetProgram(this->Context, job.Name, defines, { { GL_COMPUTE_SHADER, sources } });
    program.Use();
    if (range.Variants)
    {
      BindVariants(program, mesh, range);
    }
    else
    {
      BindMesh(program, mesh, grid, job.Axes);
    }
    job.SetUniforms(program);
  };

  if (!isClassified)
  {
    if (leavesRest)
    {
      defines[job.FirstStage] = "1";
    }
    use();
    defines.erase(job.FirstStage);
    const std::uint32_t turns =
      range.Variants ? (range.End - range.First + VariantsAtOnce - 1) / VariantsAtOnce : 1;
    vtkVoxelDispatch(std::uint64_t(triangles) * turns);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
  this->StartLaterStages();
  const auto runStage = [&](const char* name, GLintptr groups)
  {
    defines[name] = "1";
    use();
    defines.erase(name);
    queue.Bind(GL_DISPATCH_INDIRECT_BUFFER);
    glDispatchComputeIndirect(groups);
  };
  if (job.Classified)
  {
    job.Classified->IsKnown = true;
  }
  if (leavesRest)
  {
    runStage("REST", RestGroupsOffset);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    this->StartLaterStages();
  }
  if (job.HasTriangleStage)
  {
    runStage("TRIANGLES", TriangleGroupsOffset);
  }
  if (job.HasTileStage)
  {
    runStage("CUT", CutGroupsOffset);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    runStage("TILES", TileGroupsOffset);
    runStage("UNCUT", UncutGroupsOffset);
  }
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
}
