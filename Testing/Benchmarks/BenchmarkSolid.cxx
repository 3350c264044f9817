// Times vtkSlicemapSolidVoxelizer beside a scanline on the CPU (the tests' reference) and
// vtkPolyDataToImageStencil. Arguments of a row: voxels along the longest side of the mesh.
//
//   Update/MESH    polydata to image of unsigned char, both in memory, upload of the mesh included
//   Bits/MESH      the same, the result staying on the GPU as bits
//   Pass/MESH      bits again, the mesh on the GPU already: a change of the grid alone
//   Scanline/MESH  VoxelReference::CrossingParityReference, two threads, unsigned char
//   Stencil/MESH   vtkPolyDataToImageStencil and vtkImageStencilToImage, unsigned char
//   Scan           an update whose triangles do not count: the parity scan of n^3 bits, clearing
//                  them, and what an update takes besides, which is that of 8^3 bits
//   Clear, Copy    clearing n^3 bits, and copying them
//
// Meshes are those of the large data, if the build knows where they are, else the bundled one.

#include "VoxelBenchmarks.h"
#include "VoxelReference.h"
#include "VoxelTestMeshes.h"

#include <vtkImageData.h>
#include <vtkImageStencilToImage.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataToImageStencil.h>
#include <vtkSlicemap.h>
#include <vtkSlicemapSolidVoxelizer.h>
#include <vtkVoxelContext.h>
#include <vtkVoxelContextScope.h>
#include <vtkVoxelGLObjects.h>

#include <cstddef>
#include <vector>

using namespace VoxelBenchmarks;

namespace
{

vtkSmartPointer<vtkSlicemapSolidVoxelizer> MakeVoxelizer(const Mesh& mesh, int resolution)
{
  auto voxelizer = vtkSmartPointer<vtkSlicemapSolidVoxelizer>::New();
  voxelizer->SetInputData(mesh);
  voxelizer->SetResolution(resolution);
  return voxelizer;
}

void Update(benchmark::State& state, const Mesh& mesh)
{
  const auto voxelizer = MakeVoxelizer(mesh, static_cast<int>(state.range(0)));
  voxelizer->Update();
  for (auto _ : state)
  {
    Touch(mesh);
    voxelizer->Update();
  }
}

void Bits(benchmark::State& state, const Mesh& mesh)
{
  const auto voxelizer = MakeVoxelizer(mesh, static_cast<int>(state.range(0)));
  voxelizer->HostOutputOff();
  voxelizer->Update();
  for (auto _ : state)
  {
    Touch(mesh);
    voxelizer->Update();
    Finish();
  }
}

void Pass(benchmark::State& state, const Mesh& mesh)
{
  const auto voxelizer = MakeVoxelizer(mesh, static_cast<int>(state.range(0)));
  voxelizer->HostOutputOff();
  voxelizer->Update();
  for (auto _ : state)
  {
    voxelizer->Modified();
    voxelizer->Update();
    Finish();
  }
}

void Scanline(benchmark::State& state, const Mesh& mesh)
{
  const auto grid =
    VoxelReference::Grid::FromImage(MakeGrid(mesh, static_cast<int>(state.range(0))));
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(VoxelReference::CrossingParityReference(mesh, grid));
  }
}

void Stencil(benchmark::State& state, const Mesh& mesh)
{
  const auto grid = MakeGrid(mesh, static_cast<int>(state.range(0)));
  vtkNew<vtkPolyDataToImageStencil> stencil;
  stencil->SetInputData(mesh);
  stencil->SetOutputOrigin(grid->GetOrigin());
  stencil->SetOutputSpacing(grid->GetSpacing());
  stencil->SetOutputWholeExtent(grid->GetExtent());
  vtkNew<vtkImageStencilToImage> image;
  image->SetInputConnection(stencil->GetOutputPort());
  image->SetOutputScalarTypeToUnsignedChar();
  for (auto _ : state)
  {
    Touch(mesh);
    image->Update();
  }
}

void Scan(benchmark::State& state)
{
  // A mesh too small to matter: what remains is to clear the bits and to scan them.
  const auto n = static_cast<int>(state.range(0));
  const auto voxelizer = MakeVoxelizer(VoxelTestMeshes::Box({ 1, 1, 1 }, { 2, 2, 2 }), 1);
  voxelizer->SetOutputWholeExtent(0, n - 1, 0, n - 1, 0, n - 1);
  voxelizer->HostOutputOff();
  voxelizer->CheckWatertightOff();
  voxelizer->Update();
  for (auto _ : state)
  {
    voxelizer->Modified();
    voxelizer->Update();
    Finish();
  }
}

/// Two buffers of n^3 bits, and work on them.
template <typename Work>
void OnBuffers(benchmark::State& state, Work&& work)
{
  const auto bytes = static_cast<std::size_t>(state.range(0) * state.range(0) * state.range(0) / 8);
  vtkNew<vtkVoxelContext> context;
  vtkVoxelContext::Scope scope(context);
  vtkVoxelGL::Buffer from(context->GetRecord());
  vtkVoxelGL::Buffer to(context->GetRecord());
  if (!from.Allocate(bytes) || !to.Allocate(bytes))
  {
    state.SkipWithError("no memory");
    return;
  }
  from.Fill(0);
  to.Fill(0);
  glFinish();
  for (auto _ : state)
  {
    work(from, to, bytes);
    glFinish();
  }
}

void Clear(benchmark::State& state)
{
  OnBuffers(state, [](auto& from, auto&, std::size_t) { from.Fill(0); });
}

void Copy(benchmark::State& state)
{
  OnBuffers(state, [](auto& from, auto& to, std::size_t bytes) { from.CopyTo(to, 0, 0, bytes); });
}

void AddAllRows()
{
  MeshTable meshes = MeshesOfFiles();
  meshes["box"] = VoxelTestMeshes::Rotated(VoxelTestMeshes::Box({ 0, 0, 0 }, { 1, 1, 1 }));
  meshes["knot_1M"] = VoxelTestMeshes::TorusKnot(1.0, 250, 2000);
  const std::vector<int> sizes = { 64, 128, 256, 512, 1024 };
  for (const auto& [name, mesh] : meshes)
  {
    AddRows("Update/" + name, Update, mesh, sizes);
    AddRows("Bits/" + name, Bits, mesh, sizes);
    AddRows("Pass/" + name, Pass, mesh, sizes);
    AddRows("Scanline/" + name, Scanline, mesh, sizes);
    if (mesh->GetNumberOfPolys() < 500000)
    {
      AddRows("Stencil/" + name, Stencil, mesh, { 64, 128, 256 });
    }
  }
  AddRows("Scan", Scan, { 8, 256, 512, 1024 });
  AddRows("Clear", Clear, { 256, 512, 1024 });
  AddRows("Copy", Copy, { 256, 512, 1024 });
}

}

int main(int argc, char* argv[])
{
  AddAllRows();
  return RunRows(argc, argv);
}
