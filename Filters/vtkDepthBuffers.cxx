// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDepthBuffers.h"

#include "vtkSlicemap.h"
#include "vtkSlicemapKernel.h"
#include "vtkSlicemapQuadKernel.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelMesh.h"

#include "vtkDepthMeshVertexGLSL.h"
#include "vtkDepthRangesGLSL.h"
#include "vtkDepthShellsGLSL.h"
#include "vtkDepthVoxelsGLSL.h"
#include "vtkRasterMeshFetchGLSL.h"
#include "vtkVoxelFullScreenGLSL.h"

#include <algorithm>
#include <array>
#include <functional>
#include <stdexcept>
#include <string>

using vtkVoxelGL::Framebuffer;
using vtkVoxelGL::Program;
using vtkVoxelGL::Texture;

namespace
{
constexpr unsigned int NearUnit = 0;
constexpr unsigned int FarUnit = 1;
constexpr unsigned int RangesUnit = 0;
constexpr unsigned int MeshUnit = 0;
constexpr int WordsPerQuad = 4;

/// Ranges of voxels are pairs of so many bits.
constexpr int LargestLength = 65535;

const char AxisNames[] = { 'X', 'Y', 'Z' };

std::array<float, 3> ToArray(const glm::vec3& v)
{
  return { v.x, v.y, v.z };
}

std::array<int, 3> ToArray(const glm::ivec3& v)
{
  return { v.x, v.y, v.z };
}

/// An integer for each column of a view, from a fragment shader.
Texture MakeColumns(const vtkVoxelGL::Context& context, const std::string& name,
  const std::string& source, const Program::Defines& defines, const vtkDepthView& view,
  const std::function<void(Program&)>& bind)
{
  Texture columns(context, GL_TEXTURE_2D);
  if (!columns.Allocate2D(GL_R32UI, view.Size.x, view.Size.y, GL_RED_INTEGER, GL_UNSIGNED_INT))
  {
    throw std::runtime_error("OpenGL has no memory left for columns of voxels. Use fewer voxels.");
  }
  Framebuffer framebuffer(context);
  framebuffer.Attach(GL_COLOR_ATTACHMENT0, columns);
  framebuffer.SetDrawBuffers(1);
  vtkVoxelGL::VertexArray vertices(context);
  vertices.Bind();
  Program& program = vtkVoxelGetProgram(context, name, defines,
    { { GL_VERTEX_SHADER, { vtkVoxelFullScreenGLSL } }, { GL_FRAGMENT_SHADER, { source } } });
  program.Use();
  bind(program);
  glViewport(0, 0, view.Size.x, view.Size.y);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  return columns;
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

/// What is known of the columns along an axis.
struct vtkDepthBuffers::Columns
{
  int Axis;
  Texture Ranges;
  Texture Shells; ///< may be missing
};

void vtkDepthBuffers::Start(vtkVoxelGL::Context context)
{
  this->Pairs.clear();
  this->Context = std::move(context);
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

Framebuffer vtkDepthBuffers::MakeBuffer(const vtkDepthView& view, Texture& depth) const
{
  depth = Texture(this->Context, GL_TEXTURE_2D);
  const bool allocated =
    depth.Allocate2D(GL_DEPTH_COMPONENT32F, view.Size.x, view.Size.y, GL_DEPTH_COMPONENT, GL_FLOAT);
  Framebuffer framebuffer(this->Context);
  if (allocated)
  {
    framebuffer.Attach(GL_DEPTH_ATTACHMENT, depth);
  }
  framebuffer.SetDrawBuffers(0);
  glReadBuffer(GL_NONE);
  if (!allocated || !framebuffer.IsComplete())
  {
    throw std::runtime_error("OpenGL could not make a depth buffer of " +
      std::to_string(view.Size.x) + " x " + std::to_string(view.Size.y) +
      " pixels. Use fewer voxels.");
  }
  const GLfloat nothing = 1.0f;
  glClearBufferfv(GL_DEPTH, 0, &nothing);
  return framebuffer;
}

void vtkDepthBuffers::Add(int axis, const vtkDepthView& view)
{
  this->CheckSize(view);
  Pair pair;
  pair.Axis = axis;
  pair.View = view;
  pair.Near = this->MakeBuffer(view, pair.NearDepth);
  pair.Far = this->MakeBuffer(view, pair.FarDepth);
  this->Pairs.push_back(std::move(pair));
}

void vtkDepthBuffers::Draw(const vtkVoxelMesh& mesh) const
{
  Program::Defines defines;
  if (mesh.HasLowPart())
  {
    defines["POINTS_ARE_DOUBLE"] = "1";
  }
  Program& program = vtkVoxelGetProgram(this->Context, "vtkDepthMesh", defines,
    { { GL_VERTEX_SHADER, { vtkRasterMeshFetchGLSL, vtkDepthMeshVertexGLSL } } });
  program.Use();
  mesh.Bind(program, MeshUnit);
  vtkVoxelGL::VertexArray vertices(this->Context);
  vertices.Bind();
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_DEPTH_CLAMP);
  for (const Pair& pair : this->Pairs)
  {
    const glm::ivec3 viewport = pair.View.GetViewport();
    SetView(program, pair.View.WorldToView);
    program.Set("Viewport", ToArray(glm::vec3(viewport)));
    glViewport(0, 0, viewport.x, viewport.y);
    for (const Side side : { Side::Near, Side::Far })
    {
      pair.GetFramebuffer(side).Bind();
      program.Set("Side", side == Side::Near ? 1.0f : -1.0f);
      glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(mesh.GetNumberOfTriangles()) * 3);
    }
  }
  glDisable(GL_DEPTH_CLAMP);
  glDisable(GL_DEPTH_TEST);
}

Texture vtkDepthBuffers::MakeRanges(const Pair& pair) const
{
  return MakeColumns(this->Context, "vtkDepthRanges", vtkDepthRangesGLSL, {}, pair.View,
    [&](Program& program)
    {
      pair.NearDepth.Bind(NearUnit);
      pair.FarDepth.Bind(FarUnit);
      program.Set("NearDepth", int(NearUnit));
      program.Set("FarDepth", int(FarUnit));
      program.Set("DepthOfBuffers", static_cast<float>(pair.View.GetViewport().z));
      program.Set("Length", pair.View.Size.z);
    });
}

Texture vtkDepthBuffers::MakeShells(
  const Pair& pair, const Texture& ranges, Neighbours neighbours) const
{
  return MakeColumns(this->Context, "vtkDepthShells", vtkDepthShellsGLSL,
    { { "NEIGHBOURS", std::to_string(static_cast<int>(neighbours)) } }, pair.View,
    [&](Program& program)
    {
      ranges.Bind(RangesUnit);
      program.Set("Ranges", int(RangesUnit));
      program.Set("Size", ToArray(pair.View.Size));
    });
}

void vtkDepthBuffers::FillSolid(vtkSlicemap* target, const glm::ivec3& first) const
{
  std::vector<Columns> columns;
  for (const Pair& pair : this->Pairs)
  {
    columns.push_back({ pair.Axis, this->MakeRanges(pair), {} });
  }
  this->Fill(target, first, columns);
}

void vtkDepthBuffers::FillSurface(
  vtkSlicemap* target, const glm::ivec3& first, Neighbours neighbours) const
{
  std::vector<Columns> columns;
  for (const Pair& pair : this->Pairs)
  {
    Columns column{ pair.Axis, this->MakeRanges(pair), {} };
    column.Shells = this->MakeShells(pair, column.Ranges, neighbours);
    columns.push_back(std::move(column));
  }
  this->Fill(target, first, columns);
}

void vtkDepthBuffers::Fill(
  vtkSlicemap* target, const glm::ivec3& first, const std::vector<Columns>& columns) const
{
  Program::Defines defines;
  for (const Columns& column : columns)
  {
    defines[std::string("HAS_") + AxisNames[column.Axis]] = "1";
    if (column.Shells)
    {
      defines["SHELLS"] = "1";
    }
  }
  const vtkSlicemapQuadKernel kernel("vtkDepthVoxels", vtkDepthVoxelsGLSL, std::move(defines));
  kernel.Run(this->Context, target,
    [&](Program& program)
    {
      program.Set("First", ToArray(first));
      program.Set("Size", ToArray(target->GetGrid().GetDimensions()));
      program.Set(
        "QuadsPerRow", static_cast<unsigned int>(target->GetWordsPerRow() / WordsPerQuad));
      int unit = 0;
      const auto set = [&](const Texture& texture, const std::string& name)
      {
        texture.Bind(static_cast<unsigned int>(unit));
        program.Set(name.c_str(), unit++);
      };
      for (const Columns& column : columns)
      {
        set(column.Ranges, std::string("Ranges") + AxisNames[column.Axis]);
        if (column.Shells)
        {
          set(column.Shells, std::string("Shells") + AxisNames[column.Axis]);
        }
      }
    });
}
