// Times .vdb files of solids, mesh in memory to file on the disk, uncompressed. Arguments of a row:
// voxels along the longest side of the mesh; "voxels" are the active ones of the file, "filled"
// those that the voxelizer has counted on the GPU.
//
//   Mask/MESH, Bool/MESH, LevelSet/MESH  vtkSlicemapSolidVoxelizer and vtkVDBVoxelWriter, from bits
//   Write/MESH                           the writer alone, of bits on the GPU, as a mask
//   OpenVDB/MESH                         openvdb::tools::meshToVolume with a narrow band of three
//                                        voxels, its interior mask, and openvdb::io::File; the mesh
//                                        is in index coordinates before; "leaves" are those of its
//                                        tree and "our leaves" those of a Mask file, "only there"
//                                        and "only here" the voxels active in one of both

#include "OpenVDBMesh.h"
#include "VoxelBenchmarks.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSlicemapSolidVoxelizer.h>
#include <vtkVDBVoxelWriter.h>

#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/MeshToVolume.h>

#include <filesystem>
#include <string>
#include <vector>

using namespace VoxelBenchmarks;

namespace
{
std::string GetFileName()
{
  return (std::filesystem::temp_directory_path() / "BenchmarkVDB.vdb").string();
}

struct Solid
{
  vtkNew<vtkSlicemapSolidVoxelizer> Voxelizer;
  vtkNew<vtkVDBVoxelWriter> Writer;

  Solid(const Mesh& mesh, int resolution, int occupancy)
  {
    this->Voxelizer->SetInputData(mesh);
    this->Voxelizer->SetResolution(resolution);
    this->Voxelizer->HostOutputOff();
    this->Writer->SetInputConnection(this->Voxelizer->GetOutputPort());
    this->Writer->SetFileName(GetFileName().c_str());
    this->Writer->SetOccupancyGrid(occupancy);
    this->Writer->SetCompressionToNone();
  }
};

template <int Occupancy, bool WriterAlone = false>
void Voxelization(benchmark::State& state, const Mesh& mesh)
{
  const Solid solid(mesh, static_cast<int>(state.range(0)), Occupancy);
  vtkSlicemapSolidVoxelizer* voxelizer = solid.Voxelizer;
  vtkVDBVoxelWriter* writer = solid.Writer;
  voxelizer->Update();
  Finish();
  for (auto _ : state)
  {
    if (!WriterAlone)
    {
      Touch(mesh);
    }
    writer->Write();
  }
  state.counters["voxels"] = double(writer->GetNumberOfActiveVoxels());
  state.counters["filled"] = double(voxelizer->GetNumberOfFilledVoxels());
  std::filesystem::remove(GetFileName());
}

template <typename Tree, typename Other>
double CountBeyond(const Tree& tree, const Other& other)
{
  openvdb::BoolTree beyond(tree, false, openvdb::TopologyCopy());
  beyond.topologyDifference(other);
  return double(beyond.activeVoxelCount());
}

/// Of OpenVDB's tree and of the one in a file of ours.
void CompareTopologies(benchmark::State& state, const Mesh& mesh, const openvdb::BoolTree& theirs)
{
  const Solid solid(mesh, static_cast<int>(state.range(0)), vtkVDBVoxelWriter::GRID_MASK);
  solid.Writer->Write();
  openvdb::io::File file(GetFileName());
  file.open();
  const auto grid = openvdb::gridPtrCast<openvdb::MaskGrid>(file.readGrid("Occupancy"));
  file.close();
  state.counters["only there"] = CountBeyond(theirs, grid->tree());
  state.counters["only here"] = CountBeyond(grid->tree(), theirs);
  state.counters["leaves"] = double(theirs.leafCount());
  state.counters["our leaves"] = double(grid->tree().leafCount());
}

void OpenVDB(benchmark::State& state, const Mesh& mesh)
{
  openvdb::initialize();
  const OpenVDBMesh triangles(mesh, static_cast<int>(state.range(0)));
  const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
  constexpr float band = 3.0F;
  openvdb::BoolGrid::Ptr mask;
  for (auto _ : state)
  {
    const auto levelSet =
      openvdb::tools::meshToVolume<openvdb::FloatGrid>(triangles, *transform, band, band);
    mask = openvdb::tools::sdfInteriorMask(*levelSet);
    openvdb::io::File file(GetFileName());
    file.setCompression(openvdb::io::COMPRESS_ACTIVE_MASK);
    file.write(openvdb::GridPtrVec{ mask });
  }
  state.counters["voxels"] = double(mask->activeVoxelCount());
  CompareTopologies(state, mesh, mask->tree());
  std::filesystem::remove(GetFileName());
}
}

int main(int argc, char* argv[])
{
  using Writer = vtkVDBVoxelWriter;
  const std::vector<int> sizes = { 256, 512, 1024 };
  for (const auto& [name, mesh] : MeshesOfFiles())
  {
    AddRows("Mask/" + name, Voxelization<Writer::GRID_MASK>, mesh, sizes, 1);
    AddRows("Bool/" + name, Voxelization<Writer::GRID_BOOL>, mesh, sizes, 1);
    AddRows("LevelSet/" + name, Voxelization<Writer::GRID_LEVEL_SET>, mesh, sizes, 1);
    AddRows("Write/" + name, Voxelization<Writer::GRID_MASK, true>, mesh, sizes, 1);
    AddRows("OpenVDB/" + name, OpenVDB, mesh, sizes, 1);
  }
  return RunRows(argc, argv);
}
