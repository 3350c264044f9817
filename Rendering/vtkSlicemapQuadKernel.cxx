// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSlicemapQuadKernel.h"

#include "vtkSlicemap.h"
#include "vtkSlicemapKernel.h"

#include "vtkSlicemapLayoutGLSL.h"
#include "vtkSlicemapQuadKernelGLSL.h"
#include "vtkVoxelFullScreenGLSL.h"

#include <algorithm>
#include <stdexcept>

using vtkVoxelGL::Context;
using vtkVoxelGL::Program;

namespace
{
constexpr std::int64_t QuadBytes = 16;
constexpr std::int64_t QuadWords = 4;
constexpr std::int64_t CallsPerBlock = 4096; // a multiple of all alignments of storage buffers

/// Render targets are so large at most.
constexpr GLsizei MaximumLine = 4096;
constexpr GLsizei MaximumLines = 1024;
}

std::int64_t vtkSlicemapQuadKernel::GetQuadsPerCall() const
{
  const auto planes = this->Defines.find("PLANES");
  return planes == this->Defines.end() ? 1 : std::stoll(planes->second);
}

void vtkSlicemapQuadKernel::Run(const Context& context, vtkSlicemap* target, const Bind& bind) const
{
  this->Run(context, target->GetBuffer(), target->GetNumberOfWords() / QuadWords, bind);
}

void vtkSlicemapQuadKernel::Run(
  const Context& context, vtkVoxelGL::Buffer& target, std::int64_t calls, const Bind& bind) const
{
  if (context->SupportsCompute())
  {
    this->RunCompute(context, target, calls, bind);
  }
  else
  {
    this->RunFragment(context, target, calls, bind);
  }
}

void vtkSlicemapQuadKernel::RunCompute(
  const Context& context, vtkVoxelGL::Buffer& target, std::int64_t calls, const Bind& bind) const
{
  auto defines = this->Defines;
  defines["COMPUTE"] = "1";
  Program& program = vtkVoxelGetProgram(context, this->Name, defines,
    { { GL_COMPUTE_SHADER, { vtkSlicemapLayoutGLSL, vtkSlicemapQuadKernelGLSL, this->Source } } });
  program.Use();
  bind(program);
  GLint64 blockBytes = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &blockBytes);
  if (this->Defines.count("RUNS"))
  {
    target.BindBase(GL_SHADER_STORAGE_BUFFER, 0);
    program.Set("NumberOfQuads", static_cast<unsigned int>(calls));
    vtkVoxelDispatch(calls);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    return;
  }
  const std::int64_t callBytes = QuadBytes * this->GetQuadsPerCall();
  const std::int64_t callsAtOnce = blockBytes / callBytes / CallsPerBlock * CallsPerBlock;
  for (std::int64_t first = 0; first < calls; first += callsAtOnce)
  {
    const std::int64_t count = std::min(callsAtOnce, calls - first);
    target.BindRange(GL_SHADER_STORAGE_BUFFER, 0, first * callBytes, count * callBytes);
    program.Set("FirstQuad", static_cast<unsigned int>(first));
    program.Set("NumberOfQuads", static_cast<unsigned int>(count));
    vtkVoxelDispatch(count);
  }
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

void vtkSlicemapQuadKernel::RunFragment(
  const Context& context, vtkVoxelGL::Buffer& target, std::int64_t calls, const Bind& bind) const
{
  Program& program = vtkVoxelGetProgram(context, this->Name, this->Defines,
    { { GL_VERTEX_SHADER, { vtkVoxelFullScreenGLSL } },
      { GL_FRAGMENT_SHADER, { vtkSlicemapLayoutGLSL, vtkSlicemapQuadKernelGLSL, this->Source } } });
  const std::int64_t quads = calls * this->GetQuadsPerCall();
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  const auto line = static_cast<GLsizei>(std::min<std::int64_t>({ quads, largest, MaximumLine }));
  const auto lines = static_cast<GLsizei>(
    std::min<std::int64_t>({ (quads + line - 1) / line, largest, MaximumLines }));
  vtkVoxelGL::Texture texture(context, GL_TEXTURE_2D);
  if (!texture.Allocate2D(GL_RGBA32UI, line, lines, GL_RGBA_INTEGER, GL_UNSIGNED_INT))
  {
    throw std::runtime_error("OpenGL has no memory left for a render target.");
  }
  vtkVoxelGL::Framebuffer framebuffer(context);
  framebuffer.Attach(GL_COLOR_ATTACHMENT0, texture);
  framebuffer.SetDrawBuffers(1);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  vtkVoxelGL::VertexArray vertices(context);
  vertices.Bind();
  program.Use();
  program.Set("QuadsPerLine", static_cast<unsigned int>(line));
  bind(program);

  // Whole lines, and at the end what is left of one.
  const auto fill = [&](std::int64_t first, GLsizei width, GLsizei height)
  {
    program.Set("FirstQuad", static_cast<unsigned int>(first));
    glViewport(0, 0, width, height);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    target.Bind(GL_PIXEL_PACK_BUFFER);
    glReadPixels(0, 0, width, height, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
      reinterpret_cast<void*>(first * QuadBytes));
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  };
  std::int64_t first = 0;
  while (quads - first >= line)
  {
    const auto height = static_cast<GLsizei>(std::min<std::int64_t>(lines, (quads - first) / line));
    fill(first, line, height);
    first += std::int64_t(line) * height;
  }
  if (first < quads)
  {
    fill(first, static_cast<GLsizei>(quads - first), 1);
  }
}
