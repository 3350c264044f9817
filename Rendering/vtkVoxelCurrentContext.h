// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelCurrentContext.h
 * Private header: switching between OpenGL contexts of different windows and window systems.
 */

#ifndef vtkVoxelCurrentContext_h
#define vtkVoxelCurrentContext_h

#include "vtkVoxelizationModule.h"

#include <cstdint>

class vtkOpenGLRenderWindow;

/**
 * Which OpenGL context is current in this thread. EGL and GLX refuse to make a context current
 * while the other has one (GLX even ends the process), so the old one is released first.
 */
class VTKVOXELIZATION_EXPORT vtkVoxelCurrentContext
{
public:
  /**
   * Remembers what is current now.
   */
  vtkVoxelCurrentContext();

  /**
   * Makes it current again; nothing current, if nothing was.
   */
  void Restore() const;

  /**
   * Leaves no context current.
   */
  static void Release();

  /**
   * Leaves no GLX context current.
   */
  static void ReleaseGLX();

  /**
   * True when the context of the window is current.
   */
  static bool Is(vtkOpenGLRenderWindow* window);

  bool operator==(const vtkVoxelCurrentContext& other) const;

private:
  struct Binding
  {
    void* Display = nullptr;
    void* Context = nullptr;
    std::uintptr_t Draw = 0;
    std::uintptr_t Read = 0;
    unsigned int Api = 0;
  };
  Binding EGL;
  Binding GLX;
};

/**
 * Makes the context of a window current as long as it lives.
 */
class vtkVoxelContextSwitch
{
public:
  explicit vtkVoxelContextSwitch(vtkOpenGLRenderWindow* window);
  ~vtkVoxelContextSwitch();
  vtkVoxelContextSwitch(const vtkVoxelContextSwitch&) = delete;
  vtkVoxelContextSwitch& operator=(const vtkVoxelContextSwitch&) = delete;

  explicit operator bool() const { return this->Current; }

private:
  vtkVoxelCurrentContext Before;
  vtkOpenGLRenderWindow* Window;
  bool Current;
};

#endif
// VTK-HeaderTest-Exclude: vtkVoxelCurrentContext.h
