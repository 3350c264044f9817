/**
 * @file   VoxelDepthProps.h
 * @brief  What the tests share that voxelize props from depth buffers.
 */
#ifndef VoxelDepthProps_h
#define VoxelDepthProps_h

#include "VoxelReference.h"

#include <vtkActor.h>
#include <vtkDepthBufferVoxelizer.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <functional>
#include <string>

class vtkImageData;

namespace VoxelDepthProps
{

/// An actor with this mapper.
template <typename Mapper>
vtkSmartPointer<vtkActor> MakeActor(Mapper* mapper)
{
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

/// A voxelizer of the prop with 60 voxels along its longest side, and one more on each side.
vtkSmartPointer<vtkDepthBufferVoxelizer> MakeVoxelizer(vtkProp* prop);

/// A window that shows the voxels, ready to compare; null without OpenGL.
vtkSmartPointer<vtkRenderWindow> Show(vtkDepthBufferVoxelizer* voxelizer);

/// All voxels but those within half a voxel of the surface, to which the distance is, positive
/// outside, are as they should be. Otherwise prints one line that starts with `name`.
bool CheckSolid(const std::string& name, vtkImageData* image,
  const std::function<double(const VoxelReference::Vector&)>& distance);

}

#endif
