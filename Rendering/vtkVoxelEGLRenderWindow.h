// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkVoxelEGLRenderWindow
 * @brief off-screen render window on an EGL context, without a display
 *
 * Private class. VTK 9.1 as Debian builds it has X windows only; this window is what the headless
 * context of vtkVoxelContext is made of. libEGL is opened at run time, so that the module loads
 * where there is none.
 *
 * The EGL display is kept initialized until the process ends, since others in the process may use
 * the same one.
 */

#ifndef vtkVoxelEGLRenderWindow_h
#define vtkVoxelEGLRenderWindow_h

#include "vtkOpenGLRenderWindow.h"
#include "vtkVoxelCurrentContext.h"

#include <stack>

class vtkVoxelEGLRenderWindow : public vtkOpenGLRenderWindow
{
public:
  static vtkVoxelEGLRenderWindow* New();
  vtkTypeMacro(vtkVoxelEGLRenderWindow, vtkOpenGLRenderWindow);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Creates the context. Prints nothing when that fails; IsReady() tells.
   */
  void Initialize() override;
  void Finalize() override;

  /**
   * True when there is a context that VTK can use.
   */
  bool IsReady() const { return this->Context != nullptr && this->Initialized; }

  void MakeCurrent() override;
  bool IsCurrent() override;
  void ReleaseCurrent() override;
  void PushContext() override;
  void PopContext() override;

  void OpenGLInitContext() override;
  int SupportsOpenGL() override;
  vtkTypeBool IsDirect() override { return 1; }
  vtkTypeBool GetEventPending() override { return 0; }
  int* GetScreenSize() override;

  void* GetGenericDisplayId() override { return this->Display; }
  void* GetGenericContext() override { return this->Context; }
  void* GetGenericWindowId() override { return nullptr; }
  void* GetGenericParentId() override { return nullptr; }
  void* GetGenericDrawable() override { return nullptr; }

  ///@{
  /**
   * There is nothing on a screen to set.
   */
  void SetDisplayId(void*) override {}
  void SetWindowId(void*) override {}
  void SetNextWindowId(void*) override {}
  void SetParentId(void*) override {}
  void SetWindowInfo(const char*) override {}
  void SetNextWindowInfo(const char*) override {}
  void SetParentInfo(const char*) override {}
  void SetFullScreen(vtkTypeBool) override {}
  void WindowRemap() override {}
  void HideCursor() override {}
  void ShowCursor() override {}
  ///@}

protected:
  vtkVoxelEGLRenderWindow();
  ~vtkVoxelEGLRenderWindow() override;

  void CreateAWindow() override;
  void DestroyWindow() override;

private:
  vtkVoxelEGLRenderWindow(const vtkVoxelEGLRenderWindow&) = delete;
  void operator=(const vtkVoxelEGLRenderWindow&) = delete;

  void* Display = nullptr;
  void* Surface = nullptr;
  void* Context = nullptr;
  std::stack<vtkVoxelCurrentContext> Pushed;
};

#endif
// VTK-HeaderTest-Exclude: vtkVoxelEGLRenderWindow.h
