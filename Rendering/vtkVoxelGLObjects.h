// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelGLObjects.h
 * Private header: OpenGL objects that own their name. They can be moved, not copied. Each knows its
 * context, deletes itself there, and quietly becomes useless when the context goes.
 *
 * All methods but the destructors want the context current, and nothing else: call them within a
 * vtkVoxelContext::Scope. OpenGL 3.2 is enough unless a method says otherwise.
 */

#ifndef vtkVoxelGLObjects_h
#define vtkVoxelGLObjects_h

#include "vtkVoxelContextRecord.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace vtkVoxelGL
{
using Context = std::shared_ptr<vtkVoxelContextRecord>;

/**
 * The name of an OpenGL object and the context that it belongs to.
 */
template <vtkVoxelContextRecord::Kind ObjectKind>
class Object
{
public:
  Object() = default;
  explicit Object(Context context)
    : Owner(std::move(context))
    , Name(this->Owner->Create(ObjectKind))
  {
  }
  ~Object() { this->Reset(); }
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  Object(Object&& other) noexcept
    : Owner(std::move(other.Owner))
    , Name(std::exchange(other.Name, 0))
  {
  }
  Object& operator=(Object&& other) noexcept
  {
    if (this != &other)
    {
      this->Reset();
      this->Owner = std::move(other.Owner);
      this->Name = std::exchange(other.Name, 0);
    }
    return *this;
  }

  /**
   * True when there is an object and its context is still there.
   */
  explicit operator bool() const { return this->Name != 0 && this->Owner->IsAlive(); }

  GLuint GetName() const { return this->Name; }
  const Context& GetContext() const { return this->Owner; }

  void Reset()
  {
    if (this->Name)
    {
      this->Owner->Delete(ObjectKind, this->Name);
    }
    this->Name = 0;
    this->Owner.reset();
  }

private:
  Context Owner;
  GLuint Name = 0;
};

/**
 * A buffer object. Contents move through GL_COPY_WRITE_BUFFER and GL_COPY_READ_BUFFER.
 */
class Buffer : public Object<vtkVoxelContextRecord::Kind::Buffer>
{
public:
  using Object::Object;

  /**
   * Makes room for so many bytes, and fills it when data is given. False when there is not so much
   * memory.
   */
  bool Allocate(std::size_t bytes, const void* data = nullptr, GLenum usage = GL_DYNAMIC_COPY)
  {
    this->Bind(GL_COPY_WRITE_BUFFER);
    glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes), data, usage);
    const bool fits = glGetError() == GL_NO_ERROR;
    this->Size = fits ? bytes : 0;
    return fits;
  }

  std::size_t GetSize() const { return this->Size; }

  void Upload(std::size_t offset, std::size_t bytes, const void* data)
  {
    this->Bind(GL_COPY_WRITE_BUFFER);
    glBufferSubData(
      GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
  }

  void Download(std::size_t offset, std::size_t bytes, void* data) const
  {
    this->Bind(GL_COPY_READ_BUFFER);
    glGetBufferSubData(
      GL_COPY_READ_BUFFER, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
  }

  void CopyTo(Buffer& target, std::size_t from, std::size_t to, std::size_t bytes) const
  {
    this->Bind(GL_COPY_READ_BUFFER);
    target.Bind(GL_COPY_WRITE_BUFFER);
    glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(from),
      static_cast<GLintptr>(to), static_cast<GLsizeiptr>(bytes));
  }

  /**
   * Sets every word of the buffer; the size must be a multiple of four bytes.
   */
  void Fill(std::uint32_t word)
  {
    this->Bind(GL_COPY_WRITE_BUFFER);
    if (this->GetContext()->GetVersion() >= 43)
    {
      glClearBufferData(GL_COPY_WRITE_BUFFER, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &word);
      return;
    }
    const std::vector<std::uint32_t> block(std::size_t(1) << 18, word);
    const std::size_t blockBytes = block.size() * sizeof(word);
    for (std::size_t offset = 0; offset < this->Size; offset += blockBytes)
    {
      this->Upload(offset, std::min(blockBytes, this->Size - offset), block.data());
    }
  }

  void Bind(GLenum target) const { glBindBuffer(target, this->GetName()); }
  void BindBase(GLenum target, GLuint index) const
  {
    glBindBufferBase(target, index, this->GetName());
  }
  void BindRange(GLenum target, GLuint index, std::size_t offset, std::size_t bytes) const
  {
    glBindBufferRange(target, index, this->GetName(), static_cast<GLintptr>(offset),
      static_cast<GLsizeiptr>(bytes));
  }

private:
  std::size_t Size = 0;
};

/**
 * Makes `buffer` one of exactly so many bytes in `context`, the present one where it is. Throws
 * std::runtime_error when there is not so much memory.
 */
inline void Prepare(Buffer& buffer, const Context& context, std::size_t bytes)
{
  if (buffer && buffer.GetContext() == context && buffer.GetSize() == bytes)
  {
    return;
  }
  buffer = Buffer(context);
  if (!buffer.Allocate(bytes))
  {
    buffer = Buffer();
    throw std::runtime_error("OpenGL has no memory left for a buffer of " + std::to_string(bytes) +
      " bytes. Use fewer voxels, or voxelize the mesh in parts.");
  }
}

/**
 * Bytes of a buffer in the address space of the process as long as it lives.
 */
class MappedBuffer
{
public:
  MappedBuffer(const Buffer& buffer, std::size_t offset, std::size_t bytes, GLbitfield access)
    : Source(buffer)
  {
    buffer.Bind(GL_COPY_READ_BUFFER);
    this->Data = glMapBufferRange(
      GL_COPY_READ_BUFFER, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), access);
  }
  ~MappedBuffer()
  {
    if (this->Data)
    {
      this->Source.Bind(GL_COPY_READ_BUFFER);
      glUnmapBuffer(GL_COPY_READ_BUFFER);
    }
  }
  MappedBuffer(const MappedBuffer&) = delete;
  MappedBuffer& operator=(const MappedBuffer&) = delete;

  /**
   * nullptr when the buffer could not be mapped.
   */
  void* Get() const { return this->Data; }

private:
  const Buffer& Source;
  void* Data = nullptr;
};

/**
 * A texture without mipmaps, read as it is (nearest) and clamped to its edge.
 */
class Texture : public Object<vtkVoxelContextRecord::Kind::Texture>
{
public:
  Texture() = default;
  Texture(Context context, GLenum target)
    : Object(std::move(context))
    , Target(target)
  {
    if (target == GL_TEXTURE_BUFFER)
    {
      return;
    }
    this->Bind(0);
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(target, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
    glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
  }

  GLenum GetTarget() const { return this->Target; }

  void Bind(GLuint unit) const
  {
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(this->Target, this->GetName());
  }

  ///@{
  /**
   * Storage of the given internal format; data in format and type, or none. False when there is not
   * so much memory. Uses texture unit 0.
   */
  bool Allocate2D(GLenum internalFormat, GLsizei width, GLsizei height, GLenum format, GLenum type,
    const void* data = nullptr)
  {
    this->Bind(0);
    glTexImage2D(
      this->Target, 0, static_cast<GLint>(internalFormat), width, height, 0, format, type, data);
    return glGetError() == GL_NO_ERROR;
  }
  bool Allocate3D(GLenum internalFormat, GLsizei width, GLsizei height, GLsizei depth,
    GLenum format, GLenum type, const void* data = nullptr)
  {
    this->Bind(0);
    glTexImage3D(this->Target, 0, static_cast<GLint>(internalFormat), width, height, depth, 0,
      format, type, data);
    return glGetError() == GL_NO_ERROR;
  }
  ///@}

  /**
   * Interpolates between pixels and repeats beyond the edges, as surfaces are textured. Uses
   * texture unit 0.
   */
  void FilterAndRepeat()
  {
    this->Bind(0);
    glTexParameteri(this->Target, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(this->Target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(this->Target, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(this->Target, GL_TEXTURE_WRAP_T, GL_REPEAT);
  }

  /**
   * Lets shaders read the buffer through this texture, whose target is GL_TEXTURE_BUFFER.
   */
  void AttachBuffer(GLenum internalFormat, const Buffer& buffer)
  {
    this->Bind(0);
    glTexBuffer(GL_TEXTURE_BUFFER, internalFormat, buffer.GetName());
  }

private:
  GLenum Target = GL_TEXTURE_2D;
};

/**
 * A framebuffer object.
 */
class Framebuffer : public Object<vtkVoxelContextRecord::Kind::Framebuffer>
{
public:
  using Object::Object;

  void Bind(GLenum target = GL_FRAMEBUFFER) const { glBindFramebuffer(target, this->GetName()); }

  ///@{
  /**
   * Attach a texture, all its layers, or one layer of it. The framebuffer becomes the bound one.
   */
  void Attach(GLenum attachment, const Texture& texture)
  {
    this->Bind();
    glFramebufferTexture(GL_FRAMEBUFFER, attachment, texture.GetName(), 0);
  }
  void AttachLayer(GLenum attachment, const Texture& texture, GLint layer)
  {
    this->Bind();
    glFramebufferTextureLayer(GL_FRAMEBUFFER, attachment, texture.GetName(), 0, layer);
  }
  ///@}

  /**
   * Draws go to color attachments 0 to count - 1.
   */
  void SetDrawBuffers(GLsizei count)
  {
    std::vector<GLenum> buffers(count);
    std::iota(buffers.begin(), buffers.end(), static_cast<GLenum>(GL_COLOR_ATTACHMENT0));
    this->Bind();
    glDrawBuffers(count, buffers.data());
  }

  /**
   * For shaders that write to buffers only (OpenGL 4.3). The framebuffer becomes the bound one.
   */
  void SetSizeWithoutAttachments(GLint width, GLint height)
  {
    this->Bind();
    glFramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_WIDTH, width);
    glFramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_HEIGHT, height);
  }

  bool IsComplete() const
  {
    this->Bind();
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  }
};

/**
 * A query object, for samples passed or elapsed time.
 */
class Query : public Object<vtkVoxelContextRecord::Kind::Query>
{
public:
  using Object::Object;

  void Begin(GLenum target)
  {
    this->Target = target;
    glBeginQuery(target, this->GetName());
  }
  void End() { glEndQuery(this->Target); }

  /**
   * Waits for the result.
   */
  GLuint GetResult() const
  {
    GLuint result = 0;
    glGetQueryObjectuiv(this->GetName(), GL_QUERY_RESULT, &result);
    return result;
  }

private:
  GLenum Target = GL_SAMPLES_PASSED;
};

/**
 * A vertex array object.
 */
class VertexArray : public Object<vtkVoxelContextRecord::Kind::VertexArray>
{
public:
  using Object::Object;

  void Bind() const { glBindVertexArray(this->GetName()); }
};

/**
 * A linked shader program.
 */
class Program : public Object<vtkVoxelContextRecord::Kind::Program>
{
public:
  using Defines = std::map<std::string, std::string>;

  /**
   * One shader of the program: its texts one after the other, without a version line.
   */
  struct Stage
  {
    GLenum Type;
    std::vector<std::string> Sources;
  };

  Program() = default;

  /**
   * Compiles and links. The header goes before all else, one line each: the version, for instance
   * "#version 430 core", and extensions; then come the defines, then the sources. Messages of the
   * compiler name lines of the source, and its number in the stage if the compiler tells. On
   * failure the program is empty and the log tells why.
   */
  static Program Build(const Context& context, const std::string& header, const Defines& defines,
    const std::vector<Stage>& stages, std::string& log)
  {
    Program program(context);
    std::vector<GLuint> shaders;
    bool good = true;
    for (const Stage& stage : stages)
    {
      shaders.push_back(glCreateShader(stage.Type));
      good = Program::Compile(shaders.back(), Program::Assemble(header, defines, stage), log);
      if (!good)
      {
        break;
      }
      glAttachShader(program.GetName(), shaders.back());
    }
    good = good && program.Link(log);
    for (GLuint shader : shaders)
    {
      glDeleteShader(shader);
    }
    return good ? std::move(program) : Program();
  }

  void Use() const { glUseProgram(this->GetName()); }

  ///@{
  /**
   * Set a uniform of the program, which must be in use. One that the compiler found unused is
   * ignored.
   */
  void Set(const char* name, int value) { glUniform1i(this->Location(name), value); }
  void Set(const char* name, unsigned int value) { glUniform1ui(this->Location(name), value); }
  void Set(const char* name, float value) { glUniform1f(this->Location(name), value); }
  void Set(const char* name, const std::array<int, 2>& v)
  {
    glUniform2iv(this->Location(name), 1, v.data());
  }
  void Set(const char* name, const std::array<int, 3>& v)
  {
    glUniform3iv(this->Location(name), 1, v.data());
  }
  void Set(const char* name, const std::array<int, 4>& v)
  {
    glUniform4iv(this->Location(name), 1, v.data());
  }
  void Set(const char* name, const std::array<unsigned int, 2>& v)
  {
    glUniform2uiv(this->Location(name), 1, v.data());
  }
  void Set(const char* name, const std::array<unsigned int, 3>& v)
  {
    glUniform3uiv(this->Location(name), 1, v.data());
  }
  void Set(const char* name, const std::array<unsigned int, 4>& v)
  {
    glUniform4uiv(this->Location(name), 1, v.data());
  }
  void Set(const char* name, const std::array<float, 2>& v)
  {
    glUniform2fv(this->Location(name), 1, v.data());
  }
  void Set(const char* name, const std::array<float, 3>& v)
  {
    glUniform3fv(this->Location(name), 1, v.data());
  }
  void Set(const char* name, const std::array<float, 4>& v)
  {
    glUniform4fv(this->Location(name), 1, v.data());
  }
  ///@}

  ///@{
  /**
   * Double precision, of OpenGL 4.0.
   */
  void Set(const char* name, double value) { glUniform1d(this->Location(name), value); }
  void Set(const char* name, const std::array<double, 3>& v)
  {
    glUniform3dv(this->Location(name), 1, v.data());
  }
  void Set(const char* name, const std::array<double, 4>& v)
  {
    glUniform4dv(this->Location(name), 1, v.data());
  }
  ///@}

  /**
   * A 4x4 matrix of floats, row after row as vtkMatrix4x4 has them.
   */
  void SetMatrix(const char* name, const std::array<float, 16>& rows)
  {
    glUniformMatrix4fv(this->Location(name), 1, GL_TRUE, rows.data());
  }

private:
  explicit Program(const Context& context)
    : Object(context)
  {
  }

  static std::string Assemble(const std::string& header, const Defines& defines, const Stage& stage)
  {
    std::string text = header;
    for (const auto& [name, value] : defines)
    {
      text += "#define " + name + " " + value + "\n";
    }
    // Before GLSL 3.30, the line directive gave the number of its own line.
    const bool old = header.find("#version 1") != std::string::npos;
    const std::string line = old ? "#line 0 " : "#line 1 ";
    for (std::size_t i = 0; i < stage.Sources.size(); ++i)
    {
      text += line + std::to_string(i) + "\n" + stage.Sources[i] + "\n";
    }
    return text;
  }

  static bool Compile(GLuint shader, const std::string& text, std::string& log)
  {
    const char* source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint good = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (!good)
    {
      GLint length = 0;
      glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
      log.assign(static_cast<std::size_t>(length), '\0');
      glGetShaderInfoLog(shader, length, &length, log.data());
      log.resize(static_cast<std::size_t>(length));
    }
    return good == GL_TRUE;
  }

  bool Link(std::string& log) const
  {
    glLinkProgram(this->GetName());
    GLint good = GL_FALSE;
    glGetProgramiv(this->GetName(), GL_LINK_STATUS, &good);
    if (!good)
    {
      GLint length = 0;
      glGetProgramiv(this->GetName(), GL_INFO_LOG_LENGTH, &length);
      log.assign(static_cast<std::size_t>(length), '\0');
      glGetProgramInfoLog(this->GetName(), length, &length, log.data());
      log.resize(static_cast<std::size_t>(length));
    }
    return good == GL_TRUE;
  }

  GLint Location(const char* name)
  {
    const auto known = this->Locations.find(name);
    if (known != this->Locations.end())
    {
      return known->second;
    }
    const GLint location = glGetUniformLocation(this->GetName(), name);
    this->Locations.emplace(name, location);
    return location;
  }

  std::map<std::string, GLint> Locations;
};
}

#endif
// VTK-HeaderTest-Exclude: vtkVoxelGLObjects.h
