// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file InputFile.h
 * What holds for every file that the program reads.
 */

#ifndef InputFile_h
#define InputFile_h

#include "Failure.h"

#include <cerrno>
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

/// Throws Failure unless this is a file that can be opened and is not empty.
inline void CheckReadable(const std::string& file)
{
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
  {
    Refuse(file, "it is a folder");
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
