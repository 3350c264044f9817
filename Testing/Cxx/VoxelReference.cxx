#include "VoxelReference.h"

#include "VoxelReferenceThreads.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <optional>

namespace VoxelReference
{
namespace
{

//------------------------------------------------------------------------------------------------
// The rule
//------------------------------------------------------------------------------------------------

/// A vertex in the column's frame.
struct Point
{
  double U;
  double V;
  double C;
};

/// A toggle: all voxels of the column (u, v) from `Depth` on lie behind the crossing.
struct Crossing
{
  int U;
  int V;
  int Depth;
  int Orientation; ///< +1 or -1
};

/// The inclusive ranges of the grid in the column's frame.
struct ColumnFrame
{
  ColumnFrame(const Grid& grid, Axis column)
    : Order(column)
    , ULow(grid.Extent[2 * this->Order.U])
    , UHigh(grid.Extent[2 * this->Order.U + 1])
    , VLow(grid.Extent[2 * this->Order.V])
    , VHigh(grid.Extent[2 * this->Order.V + 1])
    , CLow(grid.Extent[2 * this->Order.C])
    , CHigh(grid.Extent[2 * this->Order.C + 1])
  {
  }

  Point FromIndex(const Vector& p) const
  {
    return { p[this->Order.U], p[this->Order.V], p[this->Order.C] };
  }

  AxisOrder Order;
  int ULow, UHigh, VLow, VHigh, CLow, CHigh;
};

/// ceil(x), clamped to [low, high].
inline int CeilWithin(double x, int low, int high)
{
  if (!(x > low))
  {
    return low;
  }
  if (x > high)
  {
    return high;
  }
  const int truncated = static_cast<int>(x);
  return truncated + (truncated < x);
}

inline double DifferenceOfProducts(double a, double b, double c, double d)
{
  // Kahan: within 1.5 ulp of a * b - c * d, so that slivers keep their planes.
  const double cd = c * d;
  return std::fma(a, b, -cd) + std::fma(-c, d, cd);
}

/// Where the edge crosses the row v; `low` has the smaller ordinate.
inline double CrossingU(const Point& low, const Point& high, double v)
{
  return low.U + (v - low.V) * (high.U - low.U) / (high.V - low.V);
}

/// The depth of that crossing.
inline double CrossingDepth(const Point& low, const Point& high, double v)
{
  return low.C + (v - low.V) * (high.C - low.C) / (high.V - low.V);
}

/// How to put the corners of a triangle in order of their ordinates.
struct CornerOrder
{
  int Low;
  int Middle;
  int High;
  int Orientation; ///< of the permutation
};

inline const CornerOrder& OrderCorners(const std::array<Point, 3>& p)
{
  // By b < a, c < b and c < a; two of the eight cases are impossible.
  static constexpr std::array<CornerOrder, 8> orders = { { { 0, 1, 2, 1 }, { 1, 0, 2, -1 },
    { 0, 2, 1, -1 }, { 0, 1, 2, 1 }, { 0, 1, 2, 1 }, { 1, 2, 0, 1 }, { 2, 0, 1, 1 },
    { 2, 1, 0, -1 } } };
  return orders[static_cast<int>(p[1].V < p[0].V) | static_cast<int>(p[2].V < p[1].V) << 1 |
    static_cast<int>(p[2].V < p[0].V) << 2];
}

/// The plane of a triangle as depth over (u, v).
class DepthPlane
{
public:
  DepthPlane(const Point& a, const Point& b, const Point& c)
    : Base(a)
  {
    const Point p{ b.U - a.U, b.V - a.V, b.C - a.C };
    const Point q{ c.U - a.U, c.V - a.V, c.C - a.C };
    this->NormalU = DifferenceOfProducts(p.V, q.C, p.C, q.V);
    this->NormalV = DifferenceOfProducts(p.C, q.U, p.U, q.C);
    this->NormalC = DifferenceOfProducts(p.U, q.V, p.V, q.U);
  }

  /// The depth at (u, v), kept within [low, high]; NaN gives the lower.
  double At(double u, double v, double low, double high) const
  {
    const double depth = this->Base.C -
      ((u - this->Base.U) * this->NormalU + (v - this->Base.V) * this->NormalV) / this->NormalC;
    return depth > low ? std::min(depth, high) : low;
  }

private:
  Point Base;
  double NormalU;
  double NormalV;
  double NormalC;
};

/// Does [low, high) hold an index of [first, last]? May say yes when an end lies within `room` of
/// it.
inline bool MayHoldIndex(double low, double high, double room, int first, int last)
{
  return CeilWithin(low - room, first, last + 1) != CeilWithin(high + room, first, last + 1);
}

/// Sorts out most of the triangles that cover no column. Leaves room for rounded crossings.
inline bool MayCoverColumn(const std::array<Point, 3>& triangle, const ColumnFrame& frame)
{
  const auto& [a, b, c] = triangle;
  const double lowV = std::min(std::min(a.V, b.V), c.V);
  const double highV = std::max(std::max(a.V, b.V), c.V);
  const double lowU = std::min(std::min(a.U, b.U), c.U);
  const double highU = std::max(std::max(a.U, b.U), c.U);
  const double roundingU = 1e-12 * (1.0 + std::max(std::abs(lowU), std::abs(highU)));
  return MayHoldIndex(lowV, highV, 0.0, frame.VLow, frame.VHigh) &&
    MayHoldIndex(lowU, highU, roundingU, frame.ULow, frame.UHigh);
}

/// Calls visit(Crossing) for each column of the frame that the triangle covers.
template <typename Visitor>
void VisitCrossings(const std::array<Point, 3>& triangle, const ColumnFrame& frame, Visitor&& visit)
{
  const CornerOrder& order = OrderCorners(triangle);
  const Point& a = triangle[order.Low];
  const Point& b = triangle[order.Middle];
  const Point& c = triangle[order.High];
  const int firstRow = CeilWithin(a.V, frame.VLow, frame.VHigh + 1);
  const int middleRow = CeilWithin(b.V, frame.VLow, frame.VHigh + 1);
  const int endRow = CeilWithin(c.V, frame.VLow, frame.VHigh + 1);

  std::optional<DepthPlane> plane;
  for (int v = firstRow; v < endRow; ++v)
  {
    const Point& partLow = v < middleRow ? a : b;
    const Point& partHigh = v < middleRow ? b : c;
    const double wholeU = CrossingU(a, c, v);
    const double partU = CrossingU(partLow, partHigh, v);
    const int begin = CeilWithin(std::min(wholeU, partU), frame.ULow, frame.UHigh + 1);
    const int end = CeilWithin(std::max(wholeU, partU), frame.ULow, frame.UHigh + 1);
    if (begin == end)
    {
      continue;
    }
    if (!plane)
    {
      plane.emplace(a, b, c);
    }
    const int orientation = partU < wholeU ? order.Orientation : -order.Orientation;
    const double wholeDepth = CrossingDepth(a, c, v);
    const double partDepth = CrossingDepth(partLow, partHigh, v);
    const auto [low, high] = std::minmax(wholeDepth, partDepth);
    for (int u = begin; u < end; ++u)
    {
      const int depth = CeilWithin(plane->At(u, v, low, high), frame.CLow, frame.CHigh + 1);
      if (depth <= frame.CHigh)
      {
        visit(Crossing{ u, v, depth, orientation });
      }
    }
  }
}

/// Goes in blocks, and fetches all points of a block before it looks at them: so the fetches from
/// points far apart in memory overlap.
template <typename Visitor>
void VisitCrossings(const IndexMesh& mesh, std::int64_t begin, std::int64_t end,
  const ColumnFrame& frame, Visitor&& visit)
{
  constexpr std::int64_t blockSize = 64;
  std::array<std::array<Point, 3>, blockSize> block;
  for (; begin < end; begin += blockSize)
  {
    const auto count = static_cast<std::size_t>(std::min(blockSize, end - begin));
    for (std::size_t number = 0; number < count; ++number)
    {
      const vtkTypeInt64* ids = mesh.GetPointIds(begin + static_cast<std::int64_t>(number));
      for (int corner = 0; corner < 3; ++corner)
      {
        block[number][corner] = frame.FromIndex(mesh.GetPoint(ids[corner]));
      }
    }
    for (std::size_t number = 0; number < count; ++number)
    {
      if (MayCoverColumn(block[number], frame))
      {
        VisitCrossings(block[number], frame, visit);
      }
    }
  }
}

//------------------------------------------------------------------------------------------------
// Parity: one bit a voxel is toggled at each crossing, then the bits are summed along the columns
//------------------------------------------------------------------------------------------------

using Word = std::uint64_t;
constexpr int BitsPerWord = 64;

/// One bit a voxel; each row along x is padded to whole words.
class ToggleBits
{
public:
  ToggleBits(const Grid& grid, int threads)
    : Low{ grid.Extent[0], grid.Extent[2], grid.Extent[4] }
    , Rows(grid.Size(1))
    , WordsPerRow((grid.Size(0) + BitsPerWord - 1) / BitsPerWord)
  {
    const auto words = static_cast<std::int64_t>(this->WordsPerRow) * this->Rows * grid.Size(2);
    this->Words.reset(new std::atomic<Word>[words]);
    ParallelFor(words, 1 << 16, threads,
      [this](std::int64_t begin, std::int64_t end, int)
      {
        for (std::int64_t word = begin; word < end; ++word)
        {
          this->Words[word].store(0, std::memory_order_relaxed);
        }
      });
  }

  int GetWordsPerRow() const { return this->WordsPerRow; }

  const std::atomic<Word>* Row(int j, int k) const
  {
    return this->Words.get() + (static_cast<std::int64_t>(k) * this->Rows + j) * this->WordsPerRow;
  }

  void Toggle(const Voxel& voxel)
  {
    const int i = voxel[0] - this->Low[0];
    const std::int64_t row =
      static_cast<std::int64_t>(voxel[2] - this->Low[2]) * this->Rows + (voxel[1] - this->Low[1]);
    this->Words[row * this->WordsPerRow + i / BitsPerWord].fetch_xor(
      Word{ 1 } << (i % BitsPerWord), std::memory_order_relaxed);
  }

private:
  Voxel Low;
  std::int64_t Rows;
  int WordsPerRow;
  std::unique_ptr<std::atomic<Word>[]> Words;
};

/// Eight bytes, 0 or 1, for each value of eight bits.
constexpr auto SpreadBits = []
{
  std::array<std::array<unsigned char, 8>, 256> table{};
  for (int value = 0; value < 256; ++value)
  {
    for (int bit = 0; bit < 8; ++bit)
    {
      table[value][bit] = (value >> bit) & 1;
    }
  }
  return table;
}();

inline void WriteBits(Word bits, unsigned char* out, int count)
{
  if (bits == 0 || bits == ~Word{ 0 })
  {
    std::memset(out, static_cast<int>(bits & 1), count);
    return;
  }
  for (; count >= 8; count -= 8, out += 8, bits >>= 8)
  {
    std::memcpy(out, SpreadBits[bits & 255].data(), 8);
  }
  std::memcpy(out, SpreadBits[bits & 255].data(), count);
}

/// Bit n becomes the parity of bits 0 to n.
inline Word ParityScan(Word bits)
{
  for (int shift = 1; shift < BitsPerWord; shift *= 2)
  {
    bits ^= bits << shift;
  }
  return bits;
}

/// Sums rows of toggles along the columns and writes each running sum as bytes.
class RunningParity
{
public:
  RunningParity(const ToggleBits& toggles, Volume& result)
    : Toggles(toggles)
    , Result(result)
    , Width(result.Grid.Size(0))
  {
  }

  /// Columns along x, rows [begin, end) of the whole grid.
  void AlongX(std::int64_t begin, std::int64_t end)
  {
    const int rows = this->Result.Grid.Size(1);
    for (std::int64_t row = begin; row < end; ++row)
    {
      const int j = static_cast<int>(row % rows);
      const int k = static_cast<int>(row / rows);
      const std::atomic<Word>* toggles = this->Toggles.Row(j, k);
      Word inside = 0;
      for (int word = 0; word < this->Toggles.GetWordsPerRow(); ++word)
      {
        const Word bits = inside ^ ParityScan(toggles[word].load(std::memory_order_relaxed));
        this->Write(bits, word, j, k);
        inside = Word{ 0 } - (bits >> (BitsPerWord - 1));
      }
    }
  }

  /// Columns along y, slices [begin, end) along z.
  void AlongY(std::int64_t begin, std::int64_t end)
  {
    for (auto k = static_cast<int>(begin); k < end; ++k)
    {
      std::vector<Word> inside(this->Toggles.GetWordsPerRow(), 0);
      for (int j = 0; j < this->Result.Grid.Size(1); ++j)
      {
        this->AddRow(inside.data(), j, k);
      }
    }
  }

  /// Columns along z, rows [begin, end) of each slice.
  void AlongZ(std::int64_t begin, std::int64_t end)
  {
    const std::int64_t width = this->Toggles.GetWordsPerRow();
    std::vector<Word> inside(width * (end - begin), 0);
    for (int k = 0; k < this->Result.Grid.Size(2); ++k)
    {
      for (auto j = static_cast<int>(begin); j < end; ++j)
      {
        this->AddRow(inside.data() + width * (j - begin), j, k);
      }
    }
  }

private:
  void AddRow(Word* inside, int j, int k)
  {
    const std::atomic<Word>* toggles = this->Toggles.Row(j, k);
    for (int word = 0; word < this->Toggles.GetWordsPerRow(); ++word)
    {
      inside[word] ^= toggles[word].load(std::memory_order_relaxed);
      this->Write(inside[word], word, j, k);
    }
  }

  void Write(Word bits, int word, int j, int k)
  {
    const int first = word * BitsPerWord;
    const std::size_t row = static_cast<std::size_t>(k) * this->Result.Grid.Size(1) + j;
    WriteBits(bits, this->Result.Voxels.get() + row * this->Width + first,
      std::min(BitsPerWord, this->Width - first));
  }

  const ToggleBits& Toggles;
  Volume& Result;
  int Width;
};

void SumParity(const ToggleBits& toggles, Axis column, int threads, Volume& result)
{
  const Grid& grid = result.Grid;
  const auto grain = [threads](std::int64_t count)
  { return std::max<std::int64_t>(1, count / (4 * threads)); };
  const auto rows = static_cast<std::int64_t>(grid.Size(1)) * grid.Size(2);
  RunningParity parity(toggles, result);
  switch (column)
  {
    case Axis::X:
      ParallelFor(rows, grain(rows), threads,
        [&](std::int64_t begin, std::int64_t end, int) { parity.AlongX(begin, end); });
      break;
    case Axis::Y:
      ParallelFor(grid.Size(2), grain(grid.Size(2)), threads,
        [&](std::int64_t begin, std::int64_t end, int) { parity.AlongY(begin, end); });
      break;
    case Axis::Z:
      ParallelFor(grid.Size(1), grain(grid.Size(1)), threads,
        [&](std::int64_t begin, std::int64_t end, int) { parity.AlongZ(begin, end); });
      break;
  }
}

Voxel ToVoxel(const Crossing& crossing, const AxisOrder& order)
{
  Voxel voxel{};
  voxel[order.U] = crossing.U;
  voxel[order.V] = crossing.V;
  voxel[order.C] = crossing.Depth;
  return voxel;
}

//------------------------------------------------------------------------------------------------
// Reading the polydata
//------------------------------------------------------------------------------------------------

template <typename GetCoordinate>
void MapPointRange(std::int64_t begin, std::int64_t end, const Grid& grid, Vector* mapped,
  GetCoordinate&& coordinate)
{
  for (std::int64_t point = begin; point < end; ++point)
  {
    mapped[point] =
      grid.ToIndex({ coordinate(point, 0), coordinate(point, 1), coordinate(point, 2) });
  }
}

void AppendFan(const vtkIdType* points, vtkIdType count, std::vector<vtkTypeInt64>& triangles)
{
  for (vtkIdType point = 2; point < count; ++point)
  {
    triangles.insert(triangles.end(), { points[0], points[point - 1], points[point] });
  }
}

void AppendStrip(const vtkIdType* points, vtkIdType count, std::vector<vtkTypeInt64>& triangles)
{
  for (vtkIdType point = 2; point < count; ++point)
  {
    const bool odd = point % 2 != 0;
    triangles.insert(triangles.end(),
      { points[odd ? point - 1 : point - 2], points[odd ? point - 2 : point - 1], points[point] });
  }
}

template <typename Append>
void AppendCells(vtkCellArray* cells, std::vector<vtkTypeInt64>& triangles, Append&& append)
{
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    cells->GetCellAtId(cell, count, points);
    append(points, count, triangles);
  }
}

} // namespace

//------------------------------------------------------------------------------------------------
AxisOrder::AxisOrder(Axis column)
  : U(column == Axis::X ? 1 : 0)
  , V(column == Axis::Z ? 1 : 2)
  , C(static_cast<int>(column))
{
}

//------------------------------------------------------------------------------------------------
Grid Grid::FromImage(vtkImageData* image)
{
  Grid grid;
  image->GetExtent(grid.Extent.data());
  image->GetOrigin(grid.Origin.data());
  const double* physicalToIndex = image->GetPhysicalToIndexMatrix()->GetData();
  for (int row = 0; row < 3; ++row)
  {
    std::copy_n(physicalToIndex + 4 * row, 3, grid.Linear.begin() + 3 * row);
  }
  return grid;
}

//------------------------------------------------------------------------------------------------
Grid Grid::FromSpacing(
  const std::array<int, 6>& extent, const Vector& origin, const Vector& spacing)
{
  Grid grid;
  grid.Extent = extent;
  grid.Origin = origin;
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.Linear[4 * axis] = 1.0 / spacing[axis];
  }
  return grid;
}

//------------------------------------------------------------------------------------------------
Grid Grid::FromMatrix(const std::array<int, 6>& extent, const std::array<double, 16>& worldToIndex)
{
  Grid grid;
  grid.Extent = extent;
  for (int row = 0; row < 3; ++row)
  {
    std::copy_n(worldToIndex.begin() + 4 * row, 3, grid.Linear.begin() + 3 * row);
    grid.Shift[row] = worldToIndex[4 * row + 3];
  }
  return grid;
}

//------------------------------------------------------------------------------------------------
Grid Grid::AroundBounds(const double bounds[6], int n, int padding)
{
  const double longest =
    std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  const double spacing = longest / (n - 2 * padding);
  Vector origin;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double centre = 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
    origin[axis] = centre - 0.5 * (n - 1) * spacing;
  }
  return Grid::FromSpacing({ 0, n - 1, 0, n - 1, 0, n - 1 }, origin, { spacing, spacing, spacing });
}

//------------------------------------------------------------------------------------------------
std::size_t Grid::NumberOfVoxels() const
{
  return static_cast<std::size_t>(this->Size(0)) * this->Size(1) * this->Size(2);
}

//------------------------------------------------------------------------------------------------
std::size_t Grid::Offset(const Voxel& voxel) const
{
  const std::size_t row = static_cast<std::size_t>(voxel[2] - this->Extent[4]) * this->Size(1) +
    (voxel[1] - this->Extent[2]);
  return row * this->Size(0) + (voxel[0] - this->Extent[0]);
}

//------------------------------------------------------------------------------------------------
Voxel Grid::VoxelAt(std::size_t offset) const
{
  const std::size_t row = offset / this->Size(0);
  return { this->Extent[0] + static_cast<int>(offset % this->Size(0)),
    this->Extent[2] + static_cast<int>(row % this->Size(1)),
    this->Extent[4] + static_cast<int>(row / this->Size(1)) };
}

//------------------------------------------------------------------------------------------------
bool Grid::Contains(const Voxel& voxel) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (voxel[axis] < this->Extent[2 * axis] || voxel[axis] > this->Extent[2 * axis + 1])
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------------------------
Vector Grid::ToIndex(const Vector& world) const
{
  const double x = world[0] - this->Origin[0];
  const double y = world[1] - this->Origin[1];
  const double z = world[2] - this->Origin[2];
  const auto& m = this->Linear;
  return { m[0] * x + m[1] * y + m[2] * z + this->Shift[0],
    m[3] * x + m[4] * y + m[5] * z + this->Shift[1],
    m[6] * x + m[7] * y + m[8] * z + this->Shift[2] };
}

//------------------------------------------------------------------------------------------------
Vector Grid::ToWorld(const Voxel& voxel) const
{
  vtkNew<vtkMatrix4x4> matrix;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      matrix->SetElement(row, column, this->Linear[3 * row + column]);
    }
  }
  matrix->Invert();
  const double index[4] = { voxel[0] - this->Shift[0], voxel[1] - this->Shift[1],
    voxel[2] - this->Shift[2], 1.0 };
  double world[4];
  matrix->MultiplyPoint(index, world);
  return { world[0] + this->Origin[0], world[1] + this->Origin[1], world[2] + this->Origin[2] };
}

//------------------------------------------------------------------------------------------------
Volume::Volume(const VoxelReference::Grid& grid)
  : Grid(grid)
  , Voxels(new unsigned char[grid.NumberOfVoxels()])
{
}

//------------------------------------------------------------------------------------------------
std::size_t Volume::CountNonZero() const
{
  const unsigned char* begin = this->Voxels.get();
  const std::size_t size = this->Grid.NumberOfVoxels();
  return size - static_cast<std::size_t>(std::count(begin, begin + size, 0));
}

//------------------------------------------------------------------------------------------------
IndexMesh::IndexMesh(vtkPolyData* mesh, const Grid& grid, int threads)
{
  this->MapPoints(mesh, grid, threads);
  this->CollectTriangles(mesh);
}

//------------------------------------------------------------------------------------------------
Triangle IndexMesh::GetTriangle(std::int64_t triangle) const
{
  const vtkTypeInt64* ids = this->GetPointIds(triangle);
  return { this->Points[ids[0]], this->Points[ids[1]], this->Points[ids[2]] };
}

//------------------------------------------------------------------------------------------------
void IndexMesh::MapPoints(vtkPolyData* mesh, const Grid& grid, int threads)
{
  const vtkIdType count = mesh->GetNumberOfPoints();
  this->Points.reset(new Vector[count]);
  if (count == 0)
  {
    return;
  }
  vtkDataArray* coordinates = mesh->GetPoints()->GetData();
  const auto mapAll = [&](const auto& coordinate)
  {
    ParallelFor(count, 8192, threads,
      [&](std::int64_t begin, std::int64_t end, int)
      { MapPointRange(begin, end, grid, this->Points.get(), coordinate); });
  };
  if (const auto* floats = vtkArrayDownCast<vtkFloatArray>(coordinates))
  {
    mapAll(
      [floats](std::int64_t point, int axis) { return floats->GetTypedComponent(point, axis); });
  }
  else
  {
    mapAll([coordinates](std::int64_t point, int axis)
      { return coordinates->GetComponent(point, axis); });
  }
}

//------------------------------------------------------------------------------------------------
void IndexMesh::CollectTriangles(vtkPolyData* mesh)
{
  vtkCellArray* polys = mesh->GetPolys();
  vtkCellArray* strips = mesh->GetStrips();
  auto* connectivity = vtkArrayDownCast<vtkTypeInt64Array>(polys->GetConnectivityArray());
  if (connectivity && strips->GetNumberOfCells() == 0 && polys->IsHomogeneous() == 3)
  {
    this->Connectivity = connectivity->GetPointer(0);
    this->NumberOfTriangles = polys->GetNumberOfCells();
    return;
  }
  AppendCells(polys, this->OwnConnectivity, AppendFan);
  AppendCells(strips, this->OwnConnectivity, AppendStrip);
  this->Connectivity = this->OwnConnectivity.data();
  this->NumberOfTriangles = static_cast<std::int64_t>(this->OwnConnectivity.size() / 3);
}

//------------------------------------------------------------------------------------------------
Volume CrossingParityReference(vtkPolyData* mesh, const Grid& grid, Axis column, int threads)
{
  const IndexMesh triangles(mesh, grid, threads);
  const ColumnFrame frame(grid, column);
  ToggleBits toggles(grid, threads);
  ParallelFor(triangles.GetNumberOfTriangles(), 4096, threads,
    [&](std::int64_t begin, std::int64_t end, int)
    {
      VisitCrossings(triangles, begin, end, frame,
        [&](const Crossing& crossing) { toggles.Toggle(ToVoxel(crossing, frame.Order)); });
    });

  Volume result(grid);
  SumParity(toggles, column, threads, result);
  return result;
}

//------------------------------------------------------------------------------------------------
Volume CrossingNonZeroReference(vtkPolyData* mesh, const Grid& grid, Axis column)
{
  const IndexMesh triangles(mesh, grid);
  const ColumnFrame frame(grid, column);
  std::vector<int> winding(grid.NumberOfVoxels(), 0);
  VisitCrossings(triangles, 0, triangles.GetNumberOfTriangles(), frame,
    [&](const Crossing& crossing)
    { winding[grid.Offset(ToVoxel(crossing, frame.Order))] += crossing.Orientation; });

  Volume result(grid);
  for (std::size_t offset = 0; offset < winding.size(); ++offset)
  {
    Voxel previous = grid.VoxelAt(offset);
    if (--previous[frame.Order.C] >= frame.CLow)
    {
      winding[offset] += winding[grid.Offset(previous)];
    }
    result.Voxels[offset] = winding[offset] != 0;
  }
  return result;
}

//------------------------------------------------------------------------------------------------
Volume SolidReference(vtkPolyData* mesh, const Grid& grid, Axis column, FillRule rule)
{
  return rule == FillRule::Parity ? CrossingParityReference(mesh, grid, column)
                                  : CrossingNonZeroReference(mesh, grid, column);
}

}
