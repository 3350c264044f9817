// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSlicemapKernel.h"

#include "vtkSlicemap.h"
#include "vtkVoxelGrid.h"

#include "vtkSlicemapKernelGLSL.h"
#include "vtkSlicemapLayoutGLSL.h"
#include "vtkVoxelFullScreenGLSL.h"

#include <algorithm>
#include <stdexcept>

using vtkVoxelGL::Context;
using vtkVoxelGL::Program;

namespace
{
constexpr std::int64_t WordBytes = 4;

/// As in vtkSlicemapKernel.glsl.
constexpr glm::ivec2 CellsPerBlock(4, 2);
constexpr int WordsPerCell = 4;

std::int64_t GetLimit(GLenum name)
{
  GLint64 limit = 0;
  glGetInteger64v(name, &limit);
  return limit;
}

std::int64_t GetBytesPerSlice(vtkSlicemap* slicemap)
{
  return slicemap->GetWordsPerRow() * slicemap->GetGrid().GetDimensions().y * WordBytes;
}

void SetRegion(Program& program, const glm::uvec3& first, const glm::uvec3& size)
{
  program.Set("RegionFirst", std::array<unsigned int, 3>{ first.x, first.y, first.z });
  program.Set("RegionSize", std::array<unsigned int, 3>{ size.x, size.y, size.z });
}
}

Program& vtkVoxelGetProgram(const Context& context, const std::string& name,
  const Program::Defines& defines, const std::vector<Program::Stage>& stages,
  vtkVoxelShaderVersion version)
{
  std::string key = "program " + name;
  for (const auto& [macro, value] : defines)
  {
    key += " " + macro + "=" + value;
  }
  auto& cached = context->GetCache()[key];
  if (!cached)
  {
    const bool storage =
      version == vtkVoxelShaderVersion::StorageBuffers || stages.front().Type == GL_COMPUTE_SHADER;
    const std::string header = !storage ? "#version 150 core\n"
      : context->GetVersion() >= 43     ? "#version 430 core\n"
                                        : "#version 420 core\n"
                                          "#extension GL_ARB_compute_shader : require\n"
                                          "#extension GL_ARB_shader_storage_buffer_object : require\n";
    std::string log;
    Program program = Program::Build(context, header, defines, stages, log);
    if (!program)
    {
      throw std::runtime_error("The OpenGL driver " + context->GetRendererName() +
        " can't compile the shader " + name + ": " + log);
    }
    cached = std::make_shared<Program>(std::move(program));
  }
  return *static_cast<Program*>(cached.get());
}

void vtkVoxelDispatch(std::uint64_t invocations, unsigned int local)
{
  constexpr std::uint64_t longest = 65535;
  const std::uint64_t groups = (invocations + local - 1) / local;
  const std::uint64_t rows = (groups + longest - 1) / longest;
  if (groups)
  {
    glDispatchCompute(
      static_cast<GLuint>((groups + rows - 1) / rows), static_cast<GLuint>(rows), 1);
  }
}

vtkVoxelGL::Texture vtkSlicemapTexture(vtkSlicemap* slicemap)
{
  vtkVoxelGL::Texture texture(slicemap->GetBuffer().GetContext(), GL_TEXTURE_BUFFER);
  texture.AttachBuffer(GL_RGBA32UI, slicemap->GetBuffer());
  return texture;
}

vtkVoxelGL::Texture vtkSlicemapWordTexture(vtkSlicemap* slicemap)
{
  const vtkVoxelGL::Buffer& buffer = slicemap->GetBuffer();
  if (static_cast<std::int64_t>(buffer.GetSize()) / WordBytes >
    GetLimit(GL_MAX_TEXTURE_BUFFER_SIZE))
  {
    return {};
  }
  vtkVoxelGL::Texture texture(buffer.GetContext(), GL_TEXTURE_BUFFER);
  texture.AttachBuffer(GL_R32UI, buffer);
  return texture;
}

int vtkSlicemapSlicesPerSlab(vtkSlicemap* slicemap)
{
  const int slices = slicemap->GetGrid().GetDimensions().z;
  const std::int64_t fitting =
    GetLimit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE) / GetBytesPerSlice(slicemap);
  if (fitting >= slices)
  {
    return slices;
  }
  // Whatever is bound along with the slab has one word a slice at least, so that its offset is a
  // multiple of the alignment too.
  const std::int64_t slabAlignment =
    std::max<std::int64_t>(1, GetLimit(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT) / WordBytes);
  const std::int64_t aligned = fitting / slabAlignment * slabAlignment;
  if (aligned == 0)
  {
    throw std::runtime_error("One slice of the grid with " + slicemap->GetGrid().Describe() +
      " is too large for this OpenGL renderer. Use fewer voxels along x and y, or voxelize in "
      "parts.");
  }
  return static_cast<int>(aligned);
}

void vtkSlicemapBindSlab(vtkSlicemap* slicemap, unsigned int binding, int firstSlice, int slices)
{
  const std::int64_t slice = GetBytesPerSlice(slicemap);
  slicemap->GetBuffer().BindRange(
    GL_SHADER_STORAGE_BUFFER, binding, firstSlice * slice, slices * slice);
}

void vtkSlicemapKernel::Run(const Context& context, vtkSlicemap* target, const Bind& bind) const
{
  const glm::ivec3 n = target->GetGrid().GetDimensions();
  this->Run(context, target,
    { glm::ivec3(0), { static_cast<int>(target->GetWordsPerRow()), n.y, n.z } }, bind);
}

void vtkSlicemapKernel::Run(
  const Context& context, vtkSlicemap* target, const Region& region, const Bind& bind) const
{
  if (context->SupportsCompute())
  {
    this->RunCompute(context, target, region, bind);
  }
  else
  {
    this->RunFragment(context, target, region, bind);
  }
}

std::uint64_t vtkSlicemapKernel::GetNumberOfInvocations(const glm::ivec3& size) const
{
  const auto rows = this->Defines.find("CELL_ROWS");
  const auto slices = this->Defines.find("CELL_SLICES");
  if (rows == this->Defines.end() || slices == this->Defines.end())
  {
    return std::uint64_t(size.x) * size.y * size.z;
  }
  // A region may begin and end within a cell.
  const auto blocks = [](int length, int cell, int cellsPerBlock)
  { return std::uint64_t(length + 2 * cell - 2) / cell / cellsPerBlock + 1; };
  return blocks(size.y, std::stoi(rows->second), CellsPerBlock.x) *
    blocks(size.z, std::stoi(slices->second), CellsPerBlock.y) * CellsPerBlock.x * CellsPerBlock.y *
    (size.x / WordsPerCell);
}

void vtkSlicemapKernel::RunCompute(
  const Context& context, vtkSlicemap* target, const Region& region, const Bind& bind) const
{
  auto defines = this->Defines;
  defines["COMPUTE"] = "1";
  Program& program = vtkVoxelGetProgram(context, this->Name, defines,
    { { GL_COMPUTE_SHADER, { vtkSlicemapLayoutGLSL, vtkSlicemapKernelGLSL, this->Source } } });
  program.Use();
  const std::int64_t wordsPerRow = target->GetWordsPerRow();
  const std::int64_t rowsPerSlice = target->GetGrid().GetDimensions().y;
  program.Set("WordsPerRow", static_cast<unsigned int>(wordsPerRow));
  program.Set("RowsPerSlice", static_cast<unsigned int>(rowsPerSlice));
  bind(program);

  const std::int64_t alignment = GetLimit(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT);
  const std::int64_t sliceBytes = wordsPerRow * rowsPerSlice * WordBytes;
  const std::int64_t fitting =
    (GetLimit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE) - alignment) / sliceBytes;
  const int slicesAtOnce = static_cast<int>(std::clamp<std::int64_t>(fitting, 1, 65536));
  for (int z = region.First.z; z < region.End.z; z += slicesAtOnce)
  {
    const int slices = std::min(slicesAtOnce, region.End.z - z);
    const std::int64_t start = z * sliceBytes;
    const std::int64_t aligned = start / alignment * alignment;
    target->GetBuffer().BindRange(
      GL_SHADER_STORAGE_BUFFER, 0, aligned, start + slices * sliceBytes - aligned);
    program.Set("BaseWord", static_cast<unsigned int>((start - aligned) / WordBytes));
    const glm::ivec3 size = region.End - region.First;
    SetRegion(program, { region.First.x, region.First.y, z }, { size.x, size.y, slices });
    vtkVoxelDispatch(this->GetNumberOfInvocations({ size.x, size.y, slices }));
  }
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

void vtkSlicemapKernel::RunFragment(
  const Context& context, vtkSlicemap* target, const Region& region, const Bind& bind) const
{
  Program& program = vtkVoxelGetProgram(context, this->Name, this->Defines,
    { { GL_VERTEX_SHADER, { vtkVoxelFullScreenGLSL } },
      { GL_FRAGMENT_SHADER, { vtkSlicemapLayoutGLSL, vtkSlicemapKernelGLSL, this->Source } } });
  program.Use();
  const glm::ivec3 size = region.End - region.First;
  const std::int64_t wordsPerRow = target->GetWordsPerRow();
  const std::int64_t rowsPerSlice = target->GetGrid().GetDimensions().y;
  const int slicesAtOnce =
    static_cast<int>(std::clamp<std::int64_t>(GetLimit(GL_MAX_TEXTURE_SIZE) / size.y, 1, size.z));

  vtkVoxelGL::Texture texture(context, GL_TEXTURE_2D);
  if (!texture.Allocate2D(GL_R32UI, size.x, size.y * slicesAtOnce, GL_RED_INTEGER, GL_UNSIGNED_INT))
  {
    throw std::runtime_error("OpenGL has no memory left for a render target.");
  }
  vtkVoxelGL::Framebuffer framebuffer(context);
  framebuffer.Attach(GL_COLOR_ATTACHMENT0, texture);
  framebuffer.SetDrawBuffers(1);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  vtkVoxelGL::VertexArray vertices(context);
  vertices.Bind();

  program.Set("WordsPerRow", static_cast<unsigned int>(wordsPerRow));
  program.Set("RowsPerSlice", static_cast<unsigned int>(rowsPerSlice));
  bind(program);
  for (int z = region.First.z; z < region.End.z; z += slicesAtOnce)
  {
    const int slices = std::min(slicesAtOnce, region.End.z - z);
    glViewport(0, 0, size.x, size.y * slices);
    SetRegion(program, { region.First.x, region.First.y, z }, { size.x, size.y, slices });
    glDrawArrays(GL_TRIANGLES, 0, 3);
    target->GetBuffer().Bind(GL_PIXEL_PACK_BUFFER);
    glPixelStorei(GL_PACK_ROW_LENGTH, static_cast<GLint>(wordsPerRow));
    for (int slice = 0; slice < slices; ++slice)
    {
      const std::int64_t first =
        ((z + slice) * rowsPerSlice + region.First.y) * wordsPerRow + region.First.x;
      glReadPixels(0, slice * size.y, size.x, size.y, GL_RED_INTEGER, GL_UNSIGNED_INT,
        reinterpret_cast<void*>(first * WordBytes));
    }
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  }
}
