// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GltfFileCheck.h"

#include "GltfContainer.h"
#include "GltfItem.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace
{
struct Reference
{
  const char* From; // names of members, and * for each member
  const char* To;
};

constexpr Reference References[] = {
  { "scene", "scenes" },
  { "scenes.*.nodes.*", "nodes" },
  { "nodes.*.children.*", "nodes" },
  { "nodes.*.mesh", "meshes" },
  { "nodes.*.skin", "skins" },
  { "meshes.*.primitives.*.attributes.*", "accessors" },
  { "meshes.*.primitives.*.targets.*.*", "accessors" },
  { "meshes.*.primitives.*.indices", "accessors" },
  { "skins.*.inverseBindMatrices", "accessors" },
  { "skins.*.joints.*", "nodes" },
  { "accessors.*.bufferView", "bufferViews" },
  { "accessors.*.sparse.indices.bufferView", "bufferViews" },
  { "accessors.*.sparse.values.bufferView", "bufferViews" },
  { "bufferViews.*.buffer", "buffers" },
};

struct Type
{
  std::string_view Name;
  int Components;
};

constexpr Type Types[] = { { "SCALAR", 1 }, { "VEC2", 2 }, { "VEC3", 3 }, { "VEC4", 4 },
  { "MAT2", 4 }, { "MAT3", 9 }, { "MAT4", 16 } };

struct ComponentType
{
  std::int64_t Code;
  int Bytes;
  bool IsUnsigned;
};

constexpr std::int64_t Float = 5126;
constexpr ComponentType ComponentTypes[] = { { 5120, 1, false }, { 5121, 1, true },
  { 5122, 2, false }, { 5123, 2, true }, { 5125, 4, true }, { Float, 4, false } };

/// What VTK takes for granted.
struct AttributeRule
{
  const char* Name;
  std::string_view TypeName;
  bool IsReal; // rather than an index
};

constexpr AttributeRule AttributeRules[] = { { "POSITION", "VEC3", true },
  { "NORMAL", "VEC3", true }, { "WEIGHTS_0", "VEC4", true }, { "JOINTS_0", "VEC4", false } };

/// Lists of a node, and how many numbers they have.
struct Pose
{
  const char* Name;
  std::int64_t Size;
};

constexpr Pose Poses[] = { { "matrix", 16 }, { "translation", 3 }, { "rotation", 4 },
  { "scale", 3 } };

/// Where numbers lie one after the other.
struct Bytes
{
  const char* First = nullptr;
  std::int64_t Stride = 0;
};

struct Accessor
{
  std::int64_t Count = 0;
  std::string_view TypeName;
  ComponentType Component{};
  bool IsNormalized = false;
  bool IsSparse = false;
  Bytes Data;

  /// VTK makes real numbers of these, and loses all others.
  bool IsReal() const { return this->IsNormalized || this->Component.Code == Float; }
};

class GltfFile
{
public:
  explicit GltfFile(const std::string& file)
    : File(file)
    , Parts(GltfContainer::Read(file))
    , Root(file, Parts.Root)
  {
  }

  void Check()
  {
    for (const Reference& reference : References)
    {
      this->CheckReference(this->Root, reference.From, this->Root[reference.To]);
    }
    this->ReadBuffers();
    this->Root["bufferViews"].ForEach([this](const GltfItem& view) { this->CheckView(view); });
    this->Root["accessors"].ForEach([this](const GltfItem& accessor)
      { this->Accessors.push_back(this->ReadAccessor(accessor)); });
    this->Root["meshes"].ForEach([this](const GltfItem& mesh) { this->CheckMesh(mesh); });
    this->CheckNodes();
  }

private:
  void CheckReference(const GltfItem& item, std::string_view path, const GltfItem& list) const
  {
    if (!item.Exists())
    {
      return;
    }
    if (path.empty())
    {
      const std::int64_t index = item.GetNumber();
      if (index >= list.GetSize())
      {
        item.RefuseDamaged("is " + std::to_string(index) + ", but there are " +
          std::to_string(list.GetSize()) + " " + list.GetPlace());
      }
      return;
    }
    const auto dot = std::min(path.find('.'), path.size());
    const std::string name(path.substr(0, dot));
    const std::string_view rest = path.substr(std::min(dot + 1, path.size()));
    if (name == "*")
    {
      item.ForEach([&](const GltfItem& member) { this->CheckReference(member, rest, list); });
    }
    else
    {
      this->CheckReference(item[name.c_str()], rest, list);
    }
  }

  void ReadBuffers()
  {
    const GltfItem buffers = this->Root["buffers"];
    if (this->Parts.IsBinary && buffers.GetSize() > 1)
    {
      buffers.Refuse("are several; VTK reads one from a .glb file, so export a .gltf file instead");
    }
    buffers.ForEach(
      [this](const GltfItem& buffer) { this->Buffers.push_back(this->Read(buffer)); });
  }

  std::vector<char> Read(const GltfItem& buffer)
  {
    const std::int64_t promised = buffer["byteLength"].GetNumber();
    if (!this->Parts.IsBinary)
    {
      return GltfContainer::ReadUri(
        this->File, buffer.GetPlace(), buffer["uri"].GetText(), promised);
    }
    if (buffer["uri"].Exists())
    {
      buffer.Refuse(
        "has a uri, which VTK does not read from a .glb file; export a .gltf file instead");
    }
    const auto found = static_cast<std::int64_t>(this->Parts.Binary.size());
    if (found < promised)
    {
      buffer.RefuseDamaged("is to have " + std::to_string(promised) + " bytes, but the file has " +
        std::to_string(found) + " for it");
    }
    return std::move(this->Parts.Binary);
  }

  void CheckView(const GltfItem& view) const
  {
    const auto size = static_cast<std::int64_t>(this->Buffers[view["buffer"].GetNumber()].size());
    const std::int64_t end = view["byteOffset"].GetNumber(0) + view["byteLength"].GetNumber();
    if (end > size)
    {
      view.RefuseDamaged(
        "ends at byte " + std::to_string(end) + " of a buffer of " + std::to_string(size));
    }
  }

  /// The place in a buffer of so many elements of so many bytes.
  Bytes Find(const GltfItem& user, std::int64_t count, std::int64_t elementBytes) const
  {
    const GltfItem view = this->Root["bufferViews"][user["bufferView"].GetNumber()];
    const std::int64_t offset = user["byteOffset"].GetNumber(0);
    std::int64_t stride = view["byteStride"].GetNumber(0);
    stride = stride == 0 ? elementBytes : stride;
    if (stride < elementBytes)
    {
      view.RefuseDamaged("has a byteStride of " + std::to_string(stride) + ", but " +
        user.GetPlace() + " has elements of " + std::to_string(elementBytes) + " bytes");
    }
    const std::int64_t end = offset + stride * (count - 1) + elementBytes;
    const std::int64_t length = view["byteLength"].GetNumber();
    if (end > length)
    {
      user.RefuseDamaged("ends at byte " + std::to_string(end) + " of " + view.GetPlace() +
        ", which has " + std::to_string(length));
    }
    const std::vector<char>& buffer = this->Buffers[view["buffer"].GetNumber()];
    return { buffer.data() + view["byteOffset"].GetNumber(0) + offset, stride };
  }

  static ComponentType ReadComponentType(const GltfItem& user)
  {
    const GltfItem item = user["componentType"];
    const std::int64_t code = item.GetNumber();
    const auto* const found = std::find_if(std::begin(ComponentTypes), std::end(ComponentTypes),
      [&](const ComponentType& type) { return type.Code == code; });
    if (found == std::end(ComponentTypes))
    {
      item.RefuseDamaged("is " + std::to_string(code) + ", which is none");
    }
    return *found;
  }

  static Type ReadType(const GltfItem& user)
  {
    const GltfItem item = user["type"];
    const std::string name = item.GetText();
    const auto* const found = std::find_if(
      std::begin(Types), std::end(Types), [&](const Type& type) { return type.Name == name; });
    if (found == std::end(Types))
    {
      item.RefuseDamaged("is none that is known");
    }
    return *found;
  }

  Accessor ReadAccessor(const GltfItem& item) const
  {
    if (!item["bufferView"].Exists())
    {
      item.Refuse("has no bufferView; VTK can't read compressed or purely sparse data, so export "
                  "the mesh without");
    }
    const Type type = ReadType(item);
    Accessor accessor;
    accessor.Count = item["count"].GetNumber();
    accessor.TypeName = type.Name;
    accessor.Component = ReadComponentType(item);
    accessor.IsNormalized = item["normalized"].IsTrue();
    accessor.IsSparse = item["sparse"].Exists();
    if (accessor.Count == 0)
    {
      item.RefuseDamaged("is empty");
    }
    const std::int64_t bytes = std::int64_t(type.Components) * accessor.Component.Bytes;
    accessor.Data = this->Find(item, accessor.Count, bytes);
    if (accessor.IsSparse)
    {
      this->CheckSparse(item["sparse"], accessor.Count, bytes);
    }
    return accessor;
  }

  void CheckSparse(const GltfItem& sparse, std::int64_t elements, std::int64_t elementBytes) const
  {
    const std::int64_t count = sparse["count"].GetNumber();
    const GltfItem indices = sparse["indices"];
    const ComponentType type = ReadComponentType(indices);
    const Bytes bytes = this->Find(indices, count, type.Bytes);
    this->Find(sparse["values"], count, elementBytes);
    CheckIndices(indices, bytes, type, count, elements);
  }

  /// All are less than the limit.
  static void CheckIndices(const GltfItem& item, const Bytes& bytes, const ComponentType& type,
    std::int64_t count, std::int64_t limit)
  {
    if (!type.IsUnsigned)
    {
      item.RefuseDamaged("has a componentType that is not for indices");
    }
    for (std::int64_t i = 0; i < count; ++i)
    {
      std::uint32_t index = 0;
      for (int byte = type.Bytes - 1; byte >= 0; --byte)
      {
        index = index << 8 | static_cast<unsigned char>(bytes.First[i * bytes.Stride + byte]);
      }
      if (index >= limit)
      {
        item.RefuseDamaged(
          "has an index " + std::to_string(index) + " into " + std::to_string(limit) + " elements");
      }
    }
  }

  const Accessor& GetAccessor(const GltfItem& index) const
  {
    return this->Accessors[index.GetNumber()];
  }

  void CheckMesh(const GltfItem& mesh) const
  {
    const GltfItem primitives = mesh["primitives"];
    if (primitives.GetSize() == 0)
    {
      mesh.RefuseDamaged("has no primitives");
    }
    primitives.ForEach([this](const GltfItem& primitive) { this->CheckPrimitive(primitive); });
  }

  void CheckPrimitive(const GltfItem& primitive) const
  {
    constexpr std::int64_t triangles = 4;
    constexpr std::int64_t modes = 7;
    if (primitive["mode"].GetNumber(triangles) >= modes)
    {
      primitive["mode"].RefuseDamaged("is no kind of primitive");
    }
    const GltfItem attributes = primitive["attributes"];
    const GltfItem position = attributes["POSITION"];
    if (!position.Exists())
    {
      primitive.Refuse("has no POSITION; VTK can't read such ones, so remove it");
    }
    const std::int64_t points = this->GetAccessor(position).Count;
    attributes.ForEach([&](const GltfItem& item) { this->CheckCount(item, points); });
    for (const AttributeRule& rule : AttributeRules)
    {
      this->CheckAttribute(attributes[rule.Name], rule);
    }
    primitive["targets"].ForEach([&](const GltfItem& target)
      { target.ForEach([&](const GltfItem& item) { this->CheckTarget(item, points); }); });
    this->CheckCorners(primitive, points);
  }

  void CheckCorners(const GltfItem& primitive, std::int64_t points) const
  {
    constexpr std::int64_t triangleFan = 6;
    const GltfItem item = primitive["indices"];
    std::int64_t corners = points;
    if (item.Exists())
    {
      const Accessor& indices = this->GetAccessor(item);
      corners = indices.Count;
      if (indices.TypeName != "SCALAR" || indices.IsSparse)
      {
        item.RefuseDamaged("leads to an accessor that is not for indices");
      }
      CheckIndices(item, indices.Data, indices.Component, corners, points);
    }
    if (primitive["mode"].GetNumber(0) == triangleFan && corners < 3)
    {
      primitive.RefuseDamaged("is a fan of " + std::to_string(corners) + " points");
    }
  }

  /// One element for each point.
  void CheckCount(const GltfItem& attribute, std::int64_t points) const
  {
    const std::int64_t count = this->GetAccessor(attribute).Count;
    if (count != points)
    {
      attribute.RefuseDamaged(
        "has " + std::to_string(count) + " elements for " + std::to_string(points) + " points");
    }
  }

  static void CheckType(const GltfItem& item, const Accessor& accessor, std::string_view type)
  {
    if (accessor.TypeName != type)
    {
      item.RefuseDamaged("leads to an accessor that is no " + std::string(type));
    }
  }

  static void CheckReal(const GltfItem& item, const Accessor& accessor)
  {
    if (!accessor.IsReal())
    {
      item.Refuse("holds integers; VTK reads real numbers, so export it without quantization");
    }
  }

  void CheckAttribute(const GltfItem& attribute, const AttributeRule& rule) const
  {
    if (!attribute.Exists())
    {
      return;
    }
    const Accessor& accessor = this->GetAccessor(attribute);
    CheckType(attribute, accessor, rule.TypeName);
    if (rule.IsReal)
    {
      CheckReal(attribute, accessor);
    }
    else if (!accessor.Component.IsUnsigned || accessor.IsNormalized)
    {
      attribute.RefuseDamaged("holds no indices");
    }
  }

  void CheckTarget(const GltfItem& attribute, std::int64_t points) const
  {
    this->CheckCount(attribute, points);
    const Accessor& accessor = this->GetAccessor(attribute);
    CheckType(attribute, accessor, "VEC3");
    CheckReal(attribute, accessor);
  }

  /// Trees whose roots the scenes name.
  void CheckNodes() const
  {
    const GltfItem nodes = this->Root["nodes"];
    nodes.ForEach([](const GltfItem& node) { CheckPose(node); });
    std::vector<bool> isChild(nodes.GetSize());
    nodes.ForEach([&](const GltfItem& node)
      { node["children"].ForEach([&](const GltfItem& child) { MarkChild(child, isChild); }); });
    std::vector<bool> isPlaced(nodes.GetSize());
    this->Root["scenes"].ForEach(
      [&](const GltfItem& scene)
      {
        scene["nodes"].ForEach(
          [&](const GltfItem& root)
          {
            if (isChild[root.GetNumber()])
            {
              root.RefuseDamaged("is a node that is another's child");
            }
            this->Place(root.GetNumber(), isPlaced, 0);
          });
      });
    nodes.ForEach([&](const GltfItem& node) { this->CheckSkin(node, isPlaced); });
  }

  static void CheckPose(const GltfItem& node)
  {
    for (const Pose& pose : Poses)
    {
      if (node[pose.Name].Exists())
      {
        node[pose.Name].CheckNumbers(pose.Size);
      }
    }
  }

  static void MarkChild(const GltfItem& child, std::vector<bool>& isChild)
  {
    if (isChild[child.GetNumber()])
    {
      child.RefuseDamaged("is a node that is another's child already");
    }
    isChild[child.GetNumber()] = true;
  }

  /// Marks a node and all below.
  void Place(std::int64_t index, std::vector<bool>& isPlaced, int depth) const
  {
    constexpr int deepest = 1000;
    const GltfItem node = this->Root["nodes"][index];
    if (depth > deepest)
    {
      node.Refuse(
        "lies below " + std::to_string(depth) + " others; VTK can't read that, so flatten it");
    }
    isPlaced[index] = true;
    node["children"].ForEach(
      [&](const GltfItem& child) { this->Place(child.GetNumber(), isPlaced, depth + 1); });
  }

  void CheckSkin(const GltfItem& node, const std::vector<bool>& isPlaced) const
  {
    if (!node["skin"].Exists())
    {
      return;
    }
    const GltfItem skin = this->Root["skins"][node["skin"].GetNumber()];
    if (!skin["inverseBindMatrices"].Exists())
    {
      skin.Refuse("has no inverseBindMatrices; VTK can't read that, so export the mesh without it");
    }
    skin["joints"].ForEach(
      [&](const GltfItem& joint)
      {
        if (!isPlaced[joint.GetNumber()])
        {
          joint.RefuseDamaged("is a node that is in no scene");
        }
      });
  }

  std::string File;
  GltfContainer::Parts Parts;
  GltfItem Root;
  std::vector<std::vector<char>> Buffers;
  std::vector<Accessor> Accessors;
};
}

void GltfFileCheck::Check(const std::string& file)
{
  GltfFile(file).Check();
}
