// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshFileCheck.h"

#include "InputFile.h"

#include "vtksys/SystemTools.hxx"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace
{
using InputFile::Refuse;
using InputFile::RefuseLength;

std::vector<std::string_view> SplitWords(std::string_view line)
{
  constexpr std::string_view blanks = " \t\r";
  std::vector<std::string_view> words;
  for (auto begin = line.find_first_not_of(blanks); begin != std::string_view::npos;
       begin = line.find_first_not_of(blanks, begin))
  {
    const auto end = std::min(line.find_first_of(blanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

/// The whole number that a word begins with, as scanf would read it.
bool ReadInteger(std::string_view word, std::int64_t& value)
{
  return std::from_chars(word.data(), word.data() + word.size(), value).ec == std::errc();
}

//------------------------------------------------------------------------------------------------

struct PlyProperty
{
  std::string Name;
  std::string Type;
  std::string CountType; // empty unless the property is a list
};

struct PlyElement
{
  std::string Name;
  std::int64_t Count = 0;
  std::vector<PlyProperty> Properties;

  const PlyProperty* Find(const std::string& name) const
  {
    for (const PlyProperty& property : this->Properties)
    {
      if (property.Name == name)
      {
        return &property;
      }
    }
    return nullptr;
  }
};

/// Reads a PLY file as vtkPLYReader does, and keeps nothing but the header.
class PlyFile
{
public:
  explicit PlyFile(const std::string& file)
    : File(file)
    , Stream(file, std::ios::binary)
  {
  }

  bool IsText()
  {
    this->ReadHeader();
    return this->Encoding == "ascii";
  }

  void Check()
  {
    this->ReadHeader();
    this->CheckHeader();
    for (const PlyElement& element : this->Elements)
    {
      for (std::int64_t i = 0; i < element.Count; ++i)
      {
        this->Encoding == "ascii" ? this->ReadLineOf(element, i) : this->ReadBytesOf(element, i);
      }
      if (element.Name == "face")
      {
        break; // VTK looks no further.
      }
    }
  }

private:
  /// VTK counts the corners of a face in a byte.
  static constexpr std::int64_t MaximumCorners = 255;

  /// VTK reads lines into a buffer of 4096 bytes, up to the first that is zero.
  static bool IsReadable(const std::string& line)
  {
    constexpr std::size_t longest = 4094;
    return line.size() <= longest && line.find('\0') == std::string::npos;
  }

  bool ReadLine(std::string& line) { return static_cast<bool>(std::getline(this->Stream, line)); }

  void ReadHeader()
  {
    std::string line;
    if (!this->ReadLine(line) || SplitWords(line) != std::vector<std::string_view>{ "ply" })
    {
      Refuse(this->File, "it is no PLY file: it does not begin with the line 'ply'");
    }
    while (this->ReadLine(line))
    {
      const auto words = SplitWords(line);
      if (words.empty() || !IsReadable(line))
      {
        Refuse(this->File, "its header has a line that is empty, too long, or no text");
      }
      if (words[0] == "comment" || words[0] == "obj_info")
      {
        continue;
      }
      if (words[0] == "end_header")
      {
        return;
      }
      this->ReadHeaderLine(words, line);
    }
    Refuse(this->File, "it is truncated: its header has no end");
  }

  void ReadHeaderLine(const std::vector<std::string_view>& words, const std::string& line)
  {
    const bool isList = words.size() == 5 && words[1] == "list";
    std::int64_t count = 0;
    if (words[0] == "format" && words.size() == 3)
    {
      this->Encoding = words[1];
    }
    else if (words[0] == "element" && words.size() == 3 && ReadInteger(words[2], count) &&
      count >= 0)
    {
      this->Elements.push_back({ std::string(words[1]), count, {} });
    }
    else if (words[0] == "property" && !this->Elements.empty() && (isList || words.size() == 3))
    {
      PlyProperty property;
      property.Name = words.back() == "vertex_index" ? "vertex_indices" : words.back();
      property.Type = words[words.size() - 2];
      property.CountType = isList ? words[2] : "";
      this->GetSize(property.Type);
      if (isList)
      {
        this->CheckCountType(property.CountType);
      }
      this->Elements.back().Properties.push_back(property);
    }
    else
    {
      Refuse(this->File, "its header has the line '" + line.substr(0, 60) + "'");
    }
  }

  static bool IsReal(const std::string& type) { return type[0] == 'f' || type[0] == 'd'; }

  void CheckCountType(const std::string& type) const
  {
    this->GetSize(type);
    if (IsReal(type))
    {
      Refuse(this->File, "its header has a list that is counted by the type '" + type + "'");
    }
  }

  /// VTK takes it for granted that these are no lists, and texcoord is one.
  void CheckKinds(const PlyElement& element) const
  {
    static const std::set<std::string> scalars = { "x", "y", "z", "u", "v", "nx", "ny", "nz", "red",
      "green", "blue", "alpha", "diffuse_red", "diffuse_green", "diffuse_blue", "texture_u",
      "texture_v", "intensity" };
    for (const PlyProperty& property : element.Properties)
    {
      const bool isList = !property.CountType.empty();
      if (isList ? scalars.count(property.Name) != 0 : property.Name == "texcoord")
      {
        Refuse(this->File,
          "the property " + property.Name + " of its " + element.Name + " is " +
            (isList ? "a list" : "no list"));
      }
    }
  }

  void CheckElements() const
  {
    std::set<std::string> names;
    for (const PlyElement& element : this->Elements)
    {
      this->CheckKinds(element);
      if (!names.insert(element.Name).second)
      {
        Refuse(this->File, "its header has the element " + element.Name + " twice");
      }
    }
  }

  void CheckHeader() const
  {
    this->CheckElements();
    if (this->Encoding != "ascii" && this->Encoding != "binary_little_endian" &&
      this->Encoding != "binary_big_endian")
    {
      Refuse(this->File, "its header names no format that is known");
    }
    if (this->Elements.empty() || this->Elements[0].Name != "vertex")
    {
      Refuse(this->File, "its first elements are no vertices");
    }
    for (const char* name : { "x", "y", "z" })
    {
      const PlyProperty* property = this->Elements[0].Find(name);
      if (!property || !property->CountType.empty())
      {
        Refuse(this->File, std::string("its vertices have no coordinate ") + name);
      }
    }
    if (this->Elements.size() < 2 || this->Elements[1].Name != "face")
    {
      Refuse(this->File, "no faces follow its vertices");
    }
    const PlyProperty* corners = this->Elements[1].Find("vertex_indices");
    if (!corners || corners->CountType.empty() || IsReal(corners->Type))
    {
      Refuse(this->File, "its faces have no list vertex_indices of whole numbers");
    }
  }

  std::size_t GetSize(const std::string& type) const
  {
    static const std::array<std::pair<const char*, std::size_t>, 16> sizes = { { { "char", 1 },
      { "int8", 1 }, { "uchar", 1 }, { "uint8", 1 }, { "short", 2 }, { "int16", 2 },
      { "ushort", 2 }, { "uint16", 2 }, { "int", 4 }, { "int32", 4 }, { "uint", 4 },
      { "uint32", 4 }, { "float", 4 }, { "float32", 4 }, { "double", 8 }, { "float64", 8 } } };
    for (const auto& [name, size] : sizes)
    {
      if (type == name)
      {
        return size;
      }
    }
    Refuse(this->File, "its header names the type '" + type + "'");
  }

  [[noreturn]] void RefuseTruncated(const PlyElement& element, std::int64_t index) const
  {
    Refuse(this->File,
      "it is truncated: it ends at " + element.Name + " " + std::to_string(index) + " of " +
        std::to_string(element.Count));
  }

  void CheckItem(const PlyProperty& property, const PlyElement& element, std::int64_t index,
    std::int64_t corner) const
  {
    if (element.Name == "face" && property.Name == "vertex_indices" &&
      (corner < 0 || corner >= this->Elements[0].Count))
    {
      Refuse(this->File,
        "face " + std::to_string(index) + " refers to vertex " + std::to_string(corner) +
          ", which does not exist");
    }
  }

  void CheckCount(const PlyElement& element, std::int64_t index, std::int64_t count) const
  {
    if (count < 0 || (element.Name == "face" && count > MaximumCorners))
    {
      Refuse(this->File,
        element.Name + " " + std::to_string(index) + " has a list of " + std::to_string(count) +
          " items; VTK reads up to " + std::to_string(MaximumCorners));
    }
  }

  /// The whole number that VTK makes of the beginning of a word for a number.
  std::int64_t ReadWord(
    const std::string& word, const PlyElement& element, std::int64_t index) const
  {
    char* end = nullptr;
    std::strtod(word.c_str(), &end);
    if (*end != '\0')
    {
      Refuse(this->File,
        element.Name + " " + std::to_string(index) + " has '" + word + "' for a number");
    }
    constexpr int decimal = 10;
    return std::strtoll(word.c_str(), nullptr, decimal);
  }

  void ReadLineOf(const PlyElement& element, std::int64_t index)
  {
    if (!this->ReadLine(this->Line))
    {
      this->RefuseTruncated(element, index);
    }
    const auto words = SplitWords(this->Line);
    std::size_t next = 0;
    const auto readNumber = [&]() -> std::int64_t
    {
      if (next == words.size() || !IsReadable(this->Line))
      {
        Refuse(this->File,
          "the line of " + element.Name + " " + std::to_string(index) +
            (next == words.size() ? " is too short" : " is too long, or no text"));
      }
      return this->ReadWord(std::string(words[next++]), element, index);
    };
    for (const PlyProperty& property : element.Properties)
    {
      std::int64_t count = 1;
      if (!property.CountType.empty())
      {
        count = readNumber();
        this->CheckCount(element, index, count);
      }
      for (; count > 0; --count)
      {
        this->CheckItem(property, element, index, readNumber());
      }
    }
  }

  /// An integer of the given type; floating-point types are skipped.
  std::int64_t ReadBinary(const std::string& type, const PlyElement& element, std::int64_t index)
  {
    std::array<unsigned char, 8> bytes{};
    const std::size_t size = this->GetSize(type);
    if (!this->Stream.read(reinterpret_cast<char*>(bytes.data()), size))
    {
      this->RefuseTruncated(element, index);
    }
    if (this->Encoding == "binary_little_endian")
    {
      std::reverse(bytes.begin(), bytes.begin() + size);
    }
    constexpr unsigned char signBit = 0x80;
    const bool isNegative = type.front() != 'u' && (bytes[0] & signBit) != 0;
    std::uint64_t value = isNegative ? ~std::uint64_t(0) : 0;
    for (std::size_t i = 0; i < size; ++i)
    {
      value = value << 8 | bytes[i];
    }
    return static_cast<std::int64_t>(value);
  }

  void ReadBytesOf(const PlyElement& element, std::int64_t index)
  {
    for (const PlyProperty& property : element.Properties)
    {
      std::int64_t count = 1;
      if (!property.CountType.empty())
      {
        count = this->ReadBinary(property.CountType, element, index);
        this->CheckCount(element, index, count);
      }
      for (; count > 0; --count)
      {
        this->CheckItem(property, element, index, this->ReadBinary(property.Type, element, index));
      }
    }
  }

  std::string File;
  std::ifstream Stream;
  std::string Encoding;
  std::string Line;
  std::vector<PlyElement> Elements;
};

//------------------------------------------------------------------------------------------------

/// Reads the lines of an OBJ file that hold indices.
class ObjFile
{
public:
  explicit ObjFile(std::string file)
    : File(std::move(file))
  {
  }

  void Check()
  {
    // Positive indices may refer to what comes later, negative ones count back from their line.
    this->ReadLines([this](const auto& words) { Count(words[0], this->Totals); });
    this->ReadLines(
      [this](const auto& words)
      {
        Count(words[0], this->Seen);
        if (words[0] == "f" || words[0] == "l" || words[0] == "p")
        {
          for (std::size_t i = 1; i < words.size(); ++i)
          {
            this->CheckCorner(words[i]);
          }
        }
      });
  }

private:
  /// Points, texture coordinates, normals: the order of the indices of a corner.
  using Counts = std::array<std::int64_t, 3>;

  template <typename Function>
  void ReadLines(const Function& function)
  {
    std::ifstream stream(this->File, std::ios::binary);
    std::string line;
    for (this->LineNumber = 1; std::getline(stream, line); ++this->LineNumber)
    {
      auto words = SplitWords(line);
      for (std::string more; !words.empty() && words.back() == "\\" && std::getline(stream, more);
           ++this->LineNumber)
      {
        line.erase(line.rfind('\\'));
        line += " " + more;
        words = SplitWords(line);
      }
      if (!words.empty())
      {
        function(words);
      }
    }
  }

  static void Count(std::string_view command, Counts& counts)
  {
    counts[0] += command == "v";
    counts[1] += command == "vt";
    counts[2] += command == "vn";
  }

  void CheckCorner(std::string_view corner) const
  {
    constexpr std::array<const char*, 3> kinds = { "point", "texture coordinate", "normal" };
    for (std::size_t kind = 0; kind < kinds.size() && !corner.empty(); ++kind)
    {
      std::int64_t index = 0;
      if (ReadInteger(corner, index))
      {
        const bool exists =
          index > 0 ? index <= this->Totals[kind] : index < 0 && -index <= this->Seen[kind];
        if (!exists)
        {
          Refuse(this->File,
            "line " + std::to_string(this->LineNumber) + " refers to " + kinds[kind] + " " +
              std::to_string(index) + ", which does not exist");
        }
      }
      const auto slash = corner.find('/');
      corner = slash == std::string_view::npos ? std::string_view() : corner.substr(slash + 1);
    }
  }

  std::string File;
  Counts Totals{};
  Counts Seen{};
  std::int64_t LineNumber = 0;
};

/// Of a float whose bytes come in the order of their weight.
bool IsFinite(const unsigned char* bytes)
{
  const bool hasHighestExponent = (bytes[3] & 0x7F) == 0x7F && (bytes[2] & 0x80) != 0;
  return !hasHighestExponent;
}
}

void MeshFileCheck::CheckSTL(const std::string& file)
{
  if (vtksys::SystemTools::DetectFileType(file.c_str()) == vtksys::SystemTools::FileTypeText)
  {
    return; // VTK notices when a text ends too early.
  }
  constexpr std::uint64_t headBytes = 84;
  constexpr std::uint64_t triangleBytes = 50;
  const std::uint64_t size = std::filesystem::file_size(file);
  if (size < headBytes)
  {
    RefuseLength(file, "the head of a binary STL file", headBytes, size);
  }
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(headBytes - 4);
  const std::uint32_t triangles = InputFile::ReadLittleEndian(stream);
  const std::uint64_t promised = headBytes + triangles * triangleBytes;
  if (size < promised)
  {
    RefuseLength(
      file, "its number of triangles, " + std::to_string(triangles) + ",", promised, size);
  }

  // VTK reads to the end of the file; of points that are no numbers only some versions complain.
  constexpr std::size_t normalBytes = 12;
  constexpr std::size_t pointsEnd = 48;
  std::array<unsigned char, triangleBytes> record;
  for (std::uint64_t i = 0; stream.read(reinterpret_cast<char*>(record.data()), record.size()); ++i)
  {
    for (std::size_t byte = normalBytes; byte < pointsEnd; byte += 4)
    {
      if (!IsFinite(&record[byte]))
      {
        Refuse(file, "triangle " + std::to_string(i) + " has points that are NaN or infinite");
      }
    }
  }
}

void MeshFileCheck::CheckPLY(const std::string& file)
{
  PlyFile(file).Check();
}

bool MeshFileCheck::IsPLYWithoutLastLineEnd(const std::string& file)
{
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(-1, std::ios::end);
  return stream.get() != '\n' && PlyFile(file).IsText();
}

void MeshFileCheck::CheckOBJ(const std::string& file)
{
  ObjFile(file).Check();
}
