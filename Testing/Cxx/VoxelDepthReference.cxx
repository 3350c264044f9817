#include "VoxelDepthReference.h"

#include "VoxelComparison.h"

#include <vtkImageData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <vector>

namespace VoxelReference
{
namespace
{
/// Half as much again as OpenGL's snapping may move a vertex along each axis.
constexpr double Jitter = 1.5 / 512.0;
constexpr double DepthTolerance = 1e-3;
constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Depths along an axis that its columns take part with; empty when Low > High.
struct Interval
{
  double Low = Infinity;
  double High = -Infinity;

  void Add(double depth)
  {
    this->Low = std::min(this->Low, depth);
    this->High = std::max(this->High, depth);
  }
};

/// For one of the nine places of the columns along an axis, the interval of each column.
class ColumnMap
{
public:
  ColumnMap(const IndexMesh& mesh, const Grid& grid, const AxisOrder& order, double du, double dv)
    : Order(order)
    , FirstU(grid.Extent[2 * order.U])
    , FirstV(grid.Extent[2 * order.V])
    , SizeU(grid.Size(order.U))
    , SizeV(grid.Size(order.V))
    , Du(du)
    , Dv(dv)
    , Intervals(std::size_t(this->SizeU) * this->SizeV)
  {
    for (std::int64_t i = 0; i < mesh.GetNumberOfTriangles(); ++i)
    {
      this->Add(mesh.GetTriangle(i));
    }
  }

  const Interval& At(const Voxel& voxel) const
  {
    return this->Intervals[std::size_t(voxel[this->Order.V] - this->FirstV) * this->SizeU +
      (voxel[this->Order.U] - this->FirstU)];
  }

private:
  static double Cross(double ax, double ay, double bx, double by) { return ax * by - ay * bx; }

  void Add(const Triangle& triangle)
  {
    const int u = this->Order.U;
    const int v = this->Order.V;
    const auto [low, high] = std::minmax({ triangle[0][u], triangle[1][u], triangle[2][u] });
    const auto [lowV, highV] = std::minmax({ triangle[0][v], triangle[1][v], triangle[2][v] });
    const auto index = [](double place, int first, int size)
    { return int(std::clamp(std::floor(place) - first, 0.0, double(size))); };
    const double area = Cross(triangle[1][u] - triangle[0][u], triangle[1][v] - triangle[0][v],
      triangle[2][u] - triangle[0][u], triangle[2][v] - triangle[0][v]);
    if (area == 0.0)
    {
      return;
    }
    for (int j = index(lowV, this->FirstV, this->SizeV);
         j < index(highV + 2.0, this->FirstV, this->SizeV); ++j)
    {
      for (int i = index(low, this->FirstU, this->SizeU);
           i < index(high + 2.0, this->FirstU, this->SizeU); ++i)
      {
        this->AddTo(i, j, triangle, area);
      }
    }
  }

  void AddTo(int i, int j, const Triangle& triangle, double area)
  {
    const double pu = i + this->FirstU + this->Du;
    const double pv = j + this->FirstV + this->Dv;
    double depth = 0.0;
    for (int corner = 0; corner < 3; ++corner)
    {
      const Vector& a = triangle[(corner + 1) % 3];
      const Vector& b = triangle[(corner + 2) % 3];
      const double weight =
        Cross(b[this->Order.U] - a[this->Order.U], b[this->Order.V] - a[this->Order.V],
          pu - a[this->Order.U], pv - a[this->Order.V]) /
        area;
      if (weight < 0.0)
      {
        return;
      }
      depth += weight * triangle[corner][this->Order.C];
    }
    this->Intervals[std::size_t(j) * this->SizeU + i].Add(depth);
  }

  AxisOrder Order;
  int FirstU;
  int FirstV;
  int SizeU;
  int SizeV;
  double Du;
  double Dv;
  std::vector<Interval> Intervals;
};
}

DepthVoxels DepthReference(vtkPolyData* mesh, const Grid& grid, const std::array<bool, 3>& axes)
{
  const IndexMesh triangles(mesh, grid);
  DepthVoxels result{ Volume(grid), Volume(grid) };
  std::fill_n(result.Sure.Voxels.get(), grid.NumberOfVoxels(), static_cast<unsigned char>(1));
  std::fill_n(result.Maybe.Voxels.get(), grid.NumberOfVoxels(), static_cast<unsigned char>(1));
  for (const Axis axis : AllAxes)
  {
    const AxisOrder order(axis);
    if (!axes[order.C])
    {
      continue;
    }
    std::vector<ColumnMap> maps;
    for (const double dv : { -Jitter, 0.0, Jitter })
    {
      for (const double du : { -Jitter, 0.0, Jitter })
      {
        maps.emplace_back(triangles, grid, order, du, dv);
      }
    }
    for (std::size_t offset = 0; offset < grid.NumberOfVoxels(); ++offset)
    {
      const Voxel voxel = grid.VoxelAt(offset);
      const double depth = voxel[order.C];
      bool sure = true;
      double low = Infinity;
      double high = -Infinity;
      for (const ColumnMap& map : maps)
      {
        const Interval& interval = map.At(voxel);
        sure =
          sure && interval.Low + DepthTolerance < depth && depth < interval.High - DepthTolerance;
        low = std::min(low, interval.Low);
        high = std::max(high, interval.High);
      }
      const bool maybe = low - DepthTolerance < depth && depth < high + DepthTolerance;
      result.Sure.Voxels[offset] &= static_cast<unsigned char>(sure);
      result.Maybe.Voxels[offset] &= static_cast<unsigned char>(maybe);
    }
  }
  return result;
}

bool ReportDepth(
  const std::string& name, vtkImageData* result, const DepthVoxels& expected, double allowed)
{
  const std::size_t sure = expected.Sure.CountNonZero();
  const std::size_t maybe = expected.Maybe.CountNonZero();
  if (sure == 0 || double(maybe - sure) > allowed * double(maybe))
  {
    std::cerr << name << ": the reference is useless, it knows " << sure << " of " << maybe
              << " voxels\n";
    return false;
  }
  const auto missing = Compare(result, expected.Sure).Missing;
  const auto extra = Compare(result, expected.Maybe).Extra;
  if (missing.empty() && extra.empty())
  {
    return true;
  }
  std::cerr << name << ": " << missing.size() << " voxels missing, " << extra.size()
            << " too many, of " << maybe
            << "; missing first: " << Compare(result, expected.Sure).Summary() << "\n";
  return false;
}

}
