// Proves that props of many kinds are voxelized: glyphs, the level set of an implicit function, a
// mesh that its mapper clips, and the iso-surface of a volume, each by its picture; and that the
// clipped sphere and the iso-surface are what they should be, voxel by voxel.

#include "VoxelComparison.h"
#include "VoxelReference.h"
#include "VoxelTestObservers.h"
#include "VoxelTestPictures.h"

#include <vtkActor.h>
#include <vtkAssembly.h>
#include <vtkCamera.h>
#include <vtkContourFilter.h>
#include <vtkContourValues.h>
#include <vtkCubeSource.h>
#include <vtkDepthBufferVoxelizer.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkOpenGLGPUVolumeRayCastMapper.h>
#include <vtkPlane.h>
#include <vtkPolyDataMapper.h>
#include <vtkQuadric.h>
#include <vtkRegressionTestImage.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSampleFunction.h>
#include <vtkSmartPointer.h>
#include <vtkSphere.h>
#include <vtkSphereSource.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>
#include <vtkVoxelContext.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>

using VoxelReference::Vector;
using VoxelReference::Volume;

namespace
{
using Prop = vtkSmartPointer<vtkProp>;

template <typename Mapper>
Prop MakeActor(Mapper* mapper)
{
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

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

/// All voxels but those within `tolerance` voxels of the surface, to which the distance is,
/// positive outside, are as they should be.
bool CheckSolid(const std::string& name, vtkImageData* image, double tolerance,
  const std::function<double(const Vector&)>& distance)
{
  const Volume voxels = VoxelReference::OccupancyOf(image);
  const double allowed = tolerance * image->GetSpacing()[0];
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < voxels.Grid.NumberOfVoxels(); ++i)
  {
    const double d = distance(voxels.Grid.ToWorld(voxels.Grid.VoxelAt(i)));
    wrong += std::abs(d) > allowed && (d < 0.0) != (voxels.Voxels[i] != 0) ? 1 : 0;
  }
  if (wrong > 0 || voxels.CountNonZero() == 0)
  {
    std::cerr << name << ": " << wrong << " voxels are wrong, " << voxels.CountNonZero()
              << " set\n";
  }
  return wrong == 0 && voxels.CountNonZero() > 0;
}

double Length(double x, double y, double z)
{
  return std::sqrt(x * x + y * y + z * z);
}
}

int TestDepthPicture(int argc, char* argv[])
{
  const auto window =
    vtkSmartPointer<vtkRenderWindow>::Take(vtkVoxelContext::NewHeadlessRenderWindow());
  if (!window)
  {
    std::cerr << "OpenGL is missing\n";
    return EXIT_FAILURE;
  }
  bool ok = true;
  std::array<vtkNew<vtkDepthBufferVoxelizer>, 4> voxelizers;
  const std::array<Prop, 4> props = { MakeGlyphs(), MakeImplicit(), MakeClipped(), MakeVolume() };
  for (std::size_t i = 0; i < props.size(); ++i)
  {
    voxelizers[i]->AddProp(props[i]);
    voxelizers[i]->SetResolution(60);
    voxelizers[i]->SetPadding(1);
    // The clipped sphere is open along x.
    voxelizers[i]->SetAxes(i != 2, true, true);
    voxelizers[i]->Update();
    const auto actor = VoxelTestPictures::MakeSurface(voxelizers[i]->GetOutputPort());
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(1, 1, 1);
    const double left = 0.5 * double(i % 2);
    const double low = 0.5 * double(i / 2);
    renderer->SetViewport(left, low, left + 0.5, low + 0.5);
    renderer->AddActor(actor);
    window->AddRenderer(renderer);
    renderer->GetActiveCamera()->SetPosition(2, 1, 1.5);
    renderer->ResetCamera();
  }
  ok &= CheckSolid("clipped sphere", voxelizers[2]->GetOutput(), 0.1,
    [](const Vector& p) { return std::max(Length(p[0], p[1], p[2]) - 0.5, p[0] - ClipX); });
  ok &= CheckSolid("iso-surface", voxelizers[3]->GetOutput(), 0.1,
    [](const Vector& p) { return Length(p[0] - 1, p[1] - 2, p[2] - 3) - IsoRadius; });
  window->SetMultiSamples(0);
  window->SetSize(400, 400);
  window->Render();
  ok &= vtkRegressionTestImage(window) == vtkTesting::PASSED;
  return ok ? EXIT_SUCCESS : EXIT_FAILURE;
}
