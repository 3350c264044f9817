// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkSlicemapExpressionPass.h
 * Private header: works out Boolean expressions of slicemaps on the GPU.
 *
 * An expression runs as one pass that reads every word of its inputs once, however often they are
 * named, and writes every word of the result once. Where there are more inputs than the context has
 * texture units, parts of it become intermediate slicemaps.
 */

#ifndef vtkSlicemapExpressionPass_h
#define vtkSlicemapExpressionPass_h

#include "vtkVoxelGLObjects.h"

#include <vector>

class vtkSlicemap;
class vtkSlicemapExpression;

namespace vtkSlicemapExpressionPass
{
/**
 * Fills `target`, which is allocated on the grid of the inputs and may be one of them, in the
 * current context. Throws std::runtime_error.
 */
void Run(const vtkSlicemapExpression& expression, const vtkVoxelGL::Context& context,
  const std::vector<vtkSlicemap*>& inputs, vtkSlicemap* target);
}

#endif
// VTK-HeaderTest-Exclude: vtkSlicemapExpressionPass.h
