// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelMeshDisplacement.h"

#include <algorithm>
#include <cmath>

using vtkVoxelGL::Program;

void vtkVoxelMeshDisplacement::Table::Upload(
  const vtkVoxelGL::Context& context, GLenum format, std::size_t bytes, const void* data)
{
  vtkVoxelGL::Prepare(this->Buffer, context, bytes);
  this->Buffer.Upload(0, bytes, data);
  this->Texture = vtkVoxelGL::Texture(context, GL_TEXTURE_BUFFER);
  this->Texture.AttachBuffer(format, this->Buffer);
}

vtkVoxelMeshDisplacement::Ring::Ring(
  const vtkVoxelGL::Context& context, const std::vector<glm::vec3>& vectors)
  : Mask(static_cast<std::uint32_t>(vectors.size() - 1))
  , Longest(GetLongest(vectors, false))
  , LongestAlongNormals(GetLongest(vectors, true))
{
  std::vector<glm::vec4> padded(vectors.size());
  std::transform(vectors.begin(), vectors.end(), padded.begin(),
    [](const glm::vec3& v) { return glm::vec4(v, 0.0f); });
  this->Vectors.Upload(context, GL_RGBA32F, padded.size() * sizeof(padded[0]), padded.data());
}

double vtkVoxelMeshDisplacement::Ring::GetLongest(
  const std::vector<glm::vec3>& vectors, bool alongNormals)
{
  double longest = 0.0;
  for (const glm::dvec3 vector : vectors)
  {
    longest = std::max(longest, alongNormals ? std::abs(vector.x) : glm::length(vector));
  }
  return longest;
}

void vtkVoxelMeshDisplacement::SetPoints(const vtkVoxelGL::Context& context,
  const std::vector<std::uint32_t>& places, const std::vector<glm::vec3>& normals)
{
  std::uint32_t id = 0;
  this->PlacesDiffer =
    std::any_of(places.begin(), places.end(), [&](std::uint32_t place) { return place != id++; });
  if (this->PlacesDiffer)
  {
    this->Places.Upload(context, GL_R32UI, places.size() * sizeof(places[0]), places.data());
  }
  this->AlongNormals = !normals.empty();
  if (this->AlongNormals)
  {
    this->Normals.Upload(context, GL_RGB32F, normals.size() * sizeof(normals[0]), normals.data());
  }
}

void vtkVoxelMeshDisplacement::SetRing(std::shared_ptr<const Ring> ring, float amplitude)
{
  this->Vectors = std::move(ring);
  this->Amplitude = amplitude;
}

double vtkVoxelMeshDisplacement::GetLargest() const
{
  return this->Amplitude *
    (this->AlongNormals ? this->Vectors->LongestAlongNormals : this->Vectors->Longest);
}

Program::Defines vtkVoxelMeshDisplacement::GetDefines() const
{
  Program::Defines defines{ { "DISPLACED", "1" } };
  if (this->PlacesDiffer)
  {
    defines["PLACES_DIFFER"] = "1";
  }
  if (this->AlongNormals)
  {
    defines["ALONG_NORMALS"] = "1";
  }
  return defines;
}

void vtkVoxelMeshDisplacement::Bind(Program& program, unsigned int unit) const
{
  this->Vectors->Vectors.Texture.Bind(unit);
  program.Set("Displacements", static_cast<int>(unit));
  if (this->PlacesDiffer)
  {
    this->Places.Texture.Bind(unit + 1);
    program.Set("Places", static_cast<int>(unit + 1));
  }
  if (this->AlongNormals)
  {
    this->Normals.Texture.Bind(unit + 2);
    program.Set("Normals", static_cast<int>(unit + 2));
  }
  program.Set("FirstDisplacement", this->First);
  program.Set("RingMask", this->Vectors->Mask);
  program.Set("Amplitude", this->Amplitude);
}
