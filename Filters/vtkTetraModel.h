// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkTetraModel.h
 * Private header: what vtkTetraCoveringVoxelizer knows of a mesh on the host, beside the triangles
 * on the GPU.
 */

#ifndef vtkTetraModel_h
#define vtkTetraModel_h

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

class vtkDataObject;

/// Places that a model is moved by, in world units.
struct vtkTetraFrame
{
  glm::dvec3 Center{ 0.0 };   ///< of the bounds
  glm::dvec3 HalfSize{ 0.0 }; ///< of the bounds
  double Radius = 0.0;        ///< of the ball about Center that holds all points
  glm::dvec3 Origin{ 0.0 };   ///< mean of the points: the common corner of the tetrahedra

  double GetLongestSide() const;
};

class vtkTetraModel
{
public:
  using Leaves = std::vector<vtkSmartPointer<vtkPolyData>>;

  explicit vtkTetraModel(Leaves leaves);

  const Leaves& GetLeaves() const { return this->Model; }
  const vtkTetraFrame& GetFrame() const;

  /// Whether every edge has an even number of polygons.
  bool IsClosed() const { return this->Closed; }
  vtkIdType GetNumberOfOpenEdges() const { return this->OpenEdges; }
  vtkIdType GetNumberOfNonManifoldEdges() const { return this->NonManifoldEdges; }

  /// A composite of the leaves and, if the model is not closed, of the facets of its tetrahedra
  /// that don't cancel: triangles from the odd edges to the origin.
  vtkDataObject* GetClosedMesh() const { return this->ClosedMesh; }

  /// For each point of the closed mesh the first point at the same place.
  std::vector<std::uint32_t> FindPlaces() const;

  /// For each point of the closed mesh the unit normal, of all polygons of the model at its place
  /// by their area; 0 where there are none.
  std::vector<glm::vec3> ComputeNormals(const std::vector<std::uint32_t>& places) const;

private:
  vtkTetraFrame FindFrame() const;
  void Close();

  Leaves Model;
  Leaves All;
  vtkSmartPointer<vtkDataObject> ClosedMesh;
  mutable std::optional<vtkTetraFrame> Frame;
  bool Closed = true;
  vtkIdType OpenEdges = 0;
  vtkIdType NonManifoldEdges = 0;
};

#endif
// VTK-HeaderTest-Exclude: vtkTetraModel.h
