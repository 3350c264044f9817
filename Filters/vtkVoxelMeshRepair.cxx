// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelMeshRepair.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPlaceHash.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolygonMender.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkVoxelMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace
{
using Fate = vtkPolygonMender::Fate;

vtkSmartPointer<vtkPolyData> GetMesh(vtkDataObject* input)
{
  vtkNew<vtkAppendPolyData> append;
  const auto leaves = vtkVoxelMesh::GetLeaves(input);
  if (leaves.size() == 1)
  {
    return leaves.front();
  }
  for (const auto& leaf : leaves)
  {
    append->AddInputData(leaf);
  }
  if (!leaves.empty())
  {
    append->Update();
  }
  return append->GetOutput();
}

std::vector<std::array<double, 3>> GetPoints(vtkPolyData* mesh)
{
  std::vector<std::array<double, 3>> points(mesh->GetNumberOfPoints());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    mesh->GetPoint(static_cast<vtkIdType>(i), points[i].data());
  }
  return points;
}

/// A polygon of the mesh, or a triangle of a strip, and the cell that it is or is of.
struct Polygon
{
  std::vector<vtkIdType> Ids;
  vtkIdType Cell;
};

template <typename Visit>
void VisitPolygons(vtkPolyData* mesh, Visit&& visit)
{
  vtkIdType cell = mesh->GetNumberOfVerts() + mesh->GetNumberOfLines();
  vtkNew<vtkIdList> ids;
  Polygon polygon;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPolys(); ++i, ++cell)
  {
    mesh->GetPolys()->GetCellAtId(i, ids);
    polygon.Ids.assign(ids->GetPointer(0), ids->GetPointer(0) + ids->GetNumberOfIds());
    polygon.Cell = cell;
    visit(polygon);
  }
  for (vtkIdType i = 0; i < mesh->GetNumberOfStrips(); ++i, ++cell)
  {
    mesh->GetStrips()->GetCellAtId(i, ids);
    for (vtkIdType j = 2; j < ids->GetNumberOfIds(); ++j)
    {
      polygon.Ids = { ids->GetId(j - 2), ids->GetId(j - 1), ids->GetId(j) };
      if (j % 2 != 0)
      {
        std::swap(polygon.Ids[0], polygon.Ids[1]);
      }
      polygon.Cell = cell;
      visit(polygon);
    }
  }
}

bool HasArea(const std::vector<std::array<double, 3>>& points, const std::vector<vtkIdType>& ids)
{
  constexpr double smallest = 1e-12;
  const auto at = [&](std::size_t i)
  {
    const auto& p = points[ids[i % ids.size()]];
    return glm::dvec3(p[0], p[1], p[2]);
  };
  glm::dvec3 area(0.0);
  double longest = 0.0;
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    const glm::dvec3 edge = at(i + 1) - at(i);
    longest = std::max(longest, glm::dot(edge, edge));
    area += i == 0 ? glm::dvec3(0.0) : glm::cross(at(i) - at(0), at(i + 1) - at(0));
  }
  // Not so of NaN, which others report.
  return !(glm::length(area) <= smallest * longest);
}
}

vtkStandardNewMacro(vtkVoxelMeshRepair);

int vtkVoxelMeshRepair::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

vtkExecutive* vtkVoxelMeshRepair::CreateDefaultExecutive()
{
  // Composites come as a whole.
  return vtkStreamingDemandDrivenPipeline::New();
}

vtkIdType vtkVoxelMeshRepair::GetNumberOfDroppedPolygons() const
{
  return this->NumberOfDegenerates + this->NumberOfDuplicates + this->NumberOfOpposites +
    this->NumberOfWalls;
}

std::string vtkVoxelMeshRepair::GetSummary() const
{
  const vtkIdType dropped = this->GetNumberOfDroppedPolygons();
  const std::string all = std::to_string(this->NumberOfPolygons) + " polygons";
  if (dropped == 0)
  {
    return "nothing to mend in " + all;
  }
  std::string reasons;
  const auto add = [&](vtkIdType count, const char* what)
  {
    if (count > 0)
    {
      reasons += (reasons.empty() ? "" : ", ") + std::to_string(count) + " " + what;
    }
  };
  add(this->NumberOfOpposites, "with a twin of the opposite normal");
  add(this->NumberOfDuplicates, "with an equal twin");
  add(this->NumberOfWalls, "of walls within the solid");
  add(this->NumberOfDegenerates, "degenerate");
  return "left out " + std::to_string(dropped) + " of " + all + ": " + reasons;
}

int vtkVoxelMeshRepair::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->NumberOfPolygons = this->NumberOfDegenerates = this->NumberOfDuplicates =
    this->NumberOfOpposites = this->NumberOfWalls = 0;
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  const auto mesh = GetMesh(vtkDataObject::GetData(inputs[0]));
  const auto points = GetPoints(mesh);
  if (points.size() > std::numeric_limits<std::uint32_t>::max())
  {
    vtkErrorMacro("The mesh has " << points.size() << " points, which are too many to compare.");
    return 0;
  }
  const auto places = vtkFindPlaces(points);
  vtkPolygonMender mender;
  bool isValid = true;
  std::vector<vtkIdType> corners;
  VisitPolygons(mesh,
    [&](const Polygon& polygon)
    {
      corners.clear();
      for (const vtkIdType id : polygon.Ids)
      {
        isValid = isValid && id >= 0 && id < static_cast<vtkIdType>(places.size());
        corners.push_back(isValid ? places[id] : 0);
      }
      if (isValid)
      {
        mender.Add(
          corners.data(), static_cast<vtkIdType>(corners.size()), HasArea(points, polygon.Ids));
      }
    });
  if (!isValid)
  {
    output->Initialize();
    vtkErrorMacro("A polygon of the input refers to a point that does not exist. Check what made "
                  "the mesh.");
    return 0;
  }
  const auto fates = mender.Decide();
  this->NumberOfPolygons = static_cast<vtkIdType>(fates.size());
  const auto count = [&](Fate fate)
  { return static_cast<vtkIdType>(std::count(fates.begin(), fates.end(), fate)); };
  this->NumberOfDegenerates = count(Fate::Degenerate);
  this->NumberOfDuplicates = count(Fate::Duplicate);
  this->NumberOfOpposites = count(Fate::Opposite);
  this->NumberOfWalls = count(Fate::Wall);

  output->SetPoints(mesh->GetPoints());
  output->GetPointData()->PassData(mesh->GetPointData());
  output->GetFieldData()->PassData(mesh->GetFieldData());
  output->SetVerts(mesh->GetVerts());
  output->SetLines(mesh->GetLines());
  vtkNew<vtkCellArray> polygons;
  const vtkIdType others = mesh->GetNumberOfVerts() + mesh->GetNumberOfLines();
  vtkNew<vtkIdList> cells;
  for (vtkIdType cell = 0; cell < others; ++cell)
  {
    cells->InsertNextId(cell);
  }
  std::size_t next = 0;
  VisitPolygons(mesh,
    [&](const Polygon& polygon)
    {
      if (fates[next++] == Fate::Kept)
      {
        polygons->InsertNextCell(static_cast<vtkIdType>(polygon.Ids.size()), polygon.Ids.data());
        cells->InsertNextId(polygon.Cell);
      }
    });
  output->SetPolys(polygons);
  output->GetCellData()->CopyAllOn();
  output->GetCellData()->CopyAllocate(mesh->GetCellData(), cells->GetNumberOfIds());
  for (vtkIdType to = 0; to < cells->GetNumberOfIds(); ++to)
  {
    output->GetCellData()->CopyData(mesh->GetCellData(), cells->GetId(to), to);
  }
  return 1;
}

void vtkVoxelMeshRepair::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPolygons: " << this->NumberOfPolygons << "\n";
  os << indent << "NumberOfDegenerates: " << this->NumberOfDegenerates << "\n";
  os << indent << "NumberOfDuplicates: " << this->NumberOfDuplicates << "\n";
  os << indent << "NumberOfOpposites: " << this->NumberOfOpposites << "\n";
  os << indent << "NumberOfWalls: " << this->NumberOfWalls << "\n";
}
