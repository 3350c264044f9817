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

Vector UnitVector(int axis)
{
  Vector unit{};
  unit[axis] = 1.0;
  return unit;
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

/// The half space m.(x - p) + 0.5 max|m_k| >= 0: where the octahedron in the voxel at x, of those
/// points whose offsets from x add up to 0.5 at most, reaches m.(x - p) >= 0.
class OctahedronHalfSpace
{
public:
  OctahedronHalfSpace(const Vector& normal, const Vector& point)
    : Normal(normal)
    , Point(point)
    , Reach(0.5 * std::max({ std::abs(normal[0]), std::abs(normal[1]), std::abs(normal[2]) }))
    , Size(std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]))
  {
  }

  /// Does it hold `centre` when it is moved outwards by `margin` along all axes?
  bool Holds(const Vector& centre, double margin) const
  {
    return Dot(this->Normal, centre - this->Point) + this->Reach + margin * this->Size >= 0.0;
  }

private:
  Vector Normal;
  Vector Point;
  double Reach;
  double Size;
};

/// The thin overlap of one triangle with voxels: each of its conditions is a half space.
class ThinTest
{
public:
  explicit ThinTest(const Triangle& triangle)
    : Edges{ triangle[1] - triangle[0], triangle[2] - triangle[1], triangle[0] - triangle[2] }
    , Corners(triangle)
  {
    const Vector normal = Cross(this->Edges[0], this->Edges[1]);
    for (int axis = 0; axis < 3; ++axis)
    {
      this->AddBounds(axis);
      this->AddProjection(axis, normal[axis]);
    }
    if (this->HasArea)
    {
      this->AddBothSides(normal, triangle[0]);
    }
  }

  bool Holds(const Vector& centre, double margin) const
  {
    return std::all_of(this->HalfSpaces.begin(), this->HalfSpaces.end(),
      [&](const OctahedronHalfSpace& space) { return space.Holds(centre, margin); });
  }

  /// As Holds; without area, the planes through the triangle have to hold `centre` all.
  bool HoldsInAllPlanes(const Vector& centre, double margin) const
  {
    return this->Holds(centre, margin) &&
      (this->HasArea || this->DistanceToLongestEdge(centre) <= 0.5 / std::sqrt(3.0) + margin);
  }

private:
  void AddBothSides(const Vector& normal, const Vector& point)
  {
    this->HalfSpaces.emplace_back(normal, point);
    this->HalfSpaces.emplace_back(Vector{} - normal, point);
  }

  void AddBounds(int axis)
  {
    const auto [low, high] = std::minmax_element(this->Corners.begin(), this->Corners.end(),
      [axis](const Vector& a, const Vector& b) { return a[axis] < b[axis]; });
    const Vector inward = UnitVector(axis);
    this->HalfSpaces.emplace_back(inward, *low);
    this->HalfSpaces.emplace_back(Vector{} - inward, *high);
  }

  /// The edges as seen along the axis, where the triangle has `area`, doubled and signed.
  void AddProjection(int axis, double area)
  {
    std::array<Vector, 3> inward;
    std::array<double, 3> length;
    for (int edge = 0; edge < 3; ++edge)
    {
      inward[edge] = Cross(UnitVector(axis), this->Edges[edge]);
      length[edge] = std::sqrt(Dot(inward[edge], inward[edge]));
    }
    const auto longest = std::max_element(length.begin(), length.end()) - length.begin();
    if (std::abs(area) <= SureMargin * length[longest])
    {
      this->AddBothSides(inward[longest], this->Corners[longest]);
      return;
    }
    this->HasArea = true;
    for (int edge = 0; edge < 3; ++edge)
    {
      this->HalfSpaces.emplace_back(
        area > 0.0 ? inward[edge] : Vector{} - inward[edge], this->Corners[edge]);
    }
  }

  double DistanceToLongestEdge(const Vector& point) const
  {
    const auto longest = std::max_element(this->Edges.begin(), this->Edges.end(),
                           [](const Vector& a, const Vector& b) { return Dot(a, a) < Dot(b, b); }) -
      this->Edges.begin();
    return DistanceToSegment(point, this->Corners[longest], this->Corners[(longest + 1) % 3]);
  }

  std::array<Vector, 3> Edges; ///< each begins at the corner of its number
  Triangle Corners;
  std::vector<OctahedronHalfSpace> HalfSpaces;
  bool HasArea = false;
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

/// For each voxel the bits that makeClassifier(triangle, boxTest)(centre) gives for any triangle
/// that touches the voxel grown by `margin`; it may also be asked about voxels a bit farther away.
template <typename MakeClassifier>
Volume ClassifyVoxels(
  vtkPolyData* mesh, const Grid& grid, int threads, double margin, MakeClassifier&& makeClassifier)
{
  const IndexMesh triangles(mesh, grid, threads);
  std::vector<std::atomic<unsigned char>> touched(grid.NumberOfVoxels());
  ParallelFor(triangles.GetNumberOfTriangles(), 64, threads,
    [&](std::int64_t begin, std::int64_t end, int)
    {
      for (std::int64_t cell = begin; cell < end; ++cell)
      {
        const Triangle triangle = triangles.GetTriangle(cell);
        const std::array<int, 6> range = VoxelRange(triangle, 0.5 + margin, grid);
        if (IsEmpty(range))
        {
          continue;
        }
        const TriangleBoxTest test(triangle);
        const auto classify = makeClassifier(triangle, test);
        VisitNearVoxels(test, range, margin,
          [&](const Voxel& voxel)
          {
            const int touch = classify({ static_cast<double>(voxel[0]),
              static_cast<double>(voxel[1]), static_cast<double>(voxel[2]) });
            touched[grid.Offset(voxel)].fetch_or(
              static_cast<unsigned char>(touch), std::memory_order_relaxed);
          });
      }
    });

  Volume result(grid);
  std::transform(touched.begin(), touched.end(), result.Voxels.get(),
    [](const std::atomic<unsigned char>& touch) { return touch.load(std::memory_order_relaxed); });
  return result;
}

int MakeTouch(bool nearly, bool surely)
{
  return (nearly ? TouchedNearly : 0) | (surely ? TouchedSurely : 0);
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
  return ClassifyVoxels(mesh, grid, threads, nearMargin,
    [nearMargin](const Triangle&, const TriangleBoxTest& test)
    {
      return [&test, nearMargin](const Vector& centre)
      {
        const double distance = test.CubeDistance(centre);
        return MakeTouch(distance <= 0.5 + nearMargin, distance <= 0.5 - SureMargin);
      };
    });
}

//------------------------------------------------------------------------------------------------
Volume ThinVoxelsReference(vtkPolyData* mesh, const Grid& grid, int threads, double nearMargin)
{
  return ClassifyVoxels(mesh, grid, threads, nearMargin,
    [nearMargin](const Triangle& triangle, const TriangleBoxTest&)
    {
      return [test = ThinTest(triangle), nearMargin](const Vector& centre)
      {
        const bool nearly = test.Holds(centre, nearMargin);
        return MakeTouch(nearly, nearly && test.HoldsInAllPlanes(centre, -SureMargin));
      };
    });
}

}
