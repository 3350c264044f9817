// Proves vtkVoxelBoolean bit for bit against plain loops: every operation over one to twenty inputs
// on awkward grids, random expressions against their evaluation voxel by voxel, precedence;
// volumes; chains without a transfer; and one error for each bad use, which points at the column.

#include "VoxelComparison.h"
#include "VoxelFilterTests.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSlicemap.h>
#include <vtkSlicemapSolidVoxelizer.h>
#include <vtkVoxelBoolean.h>
#include <vtkVoxelContext.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <random>

using namespace VoxelFilterTests;
using VoxelReference::Compare;
using VoxelReference::Volume;

namespace
{
std::vector<Volume> RandomInputs(vtkImageData* grid, int count, unsigned int seed)
{
  std::vector<Volume> inputs;
  for (int i = 0; i < count; ++i)
  {
    inputs.push_back(RandomVoxels(grid, seed + static_cast<unsigned int>(i), 0.5));
  }
  return inputs;
}

vtkSmartPointer<vtkVoxelBoolean> MakeFilter(vtkImageData* grid, const std::vector<Volume>& inputs)
{
  auto filter = vtkSmartPointer<vtkVoxelBoolean>::New();
  for (const Volume& input : inputs)
  {
    filter->AddInputDataObject(MakeMask(grid, input));
  }
  return filter;
}

void TestOperations(VoxelTestChecks& checks)
{
  using Combine = std::function<bool(bool, bool)>;
  const Combine combine[] = { [](bool a, bool b) { return a || b; },
    [](bool a, bool b) { return a && b; }, [](bool a, bool b) { return a && !b; },
    [](bool a, bool b) { return a != b; } };
  unsigned int seed = 100;
  for (const auto& [name, grid] : AwkwardGrids())
  {
    for (const int count : { 1, 2, 3, 8, 9, 20 })
    {
      seed += 20;
      const auto inputs = RandomInputs(grid, count, seed);
      const auto filter = MakeFilter(grid, inputs);
      for (int operation = 0; operation < 4; ++operation)
      {
        filter->SetOperation(operation);
        filter->Update();
        const Volume expected = MakeVoxels(grid,
          [&, &grid = grid](std::size_t offset)
          {
            bool value = inputs[0].Voxels[offset] != 0;
            for (int i = 1; i < count; ++i)
            {
              value = combine[operation](value, inputs[i].Voxels[offset] != 0);
            }
            return value;
          });
        const std::string what = name + ", operation " + std::to_string(operation) + " of " +
          std::to_string(count) + ", seed " + std::to_string(seed);
        checks.Check(what, VoxelReference::Report(what, Compare(filter->GetOutput(), expected)));
      }
    }
    const auto input = RandomInputs(grid, 1, ++seed);
    const auto filter = MakeFilter(grid, input);
    filter->SetOperationToComplement();
    filter->Update();
    const Volume expected =
      MakeVoxels(grid, [&](std::size_t offset) { return !input[0].Voxels[offset]; });
    const std::string what = name + ", complement, seed " + std::to_string(seed);
    checks.Check(what, VoxelReference::Report(what, Compare(filter->GetOutput(), expected)));
    checks.Equal(what + ": count", filter->GetNumberOfFilledVoxels(),
      static_cast<vtkIdType>(expected.CountNonZero()));
  }
}

/// A random expression, and what it says of a voxel whose inputs are the bits of a number.
struct RandomExpression
{
  std::string Text;
  std::function<bool(unsigned int bits)> Evaluate;
};

RandomExpression MakeExpression(std::mt19937& random, int depth, int inputs)
{
  const unsigned int kind = depth == 0 ? 0 : random() % 6;
  if (kind == 0)
  {
    const int i = static_cast<int>(random() % static_cast<unsigned int>(inputs));
    return { std::string(1, static_cast<char>('A' + i)),
      [i](unsigned int bits) { return (bits >> i & 1) != 0; } };
  }
  const auto left = MakeExpression(random, depth - 1, inputs);
  if (kind == 1)
  {
    return { "~ (" + left.Text + ")", [left](unsigned int bits) { return !left.Evaluate(bits); } };
  }
  const auto right = MakeExpression(random, depth - 1, inputs);
  const char operation = "|&-^"[kind - 2];
  return { "(" + left.Text + ") " + operation + "( " + right.Text + ")",
    [left, right, operation](unsigned int bits)
    {
      const bool a = left.Evaluate(bits);
      const bool b = right.Evaluate(bits);
      return operation == '|' ? a || b
        : operation == '&'    ? a && b
        : operation == '-'    ? a && !b
                              : a != b;
    } };
}

void TestExpressions(VoxelTestChecks& checks)
{
  for (unsigned int seed = 1; seed <= 40; ++seed)
  {
    std::mt19937 random(seed);
    const auto grids = AwkwardGrids();
    const Image grid = grids[seed % grids.size()].Grid;
    const int count = seed % 2 ? 4 : 14;
    const auto inputs = RandomInputs(grid, count, 1000 * seed);
    const auto expression = MakeExpression(random, 6, count);
    const auto filter = MakeFilter(grid, inputs);
    filter->SetExpression(expression.Text.c_str());
    filter->Update();
    const Volume expected = MakeVoxels(grid,
      [&](std::size_t offset)
      {
        unsigned int bits = 0;
        for (int i = 0; i < count; ++i)
        {
          bits |= static_cast<unsigned int>(inputs[i].Voxels[offset] != 0) << i;
        }
        return expression.Evaluate(bits);
      });
    const std::string what = expression.Text + ", seed " + std::to_string(seed);
    checks.Check(what, VoxelReference::Report(what, Compare(filter->GetOutput(), expected)));
  }
}

void TestPrecedence(VoxelTestChecks& checks)
{
  const Image grid = AwkwardGrids()[1].Grid;
  const auto filter = MakeFilter(grid, RandomInputs(grid, 4, 3));
  const auto count = [&](const char* expression)
  {
    filter->SetExpression(expression);
    filter->Update();
    return filter->GetNumberOfFilledVoxels();
  };
  for (const auto& [loose, explicitly] : std::vector<std::pair<const char*, const char*>>{
         { "A | B ^ C", "A | (B ^ C)" }, { "A ^ B | C", "(A ^ B) | C" },
         { "A ^ B & C", "A ^ (B & C)" }, { "A & B ^ C", "(A & B) ^ C" },
         { "A & B - C", "A & (B - C)" }, { "A - B & C", "(A - B) & C" },
         { "A - B - C", "(A - B) - C" }, { "~A - B", "(~A) - B" }, { "~A & B", "(~A) & B" },
         { "A | B - C & D", "A | ((B - C) & D)" }, { "~~A", "A" }, { "A-B", " A  -\tB " } })
  {
    checks.Equal(loose, count(loose), count(explicitly));
  }
  checks.Check("parentheses matter", count("(A | B) - C") != count("A | B - C"));
  checks.Check("the order of a difference matters", count("A - (B - C)") != count("A - B - C"));
  filter->SetInputName(1, "liver");
  filter->SetInputName(3, "_tumour2");
  const vtkIdType named = count("(A | liver) - _tumour2");
  filter->SetInputName(1, nullptr);
  checks.Equal("names", named, count("(A | B) - _tumour2"));
  checks.Equal("name", std::string(filter->GetInputName(3)), std::string("_tumour2"));
  checks.Equal("name of input 25", std::string(filter->GetInputName(25)), std::string("Z"));
  checks.Equal("name of input 26", std::string(filter->GetInputName(26)), std::string("AA"));
  checks.Equal("name of input 702", std::string(filter->GetInputName(702)), std::string("AAA"));
}

void TestVolumes(VoxelTestChecks& checks)
{
  const Image grid = AwkwardGrids()[8].Grid; // voxels of 1 x 2 x 0.5, turned
  const auto inputs = RandomInputs(grid, 3, 9);
  const auto filter = MakeFilter(grid, inputs);
  checks.Equal("volume before a run", filter->GetVolume(), -1.0);
  checks.Equal("intersection before a run", filter->GetIntersectionVolume(), -1.0);
  filter->Update();
  std::size_t united = 0;
  std::size_t common = 0;
  for (std::size_t offset = 0; offset < inputs[0].Grid.NumberOfVoxels(); ++offset)
  {
    const int sum = inputs[0].Voxels[offset] + inputs[1].Voxels[offset] + inputs[2].Voxels[offset];
    united += sum > 0;
    common += sum == 3;
  }
  const auto near = [](double a, double b) { return std::abs(a - b) < 1e-9 * b; };
  checks.Check("volume", near(filter->GetVolume(), static_cast<double>(united)));
  checks.Check("volume of the intersection",
    near(filter->GetIntersectionVolume(), static_cast<double>(common)));
  checks.Check("not empty", !filter->IsEmpty());
  filter->SetExpression("A - A");
  filter->Update();
  checks.Check("empty", filter->IsEmpty());
  checks.Equal("volume of nothing", filter->GetVolume(), 0.0);
}

void TestChain(VoxelTestChecks& checks)
{
  const Image grid = AwkwardGrids()[1].Grid;
  vtkNew<vtkSlicemapSolidVoxelizer> boxes[2];
  for (int i = 0; i < 2; ++i)
  {
    boxes[i]->SetInputData(
      VoxelTestMeshes::Box({ 2.0 + 3 * i, 1, 12 }, { 9.0 + 3 * i, 5.0 + i, 20 }));
    boxes[i]->SetReferenceImage(grid);
    boxes[i]->HostOutputOff();
    boxes[i]->CheckWatertightOff();
  }
  vtkNew<vtkVoxelBoolean> both;
  both->AddInputConnection(boxes[0]->GetOutputPort());
  both->AddInputConnection(boxes[1]->GetOutputPort());
  both->HostOutputOff();
  vtkNew<vtkVoxelBoolean> all;
  all->AddInputConnection(both->GetOutputPort());
  all->AddInputConnection(boxes[0]->GetOutputPort());
  all->AddInputConnection(boxes[0]->GetOutputPort());
  all->HostOutputOff();
  all->SetExpression("A - B ^ C");
  const vtkIdType readBacks = vtkSlicemap::GetNumberOfReadBacks();
  const vtkIdType uploads = vtkSlicemap::GetNumberOfUploads();
  all->Update();
  checks.Equal("read-backs of a chain", vtkSlicemap::GetNumberOfReadBacks(), readBacks);
  checks.Equal("uploads of a chain", vtkSlicemap::GetNumberOfUploads(), uploads);
  const vtkIdType a = boxes[0]->GetNumberOfFilledVoxels();
  const vtkIdType b = boxes[1]->GetNumberOfFilledVoxels();
  checks.Check("boxes", a > 0 && b > 0 && a != b);
  const double voxel = 0.5 * 1.25 * 2.0;
  const auto common = static_cast<vtkIdType>(std::lround(both->GetIntersectionVolume() / voxel));
  checks.Check("the boxes meet", common > 0);
  checks.Equal("union of two boxes", both->GetNumberOfFilledVoxels(), a + b - common);
  checks.Equal("a chain", all->GetNumberOfFilledVoxels(), b - common + a);
  checks.Equal("inputs are left alone", boxes[0]->GetNumberOfFilledVoxels(), a);
}

void TestError(VoxelTestChecks& checks, const std::string& name,
  const std::function<void(vtkVoxelBoolean*)>& spoil, const std::string& says)
{
  const Image grid = AwkwardGrids()[1].Grid;
  const auto filter = MakeFilter(grid, RandomInputs(grid, 3, 4));
  filter->Update();
  VoxelTestObserver observer(filter);
  spoil(filter);
  filter->Update();
  observer.ExpectOneError(checks, name, says);
  checks.Equal(
    name + ": arrays of the output", filter->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
  checks.Equal(name + ": volume", filter->GetVolume(), -1.0);
  checks.Equal(name + ": volume of the intersection", filter->GetIntersectionVolume(), -1.0);
  checks.Check(name + ": empty", filter->IsEmpty());
}

void TestErrors(VoxelTestChecks& checks)
{
  const auto wrong = [&](const std::string& expression, const std::string& says)
  {
    TestError(
      checks, "expression '" + expression.substr(0, 20) + "'",
      [&](vtkVoxelBoolean* f) { f->SetExpression(expression.c_str()); }, says);
  };
  wrong("A | ", "column 5: the name of an input is missing");
  wrong(" ", "column 2: the name of an input is missing");
  wrong("| A", "column 1: the name of an input is missing");
  wrong("A + B", "column 3: an operator is missing");
  wrong("A B", "column 3: an operator is missing");
  wrong("A | (B - C", "column 5: this \"(\" is never closed");
  wrong("(A | B C)", "column 8: an operator or \")\" is missing");
  wrong("(A | B)) - C", "column 8: \")\" has no \"(\"");
  wrong("A & D", "column 5: there is no input \"D\", only A, B, C");
  wrong("a", "column 1: there is no input \"a\"");
  wrong("()", "column 2: the name of an input is missing");
  wrong("A ~ B", "column 3: an operator is missing");
  wrong("A & 2", "column 5: the name of an input is missing");
  wrong(std::string(100000, '(') + "A", "nested too deep");
  wrong(std::string(100000, '~') + "A", "nested too deep");
  std::string endless = "A";
  for (int i = 0; i < 50000; ++i)
  {
    endless += "|A";
  }
  wrong(endless, "more than 2000 operators");
  wrong("A\t| !", "\n  A | !\n      ^");

  TestError(
    checks, "complement of three", [](vtkVoxelBoolean* f) { f->SetOperationToComplement(); },
    "Complement takes one input, but there are 3");
  TestError(
    checks, "two of one name",
    [](vtkVoxelBoolean* f)
    {
      f->SetInputName(0, "C");
      f->SetExpression("A");
    },
    "Two inputs are named \"C\"");
  const auto onGrid = [](const Image& grid)
  {
    return [grid](vtkVoxelBoolean* f)
    { f->AddInputDataObject(MakeMask(grid, RandomVoxels(grid, 1))); };
  };
  const Image wider = AwkwardGrids()[1].Grid;
  wider->SetExtent(0, 37, 0, 10, 0, 6);
  TestError(checks, "another extent", onGrid(wider), "(0, 37, 0, 10, 0, 6)");
  const Image moved = AwkwardGrids()[1].Grid;
  moved->SetOrigin(0.3, -3, 10);
  TestError(checks, "another origin", onGrid(moved), "origin (0.25, -3, 10) here");
  const Image turned = AwkwardGrids()[1].Grid;
  turned->SetDirectionMatrix(0, 1, 0, -1, 0, 0, 0, 0, 1);
  TestError(checks, "another direction", onGrid(turned), "direction (0, 1, 0");

  vtkNew<vtkVoxelBoolean> filter;
  VoxelTestObserver observer(filter);
  filter->SetInputName(0, "2b");
  filter->SetInputName(-1, "b");
  filter->SetInputName(0, "a b");
  checks.Equal("errors of wrong names", observer.Errors.size(), std::size_t(3));
  filter->Update();
  checks.Check("an unconnected filter gives nothing",
    filter->GetOutput()->GetPointData()->GetNumberOfArrays() == 0);
}
}

int TestVoxelBoolean(int, char*[])
{
  VoxelTestChecks checks;
  vtkNew<vtkVoxelContext> context;
  std::cout << "kernels are " << (context->SupportsCompute() ? "compute" : "fragment")
            << " shaders\n";
  TestOperations(checks);
  TestExpressions(checks);
  TestPrecedence(checks);
  TestVolumes(checks);
  TestChain(checks);
  TestErrors(checks);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
