// Fuzz target: vtkVDBVoxelReader, given any bytes. See VoxelTestReaders.h for what holds.

#include "FuzzInput.h"
#include "VoxelTestReaders.h"

#include <vtkNew.h>
#include <vtkVDBVoxelReader.h>

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  constexpr vtkTypeInt64 memoryLimit = 1 << 24;
  const FuzzFile file(bytes, size);
  vtkNew<vtkVDBVoxelReader> reader;
  reader->SetMemoryLimit(memoryLimit);
  VoxelTestChecks checks;
  VoxelTestRead(checks, "these bytes", reader.Get(), file.GetName());
  FuzzRequire(checks.Passed(), "all of this");
  return 0;
}
