// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelMesh.h
 * Private header: the triangles of an input on the GPU, uploaded once for as long as the input
 * stays as it is.
 *
 * Points go up as they are when they are floats. Doubles and other types go up as two floats, the
 * rounded value and what the rounding took away, which together hold 48 bits.
 */

#ifndef vtkVoxelMesh_h
#define vtkVoxelMesh_h

#include "vtkSmartPointer.h"
#include "vtkVoxelGLObjects.h"

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

class vtkCompositeDataSet;
class vtkDataObject;
class vtkPolyData;
class vtkVoxelMeshDisplacement;

class vtkVoxelMesh
{
public:
  enum class Triangulation
  {
    Fans, ///< a fan a polygon: parity and winding are right for concave polygons too
    Exact ///< ear clipping by vtkTriangleFilter: the triangles cover just the polygon
  };

  /// What an input consists of, and when that changed last: equal for inputs whose triangles are.
  struct Identity
  {
    const void* Points;
    const void* Polygons;
    const void* Strips;
    std::uint64_t Time;
    bool operator==(const Identity& o) const
    {
      return this->Points == o.Points && this->Polygons == o.Polygons && this->Strips == o.Strips &&
        this->Time == o.Time;
    }
  };
  static std::vector<Identity> Identify(vtkDataObject* input);

  /// The polydata of the input: itself, or all leaves of a composite.
  static std::vector<vtkSmartPointer<vtkPolyData>> GetLeaves(vtkDataObject* input);

  /// Bounds of all points of the input; false when there are none.
  static bool GetBounds(vtkDataObject* input, double bounds[6]);

  /// Puts the triangles of `input` on the GPU, unless they are there already; the context must be
  /// current. Throws std::runtime_error with a message for the user when the input can't be
  /// voxelized.
  void Update(
    const vtkVoxelGL::Context& context, vtkDataObject* input, Triangulation triangulation);

  /// For each leaf of the input that was uploaded, its points in their order: calls `visit` with
  /// the leaf as it was triangulated and, for each of its triangles, the cell of the leaf that it
  /// is of.
  void VisitLeaves(vtkDataObject* input,
    const std::function<void(vtkPolyData* leaf, const std::vector<vtkIdType>& cellsOfTriangles)>&
      visit) const;

  std::uint32_t GetNumberOfTriangles() const { return this->NumberOfTriangles; }

  /// Moves the points by this from now on, or no longer; it must outlive its use.
  void SetDisplacement(const vtkVoxelMeshDisplacement* displacement)
  {
    this->Displacement = displacement;
  }

  /// Defines of the shaders that fetch triangles.
  vtkVoxelGL::Program::Defines GetDefines() const;

  /// Binds the buffer textures to units `unit` to `unit` + 5 and sets the uniforms of
  /// vtkVoxelMeshFetch.glsl, or of its counterpart in single precision; the program must be in use.
  void Bind(vtkVoxelGL::Program& program, unsigned int unit) const;

  /// Makes the point ids of the triangles the indices of the vertex array that is bound.
  void BindIndices() const { this->Triangles.Bind(GL_ELEMENT_ARRAY_BUFFER); }

  /// Area of all triangles projected along each of the three axes of index coordinates, in squares
  /// of voxels; estimated from a fixed sample of the triangles.
  glm::dvec3 EstimateProjectedAreas(const glm::dmat4& worldToIndex) const;

  /// Area of the bounds of the largest triangle of that sample, seen along the axis closest to its
  /// normal.
  double EstimateLargestArea(const glm::dmat4& worldToIndex) const;

  /// Largest coordinate, in world units and without sign.
  double GetLargestCoordinate() const;

  /// How often triangles were uploaded.
  int GetNumberOfUploads() const { return this->NumberOfUploads; }

private:
  void UploadPoints(const std::vector<vtkSmartPointer<vtkPolyData>>& leaves);
  void UploadTriangles(
    const std::vector<vtkSmartPointer<vtkPolyData>>& leaves, bool expectTriangles);
  void SampleAreas(const std::vector<vtkSmartPointer<vtkPolyData>>& leaves);

  vtkVoxelGL::Context Context;
  std::vector<Identity> Uploaded;
  Triangulation UploadedAs = Triangulation::Fans;
  bool IsTriangulated = false;
  vtkVoxelGL::Buffer Points;
  vtkVoxelGL::Buffer PointsLow;
  vtkVoxelGL::Buffer Triangles;
  vtkVoxelGL::Texture PointsTexture;
  vtkVoxelGL::Texture PointsLowTexture;
  vtkVoxelGL::Texture TrianglesTexture;
  std::vector<glm::dvec3> SampledNormals;
  double AreaOfSample = 1.0;
  std::uint32_t NumberOfPoints = 0;
  std::uint32_t NumberOfTriangles = 0;
  bool LowPoints = false;
  double LargestCoordinate = 0.0;
  const vtkVoxelMeshDisplacement* Displacement = nullptr;
  int NumberOfUploads = 0;
};

#endif
// VTK-HeaderTest-Exclude: vtkVoxelMesh.h
