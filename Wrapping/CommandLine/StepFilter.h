// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file StepFilter.h
 * Makes the filter that a step asks for.
 */

#ifndef StepFilter_h
#define StepFilter_h

#include "Options.h"

#include "vtkSmartPointer.h"

class vtkVoxelFilter;

namespace StepFilter
{
/// Without its inputs: the voxels so far, and then those of the step's file, if it has one.
vtkSmartPointer<vtkVoxelFilter> Make(const Options::Step& step);
}

#endif
