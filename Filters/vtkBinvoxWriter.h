// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkBinvoxWriter
 * @brief writes voxels as a .binvox file, run-length encoded
 *
 * The format that tools for 3D shapes exchange solid voxels in: a header of text (dimensions, the
 * corner of the first voxel, the length of the longest side), then pairs of bytes, a value of 0 or
 * 1 and how often it comes, 1 to 255 times, with y running fastest, then z, then x.
 *
 * The input is a vtkImageData, or carries a vtkSlicemap; a voxel is set where the first component
 * of the active point scalars, or of the active cell scalars if there are only those, is not zero.
 * A slicemap is read as bits, so that no scalars are needed.
 *
 * The header has one scale and no axes: voxels must be cubes, and the direction matrix the
 * identity.
 *
 * <b>Errors.</b> One error, and no file, or the former one as it was: no file name, an empty image,
 * no voxels, voxels that are no cubes, a rotated image, a file that can't be written. GetErrorCode
 * tells scripts.
 *
 * @sa vtkBinvoxReader vtkSlicemap
 */

#ifndef vtkBinvoxWriter_h
#define vtkBinvoxWriter_h

#include "vtkVoxelizationModule.h" // for export macro
#include "vtkWriter.h"

class vtkImageData;

class VTKVOXELIZATION_EXPORT vtkBinvoxWriter : public vtkWriter
{
public:
  static vtkBinvoxWriter* New();
  vtkTypeMacro(vtkBinvoxWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to write. Default: none.
   */
  vtkSetStringMacro(FileName);
  vtkGetStringMacro(FileName);
  ///@}

  ///@{
  /**
   * Whether the file itself is written, for callers that see to a failure. When off (default) the
   * bytes go to FileName.part, which takes the name when it is complete.
   */
  vtkSetMacro(InPlace, bool);
  vtkGetMacro(InPlace, bool);
  vtkBooleanMacro(InPlace, bool);
  ///@}

  vtkImageData* GetInput();

protected:
  vtkBinvoxWriter();
  ~vtkBinvoxWriter() override;

  void WriteData() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkBinvoxWriter(const vtkBinvoxWriter&) = delete;
  void operator=(const vtkBinvoxWriter&) = delete;

  char* FileName = nullptr;
  bool InPlace = false;
};

#endif
