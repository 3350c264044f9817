// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VoxelColors.h
 * The colours of voxels in pictures.
 */

#ifndef VoxelColors_h
#define VoxelColors_h

#include "vtkType.h"

#include <glm/glm.hpp>
#include <vector>

class VoxelSet;
class vtkDataArray;

/**
 * Colours for the values of an attribute, in linear red, green and blue: bytes are colours, other
 * numbers run from blue, the least of the set voxels, to red; vectors count by their length.
 */
class VoxelColors
{
public:
  VoxelColors(const VoxelSet& voxels, vtkDataArray* attribute);

  glm::dvec3 Get(vtkIdType tuple) const;

private:
  double GetLength(vtkIdType tuple) const;

  vtkDataArray* Attribute;
  bool AreBytes;
  double Low;
  double High;
  std::vector<glm::dvec3> Table;
};

#endif
