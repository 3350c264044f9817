// Proves that the steps of the program vtkvoxelize stay on the GPU: whatever their number, the bits
// are read back once, for the result, and none are sent there but those of a mask. Holes, which are
// found on the host, cost one transfer in each direction.

#include "Messages.h"
#include "Options.h"
#include "Terminal.h"
#include "VoxelPipeline.h"
#include "VoxelTestMeshes.h"
#include "VoxelTestObservers.h"

#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkSlicemap.h>
#include <vtkTestUtilities.h>
#include <vtkVoxelAlgorithm.h>
#include <vtkXMLImageDataWriter.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace
{
struct Transfers
{
  vtkIdType ReadBacks = 0;
  vtkIdType Uploads = 0;
  vtkIdType Values = 0; // of the result
};

/// Of two runs, the second of which has nothing to do. Writes the voxels, where there is a file.
Transfers Run(const std::vector<std::string>& words, const std::string& file = {})
{
  const Options options = Options::Parse(words);
  Messages messages;
  Terminal terminal;
  VoxelPipeline pipeline(options, messages, terminal);
  pipeline.Read();
  const vtkIdType readBacks = vtkSlicemap::GetNumberOfReadBacks();
  const vtkIdType uploads = vtkSlicemap::GetNumberOfUploads();
  pipeline.Run(VoxelOutput::Kind::Image);
  pipeline.Run(VoxelOutput::Kind::Image);
  vtkImageData* voxels = pipeline.GetResult()->GetOutput();
  if (!file.empty())
  {
    vtkNew<vtkXMLImageDataWriter> writer;
    writer->SetFileName(file.c_str());
    writer->SetInputData(voxels);
    writer->Write();
  }
  return { vtkSlicemap::GetNumberOfReadBacks() - readBacks,
    vtkSlicemap::GetNumberOfUploads() - uploads,
    voxels->GetPointData()->GetScalars()->GetNumberOfValues() };
}
}

int TestVoxelPipeline(int argc, char* argv[])
{
  const std::string bunny = VoxelTestMeshes::FindMeshFile("bunny_7k.ply", argc, argv);
  char* folder = vtkTestUtilities::GetArgOrEnvOrDefault("-T", argc, argv, "VTK_TEMP_DIR", ".");
  const std::string mask = std::string(folder) + "/TestVoxelPipeline.vti";
  delete[] folder;
  const std::vector<std::string> grid = { "--resolution", "20", "--padding", "4", bunny,
    "out.vti" };
  const auto with = [&](const std::vector<std::string>& steps)
  {
    std::vector<std::string> words = grid;
    words.insert(words.end(), steps.begin(), steps.end());
    return words;
  };

  VoxelTestChecks checks;
  const auto check = [&](const std::string& what, const Transfers& transfers, vtkIdType uploads)
  {
    checks.Equal(what + ": read-backs", transfers.ReadBacks, 1);
    checks.Equal(what + ": uploads of bits", transfers.Uploads, uploads);
    checks.Check(what + ": the result is there", transfers.Values > 0);
  };
  check("no steps", Run(grid, mask), 0);
  check("one step", Run(with({ "--dilate", "1" })), 0);
  check("many steps",
    Run(with({ "--dilate", "2", "--subtract", bunny, "--complement", "--kernel", "sphere",
      "--close", "2", "--xor", bunny, "--kernel", "faces6", "--open", "1" })),
    0);
  check("a mask", Run(with({ "--dilate", "2", "--subtract", mask, "--erode", "1" })), 1);
  // Components are found on the host.
  const Transfers holes = Run(with({ "--dilate", "1", "--fill-holes" }));
  checks.Equal("holes: read-backs", holes.ReadBacks, 2);
  checks.Equal("holes: uploads of bits", holes.Uploads, 1);
  return checks.Passed() ? EXIT_SUCCESS : EXIT_FAILURE;
}
