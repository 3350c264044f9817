// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkPolygonMender.h
 * Private header: which polygons of a mesh are to go, so that edges get an even number of them. No
 * coordinates are seen here: corners are numbers of places.
 */

#ifndef vtkPolygonMender_h
#define vtkPolygonMender_h

#include "vtkType.h"

#include <vector>

class vtkPolygonMender
{
public:
  enum class Fate
  {
    Kept,
    Degenerate, ///< less than three corners, or no area and not needed by its neighbours
    Duplicate,  ///< one with the same corners in the same order is kept
    Opposite,   ///< one with the same corners in the opposite order is kept
    Wall        ///< and all others with the same corners: they lay within the solid
  };

  void Add(const vtkIdType* corners, vtkIdType count, bool hasArea);

  /// One for each polygon, in the order in which they were added.
  std::vector<Fate> Decide();

private:
  /// Polygons with the same corners, of which one is kept at most.
  struct Group
  {
    std::vector<vtkIdType> Members;
    bool HasArea;
    bool IsKept = true;
  };

  /// An edge, from the lower place to the higher one, and a group that has it.
  struct Use
  {
    vtkIdType Low;
    vtkIdType High;
    vtkIdType Group;
  };

  struct Polygon
  {
    vtkIdType First; ///< in Corners
    vtkIdType Count;
    bool IsReversed; ///< against the order in which the corners are kept
    bool HasArea;
  };

  struct Region;

  int CompareCorners(const Polygon& a, const Polygon& b) const;
  void FindGroups();
  void FindUses();
  std::vector<Region> FindRegions();
  int CountKept(vtkIdType edge) const;
  int CountEdgesThatTurnOdd(const Region& region, bool isWall) const;

  std::vector<vtkIdType> Corners;
  std::vector<Polygon> Polygons;
  std::vector<Group> Groups;
  std::vector<Use> Uses;              ///< sorted by edge
  std::vector<vtkIdType> FirstOfEdge; ///< in Uses, and one more
  std::vector<std::vector<vtkIdType>> EdgesOfGroup;
};

#endif
// VTK-HeaderTest-Exclude: vtkPolygonMender.h
