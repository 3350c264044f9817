// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkVoxelConnectivity
 * @brief fills the holes of voxels, or keeps the largest of their components
 *
 * Connectivity says which set voxels hold together: 6, those that share a face; 18, or an edge; 26,
 * or a corner. Unset voxels hold together the opposite way, as the topology of grids wants it, so
 * that a closed wall of voxels always has two sides:
 * | Connectivity of set voxels | of unset ones |
 * | --- | --- |
 * | 6 | 26 |
 * | 18 | 6 |
 * | 26 | 6 |
 *
 * A hole is a component of unset voxels that does not reach the border of the grid; so those of a
 * grid that is one or two voxels thin have none. Whatever lies in a hole is kept. With 26 the holes
 * are those of scipy.ndimage.binary_fill_holes. A surface of vtkHybridSurfaceVoxelizer of
 * Separability 6 is filled with 26, one of Separability 26 with either.
 *
 * The largest component is the one with most voxels; of several of those the one with the first
 * voxel, where x counts before y, and y before z. Without set voxels there is none, and the output
 * is empty.
 *
 * The bits are read back once, as packed as they are; the components are found on the host, and the
 * result is sent to the GPU. The cost grows with the number of runs of voxels along x, and so does
 * the memory, 21 bytes a run.
 *
 * <b>Errors.</b> One error, and an empty output: those of vtkVoxelFilter, and runs that take more
 * than MemoryLimit, or than is free.
 *
 * Pairs of connectivities are after T. Yung Kong, Azriel Rosenfeld: Digital Topology: Introduction
 * and Survey. Computer Vision, Graphics, and Image Processing 48(3), 1989, pp. 357-393; components
 * of runs after Lifeng He, Yuyan Chao, Kenji Suzuki: A Run-Based Two-Scan Labeling Algorithm. IEEE
 * Transactions on Image Processing 17(5), 2008, pp. 749-756.
 *
 * @sa vtkVoxelFilter vtkVoxelMorphology vtkImageConnectivityFilter
 */

#ifndef vtkVoxelConnectivity_h
#define vtkVoxelConnectivity_h

#include "vtkVoxelFilter.h"
#include "vtkVoxelizationModule.h" // for export macro

class VTKVOXELIZATION_EXPORT vtkVoxelConnectivity : public vtkVoxelFilter
{
public:
  static vtkVoxelConnectivity* New();
  vtkTypeMacro(vtkVoxelConnectivity, vtkVoxelFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum OperationType
  {
    OPERATION_FILL_HOLES = 0,
    OPERATION_KEEP_LARGEST = 1
  };

  ///@{
  /**
   * FillHoles (default): sets the voxels of all holes; KeepLargest: clears all but the largest
   * component.
   */
  vtkSetClampMacro(Operation, int, OPERATION_FILL_HOLES, OPERATION_KEEP_LARGEST);
  vtkGetMacro(Operation, int);
  void SetOperationToFillHoles() { this->SetOperation(OPERATION_FILL_HOLES); }
  void SetOperationToKeepLargest() { this->SetOperation(OPERATION_KEEP_LARGEST); }
  ///@}

  ///@{
  /**
   * Neighbours of a set voxel: 6, 18 or 26 (default), see above; anything else is refused with an
   * error.
   */
  virtual void SetConnectivity(int connectivity);
  vtkGetMacro(Connectivity, int);
  void SetConnectivityTo6() { this->SetConnectivity(6); }
  void SetConnectivityTo18() { this->SetConnectivity(18); }
  void SetConnectivityTo26() { this->SetConnectivity(26); }
  ///@}

  /**
   * Components that the last run has found: the holes that it has filled, or all components of set
   * voxels, whose largest it has kept. -1 before any run, or after an error.
   */
  vtkIdType GetNumberOfComponents();

protected:
  vtkVoxelConnectivity() = default;
  ~vtkVoxelConnectivity() override = default;

  bool Process(const std::vector<vtkSlicemap*>& inputs, vtkSlicemap* output) override;

private:
  vtkVoxelConnectivity(const vtkVoxelConnectivity&) = delete;
  void operator=(const vtkVoxelConnectivity&) = delete;

  int Operation = OPERATION_FILL_HOLES;
  int Connectivity = 26;
  vtkIdType NumberOfComponents = -1;
};

#endif
