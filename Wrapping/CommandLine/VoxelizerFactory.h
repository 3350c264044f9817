// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VoxelizerFactory.h
 * Makes the voxelizer that the options ask for.
 */

#ifndef VoxelizerFactory_h
#define VoxelizerFactory_h

#include "vtkSmartPointer.h"

class Messages;
struct Options;
class vtkVoxelizer;

namespace VoxelizerFactory
{
/**
 * Without its input. Throws Failure with ExitCode::Input when the reference image or the texture
 * can't be read.
 */
vtkSmartPointer<vtkVoxelizer> Make(const Options& options, Messages& messages);
}

#endif
