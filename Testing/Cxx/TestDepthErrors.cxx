// Proves that bad input of vtkDepthBufferVoxelizer gives exactly one error that says what is wrong
// and an empty output, and that the same filter works afterwards; and that props are left as they
// were.

#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkActor.h>
#include <vtkAssembly.h>
#include <vtkCamera.h>
#include <vtkDataArray.h>
#include <vtkDepthBufferVoxelizer.h>
#include <vtkImageData.h>
#include <vtkLightCollection.h>
#include <vtkNew.h>
#include <vtkOpenGLGPUVolumeRayCastMapper.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolume.h>
#include <vtkVoxelContext.h>

#include <cstdlib>
#include <functional>
#include <limits>
#include <string>

using namespace VoxelTestMeshes;

namespace
{
using Voxelizer = vtkDepthBufferVoxelizer;
using Change = std::function<void(Voxelizer*)>;

Mesh GoodMesh()
{
  return Box({ 0, 0, 0 }, { 1, 1, 1 });
}

vtkSmartPointer<vtkActor> GoodActor()
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(GoodMesh());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

void Reset(Voxelizer* voxelizer)
{
  voxelizer->RemoveAllInputConnections(0);
  voxelizer->RemoveAllProps();
  voxelizer->RemoveAllViews();
  voxelizer->SetRenderer(nullptr);
  voxelizer->SetInputData(GoodMesh());
  voxelizer->SetResolution(8);
  voxelizer->SetAxes(true, true, true);
  voxelizer->SetOutputModeToSolid();
  voxelizer->SetConnectivity(4);
  voxelizer->HostOutputOn();
  voxelizer->SetModelBounds(0, -1, 0, -1, 0, -1);
  voxelizer->SetOutputWholeExtent(0, -1, 0, -1, 0, -1);
}

void TestError(
  VoxelTestChecks& checks, const std::string& name, const Change& spoil, const std::string& says)
{
  vtkNew<Voxelizer> voxelizer;
  Reset(voxelizer);
  spoil(voxelizer);
  {
    VoxelTestObserver observer(voxelizer);
    voxelizer->Update();
    observer.ExpectOneError(checks, name, says);
    checks.Equal(name + ": points of the output",
      voxelizer->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
    checks.Equal(name + ": filled voxels", voxelizer->GetNumberOfFilledVoxels(), vtkIdType(-1));
  }
  Reset(voxelizer);
  voxelizer->Update();
  checks.Equal(name + ": voxels afterwards", voxelizer->GetNumberOfFilledVoxels(), 512);
}

/// An actor that a window of its own shows is voxelized, and drawn there again as before.
void TestSharedActor(VoxelTestChecks& checks, bool inItsWindow)
{
  const std::string name = inItsWindow ? "in the actor's window" : "in another window";
  const auto window =
    vtkSmartPointer<vtkRenderWindow>::Take(vtkVoxelContext::NewHeadlessRenderWindow());
  const auto actor = GoodActor();
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  window->SetMultiSamples(0);
  window->SetSize(64, 64);
  window->AddRenderer(renderer);
  const auto picture = [&]
  {
    window->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    window->GetPixelData(0, 0, 63, 63, 0, pixels);
    return std::string(
      reinterpret_cast<const char*>(pixels->GetPointer(0)), pixels->GetNumberOfValues());
  };
  const std::string before = picture();
  vtkNew<Voxelizer> voxelizer;
  voxelizer->SetResolution(8);
  if (inItsWindow)
  {
    voxelizer->SetRenderWindow(window);
    voxelizer->SetRenderer(renderer);
  }
  else
  {
    voxelizer->AddProp(actor);
  }
  const vtkMTimeType time = actor->GetMTime();
  const vtkMTimeType timeOfCamera = renderer->GetActiveCamera()->GetMTime();
  const vtkMTimeType timeOfLight = renderer->GetLights()->GetMTime();
  for (int run = 0; run < 2; ++run)
  {
    voxelizer->SetPadding(run);
    voxelizer->Update();
    checks.Equal(name + ": voxels", voxelizer->GetNumberOfFilledVoxels(), 512);
    checks.Check(name + ": the picture is as before", picture() == before);
  }
  checks.Equal(name + ": the actor's time", actor->GetMTime(), time);
  checks.Equal(name + ": the camera's time", renderer->GetActiveCamera()->GetMTime(), timeOfCamera);
  checks.Equal(name + ": the lights' time", renderer->GetLights()->GetMTime(), timeOfLight);
  checks.Equal(name + ": size of the window", window->GetSize()[0], 64);
  checks.Equal(name + ": renderers of the window", window->GetRenderers()->GetNumberOfItems(), 1);
}
}

int TestDepthErrors(int, char*[])
{
  VoxelTestChecks checks;
  const auto fixBounds = [](Voxelizer* v) { v->SetModelBounds(0, 1, 0, 1, 0, 1); };
  for (const bool boundsFixed : { false, true })
  {
    const auto run = [&](const std::string& name, const Change& spoil, const std::string& says)
    {
      TestError(
        checks, name + (boundsFixed ? ", bounds given" : ""),
        [&](Voxelizer* v)
        {
          spoil(v);
          if (boundsFixed)
          {
            fixBounds(v);
          }
        },
        says);
    };
    run(
      "nothing", [](Voxelizer* v) { v->SetInputData(nullptr); },
      boundsFixed ? "nothing to voxelize" : "no points");
    run(
      "invisible prop",
      [](Voxelizer* v)
      {
        const auto actor = GoodActor();
        actor->VisibilityOff();
        v->AddProp(actor);
      },
      "invisible");
    run(
      "prop without a mapper", [](Voxelizer* v) { v->AddProp(vtkSmartPointer<vtkActor>::New()); },
      "no bounds");
    run(
      "empty assembly", [](Voxelizer* v) { v->AddProp(vtkSmartPointer<vtkAssembly>::New()); },
      "no bounds");
    run(
      "translucent prop",
      [](Voxelizer* v)
      {
        const auto actor = GoodActor();
        actor->GetProperty()->SetOpacity(0.5);
        v->AddProp(actor);
      },
      "translucent");
    run(
      "translucent part of an assembly",
      [](Voxelizer* v)
      {
        vtkNew<vtkAssembly> assembly;
        const auto actor = GoodActor();
        actor->GetProperty()->SetOpacity(0.5);
        assembly->AddPart(actor);
        assembly->AddPart(GoodActor());
        v->AddProp(assembly);
      },
      "translucent");
    run(
      "volume without a surface",
      [](Voxelizer* v)
      {
        vtkNew<vtkImageData> image;
        image->SetDimensions(4, 4, 4);
        image->AllocateScalars(VTK_FLOAT, 1);
        image->GetPointData()->GetScalars()->Fill(0.0);
        vtkNew<vtkOpenGLGPUVolumeRayCastMapper> mapper;
        mapper->SetInputData(image);
        vtkNew<vtkVolume> volume;
        volume->SetMapper(mapper);
        v->AddProp(volume);
      },
      "not drawn as surfaces");
    {
      const auto window =
        vtkSmartPointer<vtkRenderWindow>::Take(vtkVoxelContext::NewHeadlessRenderWindow());
      vtkNew<vtkRenderer> renderer;
      renderer->AddActor(GoodActor());
      window->AddRenderer(renderer);
      run(
        "renderer of another window", [&](Voxelizer* v) { v->SetRenderer(renderer); },
        "another window");
    }
    run(
      "no axis", [](Voxelizer* v) { v->SetAxes(false, false, false); }, "no axis");
    run(
      "connectivity", [](Voxelizer* v) { v->SetConnectivity(6); }, "4 or 8");
    run(
      "view to nowhere", [](Voxelizer* v) { v->AddView(0, 0, 0); }, "points nowhere");
    run(
      "density on the GPU",
      [](Voxelizer* v)
      {
        v->SetOutputModeToDensity();
        v->HostOutputOff();
      },
      "HostOutput");
  }
  TestError(
    checks, "empty mesh",
    [&](Voxelizer* v)
    {
      v->SetInputData(Mesh::New());
      fixBounds(v);
    },
    "no polygons");
  TestError(
    checks, "NaN",
    [&](Voxelizer* v)
    {
      Mesh mesh = WithDoublePrecision(GoodMesh());
      mesh->GetPoints()->SetPoint(3, std::numeric_limits<double>::quiet_NaN(), 0, 0);
      v->SetInputData(mesh);
      fixBounds(v);
    },
    "NaN");
  TestError(
    checks, "buffers beyond OpenGL",
    [](Voxelizer* v)
    {
      v->SetOutputWholeExtent(0, 99999, 0, 1, 0, 1);
      v->HostOutputOff();
    },
    "too large");
  {
    vtkNew<Voxelizer> voxelizer;
    VoxelTestObserver observer(voxelizer);
    voxelizer->AddProp(nullptr);
    checks.Equal("errors of a null prop", observer.Errors.size(), std::size_t(1));
  }
  TestSharedActor(checks, false);
  TestSharedActor(checks, true);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
