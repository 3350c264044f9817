// Times files that vtkVoxelSlabWriter makes of solids slab by slab within 1 GiB, mesh in memory to
// file on the disk, and tells what memory the process had at its peak. Arguments of a row: voxels
// along each side of the grid, the longest of which is that of the mesh.
//
//   VDB/MESH, VTI/MESH, Binvox/MESH  vtkSlicemapSolidVoxelizer and vtkVoxelSlabWriter; .vdb as a
//   mask
//
// "peak_MiB" is the peak of the resident memory during the row, of the whole process (Linux);
// "slabs" is their number, "filled" the sum of their set voxels, and "active" those that OpenVDB
// counts in the .vdb file; "MiB" is the size of the file.

#include "VoxelBenchmarks.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSlicemapSolidVoxelizer.h>
#include <vtkVoxelSlabWriter.h>

#include <openvdb/openvdb.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using namespace VoxelBenchmarks;

namespace
{
constexpr double Mebibyte = 1048576.0;
constexpr vtkTypeInt64 Limit = vtkTypeInt64(1) << 30;

/// From now on the peak is one of what comes.
void ResetPeak()
{
  std::ofstream("/proc/self/clear_refs") << "5";
}

/// 0 where the system does not tell.
double GetPeak()
{
  std::ifstream status("/proc/self/status");
  double kibibytes = 0.0;
  for (std::string word; status >> word;)
  {
    if (word == "VmHWM:")
    {
      status >> kibibytes;
    }
  }
  return kibibytes / 1024.0;
}

double CountActive(const std::string& name)
{
  openvdb::io::File file(name);
  file.open();
  return double(file.readGrid("Occupancy")->activeVoxelCount());
}

void Slabs(benchmark::State& state, const Mesh& mesh, const std::string& extension)
{
  const std::string name =
    (std::filesystem::temp_directory_path() / ("BenchmarkSlabs" + extension)).string();
  vtkNew<vtkSlicemapSolidVoxelizer> voxelizer;
  voxelizer->SetInputData(mesh);
  const int n = static_cast<int>(state.range(0));
  voxelizer->SetSampleDimensions(n, n, n);
  voxelizer->HostOutputOff();
  vtkNew<vtkVoxelSlabWriter> writer;
  writer->SetInputConnection(voxelizer->GetOutputPort());
  writer->SetFileName(name.c_str());
  writer->SetMemoryLimit(Limit);
  writer->SetOccupancyGridToMask();
  ResetPeak();
  for (auto _ : state)
  {
    if (!writer->Write())
    {
      state.SkipWithError("the file could not be written");
      return;
    }
  }
  state.counters["peak_MiB"] = GetPeak();
  state.counters["slabs"] = double(writer->GetNumberOfSlabs());
  state.counters["filled"] = double(writer->GetNumberOfFilledVoxels());
  state.counters["MiB"] = double(std::filesystem::file_size(name)) / Mebibyte;
  if (extension == ".vdb")
  {
    state.counters["active"] = CountActive(name);
  }
  std::filesystem::remove(name);
}
}

int main(int argc, char* argv[])
{
  openvdb::initialize();
  for (const auto& [name, mesh] : MeshesOfFiles())
  {
    const auto add = [&, mesh = mesh](const std::string& title, const char* extension,
                       const std::vector<int>& sizes)
    {
      for (const int size : sizes)
      {
        benchmark::RegisterBenchmark((title + "/" + name).c_str(),
          [mesh, extension](benchmark::State& state) { Slabs(state, mesh, extension); })
          ->Arg(size)
          ->Iterations(1)
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
      }
    };
    add("VDB", ".vdb", { 1024, 2048, 4096 });
    add("VTI", ".vti", { 1024 });
    add("Binvox", ".binvox", { 1024 });
  }
  return RunRows(argc, argv);
}
