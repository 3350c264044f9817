// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDensityArrays.h"

#include "vtkFloatArray.h"
#include "vtkSMPTools.h"
#include "vtkSlicemapImage.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedShortArray.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelLargeArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace
{
constexpr int WordBits = 32;
constexpr int WordsPerQuad = 4;
constexpr int QuadBits = WordBits * WordsPerQuad;
constexpr int ByteBits = 8;

using Counts = std::array<std::uint16_t, ByteBits>;

/// Of the eight voxels from bit `first` of the words on; the planes are words a quad apart.
Counts GetCounts(const std::uint32_t* words, int planes, int first)
{
  static const auto values = vtkSlicemapImage::MakeValueTable(1);
  // The lower and the upper bytes of all eight, in memory order.
  std::array<std::uint64_t, 2> parts{ 0, 0 };
  for (int p = 0; p < planes; ++p)
  {
    parts[p / ByteBits] |= values[words[p * WordsPerQuad] >> first & 255] << p % ByteBits;
  }
  std::array<unsigned char, ByteBits> low;
  std::array<unsigned char, ByteBits> high;
  std::memcpy(low.data(), parts.data(), ByteBits);
  std::memcpy(high.data(), parts.data() + 1, ByteBits);
  Counts counts;
  for (int i = 0; i < ByteBits; ++i)
  {
    counts[i] = static_cast<std::uint16_t>(low[i] | high[i] << ByteBits);
  }
  return counts;
}

/// So many voxels, a word at most, of memory that is zero.
template <typename Value>
void ExpandWord(const std::uint32_t* words, int planes, int voxels, Value unit, Value* out)
{
  std::uint32_t any = 0;
  for (int p = 0; p < planes; ++p)
  {
    any |= words[p * WordsPerQuad];
  }
  if (any == 0)
  {
    return;
  }
  // The last plane is set where the count is the largest one.
  if (words[(planes - 1) * WordsPerQuad] == ~std::uint32_t(0))
  {
    std::fill_n(out, voxels, static_cast<Value>((1 << (planes - 1)) * unit));
    return;
  }
  for (int first = 0; first < voxels; first += ByteBits)
  {
    const Counts counts = GetCounts(words, planes, first);
    const int count = std::min(ByteBits, voxels - first);
    for (int i = 0; i < count; ++i)
    {
      out[first + i] = static_cast<Value>(counts[i] * unit);
    }
  }
}

/// A row of densities, and what lies before and behind each voxel on the other axes. On its own
/// axis the voxel before is `Back` back.
template <typename Value>
struct Surroundings
{
  const Value* Row;
  std::array<const Value*, 2> Before;
  std::array<const Value*, 2> Behind;
  int Size;
  int Back;

  /// Whether the gradient is zero for all x in [first, end).
  bool IsFlat(int first, int end) const
  {
    const int low = std::max(first, this->Back);
    const int high = std::min(end, this->Size - 1);
    const auto differ = [](const Value* a, const Value* b, int count)
    { return count > 0 && std::memcmp(a, b, count * sizeof(Value)) != 0; };
    return !differ(this->Row + low - this->Back, this->Row + low + 1, high - low) &&
      !differ(this->Before[0] + first, this->Behind[0] + first, end - first) &&
      !differ(this->Before[1] + first, this->Behind[1] + first, end - first) &&
      (low == first || this->GetStep(first) == 0) && (high == end || this->GetStep(end - 1) == 0);
  }

  glm::vec3 GetGradient(int x) const
  {
    return { static_cast<float>(this->GetStep(x)),
      static_cast<float>(this->Behind[0][x] - this->Before[0][x]),
      static_cast<float>(this->Behind[1][x] - this->Before[1][x]) };
  }

private:
  /// Along the row.
  auto GetStep(int x) const
  {
    return this->Row[std::min(x + 1, this->Size - 1)] - this->Row[std::max(x - this->Back, 0)];
  }
};

glm::mat3 GetOutwards(const vtkVoxelGrid& grid)
{
  const glm::dmat3 axes(grid.GetIndexToWorld());
  // Gradients are covariant; their length doesn't matter.
  const auto outwards = -glm::length(grid.Spacing) * glm::transpose(glm::inverse(axes));
  return static_cast<glm::mat3>(outwards);
}

template <typename Function>
void WithValues(vtkDataArray* density, const Function& function)
{
  switch (density->GetDataType())
  {
    case VTK_UNSIGNED_CHAR:
      function(static_cast<vtkUnsignedCharArray*>(density)->GetPointer(0));
      break;
    case VTK_UNSIGNED_SHORT:
      function(static_cast<vtkUnsignedShortArray*>(density)->GetPointer(0));
      break;
    default:
      function(static_cast<vtkFloatArray*>(density)->GetPointer(0));
  }
}

vtkSmartPointer<vtkDataArray> NewDensity(int type, std::int64_t voxels, vtkVoxelSpareArrays* spare)
{
  const char* name = vtkDensityArrays::DensityName;
  switch (type)
  {
    case VTK_UNSIGNED_CHAR:
      return vtkVoxelNewLargeArray<vtkUnsignedCharArray>(
        name, voxels, 1, vtkVoxelInitially::Zero, spare);
    case VTK_UNSIGNED_SHORT:
      return vtkVoxelNewLargeArray<vtkUnsignedShortArray>(
        name, voxels, 1, vtkVoxelInitially::Zero, spare);
    default:
      return vtkVoxelNewLargeArray<vtkFloatArray>(name, voxels, 1, vtkVoxelInitially::Zero, spare);
  }
}
}

vtkDensityArrays::vtkDensityArrays(
  const vtkVoxelGrid& grid, int planes, int type, Gradient gradient, vtkVoxelSpareArrays* spare)
  : Size(grid.GetDimensions())
  , Planes(planes)
  , Kind(gradient)
  , Outwards(GetOutwards(grid))
{
  const std::int64_t voxels = grid.GetNumberOfVoxels();
  this->Density = NewDensity(type, voxels, spare);
  if (gradient != Gradient::None)
  {
    this->Normals =
      vtkVoxelNewLargeArray<vtkFloatArray>("Normals", voxels, 3, vtkVoxelInitially::Zero, spare);
  }
  if (!this->Density || (gradient != Gradient::None && !this->Normals))
  {
    throw std::runtime_error("There is no memory for density and normals of " +
      std::to_string(voxels) + " voxels. Use fewer voxels, or Downsample.");
  }
}

vtkDensityArrays::~vtkDensityArrays() = default;

vtkDataArray* vtkDensityArrays::GetDensity() const
{
  return this->Density;
}

vtkFloatArray* vtkDensityArrays::GetNormals() const
{
  return this->Normals;
}

void vtkDensityArrays::Add(const vtkDensityPass::Slab& slab)
{
  WithValues(this->Density,
    [&](auto* density)
    {
      this->Expand(slab, density);
      if (this->Normals)
      {
        const int slices = slab.FirstSlice + slab.NumberOfSlices;
        // The last slice waits for the one behind it.
        const int end = slices == this->Size.z ? slices : slices - 1;
        this->MakeNormals(density, this->SlicesWithNormals, end);
        this->SlicesWithNormals = end;
      }
    });
}

template <typename Value>
void vtkDensityArrays::Expand(const vtkDensityPass::Slab& slab, Value* density) const
{
  const auto largest = static_cast<float>(1 << (this->Planes - 1));
  const auto unit =
    static_cast<Value>(std::is_floating_point<Value>::value ? 1.0f / largest : 1.0f);
  const std::int64_t firstRow = std::int64_t(slab.FirstSlice) * this->Size.y;
  const std::int64_t quadsPerRow = (this->Size.x + QuadBits - 1) / QuadBits;
  vtkSMPTools::For(0, vtkIdType(slab.NumberOfSlices) * this->Size.y,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType row = begin; row < end; ++row)
      {
        const std::uint32_t* words = slab.Words + row * quadsPerRow * this->Planes * WordsPerQuad;
        Value* out = density + (firstRow + row) * this->Size.x;
        for (int x = 0; x < this->Size.x; x += WordBits)
        {
          const int word = x / QuadBits * this->Planes * WordsPerQuad + x / WordBits % WordsPerQuad;
          ExpandWord(
            words + word, this->Planes, std::min(WordBits, this->Size.x - x), unit, out + x);
        }
      }
    });
}

template <typename Value>
void vtkDensityArrays::MakeNormals(const Value* density, int firstSlice, int endSlice) const
{
  const int back = this->Kind == Gradient::Symmetric ? 1 : 0;
  const std::int64_t rowsPerSlice = this->Size.y;
  const auto rowAt = [&](int y, int z)
  {
    const std::int64_t row =
      std::clamp(z, 0, this->Size.z - 1) * rowsPerSlice + std::clamp(y, 0, this->Size.y - 1);
    return density + row * this->Size.x;
  };
  float* normals = this->Normals->GetPointer(0);
  vtkSMPTools::For(firstSlice * rowsPerSlice, endSlice * rowsPerSlice,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType row = begin; row < end; ++row)
      {
        const int y = static_cast<int>(row % rowsPerSlice);
        const int z = static_cast<int>(row / rowsPerSlice);
        const Surroundings<Value> around{ rowAt(y, z), { rowAt(y - back, z), rowAt(y, z - back) },
          { rowAt(y + 1, z), rowAt(y, z + 1) }, this->Size.x, back };
        float* out = normals + std::int64_t(row) * this->Size.x * 3;
        for (int first = 0; first < this->Size.x; first += WordBits)
        {
          const int last = std::min(first + WordBits, this->Size.x);
          for (int x = around.IsFlat(first, last) ? last : first; x < last; ++x)
          {
            const glm::vec3 gradient = around.GetGradient(x);
            if (gradient != glm::vec3(0.0f))
            {
              const glm::vec3 normal = glm::normalize(this->Outwards * gradient);
              std::copy_n(&normal[0], 3, out + std::int64_t(x) * 3);
            }
          }
        }
      }
    });
}
