// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file InputFile.h
 * What holds for every file that the program reads.
 */

#ifndef InputFile_h
#define InputFile_h

#include "Failure.h"

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

namespace InputFile
{
[[noreturn]] inline void Refuse(const std::string& file, const std::string& why)
{
  throw Failure(ExitCode::Input, "cannot read " + file + ": " + why);
}

[[noreturn]] inline void RefuseLength(
  const std::string& file, const std::string& promise, std::uint64_t promised, std::uint64_t found)
{
  Refuse(file,
    "it is truncated: " + promise + " makes " + std::to_string(promised) +
      " bytes, but there are " + std::to_string(found));
}

/// The next four bytes as a number; 0 at the end of the file.
inline std::uint32_t ReadLittleEndian(std::istream& stream)
{
  std::array<unsigned char, 4> bytes{};
  stream.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
  return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | std::uint32_t(bytes[3]) << 24;
}

/// The same from the other end.
inline std::uint32_t ReadBigEndian(std::istream& stream)
{
  std::array<unsigned char, 4> bytes{};
  stream.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
  return bytes[3] | bytes[2] << 8 | bytes[1] << 16 | std::uint32_t(bytes[0]) << 24;
}

/// Throws Failure unless this is a file that can be opened, more than once, and is not empty.
inline void CheckReadable(const std::string& file)
{
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
  {
    Refuse(file, "it is a folder");
  }
  if (std::filesystem::is_other(file, error))
  {
    // To open a pipe may take for ever.
    Refuse(file, "it is a pipe or a device; write what comes of it to a file");
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
  {
    Refuse(file, std::strerror(errno));
  }
  if (stream.peek() == std::ifstream::traits_type::eof())
  {
    Refuse(file, "it is empty");
  }
}
}

#endif
