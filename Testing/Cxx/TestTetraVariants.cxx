// Proves that the variants of vtkTetraCoveringVoxelizer are what is asked for: random numbers are
// those of the published generator, rotations and scales and displacements have their
// distributions, the voxels are those of the variant's mesh voxelized the plain way, no variant
// leaves the grid that is to hold it, and batches equal runs one by one, tell how far they are, and
// stop when they are to.

#include "VoxelComparison.h"
#include "VoxelSolidTests.h"
#include "VoxelTestObservers.h"
#include "VoxelTetraTests.h"

#include <vtkCallbackCommand.h>
#include <vtkCounterRandom.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iostream>

using namespace VoxelReference;
using namespace VoxelTestMeshes;
using VoxelSolidTests::MakeGrid;
using VoxelTetraTests::AllSettings;
using VoxelTetraTests::AllWays;
using VoxelTetraTests::MakeCube;
using VoxelTetraTests::MakeVoxelizer;
using VoxelTetraTests::NameOf;
using VoxelTetraTests::Voxelizer;

namespace
{
bool TestGenerator()
{
  using Block = vtkCounterRandom::Block;
  // Of the authors' own tests, kat_vectors of Random123.
  constexpr std::uint32_t ones = 0xffffffffu;
  VoxelTestChecks checks;
  checks.Check("Philox of zeros",
    vtkCounterRandom::Philox({ 0, 0, 0, 0 }, { 0, 0 }) ==
      Block{ 0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u });
  checks.Check("Philox of ones",
    vtkCounterRandom::Philox({ ones, ones, ones, ones }, { ones, ones }) ==
      Block{ 0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu });
  vtkCounterRandom random(1, 2, 3);
  constexpr int count = 100000;
  double sum = 0.0;
  double squares = 0.0;
  double beyondTwo = 0.0;
  for (int i = 0; i < count; ++i)
  {
    const double x = random.NextNormal();
    sum += x;
    squares += x * x;
    beyondTwo += std::abs(x) > 2.0;
  }
  checks.Check("mean of normal numbers", std::abs(sum / count) < 0.015);
  checks.Check("variance of normal numbers", std::abs(squares / count - 1.0) < 0.02);
  // 4.55 of a hundred for a normal distribution.
  checks.Check("normal numbers beyond two", std::abs(beyondTwo / count - 0.0455) < 0.004);
  return checks.Passed();
}

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix GetLinear(Voxelizer* voxelizer, int variant)
{
  vtkNew<vtkMatrix4x4> matrix;
  voxelizer->GetVariantMatrix(variant, matrix);
  Matrix linear;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      linear[i][j] = matrix->GetElement(i, j);
    }
  }
  return linear;
}

/// Scalar products of the columns.
Matrix GetProducts(const Matrix& m)
{
  Matrix products;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      products[i][j] = m[0][i] * m[0][j] + m[1][i] * m[1][j] + m[2][i] * m[2][j];
    }
  }
  return products;
}

bool TestTransforms()
{
  VoxelTestChecks checks;
  const Mesh mesh = Box({ 0, 0, 0 }, { 1, 1, 1 });
  const auto voxelizer = MakeVoxelizer(mesh, MakeCube(mesh, 8, 1), vtkVoxelizer::BACKEND_AUTO);
  voxelizer->SetRotationModeToUniform();
  voxelizer->SetScaleRange(0.5, 1.5);
  constexpr int variants = 1500;
  Matrix sums{};
  Matrix squares{};
  double trace = 0.0;
  double scales = 0.0;
  bool orthogonal = true;
  bool inRange = true;
  bool rightHanded = true;
  for (int variant = 0; variant < variants; ++variant)
  {
    Matrix m = GetLinear(voxelizer, variant);
    const Matrix products = GetProducts(m);
    for (int i = 0; i < 3; ++i)
    {
      const double scale = std::sqrt(products[i][i]);
      inRange = inRange && scale >= 0.5 && scale <= 1.5;
      orthogonal = orthogonal && std::abs(products[i][(i + 1) % 3]) < 1e-12;
      scales += scale;
      for (auto& row : m)
      {
        row[i] /= scale;
      }
    }
    rightHanded = rightHanded &&
      std::abs(vtkMath::Determinant3x3(m[0].data(), m[1].data(), m[2].data()) - 1.0) < 1e-12;
    trace += m[0][0] + m[1][1] + m[2][2];
    for (int i = 0; i < 9; ++i)
    {
      sums[i / 3][i % 3] += m[i / 3][i % 3];
      squares[i / 3][i % 3] += m[i / 3][i % 3] * m[i / 3][i % 3];
    }
  }
  checks.Check("scales are in their range", inRange);
  checks.Check("axes stay orthogonal", orthogonal);
  checks.Check("rotations don't mirror", rightHanded);
  checks.Check("mean scale", std::abs(scales / (3 * variants) - 1.0) < 0.025);
  // Of uniform rotations every entry has mean 0 and variance 1/3, and the trace mean 0, variance 1.
  checks.Check("mean trace", std::abs(trace / variants) < 0.13);
  for (int i = 0; i < 9; ++i)
  {
    checks.Check("mean of entries", std::abs(sums[i / 3][i % 3] / variants) < 0.075);
    checks.Check(
      "variance of entries", std::abs(squares[i / 3][i % 3] / variants - 1.0 / 3.0) < 0.04);
  }

  voxelizer->SetScaleRange(1.0, 1.0);
  voxelizer->SetRotationModeToAxis();
  voxelizer->SetRotationAxis(0.0, 3.0, 4.0);
  double cosines = 0.0;
  bool fixed = true;
  for (int variant = 0; variant < variants; ++variant)
  {
    const Matrix m = GetLinear(voxelizer, variant);
    fixed = fixed && std::abs(m[0][1] * 0.6 + m[0][2] * 0.8) < 1e-12 &&
      std::abs(m[1][1] * 0.6 + m[1][2] * 0.8 - 0.6) < 1e-12;
    cosines += m[0][0];
  }
  checks.Check("the axis stays", fixed);
  checks.Check("mean cosine of the angle", std::abs(cosines / variants) < 0.1);

  voxelizer->SetRotationModeToFixed();
  voxelizer->SetFixedRotation(90.0, 0.0, 0.0, 2.0);
  const Matrix quarter = GetLinear(voxelizer, 7);
  checks.Check("a quarter turn",
    std::abs(quarter[1][0] - 1.0) < 1e-12 && std::abs(quarter[0][1] + 1.0) < 1e-12 &&
      std::abs(quarter[2][2] - 1.0) < 1e-12);
  return checks.Passed();
}

bool TestDisplacements(vtkPolyData* bunny)
{
  VoxelTestChecks checks;
  const Mesh mesh = Unshared(bunny);
  const double* b = mesh->GetBounds();
  constexpr double amplitude = 0.01;
  const double unit = amplitude * std::max({ b[1] - b[0], b[3] - b[2], b[5] - b[4] });
  const auto voxelizer = MakeVoxelizer(mesh, MakeCube(mesh, 8, 1), vtkVoxelizer::BACKEND_AUTO);
  voxelizer->SetDisplacementAmplitude(amplitude);
  for (const bool normal : { false, true })
  {
    voxelizer->SetDisplacementDistribution(normal);
    vtkNew<vtkPolyData> moved;
    voxelizer->GetVariantMesh(3, moved);
    double squares = 0.0;
    double sum = 0.0;
    double largest = 0.0;
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        const double x = (moved->GetPoint(i)[axis] - mesh->GetPoint(i)[axis]) / unit;
        squares += x * x;
        sum += x;
        largest = std::max(largest, std::abs(x));
      }
    }
    const double count = 3.0 * static_cast<double>(mesh->GetNumberOfPoints());
    checks.Check("mean displacement", std::abs(sum / count) < 0.03);
    checks.Check(
      "variance of displacements", std::abs(squares / count - (normal ? 1.0 : 1.0 / 3.0)) < 0.03);
    checks.Check("largest displacement",
      normal ? largest > 3.0 && largest < 6.0 : largest > 0.99 && largest < 1.00001);
    checks.Equal("open edges of the displaced soup", CountOpenEdges(moved), 0);
    vtkNew<vtkPolyData> other;
    voxelizer->GetVariantMesh(4, other);
    checks.Check("variants are displaced in other ways",
      std::memcmp(moved->GetPoint(0), other->GetPoint(0), sizeof(double)) != 0);
  }
  // A ball stays one where all normals point away from the centre.
  const Mesh ball = Sphere({ 0, 0, 0 }, 10.0, 40);
  voxelizer->SetInputData(ball);
  voxelizer->SetDisplacementDirectionToAlongNormal();
  vtkNew<vtkPolyData> moved;
  voxelizer->GetVariantMesh(0, moved);
  double worst = 0.0;
  double longest = 0.0;
  for (vtkIdType i = 0; i < ball->GetNumberOfPoints(); ++i)
  {
    double p[3];
    double q[3];
    double cross[3];
    ball->GetPoint(i, p);
    moved->GetPoint(i, q);
    vtkMath::Cross(p, q, cross);
    worst = std::max(worst, vtkMath::Norm(cross) / (vtkMath::Norm(p) * vtkMath::Norm(q)));
    longest = std::max(longest, std::abs(vtkMath::Norm(q) - vtkMath::Norm(p)));
  }
  checks.Check("displacements follow the normals", worst < 0.01 && longest > 0.1);
  return checks.Passed();
}

bool TestVoxels(vtkPolyData* bunny)
{
  const std::vector<std::pair<std::string, Mesh>> meshes = { { "bunny_7k", bunny },
    { "holed prism", HoledPrism({ 3, 4, 5 }, 20.0, 33.0, false) },
    { "soup in double precision", WithDoublePrecision(Unshared(RandomTetrahedra(2, 20, 50.0))) } };
  bool good = true;
  for (const auto& [name, mesh] : meshes)
  {
    const auto grid = MakeCube(mesh, 40, 8);
    for (const auto& settings : AllSettings())
    {
      for (const int variant : { 0, 12 })
      {
        for (const auto& way : AllWays)
        {
          const auto voxelizer = MakeVoxelizer(mesh, grid, way);
          settings.Apply(voxelizer);
          voxelizer->SetVariant(variant);
          vtkNew<vtkPolyData> moved;
          voxelizer->GetVariantMesh(variant, moved);
          const Volume expected = CrossingParityReference(moved, Grid::FromImage(grid));
          good &= VoxelTetraTests::CheckSame(
            name + ", " + settings.Name + ", variant " + std::to_string(variant), voxelizer,
            expected, moved);
          if (voxelizer->GetNumberOfMeshUploads() != 1)
          {
            std::cerr << name << " was uploaded " << voxelizer->GetNumberOfMeshUploads()
                      << " times\n";
            good = false;
          }
        }
      }
    }
  }
  return good;
}

/// Holes are closed whatever is done to the mesh: no column leaks.
bool TestHoles(vtkPolyData* bunny)
{
  const int seed = 9;
  const Mesh holed = WithHoles(Unshared(bunny), seed, 40);
  const auto grid = MakeCube(holed, 30, 30);
  bool good = true;
  for (const auto& settings : AllSettings())
  {
    for (const auto& way : AllWays)
    {
      const auto voxelizer = MakeVoxelizer(holed, grid, way);
      settings.Apply(voxelizer);
      voxelizer->SafeScaleToFitOff();
      voxelizer->CheckWatertightOff();
      voxelizer->Update();
      const Volume found = OccupancyOf(voxelizer->GetOutput());
      std::size_t leaks = 0;
      for (const Axis axis : AllAxes)
      {
        leaks += CountColumnsOpenAtEnd(found, axis);
      }
      if (leaks != 0 || found.CountNonZero() == 0)
      {
        std::cerr << "40 holes, seed 9, " << settings.Name << ", " << NameOf(voxelizer) << ": "
                  << leaks << " columns leak, " << found.CountNonZero() << " voxels\n";
        good = false;
      }
    }
  }
  return good;
}

/// No variant leaves the grid, and one that is a ball fills it from side to side.
bool TestFit(vtkPolyData* bunny)
{
  VoxelTestChecks checks;
  const auto grid = MakeGrid({ 2, 41, 0, 39, 5, 64 }, { 3, 4, 5 }, { 1, 1, 1 });
  double inside[6];
  grid->GetBounds(inside);
  const auto reach = [&](Voxelizer* voxelizer, int variant)
  {
    vtkNew<vtkPolyData> moved;
    voxelizer->GetVariantMesh(variant, moved);
    const double* b = moved->GetBounds();
    double least = VTK_DOUBLE_MAX;
    for (int axis = 0; axis < 3; ++axis)
    {
      least = std::min({ least, b[2 * axis] - (inside[2 * axis] - 0.5),
        inside[2 * axis + 1] + 0.5 - b[2 * axis + 1] });
    }
    return least;
  };
  for (const auto& settings : AllSettings())
  {
    const auto voxelizer = MakeVoxelizer(bunny, grid, vtkVoxelizer::BACKEND_AUTO);
    settings.Apply(voxelizer);
    voxelizer->SafeScaleToFitOn();
    for (int variant = 0; variant < 40; ++variant)
    {
      checks.Check(settings.Name + ", variant " + std::to_string(variant) + " stays in the grid",
        reach(voxelizer, variant) > -1e-9);
    }
  }
  const auto ball = MakeVoxelizer(Sphere({ 7, 8, 9 }, 3.0, 40), grid, vtkVoxelizer::BACKEND_AUTO);
  ball->SafeScaleToFitOn();
  checks.Check("a ball touches the sides", std::abs(reach(ball, 0)) < 0.1);
  return checks.Passed();
}

/// Variants that are done together and in several goes, seen along all axes, with triangles of many
/// columns and of none, on grids with sides of different lengths.
bool TestLargeBatches(vtkPolyData* bunny)
{
  VoxelTestChecks checks;
  const std::vector<std::pair<std::string, Mesh>> meshes = { { "bunny_7k", bunny },
    { "a box", Box({ 1.0, 2.0, 3.0 }, { 31.0, 42.0, 33.0 }) },
    { "a holed prism in double precision",
      WithDoublePrecision(HoledPrism({ 3, 4, 5 }, 20.0, 33.0, false)) } };
  const auto flat = MakeGrid({ 3, 50, -2, 57, 1, 9 }, { 3, 4, 5 }, { 1, 1, 4 });
  const auto long1 = MakeGrid({ 0, 140, 0, 20, 0, 50 }, { 3, 4, 5 }, { 0.3, 2, 1 });
  for (const auto& [name, mesh] : meshes)
  {
    for (const auto& grid : { flat, long1 })
    {
      for (const auto& settings : AllSettings())
      {
        const auto voxelizer = MakeVoxelizer(mesh, grid, vtkVoxelizer::BACKEND_AUTO);
        settings.Apply(voxelizer);
        voxelizer->SafeScaleToFitOn();
        voxelizer->CheckWatertightOff();
        constexpr int count = 70;
        const vtkIdType voxels = grid->GetNumberOfPoints();
        vtkNew<vtkUnsignedCharArray> batch;
        checks.Check("a large batch", voxelizer->VoxelizeBatch(0, count, batch));
        for (int i = 0; i < count; i += 3)
        {
          voxelizer->SetVariant(i);
          voxelizer->Update();
          auto* single = vtkUnsignedCharArray::SafeDownCast(
            voxelizer->GetOutput()->GetPointData()->GetScalars());
          checks.Check(name + ", " + settings.Name + ": variant " + std::to_string(i) + " of many",
            single->GetRange()[1] > 0.0 &&
              std::memcmp(single->GetPointer(0), batch->GetPointer(i * voxels), voxels) == 0);
        }
      }
    }
  }
  return checks.Passed();
}

bool TestProgress(vtkPolyData* bunny)
{
  VoxelTestChecks checks;
  const auto grid = MakeCube(bunny, 20, 3);
  for (const auto& way : AllWays)
  {
    const auto voxelizer = MakeVoxelizer(bunny, grid, way);
    AllSettings().back().Apply(voxelizer);
    constexpr int count = 80;
    std::vector<double> fractions;
    std::size_t last = 0;
    vtkNew<vtkCallbackCommand> command;
    const std::function<void()> note = [&]
    {
      fractions.push_back(voxelizer->GetProgress());
      voxelizer->SetAbortExecute(last && fractions.size() >= last);
    };
    command->SetClientData(const_cast<std::function<void()>*>(&note));
    command->SetCallback([](vtkObject*, unsigned long, void* data, void*)
      { (*static_cast<const std::function<void()>*>(data))(); });
    voxelizer->AddObserver(vtkCommand::ProgressEvent, command);

    vtkNew<vtkUnsignedCharArray> batch;
    const std::string name = NameOf(voxelizer);
    checks.Check(name + ": batch with progress", voxelizer->VoxelizeBatch(0, count, batch));
    checks.Check(name + ": progress of each variant", fractions.size() >= count);
    checks.Check(name + ": progress grows", std::is_sorted(fractions.begin(), fractions.end()));

    for (const std::size_t events : { std::size_t(1), std::size_t(10), fractions.size() - 10 })
    {
      fractions.clear();
      last = events;
      checks.Check(name + ": a batch that is stopped", !voxelizer->VoxelizeBatch(0, count, batch));
      checks.Equal(name + ": values of a batch that is stopped", batch->GetNumberOfValues(), 0);
      checks.Equal(name + ": progress after the stop", fractions.size(), events);
    }
    voxelizer->SetAbortExecute(false);
  }
  return checks.Passed();
}

bool TestBatches(vtkPolyData* bunny)
{
  VoxelTestChecks checks;
  const auto grid = MakeCube(bunny, 30, 3);
  for (const auto& way : AllWays)
  {
    for (const int shell : { 0, 26 })
    {
      for (const bool labels : { false, true })
      {
        const auto voxelizer = MakeVoxelizer(bunny, grid, way);
        AllSettings().back().Apply(voxelizer);
        voxelizer->SetShell(shell);
        voxelizer->SetKeepInterior(labels);
        constexpr int first = 5;
        constexpr int count = 4;
        vtkNew<vtkUnsignedCharArray> batch;
        const std::string name =
          NameOf(voxelizer) + ", shell " + std::to_string(shell) + (labels ? " in the solid" : "");
        checks.Check(name + ": batch", voxelizer->VoxelizeBatch(first, count, batch));
        const vtkIdType voxels = grid->GetNumberOfPoints();
        checks.Equal(name + ": values", batch->GetNumberOfValues(), count * voxels);
        for (int i = 0; i < count; ++i)
        {
          voxelizer->SetVariant(first + i);
          voxelizer->Update();
          auto* single = vtkUnsignedCharArray::SafeDownCast(
            voxelizer->GetOutput()->GetPointData()->GetScalars());
          checks.Check(name + ": variant " + std::to_string(first + i) + " of the batch",
            std::memcmp(single->GetPointer(0), batch->GetPointer(i * voxels), voxels) == 0);
        }
        checks.Equal(name + ": uploads", voxelizer->GetNumberOfMeshUploads(), 1);
      }
    }
  }
  vtkNew<Voxelizer> voxelizer;
  VoxelTestObserver observer(voxelizer);
  vtkNew<vtkUnsignedCharArray> batch;
  checks.Check("no batch without an input", !voxelizer->VoxelizeBatch(0, 1, batch));
  voxelizer->SetInputData(bunny);
  checks.Check("no batch of nothing", !voxelizer->VoxelizeBatch(0, 0, batch));
  checks.Check("no batch from a negative variant", !voxelizer->VoxelizeBatch(-1, 1, batch));
  checks.Check("no batch without an array", !voxelizer->VoxelizeBatch(0, 1, nullptr));
  voxelizer->SetMemoryLimit(1000000);
  checks.Check("no batch beyond memory", !voxelizer->VoxelizeBatch(0, 4, batch));
  checks.Equal("errors", observer.Errors.size(), std::size_t(5));
  checks.Check("the last batch of all fits", voxelizer->VoxelizeBatch(0, 3, batch));
  return checks.Passed();
}
}

int TestTetraVariants(int argc, char* argv[])
{
  const Mesh bunny = ReadPLY("bunny_7k.ply", argc, argv);
  if (!bunny)
  {
    std::cerr << "bunny_7k.ply is missing\n";
    return EXIT_FAILURE;
  }
  bool good = TestGenerator();
  good &= TestTransforms();
  good &= TestDisplacements(bunny);
  good &= TestVoxels(bunny);
  good &= TestHoles(bunny);
  good &= TestFit(bunny);
  good &= TestBatches(bunny);
  good &= TestLargeBatches(bunny);
  good &= TestProgress(bunny);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
