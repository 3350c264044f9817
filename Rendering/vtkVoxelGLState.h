// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelGLState.h
 * Private header: saves and restores the OpenGL state that the passes of this module change.
 */

#ifndef vtkVoxelGLState_h
#define vtkVoxelGLState_h

#include "vtkVoxelCompatibility.h"

#include <array>
#include <vector>

class vtkVoxelContextRecord;

/**
 * The OpenGL state of the current context, as it is and not as a cache has it. The constructor
 * reads it and then puts OpenGL's initial values in its place; Restore() puts it back.
 *
 * - capabilities: blending (of every draw buffer), logic operation, tests of depth, stencil and
 *   scissor, depth clamp, culling, polygon offset, clip distances, rasterizer discard,
 *   multisampling and its masks, sRGB, dithering, primitive restart, program point size, line and
 *   polygon smoothing, debug output (VTK prints it, though passes may expect and handle an error)
 * - logic operation, blend equation and function, color masks, depth function, mask and range,
 * stencil functions, operations and masks, viewport, scissor box, clip control, polygon mode, cull
 * face, front face, provoking vertex, clear color and depth
 * - framebuffers for drawing and reading, program, program pipeline, vertex array
 * - texture units 0 to 7: textures 2D, 3D, 2D array and buffer, and samplers; the active unit
 * - buffer bindings: array, copy, pixel, texture, uniform and, where they exist, shader storage,
 *   atomic counter, and indirect draw and dispatch; bindings 0 to 7 of the indexed ones; image
 *   units 0 to 7
 * - how pixels lie in memory
 */
class vtkVoxelGLState
{
public:
  static constexpr GLuint Units = 8;

  explicit vtkVoxelGLState(const vtkVoxelContextRecord& context);
  void Restore() const;

private:
  struct IndexedBuffer
  {
    GLenum Target;
    GLuint Index;
    GLint Name;
    GLint64 Start;
    GLint64 Size;
  };
  struct TextureUnit
  {
    std::array<GLint, 4> Textures;
    GLint Sampler;
  };
  struct ImageUnit
  {
    GLint Name;
    GLint Level;
    GLint Layered;
    GLint Layer;
    GLint Access;
    GLint Format;
  };
  struct DrawBuffer
  {
    GLboolean Blend;
    std::array<GLboolean, 4> ColorMask;
  };
  struct StencilFace
  {
    GLenum Face;
    std::array<GLint, 7> Values;
  };
  struct Binding
  {
    GLenum Target;
    GLint Name;
  };
  struct Setting
  {
    GLenum Name;
    GLint Value;
  };

  void SaveCapabilities();
  void SaveFragmentOperations();
  void SaveTextures();
  void SaveBuffers();
  void SaveImages();

  void RestoreCapabilities() const;
  void RestoreFragmentOperations() const;
  void RestoreTextures() const;
  void RestoreBuffers() const;
  void RestoreImages() const;

  int Version;
  bool Compute;

  std::vector<Setting> Capabilities;
  std::vector<DrawBuffer> DrawBuffers;

  GLint LogicOperation = 0;
  std::array<GLint, 2> BlendEquation{};
  std::array<GLint, 4> BlendFunction{};
  GLint DepthFunction = 0;
  GLboolean DepthMask = GL_TRUE;
  std::array<GLdouble, 2> DepthRange{};
  std::array<StencilFace, 2> StencilFaces{};
  std::array<GLint, 4> Viewport{};
  std::array<GLint, 4> Scissor{};
  std::array<GLint, 2> ClipControl{};
  std::array<GLint, 2> PolygonMode{};
  GLint CullFace = 0;
  GLint FrontFace = 0;
  GLint ProvokingVertex = 0;
  std::array<GLfloat, 4> ClearColor{};
  GLdouble ClearDepth = 1.0;

  GLint DrawFramebuffer = 0;
  GLint ReadFramebuffer = 0;
  GLint Program = 0;
  GLint ProgramPipeline = 0;
  GLint VertexArray = 0;

  GLint ActiveTexture = 0;
  std::array<TextureUnit, Units> TextureUnits{};
  std::vector<Binding> Buffers;
  std::vector<IndexedBuffer> IndexedBuffers;
  std::vector<ImageUnit> ImageUnits;
  std::vector<Setting> PixelStorage;
};

#endif
// VTK-HeaderTest-Exclude: vtkVoxelGLState.h
