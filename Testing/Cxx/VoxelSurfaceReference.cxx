#include "VoxelSurfaceReference.h"

#include "VoxelReferenceThreads.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

namespace VoxelReference
{
namespace
{

Vector operator-(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

double Dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double DifferenceOfProducts(double a, double b, double c, double d)
{
  const double cd = c * d;
  return std::fma(a, b, -cd) + std::fma(-c, d, cd);
}

Vector Cross(const Vector& a, const Vector& b)
{
  return { DifferenceOfProducts(a[1], b[2], a[2], b[1]),
    DifferenceOfProducts(a[2], b[0], a[0], b[2]), DifferenceOfProducts(a[0], b[1], a[1], b[0]) };
}

double DistanceToSegment(const Vector& point, const Vector& a, const Vector& b)
{
  const Vector direction = b - a;
  const Vector offset = point - a;
  const double length2 = Dot(direction, direction);
  const double t = length2 > 0.0 ? std::clamp(Dot(offset, direction) / length2, 0.0, 1.0) : 0.0;
  Vector rest = offset;
  for (int axis = 0; axis < 3; ++axis)
  {
    rest[axis] -= t * direction[axis];
  }
  return std::sqrt(Dot(rest, rest));
}

/// The inclusive range of voxels whose centres lie in the bounds of a triangle grown by `reach`.
std::array<int, 6> VoxelRange(const Triangle& triangle, double reach, const Grid& grid)
{
  std::array<int, 6> range{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto [low, high] =
      std::minmax({ triangle[0][axis], triangle[1][axis], triangle[2][axis] });
    const double first = grid.Extent[2 * axis];
    const double last = grid.Extent[2 * axis + 1];
    range[2 * axis] = static_cast<int>(std::clamp(std::ceil(low - reach), first, last + 1.0));
    range[2 * axis + 1] = static_cast<int>(std::clamp(std::floor(high + reach), first - 1.0, last));
  }
  return range;
}

bool IsEmpty(const std::array<int, 6>& range)
{
  return range[0] > range[1] || range[2] > range[3] || range[4] > range[5];
}

/// How far the triangle's projection stays away from 0 along `axis`, for a cube of half size 1.
double SeparationAlong(const Vector& axis, const Triangle& triangle)
{
  const double size = std::abs(axis[0]) + std::abs(axis[1]) + std::abs(axis[2]);
  if (!(size > 0.0))
  {
    return 0.0;
  }
  const auto [low, high] =
    std::minmax({ Dot(axis, triangle[0]), Dot(axis, triangle[1]), Dot(axis, triangle[2]) });
  return std::max(low, -high) / size;
}

/// The separating axis test of one triangle against boxes of voxels.
class TriangleBoxTest
{
public:
  explicit TriangleBoxTest(const Triangle& triangle)
    : Corners(triangle)
  {
    const Vector edges[3] = { triangle[1] - triangle[0], triangle[2] - triangle[1],
      triangle[0] - triangle[2] };
    int count = 0;
    for (const Vector& edge : edges)
    {
      this->Axes[count++] = { 0.0, -edge[2], edge[1] };
      this->Axes[count++] = { edge[2], 0.0, -edge[0] };
      this->Axes[count++] = { -edge[1], edge[0], 0.0 };
    }
    this->Axes[count++] = Cross(edges[0], edges[1]);
    this->Axes[count++] = { 1.0, 0.0, 0.0 };
    this->Axes[count++] = { 0.0, 1.0, 0.0 };
    this->Axes[count++] = { 0.0, 0.0, 1.0 };
  }

  double CubeDistance(const Vector& centre) const
  {
    const Triangle moved = this->RelativeTo(centre);
    double distance = 0.0;
    for (const Vector& axis : this->Axes)
    {
      distance = std::max(distance, SeparationAlong(axis, moved));
    }
    return distance;
  }

  /// Does the triangle overlap the box of all voxels of the range, grown by `margin`?
  bool Overlaps(const std::array<int, 6>& range, double margin) const
  {
    Vector centre;
    Vector half;
    for (int axis = 0; axis < 3; ++axis)
    {
      centre[axis] = 0.5 * (range[2 * axis] + range[2 * axis + 1]);
      half[axis] = 0.5 * (range[2 * axis + 1] - range[2 * axis] + 1) + margin;
    }
    const Triangle moved = this->RelativeTo(centre);
    return std::none_of(this->Axes.begin(), this->Axes.end(),
      [&](const Vector& axis)
      {
        const double radius =
          std::abs(axis[0]) * half[0] + std::abs(axis[1]) * half[1] + std::abs(axis[2]) * half[2];
        const auto [low, high] =
          std::minmax({ Dot(axis, moved[0]), Dot(axis, moved[1]), Dot(axis, moved[2]) });
        return std::max(low, -high) > radius;
      });
  }

private:
  Triangle RelativeTo(const Vector& centre) const
  {
    return { this->Corners[0] - centre, this->Corners[1] - centre, this->Corners[2] - centre };
  }

  Triangle Corners;
  std::array<Vector, 13> Axes;
};

/// Calls visit(voxel) for the voxels of the range near the triangle, halving ranges that are large.
template <typename Visitor>
void VisitNearVoxels(
  const TriangleBoxTest& test, const std::array<int, 6>& range, double margin, Visitor&& visit)
{
  const auto size = [&range](int axis) { return range[2 * axis + 1] - range[2 * axis] + 1; };
  constexpr std::int64_t fewVoxels = 64;
  if (static_cast<std::int64_t>(size(0)) * size(1) * size(2) <= fewVoxels)
  {
    for (int k = range[4]; k <= range[5]; ++k)
    {
      for (int j = range[2]; j <= range[3]; ++j)
      {
        for (int i = range[0]; i <= range[1]; ++i)
        {
          visit(Voxel{ i, j, k });
        }
      }
    }
    return;
  }
  if (!test.Overlaps(range, margin))
  {
    return;
  }
  int longest = size(0) >= size(1) ? 0 : 1;
  longest = size(longest) >= size(2) ? longest : 2;
  std::array<int, 6> lower = range;
  std::array<int, 6> upper = range;
  lower[2 * longest + 1] = range[2 * longest] + size(longest) / 2 - 1;
  upper[2 * longest] = lower[2 * longest + 1] + 1;
  VisitNearVoxels(test, lower, margin, visit);
  VisitNearVoxels(test, upper, margin, visit);
}

/// Voxels in the order of their rows, to find those of a range quickly.
class SortedVoxels
{
public:
  explicit SortedVoxels(const std::vector<Voxel>& voxels)
    : Voxels(voxels)
    , Order(voxels.size())
  {
    std::iota(this->Order.begin(), this->Order.end(), std::size_t{ 0 });
    std::sort(this->Order.begin(), this->Order.end(),
      [this](std::size_t a, std::size_t b)
      { return RowMajor(this->Voxels[a]) < RowMajor(this->Voxels[b]); });
  }

  /// Calls visit(number) for the voxels that lie in the range.
  template <typename Visitor>
  void VisitRange(const std::array<int, 6>& range, Visitor&& visit) const
  {
    for (int k = range[4]; k <= range[5]; ++k)
    {
      for (int j = range[2]; j <= range[3]; ++j)
      {
        const Voxel first{ range[0], j, k };
        auto it = std::lower_bound(this->Order.begin(), this->Order.end(), RowMajor(first),
          [this](std::size_t number, const Voxel& key)
          { return RowMajor(this->Voxels[number]) < key; });
        for (; it != this->Order.end(); ++it)
        {
          const Voxel& voxel = this->Voxels[*it];
          if (voxel[2] != k || voxel[1] != j || voxel[0] > range[1])
          {
            break;
          }
          visit(*it);
        }
      }
    }
  }

private:
  static Voxel RowMajor(const Voxel& voxel) { return { voxel[2], voxel[1], voxel[0] }; }

  const std::vector<Voxel>& Voxels;
  std::vector<std::size_t> Order;
};

bool IsInRange(const Voxel& voxel, const std::array<int, 6>& range)
{
  return voxel[0] >= range[0] && voxel[0] <= range[1] && voxel[1] >= range[2] &&
    voxel[1] <= range[3] && voxel[2] >= range[4] && voxel[2] <= range[5];
}

}

//------------------------------------------------------------------------------------------------
double DistanceToTriangle(const Vector& point, const Triangle& triangle)
{
  const auto& [a, b, c] = triangle;
  const double toEdges = std::min({ DistanceToSegment(point, a, b), DistanceToSegment(point, b, c),
    DistanceToSegment(point, c, a) });

  const Vector normal = Cross(b - a, c - a);
  const double area2 = Dot(normal, normal);
  const bool aboveInterior = Dot(Cross(b - a, point - a), normal) > 0.0 &&
    Dot(Cross(c - b, point - b), normal) > 0.0 && Dot(Cross(a - c, point - c), normal) > 0.0;
  if (!(area2 > 0.0) || !aboveInterior)
  {
    return toEdges;
  }
  return std::min(toEdges, std::abs(Dot(point - a, normal)) / std::sqrt(area2));
}

//------------------------------------------------------------------------------------------------
double CubeDistanceToTriangle(const Vector& centre, const Triangle& triangle)
{
  return TriangleBoxTest(triangle).CubeDistance(centre);
}

//------------------------------------------------------------------------------------------------
std::vector<double> DistanceToSurface(
  vtkPolyData* mesh, const Grid& grid, const std::vector<Voxel>& voxels, double reach, int threads)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> beyondReach(voxels.size(), infinity);
  if (voxels.empty())
  {
    return beyondReach;
  }

  const IndexMesh triangles(mesh, grid, threads);
  const SortedVoxels sorted(voxels);
  std::vector<std::vector<double>> partial(threads, beyondReach);
  ParallelFor(triangles.GetNumberOfTriangles(), 256, threads,
    [&](std::int64_t begin, std::int64_t end, int thread)
    {
      for (std::int64_t cell = begin; cell < end; ++cell)
      {
        const Triangle triangle = triangles.GetTriangle(cell);
        const std::array<int, 6> range = VoxelRange(triangle, reach, grid);
        if (IsEmpty(range))
        {
          continue;
        }
        const auto measure = [&](std::size_t number)
        {
          const Voxel& voxel = voxels[number];
          const Vector centre{ static_cast<double>(voxel[0]), static_cast<double>(voxel[1]),
            static_cast<double>(voxel[2]) };
          double& distance = partial[thread][number];
          distance = std::min(distance, DistanceToTriangle(centre, triangle));
        };
        const auto rows = static_cast<std::size_t>(range[3] - range[2] + 1) *
          static_cast<std::size_t>(range[5] - range[4] + 1);
        if (rows < voxels.size())
        {
          sorted.VisitRange(range, measure);
          continue;
        }
        for (std::size_t number = 0; number < voxels.size(); ++number)
        {
          if (IsInRange(voxels[number], range))
          {
            measure(number);
          }
        }
      }
    });

  std::vector<double> distances = beyondReach;
  for (const std::vector<double>& some : partial)
  {
    std::transform(some.begin(), some.end(), distances.begin(), distances.begin(),
      [](double a, double b) { return std::min(a, b); });
  }
  std::replace_if(
    distances.begin(), distances.end(), [reach](double d) { return d > reach; }, infinity);
  return distances;
}

//------------------------------------------------------------------------------------------------
Volume TouchedVoxelsReference(vtkPolyData* mesh, const Grid& grid, int threads, double nearMargin)
{
  const IndexMesh triangles(mesh, grid, threads);
  std::vector<std::atomic<unsigned char>> touched(grid.NumberOfVoxels());
  ParallelFor(triangles.GetNumberOfTriangles(), 64, threads,
    [&](std::int64_t begin, std::int64_t end, int)
    {
      for (std::int64_t cell = begin; cell < end; ++cell)
      {
        const Triangle triangle = triangles.GetTriangle(cell);
        const std::array<int, 6> range = VoxelRange(triangle, 0.5 + nearMargin, grid);
        if (IsEmpty(range))
        {
          continue;
        }
        const TriangleBoxTest test(triangle);
        VisitNearVoxels(test, range, nearMargin,
          [&](const Voxel& voxel)
          {
            const double distance = test.CubeDistance({ static_cast<double>(voxel[0]),
              static_cast<double>(voxel[1]), static_cast<double>(voxel[2]) });
            const int near = distance <= 0.5 + nearMargin ? TouchedNearly : 0;
            const int sure = distance <= 0.5 - SureMargin ? TouchedSurely : 0;
            touched[grid.Offset(voxel)].fetch_or(
              static_cast<unsigned char>(near | sure), std::memory_order_relaxed);
          });
      }
    });

  Volume result(grid);
  std::transform(touched.begin(), touched.end(), result.Voxels.get(),
    [](const std::atomic<unsigned char>& touch) { return touch.load(std::memory_order_relaxed); });
  return result;
}

}
