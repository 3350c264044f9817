// Fuzz targets: readers of voxels, given any bytes. See VoxelTestReaders.h for what holds.
//
// READER_HEADER  the file that declares the reader, in angle brackets
// READER_CLASS   its class

#include "FuzzInput.h"
#include "VoxelTestReaders.h"

#include READER_HEADER
#include <vtkNew.h>

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  const FuzzFile file(bytes, size);
  vtkNew<READER_CLASS> reader;
  VoxelTestChecks checks;
  VoxelTestRead(checks, "these bytes", reader.Get(), file.GetName());
  FuzzRequire(checks.Passed(), "all of this");
  return 0;
}
