// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelMeshVariants.h"

#include "vtkSolidPass.h" // for vtkColumnAxes

#include <array>

namespace
{
/// As in vtkVoxelMeshVariants.glsl.
struct Record
{
  std::array<glm::vec4, 2> RoughRows;
  std::array<std::uint32_t, 4> FirstDisplacement;
  std::array<glm::dvec4, 3> Rows;
};
static_assert(sizeof(Record) == 144, "nine texels");

Record MakeRecord(const vtkVoxelMeshVariants::Variant& variant)
{
  const glm::dmat4 rows = glm::transpose(variant.IndexFromWorld);
  const vtkColumnAxes axes(variant.ColumnAxis);
  return { { glm::vec4(rows[axes.U]), glm::vec4(rows[axes.V]) },
    { variant.FirstDisplacement, 0, 0, 0 }, { rows[axes.U], rows[axes.V], rows[axes.Depth] } };
}
}

void vtkVoxelMeshVariants::Upload(const vtkVoxelGL::Context& context, std::vector<Variant> variants)
{
  this->Variants = std::move(variants);
  std::vector<Record> records;
  records.reserve(this->Variants.size());
  for (const Variant& variant : this->Variants)
  {
    records.push_back(MakeRecord(variant));
  }
  const std::size_t bytes = records.size() * sizeof(Record);
  const bool isThere =
    this->Buffer && this->Buffer.GetContext() == context && this->Buffer.GetSize() == bytes;
  vtkVoxelGL::Prepare(this->Buffer, context, bytes);
  this->Buffer.Upload(0, bytes, records.data());
  if (!isThere)
  {
    this->Texture = vtkVoxelGL::Texture(context, GL_TEXTURE_BUFFER);
    this->Texture.AttachBuffer(GL_RGBA32UI, this->Buffer);
  }
}

void vtkVoxelMeshVariants::Bind(vtkVoxelGL::Program& program, unsigned int unit) const
{
  this->Texture.Bind(unit);
  program.Set("Variants", static_cast<int>(unit));
}
