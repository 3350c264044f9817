#include "VoxelTetraTests.h"

#include "VoxelComparison.h"
#include "VoxelSolidTests.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkVoxelContext.h>

#include <algorithm>

using namespace VoxelReference;
using VoxelSolidTests::MakeGrid;

namespace VoxelTetraTests
{

vtkSmartPointer<Voxelizer> MakeVoxelizer(vtkPolyData* mesh, vtkImageData* grid, const Way& way)
{
  auto voxelizer = MakeVoxelizer(mesh, grid, way.Backend);
  voxelizer->SetRasterMethod(way.Method);
  return voxelizer;
}

vtkSmartPointer<Voxelizer> MakeVoxelizer(vtkPolyData* mesh, vtkImageData* grid, int backend)
{
  auto voxelizer = vtkSmartPointer<Voxelizer>::New();
  voxelizer->SetInputData(mesh);
  voxelizer->SetReferenceImage(grid);
  voxelizer->SetBackend(backend);
  return voxelizer;
}

std::string NameOf(Voxelizer* voxelizer)
{
  const char* const methods[] = { " by slices", " by layers", "" };
  const int backend = voxelizer->GetBackend();
  return VoxelSolidTests::NameOf(backend) +
    (backend == vtkVoxelizer::BACKEND_RASTER ? methods[voxelizer->GetRasterMethod()] : "");
}

std::vector<Settings> AllSettings()
{
  return {
    { "fixed rotation", [](Voxelizer* v) { v->SetFixedRotation(37.0, 1.0, 2.0, -0.5); } },
    { "any rotation", [](Voxelizer* v) { v->SetRotationModeToUniform(); } },
    { "about an axis",
      [](Voxelizer* v)
      {
        v->SetRotationModeToAxis();
        v->SetRotationAxis(1.0, 0.5, 3.0);
      } },
    { "scaled", [](Voxelizer* v) { v->SetScaleRange(0.5, 1.5); } },
    { "displaced",
      [](Voxelizer* v)
      {
        v->SetDisplacementAmplitude(0.02);
        v->SetSeed(5);
      } },
    { "displaced normally",
      [](Voxelizer* v)
      {
        v->SetDisplacementAmplitude(0.02);
        v->SetDisplacementDistributionToNormal();
      } },
    { "displaced along normals",
      [](Voxelizer* v)
      {
        v->SetDisplacementAmplitude(0.03);
        v->SetDisplacementDirectionToAlongNormal();
      } },
    { "fitted", [](Voxelizer* v) { v->SafeScaleToFitOn(); } },
    { "all at once",
      [](Voxelizer* v)
      {
        v->SetRotationModeToUniform();
        v->SetScaleRange(0.5, 1.5);
        v->SetDisplacementAmplitude(0.01);
        v->SetDisplacementDistributionToNormal();
        v->SetDisplacementDirectionToAlongNormal();
        v->SafeScaleToFitOn();
        v->SetSeed(-3);
      } },
  };
}

vtkSmartPointer<vtkImageData> MakeCube(vtkPolyData* mesh, int n, int margin)
{
  double centre[3];
  mesh->GetCenter(centre);
  const double* b = mesh->GetBounds();
  const double size = std::max({ b[1] - b[0], b[3] - b[2], b[5] - b[4] }) / n;
  const int voxels = n + 2 * margin;
  const double first = -0.5 * (voxels - 1) + 0.0731;
  return MakeGrid({ 0, voxels - 1, 0, voxels - 1, 0, voxels - 1 },
    { centre[0] + first * size, centre[1] + first * size, centre[2] + first * size },
    { size, size, size });
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
  const bool isExact = voxelizer->GetUsedBackend() == vtkVoxelizer::BACKEND_COMPUTE ||
    voxelizer->GetRasterMethod() == Voxelizer::RASTER_COLUMNS;
  return Report(name + ", " + NameOf(voxelizer), Compare(voxelizer->GetOutput(), expected), mesh,
    VoxelSolidTests::ToleranceOf(
      isExact ? vtkVoxelizer::BACKEND_COMPUTE : vtkVoxelizer::BACKEND_RASTER));
}

}
