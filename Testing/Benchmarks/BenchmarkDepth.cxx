// Times vtkDepthBufferVoxelizer on the objects that Karabassi, Papaioannou and Theoharis timed it
// on, or rather on such as have as many triangles, and on meshes of ever more triangles. Mesh in
// memory, upload included, to image in memory:
//
//   OBJECT/Solid/SIZE, OBJECT/Surface/SIZE, OBJECT/Density/SIZE   along three axes, from the input
//   OBJECT/Prop/SIZE    solid, of an actor
//   OBJECT/Parity/SIZE  vtkSlicemapSolidVoxelizer, for comparison
//   Sphere_TRIANGLES/Solid/256, Sphere_TRIANGLES/Parity/256  one shape from few to many triangles
//
// The counter "voxels" is the number of voxels that are set.

#include "VoxelBenchmarks.h"

#include <vtkActor.h>
#include <vtkDepthBufferVoxelizer.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkSlicemapSolidVoxelizer.h>

using namespace VoxelBenchmarks;

namespace
{
const std::vector<int> Sizes = { 64, 128, 256, 512 };
constexpr int SizeOfMany = 256;

void Time(benchmark::State& state, vtkVoxelizer* voxelizer, const Mesh& mesh)
{
  voxelizer->SetReferenceImage(MakeGrid(mesh, static_cast<int>(state.range(0))));
  voxelizer->Update();
  for (auto _ : state)
  {
    Touch(mesh);
    voxelizer->Update();
  }
  state.counters["voxels"] = static_cast<double>(voxelizer->GetNumberOfFilledVoxels());
}

template <int OutputMode>
void Depth(benchmark::State& state, const Mesh& mesh)
{
  vtkNew<vtkDepthBufferVoxelizer> voxelizer;
  voxelizer->SetInputData(mesh);
  voxelizer->SetOutputMode(OutputMode);
  Time(state, voxelizer, mesh);
}

void Prop(benchmark::State& state, const Mesh& mesh)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkDepthBufferVoxelizer> voxelizer;
  voxelizer->AddProp(actor);
  Time(state, voxelizer, mesh);
}

void Parity(benchmark::State& state, const Mesh& mesh)
{
  vtkNew<vtkSlicemapSolidVoxelizer> voxelizer;
  voxelizer->SetInputData(mesh);
  Time(state, voxelizer, mesh);
}
}

int main(int argc, char* argv[])
{
  for (const auto& [name, mesh] : VoxelTestMeshes::PaperObjects())
  {
    AddRows(name + "/Solid", Depth<vtkDepthBufferVoxelizer::OUTPUT_MODE_SOLID>, mesh, Sizes);
    AddRows(name + "/Surface", Depth<vtkDepthBufferVoxelizer::OUTPUT_MODE_SURFACE>, mesh, Sizes);
    AddRows(name + "/Density", Depth<vtkDepthBufferVoxelizer::OUTPUT_MODE_DENSITY>, mesh, Sizes);
    AddRows(name + "/Prop", Prop, mesh, Sizes);
    AddRows(name + "/Parity", Parity, mesh, Sizes);
  }
  for (const int resolution : { 16, 64, 256, 1024 })
  {
    const Mesh sphere = VoxelTestMeshes::Sphere({ 0, 0, 0 }, 1.0, resolution);
    const std::string name = "Sphere_" + std::to_string(sphere->GetNumberOfPolys());
    AddRows(
      name + "/Solid", Depth<vtkDepthBufferVoxelizer::OUTPUT_MODE_SOLID>, sphere, { SizeOfMany });
    AddRows(name + "/Parity", Parity, sphere, { SizeOfMany });
  }
  return RunRows(argc, argv);
}
