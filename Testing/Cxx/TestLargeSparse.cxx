// Proves that the dragon's surface at 2048 voxels comes as a list and as a hyper tree grid with
// less than 2 GiB of memory in all, OpenGL in software included: the peak of this very process is
// looked at.

#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkHybridSurfaceVoxelizer.h>
#include <vtkHyperTreeGrid.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

namespace
{
/// Largest resident size of the process so far; 0 where the system does not tell.
long long PeakKibibytes()
{
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word)
  {
    if (word == "VmHWM:")
    {
      long long size = 0;
      status >> size;
      return size;
    }
  }
  return 0;
}
}

int TestLargeSparse(int argc, char* argv[])
{
  [[maybe_unused]] constexpr long long limit = 2LL << 20;
  const auto dragon = VoxelTestMeshes::ReadPLY("dragon.ply", argc, argv);
  if (!dragon)
  {
    std::cerr << "dragon.ply is missing\n";
    return EXIT_FAILURE;
  }
  VoxelTestChecks checks;
  vtkNew<vtkHybridSurfaceVoxelizer> voxelizer;
  voxelizer->SetInputData(dragon);
  voxelizer->SetResolution(2048);
  voxelizer->Update(1);
  const vtkIdType voxels = voxelizer->GetVoxelList()->GetNumberOfPoints();
  const long long peakOfList = PeakKibibytes();
  voxelizer->Update(2);
  const vtkIdType leaves = voxelizer->GetHyperTreeGrid()->GetNumberOfLeaves();
  const long long peak = PeakKibibytes();
  std::cout << voxels << " voxels, " << leaves << " leaves; " << peakOfList / 1024
            << " MiB at most for the list, " << peak / 1024 << " MiB with the tree beside it\n";
  checks.Check("some ten million voxels", voxels > 10000000 && voxels < 12000000);
  checks.Check("more leaves than voxels", leaves > voxels);
#ifndef __SANITIZE_ADDRESS__ // which keeps freed memory
  checks.Check("memory for the list", peakOfList < limit);
  checks.Check("memory for list and tree", peak < limit);
#endif
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
