// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDensityPass.h"

#include "vtkSlicemap.h"
#include "vtkSlicemapKernel.h" // for vtkSlicemapTexture
#include "vtkSlicemapQuadKernel.h"
#include "vtkVoxelGrid.h"

#include "vtkDensityAdderGLSL.h"
#include "vtkDensityRowsGLSL.h"
#include "vtkDensitySumsGLSL.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using vtkVoxelGL::Program;

namespace
{
/// Of sums that share nothing with their neighbours.
constexpr int MaximumTaps = 8;

/// Voxels along y or z whose sums follow from one another, one number more and one less; and quads
/// along x that share what they read.
constexpr int RunLength = 16;
constexpr int RunOfQuads = 4;

constexpr int VoxelsPerQuad = 128;
constexpr std::int64_t QuadBytes = 16;
constexpr unsigned int SourceUnit = 0;

/// Small enough for the caches of a processor that runs OpenGL in software.
constexpr std::int64_t SlabBytes = std::int64_t(1) << 23;

int GetRunLength(int axis)
{
  return axis == 0 ? RunOfQuads : RunLength;
}

int GetLogarithm(int powerOfTwo)
{
  int logarithm = 0;
  while (powerOfTwo > 1 << logarithm)
  {
    ++logarithm;
  }
  return logarithm;
}

int DividedUp(int number, int divisor)
{
  return (number + divisor - 1) / divisor;
}

/// Buffers are read as one texture; runs write them as one block, of at least one slice.
void CheckRoom(std::int64_t bytes, bool isBlock)
{
  GLint texels = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
  std::int64_t limit = texels * QuadBytes;
  if (isBlock)
  {
    GLint64 block = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block);
    limit = std::min<std::int64_t>(limit, block);
  }
  if (bytes > limit)
  {
    throw std::runtime_error("The counts of one slice take " + std::to_string(bytes) +
      " bytes, but this OpenGL renderer allows " + std::to_string(limit) +
      ". Use fewer voxels along x and y.");
  }
}

std::int64_t GetNumberOfQuads(const glm::ivec3& sizeInQuads)
{
  return std::int64_t(sizeInQuads.x) * sizeInQuads.y * sizeInQuads.z;
}
}

/// Sizes are in quads along x.
struct vtkDensityPass::Step
{
  int Axis;
  int Kernel; ///< along x; otherwise the number of taps
  int First = 0;
  int Distance = 1; ///< of taps
  int Stride = 1;
  int SourcePlanes;
  int Planes;
  glm::ivec3 SourceSize;
  glm::ivec3 Size;

  std::int64_t GetNumberOfCalls(bool runs) const
  {
    glm::ivec3 calls = this->Size;
    calls[this->Axis] =
      runs ? DividedUp(calls[this->Axis], GetRunLength(this->Axis)) : calls[this->Axis];
    return GetNumberOfQuads(calls);
  }
};

vtkDensityPass::vtkDensityPass(
  vtkVoxelGL::Context context, const glm::ivec3& kernel, bool downsampled)
  : Context(std::move(context))
  , Kernel(kernel)
  , Downsampled(downsampled)
{
}

bool vtkDensityPass::UsesRuns() const
{
  return !this->Downsampled && this->Context->SupportsCompute();
}

int vtkDensityPass::GetNumberOfPlanes() const
{
  return 1 + GetLogarithm(this->Kernel.x) + GetLogarithm(this->Kernel.y) +
    GetLogarithm(this->Kernel.z);
}

glm::ivec3 vtkDensityPass::GetResultSize(const glm::ivec3& sourceSize) const
{
  return this->Downsampled ? (sourceSize + this->Kernel - 1) / this->Kernel : sourceSize;
}

std::vector<vtkDensityPass::Step> vtkDensityPass::GetSteps(
  const glm::ivec3& sourceSize, int firstSlice, int slices) const
{
  std::vector<Step> steps;
  Step next{};
  next.Planes = 1;
  next.Size = { DividedUp(sourceSize.x, VoxelsPerQuad), sourceSize.y, sourceSize.z };
  const auto add = [&](int axis, int kernel, int size)
  {
    next.Axis = axis;
    next.Kernel = kernel;
    next.SourcePlanes = next.Planes;
    next.Planes += GetLogarithm(kernel);
    next.SourceSize = next.Size;
    next.Size[axis] = size;
    steps.push_back(next);
  };
  // Sums of a few voxels, then of a few of those sums. Along z always, since that makes the slab.
  const auto addAxis = [&](int axis, int first, int count)
  {
    const int kernel = this->Kernel[axis];
    const int taps = this->UsesRuns() ? kernel : std::min(kernel, MaximumTaps);
    const int rest = kernel / taps;
    next.First = this->Downsampled ? first * kernel : first - kernel / 2;
    next.Distance = 1;
    next.Stride = this->Downsampled ? taps : 1;
    add(axis, taps, this->Downsampled ? count * rest : count + kernel - taps);
    if (rest > 1)
    {
      next.First = 0;
      next.Distance = this->Downsampled ? 1 : taps;
      next.Stride = this->Downsampled ? rest : 1;
      add(axis, rest, count);
    }
  };
  const glm::ivec3 resultSize = this->GetResultSize(sourceSize);
  addAxis(2, firstSlice, slices);
  if (this->Kernel.y > 1)
  {
    addAxis(1, 0, resultSize.y);
  }
  if (this->Kernel.x > 1)
  {
    add(0, this->Kernel.x, DividedUp(resultSize.x, VoxelsPerQuad));
  }
  return steps;
}

void vtkDensityPass::RunStep(
  const Step& step, const vtkVoxelGL::Texture& source, vtkVoxelGL::Buffer& target) const
{
  Program::Defines defines;
  defines["SOURCE_PLANES"] = std::to_string(step.SourcePlanes);
  defines["PLANES"] = std::to_string(step.Planes);
  const bool alongRows = step.Axis == 0;
  const bool runs = this->UsesRuns();
  if (runs)
  {
    defines["RUNS"] = std::to_string(GetRunLength(step.Axis));
  }
  if (!alongRows)
  {
    defines["AXIS"] = std::to_string(step.Axis);
  }
  else
  {
    defines["KERNEL"] = std::to_string(step.Kernel);
    if (this->Downsampled)
    {
      defines["DOWNSAMPLED"] = "1";
    }
  }
  const vtkSlicemapQuadKernel kernel(alongRows ? "vtkDensityRows" : "vtkDensitySums",
    std::string(vtkDensityAdderGLSL) + (alongRows ? vtkDensityRowsGLSL : vtkDensitySumsGLSL),
    std::move(defines));
  kernel.Run(this->Context, target, step.GetNumberOfCalls(runs),
    [&](Program& program)
    {
      source.Bind(SourceUnit);
      program.Set("Source", int(SourceUnit));
      if (alongRows)
      {
        program.Set("SourceQuads", step.SourceSize.x);
        program.Set("QuadsPerRow", step.Size.x);
        return;
      }
      const auto set = [&](const char* name, const glm::ivec3& size) {
        program.Set(name, std::array<int, 3>{ size.x, size.y, size.z });
      };
      set("SourceSize", step.SourceSize);
      set("Size", step.Size);
      program.Set("Taps", step.Kernel);
      program.Set("First", step.First);
      program.Set("Step", step.Distance);
      program.Set("Stride", step.Stride);
    });
}

bool vtkDensityPass::Run(vtkSlicemap* source, const Consume& consume) const
{
  const glm::ivec3 size = source->GetGrid().GetDimensions();
  const glm::ivec3 resultSize = this->GetResultSize(size);
  const auto getBytes = [](const Step& step)
  { return GetNumberOfQuads(step.Size) * step.Planes * QuadBytes; };

  std::int64_t sliceBytes = 0;
  for (const Step& step : this->GetSteps(size, 0, 1))
  {
    sliceBytes = std::max(sliceBytes, getBytes(step));
  }
  const auto slices =
    static_cast<int>(std::clamp<std::int64_t>(SlabBytes / sliceBytes, 1, resultSize.z));

  std::array<vtkVoxelGL::Buffer, 2> sums;
  std::array<std::size_t, 2> room{};
  const auto largest = this->GetSteps(size, 0, slices);
  for (std::size_t i = 0; i < largest.size(); ++i)
  {
    room[i % 2] = std::max(room[i % 2], static_cast<std::size_t>(getBytes(largest[i])));
  }
  std::array<vtkVoxelGL::Texture, 2> textures;
  for (std::size_t i = 0; i < std::min<std::size_t>(2, largest.size()); ++i)
  {
    CheckRoom(static_cast<std::int64_t>(room[i]), this->UsesRuns());
    vtkVoxelGL::Prepare(sums[i], this->Context, room[i]);
    textures[i] = vtkVoxelGL::Texture(this->Context, GL_TEXTURE_BUFFER);
    textures[i].AttachBuffer(GL_RGBA32UI, sums[i]);
  }
  const auto sourceTexture = vtkSlicemapTexture(source);

  vtkSlicemap::CountReadBack();
  for (int first = 0; first < resultSize.z; first += slices)
  {
    const int count = std::min(slices, resultSize.z - first);
    const auto steps = this->GetSteps(size, first, count);
    for (std::size_t i = 0; i < steps.size(); ++i)
    {
      this->RunStep(steps[i], i == 0 ? sourceTexture : textures[(i - 1) % 2], sums[i % 2]);
    }
    const vtkVoxelGL::MappedBuffer mapped(sums[(steps.size() - 1) % 2], 0,
      static_cast<std::size_t>(getBytes(steps.back())), GL_MAP_READ_BIT);
    if (!mapped.Get())
    {
      throw std::runtime_error("The density could not be read back from OpenGL.");
    }
    if (!consume({ first, count, static_cast<const std::uint32_t*>(mapped.Get()) }))
    {
      return false;
    }
  }
  return true;
}
