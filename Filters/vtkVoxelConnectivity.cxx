// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelConnectivity.h"

#include "vtkObjectFactory.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapComponents.h"
#include "vtkSlicemapExpression.h"
#include "vtkSlicemapExpressionPass.h"
#include "vtkVoxelContext.h"
#include "vtkVoxelGrid.h"

#include <algorithm>
#include <optional>

namespace
{
using Neighbours = vtkSlicemapComponents::Neighbours;

/// Of the progress, for the read-back and the runs.
constexpr double ShareOfRuns = 0.2;

Neighbours NeighboursOfSet(int connectivity)
{
  switch (connectivity)
  {
    case 6:
      return Neighbours::Faces;
    case 18:
      return Neighbours::Edges;
    default:
      return Neighbours::Corners;
  }
}

Neighbours NeighboursOfUnset(int connectivityOfSet)
{
  return connectivityOfSet == 6 ? Neighbours::Corners : Neighbours::Faces;
}
}

vtkStandardNewMacro(vtkVoxelConnectivity);

void vtkVoxelConnectivity::SetConnectivity(int connectivity)
{
  if (connectivity != 6 && connectivity != 18 && connectivity != 26)
  {
    vtkErrorMacro("Connectivity must be 6, 18 or 26, not " << connectivity << ".");
    return;
  }
  if (this->Connectivity != connectivity)
  {
    this->Connectivity = connectivity;
    this->Modified();
  }
}

vtkIdType vtkVoxelConnectivity::GetNumberOfComponents()
{
  return this->GetSlicemap() ? this->NumberOfComponents : -1;
}

bool vtkVoxelConnectivity::Process(const std::vector<vtkSlicemap*>& inputs, vtkSlicemap* output)
{
  using Kind = vtkSlicemapComponents::Kind;
  const vtkVoxelGrid& grid = inputs[0]->GetGrid();
  const bool fills = this->Operation == OPERATION_FILL_HOLES;
  if (!this->ReportProgress(0.0))
  {
    return false;
  }

  std::optional<vtkSlicemapComponents> components;
  const bool isRead = inputs[0]->Read(
    [&](const std::uint32_t* words)
    {
      components.emplace(grid, words, fills ? Kind::Unset : Kind::Set,
        [&](std::int64_t bytes)
        {
          this->CheckBytes(bytes, "list of the runs of voxels along x",
            "Use fewer voxels, or an opening to remove noise first.");
        });
    });
  const auto progress = [&](double fraction)
  { return this->ReportProgress(ShareOfRuns + (1.0 - ShareOfRuns) * fraction); };
  if (!isRead ||
    !components->Join(
      fills ? NeighboursOfUnset(this->Connectivity) : NeighboursOfSet(this->Connectivity),
      progress))
  {
    return false;
  }

  const auto selection = fills ? components->SelectInner() : components->SelectLargest();
  this->NumberOfComponents =
    fills ? std::count(selection.begin(), selection.end(), 1) : components->GetCount();
  const bool isWritten = vtkSlicemap::Write(grid, { output },
    [&](std::int64_t firstRow, std::int64_t rows, const std::vector<std::uint32_t*>& words)
    {
      components->Write(selection, firstRow, rows, words[0]);
      return true;
    });
  if (!isWritten)
  {
    return false;
  }
  if (fills)
  {
    vtkSlicemapExpressionPass::Run(vtkSlicemapExpression::Join('|', 2),
      this->GetContext()->GetRecord(), { inputs[0], output }, output);
  }
  return true;
}

void vtkVoxelConnectivity::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent
     << "Operation: " << (this->Operation == OPERATION_FILL_HOLES ? "FillHoles" : "KeepLargest")
     << "\n";
  os << indent << "Connectivity: " << this->Connectivity << "\n";
  os << indent << "NumberOfComponents: " << this->NumberOfComponents << "\n";
}
