// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelTextHeader.h
 * Private header: the text that files of voxels begin with, a line for the format, lines of a key
 * and its values, and the line "data" before the bytes.
 */

#ifndef vtkVoxelTextHeader_h
#define vtkVoxelTextHeader_h

#include <algorithm>
#include <array>
#include <istream>
#include <locale>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

/// All functions throw std::runtime_error, whose text tells what is wrong with the header.
class vtkVoxelTextHeader
{
public:
  /// Leaves the stream at the first byte of the data.
  vtkVoxelTextHeader(std::istream& stream, const std::string& signature)
  {
    std::size_t length = 0;
    std::string line;
    const auto readLine = [&]
    {
      line.clear();
      for (char c = 0; stream.get(c) && c != '\n';)
      {
        line += c;
        if (++length > LongestHeader)
        {
          throw std::runtime_error("its header has no end");
        }
      }
      line.erase(std::find(line.begin(), line.end(), '\r'), line.end());
      return static_cast<bool>(stream);
    };
    if (!readLine() || line.compare(0, signature.size(), signature) != 0)
    {
      throw std::runtime_error("it does not begin with " + signature);
    }
    for (;;)
    {
      if (!readLine())
      {
        throw std::runtime_error("its header ends before the line \"data\"");
      }
      std::istringstream words(line);
      std::string key;
      words >> key;
      if (key == "data")
      {
        return;
      }
      std::string values;
      std::getline(words >> std::ws, values);
      this->Lines[key] = values;
    }
  }

  /// The text behind a key; empty when there is none.
  std::string GetText(const std::string& key) const
  {
    const auto found = this->Lines.find(key);
    return found == this->Lines.end() ? std::string() : found->second;
  }

  /// The numbers behind a key; they stay as they are where the header does not have it.
  template <typename Number, std::size_t N>
  void Get(const std::string& key, std::array<Number, N>& numbers) const
  {
    const auto found = this->Lines.find(key);
    if (found == this->Lines.end())
    {
      return;
    }
    std::istringstream words(found->second);
    words.imbue(std::locale::classic());
    for (Number& number : numbers)
    {
      words >> number;
    }
    if (!words)
    {
      throw std::runtime_error(
        "the line \"" + key + " " + found->second + "\" of its header lacks a number");
    }
  }

private:
  static constexpr std::size_t LongestHeader = 65536;

  std::map<std::string, std::string> Lines;
};

#endif
// VTK-HeaderTest-Exclude: vtkVoxelTextHeader.h
