// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPolygonMender.h"

#include "vtkConnectedSets.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

namespace
{
/// The corners as a cycle without the same one twice in a row; empty when less than three are left.
std::vector<vtkIdType> WithoutRepeats(const vtkIdType* corners, vtkIdType count)
{
  std::vector<vtkIdType> cycle;
  for (vtkIdType i = 0; i < count; ++i)
  {
    if (cycle.empty() || cycle.back() != corners[i])
    {
      cycle.push_back(corners[i]);
    }
  }
  while (cycle.size() > 1 && cycle.back() == cycle.front())
  {
    cycle.pop_back();
  }
  return cycle.size() < 3 ? std::vector<vtkIdType>() : cycle;
}

/// The cycle from where it is the least of all its rotations.
std::vector<vtkIdType> LeastRotation(const std::vector<vtkIdType>& cycle)
{
  std::vector<vtkIdType> least = cycle;
  std::vector<vtkIdType> rotated = cycle;
  for (std::size_t i = 1; i < cycle.size(); ++i)
  {
    std::rotate(rotated.begin(), rotated.begin() + 1, rotated.end());
    if (rotated.front() <= least.front() && rotated < least)
    {
      least = rotated;
    }
  }
  return least;
}
}

/// Groups that stay or go together.
struct vtkPolygonMender::Region
{
  std::vector<vtkIdType> Groups;
  vtkIdType NumberOfPolygons = 0;
};

void vtkPolygonMender::Add(const vtkIdType* corners, vtkIdType count, bool hasArea)
{
  const auto cycle = WithoutRepeats(corners, count);
  const auto forward = LeastRotation(cycle);
  const auto backward = LeastRotation({ cycle.rbegin(), cycle.rend() });
  const bool isReversed = backward < forward;
  const auto& kept = isReversed ? backward : forward;
  this->Polygons.push_back({ static_cast<vtkIdType>(this->Corners.size()),
    static_cast<vtkIdType>(kept.size()), isReversed, hasArea });
  this->Corners.insert(this->Corners.end(), kept.begin(), kept.end());
}

int vtkPolygonMender::CompareCorners(const Polygon& a, const Polygon& b) const
{
  if (a.Count != b.Count)
  {
    return a.Count < b.Count ? -1 : 1;
  }
  const auto* first = this->Corners.data() + a.First;
  const auto* second = this->Corners.data() + b.First;
  for (vtkIdType i = 0; i < a.Count; ++i)
  {
    if (first[i] != second[i])
    {
      return first[i] < second[i] ? -1 : 1;
    }
  }
  return 0;
}

void vtkPolygonMender::FindGroups()
{
  std::vector<vtkIdType> order(this->Polygons.size());
  std::iota(order.begin(), order.end(), vtkIdType(0));
  std::sort(order.begin(), order.end(),
    [&](vtkIdType a, vtkIdType b)
    {
      const int corners = this->CompareCorners(this->Polygons[a], this->Polygons[b]);
      return corners < 0 || (corners == 0 && a < b);
    });
  this->Groups.clear();
  for (const vtkIdType id : order)
  {
    const Polygon& polygon = this->Polygons[id];
    if (polygon.Count == 0)
    {
      continue;
    }
    if (this->Groups.empty() ||
      this->CompareCorners(this->Polygons[this->Groups.back().Members.front()], polygon) != 0)
    {
      this->Groups.push_back({ {}, polygon.HasArea });
    }
    this->Groups.back().Members.push_back(id);
  }
}

void vtkPolygonMender::FindUses()
{
  this->Uses.clear();
  for (std::size_t group = 0; group < this->Groups.size(); ++group)
  {
    const Polygon& polygon = this->Polygons[this->Groups[group].Members.front()];
    const vtkIdType* corners = this->Corners.data() + polygon.First;
    for (vtkIdType i = 0; i < polygon.Count; ++i)
    {
      const vtkIdType a = corners[i];
      const vtkIdType b = corners[i + 1 < polygon.Count ? i + 1 : 0];
      this->Uses.push_back({ std::min(a, b), std::max(a, b), static_cast<vtkIdType>(group) });
    }
  }
  std::sort(this->Uses.begin(), this->Uses.end(),
    [](const Use& a, const Use& b)
    { return std::tie(a.Low, a.High, a.Group) < std::tie(b.Low, b.High, b.Group); });
  this->FirstOfEdge.clear();
  this->EdgesOfGroup.assign(this->Groups.size(), {});
  for (std::size_t i = 0; i < this->Uses.size(); ++i)
  {
    const Use& use = this->Uses[i];
    if (i == 0 || use.Low != this->Uses[i - 1].Low || use.High != this->Uses[i - 1].High)
    {
      this->FirstOfEdge.push_back(static_cast<vtkIdType>(i));
    }
    this->EdgesOfGroup[use.Group].push_back(static_cast<vtkIdType>(this->FirstOfEdge.size()) - 1);
  }
  this->FirstOfEdge.push_back(static_cast<vtkIdType>(this->Uses.size()));
}

int vtkPolygonMender::CountKept(vtkIdType edge) const
{
  int kept = 0;
  for (vtkIdType i = this->FirstOfEdge[edge]; i < this->FirstOfEdge[edge + 1]; ++i)
  {
    kept += this->Groups[this->Uses[i].Group].IsKept ? 1 : 0;
  }
  return kept;
}

/// Less than zero: without the region, more edges have an even number of polygons. The rim of a
/// wall is where others meet it.
int vtkPolygonMender::CountEdgesThatTurnOdd(const Region& region, bool isWall) const
{
  std::map<vtkIdType, int> uses;
  for (const vtkIdType group : region.Groups)
  {
    for (const vtkIdType edge : this->EdgesOfGroup[group])
    {
      ++uses[edge];
    }
  }
  int sum = 0;
  for (const auto& [edge, ofRegion] : uses)
  {
    const int kept = this->CountKept(edge);
    if (ofRegion % 2 != 0 && (!isWall || kept > ofRegion))
    {
      sum += kept % 2 == 0 ? 1 : -1;
    }
  }
  return sum;
}

/// Groups of several polygons, connected across edges where there are but two groups; small ones
/// first.
std::vector<vtkPolygonMender::Region> vtkPolygonMender::FindRegions()
{
  const auto isMultiple = [&](vtkIdType group)
  { return this->Groups[group].IsKept && this->Groups[group].Members.size() > 1; };
  vtkConnectedSets sets(static_cast<vtkIdType>(this->Groups.size()));
  for (std::size_t edge = 0; edge + 1 < this->FirstOfEdge.size(); ++edge)
  {
    if (this->CountKept(static_cast<vtkIdType>(edge)) != 2)
    {
      continue;
    }
    vtkIdType previous = -1;
    for (vtkIdType i = this->FirstOfEdge[edge]; i < this->FirstOfEdge[edge + 1]; ++i)
    {
      const vtkIdType group = this->Uses[i].Group;
      if (isMultiple(group))
      {
        if (previous >= 0)
        {
          sets.Join(previous, group);
        }
        previous = group;
      }
    }
  }
  std::map<vtkIdType, Region> regions;
  for (std::size_t group = 0; group < this->Groups.size(); ++group)
  {
    const auto id = static_cast<vtkIdType>(group);
    if (isMultiple(id))
    {
      Region& region = regions[sets.Find(id)];
      region.Groups.push_back(id);
      region.NumberOfPolygons += static_cast<vtkIdType>(this->Groups[group].Members.size());
    }
  }
  std::vector<Region> sorted;
  sorted.reserve(regions.size());
  for (auto& [representative, region] : regions)
  {
    sorted.push_back(std::move(region));
  }
  std::stable_sort(sorted.begin(), sorted.end(),
    [](const Region& a, const Region& b) { return a.NumberOfPolygons < b.NumberOfPolygons; });
  return sorted;
}

std::vector<vtkPolygonMender::Fate> vtkPolygonMender::Decide()
{
  std::vector<Fate> fates(this->Polygons.size(), Fate::Degenerate);
  this->FindGroups();
  this->FindUses();
  for (std::size_t group = 0; group < this->Groups.size(); ++group)
  {
    Region alone;
    alone.Groups.push_back(static_cast<vtkIdType>(group));
    if (!this->Groups[group].HasArea && this->CountEdgesThatTurnOdd(alone, false) <= 0)
    {
      this->Groups[group].IsKept = false;
    }
  }
  for (const Region& region : this->FindRegions())
  {
    if (this->CountEdgesThatTurnOdd(region, true) < 0)
    {
      for (const vtkIdType group : region.Groups)
      {
        this->Groups[group].IsKept = false;
      }
    }
  }
  for (const Group& group : this->Groups)
  {
    if (!group.HasArea && !group.IsKept)
    {
      continue;
    }
    const bool isReversed = this->Polygons[group.Members.front()].IsReversed;
    for (const vtkIdType id : group.Members)
    {
      const bool isOpposite = this->Polygons[id].IsReversed != isReversed;
      fates[id] = !group.IsKept ? Fate::Wall : isOpposite ? Fate::Opposite : Fate::Duplicate;
    }
    if (group.IsKept)
    {
      fates[group.Members.front()] = Fate::Kept;
    }
  }
  return fates;
}
