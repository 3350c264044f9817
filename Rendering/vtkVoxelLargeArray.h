// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelLargeArray.h
 * Private header: arrays of which the first touch of fresh pages is most of the cost. Huge pages,
 * where the system has them, make it several times cheaper.
 */

#ifndef vtkVoxelLargeArray_h
#define vtkVoxelLargeArray_h

#include "vtkAbstractArray.h"
#include "vtkSmartPointer.h"

#include <cstdint>

/// What an array holds at first.
enum class vtkVoxelInitially
{
  Undefined,
  Zero ///< memory that nobody writes to is not touched
};

/// So many bytes, to be freed by free(); null when there is no memory.
void* vtkVoxelAllocate(std::int64_t bytes, vtkVoxelInitially content);

/// An array of a class with values of fixed size. Null when there is no memory for it.
template <typename Array>
vtkSmartPointer<Array> vtkVoxelNewLargeArray(const char* name, std::int64_t tuples,
  int components = 1, vtkVoxelInitially content = vtkVoxelInitially::Undefined)
{
  using Value = typename Array::ValueType;
  const std::int64_t values = tuples * components;
  auto* memory = static_cast<Value*>(
    vtkVoxelAllocate(values * static_cast<std::int64_t>(sizeof(Value)), content));
  if (!memory)
  {
    return nullptr;
  }
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetArray(memory, values, 0, vtkAbstractArray::VTK_DATA_ARRAY_FREE);
  return array;
}

#endif
// VTK-HeaderTest-Exclude: vtkVoxelLargeArray.h
