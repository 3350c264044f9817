// Times the filters that work on bits, on the solid bunny (or the first mesh there is) at 512
// voxels along its longest side, bits on the GPU to bits on the GPU, by a box or a sphere of so
// many voxels on each axis:
//
//   Dilate/SIZE, Open/SIZE, DilateSphere/SIZE  vtkVoxelMorphology
//   DilateVTK/SIZE                             vtkImageDilateErode3D, image to image, its own
//   ellipsoid Union/512                                  vtkVoxelBoolean of two inputs

#include "VoxelBenchmarks.h"

#include <vtkImageData.h>
#include <vtkImageDilateErode3D.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSlicemapSolidVoxelizer.h>
#include <vtkVoxelBoolean.h>
#include <vtkVoxelMorphology.h>

using namespace VoxelBenchmarks;

namespace
{
constexpr int Resolution = 512;

vtkSmartPointer<vtkSlicemapSolidVoxelizer> MakeSolid(const Mesh& mesh)
{
  auto solid = vtkSmartPointer<vtkSlicemapSolidVoxelizer>::New();
  solid->SetInputData(mesh);
  solid->SetResolution(Resolution);
  return solid;
}

void Run(benchmark::State& state, vtkVoxelFilter* filter)
{
  filter->HostOutputOff();
  filter->Update();
  Finish();
  for (auto _ : state)
  {
    filter->Modified();
    filter->Update();
    Finish();
  }
}

template <int Operation, int Kernel>
void Morphology(benchmark::State& state, const Mesh& mesh)
{
  const auto solid = MakeSolid(mesh);
  solid->HostOutputOff();
  const int size = static_cast<int>(state.range(0));
  vtkNew<vtkVoxelMorphology> filter;
  filter->SetInputConnection(solid->GetOutputPort());
  filter->SetOperation(Operation);
  filter->SetKernelType(Kernel);
  filter->SetKernelSize(size, size, size);
  Run(state, filter);
}

void DilateVTK(benchmark::State& state, const Mesh& mesh)
{
  const auto solid = MakeSolid(mesh);
  solid->Update();
  const int size = static_cast<int>(state.range(0));
  vtkNew<vtkImageDilateErode3D> filter;
  filter->SetInputData(solid->GetOutput());
  filter->SetDilateValue(1);
  filter->SetErodeValue(0);
  filter->SetKernelSize(size, size, size);
  for (auto _ : state)
  {
    filter->Modified();
    filter->Update();
  }
}

void Union(benchmark::State& state, const Mesh& mesh)
{
  const auto solid = MakeSolid(mesh);
  solid->HostOutputOff();
  vtkNew<vtkVoxelMorphology> other;
  other->SetInputConnection(solid->GetOutputPort());
  other->HostOutputOff();
  vtkNew<vtkVoxelBoolean> filter;
  filter->SetInputConnection(solid->GetOutputPort());
  filter->AddInputConnection(other->GetOutputPort());
  Run(state, filter);
}
}

int main(int argc, char* argv[])
{
  using Filter = vtkVoxelMorphology;
  const Mesh mesh = MeshesOfFiles().begin()->second;
  AddRows("Dilate", Morphology<Filter::OPERATION_DILATE, Filter::KERNEL_BOX>, mesh,
    { 3, 7, 15, 31, 63, 127 }, 5);
  AddRows("Open", Morphology<Filter::OPERATION_OPEN, Filter::KERNEL_BOX>, mesh, { 3, 7 }, 5);
  AddRows("DilateSphere", Morphology<Filter::OPERATION_DILATE, Filter::KERNEL_SPHERE>, mesh,
    { 3, 7, 15 }, 1);
  AddRows("DilateVTK", DilateVTK, mesh, { 3 }, 1);
  AddRows("Union", Union, mesh, { Resolution }, 5);
  return RunRows(argc, argv);
}
