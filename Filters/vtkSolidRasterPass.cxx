// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSolidRasterPass.h"

#include "vtkNew.h"
#include "vtkRasterMeshBinding.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapKernel.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelMesh.h"

#include "vtkColumnRectangleGLSL.h"
#include "vtkExactGLSL.h"
#include "vtkFloatPairsGLSL.h"
#include "vtkPairMeshFetchGLSL.h"
#include "vtkPairRasterFragmentGLSL.h"
#include "vtkPairRasterVertexGLSL.h"
#include "vtkRasterMeshFetchGLSL.h"
#include "vtkSolidMasksGLSL.h"
#include "vtkSolidRasterFragmentGLSL.h"
#include "vtkSolidRasterResolveGLSL.h"
#include "vtkSolidRasterVertexGLSL.h"
#include "vtkTouchedColumnGLSL.h"
#include "vtkTouchedRasterFragmentGLSL.h"
#include "vtkTouchedRasterVertexGLSL.h"
#include "vtkVoxelMeshDisplacementGLSL.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

using vtkVoxelGL::Program;

namespace
{
constexpr int SlicesPerMaskTarget = 128;
constexpr int SlicesPerWindingTarget = 4;
constexpr int MostTargets = 8;
constexpr int WordBits = 32;

// Eight targets of this size take 128 MiB.
constexpr int LargestTile = 1024;

// Units of textures.
constexpr unsigned int ColumnsUnit = 0;
constexpr unsigned int MaskUnit = 1;
constexpr unsigned int MeshUnit = 2;

int PowerOfTwoFrom(int n)
{
  int power = 1;
  while (power < n)
  {
    power *= 2;
  }
  return power;
}

int CeilDivide(int n, int divisor)
{
  return (n + divisor - 1) / divisor;
}

vtkVoxelGL::Texture MakeMaskTable(const vtkVoxelGL::Context& context)
{
  std::vector<std::uint32_t> masks;
  for (int first = 0; first <= SlicesPerMaskTarget; ++first)
  {
    for (int word = 0; word < SlicesPerMaskTarget / WordBits; ++word)
    {
      const int low = std::clamp(first - word * WordBits, 0, WordBits);
      masks.push_back(low == WordBits ? 0u : ~0u << low);
    }
  }
  vtkVoxelGL::Texture table(context, GL_TEXTURE_2D);
  table.Allocate2D(
    GL_RGBA32UI, SlicesPerMaskTarget + 1, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT, masks.data());
  return table;
}
}

/// One pass: a rectangle of columns and a range of slices, counted from the first voxel of the
/// grid.
struct vtkSolidRasterPass::Tile
{
  vtkColumnAxes Axes;
  glm::ivec2 First;
  glm::ivec2 Columns;
  int FirstSlice;
  int Slices;
  int LastSliceOfGrid; // of the voxels, or one more for the column's end
};

/// The render targets of a pass, layers of one texture.
class vtkSolidRasterPass::Targets
{
public:
  Targets(const vtkVoxelGL::Context& context, const glm::ivec2& size, int count, Content content)
    : Size(size)
    , Count(count)
    , IsWinding(content == Content::Winding)
    , Layers(context, GL_TEXTURE_2D_ARRAY)
    , Framebuffer(context)
    , Masks(MakeMaskTable(context))
  {
    const bool allocated = this->IsWinding
      ? this->Layers.Allocate3D(GL_RGBA16F, size.x, size.y, count, GL_RGBA, GL_FLOAT)
      : this->Layers.Allocate3D(
          GL_RGBA32UI, size.x, size.y, count, GL_RGBA_INTEGER, GL_UNSIGNED_INT);
    for (int layer = 0; allocated && layer < count; ++layer)
    {
      this->Framebuffer.AttachLayer(GL_COLOR_ATTACHMENT0 + layer, this->Layers, layer);
    }
    this->Framebuffer.SetDrawBuffers(count);
    if (!allocated || !this->Framebuffer.IsComplete())
    {
      throw std::runtime_error("OpenGL could not make " + std::to_string(count) +
        " render targets of " + std::to_string(size.x) + " x " + std::to_string(size.y) +
        " pixels.");
    }
  }

  void Begin(const glm::ivec2& columns)
  {
    this->Framebuffer.Bind();
    glViewport(0, 0, this->Size.x, this->Size.y);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, columns.x, columns.y);
    for (int target = 0; target < this->Count; ++target)
    {
      const GLuint zeros[4] = { 0, 0, 0, 0 };
      const GLfloat zero[4] = { 0, 0, 0, 0 };
      if (this->IsWinding)
      {
        glClearBufferfv(GL_COLOR, target, zero);
      }
      else
      {
        glClearBufferuiv(GL_COLOR, target, zeros);
      }
    }
  }

  void End() { glDisable(GL_SCISSOR_TEST); }

  glm::ivec2 Size;
  int Count;
  bool IsWinding;
  vtkVoxelGL::Texture Layers;
  vtkVoxelGL::Framebuffer Framebuffer;
  vtkVoxelGL::Texture Masks;
};

/// How triangles are drawn.
struct vtkSolidRasterPass::Stages
{
  const char* Name;
  std::vector<std::string> Vertex;
  std::vector<std::string> Fragment;
  GLsizei VerticesPerTriangle;
};

vtkSolidRasterPass::Stages vtkSolidRasterPass::GetStages(Content content)
{
  switch (content)
  {
    case Content::Touched:
      return { "vtkTouchedRaster",
        { vtkRasterMeshFetchGLSL, vtkColumnRectangleGLSL, vtkTouchedRasterVertexGLSL },
        { vtkSolidMasksGLSL, vtkTouchedColumnGLSL, vtkTouchedRasterFragmentGLSL }, 6 };
    case Content::PairParity:
      return { "vtkPairRaster",
        { vtkVoxelMeshDisplacementGLSL, vtkRasterMeshFetchGLSL, vtkColumnRectangleGLSL,
          vtkPairRasterVertexGLSL },
        { vtkExactGLSL, vtkFloatPairsGLSL, vtkSolidMasksGLSL, vtkVoxelMeshDisplacementGLSL,
          vtkPairMeshFetchGLSL, vtkPairRasterFragmentGLSL },
        6 };
    case Content::Winding:
      return { "vtkSolidRaster", { vtkRasterMeshFetchGLSL, vtkSolidRasterVertexGLSL },
        { vtkSolidRasterFragmentGLSL }, 3 };
    default:
      return { "vtkSolidRaster", { vtkRasterMeshFetchGLSL, vtkSolidRasterVertexGLSL },
        { vtkSolidMasksGLSL, vtkSolidRasterFragmentGLSL }, 3 };
  }
}

vtkSolidRasterPass::vtkSolidRasterPass(vtkVoxelGL::Context context, Ties ties)
  : Context(std::move(context))
  , OnSurface(ties)
{
}

bool vtkSolidRasterPass::FillSolid(
  const vtkVoxelMesh& mesh, vtkSlicemap* target, int axis, Rule rule, const Progress& progress)
{
  this->StartColumnEnds(target, vtkColumnAxes(axis));
  const Content parity =
    this->OnSurface == Ties::UpperInside ? Content::PairParity : Content::Parity;
  return this->Fill(mesh, target, axis, rule == Rule::Parity ? parity : Content::Winding, progress);
}

bool vtkSolidRasterPass::Touch(
  const vtkVoxelMesh& mesh, vtkSlicemap* target, TouchedVoxels operation, const Progress& progress)
{
  vtkNew<vtkSlicemap> touched;
  touched->SetContext(target->GetContext());
  if (!touched->Allocate(target->GetGrid()))
  {
    throw std::runtime_error("There is no room for the touched voxels.");
  }
  constexpr int cheapestAxis = 0;
  if (!this->Fill(mesh, touched, cheapestAxis, Content::Touched, progress))
  {
    return false;
  }
  return operation == TouchedVoxels::Set ? target->Union(touched) : target->Difference(touched);
}

bool vtkSolidRasterPass::Fill(const vtkVoxelMesh& mesh, vtkSlicemap* target, int axis,
  Content content, const Progress& progress)
{
  const vtkColumnAxes axes(axis);
  const glm::ivec3 n = axes(target->GetGrid().GetDimensions());
  const bool withEnds = content != Content::Touched;
  const int slices = n.z + (withEnds ? 1 : 0);

  GLint drawBuffers = 0;
  glGetIntegerv(GL_MAX_DRAW_BUFFERS, &drawBuffers);
  const int mostTargets = std::min<int>(drawBuffers, MostTargets);
  const int slicesPerTarget =
    content == Content::Winding ? SlicesPerWindingTarget : SlicesPerMaskTarget;
  const int count = std::min(mostTargets, CeilDivide(slices, slicesPerTarget));
  const int slicesPerPass = count * slicesPerTarget;

  GLint largestTexture = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largestTexture);
  const int tile = std::min<int>(LargestTile, largestTexture);
  const glm::ivec2 size(PowerOfTwoFrom(std::min(n.x, tile)), PowerOfTwoFrom(std::min(n.y, tile)));
  Targets targets(this->Context, size, count, content);

  const int tilesU = CeilDivide(n.x, size.x);
  const int tilesV = CeilDivide(n.y, size.y);
  const int passes = CeilDivide(slices, slicesPerPass);
  int done = 0;
  for (int v = 0; v < n.y; v += size.y)
  {
    for (int u = 0; u < n.x; u += size.x)
    {
      for (int slice = 0; slice < slices; slice += slicesPerPass)
      {
        if (!progress(double(done++) / (tilesU * tilesV * passes)))
        {
          return false;
        }
        const Tile part{ axes, { u, v }, { std::min(size.x, n.x - u), std::min(size.y, n.y - v) },
          slice, std::min(slicesPerPass, slices - slice), slices - 1 };
        this->Draw(mesh, target->GetGrid(), part, content, targets);
        this->Resolve(target, part, content, targets);
      }
    }
  }
  return progress(1.0);
}

void vtkSolidRasterPass::Draw(const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, const Tile& tile,
  Content content, Targets& targets)
{
  const bool touched = content == Content::Touched;
  const Stages stages = GetStages(content);
  Program::Defines defines{ { "TARGETS", std::to_string(targets.Count) }, { "REAL", "float" },
    { "REAL2", "vec2" }, { "REAL3", "vec3" } };
  defines.merge(mesh.GetDefines());
  if (content == Content::Winding)
  {
    defines["WINDING"] = "1";
  }
  Program& program = vtkVoxelGetProgram(this->Context, stages.Name, defines,
    { { GL_VERTEX_SHADER, stages.Vertex }, { GL_FRAGMENT_SHADER, stages.Fragment } });
  program.Use();
  const vtkRasterMeshBinding binding(mesh, grid, tile.Axes);
  binding.Bind(program, MeshUnit);
  targets.Masks.Bind(MaskUnit);
  program.Set("MaskTable", int(MaskUnit));

  const glm::ivec3& offset = binding.GetFirstVoxel();
  program.Set("TileFirst", std::array<int, 2>{ offset.x + tile.First.x, offset.y + tile.First.y });
  program.Set("TileColumns", std::array<int, 2>{ tile.Columns.x, tile.Columns.y });
  program.Set("TileSize", std::array<int, 2>{ targets.Size.x, targets.Size.y });
  program.Set("FirstSlice", offset.z + tile.FirstSlice);
  program.Set("LastSlice", tile.LastSliceOfGrid - tile.FirstSlice);
  program.Set("NumberOfSlices", tile.Slices);

  if (content == Content::PairParity)
  {
    binding.BindPairs(program);
  }
  constexpr double smallestMargin = 2e-3;
  constexpr double roundings = 16.0;
  const double margin = std::max(
    smallestMargin, roundings * std::numeric_limits<float>::epsilon() * binding.GetLargestTerms());
  program.Set("HalfWidth", static_cast<float>(0.5 + margin));
  program.Set("Margin", static_cast<float>(margin));

  vtkVoxelGL::VertexArray vertices(this->Context);
  vertices.Bind();
  targets.Begin(tile.Columns);
  if (targets.IsWinding)
  {
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
  }
  else
  {
    glEnable(GL_COLOR_LOGIC_OP);
    glLogicOp(touched ? GL_OR : GL_XOR);
  }
  glDrawArrays(GL_TRIANGLES, 0,
    static_cast<GLsizei>(mesh.GetNumberOfTriangles()) * stages.VerticesPerTriangle);
  glDisable(GL_BLEND);
  glDisable(GL_COLOR_LOGIC_OP);
  targets.End();
}

void vtkSolidRasterPass::Resolve(
  vtkSlicemap* target, const Tile& tile, Content content, const Targets& targets)
{
  const glm::ivec3 n = target->GetGrid().GetDimensions();
  const int depth = n[tile.Axes.Depth];
  Program::Defines defines{ { "COLUMN_AXIS", std::to_string(tile.Axes.Depth) } };
  if (content == Content::Winding)
  {
    defines["WINDING"] = "1";
  }
  const auto bind = [&](Program& program)
  {
    targets.Layers.Bind(ColumnsUnit);
    program.Set("Columns", int(ColumnsUnit));
    program.Set("TileFirst", std::array<int, 2>{ tile.First.x, tile.First.y });
    program.Set("FirstSlice", tile.FirstSlice);
    program.Set("Size", std::array<int, 3>{ n.x, n.y, n.z });
    program.Set("EndSlice", depth);
  };

  // The box of voxels of this pass, and then of words: all of the padding goes with the last
  // voxels.
  glm::ivec3 first;
  glm::ivec3 end;
  first[tile.Axes.U] = tile.First.x;
  end[tile.Axes.U] = tile.First.x + tile.Columns.x;
  first[tile.Axes.V] = tile.First.y;
  end[tile.Axes.V] = tile.First.y + tile.Columns.y;
  first[tile.Axes.Depth] = tile.FirstSlice;
  end[tile.Axes.Depth] = std::min(tile.FirstSlice + tile.Slices, depth);
  if (first[tile.Axes.Depth] < end[tile.Axes.Depth])
  {
    const auto wordsPerRow = static_cast<int>(target->GetWordsPerRow());
    first.x /= WordBits;
    end.x = end.x == n.x ? wordsPerRow : end.x / WordBits;
    const vtkSlicemapKernel resolve("vtkSolidRasterResolve", vtkSolidRasterResolveGLSL, defines);
    resolve.Run(this->Context, target, { first, end }, bind);
  }

  const bool withEnds = content != Content::Touched;
  if (withEnds && tile.FirstSlice <= depth && depth < tile.FirstSlice + tile.Slices)
  {
    defines["COLUMN_ENDS"] = "1";
    const int nu = n[tile.Axes.U];
    const int endColumn = tile.First.x + tile.Columns.x;
    const int endWord =
      endColumn == nu ? static_cast<int>(this->ColumnEnds->GetWordsPerRow()) : endColumn / WordBits;
    const vtkSlicemapKernel resolve("vtkSolidRasterResolve", vtkSolidRasterResolveGLSL, defines);
    resolve.Run(this->Context, this->ColumnEnds,
      { { tile.First.x / WordBits, tile.First.y, 0 },
        { endWord, tile.First.y + tile.Columns.y, 1 } },
      bind);
  }
}

double vtkSolidRasterPass::EstimateCost(
  const vtkVoxelGrid& grid, int axis, const glm::dvec3& projectedAreas) const
{
  // A fragment writes a mask of the whole column. Columns along x have their words side by side in
  // the targets; along y and z every word is gathered bit by bit.
  constexpr double maskOfWord = 2.0;
  constexpr std::array<double, 3> resolveOfWord{ 3.0, 120.0, 120.0 };
  const double wordsOfColumn = grid.GetDimensions()[axis] / double(WordBits);
  return maskOfWord * wordsOfColumn * projectedAreas[axis] +
    resolveOfWord[axis] * static_cast<double>(vtkSlicemap::GetNumberOfWords(grid));
}
