// Proves that a contour of an implicit function, which its mapper's pipeline makes, is voxelized:
// all voxels are on the right side of the function but those within half a voxel; and by its
// picture.

#include "VoxelDepthProps.h"

#include <vtkContourFilter.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkQuadric.h>
#include <vtkRegressionTestImage.h>
#include <vtkSampleFunction.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

using namespace VoxelDepthProps;
using VoxelReference::Vector;

namespace
{
using Prop = vtkSmartPointer<vtkProp>;

// An ellipsoid, 0.5 x^2 + y^2 + 0.2 z^2 + 0.1 y z + 0.2 y < 0.15.
double Value(const Vector& p)
{
  return 0.5 * p[0] * p[0] + p[1] * p[1] + 0.2 * p[2] * p[2] + 0.1 * p[1] * p[2] + 0.2 * p[1] -
    0.15;
}

double LengthOfGradient(const Vector& p)
{
  return std::hypot(p[0], 2.0 * p[1] + 0.1 * p[2] + 0.2, 0.4 * p[2] + 0.1 * p[1]);
}

Prop MakeImplicit()
{
  vtkNew<vtkQuadric> quadric;
  quadric->SetCoefficients(0.5, 1, 0.2, 0, 0.1, 0, 0, 0.2, 0, 0);
  vtkNew<vtkSampleFunction> sample;
  sample->SetImplicitFunction(quadric);
  sample->SetSampleDimensions(40, 40, 40);
  sample->ComputeNormalsOff();
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(sample->GetOutputPort());
  contour->SetValue(0, 0.15);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(contour->GetOutputPort());
  mapper->ScalarVisibilityOff();
  return MakeActor(mapper.Get());
}
}

int TestDepthImplicit(int argc, char* argv[])
{
  const auto voxelizer = MakeVoxelizer(MakeImplicit());
  voxelizer->Update();
  bool ok = CheckSolid("quadric", voxelizer->GetOutput(),
    [](const Vector& p) { return std::max(std::abs(p[2]) - 1.0, Value(p) / LengthOfGradient(p)); });
  const auto window = Show(voxelizer);
  ok = window && vtkRegressionTestImage(window) == vtkTesting::PASSED && ok;
  return ok ? EXIT_SUCCESS : EXIT_FAILURE;
}
