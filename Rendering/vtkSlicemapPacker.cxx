// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSlicemapPacker.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkBitArray.h"
#include "vtkSMPTools.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkSlicemap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#if defined(__SSE2__) || defined(_M_X64)
#include <emmintrin.h>
#endif

namespace
{
using Criterion = vtkSlicemapPacker::Criterion;

constexpr int WordBits = 32;

/// Values of type T from Lower to Upper; none when Lower is the larger one.
template <typename T>
struct Interval
{
  T Lower;
  T Upper;
};

template <typename T>
constexpr Interval<T> Nothing{ T(1), T(0) };

/// The integers in [lower, upper].
template <typename T>
Interval<T> IntegersWithin(double lower, double upper)
{
  // The last power of two may be beyond the type, but is exact as double, as the largest 64-bit
  // integer is not.
  constexpr auto smallest = static_cast<double>(std::numeric_limits<T>::min());
  const double beyond = std::ldexp(1.0, std::numeric_limits<T>::digits);
  const double first = std::ceil(lower);
  const double last = std::floor(upper);
  if (!(first < beyond && last >= smallest && first <= last))
  {
    return Nothing<T>;
  }
  return { first <= smallest ? std::numeric_limits<T>::min() : static_cast<T>(first),
    last >= beyond ? std::numeric_limits<T>::max() : static_cast<T>(last) };
}

/// The smallest float that is not less than x.
float RoundedUp(double x)
{
  constexpr float largest = std::numeric_limits<float>::max();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  if (x > largest)
  {
    return infinity;
  }
  if (x < -largest)
  {
    return std::isinf(x) ? -infinity : -largest;
  }
  const auto rounded = static_cast<float>(x);
  return rounded < x ? std::nextafter(rounded, infinity) : rounded;
}

template <typename T>
Interval<T> Within(const Criterion& criterion)
{
  if constexpr (std::is_same_v<T, double>)
  {
    return { criterion.Lower, criterion.Upper };
  }
  else if constexpr (std::is_same_v<T, float>)
  {
    return { RoundedUp(criterion.Lower), -RoundedUp(-criterion.Upper) };
  }
  else
  {
    return IntegersWithin<T>(criterion.Lower, criterion.Upper);
  }
}

using ByteMasks = std::array<unsigned char, WordBits>;

#if defined(__SSE2__) || defined(_M_X64)
/// One bit of each mask, the first one for the least significant bit.
std::uint32_t GatherBits(const ByteMasks& masks)
{
  const auto half = [&](int first)
  {
    const auto* bytes = reinterpret_cast<const __m128i*>(&masks[first]);
    return static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_loadu_si128(bytes)));
  };
  return half(0) | half(WordBits / 2) << WordBits / 2;
}
#else
/// One bit of each mask, the first one for the least significant bit.
std::uint32_t GatherBits(const ByteMasks& masks)
{
  constexpr int byteBits = 8;
  constexpr std::uint64_t oneOfEach = 0x0101010101010101u;
#ifdef VTK_WORDS_BIGENDIAN
  constexpr std::uint64_t toTopByte = 0x8040201008040201u;
#else
  constexpr std::uint64_t toTopByte = 0x0102040810204080u;
#endif
  std::uint32_t word = 0;
  for (int bit = 0; bit < WordBits; bit += byteBits)
  {
    std::uint64_t eight;
    std::memcpy(&eight, &masks[bit], sizeof(eight));
    word |= static_cast<std::uint32_t>((eight & oneOfEach) * toTopByte >> 56) << bit;
  }
  return word;
}
#endif

/// A plain loop without branches, which compilers turn into vector instructions.
template <typename T>
std::uint32_t PackWord(const T* values, T lower, T upper)
{
  ByteMasks within;
  for (int i = 0; i < WordBits; ++i)
  {
    const bool isWithin = (values[i] >= lower) & (values[i] <= upper);
    within[i] = static_cast<unsigned char>(-static_cast<int>(isWithin));
  }
  return GatherBits(within);
}

template <typename T>
struct Test
{
  Interval<T> Within;
  std::uint32_t Inversion;
};

/// The bits beyond the last value are zero.
template <typename T>
void PackBlock(const T* values, int count, const Test<T>& test, std::uint32_t* words)
{
  const auto [within, inversion] = test;
  const int fullWords = count / WordBits;
  for (int i = 0; i < fullWords; ++i)
  {
    words[i] = PackWord(values + i * WordBits, within.Lower, within.Upper) ^ inversion;
  }
  const int rest = count % WordBits;
  if (rest)
  {
    std::array<T, WordBits> last{};
    std::copy_n(values + fullWords * WordBits, rest, last.begin());
    const std::uint32_t used = (1u << rest) - 1;
    words[fullWords] = (PackWord(last.data(), within.Lower, within.Upper) ^ inversion) & used;
  }
}

/// `load(tuple, count, room)` gives `count` values from that tuple on, at a place which may be
/// `room`. All tests run on a block of them while it is in the cache.
template <typename T, typename Loader>
auto MakePacker(const Loader& load, int voxelsPerRow, std::int64_t wordsPerRow,
  const std::vector<Criterion>& criteria)
{
  constexpr int blockVoxels = 1024;
  std::vector<Test<T>> tests;
  for (const Criterion& criterion : criteria)
  {
    tests.push_back({ Within<T>(criterion), criterion.Inverted ? ~0u : 0u });
  }
  return [=](std::int64_t firstRow, std::int64_t rows, const std::vector<std::uint32_t*>& words)
  {
    std::array<T, blockVoxels> room;
    for (std::int64_t row = 0; row < rows; ++row)
    {
      const std::int64_t firstTuple = (firstRow + row) * voxelsPerRow;
      const std::int64_t firstWord = row * wordsPerRow;
      for (int x = 0; x < voxelsPerRow; x += blockVoxels)
      {
        const int count = std::min(blockVoxels, voxelsPerRow - x);
        const T* values = load(firstTuple + x, count, room.data());
        for (std::size_t i = 0; i < tests.size(); ++i)
        {
          PackBlock(values, count, tests[i], words[i] + firstWord + x / WordBits);
        }
      }
      const std::int64_t used = (voxelsPerRow + WordBits - 1) / WordBits;
      for (std::uint32_t* target : words)
      {
        std::fill(target + firstWord + used, target + firstWord + wordsPerRow, 0u);
      }
    }
  };
}

template <typename T>
auto LoadFromMemory(const T* memory, int stride)
{
  return [=](std::int64_t tuple, int count, T* room) -> const T*
  {
    const T* values = memory + tuple * stride;
    if (stride == 1)
    {
      return values;
    }
    for (int i = 0; i < count; ++i)
    {
      room[i] = values[std::int64_t(i) * stride];
    }
    return room;
  };
}

template <typename T, typename GetValue>
auto LoadOneByOne(GetValue getValue)
{
  return [=](std::int64_t tuple, int count, T* room) -> const T*
  {
    for (int i = 0; i < count; ++i)
    {
      room[i] = getValue(tuple + i);
    }
    return room;
  };
}
}

vtkSlicemapPacker::vtkSlicemapPacker(
  vtkDataArray* scalars, const vtkVoxelGrid& grid, const std::vector<Criterion>& criteria)
  : WordsPerRow(vtkSlicemap::GetWordsPerRow(grid))
{
  const int nx = grid.GetDimensions().x;
  switch (scalars->GetDataType())
  {
    vtkTemplateMacro(
      if (auto* tuples = vtkAOSDataArrayTemplate<VTK_TT>::FastDownCast(scalars)) {
        this->PackRows = MakePacker<VTK_TT>(
          LoadFromMemory<VTK_TT>(tuples->GetPointer(0), tuples->GetNumberOfComponents()), nx,
          this->WordsPerRow, criteria);
      } else if (auto* components = vtkSOADataArrayTemplate<VTK_TT>::FastDownCast(scalars)) {
        // Its components lie side by side again where somebody has asked for a pointer to all.
        this->PackRows = MakePacker<VTK_TT>(LoadOneByOne<VTK_TT>([components](std::int64_t i)
                                              { return components->GetTypedComponent(i, 0); }),
          nx, this->WordsPerRow, criteria);
      });
    default:
      break;
  }
  if (auto* bits = vtkBitArray::SafeDownCast(scalars))
  {
    const int stride = bits->GetNumberOfComponents();
    this->PackRows = MakePacker<unsigned char>(
      LoadOneByOne<unsigned char>([bits, stride](std::int64_t i)
        { return static_cast<unsigned char>(bits->GetValue(i * stride)); }),
      nx, this->WordsPerRow, criteria);
  }
  else if (!this->PackRows)
  {
    this->PackRows = MakePacker<double>(
      LoadOneByOne<double>([scalars](std::int64_t i) { return scalars->GetComponent(i, 0); }), nx,
      this->WordsPerRow, criteria);
  }
}

void vtkSlicemapPacker::Pack(
  std::int64_t firstRow, std::int64_t rows, const std::vector<std::uint32_t*>& words) const
{
  vtkSMPTools::For(0, rows,
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<std::uint32_t*> from(words);
      for (std::uint32_t*& target : from)
      {
        target += begin * this->WordsPerRow;
      }
      this->PackRows(firstRow + begin, end - begin, from);
    });
}
