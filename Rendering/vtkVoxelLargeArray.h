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
#include "vtkVoxelSpareArrays.h"

#include <cstdint>

/// What an array holds at first.
enum class vtkVoxelInitially
{
  Undefined,
  Zero ///< memory that nobody writes to is not touched
};

/// So many bytes, to be freed by free(); null when there is no memory.
void* vtkVoxelAllocate(std::int64_t bytes, vtkVoxelInitially content);

/// Writes zeros, with all threads.
void vtkVoxelClear(void* memory, std::int64_t bytes);

/**
 * An array of a class with values of fixed size, in the memory of a spare one if there is one that
 * fits. Null when there is no memory for it.
 */
template <typename Array>
vtkSmartPointer<Array> vtkVoxelNewLargeArray(const char* name, std::int64_t tuples,
  int components = 1, vtkVoxelInitially content = vtkVoxelInitially::Undefined,
  vtkVoxelSpareArrays* spare = nullptr)
{
  using Value = typename Array::ValueType;
  const std::int64_t values = tuples * components;
  const auto bytes = values * static_cast<std::int64_t>(sizeof(Value));
  if (auto array = spare ? spare->Take<Array>(tuples, components) : nullptr)
  {
    array->SetName(name);
    if (content == vtkVoxelInitially::Zero)
    {
      vtkVoxelClear(array->GetPointer(0), bytes);
    }
    array->Modified();
    return array;
  }
  auto* memory = static_cast<Value*>(vtkVoxelAllocate(bytes, content));
  if (!memory)
  {
    return nullptr;
  }
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetArray(memory, values, 0, vtkAbstractArray::VTK_DATA_ARRAY_FREE);
  if (spare)
  {
    spare->Own(array);
  }
  return array;
}

#endif
// VTK-HeaderTest-Exclude: vtkVoxelLargeArray.h
