// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVDBFile.h"

#include "vtkVDBBuffer.h"
#include "vtkVoxelFileError.h"

#include <openvdb/io/Archive.h>
#include <openvdb/io/Compression.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/version.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <istream>
#include <limits>
#include <mutex>
#include <new>

namespace
{
/// Before it, headers and trees were laid out differently; OpenVDB 1.0 already wrote this one.
constexpr std::uint32_t OldestVersion = openvdb::OPENVDB_FILE_VERSION_NODE_MASK_COMPRESSION;

constexpr std::int64_t VersionPosition = 8;
constexpr std::int64_t HeaderBytes = 8 + 3 * 4 + 1 + 36; // signature, versions, flag, identifier
constexpr std::int64_t BytesPerLeaf = 64;                // at least: its mask
constexpr std::int64_t BloscPadding = 128; // OpenVDB compresses fewer bytes as so many
constexpr std::int64_t LongestGridName = 1 << 16;
constexpr char HalfFloatSuffix[] = "_HalfFloat";
constexpr char DelayedLoadType[] = "__delayedload";
constexpr char StringType[] = "string";

/// The destructor of a tree that was not read to its end would follow pointers that were never set.
void Abandon(const openvdb::GridBase::Ptr& grid)
{
  static std::mutex mutex;
  static auto* const abandoned = new std::vector<openvdb::GridBase::Ptr>;
  const std::lock_guard<std::mutex> lock(mutex);
  abandoned->push_back(grid);
}

void Initialize()
{
  static const bool done = []
  {
    openvdb::initialize();
    return true;
  }();
  static_cast<void>(done);
}
}

struct vtkVDBFile::Archive : public openvdb::io::Archive
{
  explicit Archive(const std::string& name)
    : Stream(&this->Buffer)
  {
    if (!this->Buffer.open(name, std::ios::in | std::ios::binary))
    {
      throw vtkVoxelFileError(
        vtkErrorCode::CannotOpenFileError, "The file " + name + " can't be opened.");
    }
    this->Length = this->Buffer.pubseekoff(0, std::ios::end, std::ios::in);
    this->Buffer.pubseekpos(0, std::ios::in);
    this->Stream.exceptions(std::ios::eofbit | std::ios::failbit | std::ios::badbit);
  }

  std::int64_t GetPosition() { return this->Stream.tellg(); }
  void Seek(std::int64_t position) { this->Stream.seekg(position); }

  template <typename Number>
  Number ReadNumber()
  {
    Number number = 0;
    this->Stream.read(reinterpret_cast<char*>(&number), sizeof(number));
    return number;
  }

  static void Check(bool holds, const char* what)
  {
    if (!holds)
    {
      throw std::ios_base::failure(what);
    }
  }

  void CheckRest(std::int64_t bytes)
  {
    Check(bytes <= this->Length - this->GetPosition(), "it ends too early");
  }

  std::string ReadString()
  {
    const auto length = this->ReadNumber<std::uint32_t>();
    Check(length <= LongestGridName, "a name is too long");
    this->CheckRest(length);
    std::string text(length, '\0');
    if (length > 0)
    {
      this->Stream.read(text.data(), length);
    }
    return text;
  }

  /// Goes through metadata without storing them, and back.
  void CheckMetadata()
  {
    const std::int64_t begin = this->GetPosition();
    this->SkipMetadata();
    this->Seek(begin);
  }

  /// The same for what comes before a tree.
  void CheckGridHeader()
  {
    const std::int64_t begin = this->GetPosition();
    this->Compression = this->ReadNumber<std::uint32_t>();
    this->SkipMetadata();
    this->ReadString(); // the type of the transform
    this->Seek(begin);
  }

  /// A grid with a tree of its own comes next; its header is read, to know where its tree begins,
  /// and come back to.
  void Watch(openvdb::GridBase& grid)
  {
    const std::int64_t begin = this->GetPosition();
    this->ReadGridHeader(grid);
    const std::int64_t tree = this->GetPosition();
    Check(this->ReadNumber<std::int32_t>() == 1, "its trees have several buffers");
    this->Buffer.Watch(this->Compression, grid, tree, this->Length);
    this->Seek(begin);
  }

  void ReadGridHeader(openvdb::GridBase& grid)
  {
    this->CheckGridHeader();
    readGridCompression(this->Stream);
    grid.readMeta(this->Stream);
    grid.readTransform(this->Stream);
  }

  void SkipMetadata()
  {
    const auto count = this->ReadNumber<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i)
    {
      this->ReadString();
      const std::string type = this->ReadString();
      const auto bytes = this->ReadNumber<std::uint32_t>();
      this->CheckRest(bytes);
      const std::int64_t end = this->GetPosition() + bytes;
      if (type == DelayedLoadType)
      {
        this->CheckDelayedLoad(end);
      }
      else if (type != StringType && openvdb::Metadata::isRegisteredType(type))
      {
        // OpenVDB reads as much as the type takes, whatever the file says.
        Check(bytes == openvdb::Metadata::createMetadata(type)->size(),
          "a value of its metadata has the wrong length");
      }
      this->Seek(end);
    }
  }

  /// Two numbers for each leaf, which nobody needs here, but OpenVDB reads.
  void CheckDelayedLoad(std::int64_t end)
  {
    if (this->GetPosition() == end)
    {
      return;
    }
    const std::int64_t leaves = this->ReadNumber<std::uint32_t>();
    Check(leaves <= this->Length / BytesPerLeaf, "it has fewer leaves than it says");
    this->CheckPacked(this->ReadNumber<std::uint32_t>(), leaves * sizeof(std::int8_t), end);
    const auto packed = this->ReadNumber<std::uint32_t>();
    if (packed != std::numeric_limits<std::uint32_t>::max())
    {
      this->CheckPacked(packed, leaves * sizeof(std::int64_t), end);
    }
    Check(this->GetPosition() <= end, "a value of its metadata has the wrong length");
  }

  /// Bytes that Blosc has packed, or has not where `packed` is 0.
  void CheckPacked(std::int64_t packed, std::int64_t unpacked, std::int64_t end)
  {
    const std::int64_t begin = this->GetPosition();
    const std::int64_t stored = packed == 0 ? unpacked : packed;
    Check(stored <= end - begin, "a value of its metadata has the wrong length");
    if (packed != 0)
    {
      std::array<char, vtkVDBBuffer::BloscHeader> header;
      this->Stream.read(header.data(), header.size());
      Check(
        vtkVDBBuffer::CheckBloscBlock(header.data(), packed) <= std::max(unpacked, BloscPadding),
        "a value of its metadata has the wrong length");
    }
    this->Seek(begin + stored);
  }

  using openvdb::io::Archive::inputHasGridOffsets;
  using openvdb::io::Archive::readGrid;
  using openvdb::io::Archive::readGridCompression;
  using openvdb::io::Archive::readGridCount;
  using openvdb::io::Archive::readHeader;
  using openvdb::io::Archive::setDataCompression;
  using openvdb::io::Archive::setFormatVersion;
  using openvdb::io::Archive::setLibraryVersion;

  // The stream keeps the address of its metadata.
  openvdb::io::StreamMetadata::Ptr StreamMetadata = std::make_shared<openvdb::io::StreamMetadata>();
  vtkVDBBuffer Buffer;
  std::uint32_t Compression = 0; // of the grid at hand
  std::istream Stream;
  std::int64_t Length = 0;
};

vtkVDBFile::vtkVDBFile(const char* name)
{
  vtkVoxelFileError::RequireFile(name);
  Initialize();
  this->Name = name;
  this->Input = std::make_unique<Archive>(this->Name);
  try
  {
    this->ReadHeader();
    this->ReadEntries();
  }
  catch (const vtkVoxelFileError&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    this->Fail(error.what());
  }
}

vtkVDBFile::~vtkVDBFile() = default;

bool vtkVDBFile::HasSignature(const char* name)
{
  std::ifstream stream(name ? name : "", std::ios::binary);
  std::int32_t signature = 0; // the rest of eight bytes is zero
  return stream.read(reinterpret_cast<char*>(&signature), sizeof(signature)) &&
    signature == openvdb::OPENVDB_MAGIC;
}

void vtkVDBFile::Fail(const std::string& what) const
{
  throw vtkVoxelFileError(vtkErrorCode::FileFormatError,
    "The file " + this->Name + " is no .vdb file, or is damaged: " + what + ".");
}

void vtkVDBFile::ReadHeader()
{
  Archive& input = *this->Input;
  if (!vtkVDBFile::HasSignature(this->Name.c_str()))
  {
    this->Fail("it does not begin as one");
  }
  input.CheckRest(HeaderBytes);
  input.Seek(VersionPosition);
  const auto version = input.ReadNumber<std::uint32_t>();
  if (version < OldestVersion || version > openvdb::OPENVDB_FILE_VERSION)
  {
    this->Fail("its format is version " + std::to_string(version) + ", and versions " +
      std::to_string(OldestVersion) + " to " + std::to_string(openvdb::OPENVDB_FILE_VERSION) +
      " can be read");
  }
  input.Seek(0);
  openvdb::io::setStreamMetadataPtr(input.Stream, input.StreamMetadata, false);
  input.readHeader(input.Stream);
  input.setFormatVersion(input.Stream);
  input.setLibraryVersion(input.Stream);
  input.setDataCompression(input.Stream);
  input.CheckMetadata();
  this->Metadata.readMeta(input.Stream);
}

void vtkVDBFile::ReadEntries()
{
  const std::int32_t count = Archive::readGridCount(this->Input->Stream);
  Archive::Check(count >= 0, "its number of grids is negative");
  for (std::int32_t i = 0; i < count; ++i)
  {
    this->Entries.push_back(this->ReadEntry());
  }
}

vtkVDBFile::Entry vtkVDBFile::ReadEntry()
{
  Archive& input = *this->Input;
  Entry entry;
  entry.Begin = input.GetPosition();
  entry.UniqueName = input.ReadString();
  entry.Name = openvdb::io::GridDescriptor::stripSuffix(entry.UniqueName);
  entry.Type = input.ReadString();
  entry.Parent = input.ReadString();
  const auto gridPosition = input.ReadNumber<std::int64_t>();
  input.ReadNumber<std::int64_t>(); // where the values of the tree begin
  entry.End = input.ReadNumber<std::int64_t>();
  const std::size_t suffix = entry.Type.rfind(HalfFloatSuffix);
  if (suffix != std::string::npos && suffix + std::strlen(HalfFloatSuffix) == entry.Type.size())
  {
    entry.Type.erase(suffix);
  }
  const std::int64_t position = input.GetPosition();
  const bool isKnown = openvdb::GridBase::isRegistered(entry.Type);
  if (!input.inputHasGridOffsets())
  {
    // Written without them, grids can only be read one after the other.
    entry.End = 0;
    if (!isKnown)
    {
      this->Fail("the grid \"" + entry.Name + "\" is of the unknown type " + entry.Type +
        ", and cannot be skipped");
    }
    entry.Grid = this->Read(entry);
    return entry;
  }
  Archive::Check(gridPosition == position && entry.End > position && entry.End <= input.Length,
    "it ends too early, or its offsets are wrong");
  if (isKnown)
  {
    entry.Grid = openvdb::GridBase::createGrid(entry.Type);
    input.ReadGridHeader(*entry.Grid);
  }
  input.Seek(entry.End);
  return entry;
}

openvdb::GridBase::Ptr vtkVDBFile::Read(const Entry& entry)
{
  Archive& input = *this->Input;
  if (!input.inputHasGridOffsets() && entry.Grid)
  {
    return entry.Grid;
  }
  openvdb::GridBase::Ptr grid;
  try
  {
    input.Seek(entry.Begin);
    openvdb::io::GridDescriptor descriptor;
    grid = descriptor.read(input.Stream);
    if (entry.Parent.empty())
    {
      input.Watch(*grid);
    }
    Archive::readGrid(grid, descriptor, input.Stream);
    Archive::Check(entry.End == 0 || input.GetPosition() == entry.End,
      "a grid has another length than the file says");
  }
  catch (const std::bad_alloc&)
  {
    Abandon(grid);
    this->Fail("there is no memory for the grid \"" + entry.Name + "\"");
  }
  catch (const std::exception& error)
  {
    Abandon(grid);
    this->Fail(error.what());
  }
  if (!entry.Parent.empty())
  {
    const auto parent = std::find_if(this->Entries.begin(), this->Entries.end(),
      [&](const Entry& other) { return other.UniqueName == entry.Parent; });
    const bool isThere = parent != this->Entries.end() && parent->Parent.empty() && parent->Grid &&
      parent->Type == entry.Type;
    if (!isThere)
    {
      this->Fail("the grid \"" + entry.Name + "\" shares the tree of another, which is missing");
    }
    grid->setTree(this->Read(*parent)->baseTreePtr());
  }
  return grid;
}
