// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkVoxelAlgorithm
 * @brief abstract base of all filters of this module whose output is voxels
 *
 * <b>Output.</b> A vtkImageData with point scalars named "Occupancy": unsigned char,
 * ForegroundValue where the voxel is set and 0 elsewhere, or VTK_BIT (OutputScalarType). With
 * OutputAttributeType Cell the voxels are the cells of the image instead, at the same place in
 * space. The image carries its vtkSlicemap, so that filters of this module behind it work on the
 * GPU without a transfer; with HostOutput off it carries nothing else. A filter that runs again
 * writes into the arrays of its last run, as VTK's filters for images do, unless somebody else
 * holds a reference to them.
 *
 * <b>Errors.</b> One error that says what is wrong and what to do, and an empty output: a result
 * larger than MemoryLimit, no OpenGL context.
 *
 * @sa vtkVoxelizer vtkVoxelFilter vtkSlicemap vtkVoxelContext
 */

#ifndef vtkVoxelAlgorithm_h
#define vtkVoxelAlgorithm_h

#include "vtkImageAlgorithm.h"
#include "vtkVoxelizationModule.h" // for export macro

#include <cstdint>    // for 64-bit sizes
#include <functional> // for RunInContext
#include <memory>     // for the implementation
#include <string>     // for CheckBytes

class vtkDataObject;
class vtkDataSetAttributes;
class vtkImageData;
class vtkRenderWindow;
class vtkSlicemap;
class vtkVoxelContext;
class vtkVoxelSpareArrays;
struct vtkVoxelGrid;

class VTKVOXELIZATION_EXPORT vtkVoxelAlgorithm : public vtkImageAlgorithm
{
public:
  vtkTypeMacro(vtkVoxelAlgorithm, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum AttributeType
  {
    ATTRIBUTE_POINT = 0,
    ATTRIBUTE_CELL = 1
  };

  ///@{
  /**
   * Value of the voxels that are set, 1 (default) to 255; those outside are 0.
   */
  vtkSetClampMacro(ForegroundValue, int, 1, 255);
  vtkGetMacro(ForegroundValue, int);
  ///@}

  ///@{
  /**
   * VTK_UNSIGNED_CHAR (default) or VTK_BIT, which needs an eighth of the memory.
   */
  virtual void SetOutputScalarType(int type);
  vtkGetMacro(OutputScalarType, int);
  void SetOutputScalarTypeToUnsignedChar() { this->SetOutputScalarType(VTK_UNSIGNED_CHAR); }
  void SetOutputScalarTypeToBit() { this->SetOutputScalarType(VTK_BIT); }
  ///@}

  ///@{
  /**
   * Whether voxels are the points of the output (default) or its cells.
   */
  vtkSetClampMacro(OutputAttributeType, int, ATTRIBUTE_POINT, ATTRIBUTE_CELL);
  vtkGetMacro(OutputAttributeType, int);
  void SetOutputAttributeTypeToPoint() { this->SetOutputAttributeType(ATTRIBUTE_POINT); }
  void SetOutputAttributeTypeToCell() { this->SetOutputAttributeType(ATTRIBUTE_CELL); }
  ///@}

  ///@{
  /**
   * Whether the result is read back into the output's scalars (default). When off the output has
   * geometry and a vtkSlicemap, but no arrays.
   */
  vtkSetMacro(HostOutput, bool);
  vtkGetMacro(HostOutput, bool);
  vtkBooleanMacro(HostOutput, bool);
  ///@}

  ///@{
  /**
   * The window in whose OpenGL context to work. Default: none, which takes the headless context
   * that the process shares (see vtkVoxelContext).
   */
  virtual void SetRenderWindow(vtkRenderWindow* window);
  vtkRenderWindow* GetRenderWindow();
  ///@}

  ///@{
  /**
   * Most bytes of host memory that the output may take; a larger one is refused before any work. 0
   * (default) stands for what the system says is free.
   */
  vtkSetClampMacro(MemoryLimit, vtkTypeInt64, 0, VTK_TYPE_INT64_MAX);
  vtkGetMacro(MemoryLimit, vtkTypeInt64);
  ///@}

  /**
   * Number of voxels set by the last run; counted on the GPU when first asked for. -1 before any
   * run.
   */
  vtkIdType GetNumberOfFilledVoxels();

  /**
   * Name of the OpenGL renderer that the filter works on, such as "llvmpipe (LLVM 15.0.6, 256
   * bits)"; an empty string when there is none.
   */
  const char* GetRendererName();

  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

protected:
  vtkVoxelAlgorithm();
  ~vtkVoxelAlgorithm() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;

  /**
   * The frame of every run: `prepare` checks what it is to work on, before any work, and may return
   * false when there is nothing to do; `work` finds the context current, and returns false after
   * having reported an error, or when aborted. Exceptions become one error; those of OpenGL name
   * what it was `doing`. Returns what a request returns; there is a slicemap only when it went
   * well.
   */
  int RunInContext(const std::string& doing, const std::function<bool()>& prepare,
    const std::function<bool()>& work);

  /**
   * Throws std::runtime_error, which RunInContext reports, when `what` takes more bytes than
   * MemoryLimit allows, or than are free. `remedy` tells the user what to do.
   */
  void CheckBytes(std::int64_t bytes, const std::string& what, const std::string& remedy) const;

  /**
   * The same for an output on `grid`, if there are to be arrays.
   */
  void CheckMemory(const vtkVoxelGrid& grid);

  /**
   * Bytes of all arrays of an output on `grid`. Here: those of the occupancy.
   */
  virtual std::int64_t GetBytesOfOutput(const vtkVoxelGrid& grid);

  /**
   * Whether the voxels of the output are its cells. Here: what OutputAttributeType says.
   */
  virtual bool HasCellVoxels() { return this->OutputAttributeType == ATTRIBUTE_CELL; }

  ///@{
  /**
   * For RequestInformation: announces in a pipeline's information an output with an occupancy on
   * `grid`; or reports an error and empties all outputs, and returns what the request returns.
   */
  void PublishGrid(const vtkVoxelGrid& grid, vtkInformation* outputInfo);
  int FailInformation(const std::string& error, vtkInformationVector* outputs);
  ///@}

  ///@{
  /**
   * The slicemap that is to become the result of an output port, in the context of this filter and
   * not allocated. It is that of the last run, unless somebody else still looks at it; so empty the
   * output first. FillOutput gives `output`, which is empty, geometry and slicemap, and with
   * HostOutput the scalars; it throws std::runtime_error. GetSlicemap is null when there is none.
   */
  vtkSlicemap* TakeSlicemap(int port = 0);
  void FillOutput(vtkImageData* output, vtkSlicemap* slicemap);
  vtkSlicemap* GetSlicemap(int port = 0);
  ///@}

  /**
   * Removes data and slicemap of an output.
   */
  static void EmptyOutput(vtkDataObject* output);

  /**
   * The attributes of an image where the voxels are.
   */
  vtkDataSetAttributes* GetVoxelData(vtkImageData* output);

  vtkVoxelContext* GetContext();

  /**
   * The arrays of the last run, for those of this one to have their memory.
   */
  vtkVoxelSpareArrays* GetSpareArrays();

  /**
   * For runs that leave no slicemap: the number of voxels that they set.
   */
  void SetNumberOfFilledVoxels(vtkIdType count);

  /**
   * For what RunInContext runs: the fraction done, from 0 to 1; false when the filter was told to
   * stop.
   */
  bool ReportProgress(double fraction);

private:
  vtkVoxelAlgorithm(const vtkVoxelAlgorithm&) = delete;
  void operator=(const vtkVoxelAlgorithm&) = delete;

  int ForegroundValue = 1;
  int OutputScalarType = VTK_UNSIGNED_CHAR;
  int OutputAttributeType = ATTRIBUTE_POINT;
  bool HostOutput = true;
  vtkTypeInt64 MemoryLimit = 0;

  struct Internals;
  std::unique_ptr<Internals> Common;
};

#endif
