// Proves that a scene of glyphs, drawn as instances by the GPU in an assembly that is turned, is
// voxelized: by the volume of its cubes, and by its picture.

#include "VoxelDepthProps.h"

#include <vtkAssembly.h>
#include <vtkCubeSource.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkRegressionTestImage.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>

#include <cstdlib>
#include <iostream>

using namespace VoxelDepthProps;

namespace
{
using Prop = vtkSmartPointer<vtkProp>;

/// Cubes on the points of a sphere, in an assembly that is turned.
Prop MakeGlyphs()
{
  vtkNew<vtkSphereSource> points;
  points->SetThetaResolution(7);
  points->SetPhiResolution(6);
  vtkNew<vtkCubeSource> cube;
  cube->SetXLength(0.17);
  cube->SetYLength(0.12);
  cube->SetZLength(0.25);
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputConnection(points->GetOutputPort());
  mapper->SetSourceConnection(cube->GetOutputPort());
  mapper->ScalingOff();
  auto assembly = vtkSmartPointer<vtkAssembly>::New();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  assembly->AddPart(actor);
  assembly->RotateX(20);
  return assembly;
}
}

int TestDepthGlyphs(int argc, char* argv[])
{
  const auto voxelizer = MakeVoxelizer(MakeGlyphs());
  voxelizer->Update();
  // 30 cubes, some of which overlap near the poles, and hide little from the axes.
  const double* spacing = voxelizer->GetOutput()->GetSpacing();
  const double cubes = double(voxelizer->GetNumberOfFilledVoxels()) * spacing[0] * spacing[1] *
    spacing[2] / (0.17 * 0.12 * 0.25);
  std::cout << "the voxels fill " << cubes << " cubes\n";
  bool ok = cubes > 20.0 && cubes < 40.0;
  const auto window = Show(voxelizer);
  ok = window && vtkRegressionTestImage(window) == vtkTesting::PASSED && ok;
  return ok ? EXIT_SUCCESS : EXIT_FAILURE;
}
