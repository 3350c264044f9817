// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDepthPropPainter.h"

#include "vtkActor.h"
#include "vtkBoundingBox.h"
#include "vtkContourValues.h"
#include "vtkDepthBuffers.h"
#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLCamera.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLRenderer.h"
#include "vtkOpenGLState.h"
#include "vtkPolyDataMapper.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"
#include "vtkShaderProperty.h"
#include "vtkSmartPointer.h"
#include "vtkUniforms.h"
#include "vtkVolume.h"
#include "vtkVolumeMapper.h"
#include "vtkVolumeProperty.h"
#include "vtkVoxelContext.h"
#include "vtkVoxelCurrentContext.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>

namespace
{
using Side = vtkDepthView::Side;

/// What VTK gives a prop for a still image; those with levels of detail take the finest.
constexpr double SecondsOfStillImage = 10.0;

/// A renderer whose viewport has a size of its own, whatever the window's is.
class DepthRenderer : public vtkOpenGLRenderer
{
public:
  static DepthRenderer* New();
  vtkTypeMacro(DepthRenderer, vtkOpenGLRenderer);

  void GetTiledSizeAndOrigin(int* width, int* height, int* left, int* low) override
  {
    *width = this->ViewportSize.x;
    *height = this->ViewportSize.y;
    *left = 0;
    *low = 0;
  }

  glm::ivec2 ViewportSize{ 1 };
};
vtkStandardNewMacro(DepthRenderer);

/// VTK stores matrices row by row.
void Copy(const glm::dmat4& from, vtkMatrix4x4* to)
{
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      to->SetElement(row, column, from[column][row]);
    }
  }
}

glm::dmat4 ToGlm(vtkMatrix4x4* matrix)
{
  glm::dmat4 result;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      result[column][row] = matrix->GetElement(row, column);
    }
  }
  return result;
}

/// A camera that stands where mappers expect it, in front of all depths of the view, but projects
/// as the view does: it may shear, mirror and stretch.
void Aim(vtkCamera* camera, const vtkDepthView& view, Side side)
{
  const glm::dmat4 viewToWorld = glm::inverse(view.WorldToView);
  const glm::dvec3 size(view.Size);
  const glm::dvec3 centre(viewToWorld * glm::dvec4(0.5 * (size - 1.0), 1.0));
  const double towards = side == Side::Near ? 1.0 : -1.0;
  const glm::dvec3 reach = towards * size.z * glm::dvec3(viewToWorld[2]);
  const glm::dvec3 position = centre - reach;
  const double length = glm::length(reach);
  camera->SetPosition(position.x, position.y, position.z);
  camera->SetFocalPoint(centre.x, centre.y, centre.z);
  camera->SetViewUp(viewToWorld[1].x, viewToWorld[1].y, viewToWorld[1].z);
  camera->SetClippingRange(0.5 * length, 1.5 * length);
  camera->ParallelProjectionOn();
  camera->SetParallelScale(0.5 * view.GetViewport().y * glm::length(glm::dvec3(viewToWorld[1])));
  vtkNew<vtkMatrix4x4> projection;
  Copy(
    view.GetWorldToClip(side) * glm::inverse(ToGlm(camera->GetViewTransformMatrix())), projection);
  camera->SetExplicitProjectionTransformMatrix(projection);
  camera->UseExplicitProjectionTransformMatrixOn();
}

/// OpenGL's clip coordinates are left-handed; a view that is not shows faces mirrored.
bool IsMirrored(const vtkDepthView& view, Side side)
{
  return glm::determinant(glm::dmat3(view.GetWorldToClip(side))) > 0.0;
}

/// Windows other than `window` in which the prop was drawn.
std::set<vtkOpenGLRenderWindow*> GetOtherWindows(vtkProp* prop, vtkOpenGLRenderWindow* window)
{
  std::set<vtkOpenGLRenderWindow*> windows;
  for (int i = 0; i < prop->GetNumberOfConsumers(); ++i)
  {
    auto* renderer = vtkRenderer::SafeDownCast(prop->GetConsumer(i));
    auto* other =
      renderer ? vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()) : nullptr;
    if (other && other != window)
    {
      windows.insert(other);
    }
  }
  return windows;
}

/// The window of the context is current as long as this lives.
class CurrentWindow
{
public:
  explicit CurrentWindow(vtkVoxelContext* context)
  {
    if (!context->MakeCurrent())
    {
      this->Before.Restore();
      throw std::runtime_error(context->GetErrorMessage());
    }
  }
  ~CurrentWindow() { this->Before.Restore(); }
  CurrentWindow(const CurrentWindow&) = delete;
  CurrentWindow& operator=(const CurrentWindow&) = delete;

private:
  vtkVoxelCurrentContext Before;
};

/// VTK's record of the state of OpenGL is as before when this goes, and so is the state.
class SavedState
{
public:
  explicit SavedState(vtkOpenGLState* state)
    : State(state)
  {
    state->Push();
    state->PushFramebufferBindings();
    glGetIntegerv(GL_FRONT_FACE, &this->FrontFace);
    glEnable(GL_DEPTH_CLAMP);
  }
  ~SavedState()
  {
    glDisable(GL_DEPTH_CLAMP);
    glFrontFace(static_cast<GLenum>(this->FrontFace));
    this->State->PopFramebufferBindings();
    this->State->Pop();
  }
  SavedState(const SavedState&) = delete;
  SavedState& operator=(const SavedState&) = delete;

private:
  vtkOpenGLState* State;
  GLint FrontFace = GL_CCW;
};

void DrawSide(const std::vector<vtkProp*>& props, const vtkDepthBuffers::Pair& pair, Side side,
  vtkOpenGLRenderWindow* window)
{
  vtkNew<DepthRenderer> renderer;
  vtkNew<vtkOpenGLCamera> camera;
  Aim(camera, pair.View, side);
  renderer->ViewportSize = glm::ivec2(pair.View.GetViewport());
  renderer->AutomaticLightCreationOff();
  renderer->SetRenderWindow(window);
  renderer->SetActiveCamera(camera);
  vtkOpenGLState* state = window->GetState();
  state->vtkglBindFramebuffer(GL_FRAMEBUFFER, pair.GetFramebuffer(side).GetName());
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_LEQUAL);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglViewport(0, 0, renderer->ViewportSize.x, renderer->ViewportSize.y);
  glFrontFace(IsMirrored(pair.View, side) ? GL_CW : GL_CCW);
  renderer->UpdateLights();
  for (vtkProp* prop : props)
  {
    prop->SetAllocatedRenderTime(SecondsOfStillImage, renderer);
    prop->RenderOpaqueGeometry(renderer);
  }
  renderer->SetRenderWindow(nullptr);
}

/// All sides that are not drawn yet; false when stopped.
bool DrawAll(const std::vector<vtkProp*>& props, const vtkDepthBuffers& buffers,
  vtkOpenGLRenderWindow* window, const std::function<bool()>& goOn)
{
  const SavedState saved(window->GetState());
  for (const auto& pair : buffers.GetDrawnPairs())
  {
    for (const Side side : { Side::Near, Side::Far })
    {
      if (!pair->IsDrawn(side))
      {
        DrawSide(props, *pair, side, window);
        if (!goOn())
        {
          return false;
        }
      }
    }
  }
  return true;
}

/// A volume is seen as the level sets that its property names.
vtkSmartPointer<vtkActor> MakeLevelSets(vtkVolume* volume)
{
  auto* image = vtkImageData::SafeDownCast(volume->GetMapper()->GetDataSetInput());
  vtkContourValues* values = volume->GetProperty()->GetIsoSurfaceValues();
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  contour->SetNumberOfContours(values->GetNumberOfContours());
  for (int i = 0; i < values->GetNumberOfContours(); ++i)
  {
    contour->SetValue(i, values->GetValue(i));
  }
  contour->Update();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(contour->GetOutput());
  mapper->SetClippingPlanes(volume->GetMapper()->GetClippingPlanes());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->SetUserMatrix(volume->GetMatrix());
  return actor;
}

[[noreturn]] void Refuse(vtkProp* prop, const std::string& why)
{
  throw std::runtime_error(std::string("A prop, of class ") + prop->GetClassName() + ", " + why);
}
}

void vtkDepthPropPainter::Check(vtkProp* prop)
{
  if (!prop->GetVisibility())
  {
    Refuse(prop, "is invisible. Set its visibility, or remove it.");
  }
  const double* bounds = prop->GetBounds();
  if (!bounds || !vtkBoundingBox(bounds).IsValid())
  {
    Refuse(prop,
      "has no bounds, so there is nothing to voxelize. Give it a mapper with an input, "
      "or remove it.");
  }
  if (prop->HasTranslucentPolygonalGeometry())
  {
    Refuse(prop,
      "is translucent; only opaque surfaces have a depth. Set its opacity to 1 and take "
      "translucent colors and textures off, or remove it.");
  }
  auto* volume = vtkVolume::SafeDownCast(prop);
  if (!volume)
  {
    return;
  }
  auto* mapper = vtkVolumeMapper::SafeDownCast(volume->GetMapper());
  if (!mapper || mapper->GetBlendMode() != vtkVolumeMapper::ISOSURFACE_BLEND)
  {
    Refuse(prop,
      "is a volume that is not drawn as surfaces. Set the blend mode of its mapper to "
      "IsoSurface, and the iso-surface values of its property.");
  }
  mapper->Update();
  if (!vtkImageData::SafeDownCast(mapper->GetDataSetInput()))
  {
    Refuse(prop, "is a volume that is no vtkImageData. Resample it to an image first.");
  }
}

vtkMTimeType vtkDepthPropPainter::GetTime(vtkProp* prop)
{
  vtkMTimeType time = std::max(prop->GetMTime(), prop->GetRedrawMTime());
  vtkShaderProperty* shaders = prop->GetShaderProperty();
  time = std::max({ time, shaders->GetMTime(), shaders->GetShaderMTime() });
  for (vtkUniforms* uniforms : { shaders->GetVertexCustomUniforms(),
         shaders->GetGeometryCustomUniforms(), shaders->GetFragmentCustomUniforms() })
  {
    time = std::max({ time, uniforms->GetMTime(), uniforms->GetUniformListMTime() });
  }
  if (auto* volume = vtkVolume::SafeDownCast(prop))
  {
    time = std::max(time, volume->GetProperty()->GetIsoSurfaceValues()->GetMTime());
  }
  vtkNew<vtkPropCollection> parts;
  prop->GetActors(parts);
  prop->GetVolumes(parts);
  vtkCollectionSimpleIterator iterator;
  parts->InitTraversal(iterator);
  while (vtkProp* part = parts->GetNextProp(iterator))
  {
    time = part == prop ? time : std::max(time, GetTime(part));
  }
  return time;
}

bool vtkDepthPropPainter::Draw(const std::vector<vtkProp*>& props, const vtkDepthBuffers& buffers,
  vtkVoxelContext* context, const std::function<bool()>& goOn)
{
  const auto isDrawn = [](const auto& pair)
  { return pair->IsDrawn(Side::Near) && pair->IsDrawn(Side::Far); };
  const auto& pairs = buffers.GetDrawnPairs();
  if (std::all_of(pairs.begin(), pairs.end(), isDrawn))
  {
    return true;
  }
  vtkOpenGLRenderWindow* window = context->GetOpenGLRenderWindow();
  std::vector<vtkSmartPointer<vtkActor>> levelSets;
  std::vector<vtkProp*> drawn;
  for (vtkProp* prop : props)
  {
    if (auto* volume = vtkVolume::SafeDownCast(prop))
    {
      levelSets.push_back(MakeLevelSets(volume));
      drawn.push_back(levelSets.back());
      continue;
    }
    drawn.push_back(prop);
    for (vtkOpenGLRenderWindow* other : GetOtherWindows(prop, window))
    {
      const vtkVoxelContextSwitch toOther(other);
      prop->ReleaseGraphicsResources(other);
    }
  }
  const CurrentWindow current(context);
  const bool finished = DrawAll(drawn, buffers, window, goOn);
  for (const auto& actor : levelSets)
  {
    actor->ReleaseGraphicsResources(window);
  }
  if (!context->GetRenderWindow())
  {
    for (vtkProp* prop : props)
    {
      prop->ReleaseGraphicsResources(window);
    }
  }
  return finished;
}
