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

/// Values that inactive voxels of a node have, where they are written, by its layout.
int GetNumberOfInactives(char layout)
{
  switch (layout)
  {
    case openvdb::io::NO_MASK_AND_ONE_INACTIVE_VAL:
    case openvdb::io::MASK_AND_ONE_INACTIVE_VAL:
      return 1;
    case openvdb::io::MASK_AND_TWO_INACTIVE_VALS:
      return 2;
    default:
      return 0;
  }
}

/// Whether a mask selects among the values of inactive voxels.
bool HasSelection(char layout)
{
  return layout == openvdb::io::MASK_AND_NO_INACTIVE_VALS ||
    layout == openvdb::io::MASK_AND_ONE_INACTIVE_VAL ||
    layout == openvdb::io::MASK_AND_TWO_INACTIVE_VALS;
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

void vtkVDBBuffer::Watch(std::uint32_t compression, const openvdb::GridBase& grid,
  std::int64_t treeBegin, std::int64_t fileLength)
{
  this->IsBlosc = (compression & openvdb::io::COMPRESS_BLOSC) != 0;
  this->IsCompressed = this->IsBlosc || (compression & openvdb::io::COMPRESS_ZIP) != 0;
  this->HasMasks = (compression & openvdb::io::COMPRESS_ACTIVE_MASK) != 0;
  this->ValueBytes = GetValueBytes(grid);
  this->TreeBegin = treeBegin;
  this->FileLength = fileLength;
  this->Next = Expected::Tree;
  this->Mask.clear();
  this->Announced = 0;
}

std::streamsize vtkVDBBuffer::xsgetn(char* bytes, std::streamsize count)
{
  if (this->IsCompressed && this->Next == Expected::Tree &&
    this->pubseekoff(0, std::ios::cur, std::ios::in) >= this->TreeBegin)
  {
    this->Next = Expected::Masks;
  }
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
  if (isBlock && this->Announced > 0 && this->IsBlosc)
  {
    CheckBloscBlock(bytes, count);
  }
  if (this->IsCompressed)
  {
    this->Follow(bytes, count);
  }
  return found;
}

bool vtkVDBBuffer::IsBlock(std::streamsize count) const
{
  return this->Next == Expected::Values && (count == this->Announced || count == -this->Announced);
}

void vtkVDBBuffer::CheckAnnounced() const
{
  if (this->Announced > this->FileLength || this->Announced < -this->FileLength)
  {
    throw std::ios_base::failure("a block of values is longer than the file");
  }
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

std::int64_t vtkVDBBuffer::CheckBloscBlock(const char* bytes, std::streamsize count)
{
  constexpr int unpackedPosition = 4;
  constexpr int packedPosition = 12;
  if (count < BloscHeader ||
    std::int64_t(ReadLittleEndian(bytes + packedPosition)) != std::int64_t(count))
  {
    throw std::ios_base::failure("a compressed block has another length than the file says");
  }
  return ReadLittleEndian(bytes + unpackedPosition);
}

void vtkVDBBuffer::Follow(const char* bytes, std::streamsize count)
{
  switch (this->Next)
  {
    case Expected::Tree:
      return;
    case Expected::Inactives:
      --this->Inactives;
      this->FollowLayout();
      return;
    case Expected::Selection:
      this->Next = Expected::Length;
      return;
    case Expected::Length:
      if (count == sizeof(this->Announced))
      {
        std::memcpy(&this->Announced, bytes, sizeof(this->Announced));
        this->CheckAnnounced();
        this->Next = this->Announced == 0 ? Expected::Masks : Expected::Values;
        return;
      }
      break; // no half floats have no length
    case Expected::Values:
      this->Next = Expected::Masks;
      return;
    case Expected::Layout:
      if (count == 1)
      {
        this->Layout = *bytes;
        this->Inactives = GetNumberOfInactives(*bytes);
        this->FollowLayout();
        return;
      }
      break;
    case Expected::Masks:
      break;
  }
  if (IsMask(count))
  {
    this->Mask.assign(bytes, bytes + count);
    this->Next = Expected::Layout;
  }
}

void vtkVDBBuffer::FollowLayout()
{
  this->Next = this->Inactives > 0 ? Expected::Inactives
    : HasSelection(this->Layout)   ? Expected::Selection
                                   : Expected::Length;
}
