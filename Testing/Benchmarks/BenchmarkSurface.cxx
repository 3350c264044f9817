// Times vtkHybridSurfaceVoxelizer. Arguments of a row: voxels along the longest side of the mesh.
//
//   SurfaceImage/MESH  polydata to image of unsigned char, both in memory, upload of the mesh
//   included SurfaceBits/MESH   the same, the result staying on the GPU as bits Triangle/MESH,
//   Fragment/MESH, Hybrid/MESH
//                      bits by each strategy, the mesh on the GPU already; 6-separating, as in the
//                      thesis
//   Raster.../MESH     these three with the Raster backend
//
// BenchmarkSurfaceRivals has the same meshes and sizes.

#include "VoxelBenchmarks.h"

#include <vtkHybridSurfaceVoxelizer.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

using namespace VoxelBenchmarks;

namespace
{
vtkSmartPointer<vtkHybridSurfaceVoxelizer> MakeVoxelizer(const Mesh& mesh, benchmark::State& state)
{
  auto voxelizer = vtkSmartPointer<vtkHybridSurfaceVoxelizer>::New();
  voxelizer->SetInputData(mesh);
  voxelizer->SetResolution(static_cast<int>(state.range(0)));
  return voxelizer;
}

void SurfaceImage(benchmark::State& state, const Mesh& mesh)
{
  const auto voxelizer = MakeVoxelizer(mesh, state);
  voxelizer->Update();
  for (auto _ : state)
  {
    Touch(mesh);
    voxelizer->Update();
  }
}

void SurfaceBits(benchmark::State& state, const Mesh& mesh)
{
  const auto voxelizer = MakeVoxelizer(mesh, state);
  voxelizer->HostOutputOff();
  voxelizer->Update();
  for (auto _ : state)
  {
    Touch(mesh);
    voxelizer->Update();
    Finish();
  }
}

template <int Backend, int Strategy>
void Way(benchmark::State& state, const Mesh& mesh)
{
  const auto voxelizer = MakeVoxelizer(mesh, state);
  voxelizer->HostOutputOff();
  voxelizer->SetSeparabilityTo6();
  voxelizer->SetBackend(Backend);
  voxelizer->SetStrategy(Strategy);
  voxelizer->Update();
  for (auto _ : state)
  {
    voxelizer->Modified();
    voxelizer->Update();
    Finish();
  }
  state.counters["CutoffArea"] = voxelizer->GetUsedCutoffArea();
}

template <int Backend>
void AddWays(const std::string& prefix, const std::string& name, const Mesh& mesh)
{
  using Voxelizer = vtkHybridSurfaceVoxelizer;
  const std::vector<int> sizes = { 128, 256, 512 };
  AddRows(prefix + "Triangle/" + name, Way<Backend, Voxelizer::STRATEGY_TRIANGLE>, mesh, sizes);
  AddRows(prefix + "Fragment/" + name, Way<Backend, Voxelizer::STRATEGY_FRAGMENT>, mesh, sizes, 1);
  AddRows(prefix + "Hybrid/" + name, Way<Backend, Voxelizer::STRATEGY_HYBRID>, mesh, sizes);
}

void AddAllRows()
{
  const std::vector<int> sizes = { 64, 128, 256, 512, 1024 };
  for (const auto& [name, mesh] : SurfaceMeshes())
  {
    AddRows("SurfaceImage/" + name, SurfaceImage, mesh, sizes);
    AddRows("SurfaceBits/" + name, SurfaceBits, mesh, sizes);
    AddWays<vtkVoxelizer::BACKEND_COMPUTE>("", name, mesh);
    // Fragments of millions of tiny triangles take minutes.
    if (mesh->GetNumberOfPolys() < 500000)
    {
      AddWays<vtkVoxelizer::BACKEND_RASTER>("Raster", name, mesh);
    }
  }
}
}

int main(int argc, char* argv[])
{
  AddAllRows();
  return RunRows(argc, argv);
}
