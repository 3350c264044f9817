// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkVoxelMorphology
 * @brief dilates, erodes, opens and closes voxels on the GPU, 128 of them at a time
 *
 * The structuring element (KernelType, KernelSize) is laid on every voxel; a dilation sets a voxel
 * where one voxel of the element is set, an erosion leaves it where all are.
 * | kernel | voxels |
 * | --- | --- |
 * | Box | of KernelSize on each axis |
 * | Faces6 | the voxel and the 6 that share a face with it |
 * | Edges18 | and the 12 that share an edge |
 * | Corners26 | and the 8 that share a corner |
 * | Sphere | of KernelSize, those with centres in the ellipsoid whose axes are as long as that |
 *
 * Box and Sphere are those of vtkImageDilateErode3D: of an even size, the side of smaller indices
 * is the longer one. Opening and closing turn the element round for their second half, so that they
 * are idempotent whatever its size.
 *
 * The cost of a box grows with the logarithm of its size; that of a sphere with the number of its
 * rows. Iterations of a box are one larger box.
 *
 * <b>Errors.</b> One error, and an empty output: those of vtkVoxelFilter, and a KernelSize below 1,
 * above 63 for a Sphere, or too large to be counted.
 *
 * Dilation and erosion by shifts of packed bits are after
 *
 * Elmar Eisemann, Xavier Decoret: Single-Pass GPU Solid Voxelization for Real-Time Applications.
 * Graphics Interface 2008, pp. 73-80, section 7.
 *
 * @sa vtkVoxelFilter vtkVoxelBoolean vtkSlicemap
 */

#ifndef vtkVoxelMorphology_h
#define vtkVoxelMorphology_h

#include "vtkVoxelFilter.h"
#include "vtkVoxelizationModule.h" // for export macro

class VTKVOXELIZATION_EXPORT vtkVoxelMorphology : public vtkVoxelFilter
{
public:
  static vtkVoxelMorphology* New();
  vtkTypeMacro(vtkVoxelMorphology, vtkVoxelFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum OperationType
  {
    OPERATION_DILATE = 0,
    OPERATION_ERODE = 1,
    OPERATION_OPEN = 2,
    OPERATION_CLOSE = 3,
    OPERATION_INNER_GRADIENT = 4,
    OPERATION_OUTER_GRADIENT = 5
  };

  enum Kernel
  {
    KERNEL_BOX = 0,
    KERNEL_FACES6 = 1,
    KERNEL_EDGES18 = 2,
    KERNEL_CORNERS26 = 3,
    KERNEL_SPHERE = 4
  };

  enum BorderValueType
  {
    BORDER_NEUTRAL = 0,
    BORDER_EMPTY = 1,
    BORDER_FULL = 2
  };

  ///@{
  /**
   * Dilate (default), Erode; Open: erode, then dilate; Close: dilate, then erode; InnerGradient:
   * the voxels that an erosion takes away, OuterGradient: those that a dilation adds.
   */
  vtkSetClampMacro(Operation, int, OPERATION_DILATE, OPERATION_OUTER_GRADIENT);
  vtkGetMacro(Operation, int);
  void SetOperationToDilate() { this->SetOperation(OPERATION_DILATE); }
  void SetOperationToErode() { this->SetOperation(OPERATION_ERODE); }
  void SetOperationToOpen() { this->SetOperation(OPERATION_OPEN); }
  void SetOperationToClose() { this->SetOperation(OPERATION_CLOSE); }
  void SetOperationToInnerGradient() { this->SetOperation(OPERATION_INNER_GRADIENT); }
  void SetOperationToOuterGradient() { this->SetOperation(OPERATION_OUTER_GRADIENT); }
  ///@}

  ///@{
  /**
   * The structuring element, see above. Default: Box.
   */
  vtkSetClampMacro(KernelType, int, KERNEL_BOX, KERNEL_SPHERE);
  vtkGetMacro(KernelType, int);
  void SetKernelTypeToBox() { this->SetKernelType(KERNEL_BOX); }
  void SetKernelTypeToFaces6() { this->SetKernelType(KERNEL_FACES6); }
  void SetKernelTypeToEdges18() { this->SetKernelType(KERNEL_EDGES18); }
  void SetKernelTypeToCorners26() { this->SetKernelType(KERNEL_CORNERS26); }
  void SetKernelTypeToSphere() { this->SetKernelType(KERNEL_SPHERE); }
  ///@}

  ///@{
  /**
   * Voxels of a Box or a Sphere on each axis. Default: 3, 3, 3, which is one voxel to either side.
   */
  vtkSetVector3Macro(KernelSize, int);
  vtkGetVector3Macro(KernelSize, int);
  ///@}

  ///@{
  /**
   * How often to dilate and to erode. Default: 1.
   */
  vtkSetClampMacro(Iterations, int, 1, VTK_INT_MAX);
  vtkGetMacro(Iterations, int);
  ///@}

  ///@{
  /**
   * What lies beyond the grid: Neutral (default), nothing that would change a voxel, neither by a
   * dilation nor by an erosion; Empty voxels, which erode from the border; Full ones, which dilate
   * from there.
   */
  vtkSetClampMacro(BorderValue, int, BORDER_NEUTRAL, BORDER_FULL);
  vtkGetMacro(BorderValue, int);
  void SetBorderValueToNeutral() { this->SetBorderValue(BORDER_NEUTRAL); }
  void SetBorderValueToEmpty() { this->SetBorderValue(BORDER_EMPTY); }
  void SetBorderValueToFull() { this->SetBorderValue(BORDER_FULL); }
  ///@}

protected:
  vtkVoxelMorphology() = default;
  ~vtkVoxelMorphology() override = default;

  void CheckInputs(const std::vector<vtkVoxelGrid>& inputs) override;
  bool Process(const std::vector<vtkSlicemap*>& inputs, vtkSlicemap* output) override;

private:
  vtkVoxelMorphology(const vtkVoxelMorphology&) = delete;
  void operator=(const vtkVoxelMorphology&) = delete;

  int Operation = OPERATION_DILATE;
  int KernelType = KERNEL_BOX;
  int KernelSize[3] = { 3, 3, 3 };
  int Iterations = 1;
  int BorderValue = BORDER_NEUTRAL;
};

#endif
