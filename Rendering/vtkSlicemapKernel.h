// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkSlicemapKernel.h
 * Private header: programs that compute a slicemap word by word.
 *
 * A kernel is a GLSL function `uint kernel(uvec3 word)`, where word is (x / 32, y, z). It may read
 * slicemaps on the same grid by `uint sourceWord(usamplerBuffer source, uvec3 word)`, and the bit
 * layout is that of vtkSlicemapLayout.glsl. Written once, it runs as a compute shader where the
 * context has them, else as a fragment shader whose result is copied from the render target on the
 * GPU. With the defines CELL_ROWS and CELL_SLICES, the compute shader is a function
 * `void cell(uvec3 first)` instead, which puts the words of a cell, so that they can share what
 * they read; see vtkSlicemapKernel.glsl.
 */

#ifndef vtkSlicemapKernel_h
#define vtkSlicemapKernel_h

#include "vtkVoxelGLObjects.h"

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

class vtkSlicemap;

/// What the version line of a program must allow; compute shaders have storage buffers anyway.
enum class vtkVoxelShaderVersion
{
  OfStages,      ///< OpenGL 3.2, or 4.3 for compute shaders
  StorageBuffers ///< OpenGL 4.3
};

/// A compiled program from the cache of the context; compiled and cached when it is not there yet.
/// Throws std::runtime_error with the compiler's log.
vtkVoxelGL::Program& vtkVoxelGetProgram(const vtkVoxelGL::Context& context, const std::string& name,
  const vtkVoxelGL::Program::Defines& defines,
  const std::vector<vtkVoxelGL::Program::Stage>& stages,
  vtkVoxelShaderVersion version = vtkVoxelShaderVersion::OfStages);

/// Runs a compute program for at least so many invocations; `local` is its workgroup's size.
/// Workgroups make a rectangle when one row of them would be too long.
void vtkVoxelDispatch(std::uint64_t invocations, unsigned int local = 64);

///@{
/// A buffer texture over the words of a slicemap: four words a texel (RGBA32UI), or one (R32UI),
/// which is none where the renderer's textures don't have so many texels.
vtkVoxelGL::Texture vtkSlicemapTexture(vtkSlicemap* slicemap);
vtkVoxelGL::Texture vtkSlicemapWordTexture(vtkSlicemap* slicemap);
///@}

///@{
/// Slices of the grid that fit into one storage buffer, whose offset may be that of any of its
/// multiples (throws std::runtime_error when not even one does), and binding such a slab, counted
/// from the first slice.
int vtkSlicemapSlicesPerSlab(vtkSlicemap* slicemap);
void vtkSlicemapBindSlab(vtkSlicemap* slicemap, unsigned int binding, int firstSlice, int slices);
///@}

class vtkSlicemapKernel
{
public:
  vtkSlicemapKernel(std::string name, std::string source, vtkVoxelGL::Program::Defines defines = {})
    : Name(std::move(name))
    , Source(std::move(source))
    , Defines(std::move(defines))
  {
  }

  /// Binds textures and sets uniforms of the kernel.
  using Bind = std::function<void(vtkVoxelGL::Program&)>;

  /// A box of words, half open: x in words, y and z in voxels.
  struct Region
  {
    glm::ivec3 First;
    glm::ivec3 End;
  };

  /// Fills all words of `target`, or those of a region, in the current context. Throws
  /// std::runtime_error.
  void Run(const vtkVoxelGL::Context& context, vtkSlicemap* target, const Bind& bind) const;
  void Run(const vtkVoxelGL::Context& context, vtkSlicemap* target, const Region& region,
    const Bind& bind) const;

private:
  std::uint64_t GetNumberOfInvocations(const glm::ivec3& size) const;
  void RunCompute(
    const vtkVoxelGL::Context&, vtkSlicemap* target, const Region&, const Bind& bind) const;
  void RunFragment(
    const vtkVoxelGL::Context&, vtkSlicemap* target, const Region&, const Bind& bind) const;

  std::string Name;
  std::string Source;
  vtkVoxelGL::Program::Defines Defines;
};

#endif
// VTK-HeaderTest-Exclude: vtkSlicemapKernel.h
