// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkBinvoxReader
 * @brief reads voxels from a .binvox file
 *
 * See vtkBinvoxWriter for the format. The output is a vtkImageData with point scalars named
 * "Occupancy", unsigned char, that hold the values of the file: 0 outside, 1, or whatever else a
 * program has stored, inside. Voxel (0, 0, 0) is the first of the file; its spacing is the scale
 * divided by the largest dimension, and its origin half a voxel from the corner that the file calls
 * translate. Lines of the header that this class doesn't know are left out, and so is what follows
 * the last voxel.
 *
 * <b>Errors.</b> One error that names the file, and an empty output: no file name, a file that is
 * missing, is no .binvox file, has a damaged header, or has fewer voxels than its header says or
 * a run that goes on behind the last one. The number of bytes is compared with the dimensions
 * before there is any memory for them.
 *
 * @sa vtkBinvoxWriter
 */

#ifndef vtkBinvoxReader_h
#define vtkBinvoxReader_h

#include "vtkImageAlgorithm.h"
#include "vtkVoxelizationModule.h" // for export macro

class VTKVOXELIZATION_EXPORT vtkBinvoxReader : public vtkImageAlgorithm
{
public:
  static vtkBinvoxReader* New();
  vtkTypeMacro(vtkBinvoxReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to read. Default: none.
   */
  vtkSetStringMacro(FileName);
  vtkGetStringMacro(FileName);
  ///@}

  /**
   * Whether the file begins as a .binvox file does.
   */
  static bool CanReadFile(const char* fileName);

protected:
  vtkBinvoxReader();
  ~vtkBinvoxReader() override;

  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkBinvoxReader(const vtkBinvoxReader&) = delete;
  void operator=(const vtkBinvoxReader&) = delete;

  char* FileName = nullptr;
};

#endif
