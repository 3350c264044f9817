/**
 * @file   VoxelComparison.h
 * @brief  Compares occupancies with each other and says in one line what differs.
 *
 * The usual test:
 * @code
 * const Volume expected = CrossingParityReference(mesh, Grid::FromImage(image), axis);
 * const Difference difference = Compare(image, expected);
 * ok &= Report("bunny 128 seed 7", difference, mesh, 1e-4);
 * @endcode
 */
#ifndef VoxelComparison_h
#define VoxelComparison_h

#include "VoxelReference.h"

#include <string>
#include <vector>

class vtkImageData;
class vtkPolyData;

namespace VoxelReference
{

/// Where two occupancies differ.
struct Difference
{
  VoxelReference::Grid Grid;
  std::string Problem;        ///< not empty: they could not be compared, and why
  std::size_t Compared = 0;   ///< voxels
  std::size_t Expected = 0;   ///< voxels occupied in the reference
  std::vector<Voxel> Missing; ///< occupied in the reference alone
  std::vector<Voxel> Extra;   ///< occupied in the result alone

  bool IsComparable() const { return this->Problem.empty(); }
  bool IsNone() const { return this->Problem.empty() && this->Count() == 0; }
  std::size_t Count() const { return this->Missing.size() + this->Extra.size(); }
  std::vector<Voxel> All() const;
  /// "2 of 4096 voxels differ (1 missing, 1 extra; 300 expected), first -(3, 4, 5) +(6, 7, 8)"
  std::string Summary(std::size_t listed = 6) const;
};

/**
 * The occupancy of an image as 0 or 1 a voxel: the array "Occupancy", else the active scalars, of
 * the points, else of the cells; of any numeric type or vtkBitArray. A voxel has the index of its
 * point or of its cell. Throws std::runtime_error when there is no such array or its size is wrong.
 */
Volume OccupancyOf(vtkImageData* image);

/// Any value other than 0 counts as occupied. The extents have to be equal.
Difference Compare(const Volume& result, const Volume& reference);
Difference Compare(vtkImageData* result, const Volume& reference);

/// How far the differences are from the surface, and the columns where it matters.
struct SurfaceDeviation
{
  double Largest = 0.0;           ///< in voxels; infinity when beyond one voxel
  std::size_t Beyond = 0;         ///< differences farther than the tolerance
  std::size_t LeakingColumns = 0; ///< columns that hold one of those
  Voxel Worst{ 0, 0, 0 };
};
SurfaceDeviation DeviationFromSurface(
  const Difference& difference, vtkPolyData* mesh, double tolerance, Axis column = Axis::Z);

/// Columns whose last voxel is occupied. There is none for a closed mesh within the grid, whatever
/// the rounding: this finds leaks without a reference.
std::size_t CountColumnsOpenAtEnd(const Volume& volume, Axis column);

/// True when all differences lie within `tolerance` voxels of the surface. With a tolerance of 0,
/// or without the mesh, there may be none, not even on the surface itself. Otherwise prints one
/// line that starts with `name`, which should tell mesh, grid and seed.
bool Report(const std::string& name, const Difference& difference, vtkPolyData* mesh = nullptr,
  double tolerance = 0.0, Axis column = Axis::Z);

///@{
/**
 * For the conservative modes: `touched` comes from TouchedVoxelsReference, `solid` from
 * SolidReference. A voxel that is touched nearly, but not surely, may be occupied or not; apart
 * from these the result has to be
 * - over-conservative: the voxels that are touched, and the others that are solid;
 * - under-conservative: the voxels that are solid and not touched;
 * - boundary: the voxels that are touched; so a surface is checked too, with ThinVoxelsReference
 * for a thin one. False, and one line that starts with `name`, when it is not.
 */
bool ReportOverConservative(
  const std::string& name, const Volume& result, const Volume& touched, const Volume& solid);
bool ReportUnderConservative(
  const std::string& name, const Volume& result, const Volume& touched, const Volume& solid);
bool ReportBoundary(const std::string& name, const Volume& result, const Volume& touched);
///@}

}

#endif
