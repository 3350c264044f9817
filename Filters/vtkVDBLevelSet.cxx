// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVDBLevelSet.h"

#include "vtkSMPTools.h"
#include "vtkVDBNewGrid.h"

#include <openvdb/tools/Morphology.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

using openvdb::Coord;

namespace
{
using Leaf = openvdb::FloatTree::LeafNodeType;

constexpr int LeafSide = 8;
constexpr int LeafShift = 3;
constexpr int WindowSide = 3 * LeafSide;
constexpr std::uint64_t Ones = ~std::uint64_t(0);
constexpr vtkIdType LeavesAtOnce = 1 << 15;

/// A solid's leaves as voxels of a coarser tree: those where a band may be.
std::vector<Coord> FindCandidates(const openvdb::MaskTree& solid)
{
  openvdb::MaskTree touched;
  openvdb::MaskTree full;
  for (auto leaf = solid.cbeginLeaf(); leaf; ++leaf)
  {
    touched.setValueOn(leaf->origin() >> LeafShift);
  }
  auto tile = solid.cbeginValueOn();
  tile.setMaxDepth(openvdb::MaskTree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile)
  {
    const openvdb::CoordBBox box = tile.getBoundingBox();
    const openvdb::CoordBBox leaves(box.min() >> LeafShift, box.max() >> LeafShift);
    touched.fill(leaves, true, true);
    full.fill(leaves, true, true);
  }
  touched.voxelizeActiveTiles();
  full.voxelizeActiveTiles();
  constexpr auto neighbours = openvdb::tools::NN_FACE_EDGE_VERTEX;
  openvdb::tools::dilateActiveValues(touched, 1, neighbours);
  openvdb::tools::erodeActiveValues(full, 1, neighbours);
  touched.topologyDifference(full);
  std::vector<Coord> candidates;
  for (auto voxel = touched.cbeginValueOn(); voxel; ++voxel)
  {
    candidates.push_back(voxel.getCoord() << LeafShift);
  }
  return candidates;
}

/// Where to look for the other kind, nearest first.
struct Offset
{
  int X, Y, Z;
  int Squared;
};

std::vector<Offset> MakeOffsets(double halfWidth)
{
  const double radius = halfWidth + 0.5;
  const int reach = static_cast<int>(radius);
  std::vector<Offset> offsets;
  for (int x = -reach; x <= reach; ++x)
  {
    for (int y = -reach; y <= reach; ++y)
    {
      for (int z = -reach; z <= reach; ++z)
      {
        const int squared = x * x + y * y + z * z;
        if (squared > 0 && squared < radius * radius)
        {
          offsets.push_back({ x, y, z, squared });
        }
      }
    }
  }
  std::stable_sort(offsets.begin(), offsets.end(),
    [](const Offset& a, const Offset& b) { return a.Squared < b.Squared; });
  return offsets;
}

/// The bits of a leaf and of its 26 neighbours.
class Window
{
public:
  using Accessor = openvdb::tree::ValueAccessor<const openvdb::MaskTree>;

  Window(Accessor& solid, const Coord& origin)
  {
    for (int x = 0; x < WindowSide; x += LeafSide)
    {
      for (int y = 0; y < WindowSide; y += LeafSide)
      {
        for (int z = 0; z < WindowSide; z += LeafSide)
        {
          const Coord xyz = origin.offsetBy(x - LeafSide, y - LeafSide, z - LeafSide);
          const auto* leaf = solid.probeConstLeaf(xyz);
          const std::uint64_t tile = !leaf && solid.isValueOn(xyz) ? Ones : 0;
          for (int i = 0; i < LeafSide; ++i)
          {
            this->Put(x + i, y, z,
              leaf ? leaf->getValueMask().template getWord<openvdb::Index64>(i) : tile);
          }
        }
      }
    }
  }

  /// Plane x of the leaf moved by an offset: z runs fastest, then y, as in OpenVDB's leaves.
  std::uint64_t GetPlane(int x, int dy, int dz) const
  {
    std::uint64_t plane = 0;
    for (int y = 0; y < LeafSide; ++y)
    {
      const std::uint32_t row = this->Rows[x + LeafSide][y + LeafSide + dy];
      plane |= std::uint64_t(row >> (LeafSide + dz) & 0xff) << (y * LeafSide);
    }
    return plane;
  }

private:
  void Put(int x, int y, int z, std::uint64_t plane)
  {
    for (int i = 0; i < LeafSide; ++i)
    {
      this->Rows[x][y + i] |= std::uint32_t(plane >> (i * LeafSide) & 0xff) << z;
    }
  }

  std::array<std::array<std::uint32_t, WindowSide>, WindowSide> Rows{};
};

class Band
{
public:
  Band(double voxelSize, double halfWidth)
    : VoxelSize(voxelSize)
    , Background(static_cast<float>(halfWidth * voxelSize))
    , Offsets(MakeOffsets(halfWidth))
  {
  }

  float GetBackground() const { return this->Background; }

  /// Null where no voxel is in the band.
  std::unique_ptr<Leaf> MakeLeaf(Window::Accessor& solid, const Coord& origin) const
  {
    const Window window(solid, origin);
    std::array<std::uint64_t, LeafSide> inside;
    std::array<std::uint64_t, LeafSide> open;
    open.fill(Ones);
    for (int x = 0; x < LeafSide; ++x)
    {
      inside[x] = window.GetPlane(x, 0, 0);
    }
    std::unique_ptr<Leaf> leaf;
    for (const Offset& offset : this->Offsets)
    {
      for (int x = 0; x < LeafSide; ++x)
      {
        const std::uint64_t found =
          (window.GetPlane(x + offset.X, offset.Y, offset.Z) ^ inside[x]) & open[x];
        if (found != 0)
        {
          if (!leaf)
          {
            leaf = this->MakeSigned(inside, origin);
          }
          open[x] &= ~found;
          this->Assign(*leaf, x, found, inside[x], offset.Squared);
        }
      }
    }
    return leaf;
  }

private:
  static openvdb::Index GetIndex(int x, int bit)
  {
    return static_cast<openvdb::Index>(x * LeafSide * LeafSide + bit);
  }

  std::unique_ptr<Leaf> MakeSigned(
    const std::array<std::uint64_t, LeafSide>& inside, const Coord& origin) const
  {
    auto leaf = std::make_unique<Leaf>(origin, this->Background);
    for (int x = 0; x < LeafSide; ++x)
    {
      for (int bit = 0; bit < LeafSide * LeafSide; ++bit)
      {
        if (inside[x] >> bit & 1)
        {
          leaf->setValueOnly(GetIndex(x, bit), -this->Background);
        }
      }
    }
    return leaf;
  }

  void Assign(Leaf& leaf, int x, std::uint64_t voxels, std::uint64_t inside, int squared) const
  {
    const float distance = static_cast<float>((std::sqrt(squared) - 0.5) * this->VoxelSize);
    for (int bit = 0; bit < LeafSide * LeafSide; ++bit)
    {
      if (voxels >> bit & 1)
      {
        leaf.setValueOn(GetIndex(x, bit), inside >> bit & 1 ? -distance : distance);
      }
    }
  }

  double VoxelSize;
  float Background;
  std::vector<Offset> Offsets;
};

/// What is solid and not in the band.
void AddInterior(const openvdb::MaskTree& solid, float value, openvdb::FloatTree& tree)
{
  auto tile = solid.cbeginValueOn();
  tile.setMaxDepth(openvdb::MaskTree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile)
  {
    tree.addTile(tile.getLevel(), tile.getCoord(), value, false);
  }
}
}

openvdb::FloatGrid::Ptr vtkVDBLevelSet::Make(const openvdb::MaskTree& solid, double voxelSize,
  double halfWidth, const std::function<bool(double)>& progress)
{
  const Band band(voxelSize, halfWidth);
  const auto grid = vtkVDBNewGrid<openvdb::FloatGrid>();
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  openvdb::FloatTree& tree = grid->tree();
  tree.root().setBackground(band.GetBackground(), false);
  AddInterior(solid, -band.GetBackground(), tree);
  const std::vector<Coord> candidates = FindCandidates(solid);
  const auto count = static_cast<vtkIdType>(candidates.size());
  for (vtkIdType first = 0; first < count; first += LeavesAtOnce)
  {
    if (!progress(double(first) / count))
    {
      return grid;
    }
    std::vector<std::unique_ptr<Leaf>> leaves(std::min(LeavesAtOnce, count - first));
    vtkSMPTools::For(0, static_cast<vtkIdType>(leaves.size()),
      [&](vtkIdType begin, vtkIdType end)
      {
        Window::Accessor accessor(solid);
        for (vtkIdType i = begin; i < end; ++i)
        {
          leaves[i] = band.MakeLeaf(accessor, candidates[first + i]);
        }
      });
    openvdb::tree::ValueAccessor<openvdb::FloatTree> accessor(tree);
    for (auto& leaf : leaves)
    {
      if (leaf)
      {
        accessor.addLeaf(leaf.release());
      }
    }
  }
  return grid;
}
