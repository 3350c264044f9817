// Times variants of models by vtkTetraCoveringVoxelizer: any rotation, scales of 0.5 to 1.5, normal
// displacements, fitted into n^3 voxels. Items are variants, and the time of a row is that of a
// batch. Models have 10,000, 100,000 and 265,000 triangles: knots and, if the build knows where the
// large data are, the dragon.
//
//   Batch/MODEL        a batch of unsigned char in host memory, 16 MiB or eight variants
//   Rotated/MODEL      the same without displacements and scales
//   Direct/MODEL       the variants of a batch as bits, given to a function and stored nowhere
//   Shell/MODEL        shells by 26 neighbours
//   Bits/MODEL         one variant that stays on the GPU
//   First/MODEL        one variant of a mesh that was not there before
//   Columns/MODEL, Layers/MODEL, Slices/MODEL   batches by the ways of the Raster backend
//   Stencil/MODEL      each variant's mesh, made on the CPU, by vtkPolyDataToImageStencil and
//                      vtkImageStencilToImage, unsigned char
//
// With --models=FOLDER alone it writes the models as .ply files, for rivals_variants.py.

#include "VoxelBenchmarks.h"

#include <vtkImageData.h>
#include <vtkImageStencilToImage.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPLYWriter.h>
#include <vtkPolyData.h>
#include <vtkPolyDataToImageStencil.h>
#include <vtkTetraCoveringVoxelizer.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstdint>
#include <string>

using namespace VoxelBenchmarks;

namespace
{
using Voxelizer = vtkTetraCoveringVoxelizer;

/// So many that the bytes of a batch are 16 MiB, and eight at least.
int VariantsOfBatch(const benchmark::State& state)
{
  const std::int64_t n = state.range(0);
  return static_cast<int>(std::max<std::int64_t>(8, (std::int64_t(1) << 24) / (n * n * n)));
}

vtkSmartPointer<Voxelizer> MakeVoxelizer(
  const Mesh& mesh, const benchmark::State& state, int backend = Voxelizer::BACKEND_AUTO)
{
  const auto n = static_cast<int>(state.range(0));
  auto voxelizer = vtkSmartPointer<Voxelizer>::New();
  voxelizer->SetInputData(mesh);
  voxelizer->SetSampleDimensions(n, n, n);
  voxelizer->SetBackend(backend);
  voxelizer->SetRotationModeToUniform();
  voxelizer->SetScaleRange(0.5, 1.5);
  voxelizer->SetDisplacementAmplitude(0.002);
  voxelizer->SetDisplacementDistributionToNormal();
  voxelizer->SafeScaleToFitOn();
  return voxelizer;
}

void RunBatches(benchmark::State& state, Voxelizer* voxelizer, int variants)
{
  vtkNew<vtkUnsignedCharArray> batch;
  voxelizer->VoxelizeBatch(0, variants, batch);
  vtkTypeInt64 first = variants;
  for (auto _ : state)
  {
    voxelizer->VoxelizeBatch(first, variants, batch);
    first += variants;
  }
  state.SetItemsProcessed(state.iterations() * variants);
}

void Batch(benchmark::State& state, const Mesh& mesh)
{
  RunBatches(state, MakeVoxelizer(mesh, state), VariantsOfBatch(state));
}

void Rotated(benchmark::State& state, const Mesh& mesh)
{
  const auto voxelizer = MakeVoxelizer(mesh, state);
  voxelizer->SetScaleRange(1.0, 1.0);
  voxelizer->SetDisplacementAmplitude(0.0);
  RunBatches(state, voxelizer, VariantsOfBatch(state));
}

void Direct(benchmark::State& state, const Mesh& mesh)
{
  const auto voxelizer = MakeVoxelizer(mesh, state);
  const int variants = VariantsOfBatch(state);
  vtkTypeInt64 first = 0;
  const auto visit = [](int, const vtkVoxelGrid&, const std::uint32_t* words)
  {
    benchmark::DoNotOptimize(words[0]);
    return true;
  };
  const auto run = [&]
  {
    voxelizer->VisitBatch(first, variants, visit);
    first += variants;
  };
  run();
  for (auto _ : state)
  {
    run();
  }
  state.SetItemsProcessed(state.iterations() * variants);
}

void Shell(benchmark::State& state, const Mesh& mesh)
{
  const auto voxelizer = MakeVoxelizer(mesh, state);
  voxelizer->SetShell(Voxelizer::SHELL_26);
  RunBatches(state, voxelizer, VariantsOfBatch(state));
}

void Bits(benchmark::State& state, const Mesh& mesh)
{
  const auto voxelizer = MakeVoxelizer(mesh, state);
  voxelizer->HostOutputOff();
  voxelizer->Update();
  for (auto _ : state)
  {
    voxelizer->SetVariant(voxelizer->GetVariant() + 1);
    voxelizer->Update();
    Finish();
  }
  state.SetItemsProcessed(state.iterations());
}

void First(benchmark::State& state, const Mesh& mesh)
{
  const auto voxelizer = MakeVoxelizer(mesh, state);
  voxelizer->Update();
  for (auto _ : state)
  {
    Touch(mesh);
    voxelizer->Update();
  }
  state.SetItemsProcessed(state.iterations());
}

template <int Method>
void Raster(benchmark::State& state, const Mesh& mesh)
{
  const auto voxelizer = MakeVoxelizer(mesh, state, Voxelizer::BACKEND_RASTER);
  voxelizer->SetRasterMethod(Method);
  RunBatches(state, voxelizer, 1);
}

void Stencil(benchmark::State& state, const Mesh& mesh)
{
  const auto voxelizer = MakeVoxelizer(mesh, state);
  voxelizer->Update();
  vtkImageData* grid = voxelizer->GetOutput();
  vtkNew<vtkMatrix4x4> matrix;
  vtkNew<vtkTransform> transform;
  vtkNew<vtkTransformPolyDataFilter> moved;
  moved->SetInputData(mesh);
  moved->SetTransform(transform);
  vtkNew<vtkPolyDataToImageStencil> stencil;
  stencil->SetInputConnection(moved->GetOutputPort());
  stencil->SetOutputOrigin(grid->GetOrigin());
  stencil->SetOutputSpacing(grid->GetSpacing());
  stencil->SetOutputWholeExtent(grid->GetExtent());
  vtkNew<vtkImageStencilToImage> image;
  image->SetInputConnection(stencil->GetOutputPort());
  image->SetOutputScalarTypeToUnsignedChar();
  vtkTypeInt64 variant = 0;
  for (auto _ : state)
  {
    voxelizer->GetVariantMatrix(variant++, matrix);
    transform->SetMatrix(matrix);
    image->Update();
  }
  state.SetItemsProcessed(state.iterations());
}

/// The models as files, for rivals.
void WriteModels(const MeshTable& models, const std::string& folder)
{
  for (const auto& [name, mesh] : models)
  {
    vtkNew<vtkPLYWriter> writer;
    writer->SetInputData(mesh);
    writer->SetFileName((folder + "/" + name + ".ply").c_str());
    writer->SetFileTypeToBinary();
    writer->Write();
  }
}
}

int main(int argc, char* argv[])
{
  const std::string option = "--models=";
  MeshTable meshes = MeshesOfFiles();
  MeshTable models{ { "10k", VoxelTestMeshes::TorusKnot(1.0, 40, 125) },
    { "265k", VoxelTestMeshes::TorusKnot(1.0, 250, 530) } };
  models["100k"] =
    meshes.count("dragon") ? meshes["dragon"] : VoxelTestMeshes::TorusKnot(1.0, 100, 500);
  if (argc == 2 && std::string(argv[1]).compare(0, option.size(), option) == 0)
  {
    WriteModels(models, std::string(argv[1]).substr(option.size()));
    return 0;
  }
  const std::vector<int> sizes = { 64, 256 };
  for (const auto& [name, mesh] : models)
  {
    AddRows("Batch/" + name, Batch, mesh, sizes);
    AddRows("Rotated/" + name, Rotated, mesh, sizes);
    AddRows("Direct/" + name, Direct, mesh, sizes);
    AddRows("Shell/" + name, Shell, mesh, sizes);
    AddRows("Bits/" + name, Bits, mesh, sizes);
    AddRows("First/" + name, First, mesh, sizes);
    AddRows("Columns/" + name, Raster<Voxelizer::RASTER_COLUMNS>, mesh, sizes, 1);
    AddRows("Layers/" + name, Raster<Voxelizer::RASTER_LAYERS>, mesh, sizes, 1);
    AddRows("Slices/" + name, Raster<Voxelizer::RASTER_SLICES>, mesh, sizes, 1);
    AddRows("Stencil/" + name, Stencil, mesh, sizes, 3);
  }
  return RunRows(argc, argv);
}
