#include "VoxelFlood.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

namespace VoxelReference
{
namespace
{

Grid Grown(Grid grid, int layers)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.Extent[2 * axis] -= layers;
    grid.Extent[2 * axis + 1] += layers;
  }
  return grid;
}

/// Steps to the neighbours, as differences of offsets.
std::vector<std::ptrdiff_t> NeighbourSteps(const Grid& grid, int connectivity)
{
  if (connectivity != 6 && connectivity != 18 && connectivity != 26)
  {
    throw std::invalid_argument("no connectivity: " + std::to_string(connectivity));
  }
  const int most = connectivity == 6 ? 1 : connectivity == 18 ? 2 : 3;
  std::vector<std::ptrdiff_t> steps;
  for (int k = -1; k <= 1; ++k)
  {
    for (int j = -1; j <= 1; ++j)
    {
      for (int i = -1; i <= 1; ++i)
      {
        const int changed = std::abs(i) + std::abs(j) + std::abs(k);
        if (changed > 0 && changed <= most)
        {
          steps.push_back((static_cast<std::ptrdiff_t>(k) * grid.Size(1) + j) * grid.Size(0) + i);
        }
      }
    }
  }
  return steps;
}

/// Of a voxel.
enum State : unsigned char
{
  Closed,
  Open,
  Reached
};

/// Calls visit(offset in the grid, offset in the larger one) for the first voxel of each row.
template <typename Visitor>
void VisitRows(const Grid& grid, const Grid& larger, Visitor&& visit)
{
  const std::array<int, 6>& extent = grid.Extent;
  for (int k = extent[4]; k <= extent[5]; ++k)
  {
    for (int j = extent[2]; j <= extent[3]; ++j)
    {
      const Voxel first{ extent[0], j, k };
      visit(grid.Offset(first), larger.Offset(first));
    }
  }
}

/// Sets all open voxels to Reached that can be reached from the one at `start`, and counts them.
std::size_t Spread(
  unsigned char* states, std::size_t start, const std::vector<std::ptrdiff_t>& steps)
{
  std::vector<std::size_t> front;
  std::vector<std::size_t> next{ start };
  states[start] = Reached;
  std::size_t count = 1;
  while (!next.empty())
  {
    front.swap(next);
    next.clear();
    for (const std::size_t offset : front)
    {
      for (const std::ptrdiff_t step : steps)
      {
        if (states[offset + step] == Open)
        {
          states[offset + step] = Reached;
          next.push_back(offset + step);
        }
      }
    }
    count += next.size();
  }
  return count;
}

/// Gives the voxels of a volume their states in the closed grid around it.
void Mark(const Volume& volume, State set, State unset, const Grid& closed, unsigned char* states)
{
  const Grid& grid = volume.Grid;
  VisitRows(grid, closed,
    [&](std::size_t from, std::size_t to)
    {
      std::transform(&volume.Voxels[from], &volume.Voxels[from] + grid.Size(0), &states[to],
        [&](unsigned char voxel) { return voxel != 0 ? set : unset; });
    });
}

/// The voxels of a grid that are Reached in the closed grid around it.
Volume GetReached(const Grid& grid, const Grid& closed, const unsigned char* states)
{
  Volume reached(grid);
  VisitRows(grid, closed,
    [&](std::size_t to, std::size_t from)
    {
      std::transform(&states[from], &states[from] + grid.Size(0), &reached.Voxels[to],
        [](unsigned char state) { return state == Reached; });
    });
  return reached;
}

}

//------------------------------------------------------------------------------------------------
Volume FloodFromOutside(const Volume& barrier, int connectivity)
{
  const Grid& grid = barrier.Grid;
  const Grid outside = Grown(grid, 1);
  const Grid closed = Grown(grid, 2); // its outermost layer keeps the flood in
  const std::vector<std::ptrdiff_t> steps = NeighbourSteps(closed, connectivity);
  std::vector<unsigned char> states(closed.NumberOfVoxels(), Closed);
  VisitRows(outside, closed,
    [&](std::size_t, std::size_t row) { std::fill_n(&states[row], outside.Size(0), Open); });
  Mark(barrier, Closed, Open, closed, states.data());
  Spread(states.data(), closed.Offset({ outside.Extent[0], outside.Extent[2], outside.Extent[4] }),
    steps);
  return GetReached(grid, closed, states.data());
}

//------------------------------------------------------------------------------------------------
Volume LargestFlood(const Volume& voxels, int connectivity)
{
  const Grid closed = Grown(voxels.Grid, 1);
  const std::vector<std::ptrdiff_t> steps = NeighbourSteps(closed, connectivity);
  std::vector<unsigned char> states(closed.NumberOfVoxels(), Closed);
  Mark(voxels, Open, Closed, closed, states.data());
  std::size_t most = 0;
  std::size_t start = 0;
  for (std::size_t offset = 0; offset < states.size(); ++offset)
  {
    const std::size_t count = states[offset] == Open ? Spread(states.data(), offset, steps) : 0;
    if (count > most)
    {
      most = count;
      start = offset;
    }
  }
  Mark(voxels, Open, Closed, closed, states.data());
  if (most > 0)
  {
    Spread(states.data(), start, steps);
  }
  return GetReached(voxels.Grid, closed, states.data());
}

}
