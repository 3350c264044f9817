// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GltfFileCheck.h"

#include "FileNames.h"
#include "InputFile.h"

#include "vtkGLTFDocumentLoader.h"
#include "vtkNew.h"

#include <charconv>
#include <cstdint>
#include <fstream>
#include <map>
#include <set>
#include <vector>

namespace
{
using Loader = vtkGLTFDocumentLoader;

struct Buffer
{
  std::int64_t Promised = 0;
  std::string Uri; // empty for the binary part of a .glb file
};

/**
 * Buffers from the JSON text that VTK keeps of them. It has the keys of an object in the order of
 * the alphabet, so that each buffer begins with its byteLength.
 */
std::vector<Buffer> ParseBuffers(const std::string& json)
{
  const auto valueAfter = [&](std::size_t key)
  { return json.find_first_not_of(" \t\r\n", json.find(':', key) + 1); };
  const std::string lengthKey = "\"byteLength\"";
  const std::string uriKey = "\"uri\"";
  std::vector<Buffer> buffers;
  for (auto begin = json.find(lengthKey); begin != std::string::npos;)
  {
    const auto end = json.find(lengthKey, begin + lengthKey.size());
    Buffer buffer;
    const char* const length = json.data() + valueAfter(begin);
    std::from_chars(length, json.data() + json.size(), buffer.Promised);
    const auto uri = json.find(uriKey, begin);
    if (uri < end)
    {
      const auto quote = valueAfter(uri) + 1;
      buffer.Uri = json.substr(quote, json.find('"', quote) - quote);
    }
    buffers.push_back(buffer);
    begin = end;
  }
  return buffers;
}

class GltfFile
{
public:
  GltfFile(const std::string& file, const Loader::Model& model)
    : File(file)
    , Model(model)
    , Buffers(ParseBuffers(model.BufferMetaData))
  {
  }

  void Check() const
  {
    for (std::size_t i = 0; i < this->Buffers.size(); ++i)
    {
      this->CheckBuffer(i);
    }
    for (const auto& view : this->Model.BufferViews)
    {
      this->CheckIndex("buffer", view.Buffer, this->Buffers.size());
      const std::int64_t end = std::int64_t(view.ByteOffset) + view.ByteLength;
      if (view.ByteOffset < 0 || view.ByteLength < 0 || end > this->Buffers[view.Buffer].Promised)
      {
        this->Refuse("a part of a buffer ends at byte " + std::to_string(end) + " of " +
          std::to_string(this->Buffers[view.Buffer].Promised));
      }
    }
    for (const auto& mesh : this->Model.Meshes)
    {
      for (const auto& primitive : mesh.Primitives)
      {
        this->CheckPrimitive(primitive);
      }
    }
    for (const auto& skin : this->Model.Skins)
    {
      this->CheckOptionalAccessor(skin.InverseBindMatricesAccessorId);
      for (const int joint : skin.Joints)
      {
        this->CheckIndex("node", joint, this->Model.Nodes.size());
      }
    }
    this->CheckNodes();
  }

private:
  [[noreturn]] void Refuse(const std::string& why) const { InputFile::Refuse(this->File, why); }

  void CheckIndex(const char* kind, std::int64_t index, std::size_t count) const
  {
    if (index < 0 || index >= static_cast<std::int64_t>(count))
    {
      this->Refuse(std::string("it refers to ") + kind + " " + std::to_string(index) + " of " +
        std::to_string(count));
    }
  }

  /// An index that is -1 where there is none.
  void CheckOptional(const char* kind, std::int64_t index, std::size_t count) const
  {
    if (index != -1)
    {
      this->CheckIndex(kind, index, count);
    }
  }

  void CheckBuffer(std::size_t index) const
  {
    const Buffer& buffer = this->Buffers[index];
    std::int64_t found = 0;
    if (buffer.Uri.empty())
    {
      found = index == 0 ? this->GetSizeOfBinaryPart() : 0;
    }
    else if (buffer.Uri.rfind("data:", 0) == 0)
    {
      const auto coded = static_cast<std::int64_t>(buffer.Uri.size() - buffer.Uri.find(',') - 1);
      found = coded / 4 * 3;
    }
    else
    {
      const auto path = std::filesystem::path(this->Model.FileName).parent_path() / buffer.Uri;
      InputFile::CheckReadable(path.string());
      found = static_cast<std::int64_t>(std::filesystem::file_size(path));
    }
    if (buffer.Promised < 0 || found < buffer.Promised)
    {
      this->Refuse("it is truncated: buffer " + std::to_string(index) + " is to have " +
        std::to_string(buffer.Promised) + " bytes, but there are " + std::to_string(found));
    }
  }

  /// Bytes of the second chunk of a .glb file, 0 where there is none.
  std::int64_t GetSizeOfBinaryPart() const
  {
    if (FileNames::GetExtension(this->Model.FileName) != ".glb")
    {
      return 0;
    }
    constexpr std::streamoff headBytes = 12;
    std::ifstream stream(this->Model.FileName, std::ios::binary);
    stream.seekg(headBytes);
    const auto text = InputFile::ReadLittleEndian(stream);
    stream.seekg(headBytes + 8 + std::streamoff(text));
    return InputFile::ReadLittleEndian(stream);
  }

  static std::int64_t GetSize(Loader::ComponentType type)
  {
    switch (type)
    {
      case Loader::ComponentType::BYTE:
      case Loader::ComponentType::UNSIGNED_BYTE:
        return 1;
      case Loader::ComponentType::SHORT:
      case Loader::ComponentType::UNSIGNED_SHORT:
        return 2;
      default:
        return 4;
    }
  }

  void CheckAccessor(int index) const
  {
    this->CheckIndex("accessor", index, this->Model.Accessors.size());
    const auto& accessor = this->Model.Accessors[index];
    if (accessor.BufferView == -1 && accessor.IsSparse)
    {
      return;
    }
    if (accessor.BufferView == -1)
    {
      this->Refuse("accessor " + std::to_string(index) +
        " has no data; a compressed mesh, which VTK can't read, has such ones");
    }
    this->CheckIndex("bufferView", accessor.BufferView, this->Model.BufferViews.size());
    const auto& view = this->Model.BufferViews[accessor.BufferView];
    const std::int64_t element =
      std::int64_t(accessor.NumberOfComponents) * GetSize(accessor.ComponentTypeValue);
    const std::int64_t stride = view.ByteStride > 0 ? view.ByteStride : element;
    const std::int64_t end = accessor.ByteOffset + stride * (accessor.Count - 1) + element;
    if (view.ByteStride < 0 || end > view.ByteLength)
    {
      this->Refuse("accessor " + std::to_string(index) + " takes " + std::to_string(end) +
        " bytes of " + std::to_string(view.ByteLength));
    }
  }

  void CheckOptionalAccessor(int index) const
  {
    if (index != -1)
    {
      this->CheckAccessor(index);
    }
  }

  void CheckPrimitive(const Loader::Primitive& primitive) const
  {
    if (primitive.AttributeIndices.count("POSITION") == 0)
    {
      this->Refuse("a mesh has no points");
    }
    for (const auto& [name, accessor] : primitive.AttributeIndices)
    {
      this->CheckAccessor(accessor);
    }
    for (const auto& target : primitive.Targets)
    {
      for (const auto& [name, accessor] : target.AttributeIndices)
      {
        this->CheckAccessor(accessor);
      }
    }
    this->CheckOptionalAccessor(primitive.IndicesId);
  }

  /// A node that has one parent at most, and roots that have none, leave no way round in circles.
  void CheckNodes() const
  {
    std::set<int> children;
    for (const auto& node : this->Model.Nodes)
    {
      this->CheckOptional("mesh", node.Mesh, this->Model.Meshes.size());
      this->CheckOptional("skin", node.Skin, this->Model.Skins.size());
      for (const int child : node.Children)
      {
        this->CheckIndex("node", child, this->Model.Nodes.size());
        if (!children.insert(child).second)
        {
          this->Refuse("node " + std::to_string(child) + " has two parents");
        }
      }
    }
    for (const auto& scene : this->Model.Scenes)
    {
      for (const auto root : scene.Nodes)
      {
        this->CheckIndex("node", root, this->Model.Nodes.size());
        if (children.count(static_cast<int>(root)) != 0)
        {
          this->Refuse("node " + std::to_string(root) + " is a child and the root of a scene");
        }
      }
    }
  }

  std::string File;
  const Loader::Model& Model;
  std::vector<Buffer> Buffers;
};

void CheckLengthOfGLB(const std::string& file)
{
  std::ifstream stream(file, std::ios::binary);
  constexpr std::uint32_t magic = 0x46546C67; // "glTF"
  if (InputFile::ReadLittleEndian(stream) != magic)
  {
    InputFile::Refuse(file, "it is no GLB file: it does not begin with 'glTF'");
  }
  InputFile::ReadLittleEndian(stream); // the version, which VTK looks at
  const std::uint32_t promised = InputFile::ReadLittleEndian(stream);
  const std::uint64_t size = std::filesystem::file_size(file);
  if (size < promised)
  {
    InputFile::RefuseLength(file, "its header", promised, size);
  }
}
}

void GltfFileCheck::Check(const std::string& file, const std::string& name)
{
  if (FileNames::GetExtension(file) == ".glb")
  {
    CheckLengthOfGLB(file);
  }
  vtkNew<vtkGLTFDocumentLoader> loader;
  if (loader->LoadModelMetaDataFromFile(name)) // else the reader tells why
  {
    GltfFile(file, *loader->GetInternalModel()).Check();
  }
}
