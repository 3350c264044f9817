// Fuzz target: vtkBinvoxReader, given any bytes. See VoxelTestReaders.h for what holds.

#include "FuzzInput.h"
#include "VoxelTestReaders.h"

#include <vtkBinvoxReader.h>
#include <vtkNew.h>

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  const FuzzFile file(bytes, size);
  vtkNew<vtkBinvoxReader> reader;
  VoxelTestChecks checks;
  VoxelTestRead(checks, "these bytes", reader.Get(), file.GetName());
  FuzzRequire(checks.Passed(), "all of this");
  return 0;
}
