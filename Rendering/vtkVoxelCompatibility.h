// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelCompatibility.h
 * What differs between VTK 9.1 and 9.7 for this module, in one place. Private: include it in .cxx
 * files and private headers only, since it brings in the OpenGL functions.
 */

#ifndef vtkVoxelCompatibility_h
#define vtkVoxelCompatibility_h

#include "vtkAlgorithm.h"
#include "vtkVersionMacros.h"

// VTK 9.4 replaced GLEW by glad, and a window can be told since then how to find OpenGL functions.
#if __has_include("vtk_glad.h")
#include "vtk_glad.h"
#define VTK_VOXEL_USES_GLEW 0
#else
#include "vtk_glew.h"
#define VTK_VOXEL_USES_GLEW 1
#endif

// In VTK from 9.3 on, for builds of VTK that mangle their symbols.
#ifndef VTK_ABI_NAMESPACE_BEGIN
#define VTK_ABI_NAMESPACE_BEGIN
#define VTK_ABI_NAMESPACE_END
#endif

namespace vtkVoxelCompatibility
{
/**
 * True when the user asked this filter to stop. VTK 9.1 knows the filter's own flag only; later
 * versions look at the whole pipeline.
 */
inline bool CheckAbort(vtkAlgorithm* filter)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220823)
  return filter->CheckAbort();
#else
  return filter->GetAbortExecute() != 0;
#endif
}
}

#endif
// VTK-HeaderTest-Exclude: vtkVoxelCompatibility.h
