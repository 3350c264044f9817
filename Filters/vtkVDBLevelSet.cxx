// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVDBLevelSet.h"

#include "vtkByteSwap.h"
#include "vtkSMPTools.h"
#include "vtkVDBNewGrid.h"
#include "vtkVoxelFileError.h"
#include "vtkVoxelGrid.h"

#include <openvdb/tools/Morphology.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
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
  float Distance; // of voxels that find it there, in world units
};

double GetRadius(double halfWidth)
{
  return halfWidth + 0.5;
}

int GetReach(double halfWidth)
{
  return static_cast<int>(GetRadius(halfWidth));
}

std::vector<Offset> MakeOffsets(double voxelSize, double halfWidth)
{
  const double radius = GetRadius(halfWidth);
  const int reach = GetReach(halfWidth);
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
          const auto distance = static_cast<float>((std::sqrt(squared) - 0.5) * voxelSize);
          offsets.push_back({ x, y, z, squared, distance });
        }
      }
    }
  }
  std::stable_sort(offsets.begin(), offsets.end(),
    [](const Offset& a, const Offset& b) { return a.Squared < b.Squared; });
  return offsets;
}

/// Plane x of a leaf: z runs fastest, then y, as in OpenVDB's leaves.
using Planes = std::array<std::uint64_t, LeafSide>;

/**
 * The bits of a leaf and of its 26 neighbours, once for each offset along z: then the rows of any
 * plane lie side by side as the bytes of one word.
 */
class Window
{
public:
  using Accessor = openvdb::tree::ValueAccessor<const openvdb::MaskTree>;

  Window(Accessor& solid, const Coord& origin, int reach)
  {
    std::array<std::array<std::uint32_t, WindowSide>, WindowSide> rows{};
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
            const std::uint64_t plane =
              leaf ? leaf->getValueMask().template getWord<openvdb::Index64>(i) : tile;
            for (int j = 0; j < LeafSide; ++j)
            {
              rows[x + i][y + j] |= std::uint32_t(plane >> (j * LeafSide) & 0xff) << z;
            }
          }
        }
      }
    }
    for (int dz = -reach; dz <= reach; ++dz)
    {
      for (int x = LeafSide - reach; x < 2 * LeafSide + reach; ++x)
      {
        auto& bytes = this->Bytes[LeafSide + dz][x];
        for (int y = 0; y < WindowSide; ++y)
        {
          bytes[y] = static_cast<unsigned char>(rows[x][y] >> (LeafSide + dz));
        }
      }
    }
  }

  /// Plane x of the leaf moved by an offset.
  std::uint64_t GetPlane(int x, int dy, int dz) const
  {
    std::uint64_t plane;
    std::memcpy(&plane, &this->Bytes[LeafSide + dz][LeafSide + x][LeafSide + dy], sizeof(plane));
    vtkByteSwap::Swap8LE(&plane);
    return plane;
  }

private:
  using Plane = std::array<std::array<unsigned char, WindowSide>, WindowSide>;

  std::array<Plane, 2 * LeafSide> Bytes; // by offset along z, x, y
};

class Band
{
public:
  Band(double voxelSize, double halfWidth)
    : Background(static_cast<float>(halfWidth * voxelSize))
    , Reach(GetReach(halfWidth))
    , Offsets(MakeOffsets(voxelSize, halfWidth))
  {
  }

  float GetBackground() const { return this->Background; }

  /// Null where no voxel is in the band.
  std::unique_ptr<Leaf> MakeLeaf(Window::Accessor& solid, const Coord& origin) const
  {
    const Window window(solid, origin, this->Reach);
    Planes inside;
    Planes open; // not yet in the band
    open.fill(Ones);
    for (int x = 0; x < LeafSide; ++x)
    {
      inside[x] = window.GetPlane(x, 0, 0);
    }
    std::unique_ptr<Leaf> leaf;
    for (const Offset& offset : this->Offsets)
    {
      std::uint64_t anyOpen = 0;
      for (int x = 0; x < LeafSide; ++x)
      {
        const std::uint64_t found =
          (window.GetPlane(x + offset.X, offset.Y, offset.Z) ^ inside[x]) & open[x];
        open[x] &= ~found;
        anyOpen |= open[x];
        if (found != 0)
        {
          if (!leaf)
          {
            leaf = this->MakeSigned(inside, origin);
          }
          Assign(*leaf, x, found, inside[x], offset.Distance);
        }
      }
      if (anyOpen == 0)
      {
        break;
      }
    }
    if (leaf)
    {
      Leaf::NodeMaskType mask;
      for (int x = 0; x < LeafSide; ++x)
      {
        mask.getWord<openvdb::Index64>(x) = ~open[x];
      }
      leaf->setValueMask(mask);
    }
    return leaf;
  }

private:
  static constexpr int PlaneSize = LeafSide * LeafSide;

  std::unique_ptr<Leaf> MakeSigned(const Planes& inside, const Coord& origin) const
  {
    auto leaf = std::make_unique<Leaf>(origin, this->Background);
    for (int x = 0; x < LeafSide; ++x)
    {
      Assign(*leaf, x, inside[x], inside[x], this->Background);
    }
    return leaf;
  }

  static void Assign(Leaf& leaf, int x, std::uint64_t voxels, std::uint64_t inside, float distance)
  {
    float* const values = leaf.buffer().data() + x * PlaneSize;
    for (; voxels != 0; voxels &= voxels - 1)
    {
      const auto bit = openvdb::util::FindLowestOn(voxels);
      values[bit] = inside >> bit & 1 ? -distance : distance;
    }
  }

  float Background;
  int Reach;
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

void vtkVDBLevelSet::Check(const vtkVoxelGrid& lattice)
{
  if (!lattice.HasCubicVoxels())
  {
    throw vtkVoxelFileError(vtkErrorCode::UserError,
      "A level set has cubic voxels, and this image has others: " + lattice.Describe() +
        ". Resample it, or write a bool or mask grid.");
  }
}

std::int64_t vtkVDBLevelSet::EstimateBytes(const openvdb::MaskTree& solid)
{
  constexpr std::int64_t bytesPerLeaf =
    sizeof(Leaf) + Leaf::NUM_VALUES * sizeof(float) + sizeof(Coord);
  return static_cast<std::int64_t>(FindCandidates(solid).size()) * bytesPerLeaf;
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
