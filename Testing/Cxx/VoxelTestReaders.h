/**
 * @file   VoxelTestReaders.h
 * @brief  What holds for the readers of voxels, whatever the bytes of a file are.
 */
#ifndef VoxelTestReaders_h
#define VoxelTestReaders_h

#include "VoxelTestFiles.h"
#include "VoxelTestObservers.h"

#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

#include <cmath>
#include <string>

/// Reads a file that may be damaged: there are one error and no image, or an image on a sound grid
/// whose arrays have a value for each of its voxels. How many errors there were.
template <typename Reader>
std::size_t VoxelTestRead(
  VoxelTestChecks& checks, const std::string& title, Reader* reader, const std::string& file)
{
  const VoxelTestObserver observer(reader);
  reader->SetFileName(file.c_str());
  reader->Update();
  const std::size_t errors = observer.Errors.size();
  vtkImageData* image = reader->GetOutput();
  const int arrays = image->GetPointData()->GetNumberOfArrays();
  checks.Equal(title + ": warnings", observer.Warnings.size(), std::size_t(0));
  checks.Check(title + ": one error or a whole image", errors == (arrays == 0 ? 1 : 0));
  checks.Check(
    title + ": error code", (reader->GetErrorCode() == vtkErrorCode::NoError) == (errors == 0));
  for (int i = 0; i < arrays; ++i)
  {
    const vtkIdType values = image->GetPointData()->GetArray(i)->GetNumberOfTuples();
    checks.Equal(title + ": values", values, image->GetNumberOfPoints());
  }
  for (int axis = 0; arrays > 0 && axis < 3; ++axis)
  {
    const double spacing = image->GetSpacing()[axis];
    checks.Check(title + ": spacing", std::isfinite(spacing) && spacing > 0.0);
    checks.Check(title + ": origin", std::isfinite(image->GetOrigin()[axis]));
  }
  return errors;
}

/// Whatever the bytes of `good` are cut to is an error; and bytes changed, three at a time and
/// every other time within the first `header`, are what `read` takes: title and bytes, to the
/// number of errors.
template <typename Read>
void VoxelTestDamage(
  VoxelTestChecks& checks, const std::string& good, std::size_t header, const Read& read)
{
  for (std::size_t length = 0; length < good.size(); length += 1 + length / 8)
  {
    const std::string title = "first " + std::to_string(length) + " bytes";
    checks.Equal(title, read(title, good.substr(0, length)), std::size_t(1));
  }
  constexpr int mutations = 500;
  for (int seed = 0; seed < mutations; ++seed)
  {
    read("mutation of seed " + std::to_string(seed), VoxelTestFiles::Damaged(good, seed, header));
  }
}

#endif
