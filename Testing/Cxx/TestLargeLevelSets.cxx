// Proves on the CT of a head that three level sets made in one pass, each opened and then closed on
// the GPU, are those of VTK's own filters bit for bit, that nothing is read back between, and by
// their picture that they are skin, bone and dense bone.

#include "VoxelComparison.h"
#include "VoxelFilterTests.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkDiscreteFlyingEdges3D.h>
#include <vtkImageDilateErode3D.h>
#include <vtkImageThreshold.h>
#include <vtkImageToSlicemap.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRegressionTestImage.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSlicemap.h>
#include <vtkVoxelContext.h>
#include <vtkVoxelMorphology.h>
#include <vtkXMLImageDataReader.h>

#include <array>
#include <cstdlib>
#include <iostream>

namespace
{
using VoxelFilterTests::Image;

struct LevelSet
{
  const char* Name;
  double Value; ///< air has 0, water about 1000
  std::array<int, 3> KernelSize;
  std::array<double, 3> Colour;
  double Opacity;
};

constexpr std::array<LevelSet, 3> Levels{ { { "skin", 500, { 3, 3, 3 }, { 0.9, 0.7, 0.6 }, 0.25 },
  { "bone", 1150, { 1, 1, 3 }, { 0.95, 0.92, 0.7 }, 0.6 },
  { "dense bone", 2000, { 1, 1, 3 }, { 0.75, 0.2, 0.15 }, 1.0 } } };

/// The steps of an opening and a closing: whether they dilate.
constexpr std::array<bool, 4> DilatingSteps{ false, true, true, false };

VoxelReference::Volume MakeReference(vtkImageData* ct, const LevelSet& level)
{
  vtkNew<vtkImageThreshold> threshold;
  threshold->SetInputData(ct);
  threshold->ThresholdByUpper(level.Value);
  threshold->SetInValue(1);
  threshold->SetOutValue(0);
  threshold->SetOutputScalarTypeToUnsignedChar();
  threshold->Update();
  Image image = threshold->GetOutput();
  for (const bool dilates : DilatingSteps)
  {
    vtkNew<vtkImageDilateErode3D> step;
    step->SetInputData(image);
    step->SetKernelSize(level.KernelSize[0], level.KernelSize[1], level.KernelSize[2]);
    step->SetDilateValue(dilates ? 1 : 0);
    step->SetErodeValue(dilates ? 0 : 1);
    step->Update();
    image = step->GetOutput();
  }
  return VoxelReference::OccupancyOf(image);
}

vtkSmartPointer<vtkVoxelMorphology> MakeStep(
  vtkAlgorithmOutput* input, int operation, const LevelSet& level)
{
  auto step = vtkSmartPointer<vtkVoxelMorphology>::New();
  step->SetInputConnection(input);
  step->SetOperation(operation);
  step->SetKernelTypeToSphere();
  step->SetKernelSize(level.KernelSize[0], level.KernelSize[1], level.KernelSize[2]);
  step->HostOutputOff();
  return step;
}

vtkSmartPointer<vtkActor> MakeActor(vtkAlgorithmOutput* voxels, const LevelSet& level)
{
  vtkNew<vtkDiscreteFlyingEdges3D> surface;
  surface->SetInputConnection(voxels);
  surface->SetValue(0, 1);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(surface->GetOutputPort());
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(level.Colour[0], level.Colour[1], level.Colour[2]);
  actor->GetProperty()->SetOpacity(level.Opacity);
  return actor;
}
}

int TestLargeLevelSets(int argc, char* argv[])
{
  const std::string fileName = VoxelTestMeshes::FindMeshFile("headsq_quarter.vti", argc, argv);
  const auto window =
    vtkSmartPointer<vtkRenderWindow>::Take(vtkVoxelContext::NewHeadlessRenderWindow());
  if (fileName.empty() || !window)
  {
    std::cerr << "headsq_quarter.vti or OpenGL is missing\n";
    return EXIT_FAILURE;
  }
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(fileName.c_str());
  reader->Update();

  VoxelTestChecks checks;
  vtkNew<vtkImageToSlicemap> sets;
  sets->SetInputConnection(reader->GetOutputPort());
  sets->HostOutputOff();
  std::array<vtkSmartPointer<vtkVoxelMorphology>, Levels.size()> closed;
  const vtkIdType uploads = vtkSlicemap::GetNumberOfUploads();
  const vtkIdType readBacks = vtkSlicemap::GetNumberOfReadBacks();
  for (std::size_t i = 0; i < Levels.size(); ++i)
  {
    sets->SetValue(static_cast<int>(i), Levels[i].Value);
  }
  for (std::size_t i = 0; i < Levels.size(); ++i)
  {
    const auto opened = MakeStep(
      sets->GetOutputPort(static_cast<int>(i)), vtkVoxelMorphology::OPERATION_OPEN, Levels[i]);
    closed[i] = MakeStep(opened->GetOutputPort(), vtkVoxelMorphology::OPERATION_CLOSE, Levels[i]);
    closed[i]->Update();
  }
  checks.Equal("uploads", vtkSlicemap::GetNumberOfUploads(), uploads + vtkIdType(Levels.size()));
  checks.Equal("read-backs", vtkSlicemap::GetNumberOfReadBacks(), readBacks);

  vtkNew<vtkRenderer> renderer;
  for (std::size_t i = 0; i < Levels.size(); ++i)
  {
    closed[i]->HostOutputOn();
    closed[i]->Update();
    const auto expected = MakeReference(reader->GetOutput(), Levels[i]);
    std::cout << Levels[i].Name << ": " << expected.CountNonZero() << " voxels\n";
    checks.Check(Levels[i].Name,
      VoxelReference::Report(
        Levels[i].Name, VoxelReference::Compare(closed[i]->GetOutput(), expected)));
    renderer->AddActor(MakeActor(closed[i]->GetOutputPort(), Levels[i]));
  }

  renderer->SetBackground(1, 1, 1);
  window->SetMultiSamples(0);
  window->SetSize(300, 300);
  window->AddRenderer(renderer);
  renderer->GetActiveCamera()->SetPosition(-0.8, 1.6, -0.4);
  renderer->GetActiveCamera()->SetViewUp(0, 0, -1);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Zoom(1.2);
  window->Render();
  const bool looksRight = vtkRegressionTestImage(window) == vtkTesting::PASSED;
  return checks.Passed() && looksRight ? EXIT_SUCCESS : EXIT_FAILURE;
}
