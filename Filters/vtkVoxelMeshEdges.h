// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelMeshEdges.h
 * Private header: where meshes are not closed, and caps that close them.
 */

#ifndef vtkVoxelMeshEdges_h
#define vtkVoxelMeshEdges_h

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <glm/glm.hpp>
#include <vector>

/// The edges of all polygons of some meshes. Points at the same place are one point, as in an STL
/// file.
class vtkVoxelMeshEdges
{
public:
  /// Whether parity sees a closed mesh: every edge has an even number of polygons. Decided by one
  /// hash of all edges, in a fraction of the time that the rest of this class takes.
  static bool IsClosed(const std::vector<vtkSmartPointer<vtkPolyData>>& meshes);

  explicit vtkVoxelMeshEdges(const std::vector<vtkSmartPointer<vtkPolyData>>& meshes);

  /// Edges with one polygon.
  vtkIdType GetNumberOfOpenEdges() const { return this->OpenEdges; }

  /// Edges with more than two polygons.
  vtkIdType GetNumberOfNonManifoldEdges() const { return this->NonManifoldEdges; }

  /// Cones over the edges with an odd number of polygons, one for each connected set of these, with
  /// the apex in their middle. With them every edge has an even number of polygons: parity sees a
  /// closed mesh. Cones over flat holes are flat, and those over cracks without a width have none.
  vtkSmartPointer<vtkPolyData> MakeCaps() const;

  /// The same with one apex for all of them, at the given place.
  vtkSmartPointer<vtkPolyData> MakeCaps(const glm::dvec3& apex) const;

private:
  struct Edge
  {
    vtkIdType Low;
    vtkIdType High;
    bool operator<(const Edge& o) const
    {
      return this->Low < o.Low || (this->Low == o.Low && this->High < o.High);
    }
    bool operator==(const Edge& o) const { return this->Low == o.Low && this->High == o.High; }
  };

  vtkSmartPointer<vtkPolyData> MakeCones(
    const std::function<glm::dvec3(const Edge& edge)>& apexOf) const;

  vtkNew<vtkPolyData> Merged;
  std::vector<Edge> OddEdges;
  vtkIdType OpenEdges = 0;
  vtkIdType NonManifoldEdges = 0;
};

#endif
// VTK-HeaderTest-Exclude: vtkVoxelMeshEdges.h
