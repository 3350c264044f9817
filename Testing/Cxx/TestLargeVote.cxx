// Proves that the fill rule Vote mends holes: the bunny as scanned, with 223 open edges, differs
// from the closed one in at most 469 voxels at 128^3, which is what the best of the simple
// voxelizers reach.

#include "VoxelComparison.h"
#include "VoxelSolidTests.h"
#include "VoxelTestMeshes.h"

#include <vtkImageData.h>
#include <vtkPolyData.h>

#include <cstdlib>
#include <iostream>

using namespace VoxelReference;
using namespace VoxelSolidTests;
using namespace VoxelTestMeshes;

int TestLargeVote(int argc, char* argv[])
{
  constexpr std::size_t most = 469;
  const Mesh closed = ReadPLY("bunny.ply", argc, argv);
  const Mesh open = ReadPLY("bunny_open.ply", argc, argv);
  if (!closed || !open || CountOpenEdges(open) != 223)
  {
    std::cerr << "bunny.ply or bunny_open.ply is missing or another one\n";
    return EXIT_FAILURE;
  }
  bool good = true;
  for (const int backend : Backends)
  {
    vtkNew<vtkSlicemapSolidVoxelizer> voxelizer;
    voxelizer->SetInputData(open);
    voxelizer->SetModelBounds(closed->GetBounds());
    voxelizer->SetResolution(128);
    voxelizer->SetBackend(backend);
    voxelizer->SetFillRuleToVote();
    voxelizer->Update();
    const Volume expected =
      CrossingParityReference(closed, Grid::FromImage(voxelizer->GetOutput()));
    const Difference difference = Compare(voxelizer->GetOutput(), expected);
    std::cout << NameOf(backend) << ": " << difference.Summary() << "\n";
    good &= difference.IsComparable() && difference.Count() <= most;

    // A closed mesh is what it is.
    voxelizer->SetInputData(closed);
    voxelizer->Update();
    good &= Report("closed bunny by vote, " + NameOf(backend),
      Compare(voxelizer->GetOutput(), expected), closed, ToleranceOf(backend));
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
