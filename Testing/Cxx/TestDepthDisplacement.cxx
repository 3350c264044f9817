// Proves that a mesh which the user's code in the vertex shader displaces is voxelized as
// displaced: all voxels but those within half a voxel; that it is drawn anew when a uniform of that
// code changes; and by its picture.

#include "VoxelDepthProps.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkRegressionTestImage.h>
#include <vtkShaderProperty.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkUniforms.h>

#include <cmath>
#include <cstdlib>

using namespace VoxelDepthProps;
using VoxelReference::Vector;

namespace
{
using Prop = vtkSmartPointer<vtkProp>;

constexpr double Strength = 0.8;

/// A sphere of radius 0.5 that bulges at its poles, by code in the vertex shader.
Prop MakeDisplaced()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(200);
  sphere->SetPhiResolution(200);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  auto actor = MakeActor(mapper.Get());
  vtkShaderProperty* shaders = actor->GetShaderProperty();
  shaders->AddVertexShaderReplacement("//VTK::PositionVC::Impl", true,
    "//VTK::PositionVC::Impl\n"
    "  float bulge = 1.0 + strength * 4.0 * vertexMC.z * vertexMC.z;\n"
    "  gl_Position = MCDCMatrix * vec4(bulge * vertexMC.xyz, 1.0);\n",
    false);
  shaders->GetVertexCustomUniforms()->SetUniformf("strength", Strength);
  return actor;
}

double Distance(const Vector& p, double strength)
{
  const double square = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
  const double bulge = square > 0.0 ? strength * p[2] * p[2] / square : 0.0;
  return std::sqrt(square) - 0.5 * (1.0 + bulge);
}
}

int TestDepthDisplacement(int argc, char* argv[])
{
  const Prop prop = MakeDisplaced();
  const auto voxelizer = MakeVoxelizer(prop);
  // The prop's bounds don't know of the displacement.
  voxelizer->SetModelBounds(-0.7, 0.7, -0.7, 0.7, -0.95, 0.95);
  voxelizer->Update();
  bool ok = CheckSolid("displaced sphere", voxelizer->GetOutput(),
    [](const Vector& p) { return Distance(p, Strength); });
  auto* uniforms = prop->GetShaderProperty()->GetVertexCustomUniforms();
  uniforms->SetUniformf("strength", -0.5F * Strength);
  voxelizer->Update();
  ok &= CheckSolid("sphere displaced otherwise", voxelizer->GetOutput(),
    [](const Vector& p) { return Distance(p, -0.5 * Strength); });
  uniforms->SetUniformf("strength", Strength);
  const auto window = Show(voxelizer);
  ok = window && vtkRegressionTestImage(window) == vtkTesting::PASSED && ok;
  return ok ? EXIT_SUCCESS : EXIT_FAILURE;
}
