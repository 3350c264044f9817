// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVDBArrays.h"

#include "vtkDataArray.h"
#include "vtkSMPTools.h"
#include "vtkTypeTraits.h"
#include "vtkVDBNewGrid.h"
#include "vtkVoxelGrid.h"

#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <array>
#include <memory>
#include <type_traits>

namespace
{
using Grids = openvdb::TypeList<openvdb::BoolGrid, openvdb::MaskGrid, openvdb::FloatGrid,
  openvdb::DoubleGrid, openvdb::Int32Grid, openvdb::Int64Grid, openvdb::Vec3SGrid,
  openvdb::Vec3DGrid, openvdb::Vec3IGrid>;

/// What a voxel's value is made of, and how VTK stores it.
template <typename Value>
struct Traits
{
  using Element = Value;
  using Stored = Value;
  static constexpr int Components = 1;
};
template <>
struct Traits<bool>
{
  using Element = unsigned char;
  using Stored = unsigned char;
  static constexpr int Components = 1;
};
template <>
struct Traits<std::int64_t>
{
  using Element = vtkTypeInt64; // long long where the other is long
  using Stored = vtkTypeInt64;
  static constexpr int Components = 1;
};
template <typename Scalar>
struct Traits<openvdb::math::Vec3<Scalar>>
{
  using Element = Scalar;
  using Stored = openvdb::math::Vec3<Scalar>;
  static constexpr int Components = 3;
};

constexpr int LeafSide = 8;

int FloorToLeaf(int i)
{
  return i & ~(LeafSide - 1);
}

/// The 8 x 8 rows of voxels that leaves side by side share, within an extent.
struct Strip
{
  int FirstY, LastY, FirstZ, LastZ;
};

/// Calls the function with the number and the strips of each layer of leaves, from many threads
/// within a layer, until `progress` says no.
template <typename Function>
void ForEachStrip(
  const std::array<int, 6>& extent, const vtkVDBArrays::Progress& progress, Function&& function)
{
  const std::int64_t firstY = FloorToLeaf(extent[2]);
  const std::int64_t strips = (extent[3] - firstY) / LeafSide + 1;
  const std::int64_t firstZ = FloorToLeaf(extent[4]);
  for (std::int64_t z = firstZ; z <= extent[5]; z += LeafSide)
  {
    if (!progress(double(z - firstZ) / (double(extent[5]) - firstZ + 1.0)))
    {
      return;
    }
    function(strips,
      [=](std::int64_t i)
      {
        const std::int64_t y = firstY + i * LeafSide;
        return Strip{ static_cast<int>(std::max<std::int64_t>(y, extent[2])),
          static_cast<int>(std::min<std::int64_t>(y + LeafSide - 1, extent[3])),
          static_cast<int>(std::max<std::int64_t>(z, extent[4])),
          static_cast<int>(std::min<std::int64_t>(z + LeafSide - 1, extent[5])) };
      });
  }
}

/// Where the rows of an extent are in an array.
class Offsets
{
public:
  explicit Offsets(const std::array<int, 6>& extent)
    : Extent(extent)
    , Row(std::int64_t(extent[1]) - extent[0] + 1)
    , Slice(this->Row * (std::int64_t(extent[3]) - extent[2] + 1))
  {
  }

  std::int64_t GetRow(int y, int z) const
  {
    return (std::int64_t(z) - this->Extent[4]) * this->Slice +
      (std::int64_t(y) - this->Extent[2]) * this->Row;
  }
  std::int64_t GetLengthOfRow() const { return this->Row; }

private:
  std::array<int, 6> Extent;
  std::int64_t Row;
  std::int64_t Slice;
};

/// Values of an array one by one, without its type.
class Source
{
public:
  explicit Source(vtkDataArray* array)
    : Type(array->GetDataType())
    , Components(array->GetNumberOfComponents())
    , Contiguous(array)
  {
    // Other layouts become the usual one.
    if (!array->HasStandardMemoryLayout())
    {
      this->Contiguous.TakeReference(vtkDataArray::CreateDataArray(this->Type));
      this->Contiguous->DeepCopy(array);
    }
  }

  bool AreColors() const { return this->Type == VTK_UNSIGNED_CHAR && this->Components >= 3; }

  template <typename Value>
  void Read(std::int64_t first, std::int64_t count, Value* values) const
  {
    const void* data = this->Contiguous->GetVoidPointer(0);
    switch (this->Type)
    {
      vtkTemplateMacro(this->Read(static_cast<const VTK_TT*>(data), first, count, values));
    }
  }

private:
  template <typename Stored, typename Value>
  void Read(const Stored* data, std::int64_t first, std::int64_t count, Value* values) const
  {
    const bool areColors = this->AreColors();
    for (std::int64_t i = 0; i < count; ++i)
    {
      Convert(data + (first + i) * this->Components, areColors, values[i]);
    }
  }

  template <typename Stored, typename Value>
  static void Convert(const Stored* data, bool, Value& value)
  {
    value = static_cast<Value>(*data);
  }

  template <typename Stored, typename Scalar>
  static void Convert(const Stored* data, bool areColors, openvdb::math::Vec3<Scalar>& value)
  {
    constexpr Scalar brightest = 255;
    for (int i = 0; i < 3; ++i)
    {
      value[i] = static_cast<Scalar>(data[i]);
      if (areColors)
      {
        value[i] /= brightest;
      }
    }
  }

  int Type;
  int Components;
  vtkSmartPointer<vtkDataArray> Contiguous;
};

/// The leaves of a strip; those without an active voxel are left out.
template <typename Leaf, typename Value>
void MakeLeaves(const Source& source, const std::array<int, 6>& extent, const Strip& strip,
  const Value& background, std::vector<std::unique_ptr<Leaf>>& leaves)
{
  const Offsets offsets(extent);
  const int firstX = FloorToLeaf(extent[0]);
  leaves.resize((extent[1] - firstX) / LeafSide + 1);
  std::vector<Value> row(offsets.GetLengthOfRow());
  for (int z = strip.FirstZ; z <= strip.LastZ; ++z)
  {
    for (int y = strip.FirstY; y <= strip.LastY; ++y)
    {
      source.Read(offsets.GetRow(y, z), static_cast<std::int64_t>(row.size()), row.data());
      for (std::size_t i = 0; i < row.size(); ++i)
      {
        if (row[i] == background)
        {
          continue;
        }
        const openvdb::Coord voxel(extent[0] + static_cast<int>(i), y, z);
        auto& leaf = leaves[(voxel.x() - firstX) / LeafSide];
        if (!leaf)
        {
          leaf = std::make_unique<Leaf>(voxel, background);
        }
        leaf->setValueOn(voxel, row[i]);
      }
    }
  }
}

/// One row of leaf after leaf; between leaves there are tiles.
template <typename Tree, typename Stored>
void CopyStrip(
  const Tree& tree, const std::array<int, 6>& extent, const Strip& strip, Stored* values)
{
  const Offsets offsets(extent);
  openvdb::tree::ValueAccessor<const Tree> accessor(tree);
  for (std::int64_t x = FloorToLeaf(extent[0]); x <= extent[1]; x += LeafSide)
  {
    const int first = static_cast<int>(std::max<std::int64_t>(x, extent[0]));
    const int last = static_cast<int>(std::min<std::int64_t>(x + LeafSide - 1, extent[1]));
    const openvdb::Coord origin(first, strip.FirstY, strip.FirstZ);
    const auto* leaf = accessor.probeConstLeaf(origin);
    const auto tile = accessor.getValue(origin);
    for (int z = strip.FirstZ; z <= strip.LastZ; ++z)
    {
      for (int y = strip.FirstY; y <= strip.LastY; ++y)
      {
        Stored* out = values + offsets.GetRow(y, z) + (std::int64_t(first) - extent[0]);
        for (int i = first; i <= last; ++i)
        {
          *out++ = static_cast<Stored>(leaf ? leaf->getValue(openvdb::Coord(i, y, z)) : tile);
        }
      }
    }
  }
}

template <typename Grid>
openvdb::GridBase::Ptr MakeScalarGrid(double background)
{
  const auto grid = vtkVDBNewGrid<Grid>();
  grid->tree().root().setBackground(static_cast<typename Grid::ValueType>(background), false);
  return grid;
}

openvdb::GridBase::Ptr MakeScalarGrid(int type, double background)
{
  switch (type)
  {
    case VTK_FLOAT:
      return MakeScalarGrid<openvdb::FloatGrid>(background);
    case VTK_DOUBLE:
      return MakeScalarGrid<openvdb::DoubleGrid>(background);
    case VTK_CHAR:
    case VTK_SIGNED_CHAR:
    case VTK_UNSIGNED_CHAR:
    case VTK_SHORT:
    case VTK_UNSIGNED_SHORT:
    case VTK_INT:
      return MakeScalarGrid<openvdb::Int32Grid>(background);
    case VTK_UNSIGNED_INT:
    case VTK_LONG:
    case VTK_UNSIGNED_LONG:
    case VTK_LONG_LONG:
    case VTK_UNSIGNED_LONG_LONG:
    case VTK_ID_TYPE:
      return MakeScalarGrid<openvdb::Int64Grid>(background);
    default:
      return nullptr;
  }
}

openvdb::GridBase::Ptr MakeVectorGrid(int type)
{
  switch (type)
  {
    case VTK_FLOAT:
    case VTK_UNSIGNED_CHAR:
      return vtkVDBNewGrid<openvdb::Vec3SGrid>();
    case VTK_DOUBLE:
      return vtkVDBNewGrid<openvdb::Vec3DGrid>();
    case VTK_CHAR:
    case VTK_SIGNED_CHAR:
    case VTK_SHORT:
    case VTK_UNSIGNED_SHORT:
    case VTK_INT:
      return vtkVDBNewGrid<openvdb::Vec3IGrid>();
    default:
      return nullptr;
  }
}
}

openvdb::GridBase::Ptr vtkVDBArrays::MakeGrid(vtkDataArray* array, double background)
{
  const int type = array->GetDataType();
  const int components = array->GetNumberOfComponents();
  if (components == 1)
  {
    return MakeScalarGrid(type, background);
  }
  const bool haveAlpha = components == 4 && type == VTK_UNSIGNED_CHAR;
  return components == 3 || haveAlpha ? MakeVectorGrid(type) : nullptr;
}

void vtkVDBArrays::FillImage(vtkDataArray* array, const vtkVoxelGrid& lattice,
  openvdb::GridBase& grid, const Progress& progress)
{
  const Source source(array);
  grid.apply<Grids>(
    [&](auto& typed)
    {
      using Tree = typename std::decay_t<decltype(typed)>::TreeType;
      using Value = typename Tree::ValueType;
      using Leaf = typename Tree::LeafNodeType;
      if constexpr (!std::is_same_v<Value, bool>)
      {
        Tree& tree = typed.tree();
        const Value background = tree.background();
        ForEachStrip(lattice.Extent, progress,
          [&](std::int64_t count, const auto& getStrip)
          {
            std::vector<std::vector<std::unique_ptr<Leaf>>> strips(count);
            vtkSMPTools::For(0, count,
              [&](vtkIdType begin, vtkIdType end)
              {
                for (vtkIdType i = begin; i < end; ++i)
                {
                  MakeLeaves(source, lattice.Extent, getStrip(i), background, strips[i]);
                }
              });
            for (auto& leaves : strips)
            {
              for (auto& leaf : leaves)
              {
                if (leaf)
                {
                  tree.addLeaf(leaf.release());
                }
              }
            }
          });
        openvdb::tools::prune(tree);
      }
    });
}

void vtkVDBArrays::FillList(
  vtkDataArray* array, const std::vector<openvdb::Coord>& voxels, openvdb::GridBase& grid)
{
  const Source source(array);
  grid.apply<Grids>(
    [&](auto& typed)
    {
      using Value = typename std::decay_t<decltype(typed)>::ValueType;
      if constexpr (!std::is_same_v<Value, bool>)
      {
        std::vector<Value> values(voxels.size());
        source.Read(0, static_cast<std::int64_t>(voxels.size()), values.data());
        openvdb::tree::ValueAccessor<typename std::decay_t<decltype(typed)>::TreeType> accessor(
          typed.tree());
        for (std::size_t i = voxels.size(); i-- > 0;)
        {
          accessor.setValueOn(voxels[i], values[i]);
        }
      }
    });
}

bool vtkVDBArrays::IsSupported(const openvdb::GridBase& grid)
{
  return grid.apply<Grids>([](const auto&) {});
}

int vtkVDBArrays::GetScalarType(const openvdb::GridBase& grid)
{
  int type = VTK_VOID;
  grid.apply<Grids>(
    [&](const auto& typed)
    {
      using Value = typename std::decay_t<decltype(typed)>::ValueType;
      type = vtkTypeTraits<typename Traits<Value>::Element>::VTKTypeID();
    });
  return type;
}

int vtkVDBArrays::GetNumberOfComponents(const openvdb::GridBase& grid)
{
  int components = 0;
  grid.apply<Grids>([&](const auto& typed)
    { components = Traits<typename std::decay_t<decltype(typed)>::ValueType>::Components; });
  return components;
}

void vtkVDBArrays::ToImage(const openvdb::GridBase& grid, const vtkVoxelGrid& lattice,
  vtkDataArray* array, const Progress& progress)
{
  grid.apply<Grids>(
    [&](const auto& typed)
    {
      using Value = typename std::decay_t<decltype(typed)>::ValueType;
      auto* const values = static_cast<typename Traits<Value>::Stored*>(array->GetVoidPointer(0));
      ForEachStrip(lattice.Extent, progress,
        [&](std::int64_t count, const auto& getStrip)
        {
          vtkSMPTools::For(0, count,
            [&](vtkIdType begin, vtkIdType end)
            {
              for (vtkIdType i = begin; i < end; ++i)
              {
                CopyStrip(typed.constTree(), lattice.Extent, getStrip(i), values);
              }
            });
        });
    });
}
