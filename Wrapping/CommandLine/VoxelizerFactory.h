// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VoxelizerFactory.h
 * Makes the voxelizers that the options ask for.
 */

#ifndef VoxelizerFactory_h
#define VoxelizerFactory_h

#include "vtkSmartPointer.h"

class Messages;
struct Options;
class vtkImageData;
class vtkVoxelAlgorithm;
class vtkVoxelizer;

namespace VoxelizerFactory
{
/**
 * Without its input. Throws Failure with ExitCode::Input when the reference image or the texture
 * can't be read.
 */
vtkSmartPointer<vtkVoxelizer> Make(const Options& options, Messages& messages);

/// The same by the same method, on the grid of an image; not turned, scaled or displaced.
vtkSmartPointer<vtkVoxelizer> MakeOnGrid(const Options& options, vtkImageData* grid);

/// Gives the filter whose result is written the form of output that the options ask for.
void SetOutput(vtkVoxelAlgorithm* algorithm, const Options& options);
}

#endif
