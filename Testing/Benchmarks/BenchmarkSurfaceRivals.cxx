// Times what else voxelizes surfaces on the CPU, to measure the voxelizers beside. Arguments of a
// row: voxels along the longest side of the mesh.
//
//   VoxelModeller/MESH  vtkVoxelModeller, bits
//   OpenVDB/MESH        the first stage of openvdb::tools::meshToVolume: unsigned distances in the
//                       voxels within one voxel of the surface, sparse, all threads; the mesh is in
//                       index coordinates before. Only where OpenVDB was found.
//
// A mesh goes from memory to voxels in memory. Rows of more than about five seconds are left out.

#include "VoxelBenchmarks.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkVoxelModeller.h>

#ifdef VTKVOXELIZATION_HAS_OPENVDB
#include "OpenVDBMesh.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#endif

#include <algorithm>
#include <string>
#include <vector>

using namespace VoxelBenchmarks;

namespace
{

void VoxelModeller(benchmark::State& state, const Mesh& mesh)
{
  const auto grid = MakeGrid(mesh, static_cast<int>(state.range(0)));
  double bounds[6];
  grid->GetBounds(bounds);
  const double* spacing = grid->GetSpacing();
  const double longest =
    std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  vtkNew<vtkVoxelModeller> modeller;
  modeller->SetInputData(mesh);
  modeller->SetModelBounds(bounds);
  modeller->SetSampleDimensions(grid->GetDimensions());
  modeller->SetScalarTypeToBit();
  // No voxel that the surface touches is farther from it along an axis.
  modeller->SetMaximumDistance(0.5 * std::max({ spacing[0], spacing[1], spacing[2] }) / longest);
  for (auto _ : state)
  {
    Touch(mesh);
    modeller->Update();
  }
}

#ifdef VTKVOXELIZATION_HAS_OPENVDB
void OpenVDB(benchmark::State& state, const Mesh& mesh)
{
  openvdb::initialize();
  const OpenVDBMesh triangles(mesh, static_cast<int>(state.range(0)));
  const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(openvdb::tools::meshToVolume<openvdb::FloatGrid>(
      triangles, *transform, 1.0F, 1.0F, openvdb::tools::UNSIGNED_DISTANCE_FIELD));
  }
}
#endif

void AddAllRows()
{
  const std::vector<int> sizes = { 64, 128, 256, 512, 1024 };
  for (const auto& [name, mesh] : SurfaceMeshes())
  {
    // vtkVoxelModeller looks at all voxels in a triangle's bounds.
    const bool hasLargeTriangles = name == "triangle" || name == "mixed";
    AddRows("VoxelModeller/" + name, VoxelModeller, mesh,
      hasLargeTriangles ? std::vector<int>{ 64, 128, 256 } : sizes, 1);
#ifdef VTKVOXELIZATION_HAS_OPENVDB
    AddRows("OpenVDB/" + name, OpenVDB, mesh, sizes, 1);
#endif
  }
}

}

int main(int argc, char* argv[])
{
  AddAllRows();
  return RunRows(argc, argv);
}
