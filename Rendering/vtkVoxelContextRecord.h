// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelContextRecord.h
 * Private header: what the module keeps about one OpenGL context, and which objects it made there.
 */

#ifndef vtkVoxelContextRecord_h
#define vtkVoxelContextRecord_h

#include "vtkSmartPointer.h"
#include "vtkVoxelCompatibility.h"
#include "vtkVoxelizationModule.h"

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

class vtkOpenGLRenderWindow;
class vtkVoxelReleaseHook;

/**
 * One OpenGL context. It lives as long as someone uses it; when the window gives its graphics
 * resources back, the objects made there are deleted and the record is dead for good. A window that
 * is initialized again gets a new record.
 */
class VTKVOXELIZATION_EXPORT vtkVoxelContextRecord
  : public std::enable_shared_from_this<vtkVoxelContextRecord>
{
public:
  enum class Kind
  {
    Buffer,
    Texture,
    Framebuffer,
    Query,
    VertexArray,
    Program
  };

  /**
   * The record of the window's present context, which must be current.
   */
  static std::shared_ptr<vtkVoxelContextRecord> ForWindow(vtkOpenGLRenderWindow* window);

  ~vtkVoxelContextRecord();
  vtkVoxelContextRecord(const vtkVoxelContextRecord&) = delete;
  vtkVoxelContextRecord& operator=(const vtkVoxelContextRecord&) = delete;

  bool IsAlive() const { return this->Window != nullptr; }

  /**
   * The window of the context; nullptr when the context is gone.
   */
  vtkOpenGLRenderWindow* GetWindow() const { return this->Window; }

  ///@{
  /**
   * Make and delete an OpenGL object. To create, the context must be current. Delete() makes it
   * current if need be, and does nothing when the context is gone.
   */
  GLuint Create(Kind kind);
  void Delete(Kind kind, GLuint name);
  ///@}

  ///@{
  /**
   * Properties of the context, asked once.
   */
  const std::string& GetRendererName() const { return this->RendererName; }
  int GetVersion() const { return this->Version; }
  bool SupportsCompute() const { return this->Compute; }
  bool HasExtension(const std::string& name) const { return this->Extensions.count(name) != 0; }
  ///@}

  /**
   * What was made once for this context, by name, such as compiled programs. It goes with the
   * context, and may refer to this record: then the record lives as long as the context.
   */
  std::map<std::string, std::shared_ptr<void>>& GetCache() { return this->Cache; }

private:
  friend class vtkVoxelReleaseHook;

  explicit vtkVoxelContextRecord(vtkOpenGLRenderWindow* window);
  void QueryProperties();
  void Release();

  vtkOpenGLRenderWindow* Window;
  vtkSmartPointer<vtkVoxelReleaseHook> Hook;
  vtkVoxelContextRecord* Next;
  std::set<std::pair<Kind, GLuint>> Objects;
  std::set<std::string> Extensions;
  std::map<std::string, std::shared_ptr<void>> Cache;
  std::string RendererName;
  int Version = 0;
  bool Compute = false;
};

#endif
// VTK-HeaderTest-Exclude: vtkVoxelContextRecord.h
