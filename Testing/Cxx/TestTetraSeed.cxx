// Proves that variants of vtkTetraCoveringVoxelizer are the same, bit for bit, on both backends,
// whatever is done to the mesh, and those of a seed the same on all machines: their checksum is
// fixed, with compute shaders and without.

#include "VoxelSolidTests.h"
#include "VoxelTestObservers.h"
#include "VoxelTetraTests.h"

#include <vtkImageData.h>
#include <vtkUnsignedCharArray.h>

#include <cstdlib>
#include <cstring>
#include <iostream>

using namespace VoxelTestMeshes;
using VoxelTetraTests::AllSettings;
using VoxelTetraTests::MakeCube;
using VoxelTetraTests::MakeVoxelizer;
using VoxelTetraTests::NameOf;

namespace
{
std::uint64_t Checksum(vtkUnsignedCharArray* values)
{
  std::uint64_t sum = 0xcbf29ce484222325u;
  for (vtkIdType i = 0; i < values->GetNumberOfValues(); ++i)
  {
    sum = (sum ^ values->GetValue(i)) * 0x100000001b3u;
  }
  return sum;
}

/// What Compute and Raster make of the same variants.
void CompareBackends(VoxelTestChecks& checks, const std::string& name, vtkPolyData* mesh,
  vtkImageData* grid, const VoxelTetraTests::Settings& settings)
{
  std::vector<vtkSmartPointer<vtkUnsignedCharArray>> found;
  for (const int backend : VoxelTetraTests::AvailableBackends())
  {
    const auto voxelizer = MakeVoxelizer(mesh, grid, backend);
    settings.Apply(voxelizer);
    voxelizer->CheckWatertightOff();
    found.push_back(vtkSmartPointer<vtkUnsignedCharArray>::New());
    constexpr int variants = 3;
    checks.Check(name + ": a batch, " + NameOf(voxelizer),
      voxelizer->VoxelizeBatch(7, variants, found.back()) && found.back()->GetRange()[1] == 1);
    const bool same = found[0]->GetNumberOfValues() == found.back()->GetNumberOfValues() &&
      std::memcmp(found[0]->GetPointer(0), found.back()->GetPointer(0),
        found.back()->GetNumberOfValues()) == 0;
    checks.Check(name + ", " + settings.Name + ": the same on both backends", same);
  }
}

bool TestBackends(vtkPolyData* bunny)
{
  const int seed = 8;
  VoxelTestChecks checks;
  const std::vector<std::pair<std::string, Mesh>> meshes = {
    { "soup in double precision", WithDoublePrecision(RandomTetrahedra(seed, 20, 50.0)) },
    { "slivers", RandomSlivers(seed, 100, 60.0) },
    { "with holes", WithHoles(Sphere({ 12, 12, 12 }, 11.0, 12), seed, 9) },
    { "far away", Moved(WithDoublePrecision(TorusKnot(1.0, 8, 48)), { 1e5, -2e5, 3e5 }) }
  };
  for (const auto& [name, mesh] : meshes)
  {
    CompareBackends(checks, name + ", seed 8", mesh, MakeCube(mesh, 40, 4), AllSettings().back());
  }
  for (const auto& settings : AllSettings())
  {
    CompareBackends(checks, "bunny_7k", bunny, MakeCube(bunny, 40, 4), settings);
  }
  const VoxelTetraTests::Settings none{ "as it is", [](VoxelTetraTests::Voxelizer*) {} };
  const auto grid =
    VoxelSolidTests::MakeGrid({ -40, 40, -40, 40, -40, 40 }, { 0, 0, 0 }, { 1, 1, 1 });
  CompareBackends(checks, "box on voxel centres", Box({ 4, -5, 6 }, { 20, 30, 40 }), grid, none);
  return checks.Passed();
}

/// Voxels of a seed, which must never change, on any machine and backend.
bool TestSeed(vtkPolyData* bunny)
{
  constexpr std::uint64_t sum = 17511213331594176645u;
  VoxelTestChecks checks;
  for (const int backend : VoxelTetraTests::AvailableBackends())
  {
    const auto voxelizer = MakeVoxelizer(bunny, MakeCube(bunny, 40, 0), backend);
    AllSettings().back().Apply(voxelizer);
    vtkNew<vtkUnsignedCharArray> batch;
    voxelizer->VoxelizeBatch(0, 8, batch);
    checks.Equal("checksum of seed -3, " + NameOf(voxelizer), Checksum(batch), sum);
    vtkNew<vtkUnsignedCharArray> again;
    voxelizer->VoxelizeBatch(0, 8, again);
    checks.Equal("checksum again, " + NameOf(voxelizer), Checksum(again), Checksum(batch));
    voxelizer->SetSeed(4);
    voxelizer->VoxelizeBatch(0, 8, again);
    checks.Check("another seed, other voxels", Checksum(again) != Checksum(batch));
  }
  return checks.Passed();
}
}

int TestTetraSeed(int argc, char* argv[])
{
  const Mesh bunny = ReadPLY("bunny_7k.ply", argc, argv);
  if (!bunny)
  {
    std::cerr << "bunny_7k.ply is missing\n";
    return EXIT_FAILURE;
  }
  bool good = TestSeed(bunny);
  good &= TestBackends(bunny);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
