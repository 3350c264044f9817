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
 * The values of a node come as a length and a block of so many bytes. OpenVDB takes memory for the
 * block before it knows that the file has so many bytes; reads a block that is not compressed to
 * where the values go before it compares the length with theirs; and hands a compressed one to
 * Blosc without its length, which then believes the one in the block. Here all lengths are compared
 * before, and throw std::ios_base::failure. Which values a node has, is known from what was read
 * just before: its mask, and a byte that tells which inactive values are there.
 */
class vtkVDBBuffer : public std::filebuf
{
public:
  /**
   * The tree of this grid begins at a position in a file of so many bytes.
   */
  void Watch(std::uint32_t compression, const openvdb::GridBase& grid, std::int64_t treeBegin,
    std::int64_t fileLength);

  /**
   * Throws unless a block that Blosc has compressed to so many bytes says so itself, in its first
   * BloscHeader bytes. Returns how many bytes it says that it decompresses to.
   */
  static std::int64_t CheckBloscBlock(const char* bytes, std::streamsize count);
  static constexpr std::streamsize BloscHeader = 16;

protected:
  std::streamsize xsgetn(char* bytes, std::streamsize count) override;

private:
  enum class Expected
  {
    Tree,      // before it
    Masks,     // before the mask of the first node
    Layout,    // mask read
    Inactives, // byte read, and inactive values are to come
    Selection, // of inactive values, a mask
    Length,    // of the values
    Values     // length read
  };

  bool IsBlock(std::streamsize count) const;
  void CheckAnnounced() const;
  void CheckRawBlock() const;
  void Follow(const char* bytes, std::streamsize count);
  void FollowLayout();

  bool IsCompressed = false;
  bool HasMasks = false;
  std::int64_t ValueBytes = 0;
  std::int64_t TreeBegin = 0;
  std::int64_t FileLength = 0;
  Expected Next = Expected::Tree;
  std::vector<unsigned char> Mask;
  char Layout = 0;
  int Inactives = 0;          // still to come
  std::int64_t Announced = 0; // length, negative when not compressed
  bool IsBlosc = false;
};

#endif
// VTK-HeaderTest-Exclude: vtkVDBBuffer.h
