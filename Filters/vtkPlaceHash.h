// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkPlaceHash.h
 * Private header: hashes of points, by which those at the same place are found.
 */

#ifndef vtkPlaceHash_h
#define vtkPlaceHash_h

#include <cstdint>
#include <cstring>

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

#endif
// VTK-HeaderTest-Exclude: vtkPlaceHash.h
