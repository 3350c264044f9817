/**
 * @file   VoxelSolidTests.h
 * @brief  What the tests of vtkSlicemapSolidVoxelizer share: runs on a grid, and checks of the
 * result.
 */
#ifndef VoxelSolidTests_h
#define VoxelSolidTests_h

#include "VoxelReference.h"

#include <vtkSlicemapSolidVoxelizer.h>
#include <vtkSmartPointer.h>

#include <array>
#include <string>
#include <vector>

class vtkImageData;
class vtkPolyData;

namespace VoxelSolidTests
{

/// Voxels that differ from the reference must be this near to the surface, in voxels.
constexpr double ComputeTolerance = 1e-4;
constexpr double RasterTolerance = 1.0 / 64.0;

constexpr std::array<int, 2> Backends = { vtkVoxelizer::BACKEND_COMPUTE,
  vtkVoxelizer::BACKEND_RASTER };

double ToleranceOf(int backend);
std::string NameOf(int backend);

/// An image without scalars that only tells a grid.
vtkSmartPointer<vtkImageData> MakeGrid(const std::array<int, 6>& extent,
  const VoxelReference::Vector& origin, const VoxelReference::Vector& spacing,
  const std::array<double, 9>& direction = { 1, 0, 0, 0, 1, 0, 0, 0, 1 });

/// n voxels along the longest side of the mesh and two of margin on all sides; the middle is off
/// the voxels' centres, so that ties are rare.
vtkSmartPointer<vtkImageData> MakeGridAround(vtkPolyData* mesh, int n);

/// A voxelizer of the mesh on the grid, not run yet.
vtkSmartPointer<vtkSlicemapSolidVoxelizer> MakeVoxelizer(
  vtkPolyData* mesh, vtkImageData* grid, int backend, int axis);

/// CheckExact for the closed meshes of the large data, at 64, 128 and 256 voxels, as they are and
/// rotated. Returns false, too, when one is missing.
bool CheckLargeMeshes(int backend, int argc, char* argv[]);

/// Runs each backend along each axis on a closed mesh. All voxels that differ from the reference
/// lie within the backend's tolerance of the surface, and no column leaks. Prints a line and
/// returns false when not.
bool CheckExact(const std::string& name, vtkPolyData* mesh, vtkImageData* grid,
  const std::vector<int>& backends = { Backends[0], Backends[1] },
  int fillRule = vtkSlicemapSolidVoxelizer::FILL_RULE_PARITY);

/// The modes over-conservative, under-conservative and boundary of each backend against brute
/// force.
bool CheckConservative(const std::string& name, vtkPolyData* mesh, vtkImageData* image);

/// Each of some random parts of the grid, asked for by update extent, equals that part of the
/// whole.
bool CheckParts(const std::string& name, vtkVoxelizer* voxelizer, int seed, int count);

}

#endif
