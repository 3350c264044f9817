// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelContextScope.h
 * Private header: vtkVoxelContext::Scope, in which the passes call OpenGL.
 */

#ifndef vtkVoxelContextScope_h
#define vtkVoxelContextScope_h

#include "vtkVoxelContext.h"

/**
 * Makes a context current as long as it lives, and then restores both the context that was current
 * before and the OpenGL state of this one.
 *
 * Inside, the state is the initial one of OpenGL, whatever the user's window had: no capability is
 * enabled, all masks let everything through, nothing is bound, pixels are packed with alignment 1,
 * and the error flag is clear. vtkOpenGLState still caches what was there before, so call OpenGL
 * directly inside, and leave the scope before VTK renders.
 *
 * What is restored: see vtkVoxelGLState.
 *
 * @code
 * vtkVoxelContext::Scope scope(context);
 * if (!scope)
 * {
 *   vtkErrorMacro(<< context->GetErrorMessage());
 *   return 0;
 * }
 * ... OpenGL ...
 * if (!scope.Check("voxelizing"))
 * {
 *   vtkErrorMacro(<< context->GetErrorMessage());
 *   return 0;
 * }
 * @endcode
 */
class VTKVOXELIZATION_EXPORT vtkVoxelContext::Scope
{
public:
  explicit Scope(vtkVoxelContext* context);
  /**
   * Restores everything. An error of OpenGL that no Check() has seen is reported through the
   * vtkErrorMacro of the context.
   */
  ~Scope();
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;

  /**
   * True when the context is current.
   */
  explicit operator bool() const { return this->Saved != nullptr; }

  /**
   * Reads and clears OpenGL's error flag. False when it was set: then the error message of the
   * context says what happened while doing what.
   */
  bool Check(const std::string& doing);

private:
  struct SavedContext;
  vtkVoxelContext* Context;
  std::unique_ptr<SavedContext> Saved;
};

#endif
// VTK-HeaderTest-Exclude: vtkVoxelContextScope.h
