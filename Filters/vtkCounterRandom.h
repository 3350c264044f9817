// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkCounterRandom.h
 * Private header: random numbers that are functions of a seed and of counters, in integers alone,
 * so that they are the same on every machine and can be had in any order.
 *
 * Philox 4x32 with ten rounds: Salmon, Moraes, Dror, Shaw: Parallel Random Numbers: As Easy as 1,
 * 2,
 * 3. SC 2011, section 3.3.
 */

#ifndef vtkCounterRandom_h
#define vtkCounterRandom_h

#include <array>
#include <cstdint>

/// A sequence of 32-bit numbers, one of 2^96 for each seed.
class vtkCounterRandom
{
public:
  using Block = std::array<std::uint32_t, 4>;

  vtkCounterRandom(std::uint64_t seed, std::uint64_t sequence, std::uint32_t stream)
    : Key{ Low(seed), High(seed) }
    , Counter{ 0, stream, Low(sequence), High(sequence) }
  {
  }

  std::uint32_t Next()
  {
    if (this->Used == this->Numbers.size())
    {
      this->Numbers = Philox(this->Counter, this->Key);
      ++this->Counter[0];
      this->Used = 0;
    }
    return this->Numbers[this->Used++];
  }

  /// From 0 up to, but without, 1, in steps of 2^-32.
  double NextUniform() { return this->Next() * 0x1p-32; }

  /// From -1 to 1, in steps of 2^-31, in the middle of each.
  double NextSigned() { return (this->Next() + 0.5) * 0x1p-31 - 1.0; }

  /// Mean 0, standard deviation 1: the sum of twelve uniform numbers, which is normal but for a few
  /// thousandths and never beyond 6.
  double NextNormal()
  {
    constexpr int terms = 12;
    constexpr double bits = 65536.0;
    std::uint32_t sum = 0;
    for (int i = 0; i < terms; i += 2)
    {
      const std::uint32_t two = this->Next();
      sum += (two >> 16) + (two & 0xffffu);
    }
    return (sum + 0.5 * terms) / bits - 0.5 * terms;
  }

  static Block Philox(Block counter, std::array<std::uint32_t, 2> key)
  {
    constexpr int rounds = 10;
    for (int round = 0; round < rounds; ++round)
    {
      const std::uint64_t first = std::uint64_t(0xd2511f53u) * counter[0];
      const std::uint64_t second = std::uint64_t(0xcd9e8d57u) * counter[2];
      counter = { High(second) ^ counter[1] ^ key[0], Low(second),
        High(first) ^ counter[3] ^ key[1], Low(first) };
      key[0] += 0x9e3779b9u;
      key[1] += 0xbb67ae85u;
    }
    return counter;
  }

private:
  static std::uint32_t Low(std::uint64_t x) { return static_cast<std::uint32_t>(x); }
  static std::uint32_t High(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); }

  std::array<std::uint32_t, 2> Key;
  Block Counter;
  Block Numbers{};
  std::size_t Used = 4;
};

#endif
// VTK-HeaderTest-Exclude: vtkCounterRandom.h
