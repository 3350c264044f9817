// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVDBFile.h
 * Private header: a .vdb file to read, which may be damaged.
 */

#ifndef vtkVDBFile_h
#define vtkVDBFile_h

#include <openvdb/openvdb.h>

#include <memory>
#include <string>
#include <vector>

/**
 * OpenVDB's own reader takes the lengths and counts in a file for granted, goes on after its end,
 * and crashes where it throws within a tree. Here all that comes before the trees is checked
 * against the length of the file first, reading behind the end is an error, blocks of Blosc have to
 * have the length that the file says, and what a failure leaves of a tree is never touched again,
 * at the price of its memory. Every method throws vtkVoxelFileError, which names the file.
 */
class vtkVDBFile
{
public:
  struct Entry
  {
    std::string Name;
    std::string UniqueName; // has a number where several grids have the name
    std::string Type;       // OpenVDB's, for instance Tree_float_5_4_3
    std::string Parent;     // unique name of the grid whose tree this one shares, or empty
    std::int64_t Begin = 0; // of its descriptor
    std::int64_t End = 0;
    openvdb::GridBase::Ptr
      Grid; // metadata and transform; null where OpenVDB does not know the type
  };

  /**
   * Reads all but the trees.
   */
  explicit vtkVDBFile(const char* name);
  ~vtkVDBFile();
  vtkVDBFile(const vtkVDBFile&) = delete;
  void operator=(const vtkVDBFile&) = delete;

  const std::vector<Entry>& GetEntries() const { return this->Entries; }
  const openvdb::MetaMap& GetMetadata() const { return this->Metadata; }
  const std::string& GetName() const { return this->Name; }

  /**
   * Reads the tree of a grid.
   */
  openvdb::GridBase::Ptr Read(const Entry& entry);

  /**
   * Whether the file begins as a .vdb file does.
   */
  static bool HasSignature(const char* name);

private:
  struct Archive;

  [[noreturn]] void Fail(const std::string& what) const;
  void ReadHeader();
  void ReadEntries();
  Entry ReadEntry();

  std::string Name;
  std::unique_ptr<Archive> Input;
  openvdb::MetaMap Metadata;
  std::vector<Entry> Entries;
};

#endif
// VTK-HeaderTest-Exclude: vtkVDBFile.h
