// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VolumeFilter.h
 * Makes the filter that turns a volume into voxels.
 */

#ifndef VolumeFilter_h
#define VolumeFilter_h

#include "vtkSmartPointer.h"

struct Options;
class vtkVoxelFilter;

namespace VolumeFilter
{
/**
 * Without its input. Its voxels have scalars in the range that the options ask for, or else ones
 * that are not zero; they are the points of the output, though they may be cells of the input.
 */
vtkSmartPointer<vtkVoxelFilter> Make(const Options& options);
}

#endif
