// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelMeshEdges.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkConnectedSets.h"
#include "vtkIdList.h"
#include "vtkPlaceHash.h"
#include "vtkPoints.h"
#include "vtkSMPTools.h"
#include "vtkStaticCleanPolyData.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <map>

namespace
{
struct Cone
{
  glm::dvec3 Sum{ 0.0 };
  int Ends = 0;
};

/// Calls visit(a, b) for the edges of polygons, or of the triangles of strips.
template <typename Ids, typename Visit>
void VisitEdges(const Ids* points, vtkIdType n, bool strip, Visit&& visit)
{
  if (!strip)
  {
    for (vtkIdType i = 0; i < n; ++i)
    {
      visit(points[i], points[i + 1 < n ? i + 1 : 0]);
    }
    return;
  }
  for (vtkIdType i = 2; i < n; ++i)
  {
    VisitEdges(points + i - 2, 3, false, visit);
  }
}

template <typename Visit>
void VisitEdges(vtkPolyData* mesh, Visit&& visit)
{
  vtkNew<vtkIdList> cell;
  for (vtkCellArray* cells : { mesh->GetPolys(), mesh->GetStrips() })
  {
    for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
    {
      cells->GetCellAtId(i, cell);
      VisitEdges(cell->GetPointer(0), cell->GetNumberOfIds(), cells == mesh->GetStrips(), visit);
    }
  }
}

std::uint64_t HashOfEdge(std::uint64_t a, std::uint64_t b)
{
  constexpr std::uint64_t salt = 0x9e3779b97f4a7c15u;
  return a == b ? 0 : vtkHashBits(std::max(a, b) + vtkHashBits(std::min(a, b) + salt));
}

/// Hash of the edges of triangles or other polygons by whole arrays; false when they have another
/// type.
template <typename IdArray, typename KeyOf>
bool HashEdges(vtkCellArray* polygons, const KeyOf& keyOf, std::atomic<std::uint64_t>& hash)
{
  auto* connectivity = IdArray::FastDownCast(polygons->GetConnectivityArray());
  auto* offsets = IdArray::FastDownCast(polygons->GetOffsetsArray());
  if (!connectivity || !offsets)
  {
    return false;
  }
  const auto* ids = connectivity->GetPointer(0);
  const auto* starts = offsets->GetPointer(0);
  vtkSMPTools::For(0, polygons->GetNumberOfCells(),
    [&](vtkIdType begin, vtkIdType end)
    {
      std::uint64_t sum = 0;
      for (vtkIdType cell = begin; cell < end; ++cell)
      {
        VisitEdges(ids + starts[cell], starts[cell + 1] - starts[cell], false,
          [&](vtkIdType a, vtkIdType b) { sum ^= HashOfEdge(keyOf(a), keyOf(b)); });
      }
      hash ^= sum;
    });
  return true;
}

template <typename KeyOf>
std::uint64_t HashEdges(vtkPolyData* mesh, const KeyOf& keyOf)
{
  std::atomic<std::uint64_t> hash{ 0 };
  vtkCellArray* polygons = mesh->GetPolys();
  const bool plain = mesh->GetNumberOfStrips() == 0 &&
    (HashEdges<vtkTypeInt64Array>(polygons, keyOf, hash) ||
      HashEdges<vtkTypeInt32Array>(polygons, keyOf, hash));
  if (!plain)
  {
    VisitEdges(mesh, [&](vtkIdType a, vtkIdType b) { hash ^= HashOfEdge(keyOf(a), keyOf(b)); });
  }
  return hash;
}

/// A key for each point, the same for points at the same place.
std::vector<std::uint64_t> HashPlaces(vtkPolyData* mesh)
{
  std::vector<std::uint64_t> keys(mesh->GetNumberOfPoints());
  vtkDataArray* points = mesh->GetPoints()->GetData();
  vtkSMPTools::For(0, mesh->GetNumberOfPoints(),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        std::array<double, 3> place;
        points->GetTuple(i, place.data());
        keys[i] = vtkHashPlace(place.data());
      }
    });
  return keys;
}
}

bool vtkVoxelMeshEdges::IsClosed(const std::vector<vtkSmartPointer<vtkPolyData>>& meshes)
{
  std::uint64_t byIds = 0;
  vtkIdType firstPoint = 0;
  for (const auto& mesh : meshes)
  {
    byIds ^=
      HashEdges(mesh, [&](vtkIdType id) { return static_cast<std::uint64_t>(firstPoint + id); });
    firstPoint += mesh->GetNumberOfPoints();
  }
  if (byIds == 0)
  {
    return true;
  }
  std::uint64_t byPlaces = 0;
  for (const auto& mesh : meshes)
  {
    const auto keys = HashPlaces(mesh);
    byPlaces ^= HashEdges(mesh, [&](vtkIdType id) { return keys[id]; });
  }
  return byPlaces == 0;
}

vtkVoxelMeshEdges::vtkVoxelMeshEdges(const std::vector<vtkSmartPointer<vtkPolyData>>& meshes)
{
  vtkNew<vtkAppendPolyData> all;
  for (const auto& mesh : meshes)
  {
    all->AddInputData(mesh);
  }
  vtkNew<vtkStaticCleanPolyData> merge;
  merge->SetTolerance(0.0);
  merge->ConvertPolysToLinesOff();
  merge->ConvertStripsToPolysOff();
  merge->SetInputConnection(all->GetOutputPort());
  merge->Update();
  this->Merged->ShallowCopy(merge->GetOutput());

  std::vector<Edge> edges;
  edges.reserve(this->Merged->GetPolys()->GetNumberOfConnectivityIds());
  VisitEdges(this->Merged,
    [&](vtkIdType a, vtkIdType b)
    {
      if (a != b)
      {
        edges.push_back({ std::min(a, b), std::max(a, b) });
      }
    });
  vtkSMPTools::Sort(edges.begin(), edges.end());
  for (auto edge = edges.cbegin(); edge != edges.cend();)
  {
    const auto next = std::upper_bound(edge, edges.cend(), *edge);
    const auto uses = next - edge;
    this->OpenEdges += uses == 1;
    this->NonManifoldEdges += uses > 2;
    if (uses % 2 == 1)
    {
      this->OddEdges.push_back(*edge);
    }
    edge = next;
  }
}

vtkSmartPointer<vtkPolyData> vtkVoxelMeshEdges::MakeCaps() const
{
  vtkConnectedSets connected(this->Merged->GetNumberOfPoints());
  for (const Edge& edge : this->OddEdges)
  {
    connected.Join(edge.Low, edge.High);
  }
  std::map<vtkIdType, Cone> cones;
  for (const Edge& edge : this->OddEdges)
  {
    Cone& cone = cones[connected.Find(edge.Low)];
    for (const vtkIdType end : { edge.Low, edge.High })
    {
      glm::dvec3 point;
      this->Merged->GetPoint(end, &point[0]);
      cone.Sum += point;
      ++cone.Ends;
    }
  }
  return this->MakeCones(
    [&](const Edge& edge)
    {
      const Cone& cone = cones[connected.Find(edge.Low)];
      return cone.Sum / double(cone.Ends);
    });
}

vtkSmartPointer<vtkPolyData> vtkVoxelMeshEdges::MakeCaps(const glm::dvec3& apex) const
{
  return this->MakeCones([&](const Edge&) { return apex; });
}

vtkSmartPointer<vtkPolyData> vtkVoxelMeshEdges::MakeCones(
  const std::function<glm::dvec3(const Edge& edge)>& apexOf) const
{
  vtkNew<vtkPoints> points;
  points->SetDataType(VTK_DOUBLE);
  vtkNew<vtkCellArray> triangles;
  for (const Edge& edge : this->OddEdges)
  {
    const glm::dvec3 apex = apexOf(edge);
    const vtkIdType triangle[3] = { points->InsertNextPoint(this->Merged->GetPoint(edge.Low)),
      points->InsertNextPoint(this->Merged->GetPoint(edge.High)),
      points->InsertNextPoint(&apex[0]) };
    triangles->InsertNextCell(3, triangle);
  }
  auto caps = vtkSmartPointer<vtkPolyData>::New();
  caps->SetPoints(points);
  caps->SetPolys(triangles);
  return caps;
}
