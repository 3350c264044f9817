/**
 * @file   VoxelTetraTests.h
 * @brief  What the tests of vtkTetraCoveringVoxelizer share.
 */
#ifndef VoxelTetraTests_h
#define VoxelTetraTests_h

#include "VoxelReference.h"
#include "VoxelTestMeshes.h"

#include <vtkSmartPointer.h>
#include <vtkTetraCoveringVoxelizer.h>

#include <functional>
#include <string>
#include <vector>

class vtkImageData;

namespace VoxelTetraTests
{

using Voxelizer = vtkTetraCoveringVoxelizer;

/// A backend, and how it draws if it is Raster.
struct Way
{
  int Backend;
  int Method = Voxelizer::RASTER_COLUMNS;
};

constexpr Way AllWays[] = { { vtkVoxelizer::BACKEND_COMPUTE }, { vtkVoxelizer::BACKEND_RASTER },
  { vtkVoxelizer::BACKEND_RASTER, Voxelizer::RASTER_LAYERS } };

/// A voxelizer of the mesh on the grid, not run yet.
vtkSmartPointer<Voxelizer> MakeVoxelizer(vtkPolyData* mesh, vtkImageData* grid, const Way& way);
vtkSmartPointer<Voxelizer> MakeVoxelizer(vtkPolyData* mesh, vtkImageData* grid, int backend);

/// Backend and method of a voxelizer, for messages.
std::string NameOf(Voxelizer* voxelizer);

/// Kinds of variants, all with a name.
struct Settings
{
  std::string Name;
  std::function<void(Voxelizer*)> Apply;
};
std::vector<Settings> AllSettings();

/// A cube of voxels around the mesh, which spans `n` of them along its longest side.
vtkSmartPointer<vtkImageData> MakeCube(vtkPolyData* mesh, int n, int margin);

/// Both, or Raster alone where OpenGL has no compute shaders.
std::vector<int> AvailableBackends();

/// The solid by its definition: the tetrahedra of all triangles of the fans, flipped one by one.
VoxelReference::Volume XorOfTetrahedra(vtkPolyData* mesh, const VoxelReference::Grid& grid);

/// The solid as vtkSlicemapSolidVoxelizer has it, by its Compute backend.
VoxelReference::Volume Solid(vtkPolyData* mesh, vtkImageData* grid);

/// Runs and compares; what differs must lie on the surface within the tolerance of the backend and
/// the method.
bool CheckSame(const std::string& name, Voxelizer* voxelizer,
  const VoxelReference::Volume& expected, vtkPolyData* mesh);

}

#endif
