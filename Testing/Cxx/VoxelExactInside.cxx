#include "VoxelExactInside.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace VoxelReference
{
namespace
{

/// A real number as an exact, non-overlapping sum of doubles in order of increasing magnitude.
class Exact
{
public:
  Exact() = default;
  explicit Exact(double value) { this->Add(value); }
  Exact(const Exact& other)
    : Count(other.Count)
  {
    std::copy(other.begin(), other.end(), this->Terms.begin());
  }
  Exact& operator=(const Exact&) = delete;

  static Exact Difference(double a, double b)
  {
    Exact difference(a);
    difference.Add(-b);
    return difference;
  }

  Exact operator-(const Exact& other) const
  {
    Exact difference = *this;
    for (double term : other)
    {
      difference.Add(-term);
    }
    return difference;
  }

  Exact operator+(const Exact& other) const
  {
    Exact sum = *this;
    for (double term : other)
    {
      sum.Add(term);
    }
    return sum;
  }

  Exact operator*(const Exact& other) const
  {
    Exact product;
    for (double a : *this)
    {
      for (double b : other)
      {
        const double high = a * b;
        product.Add(std::fma(a, b, -high));
        product.Add(high);
      }
    }
    return product;
  }

  int Sign() const { return this->Count == 0 ? 0 : (this->Terms[this->Count - 1] > 0.0 ? 1 : -1); }

private:
  const double* begin() const { return this->Terms.data(); }
  const double* end() const { return this->Terms.data() + this->Count; }

  void Add(double value)
  {
    double carry = value;
    std::size_t kept = 0;
    for (double term : *this)
    {
      const double sum = carry + term;
      const double virtualTerm = sum - carry;
      const double rest = (carry - (sum - virtualTerm)) + (term - virtualTerm);
      carry = sum;
      if (rest != 0.0)
      {
        this->Terms[kept++] = rest;
      }
    }
    if (carry != 0.0)
    {
      this->Terms[kept++] = carry;
    }
    this->Count = kept;
  }

  // Enough for three products of a difference (2 terms) and a normal's component (16 terms).
  static constexpr std::size_t Capacity = 192;
  std::array<double, Capacity> Terms; ///< the first Count are valid
  std::size_t Count = 0;
};

/// An edge's crossing of the row v lies at or before u (U <= u).
bool CrossesAtOrBefore(const Vector& one, const Vector& two, const AxisOrder& order, int u, int v)
{
  const bool ascending = one[order.V] < two[order.V];
  const Vector& low = ascending ? one : two;
  const Vector& high = ascending ? two : one;
  const Exact scaledCrossing =
    Exact::Difference(v, low[order.V]) * Exact::Difference(high[order.U], low[order.U]);
  const Exact scaledPoint =
    Exact::Difference(u, low[order.U]) * Exact::Difference(high[order.V], low[order.V]);
  return (scaledCrossing - scaledPoint).Sign() <= 0;
}

/// +1 or -1, the direction of the crossings at or before u, if the column (u, v) is covered; else
/// 0.
int Coverage(const Triangle& triangle, const AxisOrder& order, int u, int v)
{
  int coverage = 0;
  for (int corner = 0; corner < 3; ++corner)
  {
    const Vector& from = triangle[corner];
    const Vector& to = triangle[(corner + 1) % 3];
    const bool fromBefore = from[order.V] <= v;
    const bool toBefore = to[order.V] <= v;
    if (fromBefore != toBefore && CrossesAtOrBefore(from, to, order, u, v))
    {
      coverage += fromBefore ? 1 : -1;
    }
  }
  return coverage;
}

/// The triangle's plane has a depth <= c at (u, v). The triangle is not parallel to the column.
bool LiesAtOrBefore(const Triangle& triangle, const AxisOrder& order, const Voxel& voxel)
{
  const auto edge = [&](int corner, int axis)
  { return Exact::Difference(triangle[corner][axis], triangle[0][axis]); };
  const auto normal = [&](int first, int second)
  { return edge(1, first) * edge(2, second) - edge(1, second) * edge(2, first); };
  const auto offset = [&](int axis) { return Exact::Difference(voxel[axis], triangle[0][axis]); };

  const Exact normalC = normal(order.U, order.V);
  const Exact above = offset(order.U) * normal(order.V, order.C) +
    offset(order.V) * normal(order.C, order.U) + offset(order.C) * normalC;
  return above.Sign() * normalC.Sign() >= 0;
}

bool MayCover(const Triangle& triangle, int axis, int index)
{
  const auto [low, high] = std::minmax({ triangle[0][axis], triangle[1][axis], triangle[2][axis] });
  return low <= index && index < high;
}

}

//------------------------------------------------------------------------------------------------
bool PointInMeshExact(const IndexMesh& mesh, const Voxel& voxel, Axis column, FillRule rule)
{
  const AxisOrder order(column);
  int crossings = 0;
  int winding = 0;
  for (std::int64_t cell = 0; cell < mesh.GetNumberOfTriangles(); ++cell)
  {
    const Triangle triangle = mesh.GetTriangle(cell);
    if (!MayCover(triangle, order.V, voxel[order.V]) ||
      !MayCover(triangle, order.U, voxel[order.U]))
    {
      continue;
    }
    const int coverage = Coverage(triangle, order, voxel[order.U], voxel[order.V]);
    if (coverage != 0 && LiesAtOrBefore(triangle, order, voxel))
    {
      ++crossings;
      winding += coverage;
    }
  }
  return rule == FillRule::Parity ? crossings % 2 != 0 : winding != 0;
}

}
