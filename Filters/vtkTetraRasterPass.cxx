// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetraRasterPass.h"

#include "vtkRasterMeshBinding.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapKernel.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelMesh.h"

#include "vtkExactGLSL.h"
#include "vtkRasterMeshFetchGLSL.h"
#include "vtkTetraRasterFragmentGLSL.h"
#include "vtkTetraRasterGeometryGLSL.h"
#include "vtkTetraRasterResolveGLSL.h"
#include "vtkTetraRasterVertexGLSL.h"
#include "vtkVoxelMeshDisplacementGLSL.h"

#include <algorithm>
#include <stdexcept>

using vtkVoxelGL::Program;

namespace
{
constexpr int LargestTile = 1024;
constexpr std::int64_t LargestTargetBytes = std::int64_t(1) << 26;
constexpr int WordBits = 32;

// Of one invocation of the geometry shader.
constexpr int SlicesAtOnce = 16;
constexpr int VerticesPerSlice = 4;

// Units of textures.
constexpr unsigned int LayersUnit = 0;
constexpr unsigned int MeshUnit = 1;

int GetLimit(GLenum name)
{
  GLint limit = 0;
  glGetIntegerv(name, &limit);
  return limit;
}

int PowerOfTwoFrom(int n)
{
  int power = 1;
  while (power < n)
  {
    power *= 2;
  }
  return power;
}
}

/// A box of voxels, counted from the first one of the grid.
struct vtkTetraRasterPass::Tile
{
  glm::ivec3 First;
  glm::ivec3 Size;
};

vtkTetraRasterPass::vtkTetraRasterPass(vtkVoxelGL::Context context)
  : Context(std::move(context))
{
}

bool vtkTetraRasterPass::FillSolid(const vtkVoxelMesh& mesh, const glm::dvec3& origin,
  vtkSlicemap* target, Method method, const Progress& progress)
{
  const glm::ivec3 n = target->GetGrid().GetDimensions();
  const int widest = std::min(LargestTile, GetLimit(GL_MAX_TEXTURE_SIZE));
  glm::ivec3 size(PowerOfTwoFrom(std::min(n.x, widest)), PowerOfTwoFrom(std::min(n.y, widest)), 0);
  size.z = static_cast<int>(std::min<std::int64_t>({ n.z, GetLimit(GL_MAX_ARRAY_TEXTURE_LAYERS),
    LargestTargetBytes / (std::int64_t(size.x) * size.y) }));
  if (!this->Layers || this->SizeOfLayers != size)
  {
    this->Layers = vtkVoxelGL::Texture(this->Context, GL_TEXTURE_2D_ARRAY);
    this->SizeOfLayers = size;
    if (!this->Layers.Allocate3D(GL_R8UI, size.x, size.y, size.z, GL_RED_INTEGER, GL_UNSIGNED_BYTE))
    {
      this->Layers = vtkVoxelGL::Texture();
      throw std::runtime_error("OpenGL has no memory left for a render target.");
    }
  }
  for (int z = 0; z < n.z; z += size.z)
  {
    for (int y = 0; y < n.y; y += size.y)
    {
      for (int x = 0; x < n.x; x += size.x)
      {
        const double rows = double(z) * n.y + double(y) * std::min(size.z, n.z - z);
        if (!progress(rows / (double(n.y) * n.z)))
        {
          return false;
        }
        const glm::ivec3 first(x, y, z);
        const Tile tile{ first, glm::min(size, n - first) };
        this->Draw(mesh, origin, target, tile, method);
        this->Resolve(target, tile);
      }
    }
  }
  return progress(1.0);
}

void vtkTetraRasterPass::Draw(const vtkVoxelMesh& mesh, const glm::dvec3& origin,
  vtkSlicemap* target, const Tile& tile, Method method)
{
  const vtkVoxelGrid& grid = target->GetGrid();
  const bool layered = method == Method::Layers;
  const int slices = layered ? SlicesAtOnce : 1;
  Program::Defines defines = mesh.GetDefines();
  defines["SLICES"] = std::to_string(slices);
  defines["MAX_VERTICES"] = std::to_string(VerticesPerSlice * slices);
  if (layered)
  {
    defines["LAYERED"] = "1";
  }
  Program& program = vtkVoxelGetProgram(this->Context, "vtkTetraRaster", defines,
    { { GL_VERTEX_SHADER,
        { vtkVoxelMeshDisplacementGLSL, vtkRasterMeshFetchGLSL, vtkTetraRasterVertexGLSL } },
      { GL_GEOMETRY_SHADER, { vtkExactGLSL, vtkTetraRasterGeometryGLSL } },
      { GL_FRAGMENT_SHADER, { vtkTetraRasterFragmentGLSL } } });
  program.Use();
  const vtkRasterMeshBinding binding(mesh, grid, vtkColumnAxes(2));
  binding.Bind(program, MeshUnit);
  const glm::vec3 corner = binding.GetVoxels(origin);
  program.Set("Origin", std::array<float, 3>{ corner.x, corner.y, corner.z });
  const glm::ivec3 first = binding.GetFirstVoxel() + tile.First;
  program.Set("TileFirst", std::array<int, 2>{ first.x, first.y });
  program.Set("TileSize", std::array<int, 2>{ this->SizeOfLayers.x, this->SizeOfLayers.y });

  vtkVoxelGL::VertexArray vertices(this->Context);
  vertices.Bind();
  vtkVoxelGL::Framebuffer framebuffer(this->Context);
  framebuffer.Attach(GL_COLOR_ATTACHMENT0, this->Layers);
  framebuffer.SetDrawBuffers(1);
  if (!framebuffer.IsComplete())
  {
    throw std::runtime_error(
      "OpenGL can't draw into layers of one byte a voxel. Set the backend to "
      "Compute.");
  }
  const GLuint zeros[4] = { 0, 0, 0, 0 };
  glClearBufferuiv(GL_COLOR, 0, zeros);
  glViewport(0, 0, this->SizeOfLayers.x, this->SizeOfLayers.y);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, tile.Size.x, tile.Size.y);
  glEnable(GL_COLOR_LOGIC_OP);
  glLogicOp(GL_XOR);
  const auto count = static_cast<GLsizei>(3 * mesh.GetNumberOfTriangles());
  if (layered)
  {
    program.Set("FirstSlice", first.z);
    program.Set("EndSlice", first.z + tile.Size.z);
    glDrawArraysInstanced(GL_TRIANGLES, 0, count, (tile.Size.z + SlicesAtOnce - 1) / SlicesAtOnce);
  }
  for (int slice = 0; !layered && slice < tile.Size.z; ++slice)
  {
    framebuffer.AttachLayer(GL_COLOR_ATTACHMENT0, this->Layers, slice);
    program.Set("FirstSlice", first.z + slice);
    program.Set("EndSlice", first.z + slice + 1);
    glDrawArrays(GL_TRIANGLES, 0, count);
  }
  glDisable(GL_COLOR_LOGIC_OP);
  glDisable(GL_SCISSOR_TEST);
}

void vtkTetraRasterPass::Resolve(vtkSlicemap* target, const Tile& tile)
{
  const glm::ivec3 n = target->GetGrid().GetDimensions();
  glm::ivec3 first = tile.First;
  glm::ivec3 end = tile.First + tile.Size;
  // The padding goes with the last voxels.
  first.x /= WordBits;
  end.x = end.x == n.x ? static_cast<int>(target->GetWordsPerRow()) : end.x / WordBits;
  const vtkSlicemapKernel resolve("vtkTetraRasterResolve", vtkTetraRasterResolveGLSL);
  resolve.Run(this->Context, target, { first, end },
    [&](Program& program)
    {
      this->Layers.Bind(LayersUnit);
      program.Set("Layers", int(LayersUnit));
      program.Set("TileFirst", std::array<int, 3>{ tile.First.x, tile.First.y, tile.First.z });
      program.Set("Columns", n.x);
    });
}
