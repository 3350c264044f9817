// Proves by its picture that the colours of a textured OBJ file come to the right voxels: a sphere
// with stripes and a coloured half, read from a file that the test writes.

#include "VoxelTestMeshes.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCubeSource.h>
#include <vtkGlyph3DMapper.h>
#include <vtkHybridSurfaceVoxelizer.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRegressionTestImage.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTestUtilities.h>
#include <vtkVoxelContext.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>

namespace
{
constexpr double Pi = 3.14159265358979323846;

/// A sphere of rows x columns quadrilaterals with texture coordinates.
void WriteSphere(const std::string& fileName, int rows, int columns)
{
  std::ofstream file(fileName);
  for (int row = 0; row <= rows; ++row)
  {
    for (int column = 0; column <= columns; ++column)
    {
      const double u = double(column) / columns;
      const double v = double(row) / rows;
      file << "v " << std::sin(Pi * v) * std::cos(2 * Pi * u) << " "
           << std::sin(Pi * v) * std::sin(2 * Pi * u) << " " << -std::cos(Pi * v) << "\n"
           << "vt " << u << " " << v << "\n";
    }
  }
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      const int a = row * (columns + 1) + column + 1;
      const int b = a + columns + 1;
      file << "f";
      for (const int corner : { a, a + 1, b + 1, b })
      {
        file << " " << corner << "/" << corner;
      }
      file << "\n";
    }
  }
}

/// Stripes along v, red where u is below a half, blue above.
vtkSmartPointer<vtkImageData> MakeStripes()
{
  constexpr int size = 32;
  constexpr int stripe = 4;
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(size, size, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < size; ++y)
  {
    for (int x = 0; x < size; ++x)
    {
      const bool isLight = y / stripe % 2 == 0;
      const bool isRed = x < size / 2;
      image->SetScalarComponentFromDouble(x, y, 0, 0, isLight || isRed ? 230 : 30);
      image->SetScalarComponentFromDouble(x, y, 0, 1, isLight ? 220 : 40);
      image->SetScalarComponentFromDouble(x, y, 0, 2, isLight || !isRed ? 210 : 20);
    }
  }
  return image;
}
}

int TestSurfacePicture(int argc, char* argv[])
{
  const std::unique_ptr<char[]> folder(
    vtkTestUtilities::GetArgOrEnvOrDefault("-T", argc, argv, "VTK_TEMP_DIR", "Testing/Temporary"));
  const std::string fileName = std::string(folder.get()) + "/TestSurfacePicture.obj";
  WriteSphere(fileName, 16, 32);
  const auto window =
    vtkSmartPointer<vtkRenderWindow>::Take(vtkVoxelContext::NewHeadlessRenderWindow());
  if (!window)
  {
    std::cerr << "OpenGL is missing\n";
    return EXIT_FAILURE;
  }
  vtkNew<vtkOBJReader> reader;
  reader->SetFileName(fileName.c_str());
  vtkNew<vtkHybridSurfaceVoxelizer> voxelizer;
  voxelizer->SetInputConnection(reader->GetOutputPort());
  voxelizer->SetTextureImage(MakeStripes());
  voxelizer->SetResolution(40);
  voxelizer->Update(1);
  voxelizer->GetVoxelList()->GetPointData()->SetActiveScalars("Texture");
  vtkNew<vtkCubeSource> cube;
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputConnection(voxelizer->GetOutputPort(1));
  mapper->SetSourceConnection(cube->GetOutputPort());
  mapper->SetScaleFactor(2.0 / 40);
  mapper->ScalingOn();
  mapper->SetScaleModeToNoDataScaling();
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray("Texture");
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  renderer->AddActor(actor);
  window->SetMultiSamples(0);
  window->SetSize(300, 300);
  window->AddRenderer(renderer);
  renderer->GetActiveCamera()->SetPosition(2, -0.3, 0.8);
  renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
  renderer->ResetCamera();
  window->Render();
  return vtkRegressionTestImage(window) == vtkTesting::PASSED ? EXIT_SUCCESS : EXIT_FAILURE;
}
