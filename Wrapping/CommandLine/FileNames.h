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
#include <iterator>
#include <optional>
#include <regex>
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

/// Where a name has a number such as %d or %04d, which stands there once: the text before and
/// behind it, and how many digits it has at least.
struct Numbered
{
  std::string Before;
  std::string Behind;
  int Digits;

  std::string operator()(long long number) const
  {
    std::string digits = std::to_string(number);
    const auto length = static_cast<std::size_t>(this->Digits);
    digits.insert(0, length > digits.size() ? length - digits.size() : 0, '0');
    return this->Before + digits + this->Behind;
  }
};

inline std::optional<Numbered> FindNumber(const std::string& file)
{
  static const std::regex number("%(0[1-9])?d");
  const std::sregex_iterator found(file.begin(), file.end(), number);
  if (std::distance(found, std::sregex_iterator()) != 1)
  {
    return std::nullopt;
  }
  const std::string digits = found->str(1);
  return Numbered{ found->prefix(), found->suffix(), digits.empty() ? 1 : digits[1] - '0' };
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
