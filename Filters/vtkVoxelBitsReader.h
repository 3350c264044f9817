// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkVoxelBitsReader
 * @brief reads voxels from a .bits file, one variant of a model or all
 *
 * See vtkVoxelBitsWriter for the format. The output is a vtkImageData, one variant of the file,
 * with point scalars named "Occupancy", unsigned char, 0 or 1. ReadBatch gives all variants.
 *
 * <b>Errors.</b> One error that names the file, and an empty output: no file name, a file that is
 * missing, is no .bits file, has a damaged header, or less data than its header says; a variant
 * that it does not have. The number of bytes is compared with the dimensions before there is any
 * memory for them.
 *
 * @sa vtkVoxelBitsWriter
 */

#ifndef vtkVoxelBitsReader_h
#define vtkVoxelBitsReader_h

#include "vtkImageAlgorithm.h"
#include "vtkVoxelizationModule.h" // for export macro

#include <functional> // for the implementation
#include <string>     // for the label

class vtkUnsignedCharArray;

class VTKVOXELIZATION_EXPORT vtkVoxelBitsReader : public vtkImageAlgorithm
{
public:
  static vtkVoxelBitsReader* New();
  vtkTypeMacro(vtkVoxelBitsReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to read. Default: none.
   */
  vtkSetStringMacro(FileName);
  vtkGetStringMacro(FileName);
  ///@}

  ///@{
  /**
   * Which image of the file is the output, counted from 0. Default: 0.
   */
  vtkSetMacro(Variant, int);
  vtkGetMacro(Variant, int);
  ///@}

  ///@{
  /**
   * What the header of the file that was read last tells, beside the grid.
   */
  vtkGetMacro(NumberOfVariants, vtkTypeInt64);
  vtkGetMacro(FirstVariant, vtkTypeInt64);
  vtkGetMacro(Seed, vtkTypeInt64);
  const std::string& GetLabel() const { return this->Label; }
  ///@}

  /**
   * All images of the file, one after the other, one value a voxel, x fastest, so that the array
   * has the shape (variants, nz, ny, nx). False after one error; the array then is empty.
   */
  bool ReadBatch(vtkUnsignedCharArray* array);

  /**
   * Whether the file begins as a .bits file does.
   */
  static bool CanReadFile(const char* fileName);

protected:
  vtkVoxelBitsReader();
  ~vtkVoxelBitsReader() override;

  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkVoxelBitsReader(const vtkVoxelBitsReader&) = delete;
  void operator=(const vtkVoxelBitsReader&) = delete;

  class File;
  bool Guard(const std::function<void()>& work);

  char* FileName = nullptr;
  int Variant = 0;
  vtkTypeInt64 NumberOfVariants = 0;
  vtkTypeInt64 FirstVariant = 0;
  vtkTypeInt64 Seed = 0;
  std::string Label;
};

#endif
