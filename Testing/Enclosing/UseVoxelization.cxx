// Part of the test EnclosingBuild: proves that the headers and the library of a module built by an
// enclosing project are found, by running one class of it.
#include <vtkNew.h>
#include <vtkSlicemapSolidVoxelizer.h>

#include <cstdlib>

int main()
{
  vtkNew<vtkSlicemapSolidVoxelizer> voxelizer;
  return voxelizer->IsA("vtkVoxelizer") ? EXIT_SUCCESS : EXIT_FAILURE;
}
