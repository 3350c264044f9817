// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSlicemapSolidVoxelizer.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapKernel.h"
#include "vtkSolidComputePass.h"
#include "vtkSolidRasterPass.h"
#include "vtkVoxelContext.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelMesh.h"
#include "vtkVoxelMeshEdges.h"

#include "vtkSolidVoteGLSL.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

vtkStandardNewMacro(vtkSlicemapSolidVoxelizer);

vtkSlicemapSolidVoxelizer::vtkSlicemapSolidVoxelizer() = default;
vtkSlicemapSolidVoxelizer::~vtkSlicemapSolidVoxelizer() = default;

namespace
{
/// The backend's pass, kept with the context since it holds buffers worth reusing.
vtkSolidPass& GetPass(const vtkVoxelGL::Context& context, int backend)
{
  const bool compute = backend == vtkVoxelizer::BACKEND_COMPUTE;
  auto& cached = context->GetCache()[compute ? "solid compute pass" : "solid raster pass"];
  if (!cached)
  {
    std::shared_ptr<vtkSolidPass> pass;
    if (compute)
    {
      pass = std::make_shared<vtkSolidComputePass>(context);
    }
    else
    {
      pass = std::make_shared<vtkSolidRasterPass>(context);
    }
    cached = pass;
  }
  return *static_cast<vtkSolidPass*>(cached.get());
}

}

bool vtkSlicemapSolidVoxelizer::FillByVote(
  vtkSolidPass& pass, const vtkVoxelMesh& mesh, vtkSlicemap* slicemap)
{
  const auto context = this->GetContext()->GetRecord();
  // The first three are the mesh along each axis, the last one its caps.
  std::array<vtkNew<vtkSlicemap>, 4> solids;
  std::array<vtkSmartPointer<vtkSlicemap>, 3> leaks;
  for (auto& solid : solids)
  {
    solid->SetContext(slicemap->GetContext());
    if (!solid->Allocate(slicemap->GetGrid()))
    {
      return false;
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto progress = [&](double done) { return this->ReportProgress((axis + done) / 4.0); };
    if (!pass.FillSolid(mesh, solids[axis], axis, vtkSolidPass::Rule::Parity, progress))
    {
      return false;
    }
    leaks[axis] = pass.GetColumnEnds();
    this->NumberOfLeakingColumns += leaks[axis]->GetNumberOfFilledVoxels();
  }
  const auto caps =
    vtkVoxelMeshEdges(vtkVoxelMesh::GetLeaves(this->GetInputDataObject(0, 0))).MakeCaps();
  if (caps->GetNumberOfPolys() > 0)
  {
    vtkVoxelMesh capMesh;
    capMesh.Update(context, caps, vtkVoxelMesh::Triangulation::Fans);
    pass.FillSolid(capMesh, solids[3], 0, vtkSolidPass::Rule::Parity,
      [&](double) { return this->ReportProgress(0.75); });
  }
  else
  {
    solids[3]->GetBuffer().Fill(0);
  }

  const vtkSlicemapKernel vote("vtkSolidVote", vtkSolidVoteGLSL);
  std::vector<vtkVoxelGL::Texture> textures;
  for (auto& solid : solids)
  {
    textures.push_back(vtkSlicemapTexture(solid));
  }
  for (const auto& leak : leaks)
  {
    textures.push_back(vtkSlicemapTexture(leak));
  }
  vote.Run(context, slicemap,
    [&](vtkVoxelGL::Program& program)
    {
      const char* const names[] = { "AlongX", "AlongY", "AlongZ", "Caps", "LeaksX", "LeaksY",
        "LeaksZ" };
      for (int unit = 0; unit < int(textures.size()); ++unit)
      {
        textures[unit].Bind(unit);
        program.Set(names[unit], unit);
      }
      const glm::ivec3 n = slicemap->GetGrid().GetDimensions();
      program.Set("Size", std::array<int, 3>{ n.x, n.y, n.z });
      program.Set("WordsOfY", static_cast<unsigned int>(leaks[0]->GetWordsPerRow()));
    });
  return true;
}

bool vtkSlicemapSolidVoxelizer::Voxelize(
  vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkSlicemap* slicemap)
{
  this->NumberOfLeakingColumns = 0;
  if (!slicemap->Allocate(grid))
  {
    return false;
  }
  const auto context = this->GetContext()->GetRecord();
  vtkSolidPass& pass = GetPass(context, this->GetUsedBackend());
  const bool touches = this->Mode != MODE_CENTER;
  const double shareOfSolid = touches ? 0.5 : 1.0;

  if (this->Mode == MODE_BOUNDARY)
  {
    slicemap->GetBuffer().Fill(0);
  }
  else if (this->FillRule == FILL_RULE_VOTE)
  {
    if (!this->FillByVote(pass, mesh, slicemap))
    {
      return false;
    }
  }
  else
  {
    const auto rule = this->FillRule == FILL_RULE_NON_ZERO ? vtkSolidPass::Rule::NonZero
                                                           : vtkSolidPass::Rule::Parity;
    const vtkVoxelGrid& whole = this->GetGridOfWhole();
    const int axis = pass.GetPossibleAxis(
      this->ColumnAxis == COLUMN_AXIS_AUTO ? pass.GetCheapestAxis(mesh, whole) : this->ColumnAxis,
      rule, whole);
    if (!pass.FillSolid(mesh, slicemap, axis, rule,
          [&](double done) { return this->ReportProgress(shareOfSolid * done); }))
    {
      return false;
    }
    if (this->GetCheckWatertight())
    {
      this->NumberOfLeakingColumns = pass.GetColumnEnds()->GetNumberOfFilledVoxels();
      this->WarnOfLeaks();
    }
  }

  if (!touches)
  {
    return true;
  }
  const auto operation = this->Mode == MODE_UNDER_CONSERVATIVE ? vtkSolidPass::TouchedVoxels::Clear
                                                               : vtkSolidPass::TouchedVoxels::Set;
  return pass.Touch(mesh, slicemap, operation,
    [&](double done) { return this->ReportProgress(shareOfSolid + (1.0 - shareOfSolid) * done); });
}

int vtkSlicemapSolidVoxelizer::GetNumberOfWorkSlicemaps()
{
  constexpr int ofVote = 5;
  return this->FillRule == FILL_RULE_VOTE && this->Mode != MODE_BOUNDARY ? ofVote : 1;
}

void vtkSlicemapSolidVoxelizer::WarnOfLeaks()
{
  // Once for all parts of an output.
  const vtkMTimeType time = std::max(this->GetMTime(), this->GetInputDataObject(0, 0)->GetMTime());
  if (this->NumberOfLeakingColumns == 0 || this->WarningTime == time)
  {
    return;
  }
  this->WarningTime = time;
  const vtkVoxelMeshEdges edges(vtkVoxelMesh::GetLeaves(this->GetInputDataObject(0, 0)));
  vtkWarningMacro("The mesh is not closed: it has "
    << edges.GetNumberOfOpenEdges() << " open and " << edges.GetNumberOfNonManifoldEdges()
    << " non-manifold edges, and " << this->NumberOfLeakingColumns
    << " columns of voxels leak through. Close the mesh, for "
    << "instance by vtkFillHolesFilter, or set the fill rule to Vote.");
}

void vtkSlicemapSolidVoxelizer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const modes[] = { "Center", "OverConservative", "UnderConservative", "Boundary" };
  const char* const rules[] = { "Parity", "NonZero", "Vote" };
  const char* const axes[] = { "Auto", "X", "Y", "Z" };
  os << indent << "Mode: " << modes[this->Mode] << "\n";
  os << indent << "FillRule: " << rules[this->FillRule] << "\n";
  os << indent << "ColumnAxis: " << axes[this->ColumnAxis - COLUMN_AXIS_AUTO] << "\n";
  os << indent << "NumberOfLeakingColumns: " << this->NumberOfLeakingColumns << "\n";
}
