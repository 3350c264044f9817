// Proves by its picture that the voxelized bunny looks like a bunny, drawn off-screen without a
// display.

#include "VoxelTestMeshes.h"
#include "VoxelTestPictures.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkNew.h>
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
  const auto actor = VoxelTestPictures::MakeSurface(voxelizer->GetOutputPort());
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
