// Proves that an iso-surface of a volume, which a mapper draws by ray casting, is voxelized: all
// voxels but those within half a voxel; and by its picture.

#include "VoxelDepthProps.h"

#include <vtkContourValues.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkOpenGLGPUVolumeRayCastMapper.h>
#include <vtkRegressionTestImage.h>
#include <vtkSampleFunction.h>
#include <vtkSmartPointer.h>
#include <vtkSphere.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <cmath>
#include <cstdlib>

using namespace VoxelDepthProps;
using VoxelReference::Vector;

namespace
{
using Prop = vtkSmartPointer<vtkProp>;

constexpr double IsoRadius = 0.4;

/// The distance from the origin, moved by the volume's position.
Prop MakeVolume()
{
  vtkNew<vtkSphere> distance;
  distance->SetRadius(0.0);
  vtkNew<vtkSampleFunction> sample;
  sample->SetImplicitFunction(distance);
  sample->SetSampleDimensions(60, 60, 60);
  sample->SetModelBounds(-0.5, 0.5, -0.5, 0.5, -0.5, 0.5);
  sample->ComputeNormalsOff();
  vtkNew<vtkOpenGLGPUVolumeRayCastMapper> mapper;
  mapper->SetInputConnection(sample->GetOutputPort());
  mapper->SetBlendModeToIsoSurface();
  auto volume = vtkSmartPointer<vtkVolume>::New();
  volume->SetMapper(mapper);
  volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, IsoRadius * IsoRadius);
  volume->SetPosition(1, 2, 3);
  return volume;
}

double Length(double x, double y, double z)
{
  return std::sqrt(x * x + y * y + z * z);
}
}

int TestDepthVolume(int argc, char* argv[])
{
  const auto voxelizer = MakeVoxelizer(MakeVolume());
  voxelizer->Update();
  bool ok = CheckSolid("iso-surface", voxelizer->GetOutput(),
    [](const Vector& p) { return Length(p[0] - 1, p[1] - 2, p[2] - 3) - IsoRadius; });
  const auto window = Show(voxelizer);
  ok = window && vtkRegressionTestImage(window) == vtkTesting::PASSED && ok;
  return ok ? EXIT_SUCCESS : EXIT_FAILURE;
}
