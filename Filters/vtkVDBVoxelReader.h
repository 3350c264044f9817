// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkVDBVoxelReader
 * @brief reads grids of an OpenVDB file as an image
 *
 * The output is a vtkImageData with a point array for each grid read, which has the name of the
 * grid and the values of all voxels, active or not; the first is the active scalars. Bool and mask
 * grids become unsigned char of 0 and 1, float, double, int32, int64 and vec3 grids arrays of these
 * types. Spacing, origin and direction matrix are those of the transform, and index (i, j, k) of
 * the image is index (i, j, k) of the grids.
 *
 * The extent is the one that vtkVDBVoxelWriter has stored, else the bounds of the active voxels;
 * where several grids are read, the box around them all. Update extents are honoured, so that large
 * files come in pieces.
 *
 * <b>Errors.</b> One error that names the file, and an empty output: no file name, a file that is
 * missing, is no .vdb file, is truncated or damaged, or has no grid; no grid of the name, a type of
 * grid other than those above, a transform whose voxels are no boxes, that is a perspective or
 * sheared one, grids on several lattices, no active voxel, an image that is larger than the memory.
 * Lengths and counts in the file are compared with its length before there is any memory for them.
 * A tree of a damaged file is not given back to the system.
 *
 * Only where this module was built with OpenVDB.
 *
 * @sa vtkVDBVoxelWriter
 */

#ifndef vtkVDBVoxelReader_h
#define vtkVDBVoxelReader_h

#include "vtkImageAlgorithm.h"
#include "vtkVoxelizationModule.h" // for export macro

#include <map>    // for metadata
#include <string> // for names
#include <vector> // for names

class VTKVOXELIZATION_EXPORT vtkVDBVoxelReader : public vtkImageAlgorithm
{
public:
  static vtkVDBVoxelReader* New();
  vtkTypeMacro(vtkVDBVoxelReader, vtkImageAlgorithm);
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
   * The grid to read. Default: none, which reads all that have the type of an array.
   */
  vtkSetStringMacro(GridName);
  vtkGetStringMacro(GridName);
  ///@}

  ///@{
  /**
   * Largest number of bytes of the output; 0 (default) is what the system has free.
   */
  vtkSetClampMacro(MemoryLimit, vtkTypeInt64, 0, VTK_TYPE_INT64_MAX);
  vtkGetMacro(MemoryLimit, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * All grids of the file, after UpdateInformation: their names, with a number in brackets where
   * several have one, and types as OpenVDB has them. Null when there is no such grid.
   */
  int GetNumberOfGrids() { return static_cast<int>(this->GridNames.size()); }
  const char* GetNameOfGrid(int i);
  const char* GetTypeOfGrid(int i);
  ///@}

  /**
   * Metadata of the file as text, after UpdateInformation. Null when there are none of the name.
   */
  const char* GetMetadata(const char* name);

  /**
   * Whether the file begins as a .vdb file does.
   */
  static bool CanReadFile(const char* fileName);

protected:
  vtkVDBVoxelReader();
  ~vtkVDBVoxelReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkVDBVoxelReader(const vtkVDBVoxelReader&) = delete;
  void operator=(const vtkVDBVoxelReader&) = delete;

  class Selection;

  int Report(unsigned long code, const std::string& what);

  char* FileName = nullptr;
  char* GridName = nullptr;
  vtkTypeInt64 MemoryLimit = 0;
  std::vector<std::string> GridNames;
  std::vector<std::string> GridTypes;
  std::map<std::string, std::string> Metadata;
};

#endif
