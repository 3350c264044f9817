/**
 * @file   VoxelReference.h
 * @brief  Reference solid voxelization on the CPU: a scanline in double arithmetic.
 *
 * This is the tests' oracle and the yardstick of the benchmarks. It shares no code with the module.
 *
 * ## Grid
 * A voxel is addressed by its integer index (i, j, k) inside an inclusive extent. Its centre is the
 * point with these index coordinates. World points are mapped to index coordinates in double.
 *
 * ## Rule
 * Let c be the column axis, u and v the other two: (u, v, c) is (x, y, z) for c = z, (x, z, y) for
 * c = y and (y, z, x) for c = x. All lie in index coordinates.
 * - An edge crosses the integer row v iff exactly one of its ends has an ordinate <= v. Its end
 *   points are put in order of increasing ordinate first, so the two triangles at an edge compute
 *   the same crossing, U = au + (v - av) * (bu - au) / (bv - av), shared vertices or not. An edge
 *   with equal ordinates crosses no row, so this order is total where it matters.
 * - A triangle has no or two crossings in a row; it covers the columns ceil(Umin) <= u <
 * ceil(Umax). In a closed mesh every column is thus covered an even number of times, whatever the
 * rounding.
 * - In a covered column the surface is crossed at the depth z of the triangle's plane at (u, v),
 *   clamped to the depths of the triangle at its two edge crossings of that row.
 * - A voxel k lies behind a crossing iff z <= k. Parity: a voxel is solid iff it lies behind an odd
 *   number of crossings. NonZero: iff the sum of the crossings' orientations is not zero.
 *
 * So a solid is half open, [lower, upper), along all three axes: a box from 0 to 4 holds the
 * centres 0, 1, 2, 3. On points that are multiples of a (moderate) power of two all decisions are
 * exact, ties included. In general the computed crossing lies within 16 * 2^-53 * L of the surface,
 * where L is the largest index coordinate of the mesh in magnitude: below 1e-9 voxel for L < 5e5.
 */
#ifndef VoxelReference_h
#define VoxelReference_h

#include <vtkType.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

class vtkImageData;
class vtkPolyData;

namespace VoxelReference
{

using Vector = std::array<double, 3>;
using Voxel = std::array<int, 3>;
using Triangle = std::array<Vector, 3>;

enum class Axis
{
  X,
  Y,
  Z
};

enum class FillRule
{
  Parity,
  NonZero
};

constexpr std::array<Axis, 3> AllAxes = { Axis::X, Axis::Y, Axis::Z };
constexpr int DefaultThreads = 2;

/// The axes' numbers (0, 1, 2) in the roles that the rule gives them.
struct AxisOrder
{
  explicit AxisOrder(Axis column);
  int U;
  int V;
  int C;
};

/// The voxels and where they lie: index = Linear * (world - Origin) + Shift.
struct Grid
{
  std::array<int, 6> Extent{ 0, -1, 0, -1, 0, -1 };
  std::array<double, 9> Linear{ 1, 0, 0, 0, 1, 0, 0, 0, 1 }; ///< row by row
  Vector Origin{ 0, 0, 0 };
  Vector Shift{ 0, 0, 0 };

  /// The grid of the image's points: extent, spacing, origin and direction.
  static Grid FromImage(vtkImageData* image);

  /// An axis-aligned grid; `origin` is the centre of the voxel (0, 0, 0).
  static Grid FromSpacing(
    const std::array<int, 6>& extent, const Vector& origin, const Vector& spacing);

  /// An affine map given row by row, as in vtkMatrix4x4::GetData().
  static Grid FromMatrix(
    const std::array<int, 6>& extent, const std::array<double, 16>& worldToIndex);

  /// n^3 cubic voxels centred on the bounds; the longest side spans n - 2 * padding voxels.
  static Grid AroundBounds(const double bounds[6], int n, int padding = 1);

  int Size(int axis) const { return this->Extent[2 * axis + 1] - this->Extent[2 * axis] + 1; }
  std::size_t NumberOfVoxels() const;
  std::size_t Offset(const Voxel& voxel) const; ///< x runs fastest, as in vtkImageData
  Voxel VoxelAt(std::size_t offset) const;
  bool Contains(const Voxel& voxel) const;
  Vector ToIndex(const Vector& world) const;
  Vector ToWorld(const Voxel& voxel) const;
};

/// One unsigned char a voxel, x fastest. What it means depends on who filled it.
struct Volume
{
  explicit Volume(const Grid& grid); ///< the voxels are left uninitialized

  VoxelReference::Grid Grid;
  std::unique_ptr<unsigned char[]> Voxels;

  unsigned char At(const Voxel& voxel) const { return this->Voxels[this->Grid.Offset(voxel)]; }
  std::size_t CountNonZero() const;
};

/**
 * The triangles of a polydata with their points in index coordinates of a grid.
 * n-gons are split into fans around their first point, strips as VTK defines them; lines and
 * vertices are left out. Points must be finite. The polydata has to outlive the object and must not
 * change meanwhile.
 */
class IndexMesh
{
public:
  IndexMesh(vtkPolyData* mesh, const Grid& grid, int threads = DefaultThreads);

  std::int64_t GetNumberOfTriangles() const { return this->NumberOfTriangles; }
  const vtkTypeInt64* GetPointIds(std::int64_t triangle) const
  {
    return this->Connectivity + 3 * triangle;
  }
  const Vector& GetPoint(std::int64_t id) const { return this->Points[id]; }
  Triangle GetTriangle(std::int64_t triangle) const;

private:
  void MapPoints(vtkPolyData* mesh, const Grid& grid, int threads);
  void CollectTriangles(vtkPolyData* mesh);

  std::unique_ptr<Vector[]> Points;
  std::vector<vtkTypeInt64> OwnConnectivity; ///< used unless the polydata's own can be
  const vtkTypeInt64* Connectivity = nullptr;
  std::int64_t NumberOfTriangles = 0;
};

/// Solid by parity, 0 or 1 a voxel. This is the fast one: the yardstick of the benchmarks.
Volume CrossingParityReference(
  vtkPolyData* mesh, const Grid& grid, Axis column = Axis::Z, int threads = DefaultThreads);

/// Solid by winding number, 0 or 1 a voxel. Plain and slow: an int a voxel.
Volume CrossingNonZeroReference(vtkPolyData* mesh, const Grid& grid, Axis column = Axis::Z);

/// Either of the two.
Volume SolidReference(
  vtkPolyData* mesh, const Grid& grid, Axis column = Axis::Z, FillRule rule = FillRule::Parity);

}

#endif
