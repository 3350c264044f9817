// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelContextRecord.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkTextureObject.h"
#include "vtkVoxelCurrentContext.h"

#include <utility>
#include <vector>

/**
 * Tells the record when the window is about to lose its context. Render windows inform their
 * registered resources; what registers in all versions of VTK through installed headers is a
 * texture object, so this is one that never holds a texture.
 */
class vtkVoxelReleaseHook : public vtkTextureObject
{
public:
  static vtkVoxelReleaseHook* New();
  vtkTypeMacro(vtkVoxelReleaseHook, vtkTextureObject);

  void Watch(vtkOpenGLRenderWindow* window, vtkVoxelContextRecord* record)
  {
    this->Record = record;
    this->SetContext(window);
  }

  void Forget() { this->Record = nullptr; }

  void ReleaseGraphicsResources(vtkWindow* window) override
  {
    if (this->Record)
    {
      this->Record->Release();
    }
    this->Superclass::ReleaseGraphicsResources(window);
  }

protected:
  vtkVoxelReleaseHook() = default;
  ~vtkVoxelReleaseHook() override = default;

private:
  vtkVoxelReleaseHook(const vtkVoxelReleaseHook&) = delete;
  void operator=(const vtkVoxelReleaseHook&) = delete;

  vtkVoxelContextRecord* Record = nullptr;
};

vtkStandardNewMacro(vtkVoxelReleaseHook);

namespace
{
using Kind = vtkVoxelContextRecord::Kind;

// The records of all living contexts. A plain pointer, which outlives all static objects.
vtkVoxelContextRecord* FirstRecord = nullptr;

// Hooks whose window has called them: they may not go before that call returns.
std::vector<vtkSmartPointer<vtkVoxelReleaseHook>> CalledHooks;

GLuint CreateObject(Kind kind)
{
  GLuint name = 0;
  switch (kind)
  {
    case Kind::Buffer:
      glGenBuffers(1, &name);
      break;
    case Kind::Texture:
      glGenTextures(1, &name);
      break;
    case Kind::Framebuffer:
      glGenFramebuffers(1, &name);
      break;
    case Kind::Query:
      glGenQueries(1, &name);
      break;
    case Kind::VertexArray:
      glGenVertexArrays(1, &name);
      break;
    case Kind::Program:
      name = glCreateProgram();
      break;
  }
  return name;
}

void DeleteObject(Kind kind, GLuint name)
{
  switch (kind)
  {
    case Kind::Buffer:
      glDeleteBuffers(1, &name);
      break;
    case Kind::Texture:
      glDeleteTextures(1, &name);
      break;
    case Kind::Framebuffer:
      glDeleteFramebuffers(1, &name);
      break;
    case Kind::Query:
      glDeleteQueries(1, &name);
      break;
    case Kind::VertexArray:
      glDeleteVertexArrays(1, &name);
      break;
    case Kind::Program:
      glDeleteProgram(name);
      break;
  }
}
}

std::shared_ptr<vtkVoxelContextRecord> vtkVoxelContextRecord::ForWindow(
  vtkOpenGLRenderWindow* window)
{
  CalledHooks.clear();
  for (vtkVoxelContextRecord* record = FirstRecord; record; record = record->Next)
  {
    if (record->Window == window)
    {
      return record->shared_from_this();
    }
  }
  return std::shared_ptr<vtkVoxelContextRecord>(new vtkVoxelContextRecord(window));
}

vtkVoxelContextRecord::vtkVoxelContextRecord(vtkOpenGLRenderWindow* window)
  : Window(window)
  , Hook(vtkSmartPointer<vtkVoxelReleaseHook>::New())
  , Next(FirstRecord)
{
  FirstRecord = this;
  this->Hook->Watch(window, this);
  this->QueryProperties();
}

vtkVoxelContextRecord::~vtkVoxelContextRecord()
{
  vtkVoxelContextRecord** link = &FirstRecord;
  while (*link != this)
  {
    link = &(*link)->Next;
  }
  *link = this->Next;

  if (this->Window)
  {
    this->Hook->Forget();
    const vtkVoxelContextSwitch current(this->Window);
    this->Hook = nullptr;
  }
}

void vtkVoxelContextRecord::QueryProperties()
{
  const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  this->RendererName = renderer ? renderer : "";

  GLint major = 0;
  GLint minor = 0;
  GLint extensions = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  glGetIntegerv(GL_NUM_EXTENSIONS, &extensions);
  this->Version = 10 * major + minor;
  for (GLint i = 0; i < extensions; ++i)
  {
    this->Extensions.insert(
      reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(i))));
  }

  this->Compute = this->Version >= 43 ||
    (this->HasExtension("GL_ARB_compute_shader") &&
      this->HasExtension("GL_ARB_shader_storage_buffer_object") &&
      (this->Version >= 40 || this->HasExtension("GL_ARB_gpu_shader_fp64")));
}

void vtkVoxelContextRecord::Release()
{
  this->Hook->Forget();
  CalledHooks.push_back(std::move(this->Hook));
  if (vtkVoxelCurrentContext::Is(this->Window))
  {
    for (const auto& [kind, name] : this->Objects)
    {
      DeleteObject(kind, name);
    }
  }
  this->Objects.clear();
  this->Window = nullptr;

  // What is cached may hold the last references to this record.
  const auto self = this->shared_from_this();
  std::exchange(this->Cache, {}).clear();
}

GLuint vtkVoxelContextRecord::Create(Kind kind)
{
  const GLuint name = CreateObject(kind);
  this->Objects.emplace(kind, name);
  return name;
}

void vtkVoxelContextRecord::Delete(Kind kind, GLuint name)
{
  if (!this->Window)
  {
    return;
  }
  this->Objects.erase({ kind, name });
  vtkVoxelContextSwitch current(this->Window);
  if (current)
  {
    DeleteObject(kind, name);
  }
}
