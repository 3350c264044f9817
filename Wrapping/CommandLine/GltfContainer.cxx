// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GltfContainer.h"

#include "FileNames.h"
#include "InputFile.h"

#include "vtkBase64Utilities.h"

#if __has_include("vtkURI.h")
#include "vtkURI.h"
#endif

#include <algorithm>
#include <fstream>
#include <memory>
#include <sstream>
#include <string_view>

namespace
{
using GltfContainer::RefuseDamaged;
using InputFile::Refuse;

std::vector<char> ReadBytes(std::istream& stream, std::size_t count)
{
  std::vector<char> bytes(count);
  stream.read(bytes.data(), static_cast<std::streamsize>(count));
  return bytes;
}

std::vector<char> ReadWhole(const std::string& file)
{
  std::ifstream stream(file, std::ios::binary);
  return ReadBytes(stream, std::filesystem::file_size(file));
}

/// "* PLACE\n  MESSAGE\n" and more of them becomes PLACE: MESSAGE.
std::string GetFirstMessage(const std::string& messages)
{
  std::istringstream lines(messages);
  std::string place;
  std::string message;
  std::getline(lines >> std::ws, place);
  std::getline(lines >> std::ws, message);
  return place.substr(std::min(place.find_first_not_of("* "), place.size())) + ": " + message;
}

/// As strict as the strictest parser that any VTK has.
Json::Value Parse(const std::string& file, const std::vector<char>& text)
{
  Json::CharReaderBuilder builder;
  Json::CharReaderBuilder::strictMode(&builder.settings_);
  const std::unique_ptr<Json::CharReader> reader(builder.newCharReader());
  Json::Value root;
  std::string why;
  try
  {
    if (reader->parse(text.data(), text.data() + text.size(), &root, &why))
    {
      return root;
    }
  }
  catch (const Json::Exception& error)
  {
    RefuseDamaged(file, std::string("its JSON can't be parsed: ") + error.what());
  }
  RefuseDamaged(file, "its JSON can't be parsed: " + GetFirstMessage(why));
}

GltfContainer::Parts ReadGLB(const std::string& file)
{
  constexpr std::uint32_t magic = 0x46546C67;     // "glTF"
  constexpr std::uint32_t jsonChunk = 0x4E4F534A; // "JSON"
  constexpr std::uint32_t binaryChunk = 0x004E4942;
  constexpr std::uint64_t headBytes = 12;
  constexpr std::uint64_t chunkHeadBytes = 8;

  std::ifstream stream(file, std::ios::binary);
  if (InputFile::ReadLittleEndian(stream) != magic)
  {
    Refuse(file, "it is no GLB file: it does not begin with 'glTF'");
  }
  const std::uint32_t version = InputFile::ReadLittleEndian(stream);
  if (version != 2)
  {
    Refuse(file,
      "it is of version " + std::to_string(version) +
        " of glTF; VTK reads version 2, so convert it");
  }
  const std::uint32_t promised = InputFile::ReadLittleEndian(stream);
  const std::uint64_t size = std::filesystem::file_size(file);
  if (size != promised)
  {
    InputFile::RefuseLength(file, "its header", promised, size);
  }

  GltfContainer::Parts parts;
  parts.IsBinary = true;
  for (std::uint64_t position = headBytes; position < size;)
  {
    const std::uint64_t length = InputFile::ReadLittleEndian(stream);
    const std::uint32_t type = InputFile::ReadLittleEndian(stream);
    const bool isFirst = position == headBytes;
    position += chunkHeadBytes + length;
    if (position > size)
    {
      RefuseDamaged(file, "a chunk of " + std::to_string(length) + " bytes goes beyond its end");
    }
    if (isFirst != (type == jsonChunk))
    {
      RefuseDamaged(file, "its JSON is not its first chunk and no other");
    }
    if (isFirst)
    {
      parts.Root = Parse(file, ReadBytes(stream, length));
    }
    else if (type == binaryChunk && parts.Binary.empty())
    {
      parts.Binary = ReadBytes(stream, length);
    }
    stream.seekg(static_cast<std::streamoff>(position));
  }
  return parts;
}

std::vector<char> Decode(const std::string& file, const std::string& place, std::string_view uri)
{
  constexpr std::size_t encoded = 4;
  constexpr std::size_t decoded = 3;
  const auto comma = uri.find(',');
  const std::string_view text = comma == std::string_view::npos ? "" : uri.substr(comma + 1);
  std::vector<char> bytes(text.size() / encoded * decoded);
  if (bytes.empty())
  {
    return bytes;
  }
  const std::size_t count =
    vtkBase64Utilities::DecodeSafely(reinterpret_cast<const unsigned char*>(text.data()),
      text.size(), reinterpret_cast<unsigned char*>(bytes.data()), bytes.size());
  if (text.size() % encoded != 0 || count + decoded <= bytes.size())
  {
    RefuseDamaged(file, place + ".uri is no base64 after its byte " + std::to_string(count));
  }
  bytes.resize(count);
  return bytes;
}

/// VTK before 9.3 takes the name as it stands.
std::string DecodePercents(const std::string& uri)
{
#if __has_include("vtkURI.h")
  return vtkURI::PercentDecode(uri);
#else
  return uri;
#endif
}
}

GltfContainer::Parts GltfContainer::Read(const std::string& file)
{
  if (FileNames::GetExtension(file) == ".glb")
  {
    return ReadGLB(file);
  }
  Parts parts;
  parts.Root = Parse(file, ReadWhole(file));
  return parts;
}

std::vector<char> GltfContainer::ReadUri(
  const std::string& file, const std::string& place, const std::string& uri, std::size_t promised)
{
  std::string name = place + ".uri";
  std::vector<char> bytes;
  if (uri.compare(0, 5, "data:") == 0)
  {
    bytes = Decode(file, place, uri);
  }
  else
  {
    const auto path =
      std::filesystem::absolute(file).parent_path() / std::filesystem::path(DecodePercents(uri));
    name = path.string();
    InputFile::CheckReadable(name);
    bytes = ReadWhole(name);
    if (bytes.size() > promised)
    {
      Refuse(file,
        place + " is to have " + std::to_string(promised) + " bytes, but " + name + " has " +
          std::to_string(bytes.size()) + "; VTK wants to have just as many, so correct byteLength");
    }
  }
  if (bytes.size() < promised)
  {
    RefuseDamaged(file,
      place + " is to have " + std::to_string(promised) + " bytes, but " + name + " has " +
        std::to_string(bytes.size()));
  }
  bytes.resize(promised);
  return bytes;
}

void GltfContainer::RefuseDamaged(const std::string& file, const std::string& why)
{
  Refuse(file, why + "; the file is damaged, so export it again");
}
