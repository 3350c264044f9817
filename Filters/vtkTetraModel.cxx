// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetraModel.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPlaceHash.h"
#include "vtkVoxelMeshEdges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace
{
glm::dvec3 GetPoint(vtkPolyData* mesh, vtkIdType id)
{
  glm::dvec3 point;
  mesh->GetPoint(id, &point[0]);
  return point;
}

/// Twice the area of a polygon, times its normal.
glm::dvec3 GetAreaVector(vtkPolyData* mesh, const vtkIdType* ids, vtkIdType n)
{
  glm::dvec3 sum(0.0);
  const glm::dvec3 first = GetPoint(mesh, ids[0]);
  for (vtkIdType i = 2; i < n; ++i)
  {
    sum += glm::cross(GetPoint(mesh, ids[i - 1]) - first, GetPoint(mesh, ids[i]) - first);
  }
  return sum;
}
}

double vtkTetraFrame::GetLongestSide() const
{
  return 2.0 * std::max({ this->HalfSize.x, this->HalfSize.y, this->HalfSize.z });
}

vtkTetraModel::vtkTetraModel(Leaves leaves)
  : Model(std::move(leaves))
  , All(this->Model)
{
  this->Closed = vtkVoxelMeshEdges::IsClosed(this->Model);
  if (!this->Closed)
  {
    this->Close();
  }
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (std::size_t i = 0; i < this->All.size(); ++i)
  {
    blocks->SetBlock(static_cast<unsigned int>(i), this->All[i]);
  }
  this->ClosedMesh = blocks;
}

const vtkTetraFrame& vtkTetraModel::GetFrame() const
{
  if (!this->Frame)
  {
    this->Frame = this->FindFrame();
  }
  return *this->Frame;
}

vtkTetraFrame vtkTetraModel::FindFrame() const
{
  vtkTetraFrame frame;
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(-low);
  glm::dvec3 sum(0.0);
  double count = 0.0;
  for (const auto& leaf : this->Model)
  {
    for (vtkIdType i = 0; i < leaf->GetNumberOfPoints(); ++i)
    {
      const glm::dvec3 point = GetPoint(leaf, i);
      low = glm::min(low, point);
      high = glm::max(high, point);
      sum += point;
      count += 1.0;
    }
  }
  if (count == 0.0)
  {
    return frame;
  }
  frame.Center = 0.5 * (low + high);
  frame.HalfSize = 0.5 * (high - low);
  frame.Origin = sum / count;
  double square = 0.0;
  for (const auto& leaf : this->Model)
  {
    for (vtkIdType i = 0; i < leaf->GetNumberOfPoints(); ++i)
    {
      const glm::dvec3 arm = GetPoint(leaf, i) - frame.Center;
      square = std::max(square, glm::dot(arm, arm));
    }
  }
  frame.Radius = std::sqrt(square);
  return frame;
}

void vtkTetraModel::Close()
{
  const vtkVoxelMeshEdges edges(this->Model);
  this->OpenEdges = edges.GetNumberOfOpenEdges();
  this->NonManifoldEdges = edges.GetNumberOfNonManifoldEdges();
  this->All.push_back(edges.MakeCaps(this->GetFrame().Origin));
}

std::vector<std::uint32_t> vtkTetraModel::FindPlaces() const
{
  std::vector<std::array<double, 3>> points;
  for (const auto& leaf : this->All)
  {
    for (vtkIdType i = 0; i < leaf->GetNumberOfPoints(); ++i)
    {
      std::array<double, 3> point;
      leaf->GetPoint(i, point.data());
      points.push_back(point);
    }
  }
  return vtkFindPlaces(points);
}

std::vector<glm::vec3> vtkTetraModel::ComputeNormals(const std::vector<std::uint32_t>& places) const
{
  std::vector<glm::dvec3> sums(places.size(), glm::dvec3(0.0));
  vtkIdType firstPoint = 0;
  vtkNew<vtkIdList> cell;
  for (const auto& leaf : this->Model)
  {
    const auto add = [&](const vtkIdType* ids, vtkIdType n, double sign)
    {
      const glm::dvec3 area = sign * GetAreaVector(leaf, ids, n);
      for (vtkIdType i = 0; i < n; ++i)
      {
        sums[places[firstPoint + ids[i]]] += area;
      }
    };
    for (vtkIdType i = 0; i < leaf->GetNumberOfPolys(); ++i)
    {
      leaf->GetPolys()->GetCellAtId(i, cell);
      if (cell->GetNumberOfIds() > 2)
      {
        add(cell->GetPointer(0), cell->GetNumberOfIds(), 1.0);
      }
    }
    for (vtkIdType i = 0; i < leaf->GetNumberOfStrips(); ++i)
    {
      leaf->GetStrips()->GetCellAtId(i, cell);
      for (vtkIdType j = 2; j < cell->GetNumberOfIds(); ++j)
      {
        add(cell->GetPointer(j - 2), 3, j % 2 == 0 ? 1.0 : -1.0);
      }
    }
    firstPoint += leaf->GetNumberOfPoints();
  }
  std::vector<glm::vec3> normals(places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const glm::dvec3& sum = sums[places[i]];
    const double length = std::sqrt(glm::dot(sum, sum));
    normals[i] = length > 0.0 ? glm::vec3(sum / length) : glm::vec3(0.0f);
  }
  return normals;
}
