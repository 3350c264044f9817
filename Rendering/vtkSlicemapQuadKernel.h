// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkSlicemapQuadKernel.h
 * Private header: programs that compute a slicemap four words at a time, where a quad depends on
 * the same quad of other slicemaps only. They move the bits as fast as memory does, whereas those
 * of vtkSlicemapKernel know where a word lies and may look at its neighbours.
 *
 * A kernel is a GLSL function `uvec4 kernel(uint quad)`. It reads slicemaps on the same grid by
 * `uvec4 sourceQuad(usamplerBuffer source, uint quad)`. The target may be one of them. Written
 * once, it runs as a compute or as a fragment shader. With the define PLANES it is a function
 * `void kernel(uint quad, out uvec4 planes[PLANES])`, whose results lie one after the other in the
 * target, which is a buffer then. With the define RUNS besides, which needs compute shaders, it is
 * `void run(uint call)` and calls `void put(uint quad, uvec4 planes[PLANES])` for quads of its
 * choice, so that neighbours can share what they read.
 */

#ifndef vtkSlicemapQuadKernel_h
#define vtkSlicemapQuadKernel_h

#include "vtkVoxelGLObjects.h"

#include <cstdint>
#include <functional>
#include <string>

class vtkSlicemap;

class vtkSlicemapQuadKernel
{
public:
  vtkSlicemapQuadKernel(
    std::string name, std::string source, vtkVoxelGL::Program::Defines defines = {})
    : Name(std::move(name))
    , Source(std::move(source))
    , Defines(std::move(defines))
  {
  }

  /// Binds textures and sets uniforms of the kernel.
  using Bind = std::function<void(vtkVoxelGL::Program&)>;

  /// Fills all of `target`, which is allocated, in the current context. Throws std::runtime_error.
  void Run(const vtkVoxelGL::Context& context, vtkSlicemap* target, const Bind& bind) const;

  /// Fills `target` by so many calls of the kernel; it may be larger, but with RUNS not than a
  /// storage block.
  void Run(const vtkVoxelGL::Context& context, vtkVoxelGL::Buffer& target, std::int64_t calls,
    const Bind& bind) const;

private:
  void RunCompute(const vtkVoxelGL::Context&, vtkVoxelGL::Buffer& target, std::int64_t calls,
    const Bind& bind) const;
  void RunFragment(const vtkVoxelGL::Context&, vtkVoxelGL::Buffer& target, std::int64_t calls,
    const Bind& bind) const;
  std::int64_t GetQuadsPerCall() const;

  std::string Name;
  std::string Source;
  vtkVoxelGL::Program::Defines Defines;
};

#endif
// VTK-HeaderTest-Exclude: vtkSlicemapQuadKernel.h
