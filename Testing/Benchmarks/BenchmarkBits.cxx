// Times the filters that work on bits, on the solid bunny (or the first mesh there is) at 512
// voxels along its longest side, bits on the GPU to bits on the GPU, by a box or a sphere of so
// many voxels on each axis:
//
//   Dilate/SIZE, Open/SIZE, DilateSphere/SIZE  vtkVoxelMorphology
//   DilateVTK/SIZE                             vtkImageDilateErode3D, image to image, its own
//                                              ellipsoid
//   Union/512                                  vtkVoxelBoolean of two inputs
//
// and level sets of a volume of 512^3 shorts, in memory to bits on the GPU, of so many values:
//
//   LevelSets/COUNT                            vtkImageToSlicemap
//   Copy/512                                   std::memcpy of the scalars
//   ThresholdVTK/1                             vtkImageThreshold, to an image of unsigned char

#include "VoxelBenchmarks.h"

#include <vtkImageData.h>
#include <vtkImageDilateErode3D.h>
#include <vtkImageThreshold.h>
#include <vtkImageToSlicemap.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSlicemapSolidVoxelizer.h>
#include <vtkVoxelBoolean.h>
#include <vtkVoxelMorphology.h>

#include <cstring>
#include <vector>

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

/// Smooth enough that neighbours are alike, as in a CT.
vtkSmartPointer<vtkImageData> MakeVolume()
{
  auto volume = vtkSmartPointer<vtkImageData>::New();
  volume->SetDimensions(Resolution, Resolution, Resolution);
  volume->AllocateScalars(VTK_SHORT, 1);
  auto* scalar = static_cast<short*>(volume->GetScalarPointer());
  for (int z = 0; z < Resolution; ++z)
  {
    for (int y = 0; y < Resolution; ++y)
    {
      for (int x = 0; x < Resolution; ++x)
      {
        *scalar++ = static_cast<short>((x ^ y ^ z) + x + y);
      }
    }
  }
  return volume;
}

void LevelSets(benchmark::State& state)
{
  vtkNew<vtkImageToSlicemap> filter;
  filter->SetInputData(MakeVolume());
  for (int i = 0; i < state.range(0); ++i)
  {
    filter->SetValue(i, 200.5 + 200.0 * i);
  }
  Run(state, filter);
}

void Copy(benchmark::State& state)
{
  const auto volume = MakeVolume();
  const auto bytes = static_cast<std::size_t>(volume->GetNumberOfPoints()) * sizeof(short);
  std::vector<char> copy(bytes);
  for (auto _ : state)
  {
    std::memcpy(copy.data(), volume->GetScalarPointer(), bytes);
    benchmark::DoNotOptimize(copy.data());
    benchmark::ClobberMemory();
  }
}

void ThresholdVTK(benchmark::State& state)
{
  vtkNew<vtkImageThreshold> filter;
  filter->SetInputData(MakeVolume());
  filter->ThresholdByUpper(200.5);
  filter->SetInValue(1);
  filter->SetOutValue(0);
  filter->SetOutputScalarTypeToUnsignedChar();
  for (auto _ : state)
  {
    filter->Modified();
    filter->Update();
  }
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
  AddRows("LevelSets", LevelSets, { 1, 4 }, 5);
  AddRows("Copy", Copy, { Resolution }, 5);
  AddRows("ThresholdVTK", ThresholdVTK, { 1 }, 1);
  return RunRows(argc, argv);
}
