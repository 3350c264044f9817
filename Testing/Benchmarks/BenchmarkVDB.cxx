// Times .vdb files of solids, mesh in memory to file on the disk, uncompressed. Arguments of a row:
// voxels along the longest side of the mesh; "voxels" are the active ones of the file, "filled"
// those that the voxelizer has counted on the GPU.
//
//   Mask/MESH, Bool/MESH, LevelSet/MESH  vtkSlicemapSolidVoxelizer and vtkVDBVoxelWriter, from bits
//   Write/MESH                           the writer alone, of bits on the GPU, as a mask
//   OpenVDB/MESH                         openvdb::tools::meshToVolume with a narrow band of three
//                                        voxels, its interior mask, and openvdb::io::File; the mesh
//                                        is in index coordinates before

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

template <int Occupancy, bool WriterAlone = false>
void Voxelization(benchmark::State& state, const Mesh& mesh)
{
  vtkNew<vtkSlicemapSolidVoxelizer> voxelizer;
  voxelizer->SetInputData(mesh);
  voxelizer->SetResolution(static_cast<int>(state.range(0)));
  voxelizer->HostOutputOff();
  vtkNew<vtkVDBVoxelWriter> writer;
  writer->SetInputConnection(voxelizer->GetOutputPort());
  writer->SetFileName(GetFileName().c_str());
  writer->SetOccupancyGrid(Occupancy);
  writer->SetCompressionToNone();
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

void OpenVDB(benchmark::State& state, const Mesh& mesh)
{
  openvdb::initialize();
  const OpenVDBMesh triangles(mesh, static_cast<int>(state.range(0)));
  const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
  constexpr float band = 3.0F;
  openvdb::Index64 voxels = 0;
  for (auto _ : state)
  {
    const auto levelSet =
      openvdb::tools::meshToVolume<openvdb::FloatGrid>(triangles, *transform, band, band);
    const openvdb::GridBase::Ptr mask = openvdb::tools::sdfInteriorMask(*levelSet);
    openvdb::io::File file(GetFileName());
    file.setCompression(openvdb::io::COMPRESS_ACTIVE_MASK);
    file.write(openvdb::GridPtrVec{ mask });
    voxels = mask->activeVoxelCount();
  }
  state.counters["voxels"] = double(voxels);
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
