// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVDBGridFiller.h"

#include "vtkSMPTools.h"
#include "vtkSlicemap.h"
#include "vtkVoxelGrid.h"

#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <array>
#include <memory>

using openvdb::Coord;

namespace
{
constexpr int WordBits = 32;
constexpr int LeafSide = 8;
constexpr int BlockSide = 128;
constexpr int LeavesAlongBlock = BlockSide / LeafSide;
constexpr int RowsOfLeaf = LeafSide * LeafSide;
constexpr int LongBits = 64;
constexpr int LongsAlongBlock = BlockSide / LongBits;
constexpr int BytesPerLong = LongBits / LeafSide;
constexpr std::uint64_t Ones = ~std::uint64_t(0);

/// Levels of tiles as OpenVDB counts them.
constexpr openvdb::Index LeafTile = 1;
constexpr openvdb::Index BlockTile = 2;

/// The words of a slab, as rows along x that go on without end, empty outside.
class Rows
{
public:
  Rows(const std::uint32_t* words, const vtkVoxelGrid& slab)
    : Words(words)
    , First(slab.GetFirst())
    , Dimensions(slab.GetDimensions())
    , WordsPerRow(vtkSlicemap::GetWordsPerRow(slab))
  {
  }

  glm::ivec3 GetFirst() const { return this->First; }
  glm::ivec3 GetLast() const { return this->First + this->Dimensions - 1; }

  /// The 64 voxels of row (y, z) from x on, as indices of the grid.
  std::uint64_t GetBits(int x, int y, int z) const
  {
    const std::int64_t row =
      std::int64_t(z - this->First.z) * this->Dimensions.y + (y - this->First.y);
    const std::uint32_t* words = this->Words + row * this->WordsPerRow;
    const std::int64_t bit = std::int64_t(x) - this->First.x;
    const std::int64_t word = bit >= 0 ? bit / WordBits : -((WordBits - 1 - bit) / WordBits);
    const int shift = static_cast<int>(bit - word * WordBits);
    const std::uint64_t low =
      this->GetWord(words, word) | this->GetWord(words, word + 1) << WordBits;
    return shift == 0 ? low : low >> shift | this->GetWord(words, word + 2) << (LongBits - shift);
  }

private:
  std::uint64_t GetWord(const std::uint32_t* words, std::int64_t i) const
  {
    return i >= 0 && i < this->WordsPerRow ? words[i] : 0;
  }

  const std::uint32_t* Words;
  glm::ivec3 First;
  glm::ivec3 Dimensions;
  std::int64_t WordsPerRow;
};

/// 16 leaves side by side: 128 voxels of 8 x 8 rows.
struct Strip
{
  std::array<std::array<std::uint64_t, LongsAlongBlock>, RowsOfLeaf> Bits{}; // rows: z, then y
  std::array<std::uint64_t, LongsAlongBlock> Any{};
  std::array<std::uint64_t, LongsAlongBlock> All{ Ones, Ones };

  Strip(const Rows& rows, const Coord& origin)
  {
    const glm::ivec3 first = rows.GetFirst();
    const glm::ivec3 last = rows.GetLast();
    for (int row = 0; row < RowsOfLeaf; ++row)
    {
      const int y = origin.y() + row % LeafSide;
      const int z = origin.z() + row / LeafSide;
      if (y >= first.y && y <= last.y && z >= first.z && z <= last.z)
      {
        for (int i = 0; i < LongsAlongBlock; ++i)
        {
          this->Bits[row][i] = rows.GetBits(origin.x() + i * LongBits, y, z);
        }
      }
      for (int i = 0; i < LongsAlongBlock; ++i)
      {
        this->Any[i] |= this->Bits[row][i];
        this->All[i] &= this->Bits[row][i];
      }
    }
  }

  bool IsEmpty() const { return (this->Any[0] | this->Any[1]) == 0; }

  static std::uint64_t GetByte(const std::array<std::uint64_t, LongsAlongBlock>& row, int leaf)
  {
    return row[leaf / BytesPerLong] >> (leaf % BytesPerLong * LeafSide) & 0xff;
  }

  /// Makes bit z of byte x of bit x of byte z.
  static std::uint64_t Transposed(std::uint64_t m)
  {
    std::uint64_t t = (m ^ m >> 7) & 0x00aa00aa00aa00aaull;
    m ^= t ^ t << 7;
    t = (m ^ m >> 14) & 0x0000cccc0000ccccull;
    m ^= t ^ t << 14;
    t = (m ^ m >> 28) & 0x00000000f0f0f0f0ull;
    return m ^ t ^ t << 28;
  }

  /// In OpenVDB's order: a word for each x, in which z runs fastest, then y.
  template <typename Mask>
  Mask GetMask(int leaf) const
  {
    Mask mask;
    for (int y = 0; y < LeafSide; ++y)
    {
      std::uint64_t plane = 0;
      for (int z = 0; z < LeafSide; ++z)
      {
        plane |= GetByte(this->Bits[z * LeafSide + y], leaf) << (z * LeafSide);
      }
      plane = Transposed(plane);
      for (int x = 0; x < LeafSide; ++x)
      {
        mask.template getWord<openvdb::Index64>(x) |= (plane >> (x * LeafSide) & 0xff)
          << (y * LeafSide);
      }
    }
    return mask;
  }
};

/// The leaves of one block, which exists already or is made with its first voxel.
template <typename Block>
class BlockFiller
{
public:
  using Leaf = typename Block::LeafNodeType;
  using Mask = typename Leaf::NodeMaskType;

  BlockFiller(Block* block, const Coord& origin)
    : Origin(origin)
    , Target(block)
  {
  }

  void Add(const Rows& rows)
  {
    const glm::ivec3 first = rows.GetFirst();
    const glm::ivec3 last = rows.GetLast();
    for (int z = 0; z < BlockSide; z += LeafSide)
    {
      for (int y = 0; y < BlockSide; y += LeafSide)
      {
        const Coord origin = this->Origin.offsetBy(0, y, z);
        const bool isOutside = origin.y() > last.y || origin.z() > last.z ||
          origin.y() + LeafSide <= first.y || origin.z() + LeafSide <= first.z;
        if (!isOutside)
        {
          this->Add(Strip(rows, origin), origin);
        }
      }
    }
  }

  /// What was made here; the caller's from now on.
  Block* ReleaseNew() { return this->Made.release(); }

private:
  void Add(const Strip& strip, const Coord& origin)
  {
    if (strip.IsEmpty())
    {
      return;
    }
    if (!this->Target)
    {
      this->Made = std::make_unique<Block>(this->Origin, false);
      this->Target = this->Made.get();
    }
    for (int i = 0; i < LeavesAlongBlock; ++i)
    {
      const Coord xyz = origin.offsetBy(i * LeafSide, 0, 0);
      if (Strip::GetByte(strip.All, i) == 0xff)
      {
        this->Target->addTile(LeafTile, xyz, true, true);
      }
      else if (Strip::GetByte(strip.Any, i) != 0)
      {
        this->AddLeaf(strip.GetMask<Mask>(i), xyz);
      }
    }
  }

  void AddLeaf(Mask mask, const Coord& xyz)
  {
    Leaf* leaf = this->Target->probeLeaf(xyz);
    if (!leaf && this->Target->isValueOn(xyz))
    {
      return;
    }
    if (leaf)
    {
      mask |= leaf->getValueMask();
    }
    if (mask.isOn())
    {
      this->Target->addTile(LeafTile, xyz, true, true);
      return;
    }
    if (!leaf)
    {
      leaf = new Leaf(xyz, false);
      this->Target->addLeaf(leaf);
    }
    leaf->setValueMask(mask);
    typename Leaf::Buffer values(mask);
    leaf->swap(values);
  }

  Coord Origin;
  Block* Target;
  std::unique_ptr<Block> Made;
};

int FloorToBlock(int i)
{
  return i & ~(BlockSide - 1);
}

std::vector<Coord> GetBlocks(const glm::ivec3& first, const glm::ivec3& last)
{
  std::vector<Coord> blocks;
  for (std::int64_t z = FloorToBlock(first.z); z <= last.z; z += BlockSide)
  {
    for (std::int64_t y = FloorToBlock(first.y); y <= last.y; y += BlockSide)
    {
      for (std::int64_t x = FloorToBlock(first.x); x <= last.x; x += BlockSide)
      {
        blocks.emplace_back(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z));
      }
    }
  }
  return blocks;
}
}

template <typename Tree>
void vtkVDBGridFiller<Tree>::Add(const std::uint32_t* words, const vtkVoxelGrid& slab)
{
  const Rows rows(words, slab);
  const std::vector<Coord> origins = GetBlocks(rows.GetFirst(), rows.GetLast());
  // Looked up before the threads start, since that isn't safe while others add to the tree.
  std::vector<Block*> blocks(origins.size());
  std::vector<char> isFull(origins.size());
  for (std::size_t i = 0; i < origins.size(); ++i)
  {
    blocks[i] = this->Target.template probeNode<Block>(origins[i]);
    isFull[i] = !blocks[i] && this->Target.isValueOn(origins[i]);
  }
  std::vector<Block*> made(origins.size(), nullptr);
  vtkSMPTools::For(0, static_cast<vtkIdType>(origins.size()), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        if (!isFull[i])
        {
          BlockFiller<Block> filler(blocks[i], origins[i]);
          filler.Add(rows);
          made[i] = filler.ReleaseNew();
        }
      }
    });
  for (std::size_t i = 0; i < origins.size(); ++i)
  {
    if (made[i])
    {
      this->Insert(made[i]);
      blocks[i] = made[i];
    }
    if (blocks[i] && this->IsFull(*blocks[i]))
    {
      this->Target.addTile(BlockTile, origins[i], true, true);
    }
  }
}

template <typename Tree>
bool vtkVDBGridFiller<Tree>::AddLayers(const std::uint32_t* words, const vtkVoxelGrid& slices,
  const std::function<bool(double)>& progress)
{
  const std::int64_t sliceWords = vtkSlicemap::GetWordsPerRow(slices) * slices.GetDimensions().y;
  const std::int64_t first = slices.Extent[4];
  const std::int64_t last = slices.Extent[5];
  std::array<int, 6> layer = slices.Extent;
  for (std::int64_t z = first; z <= last; z = std::int64_t(layer[5]) + 1)
  {
    if (!progress(double(z - first) / double(last - first + 1)))
    {
      return false;
    }
    layer[4] = static_cast<int>(z);
    layer[5] = static_cast<int>(std::min(last, z | (BlockSide - 1)));
    this->Add(words + (z - first) * sliceWords, slices.WithExtent(layer));
  }
  return true;
}

template <typename Tree>
void vtkVDBGridFiller<Tree>::Finish()
{
  openvdb::tools::pruneTiles(this->Target);
}

template <typename Tree>
void vtkVDBGridFiller<Tree>::Insert(Block* block)
{
  const Coord& origin = block->origin();
  Upper* upper = this->Target.template probeNode<Upper>(origin);
  if (!upper)
  {
    upper = new Upper(origin, false);
    this->Target.root().addChild(upper);
  }
  upper->addChild(block);
}

template <typename Tree>
bool vtkVDBGridFiller<Tree>::IsFull(const Block& block) const
{
  return block.getChildMask().isOff() && block.getValueMask().isOn();
}

template class vtkVDBGridFiller<openvdb::BoolTree>;
template class vtkVDBGridFiller<openvdb::MaskTree>;
