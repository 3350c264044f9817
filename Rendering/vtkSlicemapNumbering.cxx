// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSlicemapNumbering.h"

#include "vtkSlicemap.h"
#include "vtkSlicemapKernel.h"
#include "vtkVoxelGrid.h"

#include "vtkSlicemapLayoutGLSL.h"
#include "vtkSlicemapNumberingGLSL.h"

#include <array>
#include <vector>

namespace
{
constexpr std::int64_t WordsPerQuad = 4;
constexpr std::size_t WordBytes = 4;
constexpr std::int64_t BlockQuads = 64; // as in vtkSlicemapNumbering.glsl
}

vtkSlicemapNumbering::vtkSlicemapNumbering(vtkSlicemap* slicemap)
  : Slicemap(slicemap)
  , Quads(vtkSlicemapTexture(slicemap))
{
  const vtkVoxelGL::Context& context = slicemap->GetBuffer().GetContext();
  const std::int64_t quads = slicemap->GetNumberOfWords() / WordsPerQuad;
  const std::int64_t blocks = (quads + BlockQuads - 1) / BlockQuads;
  vtkVoxelGL::Buffer blockNumbers;
  vtkVoxelGL::Prepare(blockNumbers, context, blocks * WordBytes);
  blockNumbers.BindBase(GL_SHADER_STORAGE_BUFFER, 0);
  this->Use(Stage::Count);
  vtkVoxelDispatch(blocks);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);

  std::vector<std::uint32_t> numbers(blocks);
  blockNumbers.Download(0, blocks * WordBytes, numbers.data());
  for (auto& number : numbers)
  {
    const std::uint32_t count = number;
    number = static_cast<std::uint32_t>(this->Count);
    this->Count += count;
  }
  blockNumbers.Upload(0, blocks * WordBytes, numbers.data());

  vtkVoxelGL::Prepare(this->Offsets, context, quads * WordBytes);
  this->Offsets.BindBase(GL_SHADER_STORAGE_BUFFER, 1);
  this->Use(Stage::Offsets);
  vtkVoxelDispatch(blocks);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
  this->OffsetsTexture = vtkVoxelGL::Texture(context, GL_TEXTURE_BUFFER);
  this->OffsetsTexture.AttachBuffer(GL_R32UI, this->Offsets);
}

vtkVoxelGL::Buffer vtkSlicemapNumbering::MakeIndices() const
{
  vtkVoxelGL::Buffer indices;
  if (this->Count == 0)
  {
    return indices;
  }
  vtkVoxelGL::Prepare(indices, this->Slicemap->GetBuffer().GetContext(), this->Count * WordBytes);
  indices.BindBase(GL_SHADER_STORAGE_BUFFER, 0);
  this->Offsets.BindBase(GL_SHADER_STORAGE_BUFFER, 1);
  auto& program = this->Use(Stage::Indices);
  const glm::ivec3 n = this->Slicemap->GetGrid().GetDimensions();
  program.Set("Size", std::array<int, 3>{ n.x, n.y, n.z });
  program.Set(
    "QuadsPerRow", static_cast<unsigned int>(this->Slicemap->GetWordsPerRow() / WordsPerQuad));
  vtkVoxelDispatch(this->Slicemap->GetNumberOfWords() / WordsPerQuad);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
  return indices;
}

vtkVoxelGL::Program& vtkSlicemapNumbering::Use(Stage stage) const
{
  const char* const names[] = { "COUNT", "OFFSETS", "INDICES" };
  auto& program = vtkVoxelGetProgram(this->Slicemap->GetBuffer().GetContext(),
    "vtkSlicemapNumbering", { { names[static_cast<int>(stage)], "1" } },
    { { GL_COMPUTE_SHADER, { vtkSlicemapLayoutGLSL, vtkSlicemapNumberingGLSL } } });
  program.Use();
  this->Quads.Bind(0);
  program.Set("Quads", 0);
  program.Set(
    "NumberOfQuads", static_cast<unsigned int>(this->Slicemap->GetNumberOfWords() / WordsPerQuad));
  return program;
}
