// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file OutputFile.h
 * A file whose bytes are known to have arrived.
 */

#ifndef OutputFile_h
#define OutputFile_h

#include "Failure.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>

/**
 * Every call throws Failure with ExitCode::Output, which names the target, when the disk is full or
 * something else is in the way.
 */
class OutputFile
{
public:
  /// Opens the staged file; the target is what messages are about.
  OutputFile(const std::string& staged, std::string target)
    : Target(std::move(target))
  {
    errno = 0;
    this->Stream.open(staged, std::ios::binary);
    this->Check();
  }

  void Append(const void* bytes, std::size_t count)
  {
    this->Stream.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(count));
    this->Check();
  }

  void Close()
  {
    this->Stream.close();
    this->Check();
  }

  [[noreturn]] static void Refuse(const std::string& target, const std::string& why)
  {
    throw Failure(ExitCode::Output, "cannot write " + target + ": " + why);
  }

  /// For an error number of the system, or 0 where it gave none.
  static std::string Describe(int error)
  {
    return error != 0 ? std::strerror(error) : "the disk may be full";
  }

private:
  void Check()
  {
    if (!this->Stream)
    {
      OutputFile::Refuse(this->Target, OutputFile::Describe(errno));
    }
  }

  std::string Target;
  std::ofstream Stream;
};

#endif
