// Proves that voxels written slab by slab are those of the whole, bit for bit: for every voxelizer,
// its modes, fill rules and backends, closed and open meshes, grids that begin anywhere, points and
// cells, data that are there already and filters that can't work in parts, in every format and with
// slabs of any thickness. That no more memory is asked for than the limit allows, and none is
// leaked from one write to the next update. And that bad input, a full disk and an abort end in one
// error, or none, and leave no file, or the former one.

#include "VoxelFilterTests.h"
#include "VoxelSolidTests.h"
#include "VoxelTestFiles.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkBinvoxReader.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDepthBufferVoxelizer.h>
#include <vtkErrorCode.h>
#include <vtkHybridSurfaceVoxelizer.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSlicemapSolidVoxelizer.h>
#include <vtkTetraCoveringVoxelizer.h>
#include <vtkTrivialProducer.h>
#include <vtkVoxelBitsReader.h>
#include <vtkVoxelMorphology.h>
#include <vtkVoxelSlabWriter.h>
#include <vtkXMLImageDataReader.h>

#ifdef VTKVOXELIZATION_HAS_OPENVDB
#include <vtkVDBVoxelReader.h>
#include <vtkVDBVoxelWriter.h>
#endif

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#if defined(__unix__)
#include <sys/resource.h>
#endif

using namespace VoxelTestFiles;
using VoxelFilterTests::Image;
using Solid = vtkSlicemapSolidVoxelizer;
using Writer = vtkVoxelSlabWriter;

namespace
{
vtkDataArray* GetVoxels(vtkImageData* image)
{
  vtkDataArray* points = image->GetPointData()->GetScalars();
  return points ? points : image->GetCellData()->GetScalars();
}

bool AreCells(vtkImageData* image)
{
  return !image->GetPointData()->GetScalars();
}

/// The same voxels at the same places; formats without an extent begin at 0.
bool IsSame(vtkImageData* found, vtkImageData* expected)
{
  vtkDataArray* a = GetVoxels(found);
  vtkDataArray* b = GetVoxels(expected);
  int n[3];
  expected->GetDimensions(n);
  for (int i = 0; i < 3; ++i)
  {
    n[i] -= AreCells(expected) && !AreCells(found) ? 1 : 0;
  }
  const double half = AreCells(expected) && !AreCells(found) ? 0.5 : 0.0;
  bool same = std::equal(n, n + 3, found->GetDimensions());
  double first[3];
  expected->TransformContinuousIndexToPhysicalPoint(expected->GetExtent()[0] + half,
    expected->GetExtent()[2] + half, expected->GetExtent()[4] + half, first);
  double foundFirst[3];
  found->TransformIndexToPhysicalPoint(
    found->GetExtent()[0], found->GetExtent()[2], found->GetExtent()[4], foundFirst);
  for (int i = 0; same && i < 3; ++i)
  {
    same = std::abs(found->GetSpacing()[i] - expected->GetSpacing()[i]) < 1e-12 &&
      std::abs(first[i] - foundFirst[i]) < 1e-9;
  }
  for (int i = 0; same && i < 9; ++i)
  {
    same = std::abs(found->GetDirectionMatrix()->GetData()[i] -
             expected->GetDirectionMatrix()->GetData()[i]) < 1e-12;
  }
  same = same && a && b && a->GetNumberOfTuples() == b->GetNumberOfTuples();
  for (vtkIdType i = 0; same && i < a->GetNumberOfTuples(); ++i)
  {
    same = (a->GetComponent(i, 0) != 0.0) == (b->GetComponent(i, 0) != 0.0);
  }
  return same;
}

template <typename Reader>
Image ReadWith(const std::string& name)
{
  vtkNew<Reader> reader;
  reader->SetFileName(name.c_str());
  reader->Update();
  return reader->GetOutput();
}

Image ReadFile(const std::string& name)
{
  switch (Writer::GetFormatOfFile(name.c_str()))
  {
    case Writer::FORMAT_VTI:
      return ReadWith<vtkXMLImageDataReader>(name);
    case Writer::FORMAT_BINVOX:
      return ReadWith<vtkBinvoxReader>(name);
    case Writer::FORMAT_BITS:
      return ReadWith<vtkVoxelBitsReader>(name);
#ifdef VTKVOXELIZATION_HAS_OPENVDB
    case Writer::FORMAT_VDB:
      return ReadWith<vtkVDBVoxelReader>(name);
#endif
    default:
      return Image::New();
  }
}

std::vector<std::string> GetExtensions()
{
  std::vector<std::string> extensions = { ".vti", ".binvox", ".bits" };
#ifdef VTKVOXELIZATION_HAS_OPENVDB
  extensions.emplace_back(".vdb");
#endif
  return extensions;
}

bool CanHold(const std::string& extension, vtkImageData* grid)
{
  const double* spacing = grid->GetSpacing();
  const bool areCubes = spacing[0] == spacing[1] && spacing[0] == spacing[2];
  return extension != ".binvox" || (areCubes && grid->GetDirectionMatrix()->IsIdentity());
}

std::int64_t Count(vtkDataArray* voxels)
{
  std::int64_t count = 0;
  for (vtkIdType i = 0; i < voxels->GetNumberOfTuples(); ++i)
  {
    count += voxels->GetComponent(i, 0) != 0.0;
  }
  return count;
}

/// The slabs of an algorithm in all formats against `whole`, which it made in one piece.
void CheckSlabs(VoxelTestChecks& checks, const std::string& title, vtkAlgorithm* algorithm,
  vtkImageData* whole, int slices)
{
  for (const std::string& extension : GetExtensions())
  {
    if (!CanHold(extension, whole))
    {
      continue;
    }
    const std::string name = PathOf("slabs" + extension);
    std::filesystem::remove(name);
    const std::string titleOfSlabs =
      title + ", slabs of " + std::to_string(slices) + ", " + extension;
    vtkNew<Writer> writer;
    writer->SetInputConnection(algorithm->GetOutputPort());
    writer->SetFileName(name.c_str());
    writer->SetMaximumSlices(slices);
    VoxelTestObserver observer(writer);
    checks.Equal(titleOfSlabs + ": written", writer->Write(), 1);
    checks.Equal(titleOfSlabs + ": errors", observer.Errors.size(), std::size_t(0));
    checks.Equal(titleOfSlabs + ": voxels", std::int64_t(writer->GetNumberOfFilledVoxels()),
      Count(GetVoxels(whole)));
    checks.Check(titleOfSlabs + ": the same", IsSame(ReadFile(name), whole));
    checks.Check(titleOfSlabs + ": no other file", !std::filesystem::exists(name + ".part"));
  }
}

/// What a voxelizer gives in one piece, apart from it.
Image MakeWhole(vtkVoxelizer* voxelizer)
{
  voxelizer->HostOutputOn();
  voxelizer->Update();
  auto whole = Image::New();
  whole->DeepCopy(voxelizer->GetOutput());
  voxelizer->HostOutputOff();
  return whole;
}

void CheckVoxelizer(VoxelTestChecks& checks, const std::string& title, vtkVoxelizer* voxelizer,
  const std::vector<int>& slices = { 1, 7, 0 })
{
  const Image whole = MakeWhole(voxelizer);
  checks.Check(title + ": has voxels", Count(GetVoxels(whole)) > 0);
  for (const int n : slices)
  {
    CheckSlabs(checks, title, voxelizer, whole, n);
  }
  voxelizer->HostOutputOn();
}

VoxelTestMeshes::Mesh MakeKnot()
{
  return VoxelTestMeshes::Rotated(VoxelTestMeshes::TorusKnot(60.0, 16, 150));
}

void TestSolids(VoxelTestChecks& checks)
{
  const auto knot = MakeKnot();
  const VoxelTestMeshes::Mesh open = VoxelTestMeshes::WithHoles(knot, 3, 40);
  const VoxelTestMeshes::Mesh meshes[] = { knot, open };
  for (const auto& mesh : meshes)
  {
    for (const int backend : { Solid::BACKEND_COMPUTE, Solid::BACKEND_RASTER })
    {
      for (const int rule :
        { Solid::FILL_RULE_PARITY, Solid::FILL_RULE_NON_ZERO, Solid::FILL_RULE_VOTE })
      {
        for (int axis = -1; axis < 3; ++axis)
        {
          if (rule == Solid::FILL_RULE_VOTE && axis >= 0)
          {
            continue;
          }
          vtkNew<Solid> voxelizer;
          voxelizer->SetInputData(mesh);
          voxelizer->SetResolution(45);
          voxelizer->SetBackend(backend);
          voxelizer->SetFillRule(rule);
          voxelizer->SetColumnAxis(axis);
          voxelizer->CheckWatertightOff();
          CheckVoxelizer(checks,
            std::string(mesh == knot ? "closed" : "open") + ", " +
              VoxelSolidTests::NameOf(backend) + ", rule " + std::to_string(rule) + ", axis " +
              std::to_string(axis),
            voxelizer, { 7 });
        }
      }
    }
  }
}

void TestModes(VoxelTestChecks& checks)
{
  const auto knot = MakeKnot();
  for (const int backend : { Solid::BACKEND_COMPUTE, Solid::BACKEND_RASTER })
  {
    for (const int mode :
      { Solid::MODE_OVER_CONSERVATIVE, Solid::MODE_UNDER_CONSERVATIVE, Solid::MODE_BOUNDARY })
    {
      vtkNew<Solid> voxelizer;
      voxelizer->SetInputData(knot);
      voxelizer->SetResolution(45);
      voxelizer->SetBackend(backend);
      voxelizer->SetMode(mode);
      CheckVoxelizer(checks, VoxelSolidTests::NameOf(backend) + ", mode " + std::to_string(mode),
        voxelizer, { 7 });
    }
  }
}

void TestOtherVoxelizers(VoxelTestChecks& checks)
{
  const auto knot = MakeKnot();
  for (const int separability : { 6, 26 })
  {
    vtkNew<vtkHybridSurfaceVoxelizer> surface;
    surface->SetInputData(knot);
    surface->SetResolution(60);
    surface->SetSeparability(separability);
    CheckVoxelizer(checks, "surface " + std::to_string(separability), surface);
  }
  using Depth = vtkDepthBufferVoxelizer;
  for (const int mode : { Depth::OUTPUT_MODE_SOLID, Depth::OUTPUT_MODE_SURFACE })
  {
    vtkNew<Depth> depth;
    depth->SetInputData(knot);
    depth->SetResolution(60);
    depth->SetOutputMode(mode);
    CheckVoxelizer(checks, "depth " + std::to_string(mode), depth);
  }
  using Tetra = vtkTetraCoveringVoxelizer;
  for (const int backend : { Tetra::BACKEND_COMPUTE, Tetra::BACKEND_RASTER })
  {
    for (const int shell : { Tetra::SHELL_NONE, Tetra::SHELL_26 })
    {
      vtkNew<Tetra> tetra;
      tetra->SetInputData(knot);
      tetra->SetResolution(40);
      tetra->SetBackend(backend);
      tetra->SetShell(shell);
      tetra->SetSeed(5);
      tetra->SetRotationModeToUniform();
      tetra->SafeScaleToFitOn();
      CheckVoxelizer(checks,
        "tetrahedra, " + VoxelSolidTests::NameOf(backend) + ", shell " + std::to_string(shell),
        tetra, { 7 });
    }
  }
}

void TestGrids(VoxelTestChecks& checks)
{
  const auto sphere = VoxelTestMeshes::Sphere({ 3.0, -2.0, 1.0 }, 11.0);
  for (const auto& [name, grid] : VoxelFilterTests::AwkwardGrids())
  {
    vtkNew<Solid> voxelizer;
    voxelizer->SetInputData(sphere);
    // Around the centre of each grid.
    double centre[3];
    grid->GetCenter(centre);
    const double* bounds = grid->GetBounds();
    const double radius =
      0.6 * std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4], 1.0 });
    voxelizer->SetInputData(VoxelTestMeshes::Sphere({ centre[0], centre[1], centre[2] }, radius));
    voxelizer->SetReferenceImage(grid);
    for (const bool cells : { false, true })
    {
      voxelizer->SetOutputAttributeType(cells ? Solid::ATTRIBUTE_CELL : Solid::ATTRIBUTE_POINT);
      CheckVoxelizer(checks, name + (cells ? ", cells" : ""), voxelizer, { 3, 128, 0 });
    }
  }
}

/// Data that are there, points and cells, and a filter that makes all at once.
void TestOtherSources(VoxelTestChecks& checks)
{
  const auto grid =
    VoxelSolidTests::MakeGrid({ -3, 150, 4, 30, -5, 19 }, { 1, 2, 3 }, { 0.5, 0.5, 0.5 });
  for (const int type : { VTK_UNSIGNED_CHAR, VTK_BIT, VTK_FLOAT })
  {
    for (const bool cells : { false, true })
    {
      const Image mask =
        VoxelFilterTests::MakeMask(grid, VoxelFilterTests::RandomVoxels(grid, 7), type, cells);
      vtkNew<vtkVoxelMorphology> keeps;
      keeps->SetInputData(mask);
      keeps->Update();
      const std::string title = "type " + std::to_string(type) + (cells ? ", cells" : ", points");
      vtkNew<vtkTrivialProducer> producer;
      producer->SetOutput(mask);
      CheckSlabs(checks, title, producer, mask, 4);
      CheckSlabs(checks, title + ", filter", keeps, keeps->GetOutput(), 4);
      keeps->HostOutputOff();
      const Image whole = Image::New();
      whole->DeepCopy(keeps->GetOutput());
      CheckSlabs(checks, title + ", bits of a filter", keeps, whole, 4);
    }
  }
}

void TestFormats(VoxelTestChecks& checks)
{
  vtkNew<Solid> voxelizer;
  voxelizer->SetInputData(MakeKnot());
  voxelizer->SetResolution(133);
  const Image whole = MakeWhole(voxelizer);
  const std::string name = PathOf("formats.vti");
  for (const int type : { VTK_UNSIGNED_CHAR, VTK_BIT })
  {
    for (const bool compressed : { false, true })
    {
      for (const int slices : { 1, 9, 0 })
      {
        vtkNew<Writer> writer;
        writer->SetInputConnection(voxelizer->GetOutputPort());
        writer->SetFileName(name.c_str());
        writer->SetScalarType(type);
        writer->SetForegroundValue(type == VTK_BIT ? 1 : 77);
        writer->SetCompressed(compressed);
        writer->SetMaximumSlices(slices);
        const std::string title = "vti of type " + std::to_string(type) +
          (compressed ? ", packed, slices " : ", slices ") + std::to_string(slices);
        checks.Equal(title + ": written", writer->Write(), 1);
        const Image image = ReadFile(name);
        checks.Check(title + ": the same", IsSame(image, whole));
        checks.Equal(title + ": type", image->GetScalarType(), type);
        checks.Equal(title + ": value", image->GetScalarRange()[1], type == VTK_BIT ? 1.0 : 77.0);
        checks.Equal(title + ": extent", image->GetExtent()[5], whole->GetExtent()[5]);
      }
    }
  }
  // A name without an extension.
  vtkNew<Writer> writer;
  writer->SetInputConnection(voxelizer->GetOutputPort());
  writer->SetFileName(PathOf("named").c_str());
  writer->SetFormatToBinvox();
  checks.Equal("format by name: written", writer->Write(), 1);
  checks.Check(
    "format by name: the same", IsSame(ReadWith<vtkBinvoxReader>(PathOf("named")), whole));
}

#ifdef VTKVOXELIZATION_HAS_OPENVDB
/// What vtkVDBVoxelWriter writes at once.
void TestGridsOfOpenVDB(VoxelTestChecks& checks)
{
  vtkNew<Solid> voxelizer;
  voxelizer->SetInputData(MakeKnot());
  voxelizer->SetResolution(140);
  voxelizer->HostOutputOff();
  for (const int kind : { Writer::GRID_BOOL, Writer::GRID_MASK, Writer::GRID_LEVEL_SET })
  {
    for (const int slices : { 5, 128, 0 })
    {
      vtkNew<vtkVDBVoxelWriter> whole;
      whole->SetInputConnection(voxelizer->GetOutputPort());
      whole->SetFileName(PathOf("whole.vdb").c_str());
      whole->SetOccupancyGrid(kind);
      whole->SetHalfBandWidth(2.5);
      checks.Equal("whole", whole->Write(), 1);
      vtkNew<Writer> slabs;
      slabs->SetInputConnection(voxelizer->GetOutputPort());
      slabs->SetFileName(PathOf("slabs.vdb").c_str());
      slabs->SetOccupancyGrid(kind);
      slabs->SetHalfBandWidth(2.5);
      slabs->SetMaximumSlices(slices);
      const std::string title =
        "OpenVDB grid " + std::to_string(kind) + ", slabs of " + std::to_string(slices);
      checks.Equal(title + ": written", slabs->Write(), 1);
      const Image found = ReadFile(PathOf("slabs.vdb"));
      const Image expected = ReadFile(PathOf("whole.vdb"));
      vtkDataArray* a = GetVoxels(found);
      vtkDataArray* b = GetVoxels(expected);
      bool same =
        a->GetDataType() == b->GetDataType() && a->GetNumberOfTuples() == b->GetNumberOfTuples();
      for (vtkIdType i = 0; same && i < a->GetNumberOfTuples(); ++i)
      {
        same = a->GetComponent(i, 0) == b->GetComponent(i, 0);
      }
      checks.Check(title + ": values", same);
      // Trees that are the same have files of the same length.
      checks.Equal(title + ": length", std::filesystem::file_size(PathOf("slabs.vdb")),
        std::filesystem::file_size(PathOf("whole.vdb")));
    }
  }
}
#endif

void TestMemory(VoxelTestChecks& checks)
{
  vtkNew<Solid> voxelizer;
  voxelizer->SetInputData(VoxelTestMeshes::Sphere({ 1.0, 2.0, 3.0 }, 5.0, 64));
  voxelizer->SetSampleDimensions(300, 300, 300);
  const Image whole = MakeWhole(voxelizer);
  // 300^2 rows of up to 128 voxels take 1.4 MB, and 32 planes across them a quarter of that.
  const std::pair<vtkTypeInt64, int> slabs[] = { { 1 << 26, 1 }, { 1 << 22, 2 }, { 1 << 21, 3 } };
  for (const auto& [limit, expected] : slabs)
  {
    vtkNew<Writer> writer;
    writer->SetInputConnection(voxelizer->GetOutputPort());
    writer->SetFileName(PathOf("limited.binvox").c_str());
    writer->SetMemoryLimit(limit);
    // Or else the whole, which is there, would be written as it is.
    voxelizer->Modified();
    const std::string title = "limit of " + std::to_string(limit);
    checks.Equal(title + ": written", writer->Write(), 1);
    checks.Check(title + ": the same", IsSame(ReadFile(PathOf("limited.binvox")), whole));
    checks.Equal(title + ": slabs", writer->GetNumberOfSlabs(), expected);
  }

  // Afterwards all of it is made again.
  voxelizer->HostOutputOn();
  voxelizer->Update();
  checks.Check("the whole after slabs", IsSame(voxelizer->GetOutput(), whole));
}

void ExpectRefusal(VoxelTestChecks& checks, const std::string& title, Writer* writer,
  unsigned long code, std::size_t errors = 1)
{
  VoxelTestObserver observer(writer);
  checks.Equal(title + ": not written", writer->Write(), 0);
  checks.Equal(title + ": errors", observer.Errors.size(), errors);
  checks.Equal(title + ": code", writer->GetErrorCode(), code);
}

void ExpectFormerFile(VoxelTestChecks& checks, const std::string& title, const std::string& name)
{
  checks.Equal(title + ": the former file", ReadBytes(name), std::string("as it was"));
  checks.Check(title + ": no other file", !std::filesystem::exists(name + ".part"));
}

void TestRefusals(VoxelTestChecks& checks)
{
  const auto knot = MakeKnot();
  for (const std::string& extension : GetExtensions())
  {
    const std::string name = PathOf("refused" + extension);
    WriteBytes(name, "as it was");
    vtkNew<Writer> writer;
    writer->SetFileName(name.c_str());
    ExpectRefusal(checks, "no input", writer, vtkErrorCode::UserError);
    vtkNew<Solid> voxelizer;
    voxelizer->SetInputData(knot);
    voxelizer->SetResolution(100);
    voxelizer->HostOutputOff();
    writer->SetInputConnection(voxelizer->GetOutputPort());
    writer->SetMemoryLimit(1000);
    ExpectRefusal(checks, extension + ", thin limit", writer, Writer::MemoryLimitError);
    writer->SetMemoryLimit(0);

    // The voxelizer tells itself.
    {
      VoxelTestObserver observer(voxelizer);
      voxelizer->SetResolution(-3);
      ExpectRefusal(checks, extension + ", bad grid", writer, Writer::UpstreamError, 0);
      checks.Equal("bad grid: errors of the voxelizer", observer.Errors.size(), std::size_t(1));
    }
    voxelizer->SetResolution(100);

    vtkNew<vtkVoxelMorphology> filter;
    filter->SetInputConnection(voxelizer->GetOutputPort());
    filter->HostOutputOff();
    writer->SetInputConnection(filter->GetOutputPort());
    writer->SetMemoryLimit(30000);
    ExpectRefusal(checks, extension + ", one piece", writer, Writer::MemoryLimitError);
    ExpectFormerFile(checks, extension, name);
    writer->SetMemoryLimit(0);

    // Stopped at each of its steps.
    bool wasStopped = false;
    writer->SetInputConnection(voxelizer->GetOutputPort());
    writer->SetMaximumSlices(16);
    for (int step = 0; step < 12; ++step)
    {
      VoxelTestObserver observer(writer);
      const VoxelTestAbort abort(writer, step);
      const int written = writer->Write();
      checks.Equal("stopped: errors", observer.Errors.size(), std::size_t(0));
      if (abort.HasCome())
      {
        wasStopped = true;
        checks.Equal("stopped: not written", written, 0);
        ExpectFormerFile(checks, extension + ", stopped at step " + std::to_string(step), name);
      }
      else
      {
        WriteBytes(name, "as it was");
      }
    }
    checks.Check(extension + ": some write was stopped", wasStopped);

    // Stopped from upstream.
    {
      const VoxelTestAbort abort(voxelizer, 1);
      VoxelTestObserver observer(writer);
      checks.Equal(extension + ", stopped upstream: not written", writer->Write(), 0);
      checks.Equal(
        extension + ", stopped upstream: errors", observer.Errors.size(), std::size_t(0));
      ExpectFormerFile(checks, extension + ", stopped upstream", name);
    }
    checks.Equal(extension + ": and then", writer->Write(), 1);
  }
  vtkNew<Solid> voxelizer;
  voxelizer->SetInputData(knot);
  vtkNew<Writer> writer;
  writer->SetInputConnection(voxelizer->GetOutputPort());
  ExpectRefusal(checks, "no name", writer, vtkErrorCode::NoFileNameError);
  writer->SetFileName(PathOf("a.png").c_str());
  ExpectRefusal(checks, "a picture", writer, vtkErrorCode::UnrecognizedFileTypeError);
  writer->SetFileName(PathOf("none/a.vti").c_str());
  ExpectRefusal(checks, "no such folder", writer, vtkErrorCode::CannotOpenFileError);
  writer->SetFileName(PathOf("flat.binvox").c_str());
  voxelizer->CubicVoxelsOff();
  ExpectRefusal(checks, "no cubes", writer, vtkErrorCode::UserError);
#ifdef VTKVOXELIZATION_HAS_OPENVDB
  writer->SetFileName(PathOf("flat.vdb").c_str());
  writer->SetOccupancyGridToLevelSet();
  ExpectRefusal(checks, "no cubes for a level set", writer, vtkErrorCode::UserError);
#endif
}

/// A limit for the sizes of files stands in for a full disk.
void TestFullDisk(VoxelTestChecks& checks)
{
#if defined(__unix__)
  vtkNew<Solid> voxelizer;
  voxelizer->SetInputData(MakeKnot());
  voxelizer->SetResolution(100);
  voxelizer->HostOutputOff();
  voxelizer->Update();
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  for (const std::string& extension : GetExtensions())
  {
    const std::string name = PathOf("full" + extension);
    WriteBytes(name, "as it was");
    for (const rlim_t bytes : { 10, 1000, 9000 })
    {
      rlimit limit = before;
      limit.rlim_cur = bytes;
      setrlimit(RLIMIT_FSIZE, &limit);
      vtkNew<Writer> writer;
      writer->SetInputConnection(voxelizer->GetOutputPort());
      writer->SetFileName(name.c_str());
      writer->SetMaximumSlices(16);
      const std::string title = extension + ", a disk of " + std::to_string(bytes) + " bytes";
      ExpectRefusal(checks, title, writer, vtkErrorCode::OutOfDiskSpaceError);
      setrlimit(RLIMIT_FSIZE, &before);
      ExpectFormerFile(checks, title, name);
    }
  }
  std::signal(SIGXFSZ, handler);
#endif
}
}

int TestVoxelSlabWriter(int argc, char* argv[])
{
  UseFolder("TestVoxelSlabWriter", argc, argv);
  VoxelTestChecks checks;
  TestSolids(checks);
  TestModes(checks);
  TestOtherVoxelizers(checks);
  TestGrids(checks);
  TestOtherSources(checks);
  TestFormats(checks);
#ifdef VTKVOXELIZATION_HAS_OPENVDB
  TestGridsOfOpenVDB(checks);
#endif
  TestMemory(checks);
  TestRefusals(checks);
  TestFullDisk(checks);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
