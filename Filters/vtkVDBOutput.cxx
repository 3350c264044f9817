// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVDBOutput.h"

#include "vtkNewVoxelFile.h"
#include "vtkVDBVoxelWriter.h"

#include <openvdb/io/Archive.h>

#include <algorithm>
#include <ostream>
#include <streambuf>

namespace
{
constexpr char CreatorName[] = "creator";
constexpr char Creator[] = "VTKVoxelization";

struct Stopped
{
};

/// Writes through another buffer, and looks up now and then.
class WatchedBuffer : public std::streambuf
{
public:
  WatchedBuffer(std::streambuf* target, std::function<void(std::int64_t)> watch)
    : Target(target)
    , Watch(std::move(watch))
  {
  }

protected:
  std::streamsize xsputn(const char* bytes, std::streamsize count) override
  {
    this->Written += count;
    if (this->Written >= this->NextLook)
    {
      this->Watch(this->Written);
      constexpr std::int64_t step = 1 << 20;
      this->NextLook = this->Written + step;
    }
    return this->Target->sputn(bytes, count);
  }
  int_type overflow(int_type c) override
  {
    return c == traits_type::eof() ? c : this->Target->sputc(traits_type::to_char_type(c));
  }
  pos_type seekoff(
    off_type offset, std::ios_base::seekdir from, std::ios_base::openmode mode) override
  {
    return this->Target->pubseekoff(offset, from, mode);
  }
  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override
  {
    return this->Target->pubseekpos(position, mode);
  }
  int sync() override { return this->Target->pubsync(); }

private:
  std::streambuf* Target;
  std::function<void(std::int64_t)> Watch;
  std::int64_t Written = 0;
  std::int64_t NextLook = 0;
};

/// OpenVDB's own file opens a name, and does not look whether its bytes arrive.
struct StreamArchive : openvdb::io::Archive
{
  using openvdb::io::Archive::write;
};

std::uint32_t GetCompressionFlags(int compression)
{
  switch (compression)
  {
    case vtkVDBVoxelWriter::COMPRESSION_BLOSC:
      return openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK;
    case vtkVDBVoxelWriter::COMPRESSION_ZIP:
      return openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK;
    default:
      return openvdb::io::COMPRESS_ACTIVE_MASK;
  }
}
}

vtkVDBOutput::Metadata vtkVDBOutput::GetDefaultMetadata()
{
  return { { CreatorName, Creator } };
}

int vtkVDBOutput::GetDefaultCompression()
{
  for (const int compression :
    { vtkVDBVoxelWriter::COMPRESSION_BLOSC, vtkVDBVoxelWriter::COMPRESSION_ZIP })
  {
    if (vtkVDBVoxelWriter::IsCompressionAvailable(compression))
    {
      return compression;
    }
  }
  return vtkVDBVoxelWriter::COMPRESSION_NONE;
}

bool vtkVDBOutput::Write(vtkNewVoxelFile& file, const std::vector<openvdb::GridBase::Ptr>& grids,
  const Metadata& metadata, int compression, const std::function<bool(double)>& progress)
{
  double bytes = 1.0;
  openvdb::GridCPtrVec written;
  for (const auto& grid : grids)
  {
    bytes += double(grid->memUsage());
    written.push_back(grid);
  }
  WatchedBuffer buffer(file.GetStream().rdbuf(),
    [&](std::int64_t count)
    {
      if (!progress(std::min(1.0, count / bytes)))
      {
        throw Stopped();
      }
    });
  std::ostream stream(&buffer);
  stream.exceptions(std::ios::failbit | std::ios::badbit);
  openvdb::MetaMap map;
  for (const auto& [name, text] : metadata)
  {
    map.insertMeta(name, openvdb::StringMetadata(text));
  }
  try
  {
    StreamArchive archive;
    archive.setCompression(GetCompressionFlags(compression));
    archive.write(stream, written, true, map);
  }
  catch (const Stopped&)
  {
    return false;
  }
  catch (const std::ios_base::failure&)
  {
    file.Fail("the disk may be full");
  }
  return true;
}
