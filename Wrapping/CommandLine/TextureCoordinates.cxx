// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TextureCoordinates.h"

#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <array>
#include <vector>

namespace
{
using Coordinates = std::array<float, 2>;
constexpr Coordinates None = { -1.0f, -1.0f };

void DropUnusedTuples(vtkPolyData* mesh)
{
  vtkPointData* data = mesh->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    if (array->GetNumberOfTuples() > mesh->GetNumberOfPoints())
    {
      array->SetNumberOfTuples(mesh->GetNumberOfPoints());
    }
  }
}

std::vector<vtkFloatArray*> FindPerMaterial(vtkPointData* data)
{
  std::vector<vtkFloatArray*> found;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    auto* array = vtkFloatArray::SafeDownCast(data->GetArray(i));
    if (array && array->GetNumberOfComponents() == 2)
    {
      found.push_back(array);
    }
  }
  return found;
}

Coordinates FindCoordinates(const std::vector<vtkFloatArray*>& arrays, vtkIdType point)
{
  Coordinates coordinates = None;
  for (vtkFloatArray* array : arrays)
  {
    if (coordinates == None && point < array->GetNumberOfTuples())
    {
      array->GetTypedTuple(point, coordinates.data());
    }
  }
  return coordinates;
}
}

void TextureCoordinates::Join(vtkPolyData* mesh)
{
  DropUnusedTuples(mesh);
  const auto arrays = FindPerMaterial(mesh->GetPointData());
  if (arrays.size() < 2)
  {
    return;
  }
  vtkNew<vtkFloatArray> joined;
  joined->SetName("TCoords");
  joined->SetNumberOfComponents(2);
  joined->SetNumberOfTuples(mesh->GetNumberOfPoints());
  for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
  {
    joined->SetTypedTuple(point, FindCoordinates(arrays, point).data());
  }
  mesh->GetPointData()->SetTCoords(joined);
}

void TextureCoordinates::Flip(vtkPolyData* mesh)
{
  vtkDataArray* coordinates = mesh->GetPointData()->GetTCoords();
  if (!coordinates || coordinates->GetNumberOfComponents() != 2)
  {
    return;
  }
  for (vtkIdType point = 0; point < coordinates->GetNumberOfTuples(); ++point)
  {
    coordinates->SetComponent(point, 1, 1.0 - coordinates->GetComponent(point, 1));
  }
}
