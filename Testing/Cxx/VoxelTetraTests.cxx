#include "VoxelTetraTests.h"

#include "VoxelComparison.h"
#include "VoxelSolidTests.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkVoxelContext.h>

#include <algorithm>

using namespace VoxelReference;

namespace VoxelTetraTests
{

vtkSmartPointer<Voxelizer> MakeVoxelizer(vtkPolyData* mesh, vtkImageData* grid, int backend)
{
  auto voxelizer = vtkSmartPointer<Voxelizer>::New();
  voxelizer->SetInputData(mesh);
  voxelizer->SetReferenceImage(grid);
  voxelizer->SetBackend(backend);
  return voxelizer;
}

std::vector<int> AvailableBackends()
{
  vtkNew<vtkVoxelContext> context;
  return context->SupportsCompute()
    ? std::vector<int>{ vtkVoxelizer::BACKEND_COMPUTE, vtkVoxelizer::BACKEND_RASTER }
    : std::vector<int>{ vtkVoxelizer::BACKEND_RASTER };
}

Volume XorOfTetrahedra(vtkPolyData* mesh, const Grid& grid)
{
  Vector origin{ 0, 0, 0 };
  const vtkIdType points = mesh->GetNumberOfPoints();
  for (vtkIdType i = 0; i < points; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      origin[axis] += mesh->GetPoint(i)[axis] / static_cast<double>(points);
    }
  }
  // IndexMesh makes fans, as the class says that it does.
  const IndexMesh triangles(mesh,
    Grid::FromMatrix({ 0, 0, 0, 0, 0, 0 }, { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 }));
  Volume sum(grid);
  std::fill_n(sum.Voxels.get(), grid.NumberOfVoxels(), static_cast<unsigned char>(0));
  for (std::int64_t i = 0; i < triangles.GetNumberOfTriangles(); ++i)
  {
    const Triangle t = triangles.GetTriangle(i);
    const auto tetrahedron = VoxelTestMeshes::Tetrahedron({ t[0], t[1], t[2], origin });
    const Volume inside = CrossingParityReference(tetrahedron, grid, Axis::Z, 1);
    for (std::size_t voxel = 0; voxel < grid.NumberOfVoxels(); ++voxel)
    {
      sum.Voxels[voxel] ^= inside.Voxels[voxel];
    }
  }
  return sum;
}

Volume Solid(vtkPolyData* mesh, vtkImageData* grid)
{
  const auto solid = VoxelSolidTests::MakeVoxelizer(
    mesh, grid, vtkVoxelizer::BACKEND_COMPUTE, vtkSlicemapSolidVoxelizer::COLUMN_AXIS_AUTO);
  solid->Update();
  return OccupancyOf(solid->GetOutput());
}

bool CheckSame(
  const std::string& name, Voxelizer* voxelizer, const Volume& expected, vtkPolyData* mesh)
{
  voxelizer->Update();
  const int backend = voxelizer->GetUsedBackend();
  return Report(name + ", " + VoxelSolidTests::NameOf(backend),
    Compare(voxelizer->GetOutput(), expected), mesh, VoxelSolidTests::ToleranceOf(backend));
}

}
