// Proves that the voxels between depth buffers, and those of them on the surface, are what the
// depths of each single column say, bit for bit: on grids of all kinds of sizes, whole and in
// parts, along one to three axes, where columns agree over large areas and where no two of them do.

#include "VoxelComparison.h"
#include "VoxelSolidTests.h"
#include "VoxelTestObservers.h"

#include <vtkDepthBufferVoxelizer.h>
#include <vtkImageData.h>
#include <vtkNew.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <random>
#include <string>
#include <vector>

using namespace VoxelReference;

namespace
{
constexpr unsigned int Seed = 20251;

struct Range
{
  int First;
  int End;

  bool Has(int voxel) const { return voxel >= this->First && voxel < this->End; }
};

/// The ranges of all columns along an axis, counted from the first voxel of the grid.
struct Columns
{
  int Axis;
  int U;
  int V;
  std::array<int, 3> Size;
  std::vector<Range> Ranges;

  Columns(int axis, const std::array<int, 3>& size)
    : Axis(axis)
    , U(axis == 0 ? 1 : 0)
    , V(axis == 2 ? 1 : 2)
    , Size(size)
    , Ranges(std::size_t(size[this->U]) * size[this->V])
  {
  }

  Range& At(int u, int v) { return this->Ranges[std::size_t(v) * this->Size[this->U] + u]; }
  Range At(int u, int v) const
  {
    const bool exists = u >= 0 && v >= 0 && u < this->Size[this->U] && v < this->Size[this->V];
    return exists ? this->Ranges[std::size_t(v) * this->Size[this->U] + u]
                  : Range{ this->Size[this->Axis], 0 };
  }

  /// What is between the two shells, which leave nothing open to neighbours.
  Columns GetInner(int neighbours) const
  {
    Columns inner(this->Axis, this->Size);
    for (int v = 0; v < this->Size[this->V]; ++v)
    {
      for (int u = 0; u < this->Size[this->U]; ++u)
      {
        inner.At(u, v) = this->GetInnerAt(u, v, neighbours);
      }
    }
    return inner;
  }

  Range GetInnerAt(int u, int v, int neighbours) const
  {
    Range inner = this->At(u, v);
    inner = { inner.First + 1, inner.End - 1 };
    for (int dv = -1; dv <= 1; ++dv)
    {
      for (int du = -1; du <= 1; ++du)
      {
        if (neighbours == 8 || du == 0 || dv == 0)
        {
          const Range other = this->At(u + du, v + dv);
          inner = { std::max(inner.First, other.First), std::min(inner.End, other.End) };
        }
      }
    }
    return inner;
  }
};

enum class Kind
{
  Plates, ///< of many equal columns, some of them empty
  Slopes, ///< whose neighbours differ by one or none
  Noise,  ///< of columns that know nothing of each other
};

Columns MakeColumns(Kind kind, int axis, const std::array<int, 3>& size, std::mt19937& random)
{
  Columns columns(axis, size);
  const int length = size[axis];
  const auto draw = [&](int low, int high)
  { return low + static_cast<int>(random() % static_cast<unsigned int>(high - low + 1)); };
  const Range any{ draw(0, length / 3), draw(length - length / 3, length) };
  const int side = draw(17, 70);
  std::vector<Range> plates;
  std::generate_n(std::back_inserter(plates), 64,
    [&]
    {
      return draw(0, 5) == 0 ? Range{ length, 0 }
                             : Range{ draw(0, length / 2), draw(length / 2, length) };
    });
  for (int v = 0; v < size[columns.V]; ++v)
  {
    for (int u = 0; u < size[columns.U]; ++u)
    {
      Range& range = columns.At(u, v);
      switch (kind)
      {
        case Kind::Plates:
          range = plates[(u / side * 5 + v / side * 3) % plates.size()];
          break;
        case Kind::Slopes:
          range = { std::min(length, any.First + (u + v) / 3), std::max(0, any.End - u / 2) };
          break;
        case Kind::Noise:
          range = { draw(0, length), draw(0, length) };
          break;
      }
    }
  }
  return columns;
}

/// Depths that have the voxel centres of the ranges well between them.
vtkSmartPointer<vtkImageData> MakeBuffer(const Columns& columns, bool isNear)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(columns.Size[columns.U], columns.Size[columns.V], 1);
  image->AllocateScalars(VTK_FLOAT, 1);
  auto* depths = static_cast<float*>(image->GetScalarPointer());
  std::transform(columns.Ranges.begin(), columns.Ranges.end(), depths,
    [&](const Range& range) { return float(isNear ? range.First : range.End) - 0.5F; });
  return image;
}

/// Whether a voxel, counted from the first of the grid, is in the ranges of all of its columns.
bool HaveAll(const std::vector<Columns>& all, const Voxel& voxel)
{
  return std::all_of(all.begin(), all.end(),
    [&](const Columns& columns)
    { return columns.At(voxel[columns.U], voxel[columns.V]).Has(voxel[columns.Axis]); });
}

/// Voxels of the result that are not what the columns say; with neighbours on the surface only.
std::size_t CountWrong(const Volume& found, const std::vector<Columns>& all,
  const std::array<int, 3>& first, int neighbours)
{
  std::vector<Columns> inner;
  std::transform(all.begin(), all.end(), std::back_inserter(inner),
    [&](const Columns& columns) { return columns.GetInner(neighbours); });
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < found.Grid.NumberOfVoxels(); ++i)
  {
    Voxel voxel = found.Grid.VoxelAt(i);
    for (int axis = 0; axis < 3; ++axis)
    {
      voxel[axis] -= first[axis];
    }
    const bool expected = HaveAll(all, voxel) && (neighbours == 0 || !HaveAll(inner, voxel));
    wrong += (found.Voxels[i] != 0) != expected ? 1 : 0;
  }
  return wrong;
}

void CheckGrid(VoxelTestChecks& checks, Kind kind, const std::array<int, 3>& size, int axes,
  std::mt19937& random)
{
  constexpr std::array<int, 3> first{ -3, 5, 1 };
  const std::array<int, 6> extent{ first[0], first[0] + size[0] - 1, first[1],
    first[1] + size[1] - 1, first[2], first[2] + size[2] - 1 };
  vtkNew<vtkDepthBufferVoxelizer> voxelizer;
  voxelizer->SetReferenceImage(VoxelSolidTests::MakeGrid(extent, { 0, 0, 0 }, { 1, 1, 1 }));
  std::vector<Columns> all;
  for (int axis = 0; axis < 3; ++axis)
  {
    if ((axes >> axis & 1) != 0)
    {
      all.push_back(MakeColumns(kind, axis, size, random));
      voxelizer->AddDepthBuffers(axis, MakeBuffer(all.back(), true), MakeBuffer(all.back(), false));
    }
  }
  std::array<int, 6> part = extent;
  for (int axis = 0; axis < 3; ++axis)
  {
    part[2 * axis] += size[axis] / 3;
    part[2 * axis + 1] -= size[axis] / 4;
  }
  for (const int neighbours : { 0, 4, 8 })
  {
    voxelizer->SetOutputMode(neighbours == 0 ? vtkDepthBufferVoxelizer::OUTPUT_MODE_SOLID
                                             : vtkDepthBufferVoxelizer::OUTPUT_MODE_SURFACE);
    voxelizer->SetConnectivity(neighbours == 0 ? 4 : neighbours);
    for (std::array<int, 6> wanted : { part, extent })
    {
      voxelizer->UpdateInformation();
      voxelizer->UpdateExtent(wanted.data());
      const Volume found = OccupancyOf(voxelizer->GetOutput());
      checks.Check("the output has the wanted voxels", found.Grid.Extent == wanted);
      const std::size_t wrong = CountWrong(found, all, first, neighbours);
      if (wrong > 0)
      {
        checks.Equal("seed " + std::to_string(Seed) + ", kind " +
            std::to_string(static_cast<int>(kind)) + ", " + std::to_string(size[0]) + " x " +
            std::to_string(size[1]) + " x " + std::to_string(size[2]) + ", axes " +
            std::to_string(axes) + ", neighbours " + std::to_string(neighbours) +
            (wanted == part ? ", a part" : "") + ": wrong voxels",
          wrong, std::size_t(0));
      }
    }
  }
}
}

int TestDepthColumns(int, char*[])
{
  VoxelTestChecks checks;
  std::mt19937 random(Seed);
  for (const Kind kind : { Kind::Plates, Kind::Slopes, Kind::Noise })
  {
    for (const int axes : { 1, 2, 4, 5, 6, 7 })
    {
      CheckGrid(checks, kind, { 140, 21, 50 }, axes, random);
      CheckGrid(checks, kind, { 31, 33, 32 }, axes, random);
    }
    CheckGrid(checks, kind, { 1, 1, 1 }, 7, random);
    CheckGrid(checks, kind, { 2, 3, 5 }, 7, random);
    CheckGrid(checks, kind, { 33, 1, 70 }, 7, random);
    // Lengths that need more or fewer bits than other axes.
    CheckGrid(checks, kind, { 40, 300, 9 }, 7, random);
    CheckGrid(checks, kind, { 9, 20, 270 }, 7, random);
    CheckGrid(checks, kind, { 5, 4100, 3 }, 7, random);
  }
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
