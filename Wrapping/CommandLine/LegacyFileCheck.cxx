// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LegacyFileCheck.h"

#include "InputFile.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <iterator>
#include <string_view>

namespace
{
struct Type
{
  std::string_view Name;
  int Bits;
};

/// In the order in which VTK compares the beginnings of words with them.
constexpr Type Types[] = { { "bit", 1 }, { "char", 8 }, { "signed_char", 8 },
  { "unsigned_char", 8 }, { "short", 16 }, { "unsigned_short", 16 }, { "vtkidtype", 32 },
  { "int", 32 }, { "unsigned_int", 32 }, { "long", 64 }, { "unsigned_long", 64 },
  { "vtktypeint64", 64 }, { "vtktypeuint64", 64 }, { "float", 32 }, { "double", 64 } };

constexpr std::string_view CellKeywords[] = { "vertices", "lines", "polygons", "triangle_strips" };

bool BeginsWith(std::string_view word, std::string_view beginning)
{
  return word.substr(0, beginning.size()) == beginning;
}

class LegacyFile
{
public:
  explicit LegacyFile(const std::string& file)
    : File(file)
    , Size(static_cast<std::int64_t>(std::filesystem::file_size(file)))
    , Stream(file, std::ios::binary)
  {
  }

  void Check()
  {
    this->ReadHead();
    if (this->ReadWord() != "dataset" || !BeginsWith(this->ReadWord(), "polydata"))
    {
      return;
    }
    for (std::string word = this->ReadWord(); !word.empty(); word = this->ReadWord())
    {
      if (!this->CheckSection(word))
      {
        return;
      }
    }
  }

private:
  void ReadHead()
  {
    std::string line;
    std::getline(this->Stream, line);
    constexpr std::string_view beginning = "# vtk DataFile Version ";
    const std::string version = line.substr(std::min(line.size(), beginning.size()));
    this->HasOffsets = std::atoi(version.c_str()) >= 5;
    std::getline(this->Stream, line); // the title
    this->IsBinary = BeginsWith(this->ReadWord(), "binary");
  }

  /// In lower case; empty at the end of the file.
  std::string ReadWord()
  {
    std::string word;
    this->Stream >> word;
    std::transform(word.begin(), word.end(), word.begin(),
      [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return word;
  }

  /// Of things of which the file holds one in a bit or more.
  std::int64_t ReadCount(const std::string& what)
  {
    constexpr int bits = 8;
    std::int64_t count = 0;
    if (!(this->Stream >> count) || count < 0 || count / bits > this->Size)
    {
      InputFile::Refuse(this->File,
        "it has no number of " + what + ", or one that is negative or greater than the file");
    }
    return count;
  }

  /// False where this is not the geometry any more, or nothing that VTK knows.
  bool CheckSection(const std::string& word)
  {
    const bool isCells = std::any_of(std::begin(CellKeywords), std::end(CellKeywords),
      [&](std::string_view keyword) { return BeginsWith(word, keyword); });
    if (BeginsWith(word, "field"))
    {
      return this->SkipFields();
    }
    if (BeginsWith(word, "points"))
    {
      constexpr int coordinates = 3;
      const std::int64_t points = this->ReadCount(word);
      return this->SkipArray(word, points, coordinates);
    }
    if (isCells)
    {
      return this->HasOffsets ? this->SkipCells(word) : this->CheckCells(word);
    }
    return false;
  }

  bool SkipFields()
  {
    this->ReadWord(); // the name
    for (std::int64_t arrays = this->ReadCount("fields"); arrays > 0; --arrays)
    {
      const std::string name = this->ReadWord();
      const std::int64_t components = this->ReadCount("components of " + name);
      const std::int64_t tuples = this->ReadCount("values of " + name);
      if (!this->SkipArray(name, tuples, components))
      {
        return false;
      }
    }
    return true;
  }

  bool SkipCells(const std::string& what)
  {
    const std::int64_t offsets = this->ReadCount(what);
    const std::int64_t corners = this->ReadCount("corners of " + what);
    if (offsets == 0)
    {
      return true;
    }
    return this->ReadWord() == "offsets" && this->SkipArray(what, offsets, 1) &&
      this->ReadWord() == "connectivity" && this->SkipArray(what, corners, 1);
  }

  /// Cells of the old kind are numbers of points with the points behind each.
  bool CheckCells(const std::string& what)
  {
    const std::int64_t cells = this->ReadCount(what);
    const std::int64_t size = this->ReadCount("numbers of " + what);
    this->SkipLine();
    std::int64_t position = 0;
    std::int64_t found = 0;
    for (; position < size; ++found)
    {
      const std::int64_t corners = this->ReadInteger(what);
      position += 1 + corners;
      if (corners < 0 || position > size)
      {
        break;
      }
      for (std::int64_t i = 0; i < corners; ++i)
      {
        this->ReadInteger(what);
      }
    }
    if (position != size || found != cells)
    {
      InputFile::Refuse(this->File,
        "its " + what + " are damaged: " + std::to_string(cells) + " do not fit into " +
          std::to_string(size) + " numbers");
    }
    return true;
  }

  std::int32_t ReadInteger(const std::string& what)
  {
    std::int32_t value = 0;
    if (this->IsBinary)
    {
      value = static_cast<std::int32_t>(InputFile::ReadBigEndian(this->Stream));
    }
    else
    {
      this->Stream >> value;
    }
    if (!this->Stream)
    {
      this->RefuseEnd(what);
    }
    return value;
  }

  /// The type of an array, its values, and what VTK keeps with it.
  bool SkipArray(const std::string& name, std::int64_t tuples, std::int64_t components)
  {
    const std::string typeName = this->ReadWord();
    if (typeName == "string")
    {
      this->SkipStrings(name, tuples * components);
      this->SkipMetaData();
      return true;
    }
    const auto* const type = std::find_if(std::begin(Types), std::end(Types),
      [&](const Type& candidate) { return BeginsWith(typeName, candidate.Name); });
    if (type == std::end(Types))
    {
      return false;
    }
    constexpr int bits = 8;
    const std::int64_t largest = bits * this->Size;
    if (components > 0 && tuples > largest / components)
    {
      this->RefuseEnd(name);
    }
    this->IsBinary ? this->SkipBytes(name, (tuples * components * type->Bits + bits - 1) / bits)
                   : this->SkipWords(name, tuples * components);
    this->SkipMetaData();
    return true;
  }

  void SkipStrings(const std::string& name, std::int64_t count)
  {
    std::string line;
    std::getline(this->Stream, line);
    for (; count > 0; --count)
    {
      this->IsBinary ? this->SkipString() : void(std::getline(this->Stream, line));
      if (!this->Stream)
      {
        this->RefuseEnd(name);
      }
    }
  }

  /// The first two bits of a string tell of how many bytes its length is made: 3 is one, 0 is
  /// eight.
  void SkipString()
  {
    constexpr int flagShift = 6;
    constexpr int lengthMask = 0x3f;
    constexpr int bits = 8;
    const int first = this->Stream.get();
    std::uint64_t length = first & lengthMask;
    for (int more = (1 << (3 - (first >> flagShift & 3))) - 1; more > 0; --more)
    {
      length = length << bits | static_cast<unsigned char>(this->Stream.get());
    }
    if (!this->Stream || length > static_cast<std::uint64_t>(this->Size))
    {
      this->Stream.setstate(std::ios::failbit);
      return;
    }
    this->Stream.seekg(static_cast<std::streamoff>(length), std::ios::cur);
    this->Stream.peek();
    if (this->Stream.eof())
    {
      this->Stream.setstate(std::ios::failbit);
    }
  }

  void SkipWords(const std::string& name, std::int64_t count)
  {
    std::string word;
    for (; count > 0; --count)
    {
      if (!(this->Stream >> word))
      {
        this->RefuseEnd(name);
      }
    }
  }

  void SkipBytes(const std::string& name, std::int64_t count)
  {
    this->SkipLine();
    const std::int64_t position = this->Stream.tellg();
    if (position < 0 || count > this->Size - position)
    {
      this->RefuseEnd(name);
    }
    this->Stream.seekg(count, std::ios::cur);
  }

  /// What is left of the line before binary values.
  void SkipLine()
  {
    if (this->IsBinary)
    {
      std::string line;
      std::getline(this->Stream, line);
    }
  }

  /// Up to an empty line.
  void SkipMetaData()
  {
    const auto position = this->Stream.tellg();
    if (this->ReadWord() != "metadata")
    {
      this->Stream.clear();
      this->Stream.seekg(position);
      return;
    }
    std::string line;
    std::getline(this->Stream, line);
    while (std::getline(this->Stream, line) && !line.empty() && line != "\r")
    {
    }
  }

  [[noreturn]] void RefuseEnd(const std::string& what) const
  {
    InputFile::Refuse(this->File, "it is truncated: it ends within its " + what);
  }

  std::string File;
  std::int64_t Size;
  std::ifstream Stream;
  bool IsBinary = false;
  bool HasOffsets = false;
};
}

void LegacyFileCheck::Check(const std::string& file)
{
  LegacyFile(file).Check();
}
