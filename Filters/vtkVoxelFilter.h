// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkVoxelFilter
 * @brief abstract base of the filters that make voxels of voxels on the GPU
 *
 * The inputs are vtkImageData. A voxel is set where the first component of the active point
 * scalars, or of the active cell scalars if there are only those, is not zero: so an occupancy of
 * this module, any mask, or all labels of a label map.
 *
 * An image that carries its vtkSlicemap is taken as it is, without a transfer, when that lives in
 * the OpenGL context of this filter and stands for the image as it is now; the bits are only read.
 * Of any other image the scalars are packed into bits and sent to the GPU, once as long as they
 * don't change.
 *
 * All of the input is asked for, and all of the output is made.
 *
 * <b>Output.</b> As vtkVoxelAlgorithm tells; OutputAttributeType Input, the default, gives points
 * for points and cells for cells.
 *
 * <b>Errors.</b> One error that says what is wrong and what to do, and an empty output: an input
 * that is empty, that has neither scalars nor a slicemap, or no scalars and a slicemap in another
 * OpenGL context; and those of vtkVoxelAlgorithm.
 *
 * @sa vtkVoxelAlgorithm vtkSlicemap
 */

#ifndef vtkVoxelFilter_h
#define vtkVoxelFilter_h

#include "vtkVoxelAlgorithm.h"
#include "vtkVoxelizationModule.h" // for export macro

#include <memory> // for the implementation
#include <vector> // for several inputs

class vtkDataArray;

class VTKVOXELIZATION_EXPORT vtkVoxelFilter : public vtkVoxelAlgorithm
{
public:
  vtkTypeMacro(vtkVoxelFilter, vtkVoxelAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Beside those of vtkVoxelAlgorithm.
   */
  enum InputAttributeType
  {
    ATTRIBUTE_INPUT = 2
  };

  ///@{
  /**
   * Whether voxels are the points of the output, its cells, or whatever they are in the (first)
   * input (default).
   */
  void SetOutputAttributeType(int type) override;
  int GetOutputAttributeType() override;
  void SetOutputAttributeTypeToInput() { this->SetOutputAttributeType(ATTRIBUTE_INPUT); }
  ///@}

protected:
  vtkVoxelFilter();
  ~vtkVoxelFilter() override;

  /**
   * Fills `output`, which has its context but is not yet allocated, from the voxels of all inputs:
   * those of the first port in the order of its connections, then those of the next port. The
   * context is current. Inputs must not be changed. Returns false after having reported an error,
   * or when aborted; may throw std::runtime_error, which becomes the one error.
   */
  virtual bool Process(const std::vector<vtkSlicemap*>& inputs, vtkSlicemap* output);

  /**
   * The same for a filter whose output is no occupancy: fills the images of all output ports, which
   * are empty. Here: that of port 0 by Process.
   */
  virtual bool Execute(
    const std::vector<vtkSlicemap*>& inputs, const std::vector<vtkImageData*>& outputs);

  /**
   * The same for a filter that wants scalars instead of slicemaps: the images of all inputs. Here:
   * Execute on their slicemaps.
   */
  virtual bool ExecuteOnImages(
    const std::vector<vtkImageData*>& inputs, const std::vector<vtkImageData*>& outputs);

  /**
   * The array of an input that tells its voxels, and whether it is one of its cells. Here: the
   * active scalars, or null, for which the slicemap of the input may stand in. May throw
   * std::runtime_error.
   */
  virtual vtkDataArray* FindScalars(vtkImageData* image, bool& ofCells);

  /**
   * The grid of the output for that of the first input; the same here.
   */
  virtual vtkVoxelGrid GetOutputGrid(const vtkVoxelGrid& input);

  /**
   * Checks parameters and inputs, whose grids are known, before any work; throws
   * std::runtime_error.
   */
  virtual void CheckInputs(const std::vector<vtkVoxelGrid>& inputs);

  /**
   * The slicemaps of all inputs as they are now, in the current context. Throws std::runtime_error.
   */
  std::vector<vtkSlicemap*> GetInputSlicemaps();

  bool HasCellVoxels() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkVoxelFilter(const vtkVoxelFilter&) = delete;
  void operator=(const vtkVoxelFilter&) = delete;

  struct InputVoxels;
  InputVoxels FindVoxels(vtkImageData* image);
  vtkVoxelGrid GetOutputImage(const vtkVoxelGrid& inputImage, bool inputHasCellVoxels);
  std::vector<vtkImageData*> GetInputImages();

  bool FollowsInput = true;
  bool InputHasCellVoxels = false;

  struct Internals;
  std::unique_ptr<Internals> Kept;
};

#endif
