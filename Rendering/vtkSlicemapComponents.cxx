// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSlicemapComponents.h"

#include "vtkSMPTools.h"
#include "vtkSlicemap.h"

#include <algorithm>
#include <bitset>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace
{
constexpr int WordBits = 32;
constexpr std::uint32_t FullWord = 0xffffffffu;

/// So often progress is told, unless there are fewer slices.
constexpr int ProgressSteps = 16;

int CountBits(std::uint32_t word)
{
  return static_cast<int>(std::bitset<WordBits>(word).count());
}

/// Of the lowest bit that is set; there is one.
int FindLowestBit(std::uint32_t word)
{
  return CountBits((word & (0u - word)) - 1u);
}

/// The bits from `first` to before `end`, which lie in this word or beyond it.
std::uint32_t BitsBetween(int first, int end)
{
  const std::uint32_t from = first <= 0 ? FullWord : FullWord << first;
  const std::uint32_t to = end >= WordBits ? FullWord : (1u << end) - 1u;
  return from & to;
}

/// Calls visit(word, bits) for each word of a row of `n` voxels with those to look at set, and
/// those set that differ from the voxel before.
template <typename Visitor>
void VisitChanges(const std::uint32_t* words, int n, std::uint32_t inversion, Visitor&& visit)
{
  std::uint32_t before = 0;
  for (int x = 0; x < n; x += WordBits)
  {
    const std::uint32_t bits = (*words++ ^ inversion) & BitsBetween(0, n - x);
    visit(x, bits, bits ^ (bits << 1 | before));
    before = bits >> (WordBits - 1);
  }
}

int CountRuns(const std::uint32_t* words, int n, std::uint32_t inversion)
{
  int count = 0;
  VisitChanges(words, n, inversion,
    [&](int, std::uint32_t bits, std::uint32_t changes) { count += CountBits(bits & changes); });
  return count;
}
}

vtkSlicemapComponents::vtkSlicemapComponents(
  const vtkVoxelGrid& grid, const std::uint32_t* words, Kind kind, const CheckMemory& checkMemory)
  : Size(grid.GetDimensions())
  , Rows(std::int64_t(this->Size.y) * this->Size.z)
  , WordsPerRow(vtkSlicemap::GetWordsPerRow(grid))
{
  this->FindRuns(words, kind, checkMemory);
}

void vtkSlicemapComponents::FindRuns(
  const std::uint32_t* words, Kind kind, const CheckMemory& checkMemory)
{
  const std::uint32_t inversion = kind == Kind::Unset ? FullWord : 0u;
  this->FirstRuns.assign(this->Rows + 1, 0);
  vtkSMPTools::For(0, this->Rows,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType row = begin; row < end; ++row)
      {
        this->FirstRuns[row + 1] =
          static_cast<Id>(CountRuns(words + row * this->WordsPerRow, this->Size.x, inversion));
      }
    });
  const auto runs =
    std::accumulate(this->FirstRuns.begin(), this->FirstRuns.end(), std::int64_t(0));
  checkMemory(runs * BytesPerRun);
  if (runs > std::numeric_limits<Id>::max())
  {
    throw std::runtime_error("The voxels form " + std::to_string(runs) +
      " runs along x, more than can be numbered. Use fewer voxels.");
  }
  std::partial_sum(this->FirstRuns.begin(), this->FirstRuns.end(), this->FirstRuns.begin());

  this->Runs.resize(runs);
  vtkSMPTools::For(0, this->Rows,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType row = begin; row < end; ++row)
      {
        Run* run = this->Runs.data() + this->FirstRuns[row];
        bool isOpen = false;
        VisitChanges(words + row * this->WordsPerRow, this->Size.x, inversion,
          [&](int x, std::uint32_t, std::uint32_t changes)
          {
            for (; changes != 0; changes &= changes - 1u)
            {
              const int at = x + FindLowestBit(changes);
              if (isOpen)
              {
                (run++)->End = at;
              }
              else
              {
                run->First = at;
              }
              isOpen = !isOpen;
            }
          });
        if (isOpen)
        {
          run->End = this->Size.x;
        }
      }
    });
}

std::vector<vtkSlicemapComponents::Link> vtkSlicemapComponents::GetLinks(Neighbours neighbours)
{
  const int axes = static_cast<int>(neighbours);
  std::vector<Link> links;
  for (const auto& [y, z] : { std::pair(-1, 0), { -1, -1 }, { 0, -1 }, { 1, -1 } })
  {
    const int used = std::abs(y) + std::abs(z);
    if (used <= axes)
    {
      links.push_back({ y, z, used < axes ? 1 : 0 });
    }
  }
  return links;
}

bool vtkSlicemapComponents::Join(Neighbours neighbours, const Progress& progress)
{
  this->Parents.resize(this->Runs.size());
  std::iota(this->Parents.begin(), this->Parents.end(), Id(0));
  const auto links = GetLinks(neighbours);
  const auto isAcross = [](const Link& link) { return link.Z != 0; };
  std::vector<Link> within;
  std::vector<Link> across;
  std::partition_copy(
    links.begin(), links.end(), std::back_inserter(across), std::back_inserter(within), isAcross);

  const int step = (this->Size.z + ProgressSteps - 1) / ProgressSteps;
  for (int z = 0; z < this->Size.z; z += step)
  {
    if (!progress(double(z) / this->Size.z))
    {
      return false;
    }
    // Each thread joins its slices with each other; then these stacks are joined.
    std::vector<int> stacks;
    std::mutex mutex;
    vtkSMPTools::For(z, std::min(z + step, this->Size.z),
      [&](vtkIdType begin, vtkIdType end)
      {
        {
          const std::lock_guard lock(mutex);
          stacks.push_back(static_cast<int>(begin));
        }
        for (int slice = static_cast<int>(begin); slice < end; ++slice)
        {
          this->JoinSlice(slice == begin ? within : links, slice);
        }
      });
    for (const int slice : stacks)
    {
      this->JoinSlice(across, slice);
    }
  }
  this->NumberComponents();
  return progress(1.0);
}

void vtkSlicemapComponents::JoinSlice(const std::vector<Link>& links, int z)
{
  for (int y = 0; y < this->Size.y; ++y)
  {
    for (const Link& link : links)
    {
      const int otherY = y + link.Y;
      const int otherZ = z + link.Z;
      if (otherY >= 0 && otherY < this->Size.y && otherZ >= 0)
      {
        this->JoinRows(std::int64_t(z) * this->Size.y + y,
          std::int64_t(otherZ) * this->Size.y + otherY, link.Reach);
      }
    }
  }
}

void vtkSlicemapComponents::JoinRows(std::int64_t row, std::int64_t other, int reach)
{
  Id a = this->FirstRuns[row];
  Id b = this->FirstRuns[other];
  const Id endOfA = this->FirstRuns[row + 1];
  const Id endOfB = this->FirstRuns[other + 1];
  while (a < endOfA && b < endOfB)
  {
    const Run& runA = this->Runs[a];
    const Run& runB = this->Runs[b];
    if (runA.First < runB.End + reach && runB.First < runA.End + reach)
    {
      this->JoinRuns(a, b);
    }
    // The next run begins behind a gap, so that the one that ends first touches no other.
    if (runA.End < runB.End)
    {
      ++a;
    }
    else
    {
      ++b;
    }
  }
}

void vtkSlicemapComponents::JoinRuns(Id a, Id b)
{
  a = this->FindRoot(a);
  b = this->FindRoot(b);
  this->Parents[std::max(a, b)] = std::min(a, b);
}

vtkSlicemapComponents::Id vtkSlicemapComponents::FindRoot(Id run)
{
  while (this->Parents[run] != run)
  {
    const Id grandparent = this->Parents[this->Parents[run]];
    this->Parents[run] = grandparent;
    run = grandparent;
  }
  return run;
}

void vtkSlicemapComponents::NumberComponents()
{
  Id count = 0;
  for (std::size_t run = 0; run < this->Parents.size(); ++run)
  {
    // An earlier run has its number already.
    const Id parent = this->Parents[run];
    this->Parents[run] = parent == run ? count++ : this->Parents[parent];
  }
  this->Count = count;
}

vtkSlicemapComponents::Selection vtkSlicemapComponents::SelectLargest() const
{
  std::vector<std::int64_t> sizes(this->Count);
  for (std::size_t run = 0; run < this->Runs.size(); ++run)
  {
    sizes[this->Parents[run]] += this->Runs[run].End - this->Runs[run].First;
  }
  Selection selection(this->Count, 0);
  if (!sizes.empty())
  {
    selection[std::max_element(sizes.begin(), sizes.end()) - sizes.begin()] = 1;
  }
  return selection;
}

vtkSlicemapComponents::Selection vtkSlicemapComponents::SelectInner() const
{
  Selection selection(this->Count, 1);
  for (std::int64_t row = 0; row < this->Rows; ++row)
  {
    const auto y = row % this->Size.y;
    const auto z = row / this->Size.y;
    const bool isOuterRow = y == 0 || y == this->Size.y - 1 || z == 0 || z == this->Size.z - 1;
    for (Id run = this->FirstRuns[row]; run < this->FirstRuns[row + 1]; ++run)
    {
      if (isOuterRow || this->Runs[run].First == 0 || this->Runs[run].End == this->Size.x)
      {
        selection[this->Parents[run]] = 0;
      }
    }
  }
  return selection;
}

void vtkSlicemapComponents::Write(
  const Selection& selection, std::int64_t firstRow, std::int64_t rows, std::uint32_t* words) const
{
  vtkSMPTools::For(firstRow, firstRow + rows,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType row = begin; row < end; ++row)
      {
        std::uint32_t* out = words + (row - firstRow) * this->WordsPerRow;
        std::fill_n(out, this->WordsPerRow, 0u);
        for (Id id = this->FirstRuns[row]; id < this->FirstRuns[row + 1]; ++id)
        {
          const Run& run = this->Runs[id];
          const int lastWord = selection[this->Parents[id]] ? (run.End - 1) / WordBits : -1;
          for (int word = run.First / WordBits; word <= lastWord; ++word)
          {
            const int x = word * WordBits;
            out[word] |= BitsBetween(run.First - x, run.End - x);
          }
        }
      }
    });
}
