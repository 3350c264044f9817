// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDepthBuffers.h"

#include "vtkMorphologyPass.h"
#include "vtkNew.h"
#include "vtkSMPTools.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapKernel.h"
#include "vtkSlicemapQuadKernel.h"
#include "vtkSolidPass.h" // for vtkColumnAxes
#include "vtkVoxelGrid.h"
#include "vtkVoxelMesh.h"

#include "vtkDepthBlocksGLSL.h"
#include "vtkDepthCarveGLSL.h"
#include "vtkDepthCopyGLSL.h"
#include "vtkDepthDensityGLSL.h"
#include "vtkDepthMeshVertexGLSL.h"
#include "vtkDepthPlanesGLSL.h"
#include "vtkDepthRangeGLSL.h"
#include "vtkDepthRangesGLSL.h"
#include "vtkDepthShellsGLSL.h"
#include "vtkDepthVoxelsGLSL.h"
#include "vtkRasterMeshFetchGLSL.h"
#include "vtkVoxelFullScreenGLSL.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>

using vtkVoxelGL::Framebuffer;
using vtkVoxelGL::Program;
using vtkVoxelGL::Texture;

namespace
{
constexpr unsigned int NearUnit = 0;
constexpr unsigned int FarUnit = 1;
constexpr unsigned int VoxelsUnit = 2;
constexpr unsigned int RangesUnit = 0;
constexpr unsigned int EndsUnit = 0;
constexpr unsigned int PlanesUnit = 0;
constexpr unsigned int MeshUnit = 0;
constexpr int WordsPerQuad = 4;
constexpr std::int64_t BytesPerQuad = 16;
constexpr int VoxelsPerQuad = 4;
constexpr int ColumnsPerWord = 32;

/// As in vtkDepthDensity.glsl.
constexpr float OneOfDensity = 16777216.0f;

/// A buffer of 128 MiB, which all OpenGL has.
constexpr std::int64_t MostVoxelsOfDensity = std::int64_t(1) << 25;

constexpr GLfloat DepthOfNothing = 1.0f;
constexpr GLuint StencilBits = 0xff;

/// Ranges of voxels are pairs of so many bits.
constexpr int LargestLength = 65535;

/// Of a cell of vtkDepthVoxels.glsl, in columns or voxels.
constexpr glm::ivec3 CellSize(ColumnsPerWord, 4, 8);

constexpr char NoMemoryForColumns[] =
  "OpenGL has no memory left for columns of voxels. Use fewer voxels.";

const char AxisNames[] = { 'X', 'Y', 'Z' };

int CountWords(int columns)
{
  return (columns + ColumnsPerWord - 1) / ColumnsPerWord;
}

/// The bits of vtkDepthPlanes.glsl, an even number of them, for voxels from 0 to `length`.
int CountBits(int length)
{
  int bits = 4;
  while (length >> bits != 0)
  {
    bits += 2;
  }
  return bits;
}

std::array<float, 3> ToArray(const glm::vec3& v)
{
  return { v.x, v.y, v.z };
}

std::array<int, 3> ToArray(const glm::ivec3& v)
{
  return { v.x, v.y, v.z };
}

/// An image of integers, one, two or four a pixel, from a fragment shader.
Texture MakeImage(const vtkVoxelGL::Context& context, const std::string& name,
  const std::vector<std::string>& sources, const Program::Defines& defines, GLenum format,
  const glm::ivec2& size, const std::function<void(Program&)>& bind)
{
  const GLenum components = format == GL_R32UI ? GL_RED_INTEGER
    : format == GL_RG32UI                      ? GL_RG_INTEGER
                                               : GL_RGBA_INTEGER;
  Texture image(context, GL_TEXTURE_2D);
  const bool allocated = image.Allocate2D(format, size.x, size.y, components, GL_UNSIGNED_INT);
  if (!allocated)
  {
    throw std::runtime_error(NoMemoryForColumns);
  }
  Framebuffer framebuffer(context);
  framebuffer.Attach(GL_COLOR_ATTACHMENT0, image);
  framebuffer.SetDrawBuffers(1);
  vtkVoxelGL::VertexArray vertices(context);
  vertices.Bind();
  Program& program = vtkVoxelGetProgram(context, name, defines,
    { { GL_VERTEX_SHADER, { vtkVoxelFullScreenGLSL } }, { GL_FRAGMENT_SHADER, sources } });
  program.Use();
  bind(program);
  glViewport(0, 0, size.x, size.y);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  return image;
}

/// See vtkDepthRange.glsl.
void BindDepths(Program& program, const vtkDepthBuffers::Pair& pair)
{
  pair.NearDepth.Bind(NearUnit);
  pair.FarDepth.Bind(FarUnit);
  program.Set("NearDepth", int(NearUnit));
  program.Set("FarDepth", int(FarUnit));
  program.Set("DepthOfBuffers", static_cast<float>(pair.View.GetViewport().z));
  program.Set("Length", pair.View.Size.z);
}

/// Maps the points of a mesh to view coordinates; see vtkRasterMeshFetch.glsl.
void SetView(Program& program, const glm::dmat4& worldToView)
{
  const glm::dvec3 anchor(glm::inverse(worldToView)[3]);
  const glm::vec3 high(anchor);
  const glm::vec3 low(anchor - glm::dvec3(high));
  program.Set("AnchorHigh", ToArray(high));
  program.Set("AnchorLow", ToArray(low));
  const glm::mat3 rows(glm::transpose(glm::dmat3(worldToView)));
  for (int row = 0; row < 3; ++row)
  {
    const std::string name = "VoxelsFromWorld[" + std::to_string(row) + "]";
    program.Set(name.c_str(), ToArray(rows[row]));
  }
}
}

/// What vtkDepthVoxels.glsl asks of the columns along an axis.
struct vtkDepthBuffers::Columns
{
  int Axis;
  glm::ivec3 First; ///< column of the target, and its first voxel
  glm::ivec3 Size;  ///< columns of the target, and voxels of each
  Texture Ends;
  vtkVoxelGL::Buffer PlanesBuffer;
  Texture Planes;
  Texture Blocks;
};

void vtkDepthBuffers::Start(vtkVoxelGL::Context context)
{
  this->Known.clear();
  this->Drawn.clear();
  this->Effective.clear();
  this->Context = std::move(context);
}

bool vtkDepthBuffers::IsIn(const vtkVoxelGL::Context& context) const
{
  return this->Context == context &&
    std::all_of(this->Known.begin(), this->Known.end(),
      [](const auto& pair) { return pair->NearDepth && pair->FarDepth; });
}

void vtkDepthBuffers::CheckSize(const vtkDepthView& view) const
{
  GLint largestTexture = 0;
  std::array<GLint, 2> largestViewport{};
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largestTexture);
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, largestViewport.data());
  const int limit = std::min({ largestTexture, largestViewport[0], largestViewport[1] });
  const glm::ivec3 viewport = view.GetViewport();
  if (viewport.x > limit || viewport.y > limit || view.Size.z > LargestLength)
  {
    throw std::runtime_error("A depth buffer of " + std::to_string(view.Size.x) + " x " +
      std::to_string(view.Size.y) + " pixels, " + std::to_string(view.Size.z) +
      " voxels deep, is too large: " + this->Context->GetRendererName() + " takes " +
      std::to_string(limit) + " pixels on each axis, and " + std::to_string(LargestLength) +
      " voxels are the limit. Use fewer voxels.");
  }
}

Framebuffer vtkDepthBuffers::MakeBuffer(
  const vtkDepthView& view, bool hasStencil, Texture& depth) const
{
  depth = Texture(this->Context, GL_TEXTURE_2D);
  const bool allocated = hasStencil
    ? depth.Allocate2D(GL_DEPTH32F_STENCIL8, view.Size.x, view.Size.y, GL_DEPTH_STENCIL,
        GL_FLOAT_32_UNSIGNED_INT_24_8_REV)
    : depth.Allocate2D(
        GL_DEPTH_COMPONENT32F, view.Size.x, view.Size.y, GL_DEPTH_COMPONENT, GL_FLOAT);
  Framebuffer framebuffer(this->Context);
  if (allocated)
  {
    framebuffer.Attach(hasStencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT, depth);
  }
  framebuffer.SetDrawBuffers(0);
  glReadBuffer(GL_NONE);
  if (!allocated || !framebuffer.IsComplete())
  {
    throw std::runtime_error("OpenGL could not make a depth buffer of " +
      std::to_string(view.Size.x) + " x " + std::to_string(view.Size.y) +
      " pixels. Use fewer voxels.");
  }
  return framebuffer;
}

std::shared_ptr<vtkDepthBuffers::Pair> vtkDepthBuffers::MakePair(
  const Direction& direction, bool hasStencil) const
{
  const auto& [axis, view] = direction;
  this->CheckSize(view);
  auto pair = std::make_shared<Pair>();
  pair->Axis = axis;
  pair->View = view;
  pair->Near = this->MakeBuffer(view, hasStencil, pair->NearDepth);
  pair->Far = this->MakeBuffer(view, false, pair->FarDepth);
  pair->HasStencil = hasStencil;
  return pair;
}

std::shared_ptr<vtkDepthBuffers::Pair> vtkDepthBuffers::Find(
  const Direction& direction, bool counted) const
{
  const auto found = std::find_if(this->Known.begin(), this->Known.end(),
    [&](const auto& pair)
    {
      return pair->Axis == direction.first && pair->View == direction.second &&
        (!counted || pair->HasStencil);
    });
  return found == this->Known.end() ? nullptr : *found;
}

void vtkDepthBuffers::Use(const std::vector<Direction>& directions)
{
  this->Drawn.clear();
  this->Effective.clear();
  for (const Direction& direction : directions)
  {
    auto pair = this->Find(direction, false);
    if (!pair)
    {
      pair = this->MakePair(direction, false);
      this->Known.push_back(pair);
    }
    for (const Side side : { Side::Near, Side::Far })
    {
      if (!pair->IsDrawn(side))
      {
        pair->GetFramebuffer(side).Bind();
        glClearBufferfv(GL_DEPTH, 0, &DepthOfNothing);
      }
    }
    this->Drawn.push_back(std::move(pair));
  }
}

bool vtkDepthBuffers::Draw(const vtkVoxelMesh* mesh, const GoOn& goOn)
{
  for (const auto& pair : this->Drawn)
  {
    for (const Side side : { Side::Near, Side::Far })
    {
      if (!pair->IsDrawn(side))
      {
        this->DrawSide(mesh, *pair, side);
        if (!goOn())
        {
          return false;
        }
      }
    }
  }
  return true;
}

void vtkDepthBuffers::DrawSide(const vtkVoxelMesh* mesh, Pair& pair, Side side)
{
  ++this->NumberOfDraws;
  (side == Side::Near ? pair.IsNearDrawn : pair.IsFarDrawn) = true;
  if (!mesh)
  {
    return;
  }
  Program& program = vtkVoxelGetProgram(this->Context, "vtkDepthMesh", mesh->GetDefines(),
    { { GL_VERTEX_SHADER, { vtkRasterMeshFetchGLSL, vtkDepthMeshVertexGLSL } } });
  program.Use();
  mesh->Bind(program, MeshUnit);
  vtkVoxelGL::VertexArray vertices(this->Context);
  vertices.Bind();
  mesh->BindIndices();
  const glm::ivec3 viewport = pair.View.GetViewport();
  SetView(program, pair.View.WorldToView);
  program.Set("Viewport", ToArray(glm::vec3(viewport)));
  program.Set("Side", side == Side::Near ? 1.0f : -1.0f);
  glViewport(0, 0, viewport.x, viewport.y);
  pair.GetFramebuffer(side).Bind();
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_DEPTH_CLAMP);
  glDrawElements(
    GL_TRIANGLES, static_cast<GLsizei>(mesh->GetNumberOfTriangles()) * 3, GL_UNSIGNED_INT, nullptr);
  glDisable(GL_DEPTH_CLAMP);
  glDisable(GL_DEPTH_TEST);
}

std::vector<vtkDepthBuffers::Direction>::const_iterator vtkDepthBuffers::FindSufficient(
  const std::vector<Direction>& directions, const vtkVoxelMesh& mesh)
{
  std::vector<std::vector<Direction>::const_iterator> order;
  for (auto direction = directions.begin(); direction != directions.end(); ++direction)
  {
    if (direction->first != Oblique)
    {
      order.push_back(direction);
    }
  }
  const auto pixels = [](const auto& direction)
  { return std::int64_t(direction->second.Size.x) * direction->second.Size.y; };
  std::stable_sort(order.begin(), order.end(),
    [&](const auto& a, const auto& b) { return pixels(a) < pixels(b); });
  const auto isSufficient = [&](const auto& direction)
  {
    auto pair = this->Find(*direction, true);
    if (!pair)
    {
      pair = this->MakePair(*direction, true);
      this->Known.insert(this->Known.begin(), pair);
    }
    if (pair->Crossed == Crossings::NotCounted)
    {
      pair->Near.Bind();
      glClearBufferfi(GL_DEPTH_STENCIL, 0, DepthOfNothing, 0);
      glEnable(GL_STENCIL_TEST);
      glStencilFunc(GL_ALWAYS, 0, StencilBits);
      glStencilOp(GL_INCR, GL_INCR, GL_INCR);
      this->DrawSide(&mesh, *pair, Side::Near);
      pair->Crossed = this->CountCrossings(*pair);
      glDisable(GL_STENCIL_TEST);
    }
    return pair->Crossed == Crossings::NoneOrTwo;
  };
  const auto found = std::find_if(order.begin(), order.end(), isSufficient);
  return found == order.end() ? directions.end() : *found;
}

vtkDepthBuffers::Crossings vtkDepthBuffers::CountCrossings(const Pair& pair) const
{
  // Draws over the columns that were crossed, and not twice.
  Program& program = vtkVoxelGetProgram(
    this->Context, "vtkDepthEverywhere", {}, { { GL_VERTEX_SHADER, { vtkVoxelFullScreenGLSL } } });
  program.Use();
  vtkVoxelGL::VertexArray vertices(this->Context);
  vertices.Bind();
  pair.Near.Bind();
  glViewport(0, 0, pair.View.Size.x, pair.View.Size.y);
  constexpr GLint twice = 2;
  glStencilFunc(GL_EQUAL, twice, StencilBits);
  glStencilOp(GL_KEEP, GL_ZERO, GL_ZERO);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glStencilFunc(GL_NOTEQUAL, 0, StencilBits);
  vtkVoxelGL::Query others(this->Context);
  others.Begin(GL_SAMPLES_PASSED);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  others.End();
  return others.GetResult() == 0 ? Crossings::NoneOrTwo : Crossings::Others;
}

std::shared_ptr<vtkDepthBuffers::Pair> vtkDepthBuffers::Merge(const Pairs& pairs) const
{
  const auto& first = *pairs.front();
  auto merged = this->MakePair({ first.Axis, first.View }, false);
  Program& program = vtkVoxelGetProgram(this->Context, "vtkDepthCopy", {},
    { { GL_VERTEX_SHADER, { vtkVoxelFullScreenGLSL } },
      { GL_FRAGMENT_SHADER, { vtkDepthCopyGLSL } } });
  program.Use();
  program.Set("Depth", int(NearUnit));
  vtkVoxelGL::VertexArray vertices(this->Context);
  vertices.Bind();
  glViewport(0, 0, first.View.Size.x, first.View.Size.y);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  for (const Side side : { Side::Near, Side::Far })
  {
    merged->GetFramebuffer(side).Bind();
    const GLfloat nearest = 0.0f;
    glClearBufferfv(GL_DEPTH, 0, &nearest);
    for (const auto& pair : pairs)
    {
      pair->GetDepth(side).Bind(NearUnit);
      glDrawArrays(GL_TRIANGLES, 0, 3);
    }
  }
  glDepthFunc(GL_LESS);
  glDisable(GL_DEPTH_TEST);
  return merged;
}

void vtkDepthBuffers::Intersect(const std::vector<Given>& others)
{
  this->Effective.clear();
  for (const int axis : { 0, 1, 2 })
  {
    Pairs along;
    std::copy_if(this->Drawn.begin(), this->Drawn.end(), std::back_inserter(along),
      [&](const auto& pair) { return pair->Axis == axis; });
    for (const Given& given : others)
    {
      if (given.Axis == axis)
      {
        auto pair = this->MakePair({ axis, given.View }, false);
        const glm::ivec3 size = given.View.Size;
        const bool uploaded = pair->NearDepth.Allocate2D(GL_DEPTH_COMPONENT32F, size.x, size.y,
                                GL_DEPTH_COMPONENT, GL_FLOAT, given.Near.data()) &&
          pair->FarDepth.Allocate2D(
            GL_DEPTH_COMPONENT32F, size.x, size.y, GL_DEPTH_COMPONENT, GL_FLOAT, given.Far.data());
        if (!uploaded)
        {
          throw std::runtime_error(
            "OpenGL has no memory left for depth buffers. Use fewer voxels.");
        }
        along.push_back(std::move(pair));
      }
    }
    if (!along.empty())
    {
      this->Effective.push_back(along.size() == 1 ? along.front() : this->Merge(along));
    }
  }
  std::copy_if(this->Drawn.begin(), this->Drawn.end(), std::back_inserter(this->Effective),
    [](const auto& pair) { return pair->Axis == Oblique; });
}

Texture vtkDepthBuffers::MakeRanges(const Pair& pair) const
{
  return MakeImage(this->Context, "vtkDepthRanges", { vtkDepthRangeGLSL, vtkDepthRangesGLSL }, {},
    GL_R32UI, pair.View.Size, [&](Program& program) { BindDepths(program, pair); });
}

Texture vtkDepthBuffers::MakeShells(
  const Pair& pair, const Texture& ranges, Neighbours neighbours) const
{
  return MakeImage(this->Context, "vtkDepthShells", { vtkDepthShellsGLSL },
    { { "NEIGHBOURS", std::to_string(static_cast<int>(neighbours)) } }, GL_RG32UI, pair.View.Size,
    [&](Program& program)
    {
      ranges.Bind(RangesUnit);
      program.Set("Ranges", int(RangesUnit));
      program.Set("Size", ToArray(pair.View.Size));
    });
}

Texture vtkDepthBuffers::MakeBlocks(const Columns& columns, const Program::Defines& defines) const
{
  const bool hasPlanes = columns.Axis != 0;
  const glm::ivec2 side(vtkColumnAxes(columns.Axis)(CellSize));
  return MakeImage(this->Context, "vtkDepthBlocks", { vtkDepthBlocksGLSL },
    hasPlanes ? defines : Program::Defines(), GL_RGBA32UI,
    (glm::ivec2(columns.Size) + side - 1) / side,
    [&](Program& program)
    {
      program.Set("Size", ToArray(columns.Size));
      program.Set("Side", std::array<int, 2>{ side.x, side.y });
      if (hasPlanes)
      {
        columns.Planes.Bind(PlanesUnit);
        program.Set("Planes", int(PlanesUnit));
        program.Set("Words", CountWords(columns.Size.x));
      }
      else
      {
        columns.Ends.Bind(EndsUnit);
        program.Set("Ends", int(EndsUnit));
        program.Set("First", ToArray(columns.First));
      }
    });
}

vtkVoxelGL::Buffer vtkDepthBuffers::MakePlanes(
  const Pair& pair, const Columns& columns, const Program::Defines& defines) const
{
  const int words = CountWords(columns.Size.x);
  const std::int64_t groups = std::int64_t(words) * columns.Size.y;
  const std::int64_t quads = groups * std::stoi(defines.at("PLANES"));
  GLint texels = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
  vtkVoxelGL::Buffer planes(this->Context);
  if (quads > texels || !planes.Allocate(static_cast<std::size_t>(quads * BytesPerQuad)))
  {
    throw std::runtime_error(NoMemoryForColumns);
  }
  const bool hasShells = static_cast<bool>(columns.Ends);
  const vtkSlicemapQuadKernel kernel("vtkDepthPlanes",
    hasShells ? std::string(vtkDepthPlanesGLSL)
              : std::string(vtkDepthRangeGLSL) + vtkDepthPlanesGLSL,
    defines);
  kernel.Run(this->Context, planes, groups,
    [&](Program& program)
    {
      if (hasShells)
      {
        columns.Ends.Bind(EndsUnit);
        program.Set("Ends", int(EndsUnit));
      }
      else
      {
        BindDepths(program, pair);
      }
      program.Set("First", ToArray(columns.First));
      program.Set("Size", ToArray(columns.Size));
      program.Set("Words", static_cast<unsigned int>(words));
    });
  return planes;
}

vtkDepthBuffers::Columns vtkDepthBuffers::MakeColumns(const Pair& pair, const glm::ivec3& first,
  const glm::ivec3& size, std::optional<Neighbours> neighbours,
  const Program::Defines& defines) const
{
  const vtkColumnAxes axes(pair.Axis);
  Columns columns;
  columns.Axis = pair.Axis;
  columns.First = axes(first);
  columns.Size = axes(size);
  if (neighbours)
  {
    columns.Ends = this->MakeShells(pair, this->MakeRanges(pair), *neighbours);
  }
  else if (pair.Axis == 0)
  {
    columns.Ends = this->MakeRanges(pair);
  }
  if (pair.Axis != 0)
  {
    columns.PlanesBuffer = this->MakePlanes(pair, columns, defines);
    columns.Planes = Texture(this->Context, GL_TEXTURE_BUFFER);
    columns.Planes.AttachBuffer(GL_RGBA32UI, columns.PlanesBuffer);
  }
  columns.Blocks = this->MakeBlocks(columns, defines);
  return columns;
}

bool vtkDepthBuffers::HasObliquePairs() const
{
  return std::any_of(this->Effective.begin(), this->Effective.end(),
    [](const auto& pair) { return pair->Axis == Oblique; });
}

void vtkDepthBuffers::FillSolid(vtkSlicemap* target, const glm::ivec3& first) const
{
  this->Fill(target, first, std::nullopt);
  for (const auto& pair : this->Effective)
  {
    if (pair->Axis == Oblique)
    {
      this->Carve(target, *pair);
    }
  }
}

void vtkDepthBuffers::FillSurface(
  vtkSlicemap* target, const glm::ivec3& first, Neighbours neighbours) const
{
  if (this->HasObliquePairs())
  {
    this->FillSolid(target, first);
    this->KeepBoundary(target, neighbours);
  }
  else
  {
    this->Fill(target, first, neighbours);
  }
}

void vtkDepthBuffers::Carve(vtkSlicemap* target, const Pair& pair) const
{
  const vtkVoxelGrid& grid = target->GetGrid();
  const glm::dmat4 indexToView = pair.View.WorldToView * grid.GetIndexToWorld();
  const glm::dvec4 first(glm::dvec3(grid.GetFirst()), 1.0);
  const Texture voxels = vtkSlicemapTexture(target);
  const vtkSlicemapQuadKernel kernel("vtkDepthCarve", vtkDepthCarveGLSL);
  kernel.Run(this->Context, target,
    [&](Program& program)
    {
      pair.NearDepth.Bind(NearUnit);
      pair.FarDepth.Bind(FarUnit);
      voxels.Bind(VoxelsUnit);
      program.Set("NearDepth", int(NearUnit));
      program.Set("FarDepth", int(FarUnit));
      program.Set("Voxels", int(VoxelsUnit));
      program.Set("DepthOfBuffers", static_cast<float>(pair.View.GetViewport().z));
      program.Set("Pixels", std::array<int, 2>{ pair.View.Size.x, pair.View.Size.y });
      program.Set("Origin", ToArray(glm::vec3(indexToView * first)));
      for (int axis = 0; axis < 3; ++axis)
      {
        const std::string name = "Steps[" + std::to_string(axis) + "]";
        program.Set(name.c_str(), ToArray(glm::vec3(indexToView[axis])));
      }
      program.Set("Size", ToArray(grid.GetDimensions()));
      program.Set(
        "QuadsPerRow", static_cast<unsigned int>(target->GetWordsPerRow() / WordsPerQuad));
    });
}

void vtkDepthBuffers::KeepBoundary(vtkSlicemap* target, Neighbours neighbours) const
{
  vtkMorphologyPass::Element element;
  element.First = glm::ivec3(-1);
  element.Last = glm::ivec3(1);
  const int reach = neighbours == Neighbours::Four ? 1 : 2;
  for (int z = -1; z <= 1; ++z)
  {
    for (int y = -1; y <= 1; ++y)
    {
      const int left = reach - std::abs(y) - std::abs(z);
      if (left >= 0)
      {
        element.Rows.push_back({ y, z, -std::min(left, 1), std::min(left, 1) });
      }
    }
  }
  vtkNew<vtkSlicemap> interior;
  interior->SetContext(target->GetContext());
  vtkMorphologyPass(this->Context, vtkMorphologyPass::Border::Empty)
    .Run(vtkMorphologyPass::Operation::Erode, element, target, interior);
  target->Difference(interior);
}

void vtkDepthBuffers::ReadDensity(
  const vtkVoxelGrid& grid, const glm::ivec3& first, float* values) const
{
  Program::Defines defines;
  glm::vec3 depths(1.0f);
  for (const auto& pair : this->Effective)
  {
    if (pair->Axis != Oblique)
    {
      defines[std::string("HAS_") + AxisNames[pair->Axis]] = "1";
      depths[pair->Axis] = static_cast<float>(pair->View.GetViewport().z);
    }
  }
  const vtkSlicemapQuadKernel kernel("vtkDepthDensity", vtkDepthDensityGLSL, std::move(defines));
  glm::ivec3 slab = grid.GetDimensions();
  const std::int64_t voxelsPerSlice = std::int64_t(slab.x) * slab.y;
  const int slices = slab.z;
  const auto most =
    static_cast<int>(std::clamp<std::int64_t>(MostVoxelsOfDensity / voxelsPerSlice, 1, slices));
  vtkVoxelGL::Buffer buffer;
  for (int slice = 0; slice < slices; slice += most)
  {
    slab.z = std::min(most, slices - slice);
    const std::int64_t voxels = voxelsPerSlice * slab.z;
    const std::int64_t quads = (voxels + VoxelsPerQuad - 1) / VoxelsPerQuad;
    vtkVoxelGL::Prepare(buffer, this->Context,
      static_cast<std::size_t>(quads * VoxelsPerQuad) * sizeof(std::uint32_t));
    kernel.Run(this->Context, buffer, quads,
      [&](Program& program)
      {
        program.Set("First", ToArray(first + glm::ivec3(0, 0, slice)));
        program.Set("Size", ToArray(slab));
        program.Set("DepthOfBuffers", ToArray(depths));
        int unit = 0;
        for (const auto& pair : this->Effective)
        {
          if (pair->Axis == Oblique)
          {
            continue;
          }
          for (const Side side : { Side::Near, Side::Far })
          {
            const std::string name = side == Side::Near ? "Near" : "Far";
            pair->GetDepth(side).Bind(static_cast<unsigned int>(unit));
            program.Set((name + AxisNames[pair->Axis]).c_str(), unit++);
          }
        }
      });
    const vtkVoxelGL::MappedBuffer mapped(buffer, 0, buffer.GetSize(), GL_MAP_READ_BIT);
    vtkSlicemap::CountReadBack();
    const auto* parts = static_cast<const std::uint32_t*>(mapped.Get());
    if (!parts)
    {
      throw std::runtime_error("The densities could not be read back from OpenGL.");
    }
    float* out = values + voxelsPerSlice * slice;
    vtkSMPTools::For(0, voxels,
      [&](vtkIdType begin, vtkIdType end)
      {
        std::transform(parts + begin, parts + end, out + begin,
          [](std::uint32_t part) { return static_cast<float>(part) / OneOfDensity; });
      });
  }
}

std::vector<float> vtkDepthBuffers::ReadDepth(const Pair& pair, Side side) const
{
  std::vector<float> depths(std::size_t(pair.View.Size.x) * pair.View.Size.y);
  pair.GetFramebuffer(side).Bind(GL_READ_FRAMEBUFFER);
  glReadPixels(
    0, 0, pair.View.Size.x, pair.View.Size.y, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
  vtkSlicemap::CountReadBack();
  return depths;
}

void vtkDepthBuffers::Fill(
  vtkSlicemap* target, const glm::ivec3& first, std::optional<Neighbours> neighbours) const
{
  const glm::ivec3 size = target->GetGrid().GetDimensions();
  const int bits = CountBits(std::max(size.y, size.z));
  Program::Defines defines{ { "BITS", std::to_string(bits) },
    { "PLANES", std::to_string(neighbours ? bits : bits / 2) } };
  if (neighbours)
  {
    defines["SHELLS"] = "1";
  }
  std::vector<Columns> all;
  for (const auto& pair : this->Effective)
  {
    if (pair->Axis != Oblique)
    {
      all.push_back(this->MakeColumns(*pair, first, size, neighbours, defines));
    }
  }
  for (const Columns& columns : all)
  {
    defines[std::string("HAS_") + AxisNames[columns.Axis]] = "1";
  }
  defines["CELL_ROWS"] = std::to_string(CellSize.y);
  defines["CELL_SLICES"] = std::to_string(CellSize.z);
  const vtkSlicemapKernel kernel("vtkDepthVoxels", vtkDepthVoxelsGLSL, std::move(defines));
  kernel.Run(this->Context, target,
    [&](Program& program)
    {
      program.Set("First", ToArray(first));
      program.Set("Size", ToArray(size));
      program.Set("WordsInUse", CountWords(size.x));
      int unit = 0;
      for (const Columns& columns : all)
      {
        const auto set = [&](const Texture& texture, const char* name)
        {
          texture.Bind(static_cast<unsigned int>(unit));
          program.Set((std::string(name) + AxisNames[columns.Axis]).c_str(), unit++);
        };
        set(columns.Blocks, "Blocks");
        set(
          columns.Axis == 0 ? columns.Ends : columns.Planes, columns.Axis == 0 ? "Ends" : "Planes");
      }
    });
}
