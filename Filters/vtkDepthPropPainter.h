// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkDepthPropPainter.h
 * Private header: lets VTK draw props into depth buffers.
 */

#ifndef vtkDepthPropPainter_h
#define vtkDepthPropPainter_h

#include "vtkType.h"

#include <functional>
#include <vector>

class vtkDepthBuffers;
class vtkOpenGLRenderWindow;
class vtkProp;
class vtkVoxelContext;

namespace vtkDepthPropPainter
{
/// Throws std::runtime_error with a message for the user when the prop can't be seen in a depth
/// buffer.
void Check(vtkProp* prop);

/// When a change last happened to what a buffer sees of the prop: to itself, its parts, mappers,
/// data and shaders.
vtkMTimeType GetTime(vtkProp* prop);

/// Draws the opaque surfaces of the props, which are checked, into all buffers that are not drawn
/// yet, in the window of the context; call it outside of a vtkVoxelContext::Scope. Whatever was
/// current before is afterwards. What the props keep in other windows is given back first, and so
/// is afterwards what they would keep in the headless one, since windows of different window
/// systems can't reach each other's. False when stopped: `goOn` is asked after each buffer. Throws
/// std::runtime_error.
bool Draw(const std::vector<vtkProp*>& props, const vtkDepthBuffers& buffers,
  vtkVoxelContext* context, const std::function<bool()>& goOn);
}

#endif
// VTK-HeaderTest-Exclude: vtkDepthPropPainter.h
