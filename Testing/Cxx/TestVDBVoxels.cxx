// Proves that .vdb files hold voxels as they are, with their geometry: bits of awkward grids as
// bool, mask and level set grids, arrays of all types, and lists of voxels come back voxel for
// voxel, and OpenVDB itself reads what is written. That distances of a level set are within half a
// voxel of the true ones. And that bad files, and data that the format can't hold, end in one error
// and leave no file, or the former one.

#include "VoxelComparison.h"
#include "VoxelFilterTests.h"
#include "VoxelSolidTests.h"
#include "VoxelTestFiles.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"
#include "VoxelTestReaders.h"

#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkFloatArray.h>
#include <vtkHybridSurfaceVoxelizer.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSlicemap.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVDBVoxelReader.h>
#include <vtkVDBVoxelWriter.h>

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#if defined(__unix__)
#include <sys/resource.h>
#endif

using namespace VoxelFilterTests;
using namespace VoxelTestFiles;
using VoxelReference::Volume;

namespace
{
using Writer = vtkVDBVoxelWriter;
using Reader = vtkVDBVoxelReader;

bool HaveSameGeometry(vtkImageData* found, vtkImageData* expected)
{
  bool same = std::equal(expected->GetExtent(), expected->GetExtent() + 6, found->GetExtent());
  for (int i = 0; i < 3; ++i)
  {
    same = same && std::abs(found->GetOrigin()[i] - expected->GetOrigin()[i]) < 1e-12 &&
      std::abs(found->GetSpacing()[i] - expected->GetSpacing()[i]) < 1e-12;
  }
  for (int i = 0; i < 9; ++i)
  {
    same = same &&
      std::abs(found->GetDirectionMatrix()->GetData()[i] -
        expected->GetDirectionMatrix()->GetData()[i]) < 1e-12;
  }
  return same;
}

bool HaveSameValues(vtkDataArray* found, vtkDataArray* expected)
{
  bool same = found && expected && found->GetDataType() == expected->GetDataType() &&
    found->GetNumberOfComponents() == expected->GetNumberOfComponents() &&
    found->GetNumberOfTuples() == expected->GetNumberOfTuples();
  for (vtkIdType i = 0; same && i < found->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; same && c < found->GetNumberOfComponents(); ++c)
    {
      same = found->GetComponent(i, c) == expected->GetComponent(i, c);
    }
  }
  return same;
}

/// The image in a file, which is to be read without an error.
Image Read(VoxelTestChecks& checks, const std::string& title, const std::string& name,
  const char* grid = nullptr)
{
  vtkNew<Reader> reader;
  reader->SetFileName(name.c_str());
  reader->SetGridName(grid);
  reader->Update();
  checks.Equal(title + ": read", reader->GetErrorCode(), std::uint64_t(vtkErrorCode::NoError));
  return reader->GetOutput();
}

int Write(vtkDataObject* data, const std::string& name, int occupancy = Writer::GRID_BOOL,
  int compression = Writer::COMPRESSION_ZIP)
{
  vtkNew<Writer> writer;
  writer->SetInputDataObject(data);
  writer->SetFileName(name.c_str());
  writer->SetOccupancyGrid(occupancy);
  writer->SetCompression(compression);
  return writer->Write();
}

/// The same as a set of voxels, in OpenVDB's own eyes.
void CheckWithOpenVDB(VoxelTestChecks& checks, const std::string& title, const std::string& name,
  vtkImageData* grid, const Volume& voxels)
{
  openvdb::io::File file(name);
  file.open();
  const auto base = file.readGrid("Occupancy");
  const unsigned char* values = voxels.Voxels.get();
  const std::int64_t set = std::count_if(
    values, values + voxels.Grid.NumberOfVoxels(), [](unsigned char v) { return v != 0; });
  checks.Equal(title + ": active voxels", std::int64_t(base->activeVoxelCount()), set);
  const int* e = grid->GetExtent();
  const double middle[3] = { 0.5 * (e[0] + e[1]), 0.5 * (e[2] + e[3]), 0.5 * (e[4] + e[5]) };
  double expected[3];
  grid->TransformContinuousIndexToPhysicalPoint(middle, expected);
  const openvdb::Vec3d found =
    base->transform().indexToWorld(openvdb::Vec3d(middle[0], middle[1], middle[2]));
  checks.Check(title + ": place",
    (found - openvdb::Vec3d(expected[0], expected[1], expected[2])).length() < 1e-9);
  if (const auto bits = openvdb::gridPtrCast<openvdb::BoolGrid>(base))
  {
    const auto accessor = bits->getConstAccessor();
    bool same = true;
    std::size_t i = 0;
    for (int z = e[4]; z <= e[5]; ++z)
    {
      for (int y = e[2]; y <= e[3]; ++y)
      {
        for (int x = e[0]; x <= e[1]; ++x, ++i)
        {
          const openvdb::Coord xyz(x, y, z);
          const bool isSet = voxels.Voxels[i] != 0;
          same = same && accessor.getValue(xyz) == isSet && accessor.isValueOn(xyz) == isSet;
        }
      }
    }
    checks.Check(title + ": voxels of OpenVDB", same);
  }
}

std::vector<NamedGrid> Grids()
{
  auto grids = AwkwardGrids();
  grids.push_back({ "wider than 128 on all axes, over 0",
    VoxelSolidTests::MakeGrid({ -70, 201, -130, 7, -5, 135 }, { 1, 2, 3 }, { 1, 1, 1 }) });
  return grids;
}

/// Random voxels, some with full and empty blocks of all sizes between.
Volume MakeTestVoxels(vtkImageData* grid, unsigned int seed)
{
  Volume voxels = RandomVoxels(grid, seed);
  const int* e = grid->GetExtent();
  std::size_t i = 0;
  for (int z = e[4]; z <= e[5]; ++z)
  {
    for (int y = e[2]; y <= e[3]; ++y)
    {
      for (int x = e[0]; x <= e[1]; ++x, ++i)
      {
        const int block = (x >> 4) + (y >> 4) + (z >> 4);
        const bool isInTile = x >= 0 && y < 0 && z >= 0 && x < 128 && z < 128;
        voxels.Voxels[i] = isInTile || (block % 3 == 0) || (block % 3 == 1 && voxels.Voxels[i]);
      }
    }
  }
  return voxels;
}

void TestBits(VoxelTestChecks& checks)
{
  unsigned int seed = 1;
  for (const auto& [title, grid] : Grids())
  {
    const std::string name = title + ", seed " + std::to_string(seed);
    const Volume voxels = MakeTestVoxels(grid, seed++);
    const Image image = MakeMask(grid, voxels);
    image->GetPointData()->GetScalars()->SetName("Occupancy");
    for (const int occupancy : { Writer::GRID_BOOL, Writer::GRID_MASK })
    {
      const std::string file = PathOf("bits.vdb");
      const std::string kind = name + (occupancy == Writer::GRID_BOOL ? ", bool" : ", mask");
      checks.Equal(kind + ": written", Write(image, file, occupancy), 1);
      const Image found = Read(checks, kind, file);
      checks.Check(kind + ": geometry", HaveSameGeometry(found, grid));
      checks.Check(kind, VoxelReference::Report(kind, VoxelReference::Compare(found, voxels)));
      CheckWithOpenVDB(checks, kind, file, grid, voxels);
    }
    const Image bits = MakeMask(grid, voxels, VTK_BIT, true);
    Write(bits, PathOf("cells.vdb"));
    Write(image, PathOf("bits.vdb"));
    const Image cells = Read(checks, name + ", cells", PathOf("cells.vdb"));
    checks.Check(
      name + ": cells are voxels as well", VoxelReference::Compare(cells, voxels).IsNone());
  }
}

void TestSlicemaps(VoxelTestChecks& checks)
{
  vtkNew<vtkSlicemapSolidVoxelizer> voxelizer;
  voxelizer->SetInputData(VoxelTestMeshes::TorusKnot(50.0, 24, 200));
  voxelizer->SetResolution(150);
  voxelizer->HostOutputOff();
  vtkNew<Writer> writer;
  writer->SetInputConnection(voxelizer->GetOutputPort());
  writer->SetFileName(PathOf("knot.vdb").c_str());
  writer->SetOccupancyGridToMask();
  writer->SetInputName(0, "knot");
  checks.Equal("bits on the GPU: written", writer->Write(), 1);
  checks.Equal("bits on the GPU: active voxels", writer->GetNumberOfActiveVoxels(),
    vtkTypeInt64(voxelizer->GetNumberOfFilledVoxels()));
  voxelizer->HostOutputOn();
  voxelizer->Update();
  const Image found = Read(checks, "knot", PathOf("knot.vdb"), "knot");
  checks.Check("bits on the GPU: geometry", HaveSameGeometry(found, voxelizer->GetOutput()));
  checks.Check("bits on the GPU come back",
    HaveSameValues(
      found->GetPointData()->GetScalars(), voxelizer->GetOutput()->GetPointData()->GetScalars()));

  vtkNew<Reader> reader;
  reader->SetFileName(PathOf("knot.vdb").c_str());
  int part[6];
  std::copy_n(found->GetExtent(), 6, part);
  part[0] += 3;
  part[3] -= 40;
  part[4] = part[5] - 9;
  reader->UpdateExtent(part);
  vtkNew<vtkImageData> expected;
  expected->DeepCopy(found);
  expected->Crop(part);
  checks.Check("part of a file: geometry", HaveSameGeometry(reader->GetOutput(), expected));
  checks.Check("part of a file",
    HaveSameValues(
      reader->GetOutput()->GetPointData()->GetScalars(), expected->GetPointData()->GetScalars()));
}

vtkSmartPointer<vtkDataArray> RandomArray(
  int type, int components, vtkIdType count, unsigned int seed, const char* name)
{
  vtkSmartPointer<vtkDataArray> array;
  array.TakeReference(vtkDataArray::CreateDataArray(type));
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(count);
  std::mt19937 random(seed);
  const bool isReal = type == VTK_FLOAT || type == VTK_DOUBLE;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const bool isBackground = random() % 3 == 0;
    for (int c = 0; c < components; ++c)
    {
      const double value = isReal ? double(random()) / 1e9 - 1.0 : double(random() % 256);
      array->SetComponent(i, c, isBackground ? 0.0 : value);
    }
  }
  return array;
}

void TestArrays(VoxelTestChecks& checks)
{
  struct Case
  {
    const char* Name;
    int Type;
    int Components;
    int Back; // type that comes back
  };
  const Case cases[] = { { "Density", VTK_FLOAT, 1, VTK_FLOAT },
    { "double", VTK_DOUBLE, 1, VTK_DOUBLE }, { "label", VTK_UNSIGNED_CHAR, 1, VTK_INT },
    { "short", VTK_SHORT, 1, VTK_INT }, { "long", VTK_LONG_LONG, 1, VTK_TYPE_INT64 },
    { "Normals", VTK_FLOAT, 3, VTK_FLOAT }, { "vec3d", VTK_DOUBLE, 3, VTK_DOUBLE },
    { "vec3i", VTK_INT, 3, VTK_INT } };
  unsigned int seed = 100;
  for (const auto& [title, grid] : Grids())
  {
    vtkNew<vtkImageData> image;
    image->ShallowCopy(grid);
    for (const Case& c : cases)
    {
      image->GetPointData()->AddArray(
        RandomArray(c.Type, c.Components, image->GetNumberOfPoints(), seed++, c.Name));
    }
    const int compression = seed % 2 ? Writer::COMPRESSION_ZIP : Writer::COMPRESSION_NONE;
    checks.Equal(title + ": arrays written",
      Write(image, PathOf("arrays.vdb"), Writer::GRID_BOOL, compression), 1);
    const Image found = Read(checks, title, PathOf("arrays.vdb"));
    checks.Check(title + ": geometry of arrays", HaveSameGeometry(found, grid));
    for (const Case& c : cases)
    {
      vtkSmartPointer<vtkDataArray> expected;
      expected.TakeReference(vtkDataArray::CreateDataArray(c.Back));
      expected->DeepCopy(image->GetPointData()->GetArray(c.Name));
      checks.Check(title + ", seed " + std::to_string(seed) + ": array " + c.Name,
        HaveSameValues(found->GetPointData()->GetArray(c.Name), expected));
    }
  }
}

/// Colours are 0 to 1; values differ from a background other than 0; what isn't named stays out.
void TestChoices(VoxelTestChecks& checks)
{
  const auto image = VoxelSolidTests::MakeGrid({ -1, 9, 0, 8, 3, 20 }, { 0, 0, 0 }, { 1, 1, 1 });
  const vtkIdType count = image->GetNumberOfPoints();
  image->GetPointData()->AddArray(RandomArray(VTK_UNSIGNED_CHAR, 4, count, 5, "Texture"));
  image->GetPointData()->AddArray(RandomArray(VTK_FLOAT, 1, count, 6, "Density"));
  image->GetPointData()->AddArray(RandomArray(VTK_FLOAT, 2, count, 7, "two components"));
  vtkNew<Writer> writer;
  writer->SetInputData(image);
  writer->SetFileName(PathOf("choices.vdb").c_str());
  writer->AddArray("Texture");
  writer->AddArray("Density");
  writer->SetBackground(2.5);
  writer->SetInputName(0, "a");
  writer->SetMetadata("patient", "none");
  checks.Equal("choices: written", writer->Write(), 1);
  vtkNew<Reader> reader;
  reader->SetFileName(PathOf("choices.vdb").c_str());
  reader->Update();
  checks.Equal("grids", reader->GetNumberOfGrids(), 2);
  checks.Equal("name", std::string(reader->GetNameOfGrid(0)), std::string("a.Texture"));
  checks.Equal("type", std::string(reader->GetTypeOfGrid(1)), std::string("Tree_float_5_4_3"));
  checks.Equal("metadata", std::string(reader->GetMetadata("patient")), std::string("none"));
  vtkPointData* found = reader->GetOutput()->GetPointData();
  checks.Check("density with another background",
    HaveSameValues(found->GetArray("a.Density"), image->GetPointData()->GetArray("Density")));
  vtkDataArray* colors = found->GetArray("a.Texture");
  vtkDataArray* bytes = image->GetPointData()->GetArray("Texture");
  bool same = colors && colors->GetNumberOfComponents() == 3;
  for (vtkIdType i = 0; same && i < count; ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      same =
        same && std::abs(colors->GetComponent(i, c) * 255.0 - bytes->GetComponent(i, c)) < 1e-4;
    }
  }
  checks.Check("colours", same);
  openvdb::io::File file(PathOf("choices.vdb"));
  file.open();
  const auto density = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("a.Density"));
  checks.Check("background", density->background() == 2.5f);
  checks.Check("fog volume", density->getGridClass() == openvdb::GRID_FOG_VOLUME);

  // Two inputs on lattices of their own.
  const auto other = VoxelSolidTests::MakeGrid({ 0, 3, 0, 4, 0, 5 }, { 0, 0, 0 }, { 2, 2, 2 });
  other->GetPointData()->SetScalars(
    RandomArray(VTK_FLOAT, 1, other->GetNumberOfPoints(), 8, "other"));
  writer->AddInputDataObject(0, other);
  writer->AddArray("other");
  writer->SetInputName(1, "b");
  checks.Equal("two inputs: written", writer->Write(), 1);
  const Image second = Read(checks, "second input", PathOf("choices.vdb"), "b");
  checks.Check("second input: geometry", HaveSameGeometry(second, other));
  checks.Check("second input",
    HaveSameValues(second->GetPointData()->GetScalars(), other->GetPointData()->GetScalars()));
  VoxelTestObserver observer(reader);
  reader->Modified();
  reader->Update();
  checks.Equal("several lattices: errors", observer.Errors.size(), std::size_t(1));
}

void TestLists(VoxelTestChecks& checks)
{
  const auto mesh = VoxelTestMeshes::Sphere({ 0.3, 0.1, 0 }, 1.0);
  vtkNew<vtkHybridSurfaceVoxelizer> voxelizer;
  voxelizer->SetInputData(mesh);
  voxelizer->SetReferenceImage(VoxelSolidTests::MakeGrid({ -40, 55, -33, 40, -35, 38 }, { 0, 0, 0 },
    { 0.03, 0.04, 0.035 }, { 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1 }));
  vtkNew<vtkFloatArray> x;
  x->SetName("x");
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    x->InsertNextValue(static_cast<float>(mesh->GetPoint(i)[0]));
  }
  mesh->GetPointData()->AddArray(x);
  voxelizer->AddAttribute("x");
  voxelizer->Update(1);
  checks.Equal("list: written",
    Write(voxelizer->GetOutputDataObject(1), PathOf("list.vdb"), Writer::GRID_MASK), 1);
  voxelizer->Update(0);
  const Image found = Read(checks, "list", PathOf("list.vdb"));
  vtkImageData* expected = voxelizer->GetOutput();
  checks.Check("list: geometry", HaveSameGeometry(found, expected));
  for (const char* name : { "Occupancy", "x" })
  {
    checks.Check("list: " + std::string(name),
      HaveSameValues(
        found->GetPointData()->GetArray(name), expected->GetPointData()->GetArray(name)));
  }

  // Points alone, of which two lie in one voxel.
  vtkNew<vtkPolyData> points;
  vtkNew<vtkPoints> places;
  places->InsertNextPoint(0.1, 0.1, 0.1);
  places->InsertNextPoint(-0.2, 0.3, 0);
  places->InsertNextPoint(5.0, 6.6, 7.0);
  points->SetPoints(places);
  vtkNew<Writer> writer;
  writer->SetInputData(points);
  writer->SetFileName(PathOf("points.vdb").c_str());
  VoxelTestObserver observer(writer);
  writer->Write();
  checks.Equal("points without a grid: errors", observer.Errors.size(), std::size_t(1));
  checks.Check("points without a grid: file", !std::filesystem::exists(PathOf("points.vdb")));
  writer->SetReferenceImage(
    VoxelSolidTests::MakeGrid({ 0, 9, 0, 9, 0, 9 }, { 0, 0, 0 }, { 1, 1, 1 }));
  writer->Write();
  checks.Equal("points", writer->GetNumberOfActiveVoxels(), vtkTypeInt64(2));
  const Image voxels = Read(checks, "points", PathOf("points.vdb"));
  checks.Equal("voxel of a point", voxels->GetScalarComponentAsDouble(5, 7, 7, 0), 1.0);
}

void TestLevelSet(VoxelTestChecks& checks)
{
  // Radii from few voxels to more than a tile; centres off the lattice.
  const double radii[] = { 3.3, 17.25, 70.9 };
  for (const double radius : radii)
  {
    const double spacing = 0.5;
    const double centre[3] = { 3.1, -2.77, 0.46 };
    const int reach = static_cast<int>(radius) + 14;
    const auto grid =
      VoxelSolidTests::MakeGrid({ -reach, reach + 9, -reach - 3, reach, -reach, reach },
        { 0, 0, 0 }, { spacing, spacing, spacing });
    const std::string title = "sphere of " + std::to_string(radius);
    const auto distanceOf = [&](vtkIdType i)
    {
      double point[3];
      grid->GetPoint(i, point);
      return std::hypot(point[0] - centre[0], point[1] - centre[1], point[2] - centre[2]) -
        radius * spacing;
    };
    Image image = MakeMask(grid,
      MakeVoxels(grid, [&](std::size_t i) { return distanceOf(static_cast<vtkIdType>(i)) < 0; }),
      VTK_BIT);
    Write(image, PathOf("sphere.vdb"), Writer::GRID_LEVEL_SET);
    const Image found = Read(checks, title, PathOf("sphere.vdb"));
    vtkDataArray* distances = found->GetPointData()->GetScalars();
    const double band = 3.0 * spacing;
    double worst = 0.0;
    bool signs = true;
    for (vtkIdType i = 0; i < distances->GetNumberOfTuples(); ++i)
    {
      const double expected = std::clamp(distanceOf(i), -band, band);
      const double value = distances->GetComponent(i, 0);
      worst = std::max(worst, std::abs(value - expected));
      signs = signs && (value < 0) == (expected < 0);
    }
    checks.Check(title + ": worst " + std::to_string(worst), worst <= 0.5 * spacing + 1e-6);
    checks.Check(title + ": signs", signs);

    openvdb::io::File file(PathOf("sphere.vdb"));
    file.open();
    const auto levelSet = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("Occupancy"));
    checks.Check(title + ": class", levelSet->getGridClass() == openvdb::GRID_LEVEL_SET);
    checks.Check(title + ": background", levelSet->background() == float(band));
    bool isNarrow = true;
    for (auto voxel = levelSet->cbeginValueOn(); voxel; ++voxel)
    {
      isNarrow = isNarrow && voxel.isVoxelValue() && std::abs(*voxel) < band;
    }
    checks.Check(title + ": active voxels are the band", isNarrow);
  }
}

void ExpectRefusal(
  VoxelTestChecks& checks, const std::string& title, vtkWriter* writer, unsigned long code)
{
  VoxelTestObserver observer(writer);
  writer->Write();
  checks.Equal(title + ": errors", observer.Errors.size(), std::size_t(1));
  checks.Equal(title + ": code", writer->GetErrorCode(), code);
}

Image SmallImage(int seed = 9)
{
  const auto image = VoxelSolidTests::MakeGrid({ 0, 24, 0, 14, 0, 34 }, { 0, 0, 0 }, { 1, 1, 1 });
  const Image mask = MakeMask(image, RandomVoxels(image, seed));
  mask->GetPointData()->GetScalars()->SetName("Occupancy");
  mask->GetPointData()->AddArray(
    RandomArray(VTK_FLOAT, 1, mask->GetNumberOfPoints(), seed, "Density"));
  return mask;
}

void ExpectFormerFile(VoxelTestChecks& checks, const std::string& title, const std::string& name)
{
  checks.Equal(title + ": the former file", ReadBytes(name), std::string("as it was"));
  checks.Check(title + ": no other file", !std::filesystem::exists(name + ".part"));
}

void TestRefusals(VoxelTestChecks& checks)
{
  const std::string name = PathOf("refused.vdb");
  WriteBytes(name, "as it was");
  const auto refuse = [&](const std::string& title, vtkImageData* image, const char* file,
                        unsigned long code, int occupancy = Writer::GRID_BOOL)
  {
    vtkNew<Writer> writer;
    writer->SetInputData(image);
    writer->SetFileName(file);
    writer->SetOccupancyGrid(occupancy);
    ExpectRefusal(checks, title, writer, code);
    ExpectFormerFile(checks, title, name);
  };
  const Image image = SmallImage();
  refuse("no name", image, nullptr, vtkErrorCode::NoFileNameError);
  refuse("a folder", image, PathOf().c_str(), vtkErrorCode::CannotOpenFileError);
  refuse("no such folder", image, PathOf("none/a.vdb").c_str(), vtkErrorCode::CannotOpenFileError);
  vtkNew<vtkImageData> empty;
  refuse("empty", empty, name.c_str(), vtkErrorCode::UserError);
  const auto bare = VoxelSolidTests::MakeGrid({ 0, 4, 0, 4, 0, 4 }, { 0, 0, 0 }, { 1, 1, 1 });
  refuse("no arrays", bare, name.c_str(), vtkErrorCode::UserError);
  bare->GetPointData()->AddArray(RandomArray(VTK_FLOAT, 2, 125, 1, "two"));
  refuse("two components", bare, name.c_str(), vtkErrorCode::UserError);
  const Image flat = SmallImage();
  flat->SetSpacing(1, 1, 2);
  refuse("no cubes", flat, name.c_str(), vtkErrorCode::UserError, Writer::GRID_LEVEL_SET);
  const Image sheared = SmallImage();
  sheared->SetDirectionMatrix(1, 0.5, 0, 0, 1, 0, 0, 0, 1);
  refuse("sheared", sheared, name.c_str(), vtkErrorCode::UserError);
  const Image pointless = SmallImage();
  pointless->SetSpacing(1, 0, 2);
  refuse("no size", pointless, name.c_str(), vtkErrorCode::UserError);

  // Stopped at each of its steps.
  bool wasStopped = false;
  for (int step = 0; step < 8; ++step)
  {
    vtkNew<Writer> writer;
    writer->SetInputData(image);
    writer->SetFileName(name.c_str());
    const VoxelTestAbort abort(writer, step);
    writer->Write();
    if (abort.HasCome())
    {
      wasStopped = true;
      ExpectFormerFile(checks, "stopped at step " + std::to_string(step), name);
    }
  }
  checks.Check("some write was stopped", wasStopped);
}

/// A limit for the sizes of files stands in for a full disk.
void TestFullDisk(VoxelTestChecks& checks)
{
#if defined(__unix__)
  const std::string name = PathOf("refused.vdb");
  WriteBytes(name, "as it was");
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  for (const rlim_t bytes : { 10, 1000, 10000 })
  {
    rlimit limit = before;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
    vtkNew<Writer> writer;
    writer->SetInputData(SmallImage());
    writer->SetFileName(name.c_str());
    const std::string title = "a disk of " + std::to_string(bytes) + " bytes";
    ExpectRefusal(checks, title, writer, vtkErrorCode::OutOfDiskSpaceError);
    setrlimit(RLIMIT_FSIZE, &before);
    ExpectFormerFile(checks, title, name);
  }
  std::signal(SIGXFSZ, handler);
#endif
}

/// How many errors there were.
std::size_t ReadBadFile(VoxelTestChecks& checks, const std::string& title, const std::string& bytes)
{
  const std::string name = PathOf("bad.vdb");
  WriteBytes(name, bytes);
  vtkNew<Reader> reader;
  constexpr vtkTypeInt64 limit = 1 << 24;
  reader->SetMemoryLimit(limit);
  return VoxelTestRead(checks, title, reader.Get(), name);
}

void TestBadFiles(VoxelTestChecks& checks)
{
  for (const int compression :
    { Writer::COMPRESSION_NONE, Writer::COMPRESSION_ZIP, Writer::COMPRESSION_BLOSC })
  {
    if (!Writer::IsCompressionAvailable(compression))
    {
      continue;
    }
    for (const int occupancy : { Writer::GRID_BOOL, Writer::GRID_LEVEL_SET })
    {
      const std::string kind =
        "compression " + std::to_string(compression) + ", occupancy " + std::to_string(occupancy);
      Write(SmallImage(), PathOf("good.vdb"), occupancy, compression);
      const std::string good = ReadBytes(PathOf("good.vdb"));
      checks.Equal(kind + ": good file", ReadBadFile(checks, kind, good), std::size_t(0));
      for (std::size_t length = 0; length < good.size(); length += 1 + length / 16)
      {
        const std::string title = kind + ", first " + std::to_string(length) + " bytes";
        checks.Equal(title, ReadBadFile(checks, title, good.substr(0, length)), std::size_t(1));
      }
      constexpr int mutations = 200;
      constexpr std::size_t header = 1500;
      for (int seed = 0; seed < mutations; ++seed)
      {
        ReadBadFile(
          checks, kind + ", mutation of seed " + std::to_string(seed), Damaged(good, seed, header));
      }
    }
  }
  const std::pair<const char*, std::string> bad[] = { { "empty", "" }, { "text", "solid a\n" },
    { "signature alone", std::string(" BDV\0\0\0\0", 8) },
    { "zeros", std::string(" BDV\0\0\0\0", 8) + std::string(4096, '\0') },
    { "ones", std::string(" BDV\0\0\0\0", 8) + std::string(4096, '\xff') } };
  for (const auto& [title, bytes] : bad)
  {
    checks.Equal(title, ReadBadFile(checks, title, bytes), std::size_t(1));
  }
}

/// Lengths that OpenVDB does not look at, and reads on from a wrong place.
void TestLengths(VoxelTestChecks& checks)
{
  Write(SmallImage(), PathOf("good.vdb"), Writer::GRID_LEVEL_SET, Writer::COMPRESSION_ZIP);
  const std::string good = ReadBytes(PathOf("good.vdb"));
  const std::string name = PathOf("bad.vdb");
  const auto expectError = [&](std::size_t place, const std::string& says)
  {
    std::string bad = good;
    bad.at(place) = static_cast<char>(bad[place] + 1);
    WriteBytes(name, bad);
    vtkNew<Reader> reader;
    const VoxelTestObserver observer(reader);
    reader->SetFileName(name.c_str());
    reader->Update();
    observer.ExpectOneError(checks, says, says);
  };
  const std::string metadata = "vtk_extent_min";
  const std::string type = "vec3i";
  const std::size_t typeLength = good.find(metadata) + metadata.size();
  expectError(typeLength + sizeof(std::uint32_t) + type.size(), "metadata has the wrong length");
}

/// As OpenVDB's library makes it, which saves compiling that here.
openvdb::FloatGrid::Ptr MakeFloatGrid()
{
  return openvdb::gridPtrCast<openvdb::FloatGrid>(
    openvdb::GridBase::createGrid(openvdb::FloatGrid::gridType()));
}

/// Grids as other programs may write them; how many errors there are.
std::size_t ReadGrids(
  VoxelTestChecks& checks, const std::string& title, const openvdb::GridCPtrVec& grids)
{
  openvdb::io::File(PathOf("grids.vdb")).write(grids);
  return ReadBadFile(checks, title, ReadBytes(PathOf("grids.vdb")));
}

void TestOtherGrids(VoxelTestChecks& checks)
{
  const auto ball = [](const char* name)
  {
    const auto grid = MakeFloatGrid();
    grid->fill(openvdb::CoordBBox(openvdb::Coord(-3, 2, 100), openvdb::Coord(20, 9, 117)), 4.0f);
    grid->setName(name);
    return grid;
  };
  checks.Equal("no grid", ReadGrids(checks, "no grid", {}), std::size_t(1));
  checks.Equal("no voxel", ReadGrids(checks, "no voxel", { MakeFloatGrid() }), std::size_t(1));
  const auto points = openvdb::GridBase::createGrid("Tree_ptdataidx32_5_4_3");
  points->setName("points");
  checks.Equal("points alone", ReadGrids(checks, "points alone", { points }), std::size_t(1));
  checks.Equal(
    "points beside", ReadGrids(checks, "points beside", { points, ball("a") }), std::size_t(0));
  auto frustum = ball("frustum");
  frustum->setTransform(
    std::make_shared<openvdb::math::Transform>(std::make_shared<openvdb::math::NonlinearFrustumMap>(
      openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(10)), 0.5, 2.0)));
  checks.Equal("frustum", ReadGrids(checks, "frustum", { frustum }), std::size_t(1));
  auto sheared = ball("sheared");
  sheared->transform().preShear(0.5, openvdb::math::X_AXIS, openvdb::math::Y_AXIS);
  checks.Equal("sheared", ReadGrids(checks, "sheared", { sheared }), std::size_t(1));

  // Foreign files have no extent but the bounds of what is active; twins share a tree and a name.
  const auto first = ball("a");
  const auto twin = MakeFloatGrid();
  twin->setTree(first->treePtr());
  twin->setName("a");
  const auto half = ball("half");
  half->setSaveFloatAsHalf(true);
  const openvdb::GridCPtrVec grids = { first, twin, half, ball("a") };
  checks.Equal("several", ReadGrids(checks, "several", grids), std::size_t(0));
  std::ofstream(PathOf("stream.vdb"), std::ios::binary).close();
  {
    std::ofstream stream(PathOf("stream.vdb"), std::ios::binary);
    openvdb::io::Stream(stream).write(grids);
  }
  for (const char* file : { "grids.vdb", "stream.vdb" })
  {
    const std::string title = file;
    const Image image = Read(checks, title, PathOf(file));
    const std::array<int, 6> extent = { -3, 20, 2, 9, 100, 117 };
    checks.Check(title + ": bounds", std::equal(extent.begin(), extent.end(), image->GetExtent()));
    checks.Equal(title + ": arrays", image->GetPointData()->GetNumberOfArrays(), 4);
    for (const char* name : { "a[0]", "a[1]", "half", "a[2]" })
    {
      vtkDataArray* array = image->GetPointData()->GetArray(name);
      checks.Check(
        title + ": " + name, array && array->GetRange()[0] == 4.0 && array->GetRange()[1] == 4.0);
    }
  }
  const std::string stream = ReadBytes(PathOf("stream.vdb"));
  for (std::size_t length = 0; length < stream.size(); length += 1 + length / 8)
  {
    const std::string title = "first " + std::to_string(length) + " bytes of a stream";
    checks.Equal(title, ReadBadFile(checks, title, stream.substr(0, length)), std::size_t(1));
  }

  vtkNew<Reader> reader;
  VoxelTestObserver observer(reader);
  reader->Update();
  reader->SetFileName(PathOf("missing.vdb").c_str());
  reader->Update();
  reader->SetFileName(PathOf("grids.vdb").c_str());
  reader->SetGridName("b");
  reader->Update();
  checks.Equal("no name, no file, no such grid: errors", observer.Errors.size(), std::size_t(3));
  checks.Check("a vdb file", Reader::CanReadFile(PathOf("grids.vdb").c_str()));
  checks.Check("no vdb file", !Reader::CanReadFile(PathOf("missing.vdb").c_str()));
}
}

int TestVDBVoxels(int argc, char* argv[])
{
  UseFolder("TestVDBVoxels", argc, argv);
  openvdb::initialize();
  VoxelTestChecks checks;
  TestBits(checks);
  TestSlicemaps(checks);
  TestArrays(checks);
  TestChoices(checks);
  TestLists(checks);
  TestLevelSet(checks);
  TestRefusals(checks);
  TestFullDisk(checks);
  TestOtherGrids(checks);
  TestBadFiles(checks);
  TestLengths(checks);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
