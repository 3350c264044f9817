// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file GltfItem.h
 * A value in the JSON of a glTF file, which knows its place there and is of the type that is asked.
 */

#ifndef GltfItem_h
#define GltfItem_h

#include "vtk_jsoncpp.h"

#include <cstdint>
#include <functional>
#include <string>

/**
 * What is absent is an item too, without items inside; asking it for a number or a text without a
 * default is an error. Errors throw Failure with ExitCode::Input, and name the place.
 */
class GltfItem
{
public:
  /// The whole of a file. Both have to outlive the items.
  GltfItem(const std::string& file, const Json::Value& root);

  bool Exists() const { return !this->Value->isNull(); }
  const std::string& GetPlace() const { return this->Place; }

  /// A member of an object.
  GltfItem operator[](const char* name) const;

  /// A member of a list, which has to be there.
  GltfItem operator[](std::int64_t index) const;

  /// Members of a list.
  std::int64_t GetSize() const;

  /// Calls the function with each member of a list or an object.
  void ForEach(const std::function<void(const GltfItem&)>& function) const;

  /// A whole number from 0 to the greatest that VTK reads; counts and indices are such ones.
  std::int64_t GetNumber() const;
  std::int64_t GetNumber(std::int64_t otherwise) const;

  /// This is a list of so many numbers.
  void CheckNumbers(std::int64_t size) const;

  std::string GetText() const;

  /// A truth value that is false where it is absent.
  bool IsTrue() const { return this->Value->isBool() && this->Value->asBool(); }

  [[noreturn]] void Refuse(const std::string& why) const;
  [[noreturn]] void RefuseDamaged(const std::string& why) const;

private:
  GltfItem(const std::string& file, const Json::Value& value, std::string place);

  GltfItem GetMember(const std::string& name) const;
  void CheckList() const;

  const std::string* File;
  const Json::Value* Value;
  std::string Place;
};

#endif
