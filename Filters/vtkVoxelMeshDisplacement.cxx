// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelMeshDisplacement.h"

using vtkVoxelGL::Program;

void vtkVoxelMeshDisplacement::Table::Upload(
  const vtkVoxelGL::Context& context, GLenum format, std::size_t bytes, const void* data)
{
  vtkVoxelGL::Prepare(this->Buffer, context, bytes);
  this->Buffer.Upload(0, bytes, data);
  this->Texture = vtkVoxelGL::Texture(context, GL_TEXTURE_BUFFER);
  this->Texture.AttachBuffer(format, this->Buffer);
}

void vtkVoxelMeshDisplacement::SetPoints(const vtkVoxelGL::Context& context,
  const std::vector<std::uint32_t>& places, const std::vector<glm::vec3>& normals)
{
  this->Places.Upload(context, GL_R32UI, places.size() * sizeof(places[0]), places.data());
  this->AlongNormals = !normals.empty();
  if (this->AlongNormals)
  {
    this->Normals.Upload(context, GL_RGB32F, normals.size() * sizeof(normals[0]), normals.data());
  }
}

void vtkVoxelMeshDisplacement::SetRing(
  const vtkVoxelGL::Context& context, const std::vector<glm::vec3>& ring, double largest)
{
  this->Ring.Upload(context, GL_RGB32F, ring.size() * sizeof(ring[0]), ring.data());
  this->RingSize = static_cast<std::uint32_t>(ring.size());
  this->Largest = largest;
}

Program::Defines vtkVoxelMeshDisplacement::GetDefines() const
{
  Program::Defines defines{ { "DISPLACED", "1" } };
  if (this->AlongNormals)
  {
    defines["ALONG_NORMALS"] = "1";
  }
  return defines;
}

void vtkVoxelMeshDisplacement::Bind(Program& program, unsigned int unit) const
{
  this->Places.Texture.Bind(unit);
  program.Set("Places", static_cast<int>(unit));
  this->Ring.Texture.Bind(unit + 1);
  program.Set("Displacements", static_cast<int>(unit + 1));
  if (this->AlongNormals)
  {
    this->Normals.Texture.Bind(unit + 2);
    program.Set("Normals", static_cast<int>(unit + 2));
  }
  program.Set("FirstDisplacement", this->First);
  program.Set("NumberOfDisplacements", this->RingSize);
}
