/**
 * @file   VoxelBenchmarks.h
 * @brief  What the benchmarks share: meshes, grids, and rows of a mesh and a size.
 */
#ifndef VoxelBenchmarks_h
#define VoxelBenchmarks_h

#include "VoxelTestMeshes.h"

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <benchmark/benchmark.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace VoxelBenchmarks
{

using VoxelTestMeshes::Mesh;
using MeshTable = std::map<std::string, Mesh>;

/// Bunny, dragon, and the dragon with 1.6 M triangles, if the build knows where the large data are;
/// else the bundled bunny.
MeshTable MeshesOfFiles();

/// Those, and meshes with large triangles: one that spans the grid, and triangles of all sizes.
MeshTable SurfaceMeshes();

/// So that filters run again, as on a new mesh.
void Touch(vtkPolyData* mesh);

/// Waits for the GPU.
void Finish();

/// The grid of the voxelizers with so many voxels along the longest side of the mesh; no scalars.
vtkSmartPointer<vtkImageData> MakeGrid(vtkPolyData* mesh, int resolution);

/// Rows NAME/SIZE for the sizes, in real time. Iterations: 0, several, and fewer from 512 on.
void AddRows(const std::string& name, const std::function<void(benchmark::State&)>& function,
  const std::vector<int>& sizes, int iterations = 0, int repetitions = 5);

/// Rows NAME/SIZE of function(state, mesh).
template <typename Function>
void AddRows(const std::string& name, Function function, const Mesh& mesh,
  const std::vector<int>& sizes, int iterations = 0, int repetitions = 5)
{
  AddRows(
    name, [mesh, function](benchmark::State& state) { function(state, mesh); }, sizes, iterations,
    repetitions);
}

/// Runs the rows; what main returns.
int RunRows(int argc, char* argv[]);

}

#endif
