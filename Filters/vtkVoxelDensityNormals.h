// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkVoxelDensityNormals
 * @brief how much of the space around each voxel is filled, and the normals that follow from it
 *
 * Density is the number of voxels set in a box of KernelSize voxels, or its fraction of the box
 * (DensityType). It changes gradually across the surface, like a distance to it that is known near
 * the surface only.
 *
 * With Downsample the boxes lie side by side, and the output is a grid as many times as coarse, of
 * one value a box. Its indices begin at 0, and its points are the centres of the boxes; boxes that
 * reach beyond the input go on in empty voxels. Without, the output is on the grid of the input,
 * and the box of a voxel reaches from KernelSize / 2 voxels before it to KernelSize / 2 - 1 behind
 * it: as everywhere in this module, of an even size the side of smaller indices is the longer one.
 *
 * Normals are the normalised negative gradient of the density, in world coordinates: they point out
 * of the solid. Where the density is constant they are zero. At the border of the grid the density
 * goes on as it is there.
 *
 * <b>Output.</b> An image with the active scalars "Density" (float, or for counts unsigned char
 * where the box has up to 128 voxels and unsigned short above) and the active normals "Normals" (3
 * floats), on points or cells as OutputAttributeType says. It is for the host, and carries no
 * slicemap; ForegroundValue and OutputScalarType mean nothing here. The bits are read as they are
 * on the GPU, and the counts read back once.
 *
 * <b>Errors.</b> One error, and an empty output: those of vtkVoxelFilter; a KernelSize that is no
 * power of two or above 32; HostOutput off.
 *
 * Packed sums of many voxels at once, downsampling and normals from the density are after
 *
 * Elmar Eisemann, Xavier Decoret: Single-Pass GPU Solid Voxelization for Real-Time Applications.
 * Graphics Interface 2008, pp. 73-80, section 6.
 *
 * @sa vtkVoxelFilter vtkVoxelMorphology vtkSlicemap
 */

#ifndef vtkVoxelDensityNormals_h
#define vtkVoxelDensityNormals_h

#include "vtkVoxelFilter.h"
#include "vtkVoxelizationModule.h" // for export macro

class VTKVOXELIZATION_EXPORT vtkVoxelDensityNormals : public vtkVoxelFilter
{
public:
  static vtkVoxelDensityNormals* New();
  vtkTypeMacro(vtkVoxelDensityNormals, vtkVoxelFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Density
  {
    DENSITY_FRACTION = 0,
    DENSITY_COUNT = 1
  };

  enum Normals
  {
    NORMALS_OFF = 0,
    NORMALS_SYMMETRIC = 1,
    NORMALS_ONE_SIDED = 2
  };

  ///@{
  /**
   * Voxels of the box on each axis: 1, 2, 4, 8, 16 or 32. Default: 2, 2, 2.
   */
  vtkSetVector3Macro(KernelSize, int);
  vtkGetVector3Macro(KernelSize, int);
  ///@}

  ///@{
  /**
   * Whether there is one value for each box of the grid, instead of one for each voxel. Default:
   * off.
   */
  vtkSetMacro(Downsample, bool);
  vtkGetMacro(Downsample, bool);
  vtkBooleanMacro(Downsample, bool);
  ///@}

  ///@{
  /**
   * Fraction, from 0 to 1 (default), or Count.
   */
  vtkSetClampMacro(DensityType, int, DENSITY_FRACTION, DENSITY_COUNT);
  vtkGetMacro(DensityType, int);
  void SetDensityTypeToFraction() { this->SetDensityType(DENSITY_FRACTION); }
  void SetDensityTypeToCount() { this->SetDensityType(DENSITY_COUNT); }
  ///@}

  ///@{
  /**
   * No normals; or those of Symmetric differences between the voxels on both sides (default); or of
   * OneSided differences between a voxel and the next ones, which see finer details and are
   * noisier.
   */
  vtkSetClampMacro(NormalMode, int, NORMALS_OFF, NORMALS_ONE_SIDED);
  vtkGetMacro(NormalMode, int);
  void SetNormalModeToOff() { this->SetNormalMode(NORMALS_OFF); }
  void SetNormalModeToSymmetric() { this->SetNormalMode(NORMALS_SYMMETRIC); }
  void SetNormalModeToOneSided() { this->SetNormalMode(NORMALS_ONE_SIDED); }
  ///@}

protected:
  vtkVoxelDensityNormals() = default;
  ~vtkVoxelDensityNormals() override = default;

  void CheckInputs(const std::vector<vtkVoxelGrid>& inputs) override;
  vtkVoxelGrid GetOutputGrid(const vtkVoxelGrid& input) override;
  std::int64_t GetBytesOfOutput(const vtkVoxelGrid& grid) override;
  bool Execute(
    const std::vector<vtkSlicemap*>& inputs, const std::vector<vtkImageData*>& outputs) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkVoxelDensityNormals(const vtkVoxelDensityNormals&) = delete;
  void operator=(const vtkVoxelDensityNormals&) = delete;

  int GetScalarType() const;

  int KernelSize[3] = { 2, 2, 2 };
  bool Downsample = false;
  int DensityType = DENSITY_FRACTION;
  int NormalMode = NORMALS_SYMMETRIC;
};

#endif
