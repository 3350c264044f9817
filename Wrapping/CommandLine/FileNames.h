// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FileNames.h
 * What the program asks about names of files before it opens any.
 */

#ifndef FileNames_h
#define FileNames_h

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace FileNames
{
/// The extension in lower case, with its dot; empty when there is none.
inline std::string GetExtension(const std::string& file)
{
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Whether both name one place, whether or not there is a file yet.
inline bool AreSame(const std::string& one, const std::string& other)
{
  std::error_code error;
  return std::filesystem::weakly_canonical(one, error) ==
    std::filesystem::weakly_canonical(other, error);
}
}

#endif
