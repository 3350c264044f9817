// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkVoxelContext
 * @brief hands out a current OpenGL context
 *
 * The filters of this module work with OpenGL. They get it from this class: from the render window
 * of the user if one is set, else from one headless context that the whole process shares. The
 * shared context is made on first use and released when the process ends; it needs neither a
 * display nor a GPU (Mesa's software renderer does).
 *
 * Where the shared context comes from, the first that works:
 * 1. EGL on a graphics card, without any display;
 * 2. EGL without a card and a display (Mesa's surfaceless platform, then the default display);
 * 3. an ordinary off-screen vtkRenderWindow: X when DISPLAY names a server, or the platform's own
 *    windows elsewhere.
 *
 * When there is none, MakeCurrent() answers false and GetErrorMessage() says what to install.
 *
 * The context asks for the core profile of the highest version from 4.6 down to 3.2.
 *
 * An OpenGL context can be current in one thread at a time, so all filters that share one must run
 * in the same thread.
 *
 * A process that forks before it has used OpenGL may use it on both sides. When it forks later, the
 * shared context is the parent's alone: in the child MakeCurrent() answers false.
 *
 * @sa vtkSlicemap vtkVoxelizer
 */

#ifndef vtkVoxelContext_h
#define vtkVoxelContext_h

#include "vtkObject.h"
#include "vtkRenderWindow.h"       // for vtkWeakPointer
#include "vtkVoxelizationModule.h" // for the export macro
#include "vtkWeakPointer.h"        // for the user's window

#include <memory> // for std::shared_ptr
#include <string> // for std::string

class vtkOpenGLRenderWindow;
class vtkVoxelContextRecord;

class VTKVOXELIZATION_EXPORT vtkVoxelContext : public vtkObject
{
public:
  static vtkVoxelContext* New();
  vtkTypeMacro(vtkVoxelContext, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The window whose OpenGL context is used. It must be a vtkOpenGLRenderWindow; it need not have
   * been rendered before. Default: nullptr, the headless context of the process.
   *
   * The window is referenced weakly, since a window often shows, and thereby owns, what a filter
   * computes with it. Once it is deleted, the headless context is used.
   */
  virtual void SetRenderWindow(vtkRenderWindow* window);
  vtkRenderWindow* GetRenderWindow();
  ///@}

  /**
   * Make the context current in this thread and leave it so. Answers whether that succeeded; if
   * not, GetErrorMessage() tells why. Nothing is printed.
   *
   * The classes of this module use vtkVoxelContext::Scope instead, which gives back what it found.
   * Others call ReleaseCurrent() of GetOpenGLRenderWindow() before an X window renders: GLX ends
   * the process when it is to take over from an EGL context.
   */
  bool MakeCurrent();

  /**
   * Why the last call failed, one sentence for the user; empty when it succeeded.
   */
  std::string GetErrorMessage() const { return this->ErrorMessage; }

  /**
   * The window that holds the context, the user's or the headless one; nullptr when there is none.
   */
  vtkOpenGLRenderWindow* GetOpenGLRenderWindow();

  /**
   * Name of the renderer as OpenGL tells it (GL_RENDERER), for instance "llvmpipe (LLVM 15.0.6, 256
   * bits)"; empty when there is no context.
   */
  std::string GetRendererName();

  /**
   * Version of OpenGL, 10 * major + minor, for instance 45; 0 when there is no context.
   */
  int GetVersion();

  /**
   * True when compute shaders, shader storage buffers and double precision are at hand: OpenGL 4.3,
   * or the three ARB extensions.
   */
  bool SupportsCompute();

  /**
   * A new window for ordinary VTK rendering off-screen, wherever the process runs: on a context of
   * its own without a display through EGL, else an off-screen vtkRenderWindow. nullptr when there
   * is no OpenGL at all. The caller deletes it.
   *
   * Rendering leaves its context current, as with all windows of VTK. A process that has X windows
   * too must call ReleaseCurrent() before those render: GLX ends the process when it is to take
   * over from an EGL context.
   */
  VTK_NEWINSTANCE
  static vtkRenderWindow* NewHeadlessRenderWindow();

#ifndef __VTK_WRAP__
  class Scope;

  /**
   * What this module keeps about the OpenGL context; two vtkVoxelContext share a context when they
   * share the record. nullptr when there is no context. For the classes of this module.
   */
  std::shared_ptr<vtkVoxelContextRecord> GetRecord();
#endif

protected:
  vtkVoxelContext();
  ~vtkVoxelContext() override;

private:
  vtkVoxelContext(const vtkVoxelContext&) = delete;
  void operator=(const vtkVoxelContext&) = delete;

  bool Prepare();

  vtkWeakPointer<vtkRenderWindow> RenderWindow;
  std::shared_ptr<vtkVoxelContextRecord> Record;
  std::string ErrorMessage;
};

#endif
