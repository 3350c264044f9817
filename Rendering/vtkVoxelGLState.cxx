// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelGLState.h"

#include "vtkVoxelContextRecord.h"

#include <algorithm>

namespace
{
constexpr std::array<GLenum, 21> PlainCapabilities = { GL_COLOR_LOGIC_OP, GL_CULL_FACE,
  GL_DEPTH_CLAMP, GL_DEPTH_TEST, GL_DITHER, GL_FRAMEBUFFER_SRGB, GL_LINE_SMOOTH, GL_MULTISAMPLE,
  GL_POLYGON_OFFSET_FILL, GL_POLYGON_OFFSET_LINE, GL_POLYGON_OFFSET_POINT, GL_POLYGON_SMOOTH,
  GL_PRIMITIVE_RESTART, GL_PROGRAM_POINT_SIZE, GL_RASTERIZER_DISCARD, GL_SAMPLE_ALPHA_TO_COVERAGE,
  GL_SAMPLE_ALPHA_TO_ONE, GL_SAMPLE_COVERAGE, GL_SAMPLE_MASK, GL_SCISSOR_TEST, GL_STENCIL_TEST };

constexpr std::array<GLenum, 4> TextureTargets = { GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY,
  GL_TEXTURE_3D, GL_TEXTURE_BUFFER };
constexpr std::array<GLenum, 4> TextureBindings = { GL_TEXTURE_BINDING_2D,
  GL_TEXTURE_BINDING_2D_ARRAY, GL_TEXTURE_BINDING_3D, GL_TEXTURE_BINDING_BUFFER };

struct BufferTarget
{
  GLenum Target;
  GLenum Query;
};
constexpr std::array<BufferTarget, 7> PlainBuffers = {
  { { GL_ARRAY_BUFFER, GL_ARRAY_BUFFER_BINDING }, { GL_COPY_READ_BUFFER, GL_COPY_READ_BUFFER },
    { GL_COPY_WRITE_BUFFER, GL_COPY_WRITE_BUFFER },
    { GL_PIXEL_PACK_BUFFER, GL_PIXEL_PACK_BUFFER_BINDING },
    { GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_UNPACK_BUFFER_BINDING },
    { GL_TEXTURE_BUFFER, GL_TEXTURE_BUFFER }, { GL_UNIFORM_BUFFER, GL_UNIFORM_BUFFER_BINDING } }
};

constexpr std::array<GLenum, 16> PixelParameters = { GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST,
  GL_PACK_ROW_LENGTH, GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS,
  GL_PACK_SKIP_IMAGES, GL_PACK_ALIGNMENT, GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST,
  GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS,
  GL_UNPACK_SKIP_IMAGES, GL_UNPACK_ALIGNMENT };

GLint GetInteger(GLenum name)
{
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

GLuint GetUnsigned(GLenum name)
{
  return static_cast<GLuint>(GetInteger(name));
}

GLint GetIndexed(GLenum name, GLuint index)
{
  GLint value = 0;
  glGetIntegeri_v(name, index, &value);
  return value;
}

GLenum AsEnum(GLint value)
{
  return static_cast<GLenum>(value);
}

void SetCapability(GLenum name, bool enabled)
{
  (enabled ? glEnable : glDisable)(name);
}
}

namespace
{
/**
 * The name, or none when what it named was deleted meanwhile: in scopes within scopes the inner one
 * may delete what the outer one bound.
 */
template <typename Test>
GLuint IfAlive(GLint name, Test isAlive)
{
  return name != 0 && isAlive(static_cast<GLuint>(name)) ? static_cast<GLuint>(name) : 0;
}
}

vtkVoxelGLState::vtkVoxelGLState(const vtkVoxelContextRecord& context)
  : Version(context.GetVersion())
  , Compute(context.SupportsCompute())
{
  this->DrawFramebuffer = GetInteger(GL_DRAW_FRAMEBUFFER_BINDING);
  this->ReadFramebuffer = GetInteger(GL_READ_FRAMEBUFFER_BINDING);
  this->Program = GetInteger(GL_CURRENT_PROGRAM);
  this->VertexArray = GetInteger(GL_VERTEX_ARRAY_BINDING);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glUseProgram(0);
  glBindVertexArray(0);
  if (this->Version >= 41)
  {
    this->ProgramPipeline = GetInteger(GL_PROGRAM_PIPELINE_BINDING);
    glBindProgramPipeline(0);
  }
  this->SaveCapabilities();
  this->SaveFragmentOperations();
  this->SaveTextures();
  this->SaveBuffers();
  this->SaveImages();
}

void vtkVoxelGLState::Restore() const
{
  this->RestoreImages();
  this->RestoreBuffers();
  this->RestoreTextures();
  this->RestoreFragmentOperations();
  this->RestoreCapabilities();
  if (this->Version >= 41)
  {
    glBindProgramPipeline(static_cast<GLuint>(this->ProgramPipeline));
  }
  glBindVertexArray(IfAlive(this->VertexArray, glIsVertexArray));
  glUseProgram(IfAlive(this->Program, glIsProgram));
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, IfAlive(this->DrawFramebuffer, glIsFramebuffer));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, IfAlive(this->ReadFramebuffer, glIsFramebuffer));
}

void vtkVoxelGLState::SaveCapabilities()
{
  std::vector<GLenum> names(PlainCapabilities.begin(), PlainCapabilities.end());
  for (GLuint i = 0; i < Units; ++i)
  {
    names.push_back(GL_CLIP_DISTANCE0 + i);
  }
  if (this->Version >= 40)
  {
    names.push_back(GL_SAMPLE_SHADING);
  }
  if (this->Version >= 43)
  {
    names.push_back(GL_PRIMITIVE_RESTART_FIXED_INDEX);
    names.push_back(GL_DEBUG_OUTPUT);
  }
  for (GLenum name : names)
  {
    this->Capabilities.push_back({ name, glIsEnabled(name) });
    glDisable(name);
  }
}

void vtkVoxelGLState::RestoreCapabilities() const
{
  for (const Setting& capability : this->Capabilities)
  {
    SetCapability(capability.Name, capability.Value != GL_FALSE);
  }
}

void vtkVoxelGLState::SaveFragmentOperations()
{
  this->DrawBuffers.resize(GetUnsigned(GL_MAX_DRAW_BUFFERS));
  for (GLuint i = 0; i < this->DrawBuffers.size(); ++i)
  {
    DrawBuffer& buffer = this->DrawBuffers[i];
    buffer.Blend = glIsEnabledi(GL_BLEND, i);
    glGetBooleani_v(GL_COLOR_WRITEMASK, i, buffer.ColorMask.data());
  }
  glDisable(GL_BLEND);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);

  this->LogicOperation = GetInteger(GL_LOGIC_OP_MODE);
  glLogicOp(GL_COPY);

  this->BlendEquation = { GetInteger(GL_BLEND_EQUATION_RGB), GetInteger(GL_BLEND_EQUATION_ALPHA) };
  this->BlendFunction = { GetInteger(GL_BLEND_SRC_RGB), GetInteger(GL_BLEND_DST_RGB),
    GetInteger(GL_BLEND_SRC_ALPHA), GetInteger(GL_BLEND_DST_ALPHA) };
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ZERO);

  this->DepthFunction = GetInteger(GL_DEPTH_FUNC);
  glGetBooleanv(GL_DEPTH_WRITEMASK, &this->DepthMask);
  glGetDoublev(GL_DEPTH_RANGE, this->DepthRange.data());
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glDepthRange(0.0, 1.0);

  this->StencilFaces = {
    StencilFace{ GL_FRONT,
      { GetInteger(GL_STENCIL_FUNC), GetInteger(GL_STENCIL_REF), GetInteger(GL_STENCIL_VALUE_MASK),
        GetInteger(GL_STENCIL_FAIL), GetInteger(GL_STENCIL_PASS_DEPTH_FAIL),
        GetInteger(GL_STENCIL_PASS_DEPTH_PASS), GetInteger(GL_STENCIL_WRITEMASK) } },
    StencilFace{ GL_BACK,
      { GetInteger(GL_STENCIL_BACK_FUNC), GetInteger(GL_STENCIL_BACK_REF),
        GetInteger(GL_STENCIL_BACK_VALUE_MASK), GetInteger(GL_STENCIL_BACK_FAIL),
        GetInteger(GL_STENCIL_BACK_PASS_DEPTH_FAIL), GetInteger(GL_STENCIL_BACK_PASS_DEPTH_PASS),
        GetInteger(GL_STENCIL_BACK_WRITEMASK) } }
  };
  glStencilFunc(GL_ALWAYS, 0, ~0U);
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  glStencilMask(~0U);

  glGetIntegerv(GL_VIEWPORT, this->Viewport.data());
  glGetIntegerv(GL_SCISSOR_BOX, this->Scissor.data());
  if (this->Version >= 45)
  {
    this->ClipControl = { GetInteger(GL_CLIP_ORIGIN), GetInteger(GL_CLIP_DEPTH_MODE) };
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  }

  glGetIntegerv(GL_POLYGON_MODE, this->PolygonMode.data());
  this->CullFace = GetInteger(GL_CULL_FACE_MODE);
  this->FrontFace = GetInteger(GL_FRONT_FACE);
  this->ProvokingVertex = GetInteger(GL_PROVOKING_VERTEX);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glCullFace(GL_BACK);
  glFrontFace(GL_CCW);
  glProvokingVertex(GL_LAST_VERTEX_CONVENTION);

  glGetFloatv(GL_COLOR_CLEAR_VALUE, this->ClearColor.data());
  glGetDoublev(GL_DEPTH_CLEAR_VALUE, &this->ClearDepth);
  glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  glClearDepth(1.0);
}

void vtkVoxelGLState::RestoreFragmentOperations() const
{
  for (GLuint i = 0; i < this->DrawBuffers.size(); ++i)
  {
    const DrawBuffer& buffer = this->DrawBuffers[i];
    (buffer.Blend ? glEnablei : glDisablei)(GL_BLEND, i);
    glColorMaski(
      i, buffer.ColorMask[0], buffer.ColorMask[1], buffer.ColorMask[2], buffer.ColorMask[3]);
  }
  glLogicOp(AsEnum(this->LogicOperation));
  glBlendEquationSeparate(AsEnum(this->BlendEquation[0]), AsEnum(this->BlendEquation[1]));
  glBlendFuncSeparate(AsEnum(this->BlendFunction[0]), AsEnum(this->BlendFunction[1]),
    AsEnum(this->BlendFunction[2]), AsEnum(this->BlendFunction[3]));
  glDepthFunc(AsEnum(this->DepthFunction));
  glDepthMask(this->DepthMask);
  glDepthRange(this->DepthRange[0], this->DepthRange[1]);
  for (const auto& [face, values] : this->StencilFaces)
  {
    glStencilFuncSeparate(face, AsEnum(values[0]), values[1], static_cast<GLuint>(values[2]));
    glStencilOpSeparate(face, AsEnum(values[3]), AsEnum(values[4]), AsEnum(values[5]));
    glStencilMaskSeparate(face, static_cast<GLuint>(values[6]));
  }
  glViewport(this->Viewport[0], this->Viewport[1], this->Viewport[2], this->Viewport[3]);
  glScissor(this->Scissor[0], this->Scissor[1], this->Scissor[2], this->Scissor[3]);
  if (this->Version >= 45)
  {
    glClipControl(AsEnum(this->ClipControl[0]), AsEnum(this->ClipControl[1]));
  }
  glPolygonMode(GL_FRONT_AND_BACK, AsEnum(this->PolygonMode[0]));
  glCullFace(AsEnum(this->CullFace));
  glFrontFace(AsEnum(this->FrontFace));
  glProvokingVertex(AsEnum(this->ProvokingVertex));
  glClearColor(this->ClearColor[0], this->ClearColor[1], this->ClearColor[2], this->ClearColor[3]);
  glClearDepth(this->ClearDepth);
}

void vtkVoxelGLState::SaveTextures()
{
  this->ActiveTexture = GetInteger(GL_ACTIVE_TEXTURE);
  for (GLuint i = 0; i < Units; ++i)
  {
    glActiveTexture(GL_TEXTURE0 + i);
    TextureUnit& unit = this->TextureUnits[i];
    for (std::size_t t = 0; t < TextureTargets.size(); ++t)
    {
      unit.Textures[t] = GetInteger(TextureBindings[t]);
      glBindTexture(TextureTargets[t], 0);
    }
    if (this->Version >= 33)
    {
      unit.Sampler = GetInteger(GL_SAMPLER_BINDING);
      glBindSampler(i, 0);
    }
  }
  glActiveTexture(GL_TEXTURE0);
}

void vtkVoxelGLState::RestoreTextures() const
{
  for (GLuint i = 0; i < Units; ++i)
  {
    glActiveTexture(GL_TEXTURE0 + i);
    const TextureUnit& unit = this->TextureUnits[i];
    for (std::size_t t = 0; t < TextureTargets.size(); ++t)
    {
      glBindTexture(TextureTargets[t], IfAlive(unit.Textures[t], glIsTexture));
    }
    if (this->Version >= 33)
    {
      glBindSampler(i, static_cast<GLuint>(unit.Sampler));
    }
  }
  glActiveTexture(AsEnum(this->ActiveTexture));
}

void vtkVoxelGLState::SaveBuffers()
{
  const auto saveGeneric = [this](GLenum target, GLenum query)
  {
    this->Buffers.push_back({ target, GetInteger(query) });
    glBindBuffer(target, 0);
  };
  const auto saveIndexed =
    [this](GLenum target, GLenum binding, GLenum start, GLenum size, GLenum maximum)
  {
    const GLuint count = std::min(Units, GetUnsigned(maximum));
    for (GLuint i = 0; i < count; ++i)
    {
      IndexedBuffer buffer{ target, i, GetIndexed(binding, i), 0, 0 };
      glGetInteger64i_v(start, i, &buffer.Start);
      glGetInteger64i_v(size, i, &buffer.Size);
      this->IndexedBuffers.push_back(buffer);
      glBindBufferBase(target, i, 0);
    }
  };

  for (const BufferTarget& buffer : PlainBuffers)
  {
    saveGeneric(buffer.Target, buffer.Query);
  }
  saveIndexed(GL_UNIFORM_BUFFER, GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START,
    GL_UNIFORM_BUFFER_SIZE, GL_MAX_UNIFORM_BUFFER_BINDINGS);
  if (this->Version >= 40)
  {
    saveGeneric(GL_DRAW_INDIRECT_BUFFER, GL_DRAW_INDIRECT_BUFFER_BINDING);
  }
  if (this->Version >= 42)
  {
    saveGeneric(GL_ATOMIC_COUNTER_BUFFER, GL_ATOMIC_COUNTER_BUFFER_BINDING);
    saveIndexed(GL_ATOMIC_COUNTER_BUFFER, GL_ATOMIC_COUNTER_BUFFER_BINDING,
      GL_ATOMIC_COUNTER_BUFFER_START, GL_ATOMIC_COUNTER_BUFFER_SIZE,
      GL_MAX_ATOMIC_COUNTER_BUFFER_BINDINGS);
  }
  if (this->Compute)
  {
    saveGeneric(GL_DISPATCH_INDIRECT_BUFFER, GL_DISPATCH_INDIRECT_BUFFER_BINDING);
    saveGeneric(GL_SHADER_STORAGE_BUFFER, GL_SHADER_STORAGE_BUFFER_BINDING);
    saveIndexed(GL_SHADER_STORAGE_BUFFER, GL_SHADER_STORAGE_BUFFER_BINDING,
      GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE,
      GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS);
  }

  for (GLenum parameter : PixelParameters)
  {
    this->PixelStorage.push_back({ parameter, GetInteger(parameter) });
    const bool alignment = parameter == GL_PACK_ALIGNMENT || parameter == GL_UNPACK_ALIGNMENT;
    glPixelStorei(parameter, alignment ? 1 : 0);
  }
}

void vtkVoxelGLState::RestoreBuffers() const
{
  // Binding to an index binds to the target as well, so the targets come last.
  for (const IndexedBuffer& buffer : this->IndexedBuffers)
  {
    const GLuint name = IfAlive(buffer.Name, glIsBuffer);
    if (name == 0 || buffer.Size == 0)
    {
      glBindBufferBase(buffer.Target, buffer.Index, name);
    }
    else
    {
      glBindBufferRange(buffer.Target, buffer.Index, name, static_cast<GLintptr>(buffer.Start),
        static_cast<GLsizeiptr>(buffer.Size));
    }
  }
  for (const Binding& buffer : this->Buffers)
  {
    glBindBuffer(buffer.Target, IfAlive(buffer.Name, glIsBuffer));
  }
  for (const Setting& parameter : this->PixelStorage)
  {
    glPixelStorei(parameter.Name, parameter.Value);
  }
}

void vtkVoxelGLState::SaveImages()
{
  if (this->Version < 42)
  {
    return;
  }
  this->ImageUnits.resize(std::min(Units, GetUnsigned(GL_MAX_IMAGE_UNITS)));
  for (GLuint i = 0; i < this->ImageUnits.size(); ++i)
  {
    this->ImageUnits[i] = { GetIndexed(GL_IMAGE_BINDING_NAME, i),
      GetIndexed(GL_IMAGE_BINDING_LEVEL, i), GetIndexed(GL_IMAGE_BINDING_LAYERED, i),
      GetIndexed(GL_IMAGE_BINDING_LAYER, i), GetIndexed(GL_IMAGE_BINDING_ACCESS, i),
      GetIndexed(GL_IMAGE_BINDING_FORMAT, i) };
    glBindImageTexture(i, 0, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R8);
  }
}

void vtkVoxelGLState::RestoreImages() const
{
  for (GLuint i = 0; i < this->ImageUnits.size(); ++i)
  {
    const ImageUnit& unit = this->ImageUnits[i];
    glBindImageTexture(i, IfAlive(unit.Name, glIsTexture), unit.Level,
      static_cast<GLboolean>(unit.Layered), unit.Layer, AsEnum(unit.Access), AsEnum(unit.Format));
  }
}
