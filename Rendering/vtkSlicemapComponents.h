// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkSlicemapComponents.h
 * Private header: the connected components of the voxels of a slicemap, on the host.
 *
 * Works on runs, the stretches of alike voxels in a row along x, which are few in solids. Runs of
 * neighbouring rows that touch are joined by union-find; slices in parallel, what they share with
 * the next ones after that. Linear in the number of runs, but for the depth of union-find.
 */

#ifndef vtkSlicemapComponents_h
#define vtkSlicemapComponents_h

#include "vtkVoxelGrid.h"

#include <cstdint>
#include <functional>
#include <vector>

class vtkSlicemapComponents
{
public:
  /// Which voxels.
  enum class Kind
  {
    Set,
    Unset
  };

  /// How many axes two neighbours may be apart on, by one voxel each.
  enum class Neighbours
  {
    Faces = 1,
    Edges = 2,
    Corners = 3
  };

  /// Called with the fraction that is done; false stops.
  using Progress = std::function<bool(double)>;

  /// Called with the bytes that are needed, before they are taken; may throw.
  using CheckMemory = std::function<void(std::int64_t bytes)>;

  /// The runs of the words of a slicemap on `grid`. Throws std::runtime_error when there are more
  /// than can be numbered.
  vtkSlicemapComponents(const vtkVoxelGrid& grid, const std::uint32_t* words, Kind kind,
    const CheckMemory& checkMemory);

  /// Finds the components and numbers them in the order of their first voxels. False when stopped.
  bool Join(Neighbours neighbours, const Progress& progress);

  std::int64_t GetCount() const { return this->Count; }

  /// 1 for each component to take, 0 for the others.
  using Selection = std::vector<char>;

  /// The one with most voxels, of several of those the first; none when there are no components.
  Selection SelectLargest() const;

  /// Those without a voxel at the border of the grid.
  Selection SelectInner() const;

  /// Sets the voxels of the selected components in the words of some rows of a slicemap, from the
  /// first of these on, and clears all others.
  void Write(const Selection& selection, std::int64_t firstRow, std::int64_t rows,
    std::uint32_t* words) const;

private:
  struct Run
  {
    int First;
    int End; ///< one behind the last
  };
  using Id = std::uint32_t;

  /// With the size and the selection of each, if each is a component.
  static constexpr std::int64_t BytesPerRun =
    sizeof(Run) + sizeof(Id) + sizeof(std::int64_t) + sizeof(Selection::value_type);

  /// A row as seen from another one: off by so much, and by how much its runs may miss the others.
  struct Link
  {
    int Y;
    int Z;
    int Reach;
  };
  static std::vector<Link> GetLinks(Neighbours neighbours);

  void FindRuns(const std::uint32_t* words, Kind kind, const CheckMemory& checkMemory);
  void JoinSlice(const std::vector<Link>& links, int z);
  void JoinRows(std::int64_t row, std::int64_t other, int reach);
  void JoinRuns(Id a, Id b);
  Id FindRoot(Id run);
  void NumberComponents();

  glm::ivec3 Size;
  std::int64_t Rows;
  std::int64_t WordsPerRow;
  std::vector<Id> FirstRuns; ///< of each row, and the number of all
  std::vector<Run> Runs;
  std::vector<Id>
    Parents; ///< an earlier run, or the run itself; at last the number of the component
  std::int64_t Count = 0;
};

#endif
// VTK-HeaderTest-Exclude: vtkSlicemapComponents.h
