// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkVoxelMeshRepair
 * @brief drops the polygons of a mesh that keep its solid from being voxelized
 *
 * Meshes made for pictures often have each polygon twice, once for either side, or several times.
 * Voxelizers that count crossings see all pairs cancel, and find nothing. This filter leaves one
 * of the polygons that have the same corners, as
 *
 * GPU-Based Framework for Training 3D Convolutional Neural Networks with Voxelized Polygonal
 * Models, section IV
 *
 * did for ModelNet, where the merged polygons close the mesh, and none where they are a wall within
 * the solid, such as between two boxes side by side. Corners are the same when their coordinates
 * are equal; polygons may begin at any of them.
 *
 * The input is a vtkPolyData, or a composite dataset of them, whose leaves become one. The output
 * has the points of the input as they are, all vertices and lines, and the polygons that are left,
 * in their order and with their cell data; triangle strips become triangles.
 *
 * A polygon that is left out is counted once, as one of these:
 *  - degenerate: it has less than three different corners, or no area (less than 1e-12 of the
 * square of its longest edge). One without an area stays where edges would be open without it;
 *  - duplicate: one with the same corners in the same order stays;
 *  - opposite: one with the same corners in the opposite order, the first of the mesh, stays;
 *  - wall: several have the same corners, and none stays. So it is when this leaves more edges
 *    with an even number of polygons than otherwise, of those where other polygons meet; polygons
 *    that hang together are decided on at once, the smallest parts first.
 *
 * Holes are not filled, and cracks between unequal corners not sewn: see vtkFillHolesFilter and
 * vtkCleanPolyData.
 *
 * <b>Errors.</b> One error, and an empty output: a polygon with a point that does not exist.
 *
 * @sa vtkTetraCoveringVoxelizer vtkSlicemapSolidVoxelizer vtkCleanPolyData
 */

#ifndef vtkVoxelMeshRepair_h
#define vtkVoxelMeshRepair_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkVoxelizationModule.h" // for export macro

#include <string> // for the summary

class VTKVOXELIZATION_EXPORT vtkVoxelMeshRepair : public vtkPolyDataAlgorithm
{
public:
  static vtkVoxelMeshRepair* New();
  vtkTypeMacro(vtkVoxelMeshRepair, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Polygons of the input of the last run, the triangles of strips among them, and how many of them
   * were left out, for which reason.
   */
  vtkGetMacro(NumberOfPolygons, vtkIdType);
  vtkGetMacro(NumberOfDegenerates, vtkIdType);
  vtkGetMacro(NumberOfDuplicates, vtkIdType);
  vtkGetMacro(NumberOfOpposites, vtkIdType);
  vtkGetMacro(NumberOfWalls, vtkIdType);
  ///@}

  /**
   * All of them.
   */
  vtkIdType GetNumberOfDroppedPolygons() const;

  /**
   * The same as one line of text.
   */
  std::string GetSummary() const;

protected:
  vtkVoxelMeshRepair() = default;
  ~vtkVoxelMeshRepair() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  vtkExecutive* CreateDefaultExecutive() override;

private:
  vtkVoxelMeshRepair(const vtkVoxelMeshRepair&) = delete;
  void operator=(const vtkVoxelMeshRepair&) = delete;

  vtkIdType NumberOfPolygons = 0;
  vtkIdType NumberOfDegenerates = 0;
  vtkIdType NumberOfDuplicates = 0;
  vtkIdType NumberOfOpposites = 0;
  vtkIdType NumberOfWalls = 0;
};

#endif
