// Proves that shells of vtkTetraCoveringVoxelizer are, by definition, the voxels of the solid with
// a neighbour that is not in it, for 6, 18 and 26 neighbours, voxels beyond the grid being outside;
// alone and as labels along with the rest of the solid; and that wrong properties give one error.

#include "VoxelComparison.h"
#include "VoxelSolidTests.h"
#include "VoxelTestObservers.h"
#include "VoxelTetraTests.h"

#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSlicemap.h>
#include <vtkUnsignedCharArray.h>

#include <cstdlib>
#include <functional>
#include <iostream>

using namespace VoxelReference;
using namespace VoxelTestMeshes;
using VoxelTetraTests::MakeVoxelizer;
using VoxelTetraTests::Voxelizer;

namespace
{
constexpr int InteriorValue = 7;
constexpr int ShellValue = 9;

bool IsOnShell(const Volume& solid, const Voxel& v, int neighbours)
{
  const int axes = neighbours == 6 ? 1 : neighbours == 18 ? 2 : 3;
  for (int z = -1; z <= 1; ++z)
  {
    for (int y = -1; y <= 1; ++y)
    {
      for (int x = -1; x <= 1; ++x)
      {
        const Voxel other{ v[0] + x, v[1] + y, v[2] + z };
        const bool isNeighbour = std::abs(x) + std::abs(y) + std::abs(z) <= axes;
        if (isNeighbour && (!solid.Grid.Contains(other) || solid.At(other) == 0))
        {
          return solid.At(v) != 0;
        }
      }
    }
  }
  return false;
}

/// Whether all voxels of the output have the value that `expected` says.
bool CheckValues(const std::string& name, vtkImageData* output, const Volume& solid,
  const std::function<int(const Voxel&)>& expected)
{
  auto* values = vtkUnsignedCharArray::SafeDownCast(output->GetPointData()->GetScalars());
  for (std::size_t i = 0; values && i < solid.Grid.NumberOfVoxels(); ++i)
  {
    const Voxel v = solid.Grid.VoxelAt(i);
    const int found = values->GetValue(static_cast<vtkIdType>(i));
    if (found != expected(v))
    {
      std::cerr << name << ": voxel " << v[0] << ", " << v[1] << ", " << v[2] << " is " << found
                << ", not " << expected(v) << "\n";
      return false;
    }
  }
  return values != nullptr;
}

bool CheckShells(const std::string& mesh, vtkPolyData* input, vtkImageData* grid, int backend)
{
  const auto voxelizer = MakeVoxelizer(input, grid, backend);
  voxelizer->Update();
  const Volume solid = OccupancyOf(voxelizer->GetOutput());
  bool good = VoxelTetraTests::CheckSame(
    mesh, voxelizer, CrossingParityReference(input, Grid::FromImage(grid)), input);
  voxelizer->SetForegroundValue(InteriorValue);
  voxelizer->SetShellValue(ShellValue);
  for (const int neighbours : { 6, 18, 26 })
  {
    const std::string name =
      mesh + ", " + std::to_string(neighbours) + " neighbours, " + VoxelSolidTests::NameOf(backend);
    voxelizer->SetShell(neighbours);
    voxelizer->KeepInteriorOff();
    voxelizer->Update();
    good &= CheckValues(name, voxelizer->GetOutput(), solid,
      [&](const Voxel& v) { return IsOnShell(solid, v, neighbours) ? InteriorValue : 0; });

    voxelizer->KeepInteriorOn();
    voxelizer->Update();
    good &= CheckValues(name + ", labels", voxelizer->GetOutput(), solid,
      [&](const Voxel& v) {
        return IsOnShell(solid, v, neighbours) ? ShellValue : solid.At(v) ? InteriorValue : 0;
      });
    vtkSlicemap* slicemap = vtkSlicemap::GetFromImage(voxelizer->GetOutput());
    if (!slicemap ||
      slicemap->GetNumberOfFilledVoxels() != static_cast<vtkIdType>(solid.CountNonZero()))
    {
      std::cerr << name << ": the slicemap is not the solid\n";
      good = false;
    }
  }
  return good;
}

bool TestErrors()
{
  const std::vector<std::pair<std::string, std::function<void(Voxelizer*)>>> wrong = {
    { "Shell is 7", [](Voxelizer* v) { v->SetShell(7); } },
    { "KeepInterior",
      [](Voxelizer* v)
      {
        v->SetShell(6);
        v->KeepInteriorOn();
        v->SetOutputScalarTypeToBit();
      } },
    { "ScaleRange", [](Voxelizer* v) { v->SetScaleRange(0.0, 1.0); } },
    { "ScaleRange", [](Voxelizer* v) { v->SetScaleRange(2.0, 1.0); } },
    { "FixedRotation", [](Voxelizer* v) { v->SetFixedRotation(10, 0, 0, 0); } },
    { "RotationAxis", [](Voxelizer* v) { v->SetRotationAxis(0, 0, 0); } },
    { "DisplacementAmplitude", [](Voxelizer* v) { v->SetDisplacementAmplitude(-0.1); } },
  };
  VoxelTestChecks checks;
  for (const auto& [says, spoil] : wrong)
  {
    vtkNew<Voxelizer> voxelizer;
    VoxelTestObserver observer(voxelizer);
    voxelizer->SetInputData(Box({ 0, 0, 0 }, { 1, 1, 1 }));
    voxelizer->SetResolution(8);
    spoil(voxelizer);
    voxelizer->Update();
    checks.Equal(says + ": errors", observer.Errors.size(), std::size_t(1));
    checks.Check(says + " in the error",
      !observer.Errors.empty() && observer.Errors[0].find(says) != std::string::npos);
    checks.Equal(says + ": arrays", voxelizer->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
    vtkNew<vtkUnsignedCharArray> array;
    checks.Check(says + ": no batch", !voxelizer->VoxelizeBatch(0, 2, array));
    checks.Equal(says + ": errors of a batch", observer.Errors.size(), std::size_t(2));
    checks.Equal(says + ": values of a batch", array->GetNumberOfValues(), vtkIdType(0));
  }
  return checks.Passed();
}
}

int TestTetraShell(int argc, char* argv[])
{
  const Mesh bunny = ReadPLY("bunny_7k.ply", argc, argv);
  if (!bunny)
  {
    std::cerr << "bunny_7k.ply is missing\n";
    return EXIT_FAILURE;
  }
  const int seed = 6;
  bool good = true;
  for (const int backend : VoxelTetraTests::AvailableBackends())
  {
    good &= CheckShells("bunny_7k", bunny, VoxelSolidTests::MakeGridAround(bunny, 50), backend);
    good &= CheckShells("sphere beyond the grid", Sphere({ 20, 20, 20 }, 22.0),
      VoxelSolidTests::MakeGrid({ 3, 39, -2, 40, 0, 37 }, { 0.2, 0.3, 0.4 }, { 1, 1, 1 }), backend);
    good &= CheckShells("tetrahedra seed 6", RandomTetrahedra(seed, 40, 40.0),
      VoxelSolidTests::MakeGrid({ 0, 69, 0, 33, 0, 40 }, { 0.2, 0.3, 0.4 }, { 0.6, 1, 1 }),
      backend);
  }
  good &= TestErrors();
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
