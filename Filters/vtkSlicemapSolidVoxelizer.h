// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSlicemapSolidVoxelizer
 * @brief solid voxels of closed meshes, exactly sampled, in one pass over the triangles
 *
 * A voxel is inside when a ray from its centre crosses the surface an odd number of times. The rays
 * run along the columns of the grid; a crossing flips all voxels behind it, and flips commute, so
 * that triangles may come in any order and any number of them may fall into one voxel. The method
 * is that of
 *
 * Elmar Eisemann, Xavier Decoret: Single-Pass GPU Solid Voxelization for Real-Time Applications.
 * Graphics Interface 2008, pp. 73-80; section 5.2 (solid), 5.3 (conservative).
 *
 * The Raster backend is the paper's: a fragment looks up the bit mask of the voxels behind it in a
 * small table, and masks are combined by the logic operation XOR in integer render targets, up to
 * 1,024 slices in one pass with eight targets; tiles and further passes make larger grids. Vertices
 * are snapped to 1/256 voxel across the columns, as OpenGL's rasterization does, and coordinates
 * are single precision: slivers some thousand voxels long may be off by more than that. The Compute
 * backend flips one bit where a column crosses the surface and then runs a parity scan along the
 * columns; its arithmetic is double precision.
 *
 * <b>Ties.</b> With both backends a closed mesh never leaks, since all triangles at an edge
 * evaluate the edge identically. Compute treats a solid as half open along each axis: voxel centres
 * that lie on a face at the lower end of an axis are inside, those at the upper end outside, so
 * that a box [0, 4]^3 holds exactly the centres 0, 1, 2, 3 of each axis.
 *
 * <b>Modes.</b> Center samples voxel centres. Boundary gives the voxels (closed boxes) that the
 * surface touches. OverConservative is Center or Boundary, UnderConservative Center without
 * Boundary. "Touches" errs on the safe side only: no touched voxel is ever missed, and none farther
 * from the surface than 1e-5 voxel with Compute, 1e-2 voxel with Raster, is added.
 *
 * <b>Fill rules.</b> Parity is the paper's: where closed surfaces overlap, the symmetric
 * difference. NonZero uses the winding number, and gives the union of consistently oriented closed
 * surfaces. Vote is for dirty meshes, with holes or inner walls, where a single axis leaks whole
 * columns: parity along all three axes, columns that leak abstain, and the majority wins. Where it
 * does not lead by two votes, the mesh with caps on its holes decides, cones over the edges that
 * have an odd number of polygons.
 */

#ifndef vtkSlicemapSolidVoxelizer_h
#define vtkSlicemapSolidVoxelizer_h

#include "vtkVoxelizationModule.h" // for export macro
#include "vtkVoxelizer.h"

class vtkSolidPass;

class VTKVOXELIZATION_EXPORT vtkSlicemapSolidVoxelizer : public vtkVoxelizer
{
public:
  static vtkSlicemapSolidVoxelizer* New();
  vtkTypeMacro(vtkSlicemapSolidVoxelizer, vtkVoxelizer);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ModeType
  {
    MODE_CENTER = 0,
    MODE_OVER_CONSERVATIVE = 1,
    MODE_UNDER_CONSERVATIVE = 2,
    MODE_BOUNDARY = 3
  };

  enum FillRuleType
  {
    FILL_RULE_PARITY = 0,
    FILL_RULE_NON_ZERO = 1,
    FILL_RULE_VOTE = 2
  };

  enum ColumnAxisType
  {
    COLUMN_AXIS_AUTO = -1,
    COLUMN_AXIS_X = 0,
    COLUMN_AXIS_Y = 1,
    COLUMN_AXIS_Z = 2
  };

  ///@{
  /**
   * Which voxels are set; see the class description. Default: Center.
   */
  vtkSetClampMacro(Mode, int, MODE_CENTER, MODE_BOUNDARY);
  vtkGetMacro(Mode, int);
  void SetModeToCenter() { this->SetMode(MODE_CENTER); }
  void SetModeToOverConservative() { this->SetMode(MODE_OVER_CONSERVATIVE); }
  void SetModeToUnderConservative() { this->SetMode(MODE_UNDER_CONSERVATIVE); }
  void SetModeToBoundary() { this->SetMode(MODE_BOUNDARY); }
  ///@}

  ///@{
  /**
   * What counts as inside; see the class description. Default: Parity. Mode Boundary ignores it.
   */
  vtkSetClampMacro(FillRule, int, FILL_RULE_PARITY, FILL_RULE_VOTE);
  vtkGetMacro(FillRule, int);
  void SetFillRuleToParity() { this->SetFillRule(FILL_RULE_PARITY); }
  void SetFillRuleToNonZero() { this->SetFillRule(FILL_RULE_NON_ZERO); }
  void SetFillRuleToVote() { this->SetFillRule(FILL_RULE_VOTE); }
  ///@}

  ///@{
  /**
   * Index axis along which the columns run. Auto (default) takes the one with the least work. The
   * result of a closed mesh depends on it only where voxel centres lie on the surface.
   */
  vtkSetClampMacro(ColumnAxis, int, COLUMN_AXIS_AUTO, COLUMN_AXIS_Z);
  vtkGetMacro(ColumnAxis, int);
  void SetColumnAxisToAuto() { this->SetColumnAxis(COLUMN_AXIS_AUTO); }
  void SetColumnAxisToX() { this->SetColumnAxis(COLUMN_AXIS_X); }
  void SetColumnAxisToY() { this->SetColumnAxis(COLUMN_AXIS_Y); }
  void SetColumnAxisToZ() { this->SetColumnAxis(COLUMN_AXIS_Z); }
  ///@}

  /**
   * Columns of the last run in which crossings did not cancel: 0 for a closed mesh. Columns along
   * the axis used, in the part that was asked for; all three axes together with Vote. 0 with mode
   * Boundary, which has no columns, and with CheckWatertight off.
   */
  vtkGetMacro(NumberOfLeakingColumns, vtkIdType);

protected:
  vtkSlicemapSolidVoxelizer();
  ~vtkSlicemapSolidVoxelizer() override;

  bool Voxelize(vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkSlicemap* slicemap) override;
  bool NeedsExactTriangulation() override { return this->Mode != MODE_CENTER; }
  int GetNumberOfWorkSlicemaps() override;

private:
  vtkSlicemapSolidVoxelizer(const vtkSlicemapSolidVoxelizer&) = delete;
  void operator=(const vtkSlicemapSolidVoxelizer&) = delete;

  bool FillByVote(vtkSolidPass& pass, const vtkVoxelMesh& mesh, vtkSlicemap* slicemap);
  void WarnOfLeaks();

  int Mode = MODE_CENTER;
  int FillRule = FILL_RULE_PARITY;
  int ColumnAxis = COLUMN_AXIS_AUTO;
  vtkIdType NumberOfLeakingColumns = 0;
  vtkMTimeType WarningTime = 0; // of filter and mesh that were warned of
};

#endif
