// Proves by its picture that the voxelized bunny looks like a bunny, drawn off-screen without a
// display.

#include "VoxelTestMeshes.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkDiscreteFlyingEdges3D.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRegressionTestImage.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSlicemapSolidVoxelizer.h>
#include <vtkSmartPointer.h>
#include <vtkVoxelContext.h>

#include <cstdlib>
#include <iostream>

int TestSolidPicture(int argc, char* argv[])
{
  const auto bunny = VoxelTestMeshes::ReadPLY("bunny_7k.ply", argc, argv);
  const auto window =
    vtkSmartPointer<vtkRenderWindow>::Take(vtkVoxelContext::NewHeadlessRenderWindow());
  if (!bunny || !window)
  {
    std::cerr << "bunny_7k.ply or OpenGL is missing\n";
    return EXIT_FAILURE;
  }
  vtkNew<vtkSlicemapSolidVoxelizer> voxelizer;
  voxelizer->SetInputData(bunny);
  voxelizer->SetResolution(64);
  voxelizer->SetPadding(1);
  vtkNew<vtkDiscreteFlyingEdges3D> surface;
  surface->SetInputConnection(voxelizer->GetOutputPort());
  surface->SetValue(0, 1);
  surface->ComputeNormalsOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(surface->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->SetColor(0.3, 0.65, 0.8);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  renderer->AddActor(actor);
  window->SetMultiSamples(0);
  window->SetSize(300, 300);
  window->AddRenderer(renderer);
  renderer->GetActiveCamera()->SetPosition(-1, 0.6, 2);
  renderer->ResetCamera();
  window->Render();
  return vtkRegressionTestImage(window) == vtkTesting::PASSED ? EXIT_SUCCESS : EXIT_FAILURE;
}
