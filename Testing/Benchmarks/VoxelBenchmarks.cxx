#include "VoxelBenchmarks.h"

#include <vtkCellArray.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSlicemapSolidVoxelizer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkVoxelCompatibility.h>
#include <vtkVoxelContext.h>
#include <vtkVoxelContextScope.h>

namespace VoxelBenchmarks
{
namespace
{

Mesh Read(const char* file)
{
  char name[] = "benchmark";
  char option[] = "-D";
  char small[] = VTKVOXELIZATION_DATA_DIR;
  char large[] = VTKVOXELIZATION_LARGE_DATA_DIR;
  char* arguments[] = { name, option, small, option, large };
  return VoxelTestMeshes::ReadPLY(file, 5, arguments);
}

}

//------------------------------------------------------------------------------------------------
MeshTable MeshesOfFiles()
{
  const Mesh bunny = Read("bunny.ply");
  const Mesh dragon = Read("dragon.ply");
  if (!bunny || !dragon)
  {
    return { { "bunny_7k", Read("bunny_7k.ply") } };
  }
  return { { "bunny", bunny }, { "dragon", dragon },
    { "dragon_1.6M", VoxelTestMeshes::Subdivided(dragon, 2) } };
}

//------------------------------------------------------------------------------------------------
MeshTable SurfaceMeshes()
{
  MeshTable meshes = MeshesOfFiles();
  meshes["mixed"] = VoxelTestMeshes::MixedScene(1.0);
  meshes["triangle"] = VoxelTestMeshes::FromTriangles(
    { { { { 0.0, 0.1, 0.0 }, { 1.0, 0.0, 0.3 }, { 0.2, 1.0, 1.0 } } } });
  return meshes;
}

//------------------------------------------------------------------------------------------------
void Touch(vtkPolyData* mesh)
{
  mesh->GetPoints()->Modified();
  mesh->GetPolys()->Modified();
  mesh->Modified();
}

//------------------------------------------------------------------------------------------------
void Finish()
{
  vtkNew<vtkVoxelContext> context;
  vtkVoxelContext::Scope scope(context);
  glFinish();
}

vtkSmartPointer<vtkImageData> MakeGrid(vtkPolyData* mesh, int resolution)
{
  vtkNew<vtkSlicemapSolidVoxelizer> voxelizer;
  voxelizer->SetInputData(mesh);
  voxelizer->SetResolution(resolution);
  voxelizer->UpdateInformation();
  vtkInformation* information = voxelizer->GetOutputInformation(0);
  auto grid = vtkSmartPointer<vtkImageData>::New();
  grid->SetExtent(information->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()));
  grid->SetOrigin(information->Get(vtkDataObject::ORIGIN()));
  grid->SetSpacing(information->Get(vtkDataObject::SPACING()));
  return grid;
}

//------------------------------------------------------------------------------------------------
void AddRows(const std::string& name, const std::function<void(benchmark::State&)>& function,
  const std::vector<int>& sizes, int iterations, int repetitions)
{
  for (const int size : sizes)
  {
    const int several = size < 512 ? 5 : 2;
    benchmark::RegisterBenchmark(name.c_str(), function)
      ->Arg(size)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->Iterations(iterations > 0 ? iterations : several)
      ->Repetitions(repetitions)
      ->ReportAggregatesOnly(false);
  }
}

//------------------------------------------------------------------------------------------------
int RunRows(int argc, char* argv[])
{
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}
