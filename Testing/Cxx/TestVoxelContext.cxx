// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
// Proves of vtkVoxelContext, of the shared headless context as of a user's window:
// - a context comes up without a display, and nothing is printed on the way;
// - a scope starts from OpenGL's initial state, and leaves the context that was current before, all
//   the state that passes change, and a clean error flag behind, whatever is done inside;
// - an OpenGL error inside is reported, a shader that does not compile says where and why;
// - buffers, textures, framebuffers and programs compute what they should, delete themselves in
//   their context, and die quietly with the window;
// - ordinary VTK rendering works off-screen without a display, also with our work in between;
// - a window without OpenGL is refused with one sentence, and so is a machine without, while X
//   stands in for a missing EGL;
// - the shared context comes back when somebody closed its EGL display;
// - a process that was forked after the first use is told so, and the first one goes on.

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkStringOutputWindow.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVoxelContext.h"
#include "vtkVoxelContextScope.h"
#include "vtkVoxelCurrentContext.h"
#include "vtkVoxelGLObjects.h"
#include "vtkWindowToImageFilter.h"

#include <vtksys/SystemTools.hxx>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#ifdef __unix__
#include <dlfcn.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace
{
int Failures = 0;

void Expect(bool condition, const std::string& what)
{
  if (!condition)
  {
    std::cout << "Failed: " << what << std::endl;
    ++Failures;
  }
}

// A render window of a backend that is not OpenGL.
class OtherRenderWindow : public vtkRenderWindow
{
public:
  static OtherRenderWindow* New();
  vtkTypeMacro(OtherRenderWindow, vtkRenderWindow);
};
vtkStandardNewMacro(OtherRenderWindow);

struct Parameter
{
  GLenum Name;
  const char* Text;
};
#define PARAMETER(name)                                                                            \
  {                                                                                                \
    name, #name                                                                                    \
  }

const std::vector<Parameter> Parameters = { PARAMETER(GL_ACTIVE_TEXTURE),
  PARAMETER(GL_ARRAY_BUFFER_BINDING), PARAMETER(GL_BLEND), PARAMETER(GL_BLEND_DST_ALPHA),
  PARAMETER(GL_BLEND_DST_RGB), PARAMETER(GL_BLEND_EQUATION_ALPHA), PARAMETER(GL_BLEND_EQUATION_RGB),
  PARAMETER(GL_BLEND_SRC_ALPHA), PARAMETER(GL_BLEND_SRC_RGB), PARAMETER(GL_CLIP_DISTANCE0),
  PARAMETER(GL_CLIP_DISTANCE5), PARAMETER(GL_COLOR_CLEAR_VALUE), PARAMETER(GL_COLOR_LOGIC_OP),
  PARAMETER(GL_COLOR_WRITEMASK), PARAMETER(GL_COPY_READ_BUFFER), PARAMETER(GL_COPY_WRITE_BUFFER),
  PARAMETER(GL_CULL_FACE), PARAMETER(GL_CULL_FACE_MODE), PARAMETER(GL_CURRENT_PROGRAM),
  PARAMETER(GL_DEPTH_CLAMP), PARAMETER(GL_DEPTH_CLEAR_VALUE), PARAMETER(GL_DEPTH_FUNC),
  PARAMETER(GL_DEPTH_RANGE), PARAMETER(GL_DEPTH_TEST), PARAMETER(GL_DEPTH_WRITEMASK),
  PARAMETER(GL_DITHER), PARAMETER(GL_DRAW_FRAMEBUFFER_BINDING), PARAMETER(GL_FRAMEBUFFER_SRGB),
  PARAMETER(GL_FRONT_FACE), PARAMETER(GL_LINE_SMOOTH), PARAMETER(GL_LOGIC_OP_MODE),
  PARAMETER(GL_MULTISAMPLE), PARAMETER(GL_PACK_ALIGNMENT), PARAMETER(GL_PACK_ROW_LENGTH),
  PARAMETER(GL_PACK_SKIP_ROWS), PARAMETER(GL_PIXEL_PACK_BUFFER_BINDING),
  PARAMETER(GL_PIXEL_UNPACK_BUFFER_BINDING), PARAMETER(GL_POLYGON_OFFSET_FILL),
  PARAMETER(GL_PRIMITIVE_RESTART), PARAMETER(GL_PROGRAM_POINT_SIZE), PARAMETER(GL_PROVOKING_VERTEX),
  PARAMETER(GL_RASTERIZER_DISCARD), PARAMETER(GL_READ_FRAMEBUFFER_BINDING),
  PARAMETER(GL_SAMPLE_MASK), PARAMETER(GL_SCISSOR_BOX), PARAMETER(GL_SCISSOR_TEST),
  PARAMETER(GL_STENCIL_BACK_FAIL), PARAMETER(GL_STENCIL_BACK_FUNC),
  PARAMETER(GL_STENCIL_BACK_PASS_DEPTH_FAIL), PARAMETER(GL_STENCIL_BACK_PASS_DEPTH_PASS),
  PARAMETER(GL_STENCIL_BACK_REF), PARAMETER(GL_STENCIL_BACK_VALUE_MASK),
  PARAMETER(GL_STENCIL_BACK_WRITEMASK), PARAMETER(GL_STENCIL_FAIL), PARAMETER(GL_STENCIL_FUNC),
  PARAMETER(GL_STENCIL_PASS_DEPTH_FAIL), PARAMETER(GL_STENCIL_PASS_DEPTH_PASS),
  PARAMETER(GL_STENCIL_REF), PARAMETER(GL_STENCIL_TEST), PARAMETER(GL_STENCIL_VALUE_MASK),
  PARAMETER(GL_STENCIL_WRITEMASK), PARAMETER(GL_TEXTURE_BUFFER),
  PARAMETER(GL_UNIFORM_BUFFER_BINDING), PARAMETER(GL_UNPACK_ALIGNMENT),
  PARAMETER(GL_UNPACK_IMAGE_HEIGHT), PARAMETER(GL_UNPACK_ROW_LENGTH),
  PARAMETER(GL_VERTEX_ARRAY_BINDING), PARAMETER(GL_VIEWPORT) };

const std::vector<Parameter> ComputeParameters = { PARAMETER(GL_ATOMIC_COUNTER_BUFFER_BINDING),
  PARAMETER(GL_DISPATCH_INDIRECT_BUFFER_BINDING), PARAMETER(GL_DRAW_INDIRECT_BUFFER_BINDING),
  PARAMETER(GL_PROGRAM_PIPELINE_BINDING), PARAMETER(GL_SHADER_STORAGE_BUFFER_BINDING) };

const std::vector<Parameter> TextureParameters = { PARAMETER(GL_TEXTURE_BINDING_2D),
  PARAMETER(GL_TEXTURE_BINDING_2D_ARRAY), PARAMETER(GL_TEXTURE_BINDING_3D),
  PARAMETER(GL_TEXTURE_BINDING_BUFFER), PARAMETER(GL_SAMPLER_BINDING) };

const std::vector<Parameter> IndexedParameters = { PARAMETER(GL_UNIFORM_BUFFER_BINDING),
  PARAMETER(GL_UNIFORM_BUFFER_START), PARAMETER(GL_UNIFORM_BUFFER_SIZE),
  PARAMETER(GL_COLOR_WRITEMASK) };

const std::vector<Parameter> IndexedComputeParameters = { PARAMETER(
                                                            GL_SHADER_STORAGE_BUFFER_BINDING),
  PARAMETER(GL_SHADER_STORAGE_BUFFER_START), PARAMETER(GL_SHADER_STORAGE_BUFFER_SIZE),
  PARAMETER(GL_IMAGE_BINDING_NAME), PARAMETER(GL_IMAGE_BINDING_FORMAT),
  PARAMETER(GL_IMAGE_BINDING_ACCESS), PARAMETER(GL_IMAGE_BINDING_LAYERED) };

using State = std::map<std::string, std::vector<double>>;

// The state as OpenGL has it, from the current context.
State QueryState(bool compute)
{
  State state;
  const auto query = [&state](const Parameter& parameter, const std::string& suffix)
  {
    std::vector<double> values(4, 0.0);
    glGetDoublev(parameter.Name, values.data());
    state[parameter.Text + suffix] = values;
  };
  const auto queryIndexed = [&state](const Parameter& parameter, GLuint index)
  {
    GLint64 values[4] = { 0, 0, 0, 0 };
    glGetInteger64i_v(parameter.Name, index, values);
    state[parameter.Text + std::to_string(index)] =
      std::vector<double>(std::begin(values), std::end(values));
  };
  for (const Parameter& parameter : Parameters)
  {
    query(parameter, "");
  }
  for (GLuint i = 0; i < 8; ++i)
  {
    state["GL_BLEND" + std::to_string(i)] = { double(glIsEnabledi(GL_BLEND, i)) };
    for (const Parameter& parameter : IndexedParameters)
    {
      queryIndexed(parameter, i);
    }
  }
  if (compute)
  {
    for (const Parameter& parameter : ComputeParameters)
    {
      query(parameter, "");
    }
    for (GLuint i = 0; i < 8; ++i)
    {
      for (const Parameter& parameter : IndexedComputeParameters)
      {
        queryIndexed(parameter, i);
      }
    }
  }
  GLint active = 0;
  glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
  for (GLuint i = 0; i < 8; ++i)
  {
    glActiveTexture(GL_TEXTURE0 + i);
    for (const Parameter& parameter : TextureParameters)
    {
      query(parameter, " of unit " + std::to_string(i));
    }
  }
  glActiveTexture(static_cast<GLenum>(active));
  return state;
}

void ExpectSame(const State& before, const State& after, const std::string& where)
{
  for (const auto& [name, value] : before)
  {
    Expect(after.at(name) == value, where + ": " + name + " has changed");
  }
}

// Objects to bind, and a way to set all the state that a scope takes care of.
class Mess
{
public:
  Mess(const vtkVoxelGL::Context& context, bool compute)
    : Compute(compute)
    , Bytes(context)
    , Flat(context, GL_TEXTURE_2D)
    , Layers(context, GL_TEXTURE_2D_ARRAY)
    , Solid(context, GL_TEXTURE_3D)
    , Texels(context, GL_TEXTURE_BUFFER)
    , Target(context)
    , Vertices(context)
  {
    Expect(this->Bytes.Allocate(4096), "4096 bytes of a buffer");
    Expect(this->Flat.Allocate2D(GL_R32UI, 8, 8, GL_RED_INTEGER, GL_UNSIGNED_INT), "2D texture");
    Expect(this->Layers.Allocate3D(GL_R32UI, 8, 8, 3, GL_RED_INTEGER, GL_UNSIGNED_INT),
      "2D array texture");
    Expect(
      this->Solid.Allocate3D(GL_R32UI, 8, 8, 8, GL_RED_INTEGER, GL_UNSIGNED_INT), "3D texture");
    this->Texels.AttachBuffer(GL_R32UI, this->Bytes);
    this->Target.Attach(GL_COLOR_ATTACHMENT0, this->Flat);
    std::string log;
    this->Painter = vtkVoxelGL::Program::Build(context, "#version 150\n", {},
      { { GL_VERTEX_SHADER, { "void main() { gl_Position = vec4(0.0, 0.0, 0.0, 1.0); }" } },
        { GL_FRAGMENT_SHADER, { "out uvec4 word; void main() { word = uvec4(1u); }" } } },
      log);
    Expect(bool(this->Painter), "a simple program compiles: " + log);
  }

  // Different values of all state for different seeds.
  void Set(int seed)
  {
    const bool odd = seed % 2 == 1;
    const GLuint offset = 256u * static_cast<GLuint>(seed);
    for (GLenum name : { GL_COLOR_LOGIC_OP, GL_CULL_FACE, GL_DEPTH_CLAMP, GL_DEPTH_TEST, GL_DITHER,
           GL_FRAMEBUFFER_SRGB, GL_LINE_SMOOTH, GL_MULTISAMPLE, GL_POLYGON_OFFSET_FILL,
           GL_PRIMITIVE_RESTART, GL_PROGRAM_POINT_SIZE, GL_RASTERIZER_DISCARD, GL_SAMPLE_MASK,
           GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_CLIP_DISTANCE0, GL_CLIP_DISTANCE5 })
    {
      (odd ? glEnable : glDisable)(name);
    }
    for (GLuint i = 0; i < 8; ++i)
    {
      ((i % 2 == 1) == odd ? glEnablei : glDisablei)(GL_BLEND, i);
      glColorMaski(i, odd, !odd, i % 2 == 0, GL_TRUE);
      glBindBufferRange(GL_UNIFORM_BUFFER, i, this->Bytes.GetName(), offset, 256);
      this->Flat.Bind(i);
      this->Layers.Bind(odd ? i : 0);
      this->Solid.Bind(odd ? 7 - i : i);
      this->Texels.Bind(odd ? i : 3);
    }
    glLogicOp(odd ? GL_XOR : GL_AND);
    glBlendEquationSeparate(odd ? GL_MAX : GL_MIN, GL_FUNC_SUBTRACT);
    glBlendFuncSeparate(odd ? GL_ZERO : GL_SRC_COLOR, GL_ONE, GL_DST_ALPHA, GL_ZERO);
    glDepthFunc(odd ? GL_ALWAYS : GL_GREATER);
    glDepthMask(odd);
    glDepthRange(0.25, odd ? 0.5 : 0.75);
    glStencilFuncSeparate(GL_FRONT, odd ? GL_LESS : GL_EQUAL, odd ? 3 : 4, odd ? 0x0f : 0x3f);
    glStencilFuncSeparate(GL_BACK, odd ? GL_NEVER : GL_LEQUAL, odd ? 5 : 6, odd ? 0x1f : 0x7f);
    glStencilOpSeparate(GL_FRONT, odd ? GL_INVERT : GL_ZERO, GL_REPLACE, odd ? GL_DECR : GL_INCR);
    glStencilOpSeparate(GL_BACK, odd ? GL_INCR : GL_DECR, GL_INVERT, odd ? GL_ZERO : GL_REPLACE);
    glStencilMaskSeparate(GL_FRONT, odd ? 0x33 : 0x55);
    glStencilMaskSeparate(GL_BACK, odd ? 0x77 : 0x11);
    glClearColor(0.25f, 0.5f, odd ? 0.0f : 1.0f, 1.0f);
    glClearDepth(odd ? 0.125 : 0.5);
    glViewport(1, 2, 30 + seed, 40);
    glScissor(3, 4, 50 + seed, 60);
    glCullFace(odd ? GL_FRONT : GL_FRONT_AND_BACK);
    glFrontFace(odd ? GL_CW : GL_CCW);
    glProvokingVertex(odd ? GL_FIRST_VERTEX_CONVENTION : GL_LAST_VERTEX_CONVENTION);
    glPixelStorei(GL_PACK_ALIGNMENT, odd ? 2 : 8);
    glPixelStorei(GL_UNPACK_ALIGNMENT, odd ? 8 : 2);
    glPixelStorei(GL_PACK_ROW_LENGTH, 10 + seed);
    glPixelStorei(GL_PACK_SKIP_ROWS, seed);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 20 + seed);
    glPixelStorei(GL_UNPACK_IMAGE_HEIGHT, 30 + seed);
    const GLuint name = odd ? this->Bytes.GetName() : 0;
    for (GLenum target : { GL_ARRAY_BUFFER, GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER,
           GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER, GL_TEXTURE_BUFFER, GL_UNIFORM_BUFFER })
    {
      glBindBuffer(target, name);
    }
    this->Target.Bind(odd ? GL_FRAMEBUFFER : GL_READ_FRAMEBUFFER);
    glBindVertexArray(odd ? this->Vertices.GetName() : 0);
    glUseProgram(odd ? this->Painter.GetName() : 0);
    if (this->Compute)
    {
      for (GLenum target :
        { GL_DISPATCH_INDIRECT_BUFFER, GL_DRAW_INDIRECT_BUFFER, GL_ATOMIC_COUNTER_BUFFER })
      {
        glBindBuffer(target, name);
      }
      for (GLuint i = 0; i < 8; ++i)
      {
        glBindBufferRange(
          GL_SHADER_STORAGE_BUFFER, i, this->Bytes.GetName(), offset, GLsizeiptr(256) * (i + 1));
        glBindImageTexture(
          i, this->Layers.GetName(), 0, odd, 1, odd ? GL_WRITE_ONLY : GL_READ_WRITE, GL_R32UI);
      }
      glBindBuffer(GL_SHADER_STORAGE_BUFFER, name);
    }
    glActiveTexture(GL_TEXTURE0 + static_cast<GLuint>(seed) + 2);
  }

private:
  bool Compute;
  vtkVoxelGL::Buffer Bytes;
  vtkVoxelGL::Texture Flat;
  vtkVoxelGL::Texture Layers;
  vtkVoxelGL::Texture Solid;
  vtkVoxelGL::Texture Texels;
  vtkVoxelGL::Framebuffer Target;
  vtkVoxelGL::VertexArray Vertices;
  vtkVoxelGL::Program Painter;
};

void TestScopeRestoresState(vtkVoxelContext* context)
{
  Expect(context->MakeCurrent(), "context is current: " + context->GetErrorMessage());
  const bool compute = context->SupportsCompute();
  const vtkVoxelCurrentContext current;
  {
    vtkVoxelContext::Scope outer(context);
    Mess mess(context->GetRecord(), compute);
    const State untouched = QueryState(compute);
    for (int seed : { 1, 2 })
    {
      mess.Set(seed);
      const State before = QueryState(compute);
      Expect(glGetError() == GL_NO_ERROR, "setting and reading the state is no error");
      {
        vtkVoxelContext::Scope inner(context);
        const State inside = QueryState(compute);
        Expect(inside.at("GL_COLOR_WRITEMASK") == std::vector<double>(4, 1.0),
          "color masks let everything through inside a scope");
        for (const char* name : { "GL_BLEND", "GL_COLOR_LOGIC_OP", "GL_SCISSOR_TEST",
               "GL_STENCIL_TEST", "GL_CULL_FACE", "GL_RASTERIZER_DISCARD", "GL_CURRENT_PROGRAM",
               "GL_PIXEL_PACK_BUFFER_BINDING", "GL_TEXTURE_BINDING_2D of unit 3" })
        {
          Expect(inside.at(name)[0] == 0.0, std::string(name) + " is off inside a scope");
        }
        Expect(inside.at("GL_PACK_ALIGNMENT")[0] == 1.0, "pixels are packed inside a scope");
        mess.Set(3 - seed);
        Expect(QueryState(compute) != before, "the test changes the state");
      }
      Expect(glGetError() == GL_NO_ERROR, "a scope leaves the error flag clean");
      ExpectSame(before, QueryState(compute), "after a scope");
    }
    Expect(untouched.at("GL_BLEND")[0] == 0.0, "no blending at the start of a scope");
  }
  Expect(current == vtkVoxelCurrentContext(), "the context is still current");
  Expect(glGetError() == GL_NO_ERROR, "the error flag is clean");
}

void TestErrorsAreReported(vtkVoxelContext* context)
{
  vtkVoxelContext::Scope scope(context);
  Expect(scope.Check("resting"), "no error to begin with");
  glEnable(GL_TEXTURE_BINDING_2D);
  Expect(!scope.Check("testing errors"), "an OpenGL error is seen");
  Expect(context->GetErrorMessage() == "OpenGL reports \"invalid enumerant\" while testing errors.",
    "the message tells what and when: " + context->GetErrorMessage());
  Expect(scope.Check("resting"), "an error is reported once");

  vtkVoxelGL::Buffer huge(context->GetRecord());
  Expect(
    !huge.Allocate(std::size_t(1) << 46) && huge.GetSize() == 0, "a buffer of 64 TiB is refused");
  Expect(scope.Check("resting"), "which is no further error");

  std::string log;
  for (const char* version : { "#version 150 core\n", "#version 330 core\n" })
  {
    const auto program =
      vtkVoxelGL::Program::Build(context->GetRecord(), version, { { "HALF", "0.5" } },
        { { GL_VERTEX_SHADER,
          { "float size() { return HALF; }", "void main()\n{\n  gl_Position = nonsense;\n}" } } },
        log);
    Expect(!program, "a shader with an undeclared name does not compile");
    const bool place = log.find(":3(") != std::string::npos || log.find("(3)") != std::string::npos;
    Expect(place && log.find("nonsense") != std::string::npos,
      "the log names the third line of the source and the name: " + log);
  }
  Expect(scope.Check("compiling"), "a shader that fails to compile sets no OpenGL error");
}

void TestBuffers(vtkVoxelContext* context)
{
  vtkVoxelContext::Scope scope(context);
  std::vector<std::uint32_t> words(1000);
  std::iota(words.begin(), words.end(), 7u);
  vtkVoxelGL::Buffer first(context->GetRecord());
  Expect(first.Allocate(4000, words.data()), "4000 bytes");
  vtkVoxelGL::Buffer second(context->GetRecord());
  Expect(second.Allocate(4000), "another 4000 bytes");
  second.Fill(0xabcd1234u);
  first.CopyTo(second, 40, 400, 80);
  std::vector<std::uint32_t> result(1000, 0u);
  second.Download(0, 4000, result.data());
  std::vector<std::uint32_t> expected(1000, 0xabcd1234u);
  std::copy(words.begin() + 10, words.begin() + 30, expected.begin() + 100);
  Expect(result == expected, "fill, copy and download of buffers");

  vtkVoxelGL::Buffer moved = std::move(first);
  Expect(!first && moved && moved.GetSize() == 4000, "a buffer can be moved");
  {
    const vtkVoxelGL::MappedBuffer mapped(moved, 8, 400, GL_MAP_READ_BIT);
    Expect(mapped.Get() && std::memcmp(mapped.Get(), words.data() + 2, 400) == 0,
      "a mapped buffer shows its words");
  }
  Expect(scope.Check("working with buffers"), context->GetErrorMessage());
}

// Three triangles that cover the whole target each set another bit of it by XOR; one of them twice.
void TestRaster(vtkVoxelContext* context)
{
  vtkVoxelContext::Scope scope(context);
  const vtkVoxelGL::Context record = context->GetRecord();
  vtkVoxelGL::Texture target(record, GL_TEXTURE_2D);
  Expect(target.Allocate2D(GL_R32UI, 16, 16, GL_RED_INTEGER, GL_UNSIGNED_INT), "target");
  vtkVoxelGL::Framebuffer framebuffer(record);
  framebuffer.Attach(GL_COLOR_ATTACHMENT0, target);
  framebuffer.SetDrawBuffers(1);
  Expect(framebuffer.IsComplete(), "framebuffer is complete");
  std::string log;
  auto program = vtkVoxelGL::Program::Build(record, "#version 150\n", { { "SIZE", "4.0" } },
    { { GL_VERTEX_SHADER,
        { "void main()\n{\n"
          "  vec2 corner = vec2(gl_VertexID % 3 == 1, gl_VertexID % 3 == 2);\n"
          "  gl_Position = vec4(SIZE * corner - 1.0, 0.0, 1.0);\n}" } },
      { GL_FRAGMENT_SHADER,
        { "uniform uint Word; out uint Result; void main() { Result = Word; }" } } },
    log);
  Expect(bool(program), "the raster program compiles: " + log);
  vtkVoxelGL::VertexArray vertices(record);
  vertices.Bind();
  program.Use();
  glViewport(0, 0, 16, 16);
  const GLuint zero[4] = { 0, 0, 0, 0 };
  glClearBufferuiv(GL_COLOR, 0, zero);
  glEnable(GL_COLOR_LOGIC_OP);
  glLogicOp(GL_XOR);
  vtkVoxelGL::Query samples(record);
  samples.Begin(GL_SAMPLES_PASSED);
  for (unsigned int word : { 1u, 2u, 0x80000000u, 2u })
  {
    program.Set("Word", word);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  samples.End();
  std::vector<GLuint> pixels(256, 0u);
  glReadPixels(0, 0, 16, 16, GL_RED_INTEGER, GL_UNSIGNED_INT, pixels.data());
  Expect(pixels == std::vector<GLuint>(256, 0x80000001u), "XOR of bits into an integer target");
  Expect(samples.GetResult() == 4u * 256u, "every triangle covers every pixel once");
  Expect(scope.Check("drawing"), context->GetErrorMessage());
}

void TestCompute(vtkVoxelContext* context)
{
  if (!context->SupportsCompute())
  {
    std::cout << "No compute shaders on " << context->GetRendererName() << "\n";
    return;
  }
  vtkVoxelContext::Scope scope(context);
  std::string log;
  auto program =
    vtkVoxelGL::Program::Build(context->GetRecord(), "#version 430\n", { { "GROUP", "64" } },
      { { GL_COMPUTE_SHADER,
        { "layout(local_size_x = GROUP) in;\n"
          "layout(std430, binding = 0) buffer Words { uint words[]; };\n",
          "uniform uint Factor;\n"
          "uniform double Offset;\n"
          "void main() { uint i = gl_GlobalInvocationID.x; words[i] = i * Factor + uint(Offset); "
          "}" } } },
      log);
  Expect(bool(program), "the compute program compiles: " + log);
  vtkVoxelGL::Buffer words(context->GetRecord());
  Expect(words.Allocate(256 * sizeof(GLuint)), "words");
  words.BindBase(GL_SHADER_STORAGE_BUFFER, 0);
  program.Use();
  program.Set("Factor", 3u);
  program.Set("Offset", 5.0);
  glDispatchCompute(4, 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<std::uint32_t> result(256);
  words.Download(0, 1024, result.data());
  bool good = true;
  for (std::uint32_t i = 0; i < 256; ++i)
  {
    good = good && result[i] == 3 * i + 5;
  }
  Expect(good, "a compute shader writes 3 i + 5");
  Expect(scope.Check("computing"), context->GetErrorMessage());
}

void TestAll(vtkVoxelContext* context)
{
  TestScopeRestoresState(context);
  TestErrorsAreReported(context);
  TestBuffers(context);
  TestRaster(context);
  TestCompute(context);
}

vtkSmartPointer<vtkImageData> Render(vtkRenderWindow* window)
{
  window->Render();
  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(window);
  grabber->ReadFrontBufferOff();
  grabber->Update();
  return grabber->GetOutput();
}

bool SamePixels(vtkImageData* a, vtkImageData* b)
{
  auto* first = vtkUnsignedCharArray::SafeDownCast(a->GetPointData()->GetScalars());
  auto* second = vtkUnsignedCharArray::SafeDownCast(b->GetPointData()->GetScalars());
  const vtkIdType size = first->GetNumberOfValues();
  return size == second->GetNumberOfValues() &&
    std::memcmp(first->GetPointer(0), second->GetPointer(0), static_cast<std::size_t>(size)) == 0;
}

// A red sphere of half the window's height on blue: the picture is right, and stays so when this
// module works in the window's context and in the shared one between frames.
void TestRendering(vtkRenderWindow* window, const std::string& picture)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.5);
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(64);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(1.0, 0.0, 0.0);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->SetBackground(0.0, 0.0, 1.0);
  renderer->GetActiveCamera()->ParallelProjectionOn();
  renderer->GetActiveCamera()->SetParallelScale(1.0);
  window->SetMultiSamples(0);
  window->SetSize(200, 160);
  window->AddRenderer(renderer);

  const vtkSmartPointer<vtkImageData> image = Render(window);
  int size[3];
  image->GetDimensions(size);
  Expect(size[0] == 200 && size[1] == 160, "the picture has the size of the window");
  int red = 0;
  int blue = 0;
  for (int y = 0; y < size[1]; ++y)
  {
    for (int x = 0; x < size[0]; ++x)
    {
      const auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
      red += pixel[0] > 0 && pixel[1] == 0 && pixel[2] == 0;
      blue += pixel[0] == 0 && pixel[1] == 0 && pixel[2] == 255;
    }
  }
  // The disc has a radius of 40 pixels; its circumference of 251 pixels bounds the error.
  const double disc = 3.14159265 * 40.0 * 40.0;
  Expect(std::abs(red - disc) < 126.0, "a disc of red pixels: " + std::to_string(red));
  Expect(red + blue == 200 * 160, "all other pixels are background: " + std::to_string(blue));

  vtkNew<vtkVoxelContext> here;
  here->SetRenderWindow(window);
  TestAll(here);
  vtkNew<vtkVoxelContext> shared;
  TestAll(shared);
  vtkVoxelCurrentContext::Release();
  Expect(SamePixels(image, Render(window)), "the next frame looks the same");

  if (!picture.empty())
  {
    vtkNew<vtkPNGWriter> writer;
    writer->SetFileName(picture.c_str());
    writer->SetInputData(image);
    writer->Write();
  }
}

void TestSharedContext()
{
  const vtkVoxelCurrentContext before;
  vtkNew<vtkVoxelContext> first;
  vtkNew<vtkVoxelContext> second;
  Expect(
    first->GetOpenGLRenderWindow() != nullptr, "there is a window: " + first->GetErrorMessage());
  Expect(before == vtkVoxelCurrentContext(), "asking for the window makes nothing current");
  Expect(first->GetRecord() && first->GetRecord() == second->GetRecord(),
    "all of the process share the headless context");
  Expect(first->GetVersion() >= 32 && first->GetVersion() < 100, "OpenGL 3.2 or better");
  Expect(!first->GetRendererName().empty(), "the renderer has a name");
  Expect(!first->SupportsCompute() || first->GetVersion() >= 32, "compute needs OpenGL");
  {
    vtkVoxelContext::Scope scope(first);
    Expect(bool(scope), "a scope can be entered");
    Expect(!(before == vtkVoxelCurrentContext()), "inside, the context is current");
  }
  Expect(before == vtkVoxelCurrentContext(), "after a scope, what was current before is again");
  TestAll(first);
  vtkVoxelCurrentContext::Release();
}

// What a user's window has made dies with it, and the context falls back to the shared one.
void TestWindowGoes(vtkSmartPointer<vtkRenderWindow> window)
{
  vtkNew<vtkVoxelContext> context;
  context->SetRenderWindow(window);
  Expect(context->GetRenderWindow() == window, "the window is set");
  Expect(context->GetOpenGLRenderWindow() == window, "and used");
  vtkVoxelGL::Buffer buffer;
  vtkVoxelGL::Buffer finalized;
  {
    vtkVoxelContext::Scope scope(context);
    finalized = vtkVoxelGL::Buffer(context->GetRecord());
    Expect(finalized.Allocate(64), "a buffer in the user's window");
  }
  window->Finalize();
  Expect(!finalized, "a finalized window takes its buffers along");
  {
    vtkVoxelContext::Scope scope(context);
    Expect(bool(scope), "the window comes up again: " + context->GetErrorMessage());
    buffer = vtkVoxelGL::Buffer(context->GetRecord());
    Expect(buffer.Allocate(64), "a buffer in its second context");
  }
  Expect(bool(buffer) && !finalized, "each context has its own objects");
  // What is cached for the context may own the context's record, as the passes do.
  context->GetRecord()->GetCache()["buffer"] =
    std::make_shared<vtkVoxelGL::Buffer>(std::move(buffer));
  const std::weak_ptr<vtkVoxelContextRecord> record = context->GetRecord();
  context->SetRenderWindow(nullptr);
  Expect(!record.expired(), "the cache lives as long as the context");
  context->SetRenderWindow(window);
  const int references = window->GetReferenceCount();
  Expect(references == 1, "the context does not own the window: " + std::to_string(references));
  window = nullptr;
  context->GetRecord();
  Expect(record.expired(), "a deleted window takes its cache along");
  Expect(context->GetRenderWindow() == nullptr, "no user's window any more");
  vtkNew<vtkVoxelContext> shared;
  Expect(context->GetRecord() == shared->GetRecord(), "the shared context takes over");
}

// Objects that outlive the scope delete themselves in their own context.
void TestLateDeletion()
{
  vtkNew<vtkVoxelContext> shared;
  vtkVoxelGL::Buffer buffer;
  GLuint name = 0;
  {
    vtkVoxelContext::Scope scope(shared);
    buffer = vtkVoxelGL::Buffer(shared->GetRecord());
    Expect(buffer.Allocate(64), "a buffer in the shared context");
    name = buffer.GetName();
    Expect(glIsBuffer(name) == GL_TRUE, "it is one");
  }
  const vtkVoxelCurrentContext before;
  buffer.Reset();
  Expect(before == vtkVoxelCurrentContext(), "deleting changes nothing of what is current");
  vtkVoxelContext::Scope scope(shared);
  Expect(glIsBuffer(name) == GL_FALSE, "the buffer is gone");
}

void TestOtherWindow()
{
  vtkNew<OtherRenderWindow> other;
  vtkNew<vtkVoxelContext> context;
  context->SetRenderWindow(other);
  Expect(!context->MakeCurrent(), "a window without OpenGL gives no context");
  Expect(context->GetErrorMessage().find("OtherRenderWindow") != std::string::npos,
    "the message names the class: " + context->GetErrorMessage());
  Expect(context->GetRecord() == nullptr && context->GetVersion() == 0 &&
      context->GetRendererName().empty() && !context->SupportsCompute(),
    "nothing is known about no context");
  vtkVoxelContext::Scope scope(context);
  Expect(!scope, "nor can a scope be entered");
  context->SetRenderWindow(nullptr);
  Expect(context->MakeCurrent() && context->GetErrorMessage().empty(), "the shared one is there");
  vtkVoxelCurrentContext::Release();
}

#ifdef __unix__
// Collects what anyone, drivers included, writes to the standard error as long as it lives.
class CapturedErrors
{
public:
  CapturedErrors()
    : File(std::tmpfile())
    , Original(dup(STDERR_FILENO))
  {
    dup2(fileno(this->File), STDERR_FILENO);
  }
  ~CapturedErrors()
  {
    dup2(this->Original, STDERR_FILENO);
    close(this->Original);
    std::fclose(this->File);
  }
  CapturedErrors(const CapturedErrors&) = delete;
  CapturedErrors& operator=(const CapturedErrors&) = delete;

  std::string GetText() const
  {
    std::string text;
    std::fseek(this->File, 0, SEEK_SET);
    for (int c = std::fgetc(this->File); c != EOF; c = std::fgetc(this->File))
    {
      text += static_cast<char>(c);
    }
    return text;
  }

private:
  std::FILE* File;
  int Original;
};

// Runs the check in a process of its own, since there is one shared context a process.
void InChild(const std::string& what, void (*check)())
{
  const pid_t child = fork();
  if (child == 0)
  {
    check();
    _exit(Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE);
  }
  int status = -1;
  waitpid(child, &status, 0);
  Expect(WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS, what);
}

void TestForkedLate()
{
  vtkNew<vtkVoxelContext> context;
  Expect(!context->MakeCurrent(), "the context is the parent's");
  const std::string message = context->GetErrorMessage();
  Expect(message.find("forked") != std::string::npos, "why: " + message);
}

void HideEGLDrivers()
{
  setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent", 1);
}

void TestNoOpenGL()
{
  HideEGLDrivers();
  unsetenv("DISPLAY");
  vtkNew<vtkVoxelContext> context;
  Expect(!context->MakeCurrent(), "no OpenGL, no context");
  const std::string message = context->GetErrorMessage();
  Expect(message.find("libegl1") != std::string::npos, "what to install: " + message);
  Expect(message.find('\n') == std::string::npos, "one line: " + message);
  Expect(vtkVoxelContext::NewHeadlessRenderWindow() == nullptr, "nor a window");
  if (VTK_VOXEL_USES_GLEW)
  {
    // VTK's X window ends the process when it is asked itself.
    vtkNew<vtkRenderWindow> window;
    context->SetRenderWindow(window);
    Expect(!context->MakeCurrent(), "no context of an X window without a server");
  }
}

void TestOnlyX()
{
  HideEGLDrivers();
  vtkNew<vtkVoxelContext> context;
  Expect(context->MakeCurrent(), "X stands in: " + context->GetErrorMessage());
  Expect(context->GetOpenGLRenderWindow()->IsA("vtkXOpenGLRenderWindow"),
    context->GetOpenGLRenderWindow()->GetClassName());
  TestAll(context);
}

void TestClosedDisplay()
{
  vtkNew<vtkVoxelContext> context;
  vtkVoxelGL::Buffer buffer;
  {
    vtkVoxelContext::Scope scope(context);
    buffer = vtkVoxelGL::Buffer(context->GetRecord());
    Expect(buffer.Allocate(64), "a buffer");
  }
  void* library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_NOLOAD);
  if (!library || !context->GetOpenGLRenderWindow()->IsA("vtkVoxelEGLRenderWindow"))
  {
    return;
  }
  const auto terminate = reinterpret_cast<unsigned int (*)(void*)>(dlsym(library, "eglTerminate"));
  Expect(terminate(context->GetOpenGLRenderWindow()->GetGenericDisplayId()), "display is closed");
  {
    vtkVoxelContext::Scope scope(context);
    Expect(bool(scope), "the shared context is back: " + context->GetErrorMessage());
    Expect(!buffer, "without what was in the old one");
  }
  TestAll(context);
}
#endif
}

int TestVoxelContext(int argc, char* argv[])
{
  vtkNew<vtkStringOutputWindow> output;
  vtkOutputWindow::SetInstance(output);
  const bool display = std::getenv("DISPLAY") != nullptr;
#ifdef __unix__
  const CapturedErrors errors;
  InChild("no OpenGL is an error of one sentence", TestNoOpenGL);
  InChild("the shared context survives that its display is closed", TestClosedDisplay);
  if (display)
  {
    InChild("X stands in for EGL", TestOnlyX);
  }
#endif
  TestSharedContext();
  TestLateDeletion();
  TestOtherWindow();

  vtkSmartPointer<vtkRenderWindow> headless;
  headless.TakeReference(vtkVoxelContext::NewHeadlessRenderWindow());
  Expect(headless != nullptr, "there is a headless window");
  TestRendering(headless, argc > 1 ? argv[1] : "");
  TestWindowGoes(std::move(headless));

  // VTK before 9.4 has only X windows where it was built for X; later ones complain about a missing
  // display before they take EGL by themselves.
  if (!display)
  {
    vtksys::SystemTools::PutEnv("VTK_DEFAULT_OPENGL_WINDOW=vtkEGLRenderWindow");
  }
  if (display || !VTK_VOXEL_USES_GLEW)
  {
    // An X server may start over when its last client leaves, and refuse new ones meanwhile.
    vtkNew<vtkRenderWindow> keeper;
    keeper->SetOffScreenRendering(1);
    keeper->Render();
    auto users = vtkSmartPointer<vtkRenderWindow>::New();
    users->SetOffScreenRendering(1);
    std::cout << "The user's window is a " << users->GetClassName() << "\n";
    TestRendering(users, "");
    TestWindowGoes(std::move(users));
  }

  vtkNew<vtkVoxelContext> context;
  std::cout << context->GetRendererName() << ", OpenGL " << context->GetVersion() / 10.0
            << (context->SupportsCompute() ? " with" : " without") << " compute shaders\n";

#ifdef __unix__
  InChild("a process forked too late has no context", TestForkedLate);
  Expect(context->MakeCurrent(), "the first process keeps its context");
#endif

  // Left to the end of the process, where sanitizers watch.
  {
    vtkVoxelContext::Scope scope(context);
    context->GetRecord()->GetCache()["left"] =
      std::make_shared<vtkVoxelGL::Buffer>(context->GetRecord());
  }

  std::string printed = output->GetOutput();
#ifdef __unix__
  printed += errors.GetText();
#endif
  Expect(printed.empty(), "nothing is printed, but was: " + printed);
  vtkOutputWindow::SetInstance(nullptr);
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
