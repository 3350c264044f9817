// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVDBSlabs.h"

#include "vtkNewVoxelFile.h"
#include "vtkSlicemapImage.h"
#include "vtkVDBGridFiller.h"
#include "vtkVDBLattice.h"
#include "vtkVDBLevelSet.h"
#include "vtkVDBNewGrid.h"
#include "vtkVDBOutput.h"
#include "vtkVDBVoxelWriter.h"

#include <cmath>

namespace
{
using Writer = vtkVDBVoxelWriter;

constexpr int BlockSide = 128;
constexpr double ShareOfMaking = 0.5; // of finishing a level set

template <typename Grid>
class Slabs : public vtkVoxelSlabs
{
public:
  Slabs(vtkNewVoxelFile& file, const vtkVoxelGrid& whole)
    : File(file)
    , Whole(whole)
    , Voxels(vtkVDBNewGrid<Grid>())
    , Filler(this->Voxels->tree())
  {
  }

  int GetBestMultiple() const override { return BlockSide; }

  std::int64_t GetBytes() const override
  {
    return static_cast<std::int64_t>(this->Voxels->memUsage());
  }

  bool Add(const std::uint32_t* words, const vtkVoxelGrid& slab, const Progress& progress) override
  {
    return this->Filler.AddLayers(words, slab, progress);
  }

  bool Finish(const Progress& progress) override
  {
    this->Filler.Finish();
    return this->Write(this->Voxels, progress);
  }

protected:
  bool Write(const openvdb::GridBase::Ptr& grid, const Progress& progress)
  {
    grid->setName(vtkSlicemapImage::ArrayName);
    vtkVDBLattice::ApplyTo(this->Whole, *grid);
    return vtkVDBOutput::Write(this->File, { grid }, vtkVDBOutput::GetDefaultMetadata(),
      vtkVDBOutput::GetDefaultCompression(), progress);
  }

  vtkNewVoxelFile& File;
  vtkVoxelGrid Whole;
  typename Grid::Ptr Voxels;
  vtkVDBGridFiller<typename Grid::TreeType> Filler;
};

class LevelSetSlabs : public Slabs<openvdb::MaskGrid>
{
public:
  LevelSetSlabs(vtkNewVoxelFile& file, const vtkVoxelGrid& whole, double halfBandWidth)
    : Slabs<openvdb::MaskGrid>(file, whole)
    , HalfBandWidth(halfBandWidth)
  {
  }

  std::int64_t GetBytesToFinish() const override
  {
    return vtkVDBLevelSet::EstimateBytes(this->Voxels->constTree());
  }

  bool Finish(const Progress& progress) override
  {
    this->Filler.Finish();
    bool stopped = false;
    const auto grid = vtkVDBLevelSet::Make(this->Voxels->constTree(),
      std::abs(this->Whole.Spacing.x), this->HalfBandWidth,
      [&](double fraction)
      {
        stopped = !progress(ShareOfMaking * fraction);
        return !stopped;
      });
    return !stopped &&
      this->Write(grid,
        [&](double fraction)
        { return progress(ShareOfMaking + (1.0 - ShareOfMaking) * fraction); });
  }

private:
  double HalfBandWidth;
};
}

void vtkVDBSlabs::Check(const vtkVoxelGrid& whole, int occupancyGrid)
{
  vtkVDBLattice::Check(whole);
  if (occupancyGrid == Writer::GRID_LEVEL_SET)
  {
    vtkVDBLevelSet::Check(whole);
  }
}

std::unique_ptr<vtkVoxelSlabs> vtkVDBSlabs::Make(
  vtkNewVoxelFile& file, const vtkVoxelGrid& whole, int occupancyGrid, double halfBandWidth)
{
  openvdb::initialize();
  switch (occupancyGrid)
  {
    case Writer::GRID_LEVEL_SET:
      return std::make_unique<LevelSetSlabs>(file, whole, halfBandWidth);
    case Writer::GRID_MASK:
      return std::make_unique<Slabs<openvdb::MaskGrid>>(file, whole);
    default:
      return std::make_unique<Slabs<openvdb::BoolGrid>>(file, whole);
  }
}
