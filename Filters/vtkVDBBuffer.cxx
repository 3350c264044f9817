// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVDBBuffer.h"

#include <openvdb/io/Compression.h>

#include <bitset>
#include <cstring>
#include <map>
#include <string>

namespace
{
constexpr int ByteBits = 8;

/// Masks of leaves, and of the two kinds of nodes above.
bool IsMask(std::streamsize count)
{
  return count == 64 || count == 512 || count == 4096;
}

std::uint32_t ReadLittleEndian(const char* bytes)
{
  std::uint32_t number = 0;
  for (int i = 3; i >= 0; --i)
  {
    number = number << ByteBits | static_cast<unsigned char>(bytes[i]);
  }
  return number;
}

/// Bytes of a value in a file; 0 for types that nobody reads.
std::int64_t GetValueBytes(const openvdb::GridBase& grid)
{
  static const std::map<std::string, std::int64_t> full = { { "bool", 1 }, { "float", 4 },
    { "double", 8 }, { "int32", 4 }, { "int64", 8 }, { "vec3s", 12 }, { "vec3d", 24 },
    { "vec3i", 12 } };
  static const std::map<std::string, std::int64_t> half = { { "float", 2 }, { "double", 2 },
    { "vec3s", 6 }, { "vec3d", 6 } };
  const std::string type = grid.valueType();
  const auto halved = half.find(type);
  if (grid.saveFloatAsHalf() && halved != half.end())
  {
    return halved->second;
  }
  const auto found = full.find(type);
  return found == full.end() ? 0 : found->second;
}
}

void vtkVDBBuffer::Watch(std::uint32_t compression, const openvdb::GridBase& grid)
{
  this->IsBlosc = (compression & openvdb::io::COMPRESS_BLOSC) != 0;
  this->IsCompressed = this->IsBlosc || (compression & openvdb::io::COMPRESS_ZIP) != 0;
  this->HasMasks = (compression & openvdb::io::COMPRESS_ACTIVE_MASK) != 0;
  this->ValueBytes = GetValueBytes(grid);
  this->Next = Expected::Masks;
  this->Mask.clear();
  this->Announced = 0;
}

std::streamsize vtkVDBBuffer::xsgetn(char* bytes, std::streamsize count)
{
  const bool isBlock = this->IsBlock(count);
  if (isBlock && this->Announced < 0)
  {
    this->CheckRawBlock();
  }
  const std::streamsize found = std::filebuf::xsgetn(bytes, count);
  if (found != count)
  {
    return found;
  }
  if (isBlock)
  {
    if (this->Announced > 0 && this->IsBlosc)
    {
      this->CheckBloscBlock(bytes, count);
    }
    this->Announced = 0;
    this->Next = Expected::Layout;
  }
  else
  {
    this->Follow(bytes, count);
  }
  return found;
}

bool vtkVDBBuffer::IsBlock(std::streamsize count) const
{
  return this->IsCompressed && this->Next == Expected::Values && this->Announced != 0 &&
    (count == this->Announced || count == -this->Announced);
}

void vtkVDBBuffer::CheckRawBlock() const
{
  auto values = static_cast<std::int64_t>(this->Mask.size()) * ByteBits;
  if (this->HasMasks && this->Layout != openvdb::io::NO_MASK_AND_ALL_VALS)
  {
    values = 0;
    for (const unsigned char byte : this->Mask)
    {
      values += static_cast<std::int64_t>(std::bitset<ByteBits>(byte).count());
    }
  }
  if (-this->Announced != values * this->ValueBytes)
  {
    throw std::ios_base::failure("a block of values has another length than its node");
  }
}

void vtkVDBBuffer::CheckBloscBlock(const char* bytes, std::streamsize count) const
{
  constexpr std::streamsize header = 16;
  constexpr int lengthPosition = 12;
  if (count < header ||
    std::int64_t(ReadLittleEndian(bytes + lengthPosition)) != std::int64_t(count))
  {
    throw std::ios_base::failure("a compressed block has another length than the file says");
  }
}

void vtkVDBBuffer::Follow(const char* bytes, std::streamsize count)
{
  const bool isSelection =
    this->Next == Expected::Values && count == static_cast<std::streamsize>(this->Mask.size());
  if (IsMask(count) && !isSelection)
  {
    this->Mask.assign(bytes, bytes + count);
    this->Next = Expected::Layout;
  }
  else if (count == 1 && this->Next == Expected::Layout)
  {
    this->Layout = *bytes;
    this->Next = Expected::Values;
  }
  else if (count == sizeof(this->Announced))
  {
    std::memcpy(&this->Announced, bytes, sizeof(this->Announced));
    if (this->Announced == 0)
    {
      this->Next = Expected::Layout;
    }
  }
}
