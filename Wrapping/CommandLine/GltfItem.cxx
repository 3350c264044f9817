// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GltfItem.h"

#include "GltfContainer.h"
#include "InputFile.h"

#include <algorithm>
#include <utility>

GltfItem::GltfItem(const std::string& file, const Json::Value& root)
  : GltfItem(file, root, "")
{
}

GltfItem::GltfItem(const std::string& file, const Json::Value& value, std::string place)
  : File(&file)
  , Value(&value)
  , Place(std::move(place))
{
}

GltfItem GltfItem::operator[](const char* name) const
{
  if (this->Exists() && !this->Value->isObject())
  {
    this->RefuseDamaged("is no object");
  }
  return this->GetMember(name);
}

GltfItem GltfItem::GetMember(const std::string& name) const
{
  constexpr std::size_t longest = 40;
  const Json::Value* member = this->Value->find(name.data(), name.data() + name.size());
  const std::string place =
    (this->Place.empty() ? "" : this->Place + ".") + name.substr(0, longest);
  return { *this->File, member ? *member : Json::Value::nullSingleton(), place };
}

GltfItem GltfItem::operator[](std::int64_t index) const
{
  this->CheckList();
  return { *this->File, (*this->Value)[static_cast<Json::ArrayIndex>(index)],
    this->Place + "[" + std::to_string(index) + "]" };
}

std::int64_t GltfItem::GetSize() const
{
  this->CheckList();
  return this->Value->size();
}

void GltfItem::ForEach(const std::function<void(const GltfItem&)>& function) const
{
  if (this->Value->isObject())
  {
    for (const std::string& name : this->Value->getMemberNames())
    {
      function(this->GetMember(name));
    }
    return;
  }
  for (std::int64_t i = 0; i < this->GetSize(); ++i)
  {
    function((*this)[i]);
  }
}

std::int64_t GltfItem::GetNumber() const
{
  const bool isWhole =
    this->Value->type() == Json::intValue || this->Value->type() == Json::uintValue;
  if (!isWhole || !this->Value->isInt() || this->Value->asInt() < 0)
  {
    this->RefuseDamaged(this->Exists() ? "is no whole number from 0 to 2147483647" : "is missing");
  }
  return this->Value->asInt();
}

std::int64_t GltfItem::GetNumber(std::int64_t otherwise) const
{
  return this->Exists() ? this->GetNumber() : otherwise;
}

void GltfItem::CheckNumbers(std::int64_t size) const
{
  const bool hasSize = this->GetSize() == size;
  if (!hasSize ||
    !std::all_of(this->Value->begin(), this->Value->end(),
      [](const Json::Value& value) { return value.isNumeric(); }))
  {
    this->RefuseDamaged("is no list of " + std::to_string(size) + " numbers");
  }
}

std::string GltfItem::GetText() const
{
  if (!this->Value->isString())
  {
    this->RefuseDamaged(this->Exists() ? "is no text" : "is missing");
  }
  return this->Value->asString();
}

void GltfItem::Refuse(const std::string& why) const
{
  InputFile::Refuse(*this->File, this->Place + " " + why);
}

void GltfItem::RefuseDamaged(const std::string& why) const
{
  GltfContainer::RefuseDamaged(*this->File, this->Place + " " + why);
}

void GltfItem::CheckList() const
{
  if (this->Exists() && !this->Value->isArray())
  {
    this->RefuseDamaged("is no list");
  }
}
