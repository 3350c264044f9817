// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkVoxelSlabWriter
 * @brief has voxels made slab by slab and writes them, for grids larger than memory
 *
 * Where other writers update their input as a whole, this one asks for one slab of the grid after
 * the other by update extents, hands its bits to the file and goes on, so that no more than a slab
 * is in memory at a time. The input is any algorithm whose output is a vtkImageData with occupied
 * voxels, point or cell scalars or a vtkSlicemap. All voxelizers of this module work in slabs, and
 * each slab equals the same part of the whole, bit for bit; so do readers and filters that announce
 * CAN_PRODUCE_SUB_EXTENT. Turn HostOutput of voxelizers off: then no array is made between the bits
 * and the file.
 *
 * <b>Formats</b>, by the extension of FileName, or by Format:
 *  - .vdb: a sparse grid "Occupancy" of OccupancyGrid, as vtkVDBVoxelWriter writes it; it grows in
 *    memory and is written at the end. Only where this module was built with OpenVDB.
 *  - .vti: an image with the array "Occupancy" of ScalarType, appended raw, in blocks packed by
 * zlib (Compressed, default) or in one piece.
 *  - .binvox: run lengths, as vtkBinvoxWriter writes them; the slabs lie along x.
 *  - .bits: one bit a voxel, as vtkVoxelBitsWriter writes them.
 * Set voxels alone are written, no other arrays.
 *
 * <b>Memory.</b> Slabs are as thick as MemoryLimit allows, counting the bits, scalars and buffers
 * of a voxelizer, what a .vdb grid has grown to and what its level set will take. Not counted are
 * the mesh, and what VTK and OpenGL need to exist, some 200 MiB with a renderer in software.
 *
 * <b>Errors.</b> One error, and no file, or the former one as it was: no input, no file name, a
 * format that is not known, or that can't hold the grid, a limit too small for the thinnest slab,
 * an input that makes its output in one piece larger than the limit, a full disk. What fails
 * upstream is reported there. GetErrorCode tells scripts. Progress is reported and abort honoured
 * between slabs and within writing; an aborted write leaves no file either.
 *
 * @sa vtkVDBVoxelWriter vtkBinvoxWriter vtkVoxelBitsWriter vtkVoxelizer
 */

#ifndef vtkVoxelSlabWriter_h
#define vtkVoxelSlabWriter_h

#include "vtkErrorCode.h"          // for errors
#include "vtkVoxelizationModule.h" // for export macro
#include "vtkWriter.h"

class VTKVOXELIZATION_EXPORT vtkVoxelSlabWriter : public vtkWriter
{
public:
  static vtkVoxelSlabWriter* New();
  vtkTypeMacro(vtkVoxelSlabWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum FormatType
  {
    FORMAT_AUTO = 0,
    FORMAT_VDB = 1,
    FORMAT_VTI = 2,
    FORMAT_BINVOX = 3,
    FORMAT_BITS = 4
  };

  /// Of GetErrorCode, beside those of vtkErrorCode.
  enum ErrorType
  {
    MemoryLimitError = vtkErrorCode::UserError + 1, ///< the limit is too small
    UpstreamError = vtkErrorCode::UserError + 2     ///< the input could not be made
  };

  enum OccupancyGridType
  {
    GRID_BOOL = 0,
    GRID_MASK = 1,
    GRID_LEVEL_SET = 2
  };

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

  ///@{
  /**
   * The format of the file. Default: Auto, which goes by the extension of FileName.
   */
  vtkSetClampMacro(Format, int, FORMAT_AUTO, FORMAT_BITS);
  vtkGetMacro(Format, int);
  void SetFormatToAuto() { this->SetFormat(FORMAT_AUTO); }
  void SetFormatToVDB() { this->SetFormat(FORMAT_VDB); }
  void SetFormatToVTI() { this->SetFormat(FORMAT_VTI); }
  void SetFormatToBinvox() { this->SetFormat(FORMAT_BINVOX); }
  void SetFormatToBits() { this->SetFormat(FORMAT_BITS); }
  ///@}

  /**
   * The format that the extension of a file's name stands for; FORMAT_AUTO when it is none that
   * this build can write.
   */
  static int GetFormatOfFile(const char* fileName);

  ///@{
  /**
   * Most bytes that slabs, and what the file has in memory, may take together. 0 (default) is half
   * of what the system has free when Write is called.
   */
  vtkSetClampMacro(MemoryLimit, vtkTypeInt64, 0, VTK_TYPE_INT64_MAX);
  vtkGetMacro(MemoryLimit, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * Most slices of a slab, along z, for .binvox along x. 0 (default) leaves that to the limit.
   */
  vtkSetClampMacro(MaximumSlices, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumSlices, int);
  ///@}

  ///@{
  /**
   * For .vdb: what becomes of the occupancy, as of vtkVDBVoxelWriter. Default: Bool.
   */
  vtkSetClampMacro(OccupancyGrid, int, GRID_BOOL, GRID_LEVEL_SET);
  vtkGetMacro(OccupancyGrid, int);
  void SetOccupancyGridToBool() { this->SetOccupancyGrid(GRID_BOOL); }
  void SetOccupancyGridToMask() { this->SetOccupancyGrid(GRID_MASK); }
  void SetOccupancyGridToLevelSet() { this->SetOccupancyGrid(GRID_LEVEL_SET); }
  ///@}

  ///@{
  /**
   * For .vdb: half the width of the band of a level set, in voxels, 1 to 7. Default: 3.
   */
  vtkSetClampMacro(HalfBandWidth, double, 1.0, 7.0);
  vtkGetMacro(HalfBandWidth, double);
  ///@}

  ///@{
  /**
   * For .vti: VTK_UNSIGNED_CHAR (default) or VTK_BIT, which needs an eighth of the space.
   */
  virtual void SetScalarType(int type);
  vtkGetMacro(ScalarType, int);
  void SetScalarTypeToUnsignedChar() { this->SetScalarType(VTK_UNSIGNED_CHAR); }
  void SetScalarTypeToBit() { this->SetScalarType(VTK_BIT); }
  ///@}

  ///@{
  /**
   * For .vti of VTK_UNSIGNED_CHAR: value of the voxels that are set, 1 (default) to 255.
   */
  vtkSetClampMacro(ForegroundValue, int, 1, 255);
  vtkGetMacro(ForegroundValue, int);
  ///@}

  ///@{
  /**
   * For .vti: whether its blocks are packed by zlib. Default: on.
   */
  vtkSetMacro(Compressed, bool);
  vtkGetMacro(Compressed, bool);
  vtkBooleanMacro(Compressed, bool);
  ///@}

  ///@{
  /**
   * Number of slabs that the last call of Write took, and of the voxels set in them.
   */
  vtkGetMacro(NumberOfSlabs, int);
  vtkGetMacro(NumberOfFilledVoxels, vtkTypeInt64);
  ///@}

  /**
   * Makes and writes all slabs. Returns 1 when the file is there, and 0 otherwise.
   */
  int Write() override;

  ///@{
  /**
   * The same as Write.
   */
  using vtkAlgorithm::Update;
  void Update() override { this->Write(); }
  void Update(int) override { this->Write(); }
  ///@}

protected:
  vtkVoxelSlabWriter();
  ~vtkVoxelSlabWriter() override;

  void WriteData() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkVoxelSlabWriter(const vtkVoxelSlabWriter&) = delete;
  void operator=(const vtkVoxelSlabWriter&) = delete;

  class Run;
  class Source;

  char* FileName = nullptr;
  bool InPlace = false;
  int Format = FORMAT_AUTO;
  vtkTypeInt64 MemoryLimit = 0;
  int MaximumSlices = 0;
  int OccupancyGrid = GRID_BOOL;
  double HalfBandWidth = 3.0;
  int ScalarType = VTK_UNSIGNED_CHAR;
  int ForegroundValue = 1;
  bool Compressed = true;
  bool IsWritten = false;
  int NumberOfSlabs = 0;
  vtkTypeInt64 NumberOfFilledVoxels = 0;
};

#endif
