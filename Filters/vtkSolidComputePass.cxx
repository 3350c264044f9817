// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSolidComputePass.h"

#include "vtkSlicemap.h"
#include "vtkSlicemapKernel.h"
#include "vtkSurfacePass.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelMesh.h"

#include "vtkSlicemapLayoutGLSL.h"
#include "vtkSolidCrossingsGLSL.h"
#include "vtkSolidScanGLSL.h"
#include "vtkSolidWindingGLSL.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

using vtkVoxelGL::Program;

namespace
{
constexpr std::int64_t WordBytes = 4;
constexpr std::int64_t WordsPerQuad = 4;

// Renderers in software end the loops of an invocation after 65,535 turns.
constexpr int LongestLoop = 65535;

constexpr std::int64_t LargestCounterBytes = std::int64_t(1) << 26;

// Of variants that are done at once: bytes of their words, and triangles that may have to wait.
constexpr std::int64_t VariantBytes = std::int64_t(1) << 24;
constexpr std::int64_t VariantTriangles = std::int64_t(1) << 22;
constexpr std::int64_t MostVariants = 64;

// Units of textures and indices of storage buffers, as in the shaders.
constexpr unsigned int QuadsUnit = 0;

std::array<int, 3> ToArray(const glm::ivec3& v)
{
  return { v.x, v.y, v.z };
}

std::int64_t GetStorageLimit()
{
  GLint64 limit = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
  return limit;
}

std::int64_t GetOffsetAlignment()
{
  GLint alignment = 0;
  glGetIntegerv(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT, &alignment);
  return alignment;
}

/// A row along x each, or the columns of four words side by side.
std::int64_t GetInvocationsOfScan(int axis, const glm::ivec3& size, std::int64_t quadsPerRow)
{
  return axis == 0 ? std::int64_t(size.y) * size.z : quadsPerRow * (axis == 1 ? size.z : size.y);
}

/// Whether so many triangles lie between the columns that it pays to sort them out beforehand.
bool MostMissAllColumns(
  const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, const vtkColumnAxes& axes)
{
  constexpr double largestMeanArea = 0.06;
  const glm::dvec3 areas = mesh.EstimateProjectedAreas(grid.GetWorldToIndex());
  return areas[axes.Depth] < largestMeanArea * mesh.GetNumberOfTriangles();
}
}

/// Voxels of one dispatch, half open, in index coordinates in the order x, y, z.
struct vtkSolidComputePass::Box
{
  glm::ivec3 First;
  glm::ivec3 End;
  bool Begins = true; // whether the first voxels of the columns are in the box
  bool Ends = true;
};

/// Of the grids that lie one behind the other in a slab.
struct vtkSolidComputePass::GridRange
{
  int First;
  int Count;
};

vtkSolidComputePass::vtkSolidComputePass(vtkVoxelGL::Context context, Ties ties)
  : Context(std::move(context))
  , OnSurface(ties)
  , Dispatch(this->Context)
{
}

bool vtkSolidComputePass::FillSolid(
  const vtkVoxelMesh& mesh, vtkSlicemap* target, int axis, Rule rule, const Progress& progress)
{
  return rule == Rule::Parity ? this->FillParity(mesh, target, axis, progress)
                              : this->FillNonZero(mesh, target, axis, progress);
}

int vtkSolidComputePass::GetPossibleAxis(int axis, Rule rule, const vtkVoxelGrid& whole) const
{
  // Columns along z need all words at once.
  const bool fits = vtkSlicemap::GetNumberOfWords(whole) * WordBytes <= GetStorageLimit();
  return rule == Rule::NonZero && axis == 2 && !fits ? 1 : axis;
}

bool vtkSolidComputePass::FillParity(
  const vtkVoxelMesh& mesh, vtkSlicemap* target, int axis, const Progress& progress)
{
  const vtkVoxelGrid& grid = target->GetGrid();
  const glm::ivec3 n = grid.GetDimensions();
  const vtkColumnAxes axes(axis);
  this->StartColumnEnds(target, axes);
  if (axis != 0)
  {
    vtkVoxelGL::Prepare(this->ColumnCarries, this->Context, this->ColumnEnds->GetNumberOfBytes());
    this->ColumnCarries.Fill(0);
  }
  target->GetBuffer().Fill(0);

  const int slicesPerSlab = vtkSlicemapSlicesPerSlab(target);
  for (int slice = 0; slice < n.z; slice += slicesPerSlab)
  {
    if (!progress(double(slice) / n.z))
    {
      return false;
    }
    const int end = std::min(slice + slicesPerSlab, n.z);
    Box box{ grid.GetFirst() + glm::ivec3(0, 0, slice),
      grid.GetFirst() + glm::ivec3(n.x, n.y, end) };
    box.Begins = axis != 2 || slice == 0;
    box.Ends = axis != 2 || end == n.z;
    vtkSlicemapBindSlab(target, 0, slice, end - slice);
    // Columns along x and y end in the slab's slices, those along z all in one plane.
    const std::int64_t endBytesPerRow = this->ColumnEnds->GetWordsPerRow() * WordBytes;
    this->ColumnEnds->GetBuffer().BindRange(GL_SHADER_STORAGE_BUFFER, 1,
      axes.V == 2 ? slice * endBytesPerRow : 0, (axes.V == 2 ? end - slice : n.y) * endBytesPerRow);
    this->RunTriangles(mesh, target, { { "COLUMN_AXIS", std::to_string(axis) } }, axes, box);
    this->Scan(target, axis, box);
  }
  return progress(1.0);
}

int vtkSolidComputePass::GetVariantsAtOnce(
  const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, int count)
{
  // Small grids share what a dispatch costs, small triangles that they are fetched and sorted out.
  constexpr std::int64_t smallGrid = std::int64_t(1) << 19;
  constexpr std::int64_t bytesPerSmallTriangle = 64;
  constexpr int fewest = 4;
  const std::int64_t triangles = mesh.GetNumberOfTriangles();
  const std::int64_t bytes = vtkSlicemap::GetNumberOfWords(grid) * WordBytes;
  const std::int64_t room = std::min(GetStorageLimit(), VariantBytes) / bytes;
  const glm::ivec3 n = grid.GetDimensions();
  const bool scansAtOnce = std::max({ n.x, n.y, n.z }) <= LongestLoop;
  const bool pays = bytes <= smallGrid || bytes <= bytesPerSmallTriangle * triangles;
  const std::int64_t most =
    std::min({ std::int64_t(count), MostVariants, room, VariantTriangles / triangles });
  if (!scansAtOnce || !pays || most < fewest)
  {
    return 1;
  }
  const std::int64_t rounds = (count + most - 1) / most;
  return static_cast<int>((count + rounds - 1) / rounds);
}

void vtkSolidComputePass::FillVariants(const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid,
  const std::vector<vtkVoxelMeshVariants::Variant>& variants, vtkSlicemap* target)
{
  this->Variants.Upload(this->Context, variants);
  target->GetBuffer().Fill(0);
  const Box box{ grid.GetFirst(), grid.GetFirst() + grid.GetDimensions() };
  for (std::size_t first = 0, end = 0; first < variants.size(); first = end)
  {
    const int axis = variants[first].ColumnAxis;
    while (end < variants.size() && variants[end].ColumnAxis == axis)
    {
      ++end;
    }
    const vtkColumnAxes axes(axis);
    target->GetBuffer().BindBase(GL_SHADER_STORAGE_BUFFER, 0);
    auto job = this->MakeJob(target, { { "COLUMN_AXIS", std::to_string(axis) } }, axes, box);
    job.Variants = { &this->Variants, static_cast<std::uint32_t>(first),
      static_cast<std::uint32_t>(end) };
    const auto setUniforms = job.SetUniforms;
    job.SetUniforms = [&](Program& program)
    {
      setUniforms(program);
      program.Set("SlicesPerGrid", static_cast<unsigned int>(grid.GetDimensions().z));
    };
    this->Dispatch.Run(mesh, grid, job);

    this->ScanGrids(target, axis, grid.GetDimensions(),
      { static_cast<int>(first), static_cast<int>(end - first) });
  }
}

void vtkSolidComputePass::RunTriangles(const vtkVoxelMesh& mesh, vtkSlicemap* target,
  const Program::Defines& defines, const vtkColumnAxes& axes, const Box& box)
{
  const vtkVoxelGrid& grid = target->GetGrid();
  auto job = this->MakeJob(target, defines, axes, box);
  job.FirstStage = MostMissAllColumns(mesh, grid, axes) ? "SIEVE" : "";
  const auto setUniforms = job.SetUniforms;
  job.SetUniforms = [&](Program& program)
  {
    setUniforms(program);
    program.Set("EndWordsPerRow", static_cast<unsigned int>(this->ColumnEnds->GetWordsPerRow()));
  };
  this->Dispatch.Run(mesh, grid, job);
}

vtkTriangleDispatch::Job vtkSolidComputePass::MakeJob(vtkSlicemap* target,
  const Program::Defines& defines, const vtkColumnAxes& axes, const Box& box) const
{
  vtkTriangleDispatch::Job job;
  job.Name = "vtkSolidCrossings";
  job.Sources = { vtkSolidCrossingsGLSL };
  job.Defines = defines;
  if (this->OnSurface == Ties::UpperInside)
  {
    job.Defines["UPPER_INCLUDED"] = "1";
  }
  job.Axes = axes;
  job.SetUniforms = [target, axes, box](Program& program)
  {
    const vtkVoxelGrid& grid = target->GetGrid();
    program.Set("First", ToArray(axes(box.First)));
    program.Set("End", ToArray(axes(box.End)));
    program.Set("Begins", int(box.Begins));
    program.Set("Ends", int(box.Ends));
    program.Set("GridFirst", ToArray(axes(grid.GetFirst())));
    program.Set("WordsPerRow", static_cast<unsigned int>(target->GetWordsPerRow()));
    program.Set("RowsPerSlice", static_cast<unsigned int>(grid.GetDimensions().y));
  };
  return job;
}

Program& vtkSolidComputePass::UseScan(
  vtkSlicemap* target, int axis, const glm::ivec3& size, Program::Defines defines)
{
  defines["COLUMN_AXIS"] = std::to_string(axis);
  Program& program = vtkVoxelGetProgram(this->Context, "vtkSolidScan", defines,
    { { GL_COMPUTE_SHADER, { vtkSlicemapLayoutGLSL, vtkSolidScanGLSL } } });
  program.Use();
  program.Set("Quads", int(QuadsUnit));
  program.Set("Size", ToArray(size));
  program.Set("QuadsPerRow", static_cast<unsigned int>(target->GetWordsPerRow() / WordsPerQuad));
  return program;
}

void vtkSolidComputePass::ScanGrids(
  vtkSlicemap* target, int axis, const glm::ivec3& size, const GridRange& grids)
{
  Program& program = this->UseScan(target, axis, size, { { "GRIDS", "1" } });
  const auto quads = vtkSlicemapTexture(target);
  quads.Bind(QuadsUnit);
  program.Set("FirstQuad", 0u);
  program.Set("FirstStep", 0);
  program.Set("Steps", axis == 0 ? 1 : size[axis]);
  program.Set("FirstGrid", static_cast<unsigned int>(grids.First));
  program.Set("NumberOfGrids", static_cast<unsigned int>(grids.Count));
  vtkVoxelDispatch(
    grids.Count * GetInvocationsOfScan(axis, size, target->GetWordsPerRow() / WordsPerQuad));
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

void vtkSolidComputePass::Scan(vtkSlicemap* target, int axis, const Box& box)
{
  const glm::ivec3 size = box.End - box.First;
  const std::int64_t quadsPerRow = target->GetWordsPerRow() / WordsPerQuad;
  const int firstSlice = box.First.z - target->GetGrid().GetFirst().z;
  Program& program = this->UseScan(target, axis, size, {});
  const auto quads = vtkSlicemapTexture(target);
  quads.Bind(QuadsUnit);
  program.Set("FirstQuad",
    static_cast<unsigned int>(firstSlice * quadsPerRow * target->GetGrid().GetDimensions().y));
  program.Set("EndWordsPerRow", static_cast<unsigned int>(this->ColumnEnds->GetWordsPerRow()));
  if (axis != 0)
  {
    // Columns along y begin anew in each slab.
    const std::int64_t carryBytes = quadsPerRow * WordsPerQuad * WordBytes;
    this->ColumnCarries.BindRange(GL_SHADER_STORAGE_BUFFER, 2,
      axis == 1 ? firstSlice * carryBytes : 0, (axis == 1 ? size.z : size.y) * carryBytes);
  }
  const std::int64_t invocations = GetInvocationsOfScan(axis, size, quadsPerRow);
  const int length = axis == 0 ? 1 : size[axis];
  for (int step = 0; step < length; step += LongestLoop)
  {
    const int steps = std::min(LongestLoop, length - step);
    program.Set("FirstStep", step);
    program.Set("Steps", steps);
    program.Set("Ends", int(box.Ends && step + steps == length));
    vtkVoxelDispatch(invocations);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
  }
}

bool vtkSolidComputePass::FillNonZero(
  const vtkVoxelMesh& mesh, vtkSlicemap* target, int axis, const Progress& progress)
{
  const vtkVoxelGrid& grid = target->GetGrid();
  const vtkColumnAxes axes(axis);
  const glm::ivec3 n = axes(grid.GetDimensions());
  this->StartColumnEnds(target, axes);
  const std::int64_t bytesPerRow = std::int64_t(n.x) * (n.z + 1) * WordBytes;
  const std::int64_t limit = std::min(GetStorageLimit(), LargestCounterBytes);
  const std::int64_t turns = axis == 0 ? target->GetWordsPerRow() : n.z;
  if (bytesPerRow > limit || turns > LongestLoop)
  {
    throw std::runtime_error("The grid with " + grid.Describe() +
      " is too large for the fill rule NonZero. Voxelize in parts, or choose another column axis.");
  }
  const int rowsPerSlab = static_cast<int>(std::min<std::int64_t>(n.y, limit / bytesPerRow));
  vtkVoxelGL::Prepare(this->Counters, this->Context, rowsPerSlab * bytesPerRow);

  const std::int64_t wordsPerV =
    target->GetWordsPerRow() * (axes.V == 2 ? grid.GetDimensions().y : 1);
  const std::int64_t alignment = GetOffsetAlignment();
  for (int v = 0; v < n.y; v += rowsPerSlab)
  {
    if (!progress(double(v) / n.y))
    {
      return false;
    }
    const int rows = std::min(rowsPerSlab, n.y - v);
    this->Counters.Fill(0);
    this->Counters.BindBase(GL_SHADER_STORAGE_BUFFER, 0);
    Box box{ grid.GetFirst(), grid.GetFirst() + grid.GetDimensions() };
    box.First[axes.V] += v;
    box.End[axes.V] = box.First[axes.V] + rows;
    this->RunTriangles(
      mesh, target, { { "COLUMN_AXIS", std::to_string(axis) }, { "WINDING", "1" } }, axes, box);

    Program& program = vtkVoxelGetProgram(this->Context, "vtkSolidWinding",
      { { "COLUMN_AXIS", std::to_string(axis) } },
      { { GL_COMPUTE_SHADER, { vtkSlicemapLayoutGLSL, vtkSolidWindingGLSL } } });
    program.Use();
    const std::int64_t start = v * wordsPerV * WordBytes;
    const std::int64_t aligned = start / alignment * alignment;
    const std::int64_t end =
      axes.V == 2 ? start + rows * wordsPerV * WordBytes : target->GetNumberOfWords() * WordBytes;
    target->GetBuffer().BindRange(GL_SHADER_STORAGE_BUFFER, 1, aligned, end - aligned);
    this->ColumnEnds->GetBuffer().BindBase(GL_SHADER_STORAGE_BUFFER, 2);
    program.Set("FirstRow", static_cast<unsigned int>(v));
    program.Set("EndWordsPerRow", static_cast<unsigned int>(this->ColumnEnds->GetWordsPerRow()));
    program.Set("FirstWord", static_cast<unsigned int>((start - aligned) / WordBytes));
    program.Set("Size", std::array<int, 3>{ n.x, rows, n.z });
    program.Set("WordsPerRow", static_cast<unsigned int>(target->GetWordsPerRow()));
    program.Set("RowsPerSlice", static_cast<unsigned int>(grid.GetDimensions().y));
    vtkVoxelDispatch(
      axis == 0 ? std::uint64_t(n.x) * rows : std::uint64_t(target->GetWordsPerRow()) * rows);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
  }
  return progress(1.0);
}

bool vtkSolidComputePass::Touch(
  const vtkVoxelMesh& mesh, vtkSlicemap* target, TouchedVoxels operation, const Progress& progress)
{
  vtkSurfacePass::Settings settings;
  settings.Effect = operation == TouchedVoxels::Clear ? vtkSurfacePass::Operation::Clear
                                                      : vtkSurfacePass::Operation::Set;
  return vtkSurfacePass::Get(this->Context).Run(mesh, target, settings, progress);
}

double vtkSolidComputePass::EstimateCost(
  const vtkVoxelGrid& grid, int axis, const glm::dvec3& projectedAreas) const
{
  // Columns along z step through memory slice by slice, those along y row by row; along x all bits
  // of a word belong to one column.
  constexpr std::array<double, 3> scanOfWord{ 0.9, 0.7, 3.0 };
  constexpr double crossing = 25.0;
  return crossing * projectedAreas[axis] +
    scanOfWord[axis] * static_cast<double>(vtkSlicemap::GetNumberOfWords(grid));
}
