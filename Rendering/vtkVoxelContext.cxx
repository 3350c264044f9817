// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelContext.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkSmartPointer.h"
#include "vtkVoxelCompatibility.h"
#include "vtkVoxelContextRecord.h"
#include "vtkVoxelContextScope.h"
#include "vtkVoxelCurrentContext.h"
#include "vtkVoxelEGLRenderWindow.h"
#include "vtkVoxelGLState.h"

#if defined(__unix__) && !defined(__APPLE__)
#include <dlfcn.h>
#endif
#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#endif

vtkStandardNewMacro(vtkVoxelContext);

namespace
{
const char* const NoOpenGL =
  "There is no OpenGL: install Mesa's EGL and software renderer (on Debian: libegl1 libegl-mesa0 "
  "libgl1-mesa-dri), or set DISPLAY to an X server with GLX.";

const char* const Forked =
  "The process was forked after it had used OpenGL, whose threads are not in the new process: fork "
  "before the first use, or start the process anew (in Python: the method \"spawn\" of "
  "multiprocessing).";

// Whether this is the process that made the object, and not one forked from it.
class HomeProcess
{
public:
#if defined(__unix__) || defined(__APPLE__)
  bool IsHere() const
  {
    return getpid() == this->Id;
  }

private:
  pid_t Id = getpid();
#else
  bool IsHere() const
  {
    return true;
  }
#endif
};

// Keeps VTK from printing and from ending the process, as its windows do on a bad display.
class Quietly
{
public:
  explicit Quietly(vtkRenderWindow* window)
    : Window(window)
    , Warnings(vtkObject::GetGlobalWarningDisplay())
  {
    vtkObject::GlobalWarningDisplayOff();
    this->Observer->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
    this->Tag = window->AddObserver(vtkCommand::ExitEvent, this->Observer);
  }
  ~Quietly()
  {
    this->Window->RemoveObserver(this->Tag);
    vtkObject::SetGlobalWarningDisplay(this->Warnings);
  }
  Quietly(const Quietly&) = delete;
  Quietly& operator=(const Quietly&) = delete;

private:
  vtkRenderWindow* Window;
  int Warnings;
  vtkNew<vtkCallbackCommand> Observer;
  unsigned long Tag;
};

// A connection to the X server that DISPLAY names; VTK may end the process where there is none.
// Keep it until VTK has its own, since servers that start over when the last client leaves refuse
// clients meanwhile. Platforms that do not know X need none.
class XConnection
{
public:
#if defined(__unix__) && !defined(__APPLE__)
  XConnection()
  {
    if (void* library = dlopen("libX11.so.6", RTLD_LAZY | RTLD_LOCAL))
    {
      const auto open = reinterpret_cast<void* (*)(const char*)>(dlsym(library, "XOpenDisplay"));
      this->Close = reinterpret_cast<int (*)(void*)>(dlsym(library, "XCloseDisplay"));
      this->Display = open && this->Close ? open(nullptr) : nullptr;
    }
  }
  ~XConnection()
  {
    if (this->Display)
    {
      this->Close(this->Display);
    }
  }
  explicit operator bool() const
  {
    return this->Display != nullptr;
  }
#else
  XConnection() = default;
  explicit operator bool() const
  {
    return true;
  }
#endif
  XConnection(const XConnection&) = delete;
  XConnection& operator=(const XConnection&) = delete;

private:
  void* Display = nullptr;
  int (*Close)(void*) = nullptr;
};

bool IsInitialized(vtkOpenGLRenderWindow* window)
{
  int major = 0;
  int minor = 0;
  window->GetOpenGLVersion(major, minor);
  return major >= 3;
}

bool SwitchTo(vtkOpenGLRenderWindow* window)
{
  if (!vtkVoxelCurrentContext::Is(window))
  {
    vtkVoxelCurrentContext::Release();
    window->MakeCurrent();
  }
  return vtkVoxelCurrentContext::Is(window);
}

// Makes sure that the window has a context that VTK can use, which is current then.
bool InitializeWindow(vtkOpenGLRenderWindow* window)
{
  if (!vtkVoxelCurrentContext::Is(window))
  {
    vtkVoxelCurrentContext::Release();
  }
  std::unique_ptr<XConnection> server;
  if (window->IsA("vtkXOpenGLRenderWindow") && !window->GetGenericDisplayId())
  {
    server = std::make_unique<XConnection>();
    if (!*server)
    {
      return false;
    }
  }
  const Quietly quietly(window);
  window->Initialize();
  if (!SwitchTo(window))
  {
    return false;
  }
  // Windows whose context the application makes do not initialize themselves.
  if (!IsInitialized(window))
  {
    window->OpenGLInit();
  }
  return IsInitialized(window);
}

vtkSmartPointer<vtkOpenGLRenderWindow> NewWindowOfPlatform()
{
  const XConnection server;
  if (!server)
  {
    return nullptr;
  }
  vtkVoxelCurrentContext::Release();
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetOffScreenRendering(1);
  vtkSmartPointer<vtkOpenGLRenderWindow> result = vtkOpenGLRenderWindow::SafeDownCast(window);
  return result && InitializeWindow(result) ? result : nullptr;
}

vtkSmartPointer<vtkOpenGLRenderWindow> NewHeadlessWindow()
{
  const vtkVoxelCurrentContext before;
  vtkSmartPointer<vtkOpenGLRenderWindow> window = vtkSmartPointer<vtkVoxelEGLRenderWindow>::New();
  if (!InitializeWindow(window))
  {
    window = NewWindowOfPlatform();
  }
  before.Restore();
  return window;
}

// The headless window of the process. It is made before this object is complete, so that what the
// drivers registered to run at exit runs after its destructor.
class SharedWindow
{
public:
  static SharedWindow& Get()
  {
    static SharedWindow shared;
    return shared;
  }

  vtkOpenGLRenderWindow* GetWindow() const { return this->Window; }

  bool IsOfThisProcess() const { return this->Home.IsHere(); }

  bool Renew()
  {
    this->Window = nullptr;
    this->Window = NewHeadlessWindow();
    return this->Window != nullptr;
  }

private:
  SharedWindow() { this->Renew(); }

  const HomeProcess Home;
  vtkSmartPointer<vtkOpenGLRenderWindow> Window;
};

const char* NameOfError(GLenum error)
{
  switch (error)
  {
    case GL_INVALID_ENUM:
      return "invalid enumerant";
    case GL_INVALID_VALUE:
      return "invalid value";
    case GL_INVALID_OPERATION:
      return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "invalid framebuffer operation";
    case GL_OUT_OF_MEMORY:
      return "out of memory";
    default:
      return "unknown error";
  }
}

// The first error since the last call. A lost context may go on reporting errors for ever.
GLenum TakeError()
{
  const GLenum first = glGetError();
  for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i)
  {
  }
  return first;
}
}

vtkVoxelContext::vtkVoxelContext() = default;

vtkVoxelContext::~vtkVoxelContext() = default;

void vtkVoxelContext::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RenderWindow: " << this->RenderWindow.GetPointer() << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
}

void vtkVoxelContext::SetRenderWindow(vtkRenderWindow* window)
{
  if (this->RenderWindow != window)
  {
    this->RenderWindow = window;
    this->Record.reset();
    this->Modified();
  }
}

vtkRenderWindow* vtkVoxelContext::GetRenderWindow()
{
  return this->RenderWindow;
}

bool vtkVoxelContext::Prepare()
{
  this->ErrorMessage.clear();
  vtkOpenGLRenderWindow* window = nullptr;
  if (this->RenderWindow)
  {
    window = vtkOpenGLRenderWindow::SafeDownCast(this->RenderWindow);
    if (!window)
    {
      this->ErrorMessage = std::string("The render window is a ") +
        this->RenderWindow->GetClassName() +
        ", which has no OpenGL context: set a vtkOpenGLRenderWindow, or none.";
      return false;
    }
  }
  else
  {
    window = SharedWindow::Get().GetWindow();
    if (!window || !SharedWindow::Get().IsOfThisProcess())
    {
      this->ErrorMessage = window ? Forked : NoOpenGL;
      return false;
    }
  }

  if (this->Record && this->Record->GetWindow() == window)
  {
    return true;
  }
  this->Record.reset();
  const vtkVoxelCurrentContext before;
  if (InitializeWindow(window))
  {
    this->Record = vtkVoxelContextRecord::ForWindow(window);
  }
  else
  {
    this->ErrorMessage =
      "The render window has no OpenGL 3.2 context: initialize it first, or set none.";
  }
  before.Restore();
  return this->Record != nullptr;
}

bool vtkVoxelContext::MakeCurrent()
{
  if (!this->Prepare())
  {
    return false;
  }
  if (SwitchTo(this->Record->GetWindow()))
  {
    return true;
  }
  // Whoever uses the same EGL display may have closed it under the headless window.
  const bool renewed = !this->RenderWindow && SharedWindow::Get().Renew() && this->Prepare();
  if (renewed && SwitchTo(this->Record->GetWindow()))
  {
    return true;
  }
  this->ErrorMessage = "The OpenGL context of the render window cannot be made current.";
  return false;
}

vtkOpenGLRenderWindow* vtkVoxelContext::GetOpenGLRenderWindow()
{
  return this->Prepare() ? this->Record->GetWindow() : nullptr;
}

std::string vtkVoxelContext::GetRendererName()
{
  return this->Prepare() ? this->Record->GetRendererName() : std::string();
}

int vtkVoxelContext::GetVersion()
{
  return this->Prepare() ? this->Record->GetVersion() : 0;
}

bool vtkVoxelContext::SupportsCompute()
{
  return this->Prepare() && this->Record->SupportsCompute();
}

std::shared_ptr<vtkVoxelContextRecord> vtkVoxelContext::GetRecord()
{
  return this->Prepare() ? this->Record : nullptr;
}

vtkRenderWindow* vtkVoxelContext::NewHeadlessRenderWindow()
{
  vtkSmartPointer<vtkOpenGLRenderWindow> window = NewHeadlessWindow();
  if (window)
  {
    window->Register(nullptr);
  }
  return window;
}

struct vtkVoxelContext::Scope::SavedContext
{
  vtkVoxelCurrentContext Before;
  std::shared_ptr<vtkVoxelContextRecord> Record;
  std::unique_ptr<vtkVoxelGLState> State;
};

vtkVoxelContext::Scope::Scope(vtkVoxelContext* context)
  : Context(context)
{
  auto saved = std::make_unique<SavedContext>();
  if (!context->MakeCurrent())
  {
    saved->Before.Restore();
    return;
  }
  TakeError();
  saved->Record = context->Record;
  saved->State = std::make_unique<vtkVoxelGLState>(*context->Record);
  this->Saved = std::move(saved);
}

vtkVoxelContext::Scope::~Scope()
{
  if (!this->Saved)
  {
    return;
  }
  if (!this->Check("working"))
  {
    vtkErrorWithObjectMacro(this->Context, << this->Context->ErrorMessage);
  }
  this->Saved->State->Restore();
  this->Saved->Before.Restore();
}

bool vtkVoxelContext::Scope::Check(const std::string& doing)
{
  const GLenum error = TakeError();
  if (error == GL_NO_ERROR)
  {
    return true;
  }
  this->Context->ErrorMessage =
    std::string("OpenGL reports \"") + NameOfError(error) + "\" while " + doing + ".";
  return false;
}
