// Proves that .bits files hold what the format says, byte for byte, also several variants of a
// model, and that voxels come back from them as they were, with their geometry; and that bad files
// and requests end in one error and leave no file, or the former one.

#include "VoxelSolidTests.h"
#include "VoxelTestFiles.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"
#include "VoxelTestReaders.h"
#include "VoxelTetraTests.h"

#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVoxelBitsReader.h>
#include <vtkVoxelBitsWriter.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <random>
#include <string>

using namespace VoxelSolidTests;
using namespace VoxelTestFiles;

namespace
{
int WriteImage(vtkImageData* image, const std::string& name)
{
  vtkNew<vtkVoxelBitsWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(name.c_str());
  return writer->Write();
}

vtkSmartPointer<vtkImageData> RandomImage(int seed, const std::array<int, 6>& extent)
{
  const auto image = MakeGrid(
    extent, { 0.5, -2.0, 1.0 / 3.0 }, { 0.25, 0.5, 0.1 }, { 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, -1 });
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  std::mt19937 random(seed);
  auto* values = static_cast<unsigned char*>(image->GetScalarPointer());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    values[i] = random() % 3 == 0 ? 1 : 0;
  }
  return image;
}

void TestBytes(VoxelTestChecks& checks)
{
  // 3 x 2 x 2 voxels, of which (0, 0, 0), (2, 0, 0), (1, 1, 1) and (2, 1, 1) are set.
  const auto image = MakeGrid({ 4, 6, 0, 1, -1, 0 }, { 1, 2, 3 }, { 2, 3, 4 });
  image->AllocateScalars(VTK_FLOAT, 1);
  image->GetPointData()->GetScalars()->Fill(0.0);
  image->SetScalarComponentFromDouble(4, 0, -1, 0, -0.5);
  image->SetScalarComponentFromDouble(6, 0, -1, 0, 7.0);
  image->SetScalarComponentFromDouble(5, 1, 0, 0, 1.0);
  image->SetScalarComponentFromDouble(6, 1, 0, 0, 1.0);
  vtkNew<vtkVoxelBitsWriter> writer;
  writer->SetInputData(image);
  writer->SetLabel("night stand");
  writer->SetFileName(PathOf("bytes.bits").c_str());
  checks.Equal("written", writer->Write(), 1);
  checks.Equal("bytes", ReadBytes(PathOf("bytes.bits")),
    std::string("#voxelbits 1\ndim 3 2 2\nvariants 1\nfirst 0\nseed 0\nindex 4 0 -1\n"
                "origin 1 2 3\nspacing 2 3 4\ndirection 1 0 0 0 1 0 0 0 1\nlabel night "
                "stand\ndata\n\xa0\x30"));
  vtkNew<vtkVoxelBitsReader> reader;
  reader->SetFileName(PathOf("bytes.bits").c_str());
  reader->UpdateInformation();
  checks.Equal("label", reader->GetLabel(), std::string("night stand"));
}

bool IsSame(vtkImageData* found, vtkImageData* expected)
{
  bool same = std::equal(found->GetExtent(), found->GetExtent() + 6, expected->GetExtent());
  for (int i = 0; i < 3; ++i)
  {
    same = same && found->GetOrigin()[i] == expected->GetOrigin()[i] &&
      found->GetSpacing()[i] == expected->GetSpacing()[i];
  }
  for (int i = 0; i < 9; ++i)
  {
    same = same &&
      found->GetDirectionMatrix()->GetData()[i] == expected->GetDirectionMatrix()->GetData()[i];
  }
  auto* a = vtkUnsignedCharArray::SafeDownCast(found->GetPointData()->GetScalars());
  auto* b = vtkUnsignedCharArray::SafeDownCast(expected->GetPointData()->GetScalars());
  return same && a && b && a->GetNumberOfTuples() == b->GetNumberOfTuples() &&
    std::memcmp(a->GetPointer(0), b->GetPointer(0), a->GetNumberOfTuples()) == 0;
}

void TestRoundTrips(VoxelTestChecks& checks)
{
  const std::array<int, 6> extents[] = { { 0, 63, 0, 63, 0, 63 }, { -3, 127, 5, 40, 2, 2 },
    { 7, 7, 0, 99, -1, 8 }, { 0, 130, 0, 0, 0, 0 }, { 1, 1, 1, 1, 1, 1 }, { 0, 8, 0, 8, 0, 8 } };
  int seed = 1;
  for (const auto& extent : extents)
  {
    const std::string title = "random grid of seed " + std::to_string(seed);
    const auto image = RandomImage(seed++, extent);
    checks.Equal(title + ": written", WriteImage(image, PathOf("random.bits")), 1);
    vtkNew<vtkVoxelBitsReader> reader;
    reader->SetFileName(PathOf("random.bits").c_str());
    reader->Update();
    checks.Check(title + ": comes back", IsSame(reader->GetOutput(), image));
  }
}

void TestBatches(VoxelTestChecks& checks)
{
  constexpr int first = 3;
  constexpr int count = 4;
  const auto knot = VoxelTestMeshes::TorusKnot(50.0, 12, 100);
  const auto voxelizer = VoxelTetraTests::MakeVoxelizer(
    knot, VoxelTetraTests::MakeCube(knot, 35, 1), vtkVoxelizer::BACKEND_AUTO);
  VoxelTetraTests::AllSettings().back().Apply(voxelizer);
  for (const int shell : { 0, 18 })
  {
    const std::string title = "batch with shell " + std::to_string(shell);
    voxelizer->SetShell(shell);
    vtkNew<vtkUnsignedCharArray> expected;
    voxelizer->VoxelizeBatch(first, count, expected);
    vtkNew<vtkVoxelBitsWriter> writer;
    writer->SetFileName(PathOf("batch.bits").c_str());
    checks.Check(title + ": written", writer->WriteBatch(voxelizer, first, count));
    vtkNew<vtkVoxelBitsReader> reader;
    reader->SetFileName(PathOf("batch.bits").c_str());
    vtkNew<vtkUnsignedCharArray> found;
    checks.Check(title + ": read", reader->ReadBatch(found));
    checks.Check(title + ": the same",
      found->GetNumberOfValues() == expected->GetNumberOfValues() &&
        std::memcmp(found->GetPointer(0), expected->GetPointer(0), found->GetNumberOfValues()) ==
          0);
    const vtkIdType voxels = expected->GetNumberOfValues() / count;
    for (int i = 0; i < count; ++i)
    {
      reader->SetVariant(i);
      reader->Update();
      auto* one =
        vtkUnsignedCharArray::SafeDownCast(reader->GetOutput()->GetPointData()->GetScalars());
      checks.Check(title + ": variant " + std::to_string(i),
        one && std::memcmp(one->GetPointer(0), expected->GetPointer(i * voxels), voxels) == 0);
    }
    checks.Equal(title + ": variants", reader->GetNumberOfVariants(), vtkTypeInt64(count));
    checks.Equal(title + ": first", reader->GetFirstVariant(), vtkTypeInt64(first));
    checks.Equal(title + ": seed", reader->GetSeed(), vtkTypeInt64(-3));
    VoxelTestObserver observer(reader);
    reader->SetVariant(count);
    reader->Update();
    observer.ExpectOneError(checks, title + ": no such variant", "has 4 variants");
  }
}

void ExpectRefusal(VoxelTestChecks& checks, const std::string& title, unsigned long code,
  const std::function<void(vtkVoxelBitsWriter*)>& work)
{
  vtkNew<vtkVoxelBitsWriter> writer;
  VoxelTestObserver observer(writer);
  writer->SetInputData(RandomImage(9, { 0, 4, 0, 4, 0, 4 }));
  writer->SetFileName(PathOf("refused.bits").c_str());
  work(writer);
  checks.Equal(title + ": errors", observer.Errors.size(), std::size_t(1));
  checks.Equal(title + ": code", writer->GetErrorCode(), code);
}

void TestRefusals(VoxelTestChecks& checks)
{
  const std::string name = PathOf("refused.bits");
  WriteBytes(name, "as it was");
  using Writer = vtkVoxelBitsWriter;
  ExpectRefusal(checks, "no name", vtkErrorCode::NoFileNameError,
    [](Writer* w)
    {
      w->SetFileName(nullptr);
      w->Write();
    });
  ExpectRefusal(checks, "a folder", vtkErrorCode::CannotOpenFileError,
    [](Writer* w)
    {
      w->SetFileName(PathOf().c_str());
      w->Write();
    });
  ExpectRefusal(checks, "two lines", vtkErrorCode::UserError,
    [](Writer* w)
    {
      w->SetLabel("a\ndata");
      w->Write();
    });
  ExpectRefusal(checks, "empty", vtkErrorCode::UserError,
    [](Writer* w)
    {
      vtkNew<vtkImageData> empty;
      w->SetInputData(empty);
      w->Write();
    });
  ExpectRefusal(checks, "no voxelizer", vtkErrorCode::UserError,
    [](Writer* w) { w->WriteBatch(nullptr, 0, 1); });

  vtkNew<vtkTetraCoveringVoxelizer> voxelizer;
  voxelizer->SetInputData(VoxelTestMeshes::Box({ 0, 0, 0 }, { 1, 1, 1 }));
  vtkNew<Writer> writer;
  writer->SetFileName(name.c_str());
  VoxelTestObserver observer(voxelizer);
  checks.Check("zero variants", !writer->WriteBatch(voxelizer, 0, 0));
  observer.ExpectOneError(checks, "zero variants", "ask for one at least");
  VoxelTestAbort abort(voxelizer, 3);
  checks.Check("aborted", !writer->WriteBatch(voxelizer, 0, 100));
  checks.Check("aborted early", abort.HasCome());

  checks.Equal("the former file", ReadBytes(name), std::string("as it was"));
  checks.Check("no other file", !std::filesystem::exists(name + ".part"));
}

/// How many errors there were; the output is there, or empty after one.
std::size_t ReadBadFile(VoxelTestChecks& checks, const std::string& title, const std::string& bytes)
{
  WriteBytes(PathOf("bad.bits"), bytes);
  vtkNew<vtkVoxelBitsReader> reader;
  const std::size_t errors = VoxelTestRead(checks, title, reader.Get(), PathOf("bad.bits"));
  const VoxelTestObserver observer(reader);
  vtkNew<vtkUnsignedCharArray> batch;
  const bool read = reader->ReadBatch(batch);
  checks.Check(title + ": a batch or one error",
    observer.Errors.size() == (read ? 0 : 1) && (batch->GetNumberOfValues() > 0) == read);
  return errors;
}

void TestBadFiles(VoxelTestChecks& checks)
{
  WriteImage(RandomImage(3, { 0, 20, 0, 11, 0, 15 }), PathOf("good.bits"));
  const std::string good = ReadBytes(PathOf("good.bits"));
  checks.Equal("good file", ReadBadFile(checks, "good file", good), std::size_t(0));
  checks.Equal("more at the end", ReadBadFile(checks, "more", good + "\n"), std::size_t(0));
  checks.Equal("short header", ReadBadFile(checks, "short", "#voxelbits 1\ndim 2 2 2\ndata\n\x7f"),
    std::size_t(0));
  const std::string data = "data\nxxxxxxxx";
  const std::pair<const char*, std::string> bad[] = { { "empty", "" }, { "text", "solid a\n" },
    { "no data", "#voxelbits 1\ndim 2 2 2\n" }, { "no dimensions", "#voxelbits 1\n" + data },
    { "zero", "#voxelbits 1\ndim 2 0 2\n" + data },
    { "negative", "#voxelbits 1\ndim -2 2 -2\n" + data },
    { "two numbers", "#voxelbits 1\ndim 2 2\n" + data },
    { "huge", "#voxelbits 1\ndim 1000000 1000000 1000000\n" + data },
    { "overflow", "#voxelbits 1\ndim 99999999999999999999 1 1\n" + data },
    { "many variants", "#voxelbits 1\ndim 2 2 2\nvariants 9223372036854775807\n" + data },
    { "no variants", "#voxelbits 1\ndim 2 2 2\nvariants 0\n" + data },
    { "NaN", "#voxelbits 1\ndim 2 2 2\norigin nan 0 0\n" + data },
    { "flat", "#voxelbits 1\ndim 2 2 2\nspacing 1 0 1\n" + data },
    { "direction", "#voxelbits 1\ndim 2 2 2\ndirection 1 0 0 1 0 0 0 0 1\n" + data },
    { "far index", "#voxelbits 1\ndim 2 2 2\nindex 0 0 99999999999\n" + data },
    { "endless header", "#voxelbits 1\n" + std::string(1 << 20, 'x') } };
  for (const auto& [title, bytes] : bad)
  {
    checks.Equal(title, ReadBadFile(checks, title, bytes), std::size_t(1));
  }
  constexpr std::size_t header = 150;
  VoxelTestDamage(checks, good, header,
    [&](const std::string& title, const std::string& bytes)
    { return ReadBadFile(checks, title, bytes); });
  checks.Check("a .bits file", vtkVoxelBitsReader::CanReadFile(PathOf("good.bits").c_str()));
  checks.Check("no .bits file", !vtkVoxelBitsReader::CanReadFile(PathOf("missing.bits").c_str()));
  vtkNew<vtkVoxelBitsReader> missing;
  VoxelTestObserver observer(missing);
  missing->SetFileName(PathOf("missing.bits").c_str());
  missing->Update();
  observer.ExpectOneError(checks, "missing", "There is no file");
}
}

int TestVoxelBits(int argc, char* argv[])
{
  UseFolder("TestVoxelBits", argc, argv);
  VoxelTestChecks checks;
  TestBytes(checks);
  TestRoundTrips(checks);
  TestBatches(checks);
  TestRefusals(checks);
  TestBadFiles(checks);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
