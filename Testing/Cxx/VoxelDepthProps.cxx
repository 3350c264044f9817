#include "VoxelDepthProps.h"

#include "VoxelComparison.h"
#include "VoxelTestPictures.h"

#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkRenderer.h>
#include <vtkVoxelContext.h>

#include <cmath>
#include <iostream>

namespace VoxelDepthProps
{

//------------------------------------------------------------------------------------------------
vtkSmartPointer<vtkDepthBufferVoxelizer> MakeVoxelizer(vtkProp* prop)
{
  auto voxelizer = vtkSmartPointer<vtkDepthBufferVoxelizer>::New();
  voxelizer->AddProp(prop);
  voxelizer->SetResolution(60);
  voxelizer->SetPadding(1);
  return voxelizer;
}

//------------------------------------------------------------------------------------------------
vtkSmartPointer<vtkRenderWindow> Show(vtkDepthBufferVoxelizer* voxelizer)
{
  auto window = vtkSmartPointer<vtkRenderWindow>::Take(vtkVoxelContext::NewHeadlessRenderWindow());
  if (!window)
  {
    std::cerr << "OpenGL is missing\n";
    return nullptr;
  }
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  renderer->AddActor(VoxelTestPictures::MakeSurface(voxelizer->GetOutputPort()));
  window->AddRenderer(renderer);
  window->SetMultiSamples(0);
  window->SetSize(200, 200);
  renderer->GetActiveCamera()->SetPosition(2, 1, 1.5);
  renderer->ResetCamera();
  window->Render();
  return window;
}

//------------------------------------------------------------------------------------------------
bool CheckSolid(const std::string& name, vtkImageData* image,
  const std::function<double(const VoxelReference::Vector&)>& distance)
{
  const VoxelReference::Volume voxels = VoxelReference::OccupancyOf(image);
  const double allowed = 0.5 * image->GetSpacing()[0];
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

}
