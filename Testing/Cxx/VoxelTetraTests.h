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

#include <string>
#include <vector>

class vtkImageData;

namespace VoxelTetraTests
{

using Voxelizer = vtkTetraCoveringVoxelizer;

/// A voxelizer of the mesh on the grid, not run yet.
vtkSmartPointer<Voxelizer> MakeVoxelizer(vtkPolyData* mesh, vtkImageData* grid, int backend);

/// Both, or Raster alone where OpenGL has no compute shaders.
std::vector<int> AvailableBackends();

/// The solid by its definition: the tetrahedra of all triangles of the fans, flipped one by one.
VoxelReference::Volume XorOfTetrahedra(vtkPolyData* mesh, const VoxelReference::Grid& grid);

/// The solid as vtkSlicemapSolidVoxelizer has it, by its Compute backend.
VoxelReference::Volume Solid(vtkPolyData* mesh, vtkImageData* grid);

/// Runs and compares; what differs must lie on the surface within the tolerance of the backend.
bool CheckSame(const std::string& name, Voxelizer* voxelizer,
  const VoxelReference::Volume& expected, vtkPolyData* mesh);

}

#endif
