// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Picture.h"

#include "OutputFile.h"
#include "VoxelShading.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkImageShrink3D.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVoxelContext.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace
{
using Light = VoxelLighting::Light;
using Color = glm::dvec3; // linear red, green, blue

const Color VoxelColor(0.045, 0.33, 0.60);
const Color SkyColor(0.52, 0.58, 0.70);
const Color SunColor(1.02, 0.92, 0.78);

constexpr int LongestSide = 1200;    // pixels of the picture
constexpr int Supersampling = 2;     // pixels drawn for one of them, along each axis
constexpr double Margin = 0.07;      // around the voxels, of the picture's size
constexpr double WidthOfFade = 0.16; // of the floor into the background, of the same
constexpr double FloorReach = 1.3;   // of the floor to all sides, of the same
constexpr int FloorCells = 500;

constexpr int MostVoxelsWithSeams = 160; // along a side; more are too small for them
constexpr double WidthOfSeams = 0.06;    // in voxels, as is the next
constexpr double LiftOfPlates = 1e-3;
constexpr double ShadeOfSeams = 0.80;

/// The world as the picture shows it.
struct View
{
  explicit View(int upAxis)
    : Up(upAxis == 0, upAxis == 1, upAxis == 2)
    , East(upAxis == 0 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0))
  {
    this->South = glm::cross(this->East, this->Up);
    this->ToCamera = glm::normalize(-0.42 * this->East + 0.55 * this->Up + this->South);
    this->ToSun = glm::normalize(-0.62 * this->East + 1.5 * this->Up + 0.42 * this->South);
    this->Right = glm::normalize(glm::cross(this->Up, this->ToCamera));
    this->ScreenUp = glm::cross(this->ToCamera, this->Right);
  }

  glm::dvec3 Up;
  glm::dvec3 East;
  glm::dvec3 South; // towards the viewer
  glm::dvec3 ToCamera;
  glm::dvec3 ToSun;
  glm::dvec3 Right;
  glm::dvec3 ScreenUp;
};

/// An interval that grows.
struct Range
{
  double Low = std::numeric_limits<double>::infinity();
  double High = -std::numeric_limits<double>::infinity();

  void Add(double value)
  {
    this->Low = std::min(this->Low, value);
    this->High = std::max(this->High, value);
  }
  void Grow(double margin)
  {
    this->Low -= margin;
    this->High += margin;
  }
  double GetDistanceInside(double value) const
  {
    return std::min(value - this->Low, this->High - value);
  }
  double GetSize() const { return this->High - this->Low; }
  double GetCenter() const { return 0.5 * (this->Low + this->High); }
};

unsigned char ToByte(double linear)
{
  const double bounded = std::clamp(linear, 0.0, 1.0);
  const double encoded =
    bounded <= 0.0031308 ? 12.92 * bounded : 1.055 * std::pow(bounded, 1.0 / 2.4) - 0.055;
  return static_cast<unsigned char>(std::lround(255.0 * encoded));
}

/// Bright parts run up to white slowly instead of being cut off.
double Soften(double value)
{
  return 1.0 - std::exp(-1.25 * value);
}

Color ShadeVoxel(const Color& own, const Light& light)
{
  Color color;
  for (const int channel : { 0, 1, 2 })
  {
    color[channel] = Soften(
      own[channel] * (1.35 * SkyColor[channel] * light.Sky + 2.0 * SunColor[channel] * light.Sun));
  }
  return color;
}

/// The floor is white in full light, and where its shades have no strength.
Color ShadeFloor(const Light& light, const Light& full, double strength)
{
  const double bright = 0.70 * light.Sky / full.Sky + 0.30 * light.Sun / full.Sun;
  const double value = 1.0 - strength * (1.0 - bright);
  return { std::pow(value, 1.12), std::pow(value, 1.05), value };
}

/// One side of a voxel.
struct Face
{
  std::array<int, 3> Voxel;
  int Axis;
  int Side; // 0 low, 1 high

  /// A point over the face: u and v from 0 to 1 along it, w outwards.
  glm::dvec3 GetPoint(double u, double v, double w) const
  {
    glm::dvec3 point(this->Voxel[0], this->Voxel[1], this->Voxel[2]);
    point[this->Axis] += this->Side == 1 ? 1.0 + w : -w;
    point[(this->Axis + 1) % 3] += u;
    point[(this->Axis + 2) % 3] += v;
    return point;
  }

  std::array<glm::dvec3, 4> GetCorners() const
  {
    return { this->GetPoint(0, 0, 0), this->GetPoint(1, 0, 0), this->GetPoint(1, 1, 0),
      this->GetPoint(0, 1, 0) };
  }
};

/// Normal of the faces of a voxel, in the world.
glm::dvec3 GetNormal(const VoxelScene& scene, int axis, int side)
{
  glm::dvec3 one(0.0);
  glm::dvec3 two(0.0);
  one[(axis + 1) % 3] = 1.0;
  two[(axis + 2) % 3] = 1.0;
  glm::dvec3 normal =
    glm::normalize(glm::cross(scene.DirectionToWorld(one), scene.DirectionToWorld(two)));
  glm::dvec3 outward(0.0);
  outward[axis] = side == 1 ? 1.0 : -1.0;
  return glm::dot(normal, scene.DirectionToWorld(outward)) < 0.0 ? -normal : normal;
}

/// The faces between a voxel that is set and one that is not, as far as they look at the camera.
std::vector<Face> FindFaces(const VoxelScene& scene, const View& view)
{
  std::vector<std::array<int, 2>> looking;
  for (const int axis : { 0, 1, 2 })
  {
    for (const int side : { 0, 1 })
    {
      if (glm::dot(GetNormal(scene, axis, side), view.ToCamera) > 0.0)
      {
        looking.push_back({ axis, side });
      }
    }
  }
  const auto& n = scene.GetDimensions();
  std::vector<Face> faces;
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        if (!scene.IsSet(i, j, k))
        {
          continue;
        }
        for (const auto& [axis, side] : looking)
        {
          std::array<int, 3> neighbor = { i, j, k };
          neighbor[axis] += side == 1 ? 1 : -1;
          if (!scene.IsSet(neighbor[0], neighbor[1], neighbor[2]))
          {
            faces.push_back({ { i, j, k }, axis, side });
          }
        }
      }
    }
  }
  return faces;
}

/// Quads with a color at each corner.
class Quads
{
public:
  explicit Quads(std::size_t count)
  {
    this->Points->SetDataTypeToDouble();
    this->Points->SetNumberOfPoints(4 * static_cast<vtkIdType>(count));
    this->Colors->SetNumberOfComponents(3);
    this->Colors->SetNumberOfTuples(4 * static_cast<vtkIdType>(count));
  }

  void SetCorner(std::size_t quad, int corner, const glm::dvec3& point, const Color& color)
  {
    const auto id = 4 * static_cast<vtkIdType>(quad) + corner;
    this->Points->SetPoint(id, &point[0]);
    const std::array<unsigned char, 3> bytes = { ToByte(color[0]), ToByte(color[1]),
      ToByte(color[2]) };
    this->Colors->SetTypedTuple(id, bytes.data());
  }

  vtkSmartPointer<vtkActor> MakeActor()
  {
    vtkNew<vtkCellArray> cells;
    for (vtkIdType first = 0; first < this->Points->GetNumberOfPoints(); first += 4)
    {
      cells->InsertNextCell({ first, first + 1, first + 2, first + 3 });
    }
    vtkNew<vtkPolyData> surface;
    surface->SetPoints(this->Points);
    surface->SetPolys(cells);
    surface->GetPointData()->SetScalars(this->Colors);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(surface);
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff(); // it is in the colors
    return actor;
  }

private:
  vtkNew<vtkPoints> Points;
  vtkNew<vtkUnsignedCharArray> Colors;
};

/// What the picture shows: the faces and a margin around them, in coordinates of the screen.
struct Frame
{
  Frame(const VoxelScene& scene, const View& view, const std::vector<Face>& faces)
  {
    for (const Face& face : faces)
    {
      for (const glm::dvec3& corner : face.GetCorners())
      {
        const glm::dvec3 point = scene.ToWorld(corner);
        this->Right.Add(glm::dot(point, view.Right));
        this->Up.Add(glm::dot(point, view.ScreenUp));
        this->Depth.Add(glm::dot(point, view.ToCamera));
        this->East.Add(glm::dot(point, view.East));
        this->South.Add(glm::dot(point, view.South));
        this->Height.Add(glm::dot(point, view.Up));
      }
    }
    const double margin = Margin * std::max(this->Right.GetSize(), this->Up.GetSize());
    this->Right.Grow(margin);
    this->Up.Grow(margin);
  }

  double GetSize() const { return std::max(this->Right.GetSize(), this->Up.GetSize()); }

  /// How far inside a point lies: 0 at the border and beyond, 1 well inside.
  double GetDepthInside(const View& view, const glm::dvec3& point) const
  {
    const double inside = std::min(this->Right.GetDistanceInside(glm::dot(point, view.Right)),
      this->Up.GetDistanceInside(glm::dot(point, view.ScreenUp)));
    return glm::smoothstep(0.0, WidthOfFade * this->GetSize(), inside);
  }

  Range Right;
  Range Up;
  Range Depth;
  Range East;
  Range South;
  Range Height;
};

vtkSmartPointer<vtkActor> MakeVoxels(
  const VoxelScene& scene, const VoxelLighting& lighting, const std::vector<Face>& faces)
{
  // A face is a plate on a slightly larger and darker one, which leaves a seam.
  const auto& n = scene.GetDimensions();
  const bool seams = *std::max_element(n.begin(), n.end()) <= MostVoxelsWithSeams;
  const std::size_t plates = seams ? 2 : 1;
  Quads quads(plates * faces.size());
  vtkSMPTools::For(0, static_cast<vtkIdType>(faces.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const Face& face = faces[i];
        const glm::dvec3 normal = GetNormal(scene, face.Axis, face.Side);
        const auto& [x, y, z] = face.Voxel;
        const Color color = ShadeVoxel(scene.GetColor(x, y, z).value_or(VoxelColor),
          lighting.GetLight(face.GetPoint(0.5, 0.5, LiftOfPlates), normal));
        for (std::size_t plate = 0; plate < plates; ++plate)
        {
          const double low = plate == 0 ? 0.0 : WidthOfSeams;
          const double high = 1.0 - low;
          const double lift = plate == 0 ? 0.0 : LiftOfPlates;
          const double shade = seams && plate == 0 ? ShadeOfSeams : 1.0;
          const std::array<glm::dvec3, 4> corners = { face.GetPoint(low, low, lift),
            face.GetPoint(high, low, lift), face.GetPoint(high, high, lift),
            face.GetPoint(low, high, lift) };
          for (const int corner : { 0, 1, 2, 3 })
          {
            quads.SetCorner(
              plates * i + plate, corner, scene.ToWorld(corners[corner]), shade * color);
          }
        }
      }
    });
  return quads.MakeActor();
}

vtkSmartPointer<vtkActor> MakeFloor(
  const VoxelScene& scene, const VoxelLighting& lighting, const View& view, const Frame& frame)
{
  // Wide enough for the frame, which cuts out a part of it.
  const double reach = FloorReach * frame.GetSize();
  constexpr int side = FloorCells + 1;
  std::vector<glm::dvec3> points(static_cast<std::size_t>(side) * side);
  std::vector<Color> colors(points.size());
  const Light full =
    lighting.GetLight(scene.FromWorld((frame.Height.High + reach) * view.Up), view.Up);
  vtkSMPTools::For(0, side,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (auto row = static_cast<int>(begin); row < static_cast<int>(end); ++row)
      {
        for (int column = 0; column < side; ++column)
        {
          const double u = 2.0 * column / FloorCells - 1.0;
          const double v = 2.0 * row / FloorCells - 1.0;
          const glm::dvec3 point = (frame.East.GetCenter() + reach * u) * view.East +
            (frame.South.GetCenter() + reach * v) * view.South + frame.Height.Low * view.Up;
          const double strength = frame.GetDepthInside(view, point);
          const std::size_t id = static_cast<std::size_t>(row) * side + column;
          points[id] = point;
          colors[id] = strength > 0.0
            ? ShadeFloor(lighting.GetLight(scene.FromWorld(point), view.Up), full, strength)
            : Color(1.0);
        }
      }
    });

  Quads quads(static_cast<std::size_t>(FloorCells) * FloorCells);
  for (int row = 0; row < FloorCells; ++row)
  {
    for (int column = 0; column < FloorCells; ++column)
    {
      const std::size_t quad = static_cast<std::size_t>(row) * FloorCells + column;
      const std::size_t id = static_cast<std::size_t>(row) * side + column;
      const std::array<std::size_t, 4> corners = { id, id + 1, id + 1 + side, id + side };
      for (const int corner : { 0, 1, 2, 3 })
      {
        quads.SetCorner(quad, corner, points[corners[corner]], colors[corners[corner]]);
      }
    }
  }
  return quads.MakeActor();
}

/// Points the camera at the frame and gives the size of the picture, in pixels.
std::array<int, 2> Aim(vtkRenderer* renderer, const View& view, const Frame& frame)
{
  const glm::dvec3 focus = frame.Right.GetCenter() * view.Right +
    frame.Up.GetCenter() * view.ScreenUp + frame.Depth.GetCenter() * view.ToCamera;
  const glm::dvec3 position = focus + (frame.Depth.GetSize() + frame.GetSize()) * view.ToCamera;
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(&focus[0]);
  camera->SetPosition(&position[0]);
  camera->SetViewUp(&view.Up[0]);
  camera->SetParallelScale(0.5 * frame.Up.GetSize());
  renderer->ResetCameraClippingRange();
  const double scale = LongestSide / frame.GetSize();
  return { static_cast<int>(std::ceil(scale * frame.Right.GetSize())),
    static_cast<int>(std::ceil(scale * frame.Up.GetSize())) };
}

vtkSmartPointer<vtkImageData> Render(vtkRenderWindow* window, const std::array<int, 2>& size)
{
  window->SetMultiSamples(0);
  window->SetSize(Supersampling * size[0], Supersampling * size[1]);
  window->Render();
  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(window);
  grabber->ReadFrontBufferOff();
  grabber->ShouldRerenderOff();
  grabber->Update();
  // As data, for the pipeline of VTK 9.1 does not know the spacing of what was grabbed.
  vtkNew<vtkImageShrink3D> shrink;
  shrink->SetInputData(grabber->GetOutput());
  shrink->SetShrinkFactors(Supersampling, Supersampling, 1);
  shrink->AveragingOn();
  shrink->Update();
  return shrink->GetOutput();
}
}

vtkSmartPointer<vtkImageData> Picture::Draw(
  const VoxelSet& voxels, const std::string& attribute, int upAxis)
{
  vtkSmartPointer<vtkRenderWindow> window;
  window.TakeReference(vtkVoxelContext::NewHeadlessRenderWindow());
  if (!window)
  {
    return nullptr;
  }
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  window->AddRenderer(renderer);
  const VoxelScene scene(voxels, attribute);
  const View view(upAxis);
  const auto faces = FindFaces(scene, view);
  std::array<int, 2> size = { LongestSide, LongestSide };
  if (!faces.empty())
  {
    const VoxelLighting lighting(scene, view.Up, view.ToSun);
    const Frame frame(scene, view, faces);
    renderer->AddActor(MakeVoxels(scene, lighting, faces));
    renderer->AddActor(MakeFloor(scene, lighting, view, frame));
    size = Aim(renderer, view, frame);
  }
  return Render(window, size);
}

void Picture::Write(vtkImageData* picture, const std::string& staged, const std::string& target)
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(picture);
  writer->WriteToMemoryOn();
  writer->Write();
  if (writer->GetErrorCode() != vtkErrorCode::NoError)
  {
    OutputFile::Refuse(target, vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
  }
  vtkUnsignedCharArray* bytes = writer->GetResult();
  OutputFile file(staged, target);
  file.Append(bytes->GetPointer(0), bytes->GetNumberOfValues());
  file.Close();
}
