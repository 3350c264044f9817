// Times the filters that work on bits, on the solid bunny (or the first mesh there is) at 512
// voxels along its longest side, bits on the GPU to bits on the GPU, by a box or a sphere of so
// many voxels on each axis:
//
//   Dilate/SIZE, Open/SIZE, DilateSphere/SIZE
//                    vtkVoxelMorphology
//   DilateVTK/SIZE   vtkImageDilateErode3D, image to image, its own ellipsoid
//   Union/512        vtkVoxelBoolean of two inputs
//   Density/SIZE     vtkVoxelDensityNormals, bits on the GPU to arrays of density and normals for
//                    every voxel; DensityCoarse/SIZE for every box, DensityCount/SIZE without
//                    normals
//   Chain/SIZE       two meshes to solids in the same grid, their difference, dilated by 3 voxels
//                    in a box, its density in boxes of SIZE^3 and normals for every voxel;
//                    ChainSphere/SIZE dilated by a sphere
//   ChainVTK/8       as ChainSphere with VTK's filters for images, the same voxels to dilate by;
//                    ChainVTKLines/8 as Chain, by lines along x, y and z, which make the box
// with the number of voxels of the dilated solid as Voxels,
//
// and level sets of a volume of 512^3 shorts, in memory to bits on the GPU, of so many values:
//
//   LevelSets/COUNT  vtkImageToSlicemap
//   CopyScalars/512  std::memcpy of the scalars
//   ThresholdVTK/1   vtkImageThreshold, to an image of unsigned char

#include "VoxelBenchmarks.h"

#include <vtkAlgorithmOutput.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkImageDilateErode3D.h>
#include <vtkImageGradient.h>
#include <vtkImageLogic.h>
#include <vtkImageNormalize.h>
#include <vtkImageSeparableConvolution.h>
#include <vtkImageStencilToImage.h>
#include <vtkImageThreshold.h>
#include <vtkImageToSlicemap.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataToImageStencil.h>
#include <vtkSlicemap.h>
#include <vtkSlicemapSolidVoxelizer.h>
#include <vtkSphereSource.h>
#include <vtkVoxelBoolean.h>
#include <vtkVoxelDensityNormals.h>
#include <vtkVoxelMorphology.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

using namespace VoxelBenchmarks;

namespace
{
constexpr int Resolution = 512;
constexpr int DilationSize = 7;
constexpr int Margin = 8;

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

template <bool Downsample, int NormalMode>
void Density(benchmark::State& state, const Mesh& mesh)
{
  const auto solid = MakeSolid(mesh);
  solid->HostOutputOff();
  const int size = static_cast<int>(state.range(0));
  vtkNew<vtkVoxelDensityNormals> filter;
  filter->SetInputConnection(solid->GetOutputPort());
  filter->SetKernelSize(size, size, size);
  filter->SetDownsample(Downsample);
  filter->SetNormalMode(NormalMode);
  filter->SetDensityType(NormalMode == vtkVoxelDensityNormals::NORMALS_OFF
      ? vtkVoxelDensityNormals::DENSITY_COUNT
      : vtkVoxelDensityNormals::DENSITY_FRACTION);
  filter->Update();
  for (auto _ : state)
  {
    filter->Modified();
    filter->Update();
  }
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

void CopyScalars(benchmark::State& state)
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

/// A sphere in the middle of the mesh, about half as large.
vtkSmartPointer<vtkSphereSource> MakeTool(const Mesh& mesh)
{
  auto sphere = vtkSmartPointer<vtkSphereSource>::New();
  sphere->SetCenter(mesh->GetCenter());
  sphere->SetRadius(0.25 * mesh->GetLength());
  sphere->SetThetaResolution(100);
  sphere->SetPhiResolution(100);
  sphere->Update();
  return sphere;
}

template <int KernelType>
void Chain(benchmark::State& state, const Mesh& mesh)
{
  const auto tool = MakeTool(mesh);
  const auto solid = MakeSolid(mesh);
  solid->HostOutputOff();
  solid->SetPadding(Margin);
  solid->Update();
  vtkNew<vtkSlicemapSolidVoxelizer> other;
  other->SetInputConnection(tool->GetOutputPort());
  other->SetReferenceImage(solid->GetOutput());
  other->HostOutputOff();
  vtkNew<vtkVoxelBoolean> difference;
  difference->SetOperationToDifference();
  difference->SetInputConnection(solid->GetOutputPort());
  difference->AddInputConnection(other->GetOutputPort());
  difference->HostOutputOff();
  vtkNew<vtkVoxelMorphology> dilation;
  dilation->SetInputConnection(difference->GetOutputPort());
  dilation->SetKernelSize(DilationSize, DilationSize, DilationSize);
  dilation->SetKernelType(KernelType);
  dilation->HostOutputOff();
  const int size = static_cast<int>(state.range(0));
  vtkNew<vtkVoxelDensityNormals> density;
  density->SetInputConnection(dilation->GetOutputPort());
  density->SetKernelSize(size, size, size);
  for (auto _ : state)
  {
    solid->Modified();
    other->Modified();
    density->Update();
  }
  const vtkIdType readBacks = vtkSlicemap::GetNumberOfReadBacks();
  solid->Modified();
  other->Modified();
  density->Update();
  state.counters["ReadBacks"] =
    static_cast<double>(vtkSlicemap::GetNumberOfReadBacks() - readBacks);
  state.counters["Voxels"] = static_cast<double>(dilation->GetNumberOfFilledVoxels());
}

vtkSmartPointer<vtkPolyDataToImageStencil> MakeStencil(vtkPolyData* mesh, vtkImageData* grid)
{
  auto stencil = vtkSmartPointer<vtkPolyDataToImageStencil>::New();
  stencil->SetInputData(mesh);
  stencil->SetInformationInput(grid);
  return stencil;
}

/// Of an image of zeros and ones.
double CountVoxels(vtkImageData* image)
{
  const auto* values = static_cast<const unsigned char*>(image->GetScalarPointer());
  return static_cast<double>(std::count(values, values + image->GetNumberOfPoints(), 1));
}

/// Kernels follow one another.
vtkSmartPointer<vtkImageDilateErode3D> MakeDilation(
  vtkAlgorithmOutput* input, const std::vector<std::array<int, 3>>& kernels)
{
  vtkSmartPointer<vtkImageDilateErode3D> last;
  for (const auto& kernel : kernels)
  {
    auto dilation = vtkSmartPointer<vtkImageDilateErode3D>::New();
    dilation->SetInputConnection(last ? last->GetOutputPort() : input);
    dilation->SetDilateValue(1);
    dilation->SetErodeValue(0);
    dilation->SetKernelSize(kernel[0], kernel[1], kernel[2]);
    last = dilation;
  }
  return last;
}

template <bool ByLines>
void ChainVTK(benchmark::State& state, const Mesh& mesh)
{
  const auto tool = MakeTool(mesh);
  const auto solid = MakeSolid(mesh);
  solid->SetPadding(Margin);
  solid->Update();
  vtkNew<vtkImageData> grid;
  grid->CopyStructure(solid->GetOutput());
  const int size = static_cast<int>(state.range(0));
  for (auto _ : state)
  {
    std::array<vtkSmartPointer<vtkImageStencilToImage>, 2> images;
    const std::array<vtkPolyData*, 2> meshes{ mesh, tool->GetOutput() };
    for (std::size_t i = 0; i < images.size(); ++i)
    {
      images[i] = vtkSmartPointer<vtkImageStencilToImage>::New();
      images[i]->SetInputConnection(MakeStencil(meshes[i], grid)->GetOutputPort());
      images[i]->SetOutputScalarTypeToUnsignedChar();
      images[i]->SetInsideValue(i == 0 ? 1 : 0);
      images[i]->SetOutsideValue(i == 0 ? 0 : 1);
    }
    vtkNew<vtkImageLogic> difference;
    difference->SetOperationToAnd();
    difference->SetOutputTrueValue(1);
    difference->SetInputConnection(0, images[0]->GetOutputPort());
    difference->SetInputConnection(1, images[1]->GetOutputPort());
    constexpr int n = DilationSize;
    const auto dilation = MakeDilation(difference->GetOutputPort(),
      ByLines ? std::vector<std::array<int, 3>>{ { n, 1, 1 }, { 1, n, 1 }, { 1, 1, n } }
              : std::vector<std::array<int, 3>>{ { n, n, n } });
    vtkNew<vtkFloatArray> box;
    box->SetNumberOfValues(size + 1); // of odd length, so without a shift
    box->Fill(1.0 / size);
    box->SetValue(size, 0.0f);
    vtkNew<vtkImageSeparableConvolution> density;
    density->SetInputConnection(dilation->GetOutputPort());
    density->SetXKernel(box);
    density->SetYKernel(box);
    density->SetZKernel(box);
    vtkNew<vtkImageGradient> gradient;
    gradient->SetInputConnection(density->GetOutputPort());
    gradient->SetDimensionality(3);
    gradient->HandleBoundariesOn();
    vtkNew<vtkImageNormalize> normals;
    normals->SetInputConnection(gradient->GetOutputPort());
    normals->Update();
    state.PauseTiming();
    state.counters["Voxels"] = CountVoxels(dilation->GetOutput());
    state.ResumeTiming();
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
  using DensityNormals = vtkVoxelDensityNormals;
  AddRows("Density", Density<false, DensityNormals::NORMALS_SYMMETRIC>, mesh, { 2, 4, 8, 16 }, 3);
  AddRows("DensityCoarse", Density<true, DensityNormals::NORMALS_SYMMETRIC>, mesh, { 2, 4, 8 }, 3);
  AddRows("DensityCount", Density<false, DensityNormals::NORMALS_OFF>, mesh, { 2, 4, 8 }, 3);
  AddRows("Chain", Chain<Filter::KERNEL_BOX>, mesh, { 2, 8 }, 3);
  AddRows("ChainSphere", Chain<Filter::KERNEL_SPHERE>, mesh, { 8 }, 3);
  AddRows("ChainVTK", ChainVTK<false>, mesh, { 8 }, 1, 1); // takes a minute
  AddRows("ChainVTKLines", ChainVTK<true>, mesh, { 8 }, 1);
  AddRows("Union", Union, mesh, { Resolution }, 5);
  AddRows("LevelSets", LevelSets, { 1, 4 }, 5);
  AddRows("CopyScalars", CopyScalars, { Resolution }, 5);
  AddRows("ThresholdVTK", ThresholdVTK, { 1 }, 1);
  return RunRows(argc, argv);
}
