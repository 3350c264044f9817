/**
 * @file   VoxelTestPictures.h
 * @brief  How the tests that compare pictures draw voxels.
 */
#ifndef VoxelTestPictures_h
#define VoxelTestPictures_h

#include <vtkSmartPointer.h>

class vtkActor;
class vtkAlgorithmOutput;

namespace VoxelTestPictures
{

/// The surface between the voxels of an image that are 1 and the others, in flat blue.
vtkSmartPointer<vtkActor> MakeSurface(vtkAlgorithmOutput* voxels);

}

#endif
