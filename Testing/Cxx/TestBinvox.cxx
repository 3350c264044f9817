// Proves that .binvox files hold what the format says, byte for byte, and that voxels come back
// from them as they were, with their geometry; and that bad files, and images that the format can't
// hold, end in one error and leave no file, or the former one.

#include "VoxelSolidTests.h"
#include "VoxelTestFiles.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"
#include "VoxelTestReaders.h"

#include <vtkBinvoxReader.h>
#include <vtkBinvoxWriter.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSlicemap.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>

using namespace VoxelSolidTests;
using namespace VoxelTestFiles;

namespace
{
/// Runs of random length, so that some are longer than a byte can tell.
vtkSmartPointer<vtkImageData> RandomImage(int seed, const std::array<int, 6>& extent)
{
  auto image = MakeGrid(extent, { 0.5, -2.0, 3.25 }, { 0.25, 0.25, 0.25 });
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  std::mt19937 random(seed);
  std::geometric_distribution<int> length(0.01);
  auto* values = static_cast<unsigned char*>(image->GetScalarPointer());
  const vtkIdType count = image->GetNumberOfPoints();
  for (vtkIdType i = 0, left = 0; i < count; ++i, --left)
  {
    if (left == 0)
    {
      left = 1 + length(random);
    }
    values[i] = left % 2;
  }
  return image;
}

int WriteImage(vtkImageData* image, const std::string& name)
{
  vtkNew<vtkBinvoxWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(name.c_str());
  return writer->Write();
}

/// Compares voxels by their places in the world; the file's extent begins at 0.
bool IsSame(vtkImageData* found, vtkImageData* expected)
{
  int n[3];
  expected->GetDimensions(n);
  bool same = std::equal(n, n + 3, found->GetDimensions());
  for (int axis = 0; same && axis < 3; ++axis)
  {
    const double first =
      expected->GetOrigin()[axis] + expected->GetExtent()[2 * axis] * expected->GetSpacing()[axis];
    same = std::abs(found->GetOrigin()[axis] - first) < 1e-12 &&
      std::abs(found->GetSpacing()[axis] - expected->GetSpacing()[axis]) < 1e-12;
  }
  vtkDataArray* a = found->GetPointData()->GetScalars();
  vtkDataArray* b = expected->GetPointData()->GetScalars();
  same = same && a && a->GetNumberOfTuples() == b->GetNumberOfTuples();
  for (vtkIdType i = 0; same && i < a->GetNumberOfTuples(); ++i)
  {
    same = (a->GetComponent(i, 0) != 0.0) == (b->GetComponent(i, 0) != 0.0);
  }
  return same;
}

void TestBytes(VoxelTestChecks& checks)
{
  // 2 x 3 x 2 voxels, one set: (1, 2, 0). The order is x, then z, then y.
  const auto image = MakeGrid({ 4, 5, 0, 2, -1, 0 }, { 0, 0, 0 }, { 2, 2, 2 });
  image->AllocateScalars(VTK_FLOAT, 1);
  image->GetPointData()->GetScalars()->Fill(0.0);
  image->SetScalarComponentFromDouble(5, 2, -1, 0, -0.5);
  const std::string name = PathOf("bytes.binvox");
  checks.Equal("written", WriteImage(image, name), 1);
  checks.Equal("bytes", ReadBytes(name),
    std::string("#binvox 1\ndim 2 2 3\ntranslate 7 -1 -3\nscale 6\ndata\n") +
      std::string({ 0, 8, 1, 1, 0, 3 }));
}

void TestRoundTrips(VoxelTestChecks& checks)
{
  const std::array<int, 6> extents[] = { { 0, 63, 0, 63, 0, 63 }, { -3, 127, 5, 40, 2, 2 },
    { 7, 7, 0, 99, -1, 8 }, { 0, 130, 0, 0, 0, 0 }, { 1, 1, 1, 1, 1, 1 } };
  int seed = 1;
  for (const auto& extent : extents)
  {
    const std::string title = "random grid of seed " + std::to_string(seed);
    const auto image = RandomImage(seed++, extent);
    const std::string name = PathOf("random.binvox");
    checks.Equal(title + ": written", WriteImage(image, name), 1);
    vtkNew<vtkBinvoxReader> reader;
    reader->SetFileName(name.c_str());
    reader->Update();
    checks.Check(title + ": comes back", IsSame(reader->GetOutput(), image));

    vtkNew<vtkBinvoxWriter> again;
    again->SetInputConnection(reader->GetOutputPort());
    again->SetFileName(PathOf("again.binvox").c_str());
    again->Write();
    checks.Check(title + ": same file", ReadBytes(PathOf("again.binvox")) == ReadBytes(name));
  }
}

void TestSlicemaps(VoxelTestChecks& checks)
{
  vtkNew<vtkSlicemapSolidVoxelizer> voxelizer;
  voxelizer->SetInputData(VoxelTestMeshes::TorusKnot(50.0, 24, 200));
  voxelizer->SetResolution(70);
  voxelizer->HostOutputOff();
  vtkNew<vtkBinvoxWriter> writer;
  writer->SetInputConnection(voxelizer->GetOutputPort());
  writer->SetFileName(PathOf("knot.binvox").c_str());
  checks.Equal("bits on the GPU: written", writer->Write(), 1);
  voxelizer->HostOutputOn();
  voxelizer->Update();
  vtkNew<vtkBinvoxReader> reader;
  reader->SetFileName(PathOf("knot.binvox").c_str());
  reader->Update();
  checks.Check("bits on the GPU come back", IsSame(reader->GetOutput(), voxelizer->GetOutput()));

  const std::string points = ReadBytes(PathOf("knot.binvox"));
  voxelizer->SetOutputAttributeTypeToCell();
  voxelizer->Update();
  vtkNew<vtkImageData> cells;
  cells->DeepCopy(voxelizer->GetOutput());
  cells->GetInformation()->Clear();
  WriteImage(cells, PathOf("cells.binvox"));
  checks.Check("cells are voxels as well", ReadBytes(PathOf("cells.binvox")) == points);
}

void ExpectRefusal(VoxelTestChecks& checks, const std::string& title, vtkImageData* image,
  const char* name, unsigned long code)
{
  vtkNew<vtkBinvoxWriter> writer;
  VoxelTestObserver observer(writer);
  writer->SetInputData(image);
  writer->SetFileName(name);
  writer->Write();
  checks.Equal(title + ": errors", observer.Errors.size(), std::size_t(1));
  checks.Equal(title + ": code", writer->GetErrorCode(), code);
}

void TestRefusals(VoxelTestChecks& checks)
{
  const std::string name = PathOf("refused.binvox");
  WriteBytes(name, "as it was");
  const auto image = RandomImage(9, { 0, 4, 0, 4, 0, 4 });
  ExpectRefusal(checks, "no name", image, nullptr, vtkErrorCode::NoFileNameError);
  ExpectRefusal(checks, "a folder", image, PathOf().c_str(), vtkErrorCode::CannotOpenFileError);
  ExpectRefusal(checks, "no such folder", image, PathOf("none/a.binvox").c_str(),
    vtkErrorCode::CannotOpenFileError);
  const auto flat = RandomImage(9, { 0, 4, 0, 4, 0, 4 });
  flat->SetSpacing(1, 1, 2);
  ExpectRefusal(checks, "no cubes", flat, name.c_str(), vtkErrorCode::UserError);
  const auto turned = RandomImage(9, { 0, 4, 0, 4, 0, 4 });
  turned->SetDirectionMatrix(0, 1, 0, 1, 0, 0, 0, 0, 1);
  ExpectRefusal(checks, "rotated", turned, name.c_str(), vtkErrorCode::UserError);
  vtkNew<vtkImageData> empty;
  ExpectRefusal(checks, "empty", empty, name.c_str(), vtkErrorCode::UserError);
  const auto bare = MakeGrid({ 0, 4, 0, 4, 0, 4 }, { 0, 0, 0 }, { 1, 1, 1 });
  ExpectRefusal(checks, "no scalars", bare, name.c_str(), vtkErrorCode::UserError);
  checks.Equal("the former file", ReadBytes(name), std::string("as it was"));
  checks.Check("no other file", !std::filesystem::exists(name + ".part"));
}

/// How many errors there were.
std::size_t ReadBadFile(VoxelTestChecks& checks, const std::string& title, const std::string& bytes)
{
  const std::string name = PathOf("bad.binvox");
  WriteBytes(name, bytes);
  vtkNew<vtkBinvoxReader> reader;
  return VoxelTestRead(checks, title, reader.Get(), name);
}

void TestBadFiles(VoxelTestChecks& checks)
{
  WriteImage(RandomImage(3, { 0, 20, 0, 11, 0, 15 }), PathOf("good.binvox"));
  const std::string good = ReadBytes(PathOf("good.binvox"));
  checks.Equal("good file", ReadBadFile(checks, "good file", good), std::size_t(0));
  checks.Equal("more at the end", ReadBadFile(checks, "more", good + "\n"), std::size_t(0));
  const std::string data = std::string("data\n") + std::string({ 1, 8 });
  const std::pair<const char*, std::string> bad[] = { { "empty", "" }, { "text", "solid a\n" },
    { "no data", "#binvox 1\ndim 2 2 2\n" }, { "no dimensions", "#binvox 1\n" + data },
    { "zero", "#binvox 1\ndim 2 0 2\n" + data }, { "negative", "#binvox 1\ndim -2 2 -2\n" + data },
    { "two numbers", "#binvox 1\ndim 2 2\n" + data },
    { "huge", "#binvox 1\ndim 1000000 1000000 1000000\n" + data },
    { "overflow", "#binvox 1\ndim 99999999999999999999 1 1\n" + data },
    { "NaN", "#binvox 1\ndim 2 2 2\ntranslate nan 0 0\n" + data },
    { "scale", "#binvox 1\ndim 2 2 2\nscale 0\n" + data },
    { "spacing of zero", "#binvox 1\ndim 2 2 2\nscale 5e-324\n" + data },
    { "end beyond all numbers",
      "#binvox 1\ndim 2 2 2\ntranslate 1.5e308 0 0\nscale 1.5e308\n" + data },
    { "run too long", "#binvox 1\ndim 2 2 1\n" + data },
    { "endless header", "#binvox 1\n" + std::string(1 << 20, 'x') },
    { "no voxels in runs", "#binvox 1\ndim 2 2 2\ndata\n" + std::string(16, '\0') } };
  for (const auto& [title, bytes] : bad)
  {
    checks.Equal(title, ReadBadFile(checks, title, bytes), std::size_t(1));
  }
  constexpr std::size_t header = 64;
  VoxelTestDamage(checks, good, header,
    [&](const std::string& title, const std::string& bytes)
    { return ReadBadFile(checks, title, bytes); });

  vtkNew<vtkBinvoxReader> missing;
  VoxelTestObserver observer(missing);
  missing->Update();
  missing->SetFileName(PathOf("missing.binvox").c_str());
  missing->Update();
  checks.Equal("no name, no file: errors", observer.Errors.size(), std::size_t(2));
  checks.Check("a binvox file", vtkBinvoxReader::CanReadFile(PathOf("good.binvox").c_str()));
  checks.Check("no binvox file", !vtkBinvoxReader::CanReadFile(PathOf("missing.binvox").c_str()));
}
}

int TestBinvox(int argc, char* argv[])
{
  UseFolder("TestBinvox", argc, argv);
  VoxelTestChecks checks;
  TestBytes(checks);
  TestRoundTrips(checks);
  TestSlicemaps(checks);
  TestRefusals(checks);
  TestBadFiles(checks);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
