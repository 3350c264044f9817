// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSolidPass.h"

#include "vtkSlicemap.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelMesh.h"

#include <algorithm>
#include <stdexcept>

void vtkSolidPass::StartColumnEnds(vtkSlicemap* target, const vtkColumnAxes& axes)
{
  if (!this->ColumnEnds || this->ColumnEnds->GetReferenceCount() > 1)
  {
    this->ColumnEnds = vtkSmartPointer<vtkSlicemap>::New();
  }
  this->ColumnEnds->SetContext(target->GetContext());
  const glm::ivec3 n = axes(target->GetGrid().GetDimensions());
  vtkVoxelGrid columns;
  columns.Extent = { 0, n.x - 1, 0, n.y - 1, 0, 0 };
  if (!this->ColumnEnds->Allocate(columns))
  {
    throw std::runtime_error("There is no room for the ends of the columns.");
  }
  this->ColumnEnds->GetBuffer().Fill(0);
}

int vtkSolidPass::GetCheapestAxis(const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid) const
{
  const glm::dvec3 areas = mesh.EstimateProjectedAreas(grid.GetWorldToIndex());
  std::array<double, 3> costs;
  for (int axis = 0; axis < 3; ++axis)
  {
    costs[axis] = this->EstimateCost(grid, axis, areas);
  }
  return static_cast<int>(std::min_element(costs.begin(), costs.end()) - costs.begin());
}
