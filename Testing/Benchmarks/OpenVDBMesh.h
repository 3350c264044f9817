/**
 * @file   OpenVDBMesh.h
 * @brief  A mesh for openvdb::tools::meshToVolume.
 */
#ifndef OpenVDBMesh_h
#define OpenVDBMesh_h

#include "VoxelBenchmarks.h"
#include "VoxelReference.h"

#include <openvdb/openvdb.h>

#include <cstddef>
#include <cstdint>

namespace VoxelBenchmarks
{

/// The triangles as meshToVolume wants to see them.
class OpenVDBMesh
{
public:
  OpenVDBMesh(vtkPolyData* mesh, int resolution)
    : NumberOfPoints(static_cast<std::size_t>(mesh->GetNumberOfPoints()))
    , Triangles(mesh, VoxelReference::Grid::FromImage(MakeGrid(mesh, resolution)))
  {
  }

  std::size_t polygonCount() const
  {
    return static_cast<std::size_t>(this->Triangles.GetNumberOfTriangles());
  }
  std::size_t pointCount() const { return this->NumberOfPoints; }
  std::size_t vertexCount(std::size_t) const { return 3; }
  void getIndexSpacePoint(std::size_t polygon, std::size_t vertex, openvdb::Vec3d& point) const
  {
    const auto triangle = static_cast<std::int64_t>(polygon);
    point = openvdb::Vec3d(
      this->Triangles.GetPoint(this->Triangles.GetPointIds(triangle)[vertex]).data());
  }

private:
  std::size_t NumberOfPoints;
  VoxelReference::IndexMesh Triangles;
};

}

#endif
