// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVDBBuffer.h
 * Private header: the bytes of a .vdb file on their way into OpenVDB.
 */

#ifndef vtkVDBBuffer_h
#define vtkVDBBuffer_h

#include <openvdb/openvdb.h>

#include <cstdint>
#include <fstream>
#include <vector>

/**
 * The values of a node come as a length and a block of so many bytes. OpenVDB reads a block that is
 * not compressed to where the values go before it compares the length with theirs, and hands a
 * compressed one to Blosc without its length, which then believes the one in the block. Here both
 * lengths are compared before, and throw std::ios_base::failure. Which values a node has, is known
 * from what was read just before: its mask, and a byte that tells whether inactive values are
 * there.
 */
class vtkVDBBuffer : public std::filebuf
{
public:
  /**
   * The tree of this grid comes next.
   */
  void Watch(std::uint32_t compression, const openvdb::GridBase& grid);

protected:
  std::streamsize xsgetn(char* bytes, std::streamsize count) override;

private:
  enum class Expected
  {
    Masks,  // before the mask of the first node
    Layout, // mask read
    Values  // byte read
  };

  bool IsBlock(std::streamsize count) const;
  void CheckRawBlock() const;
  void CheckBloscBlock(const char* bytes, std::streamsize count) const;
  void Follow(const char* bytes, std::streamsize count);

  bool IsCompressed = false;
  bool HasMasks = false;
  std::int64_t ValueBytes = 0;
  Expected Next = Expected::Masks;
  std::vector<unsigned char> Mask;
  char Layout = 0;
  std::int64_t Announced = 0; // length, negative when not compressed
  bool IsBlosc = false;
};

#endif
// VTK-HeaderTest-Exclude: vtkVDBBuffer.h
