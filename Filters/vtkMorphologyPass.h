// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkMorphologyPass.h
 * Private header: dilation and erosion of the bits of a slicemap, 128 voxels at a time.
 *
 * A box is done axis by axis, in passes that make lines at most four times as long as they were, so
 * that the cost grows with the logarithm of its size; along x the first pass makes lines of up to
 * 63 voxels. Any other element is a list of rows along x.
 */

#ifndef vtkMorphologyPass_h
#define vtkMorphologyPass_h

#include "vtkVoxelGLObjects.h"

#include <functional>
#include <glm/glm.hpp>
#include <vector>

class vtkSlicemap;

class vtkMorphologyPass
{
public:
  /// Voxels of an element in one row along x, relative to its centre; First <= 0 <= Last.
  struct Row
  {
    int Y;
    int Z;
    int First;
    int Last;
  };

  /// Which voxels around one count, itself among them: a box, or rows.
  struct Element
  {
    glm::ivec3 First{ 0 }; ///< of the box, none above 0
    glm::ivec3 Last{ 0 };  ///< of the box, none below 0
    std::vector<Row> Rows; ///< instead of the box, if there are any

    static constexpr int LongestRow = 31; ///< to either side

    Element Mirrored() const;
    /// The same as so many times in a row; of a box only.
    Element Repeated(int times) const;
  };

  enum class Operation
  {
    Dilate,
    Erode
  };

  /// Voxels beyond the grid.
  enum class Border
  {
    Neutral, ///< never change anything
    Empty,
    Full
  };

  using Progress = std::function<bool(double)>;

  vtkMorphologyPass(vtkVoxelGL::Context context, Border border);

  /// Makes `result`, which may hold anything, from `source`, another slicemap on the same context.
  /// Throws std::runtime_error when there is no memory.
  void Run(
    Operation operation, const Element& element, vtkSlicemap* source, vtkSlicemap* result) const;

private:
  struct Step;
  std::vector<Step> GetSteps(const Element& element) const;
  void RunStep(const Step& step, Operation operation, vtkSlicemap* source, vtkSlicemap* partial,
    vtkSlicemap* target) const;

  vtkVoxelGL::Context Context;
  Border Beyond;
};

#endif
// VTK-HeaderTest-Exclude: vtkMorphologyPass.h
