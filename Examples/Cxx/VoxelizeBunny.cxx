// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
// Reads a mesh, voxelizes it, prints what came out, and writes the image.
//
//   VoxelizeBunny MESH.ply IMAGE.vti

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkSlicemapSolidVoxelizer.h>
#include <vtkXMLImageDataWriter.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char* argv[])
{
  if (argc != 3)
  {
    std::cerr << "usage: VoxelizeBunny MESH.ply IMAGE.vti\n";
    return EXIT_FAILURE;
  }
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(argv[1]);

  vtkNew<vtkSlicemapSolidVoxelizer> voxelizer;
  voxelizer->SetInputConnection(reader->GetOutputPort());
  voxelizer->SetResolution(128);
  voxelizer->SetPadding(1);
  voxelizer->Update();

  const int* n = voxelizer->GetOutput()->GetDimensions();
  const vtkIdType filled = voxelizer->GetNumberOfFilledVoxels();
  std::cout << n[0] << " x " << n[1] << " x " << n[2] << " voxels, " << filled << " inside, on "
            << voxelizer->GetRendererName() << "\n";

  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputConnection(voxelizer->GetOutputPort());
  writer->SetFileName(argv[2]);
  return filled > 0 && writer->Write() ? EXIT_SUCCESS : EXIT_FAILURE;
}
