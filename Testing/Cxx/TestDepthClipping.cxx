// Proves that a mesh which the clipping plane of its mapper cuts is voxelized without what is cut
// off: all voxels but those within half a voxel; and by its picture.

#include "VoxelDepthProps.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPolyDataMapper.h>
#include <vtkRegressionTestImage.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

using namespace VoxelDepthProps;
using VoxelReference::Vector;

namespace
{
using Prop = vtkSmartPointer<vtkProp>;

constexpr double ClipX = 0.103;

Prop MakeClipped()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(200);
  sphere->SetPhiResolution(200);
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(ClipX, 0, 0);
  plane->SetNormal(-1, 0, 0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  mapper->AddClippingPlane(plane);
  return MakeActor(mapper.Get());
}

double Length(double x, double y, double z)
{
  return std::sqrt(x * x + y * y + z * z);
}
}

int TestDepthClipping(int argc, char* argv[])
{
  const auto voxelizer = MakeVoxelizer(MakeClipped());
  // It is open along x.
  voxelizer->SetAxes(false, true, true);
  voxelizer->Update();
  bool ok = CheckSolid("clipped sphere", voxelizer->GetOutput(),
    [](const Vector& p) { return std::max(Length(p[0], p[1], p[2]) - 0.5, p[0] - ClipX); });
  const auto window = Show(voxelizer);
  ok = window && vtkRegressionTestImage(window) == vtkTesting::PASSED && ok;
  return ok ? EXIT_SUCCESS : EXIT_FAILURE;
}
