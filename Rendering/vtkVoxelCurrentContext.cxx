// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelCurrentContext.h"

#include "vtkOpenGLRenderWindow.h"

#if defined(__unix__) && !defined(__APPLE__)
#define VTK_VOXEL_HAS_EGL_AND_GLX 1
#include <dlfcn.h>
#else
#define VTK_VOXEL_HAS_EGL_AND_GLX 0
#endif

#if VTK_VOXEL_HAS_EGL_AND_GLX
namespace
{
// A function of a library that the process has loaded already; nullptr otherwise, since a window
// system that is not loaded has no context current.
template <typename Function>
void Find(Function*& function, void* library, const char* name)
{
  function = library ? reinterpret_cast<Function*>(dlsym(library, name)) : nullptr;
}

struct EGLFunctions
{
  static constexpr unsigned int Draw = 0x3059;
  static constexpr unsigned int Read = 0x305A;

  void* (*GetCurrentContext)() = nullptr;
  void* (*GetCurrentDisplay)() = nullptr;
  void* (*GetCurrentSurface)(int) = nullptr;
  unsigned int (*QueryAPI)() = nullptr;
  unsigned int (*BindAPI)(unsigned int) = nullptr;
  unsigned int (*MakeCurrent)(void*, void*, void*, void*) = nullptr;

  explicit operator bool() const { return this->MakeCurrent != nullptr; }

  static const EGLFunctions& Get()
  {
    static EGLFunctions functions;
    if (!functions)
    {
      void* library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_NOLOAD);
      Find(functions.GetCurrentContext, library, "eglGetCurrentContext");
      Find(functions.GetCurrentDisplay, library, "eglGetCurrentDisplay");
      Find(functions.GetCurrentSurface, library, "eglGetCurrentSurface");
      Find(functions.QueryAPI, library, "eglQueryAPI");
      Find(functions.BindAPI, library, "eglBindAPI");
      Find(functions.MakeCurrent, library, "eglMakeCurrent");
    }
    return functions;
  }
};

struct GLXFunctions
{
  void* (*GetCurrentContext)() = nullptr;
  void* (*GetCurrentDisplay)() = nullptr;
  unsigned long (*GetCurrentDrawable)() = nullptr;
  unsigned long (*GetCurrentReadDrawable)() = nullptr;
  int (*MakeContextCurrent)(void*, unsigned long, unsigned long, void*) = nullptr;

  explicit operator bool() const { return this->MakeContextCurrent != nullptr; }

  static const GLXFunctions& Get()
  {
    static GLXFunctions functions;
    if (!functions)
    {
      void* library = dlopen("libGLX.so.0", RTLD_LAZY | RTLD_NOLOAD);
      library = library ? library : dlopen("libGL.so.1", RTLD_LAZY | RTLD_NOLOAD);
      Find(functions.GetCurrentContext, library, "glXGetCurrentContext");
      Find(functions.GetCurrentDisplay, library, "glXGetCurrentDisplay");
      Find(functions.GetCurrentDrawable, library, "glXGetCurrentDrawable");
      Find(functions.GetCurrentReadDrawable, library, "glXGetCurrentReadDrawable");
      Find(functions.MakeContextCurrent, library, "glXMakeContextCurrent");
    }
    return functions;
  }
};

void ReleaseEGL()
{
  const EGLFunctions& egl = EGLFunctions::Get();
  if (egl && egl.GetCurrentContext())
  {
    egl.MakeCurrent(egl.GetCurrentDisplay(), nullptr, nullptr, nullptr);
  }
}
}

vtkVoxelCurrentContext::vtkVoxelCurrentContext()
{
  const EGLFunctions& egl = EGLFunctions::Get();
  if (egl && egl.GetCurrentContext())
  {
    this->EGL.Display = egl.GetCurrentDisplay();
    this->EGL.Context = egl.GetCurrentContext();
    this->EGL.Draw = reinterpret_cast<std::uintptr_t>(egl.GetCurrentSurface(EGLFunctions::Draw));
    this->EGL.Read = reinterpret_cast<std::uintptr_t>(egl.GetCurrentSurface(EGLFunctions::Read));
    this->EGL.Api = egl.QueryAPI();
  }
  const GLXFunctions& glx = GLXFunctions::Get();
  if (glx && glx.GetCurrentContext())
  {
    this->GLX.Display = glx.GetCurrentDisplay();
    this->GLX.Context = glx.GetCurrentContext();
    this->GLX.Draw = glx.GetCurrentDrawable();
    this->GLX.Read = glx.GetCurrentReadDrawable();
  }
}

bool vtkVoxelCurrentContext::operator==(const vtkVoxelCurrentContext& other) const
{
  const auto same = [](const Binding& a, const Binding& b)
  {
    return a.Display == b.Display && a.Context == b.Context && a.Draw == b.Draw && a.Read == b.Read;
  };
  return same(this->EGL, other.EGL) && same(this->GLX, other.GLX);
}

void vtkVoxelCurrentContext::Restore() const
{
  if (*this == vtkVoxelCurrentContext())
  {
    return;
  }
  vtkVoxelCurrentContext::Release();
  if (this->EGL.Context)
  {
    const EGLFunctions& egl = EGLFunctions::Get();
    egl.BindAPI(this->EGL.Api);
    egl.MakeCurrent(this->EGL.Display, reinterpret_cast<void*>(this->EGL.Draw),
      reinterpret_cast<void*>(this->EGL.Read), this->EGL.Context);
  }
  if (this->GLX.Context)
  {
    GLXFunctions::Get().MakeContextCurrent(
      this->GLX.Display, this->GLX.Draw, this->GLX.Read, this->GLX.Context);
  }
}

void vtkVoxelCurrentContext::Release()
{
  ReleaseEGL();
  vtkVoxelCurrentContext::ReleaseGLX();
}

void vtkVoxelCurrentContext::ReleaseGLX()
{
  const GLXFunctions& glx = GLXFunctions::Get();
  if (glx && glx.GetCurrentContext())
  {
    glx.MakeContextCurrent(glx.GetCurrentDisplay(), 0, 0, nullptr);
  }
}

bool vtkVoxelCurrentContext::Is(vtkOpenGLRenderWindow* window)
{
  // VTK's own EGL window always says that it is current.
  if (window->IsA("vtkEGLRenderWindow"))
  {
    const EGLFunctions& egl = EGLFunctions::Get();
    return egl && window->GetGenericContext() &&
      window->GetGenericContext() == egl.GetCurrentContext();
  }
  return window->IsCurrent();
}

vtkVoxelContextSwitch::vtkVoxelContextSwitch(vtkOpenGLRenderWindow* window)
  : Window(window)
{
  if (!vtkVoxelCurrentContext::Is(window))
  {
    vtkVoxelCurrentContext::Release();
    window->MakeCurrent();
  }
  this->Current = vtkVoxelCurrentContext::Is(window);
}

vtkVoxelContextSwitch::~vtkVoxelContextSwitch()
{
  this->Before.Restore();
}

#else // Windows and macOS: one window system, and VTK's windows know it.

vtkVoxelCurrentContext::vtkVoxelCurrentContext() = default;

bool vtkVoxelCurrentContext::operator==(const vtkVoxelCurrentContext&) const
{
  return true;
}

void vtkVoxelCurrentContext::Restore() const {}

void vtkVoxelCurrentContext::Release() {}

void vtkVoxelCurrentContext::ReleaseGLX() {}

bool vtkVoxelCurrentContext::Is(vtkOpenGLRenderWindow* window)
{
  return window->IsCurrent();
}

vtkVoxelContextSwitch::vtkVoxelContextSwitch(vtkOpenGLRenderWindow* window)
  : Window(window)
{
  window->PushContext();
  this->Current = window->IsCurrent();
}

vtkVoxelContextSwitch::~vtkVoxelContextSwitch()
{
  this->Window->PopContext();
}
#endif
