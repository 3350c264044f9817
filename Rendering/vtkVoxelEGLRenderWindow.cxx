// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelEGLRenderWindow.h"

#include "vtkObjectFactory.h"
#include "vtkRendererCollection.h"
#include "vtkVoxelCompatibility.h"

#if defined(__unix__) && !defined(__APPLE__) && __has_include(<EGL/egl.h>)
#define VTK_VOXEL_HAS_EGL 1
#define EGL_NO_X11
#define MESA_EGL_NO_X11_HEADERS
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <unistd.h>
#else
#define VTK_VOXEL_HAS_EGL 0
#endif

#include <array>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkVoxelEGLRenderWindow);

#if VTK_VOXEL_HAS_EGL
namespace
{
constexpr std::array<EGLint, 2> SurfaceSize = { 16, 16 };

// libEGL, opened once and kept.
struct EGLLibrary
{
  PFNEGLGETPROCADDRESSPROC GetProcAddress = nullptr;
  PFNEGLGETDISPLAYPROC GetDisplay = nullptr;
  PFNEGLINITIALIZEPROC Initialize = nullptr;
  PFNEGLBINDAPIPROC BindAPI = nullptr;
  PFNEGLQUERYAPIPROC QueryAPI = nullptr;
  PFNEGLQUERYSTRINGPROC QueryString = nullptr;
  PFNEGLCHOOSECONFIGPROC ChooseConfig = nullptr;
  PFNEGLCREATECONTEXTPROC CreateContext = nullptr;
  PFNEGLDESTROYCONTEXTPROC DestroyContext = nullptr;
  PFNEGLCREATEPBUFFERSURFACEPROC CreatePbufferSurface = nullptr;
  PFNEGLDESTROYSURFACEPROC DestroySurface = nullptr;
  PFNEGLMAKECURRENTPROC MakeCurrent = nullptr;
  PFNEGLGETCURRENTCONTEXTPROC GetCurrentContext = nullptr;

  PFNEGLGETPLATFORMDISPLAYEXTPROC GetPlatformDisplay = nullptr;
  PFNEGLQUERYDEVICESEXTPROC QueryDevices = nullptr;
  PFNEGLQUERYDEVICESTRINGEXTPROC QueryDeviceString = nullptr;

  explicit operator bool() const { return this->Complete; }

  static const EGLLibrary& Get()
  {
    static const EGLLibrary library;
    return library;
  }

private:
  bool Complete = false;

  EGLLibrary()
  {
    void* handle = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    if (!handle)
    {
      return;
    }
    this->Complete = Load(handle, this->GetProcAddress, "eglGetProcAddress") &&
      Load(handle, this->GetDisplay, "eglGetDisplay") &&
      Load(handle, this->Initialize, "eglInitialize") &&
      Load(handle, this->BindAPI, "eglBindAPI") && Load(handle, this->QueryAPI, "eglQueryAPI") &&
      Load(handle, this->QueryString, "eglQueryString") &&
      Load(handle, this->ChooseConfig, "eglChooseConfig") &&
      Load(handle, this->CreateContext, "eglCreateContext") &&
      Load(handle, this->DestroyContext, "eglDestroyContext") &&
      Load(handle, this->CreatePbufferSurface, "eglCreatePbufferSurface") &&
      Load(handle, this->DestroySurface, "eglDestroySurface") &&
      Load(handle, this->MakeCurrent, "eglMakeCurrent") &&
      Load(handle, this->GetCurrentContext, "eglGetCurrentContext");
    if (this->Complete)
    {
      this->LoadExtension(this->GetPlatformDisplay, "eglGetPlatformDisplayEXT");
      this->LoadExtension(this->QueryDevices, "eglQueryDevicesEXT");
      this->LoadExtension(this->QueryDeviceString, "eglQueryDeviceStringEXT");
    }
  }

  template <typename Function>
  static bool Load(void* handle, Function& function, const char* name)
  {
    function = reinterpret_cast<Function>(dlsym(handle, name));
    return function != nullptr;
  }

  template <typename Function>
  void LoadExtension(Function& function, const char* name)
  {
    function = reinterpret_cast<Function>(this->GetProcAddress(name));
  }
};

bool Lists(const char* extensions, const std::string& name)
{
  const std::string padded = std::string(" ") + (extensions ? extensions : "") + " ";
  return padded.find(" " + name + " ") != std::string::npos;
}

// Mesa is told to stay away from graphics cards.
bool WantsSoftware()
{
  const char* value = std::getenv("LIBGL_ALWAYS_SOFTWARE");
  const std::string text = value ? value : "";
  return text == "1" || text == "true" || text == "yes" || text == "y";
}

// A card, and one whose device node this process may open.
bool IsUsableCard(EGLDeviceEXT device)
{
  const EGLLibrary& egl = EGLLibrary::Get();
  const char* extensions = egl.QueryDeviceString(device, EGL_EXTENSIONS);
  if (Lists(extensions, "EGL_MESA_device_software"))
  {
    return false;
  }
  if (!Lists(extensions, "EGL_EXT_device_drm_render_node"))
  {
    return true;
  }
  const char* node = egl.QueryDeviceString(device, EGL_DRM_RENDER_NODE_FILE_EXT);
  return !node || access(node, F_OK) != 0 || access(node, R_OK | W_OK) == 0;
}

// In the order in which to try them.
std::vector<EGLDisplay> FindDisplays()
{
  const EGLLibrary& egl = EGLLibrary::Get();
  std::vector<EGLDisplay> displays;
  const char* extensions = egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (egl.GetPlatformDisplay && egl.QueryDevices && egl.QueryDeviceString && !WantsSoftware() &&
    Lists(extensions, "EGL_EXT_platform_device"))
  {
    EGLint count = 0;
    egl.QueryDevices(0, nullptr, &count);
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    egl.QueryDevices(count, devices.data(), &count);
    for (EGLDeviceEXT device : devices)
    {
      if (IsUsableCard(device))
      {
        displays.push_back(egl.GetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
      }
    }
  }
  if (egl.GetPlatformDisplay && Lists(extensions, "EGL_MESA_platform_surfaceless"))
  {
    displays.push_back(
      egl.GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  }
  displays.push_back(egl.GetDisplay(EGL_DEFAULT_DISPLAY));
  return displays;
}

EGLContext CreateCoreContext(EGLDisplay display, EGLConfig config)
{
  constexpr std::array<EGLint, 8> versions = { 46, 45, 44, 43, 42, 41, 40, 33 };
  const EGLLibrary& egl = EGLLibrary::Get();
  const auto create = [&](EGLint version)
  {
    const std::array<EGLint, 7> attributes = { EGL_CONTEXT_MAJOR_VERSION, version / 10,
      EGL_CONTEXT_MINOR_VERSION, version % 10, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE };
    return egl.CreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
  };
  for (EGLint version : versions)
  {
    if (EGLContext context = create(version))
    {
      return context;
    }
  }
  return create(32);
}

struct ContextAndSurface
{
  EGLContext Context = EGL_NO_CONTEXT;
  EGLSurface Surface = EGL_NO_SURFACE;
};

// A context with a small surface, so that there is a default framebuffer; without, if there cannot
// be one.
ContextAndSurface CreateOnDisplay(EGLDisplay display)
{
  const EGLLibrary& egl = EGLLibrary::Get();
  EGLint major = 0;
  EGLint minor = 0;
  if (display == EGL_NO_DISPLAY || !egl.Initialize(display, &major, &minor))
  {
    return {};
  }
  const bool surfaceless =
    Lists(egl.QueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context");
  for (EGLint surfaceType : { EGL_PBUFFER_BIT, 0 })
  {
    const std::array<EGLint, 15> wanted = { EGL_SURFACE_TYPE, surfaceType, EGL_RENDERABLE_TYPE,
      EGL_OPENGL_BIT, EGL_RED_SIZE, 8, EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8, EGL_ALPHA_SIZE, 8,
      EGL_DEPTH_SIZE, 16, EGL_NONE };
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!egl.ChooseConfig(display, wanted.data(), &config, 1, &count) || count == 0)
    {
      continue;
    }
    ContextAndSurface made;
    if (surfaceType == EGL_PBUFFER_BIT)
    {
      const std::array<EGLint, 5> size = { EGL_WIDTH, SurfaceSize[0], EGL_HEIGHT, SurfaceSize[1],
        EGL_NONE };
      made.Surface = egl.CreatePbufferSurface(display, config, size.data());
    }
    if (made.Surface || surfaceless)
    {
      made.Context = CreateCoreContext(display, config);
    }
    if (made.Context)
    {
      return made;
    }
    if (made.Surface)
    {
      egl.DestroySurface(display, made.Surface);
    }
  }
  return {};
}

#if !VTK_VOXEL_USES_GLEW
vtkOpenGLRenderWindow::VTKOpenGLAPIProc LoadSymbol(void*, const char* name)
{
  return EGLLibrary::Get().GetProcAddress(name);
}
#endif
}
#endif

vtkVoxelEGLRenderWindow::vtkVoxelEGLRenderWindow()
{
  this->SetOffScreenRendering(1);
#if VTK_VOXEL_HAS_EGL && !VTK_VOXEL_USES_GLEW
  this->SetOpenGLSymbolLoader(LoadSymbol, nullptr);
#endif
}

vtkVoxelEGLRenderWindow::~vtkVoxelEGLRenderWindow()
{
  this->Finalize();
  vtkCollectionSimpleIterator iterator;
  this->Renderers->InitTraversal(iterator);
  while (vtkRenderer* renderer = this->Renderers->GetNextRenderer(iterator))
  {
    renderer->SetRenderWindow(nullptr);
  }
}

void vtkVoxelEGLRenderWindow::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Display: " << this->Display << "\n";
  os << indent << "Surface: " << this->Surface << "\n";
  os << indent << "Context: " << this->Context << "\n";
}

void vtkVoxelEGLRenderWindow::Initialize()
{
  if (this->Context)
  {
    return;
  }
  this->CreateAWindow();
  this->MakeCurrent();
  if (this->IsCurrent())
  {
    this->OpenGLInit();
  }
}

void vtkVoxelEGLRenderWindow::Finalize()
{
  this->DestroyWindow();
}

void vtkVoxelEGLRenderWindow::OpenGLInitContext()
{
#if VTK_VOXEL_USES_GLEW
  // GLEW loads the functions of OpenGL first and then wants those of GLX, for which it misses a
  // display. The superclass takes that for an error.
  if (!this->Initialized)
  {
    const GLenum result = glewInit();
    this->GlewInitValid = result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY;
    this->Initialized = this->GlewInitValid && GLEW_VERSION_3_2;
    if (this->Initialized)
    {
      std::array<GLfloat, 2> range = { 1.0f, 1.0f };
      glGetFloatv(GL_ALIASED_LINE_WIDTH_RANGE, range.data());
      this->MaximumHardwareLineWidth = range[1];
      this->Superclass::OpenGLInitContext();
    }
    return;
  }
#endif
  this->Superclass::OpenGLInitContext();
}

int vtkVoxelEGLRenderWindow::SupportsOpenGL()
{
  this->Initialize();
  return this->IsReady() ? 1 : 0;
}

int* vtkVoxelEGLRenderWindow::GetScreenSize()
{
  this->ScreenSize[0] = this->Size[0];
  this->ScreenSize[1] = this->Size[1];
  return this->ScreenSize;
}

void vtkVoxelEGLRenderWindow::PushContext()
{
  this->Pushed.emplace();
  this->MakeCurrent();
}

void vtkVoxelEGLRenderWindow::PopContext()
{
  this->Pushed.top().Restore();
  this->Pushed.pop();
}

#if VTK_VOXEL_HAS_EGL
void vtkVoxelEGLRenderWindow::CreateAWindow()
{
  const EGLLibrary& egl = EGLLibrary::Get();
  if (!egl)
  {
    return;
  }
  const EGLenum api = egl.QueryAPI();
  egl.BindAPI(EGL_OPENGL_API);
  for (EGLDisplay display : FindDisplays())
  {
    const ContextAndSurface made = CreateOnDisplay(display);
    if (made.Context)
    {
      this->Display = display;
      this->Context = made.Context;
      this->Surface = made.Surface;
      break;
    }
  }
  egl.BindAPI(api);
  this->Size[0] = this->Size[0] > 0 ? this->Size[0] : 300;
  this->Size[1] = this->Size[1] > 0 ? this->Size[1] : 300;
}

void vtkVoxelEGLRenderWindow::DestroyWindow()
{
  if (!this->Context)
  {
    return;
  }
  this->ReleaseGraphicsResources(this);
  this->ReleaseCurrent();
  const EGLLibrary& egl = EGLLibrary::Get();
  egl.DestroyContext(this->Display, this->Context);
  if (this->Surface)
  {
    egl.DestroySurface(this->Display, this->Surface);
  }
  this->Display = nullptr;
  this->Context = nullptr;
  this->Surface = nullptr;
}

void vtkVoxelEGLRenderWindow::MakeCurrent()
{
  if (!this->Context || this->IsCurrent())
  {
    return;
  }
  vtkVoxelCurrentContext::ReleaseGLX();
  EGLLibrary::Get().MakeCurrent(this->Display, this->Surface, this->Surface, this->Context);
}

bool vtkVoxelEGLRenderWindow::IsCurrent()
{
  return this->Context && EGLLibrary::Get().GetCurrentContext() == this->Context;
}

void vtkVoxelEGLRenderWindow::ReleaseCurrent()
{
  if (this->IsCurrent())
  {
    EGLLibrary::Get().MakeCurrent(this->Display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
}
#else
void vtkVoxelEGLRenderWindow::CreateAWindow() {}

void vtkVoxelEGLRenderWindow::DestroyWindow() {}

void vtkVoxelEGLRenderWindow::MakeCurrent() {}

bool vtkVoxelEGLRenderWindow::IsCurrent()
{
  return false;
}

void vtkVoxelEGLRenderWindow::ReleaseCurrent() {}
#endif
