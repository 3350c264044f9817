#include "VoxelTestPictures.h"

#include <vtkActor.h>
#include <vtkAlgorithmOutput.h>
#include <vtkDiscreteFlyingEdges3D.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

namespace VoxelTestPictures
{

vtkSmartPointer<vtkActor> MakeSurface(vtkAlgorithmOutput* voxels)
{
  vtkNew<vtkDiscreteFlyingEdges3D> surface;
  surface->SetInputConnection(voxels);
  surface->SetValue(0, 1);
  surface->ComputeNormalsOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(surface->GetOutputPort());
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->SetColor(0.3, 0.65, 0.8);
  return actor;
}

}
