// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSolidComputePass.h"

#include "vtkSlicemap.h"
#include "vtkSlicemapKernel.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelMesh.h"

#include "vtkSlicemapLayoutGLSL.h"
#include "vtkSolidCrossingsGLSL.h"
#include "vtkSolidScanGLSL.h"
#include "vtkSolidWindingGLSL.h"
#include "vtkTouchedColumnGLSL.h"
#include "vtkTouchedVoxelsGLSL.h"
#include "vtkVoxelMeshFetchGLSL.h"
#include "vtkVoxelTileQueueGLSL.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

using vtkVoxelGL::Program;

namespace
{
constexpr std::int64_t WordBytes = 4;
constexpr std::int64_t WordsPerQuad = 4;

// As in vtkVoxelTileQueue.glsl.
constexpr std::size_t QueueCapacity = 262144;
constexpr std::array<std::uint32_t, 4> EmptyQueue{ 0, 1, 1, 0 };

constexpr std::int64_t LargestCounterBytes = std::int64_t(1) << 26;

// Units of textures and indices of storage buffers, as in the shaders.
constexpr unsigned int QuadsUnit = 0;
constexpr unsigned int MeshUnit = 1;

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

std::int64_t GetBytesPerSlice(vtkSlicemap* slicemap)
{
  return slicemap->GetWordsPerRow() * slicemap->GetGrid().GetDimensions().y * WordBytes;
}

/// Slices of the grid that fit into one storage buffer.
int GetSlicesPerSlab(vtkSlicemap* slicemap)
{
  const int slices = slicemap->GetGrid().GetDimensions().z;
  const std::int64_t fitting = GetStorageLimit() / GetBytesPerSlice(slicemap);
  if (fitting >= slices)
  {
    return slices;
  }
  // Whatever is bound along with the slab has one word a slice at least, so that its offset is a
  // multiple of the alignment too.
  const std::int64_t slabAlignment = std::max<std::int64_t>(1, GetOffsetAlignment() / WordBytes);
  const std::int64_t aligned = fitting / slabAlignment * slabAlignment;
  if (aligned == 0)
  {
    throw std::runtime_error("One slice of the grid with " + slicemap->GetGrid().Describe() +
      " is too large for this OpenGL renderer. Use fewer voxels along x and y, or voxelize in "
      "parts.");
  }
  return static_cast<int>(aligned);
}

void BindSlab(vtkSlicemap* slicemap, GLuint index, int firstSlice, int slices)
{
  const std::int64_t slice = GetBytesPerSlice(slicemap);
  slicemap->GetBuffer().BindRange(
    GL_SHADER_STORAGE_BUFFER, index, firstSlice * slice, slices * slice);
}

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

/// By how much voxels are grown so that rounding never makes them miss a triangle; in voxels.
double GetMargin(double largestTerms)
{
  constexpr double smallest = 1e-6;
  constexpr double roundings = 64.0;
  return std::max(smallest, roundings * std::numeric_limits<double>::epsilon() * largestTerms);
}

void Prepare(vtkVoxelGL::Buffer& buffer, const vtkVoxelGL::Context& context, std::int64_t bytes)
{
  if (!buffer || buffer.GetContext() != context || std::int64_t(buffer.GetSize()) != bytes)
  {
    buffer = vtkVoxelGL::Buffer(context);
    if (!buffer.Allocate(static_cast<std::size_t>(bytes)))
    {
      throw std::runtime_error(
        "OpenGL has no memory left for " + std::to_string(bytes) + " bytes. Use fewer voxels.");
    }
  }
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

vtkSolidComputePass::vtkSolidComputePass(vtkVoxelGL::Context context)
  : Context(std::move(context))
{
}

bool vtkSolidComputePass::FillSolid(
  const vtkVoxelMesh& mesh, vtkSlicemap* target, int axis, Rule rule, const Progress& progress)
{
  if (rule == Rule::Parity)
  {
    return this->FillParity(mesh, target, axis, progress);
  }
  const bool fits = target->GetNumberOfWords() * WordBytes <= GetStorageLimit();
  return this->FillNonZero(mesh, target, axis == 2 && !fits ? 1 : axis, progress);
}

bool vtkSolidComputePass::FillParity(
  const vtkVoxelMesh& mesh, vtkSlicemap* target, int axis, const Progress& progress)
{
  const vtkVoxelGrid& grid = target->GetGrid();
  const glm::ivec3 n = grid.GetDimensions();
  const vtkColumnAxes axes(axis);
  this->StartColumnEnds(target, axes);
  if (axis == 2)
  {
    Prepare(this->ColumnCarries, this->Context, this->ColumnEnds->GetNumberOfBytes());
    this->ColumnCarries.Fill(0);
  }
  target->GetBuffer().Fill(0);

  const int slicesPerSlab = GetSlicesPerSlab(target);
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
    BindSlab(target, 0, slice, end - slice);
    // Columns along x and y end in the slab's slices, those along z all in one plane.
    const std::int64_t endBytesPerRow = this->ColumnEnds->GetWordsPerRow() * WordBytes;
    this->ColumnEnds->GetBuffer().BindRange(GL_SHADER_STORAGE_BUFFER, 1,
      axes.V == 2 ? slice * endBytesPerRow : 0, (axes.V == 2 ? end - slice : n.y) * endBytesPerRow);
    this->RunTriangles(mesh, target, "vtkSolidCrossings", vtkSolidCrossingsGLSL,
      { { "COLUMN_AXIS", std::to_string(axis) } }, axes, box);
    this->Scan(target, axis, box);
  }
  return progress(1.0);
}

void vtkSolidComputePass::RunTriangles(const vtkVoxelMesh& mesh, vtkSlicemap* target,
  const char* name, const char* source, const Program::Defines& defines, const vtkColumnAxes& axes,
  const Box& box)
{
  const vtkVoxelGrid& grid = target->GetGrid();
  Prepare(this->Queue, this->Context, sizeof(EmptyQueue) + QueueCapacity * 2 * WordBytes);
  this->Queue.Upload(0, sizeof(EmptyQueue), EmptyQueue.data());
  this->Queue.BindBase(GL_SHADER_STORAGE_BUFFER, 2);
  const glm::dmat4 indexFromWorld = grid.GetWorldToIndex();
  const double largestTerms = GetLargestTerms(mesh, indexFromWorld);
  const std::string alignedAxes = GetAlignedAxes(indexFromWorld, axes);
  const auto endWordsPerRow =
    static_cast<unsigned int>(this->ColumnEnds ? this->ColumnEnds->GetWordsPerRow() : 0);

  for (const bool tiles : { false, true })
  {
    auto all = defines;
    all.insert({ { "REAL", "double" }, { "REAL2", "dvec2" }, { "REAL3", "dvec3" } });
    if (tiles)
    {
      all["TILES"] = "1";
    }
    if (!alignedAxes.empty())
    {
      all["AXES_ALIGNED"] = alignedAxes;
    }
    if (mesh.HasLowPart())
    {
      all["POINTS_ARE_DOUBLE"] = "1";
    }
    Program& program = vtkVoxelGetProgram(this->Context, name, all,
      { { GL_COMPUTE_SHADER,
        { vtkSlicemapLayoutGLSL, vtkVoxelMeshFetchGLSL, vtkVoxelTileQueueGLSL, vtkTouchedColumnGLSL,
          source } } });
    program.Use();
    mesh.Bind(program, MeshUnit);
    SetIndexFromWorld(program, indexFromWorld, axes, !alignedAxes.empty());
    program.Set("First", ToArray(axes(box.First)));
    program.Set("End", ToArray(axes(box.End)));
    program.Set("Begins", int(box.Begins));
    program.Set("Ends", int(box.Ends));
    program.Set("GridFirst", ToArray(axes(grid.GetFirst())));
    program.Set("WordsPerRow", static_cast<unsigned int>(target->GetWordsPerRow()));
    program.Set("RowsPerSlice", static_cast<unsigned int>(grid.GetDimensions().y));
    program.Set("EndWordsPerRow", endWordsPerRow);
    program.Set("Margin", GetMargin(largestTerms));
    if (tiles)
    {
      this->Queue.Bind(GL_DISPATCH_INDIRECT_BUFFER);
      glDispatchComputeIndirect(0);
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
        GL_BUFFER_UPDATE_BARRIER_BIT);
    }
    else
    {
      vtkVoxelDispatch(mesh.GetNumberOfTriangles());
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    }
  }
}

void vtkSolidComputePass::Scan(vtkSlicemap* target, int axis, const Box& box)
{
  const glm::ivec3 size = box.End - box.First;
  const std::int64_t quadsPerRow = target->GetWordsPerRow() / WordsPerQuad;
  const int firstSlice = box.First.z - target->GetGrid().GetFirst().z;
  Program& program =
    vtkVoxelGetProgram(this->Context, "vtkSolidScan", { { "COLUMN_AXIS", std::to_string(axis) } },
      { { GL_COMPUTE_SHADER, { vtkSlicemapLayoutGLSL, vtkSolidScanGLSL } } });
  program.Use();
  const auto quads = vtkSlicemapTexture(target);
  quads.Bind(QuadsUnit);
  program.Set("Quads", int(QuadsUnit));
  program.Set("FirstQuad",
    static_cast<unsigned int>(firstSlice * quadsPerRow * target->GetGrid().GetDimensions().y));
  program.Set("Size", ToArray(size));
  program.Set("QuadsPerRow", static_cast<unsigned int>(quadsPerRow));
  program.Set("Ends", int(box.Ends));
  program.Set("EndWordsPerRow", static_cast<unsigned int>(this->ColumnEnds->GetWordsPerRow()));
  if (axis == 2)
  {
    this->ColumnCarries.BindBase(GL_SHADER_STORAGE_BUFFER, 2);
  }
  const std::int64_t invocations =
    axis == 0 ? std::int64_t(size.y) * size.z : quadsPerRow * (axis == 1 ? size.z : size.y);
  vtkVoxelDispatch(invocations);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
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
  if (bytesPerRow > limit)
  {
    throw std::runtime_error("The grid with " + grid.Describe() +
      " is too large for the fill rule NonZero. Voxelize in parts, or choose another column axis.");
  }
  const int rowsPerSlab = static_cast<int>(std::min<std::int64_t>(n.y, limit / bytesPerRow));
  Prepare(this->Counters, this->Context, rowsPerSlab * bytesPerRow);

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
    this->RunTriangles(mesh, target, "vtkSolidCrossings", vtkSolidCrossingsGLSL,
      { { "COLUMN_AXIS", std::to_string(axis) }, { "WINDING", "1" } }, axes, box);

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
  const vtkVoxelGrid& grid = target->GetGrid();
  const glm::ivec3 n = grid.GetDimensions();
  const int slicesPerSlab = GetSlicesPerSlab(target);
  Program::Defines defines;
  if (operation == TouchedVoxels::Clear)
  {
    defines["REMOVE"] = "1";
  }
  for (int slice = 0; slice < n.z; slice += slicesPerSlab)
  {
    if (!progress(double(slice) / n.z))
    {
      return false;
    }
    const int end = std::min(slice + slicesPerSlab, n.z);
    const Box box{ grid.GetFirst() + glm::ivec3(0, 0, slice),
      grid.GetFirst() + glm::ivec3(n.x, n.y, end) };
    BindSlab(target, 0, slice, end - slice);
    this->RunTriangles(
      mesh, target, "vtkTouchedVoxels", vtkTouchedVoxelsGLSL, defines, vtkColumnAxes(2), box);
  }
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
  return progress(1.0);
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
