#include "VoxelComparison.h"

#include "VoxelSurfaceReference.h"

#include <vtkBitArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <iostream>
#include <set>
#include <sstream>
#include <stdexcept>

namespace VoxelReference
{
namespace
{

vtkDataArray* FindOccupancy(vtkDataSetAttributes* attributes)
{
  vtkDataArray* array = attributes->GetArray("Occupancy");
  return array ? array : attributes->GetScalars();
}

/// The image's cells as voxels; their centres lie half a voxel beyond the points of the same index.
Grid GridOfCells(vtkImageData* image)
{
  Grid grid = Grid::FromImage(image);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (grid.Size(axis) > 1)
    {
      grid.Extent[2 * axis + 1] -= 1;
      grid.Shift[axis] = -0.5;
    }
  }
  return grid;
}

std::string ToString(const std::array<int, 6>& extent)
{
  std::ostringstream out;
  out << extent[0] << ".." << extent[1] << " x " << extent[2] << ".." << extent[3] << " x "
      << extent[4] << ".." << extent[5];
  return out.str();
}

/// A difference with no voxels yet; says so when the grids do not fit.
Difference BeginComparison(const Volume& result, const Volume& reference)
{
  Difference difference;
  difference.Grid = reference.Grid;
  if (result.Grid.Extent != reference.Grid.Extent)
  {
    difference.Problem = "the extent is " + ToString(result.Grid.Extent) + " instead of " +
      ToString(reference.Grid.Extent);
    return difference;
  }
  difference.Compared = reference.Grid.NumberOfVoxels();
  return difference;
}

void AppendVoxels(
  std::ostream& out, const char* sign, const std::vector<Voxel>& voxels, std::size_t listed)
{
  for (std::size_t number = 0; number < std::min(listed, voxels.size()); ++number)
  {
    const Voxel& voxel = voxels[number];
    out << ' ' << sign << '(' << voxel[0] << ", " << voxel[1] << ", " << voxel[2] << ')';
  }
}

/// Prints a line and answers false when `isRequired(v)` or `isForbidden(v)` is violated somewhere.
template <typename Required, typename Forbidden>
bool ReportBounds(const std::string& name, const Volume& result, const Volume& touched,
  Required&& isRequired, Forbidden&& isForbidden)
{
  Difference difference = BeginComparison(result, touched);
  for (std::size_t offset = 0; offset < difference.Compared; ++offset)
  {
    const bool required = isRequired(offset);
    difference.Expected += required ? 1 : 0;
    if (required && result.Voxels[offset] == 0)
    {
      difference.Missing.push_back(touched.Grid.VoxelAt(offset));
    }
    else if (isForbidden(offset) && result.Voxels[offset] != 0)
    {
      difference.Extra.push_back(touched.Grid.VoxelAt(offset));
    }
  }
  return Report(name, difference);
}

}

//------------------------------------------------------------------------------------------------
std::vector<Voxel> Difference::All() const
{
  std::vector<Voxel> all = this->Missing;
  all.insert(all.end(), this->Extra.begin(), this->Extra.end());
  return all;
}

//------------------------------------------------------------------------------------------------
std::string Difference::Summary(std::size_t listed) const
{
  if (!this->IsComparable())
  {
    return "not comparable: " + this->Problem;
  }
  std::ostringstream out;
  out << this->Count() << " of " << this->Compared << " voxels differ (" << this->Missing.size()
      << " missing, " << this->Extra.size() << " extra; " << this->Expected << " expected)";
  if (this->Count() > 0)
  {
    out << ", first";
    AppendVoxels(out, "-", this->Missing, listed);
    AppendVoxels(out, "+", this->Extra, listed);
  }
  return out.str();
}

//------------------------------------------------------------------------------------------------
Volume OccupancyOf(vtkImageData* image)
{
  vtkDataArray* overPoints = FindOccupancy(image->GetPointData());
  vtkDataArray* array = overPoints ? overPoints : FindOccupancy(image->GetCellData());
  if (!array)
  {
    throw std::runtime_error("the image has neither an Occupancy array nor scalars");
  }
  const Grid grid = overPoints ? Grid::FromImage(image) : GridOfCells(image);
  const std::size_t size = grid.NumberOfVoxels();
  if (static_cast<std::size_t>(array->GetNumberOfValues()) != size)
  {
    throw std::runtime_error("the image has " + std::to_string(array->GetNumberOfValues()) +
      " values for " + std::to_string(size) + " voxels");
  }

  Volume occupancy(grid);
  if (const auto* bytes = vtkArrayDownCast<vtkUnsignedCharArray>(array))
  {
    for (std::size_t offset = 0; offset < size; ++offset)
    {
      occupancy.Voxels[offset] = bytes->GetValue(static_cast<vtkIdType>(offset)) != 0;
    }
  }
  else if (const auto* bits = vtkArrayDownCast<vtkBitArray>(array))
  {
    for (std::size_t offset = 0; offset < size; ++offset)
    {
      occupancy.Voxels[offset] = bits->GetValue(static_cast<vtkIdType>(offset)) != 0;
    }
  }
  else
  {
    for (std::size_t offset = 0; offset < size; ++offset)
    {
      occupancy.Voxels[offset] = array->GetTuple1(static_cast<vtkIdType>(offset)) != 0.0;
    }
  }
  return occupancy;
}

//------------------------------------------------------------------------------------------------
Difference Compare(const Volume& result, const Volume& reference)
{
  Difference difference = BeginComparison(result, reference);
  for (std::size_t offset = 0; offset < difference.Compared; ++offset)
  {
    const bool expected = reference.Voxels[offset] != 0;
    const bool found = result.Voxels[offset] != 0;
    difference.Expected += expected ? 1 : 0;
    if (expected != found)
    {
      (expected ? difference.Missing : difference.Extra).push_back(reference.Grid.VoxelAt(offset));
    }
  }
  return difference;
}

//------------------------------------------------------------------------------------------------
Difference Compare(vtkImageData* result, const Volume& reference)
{
  Difference difference;
  difference.Grid = reference.Grid;
  if (!result)
  {
    difference.Problem = "there is no image";
    return difference;
  }
  try
  {
    return Compare(OccupancyOf(result), reference);
  }
  catch (const std::runtime_error& error)
  {
    difference.Problem = error.what();
    return difference;
  }
}

//------------------------------------------------------------------------------------------------
SurfaceDeviation DeviationFromSurface(
  const Difference& difference, vtkPolyData* mesh, double tolerance, Axis column)
{
  const AxisOrder order(column);
  const std::vector<Voxel> voxels = difference.All();
  const std::vector<double> distances = DistanceToSurface(mesh, difference.Grid, voxels);
  SurfaceDeviation deviation;
  std::set<std::array<int, 2>> leaking;
  for (std::size_t number = 0; number < voxels.size(); ++number)
  {
    if (distances[number] > deviation.Largest)
    {
      deviation.Largest = distances[number];
      deviation.Worst = voxels[number];
    }
    if (distances[number] > tolerance)
    {
      ++deviation.Beyond;
      leaking.insert({ voxels[number][order.U], voxels[number][order.V] });
    }
  }
  deviation.LeakingColumns = leaking.size();
  return deviation;
}

//------------------------------------------------------------------------------------------------
std::size_t CountColumnsOpenAtEnd(const Volume& volume, Axis column)
{
  const AxisOrder order(column);
  const std::array<int, 6>& extent = volume.Grid.Extent;
  Voxel voxel{};
  voxel[order.C] = extent[2 * order.C + 1];
  std::size_t open = 0;
  for (int v = extent[2 * order.V]; v <= extent[2 * order.V + 1]; ++v)
  {
    for (int u = extent[2 * order.U]; u <= extent[2 * order.U + 1]; ++u)
    {
      voxel[order.U] = u;
      voxel[order.V] = v;
      open += volume.At(voxel) != 0 ? 1 : 0;
    }
  }
  return open;
}

//------------------------------------------------------------------------------------------------
bool Report(const std::string& name, const Difference& difference, vtkPolyData* mesh,
  double tolerance, Axis column)
{
  if (difference.IsNone())
  {
    return true;
  }
  if (!difference.IsComparable() || !mesh)
  {
    std::cerr << name << ": " << difference.Summary() << '\n';
    return false;
  }
  const SurfaceDeviation deviation = DeviationFromSurface(difference, mesh, tolerance, column);
  if (tolerance > 0.0 && deviation.Beyond == 0)
  {
    return true;
  }
  const Voxel& worst = deviation.Worst;
  std::cerr << name << ": " << difference.Summary() << "; " << deviation.Beyond << " farther than "
            << tolerance << " voxel from the surface, at most " << deviation.Largest << " at ("
            << worst[0] << ", " << worst[1] << ", " << worst[2] << "), in "
            << deviation.LeakingColumns << " columns\n";
  return false;
}

//------------------------------------------------------------------------------------------------
bool ReportOverConservative(
  const std::string& name, const Volume& result, const Volume& touched, const Volume& solid)
{
  const auto isRequired = [&](std::size_t offset)
  {
    const unsigned char touch = touched.Voxels[offset];
    return (touch & TouchedSurely) != 0 || (touch == 0 && solid.Voxels[offset] != 0);
  };
  const auto isForbidden = [&](std::size_t offset)
  { return touched.Voxels[offset] == 0 && solid.Voxels[offset] == 0; };
  return ReportBounds(name, result, touched, isRequired, isForbidden);
}

//------------------------------------------------------------------------------------------------
bool ReportUnderConservative(
  const std::string& name, const Volume& result, const Volume& touched, const Volume& solid)
{
  const auto isRequired = [&](std::size_t offset)
  { return touched.Voxels[offset] == 0 && solid.Voxels[offset] != 0; };
  const auto isForbidden = [&](std::size_t offset)
  {
    const unsigned char touch = touched.Voxels[offset];
    return (touch & TouchedSurely) != 0 || (touch == 0 && solid.Voxels[offset] == 0);
  };
  return ReportBounds(name, result, touched, isRequired, isForbidden);
}

//------------------------------------------------------------------------------------------------
bool ReportBoundary(const std::string& name, const Volume& result, const Volume& touched)
{
  const auto isRequired = [&](std::size_t offset)
  { return (touched.Voxels[offset] & TouchedSurely) != 0; };
  const auto isForbidden = [&](std::size_t offset) { return touched.Voxels[offset] == 0; };
  return ReportBounds(name, result, touched, isRequired, isForbidden);
}

}
