// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkPlaceHash.h
 * Private header: hashes of points, and those at the same place.
 */

#ifndef vtkPlaceHash_h
#define vtkPlaceHash_h

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

/// The finalizer of SplitMix64.
inline std::uint64_t vtkHashBits(std::uint64_t x)
{
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 27) * 0x94d049bb133111ebu;
  return x ^ x >> 31;
}

/// The same for points with equal coordinates, 0 and -0 being equal.
inline std::uint64_t vtkHashPlace(const double place[3])
{
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double unsignedZero = place[axis] + 0.0;
    std::uint64_t bits;
    std::memcpy(&bits, &unsignedZero, sizeof(bits));
    hash = vtkHashBits(hash + bits);
  }
  return hash;
}

/// For each point the first one at the same place.
inline std::vector<std::uint32_t> vtkFindPlaces(const std::vector<std::array<double, 3>>& points)
{
  // A hash table with open addressing, half full at most.
  constexpr std::uint32_t none = ~0u;
  std::size_t capacity = 2;
  while (capacity < 2 * points.size())
  {
    capacity *= 2;
  }
  std::vector<std::uint32_t> table(capacity, none);
  std::vector<std::uint32_t> places(points.size());
  for (std::uint32_t id = 0; id < points.size(); ++id)
  {
    std::size_t at = vtkHashPlace(points[id].data()) & (capacity - 1);
    while (table[at] != none && points[table[at]] != points[id])
    {
      at = (at + 1) & (capacity - 1);
    }
    table[at] = std::min(table[at], id);
    places[id] = table[at];
  }
  return places;
}

#endif
// VTK-HeaderTest-Exclude: vtkPlaceHash.h
