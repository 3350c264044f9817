// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelMeshEdges.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkPoints.h"
#include "vtkSMPTools.h"
#include "vtkStaticCleanPolyData.h"
#include "vtkTriangleFilter.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <map>
#include <numeric>

namespace
{
/// Sets of connected points, by the representative of each.
class ConnectedPoints
{
public:
  explicit ConnectedPoints(vtkIdType points)
    : Parents(points)
  {
    std::iota(this->Parents.begin(), this->Parents.end(), vtkIdType(0));
  }

  vtkIdType Find(vtkIdType point)
  {
    while (this->Parents[point] != point)
    {
      this->Parents[point] = this->Parents[this->Parents[point]];
      point = this->Parents[point];
    }
    return point;
  }

  void Join(vtkIdType a, vtkIdType b) { this->Parents[this->Find(a)] = this->Find(b); }

private:
  std::vector<vtkIdType> Parents;
};

struct Cone
{
  glm::dvec3 Sum{ 0.0 };
  int Ends = 0;
  vtkIdType Apex = -1;
};
}

vtkVoxelMeshEdges::vtkVoxelMeshEdges(const std::vector<vtkSmartPointer<vtkPolyData>>& meshes)
{
  vtkNew<vtkAppendPolyData> all;
  for (const auto& mesh : meshes)
  {
    all->AddInputData(mesh);
  }
  vtkNew<vtkTriangleFilter> triangles;
  triangles->PassVertsOff();
  triangles->PassLinesOff();
  triangles->SetInputConnection(all->GetOutputPort());
  vtkNew<vtkStaticCleanPolyData> merge;
  merge->SetTolerance(0.0);
  merge->SetInputConnection(triangles->GetOutputPort());
  merge->Update();
  this->Merged->ShallowCopy(merge->GetOutput());

  std::vector<Edge> edges;
  vtkNew<vtkIdList> cell;
  vtkCellArray* polygons = this->Merged->GetPolys();
  edges.reserve(polygons->GetNumberOfConnectivityIds());
  for (vtkIdType i = 0; i < polygons->GetNumberOfCells(); ++i)
  {
    polygons->GetCellAtId(i, cell);
    const vtkIdType n = cell->GetNumberOfIds();
    for (vtkIdType j = 0; j < n; ++j)
    {
      const auto [low, high] = std::minmax({ cell->GetId(j), cell->GetId((j + 1) % n) });
      edges.push_back({ low, high });
    }
  }
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
  ConnectedPoints connected(this->Merged->GetNumberOfPoints());
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
  vtkNew<vtkPoints> points;
  points->SetDataType(VTK_DOUBLE);
  vtkNew<vtkCellArray> triangles;
  for (const Edge& edge : this->OddEdges)
  {
    Cone& cone = cones[connected.Find(edge.Low)];
    if (cone.Apex < 0)
    {
      const glm::dvec3 apex = cone.Sum / double(cone.Ends);
      cone.Apex = points->InsertNextPoint(&apex[0]);
    }
    const vtkIdType triangle[3] = { points->InsertNextPoint(this->Merged->GetPoint(edge.Low)),
      points->InsertNextPoint(this->Merged->GetPoint(edge.High)), cone.Apex };
    triangles->InsertNextCell(3, triangle);
  }
  auto caps = vtkSmartPointer<vtkPolyData>::New();
  caps->SetPoints(points);
  caps->SetPolys(triangles);
  return caps;
}
