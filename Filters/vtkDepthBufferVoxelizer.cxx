// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDepthBufferVoxelizer.h"

#include "vtkBoundingBox.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDensityArrays.h"
#include "vtkDepthBuffers.h"
#include "vtkDepthPropPainter.h"
#include "vtkDepthView.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPointData.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapSolidVoxelizer.h"
#include "vtkSmartPointer.h"
#include "vtkVoxelContext.h"
#include "vtkVoxelContextScope.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelLargeArray.h"
#include "vtkVoxelMesh.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

vtkStandardNewMacro(vtkDepthBufferVoxelizer);

namespace
{
constexpr double ShareOfDraws = 0.5;

/// A pair of buffers that the user gave.
struct GivenPair
{
  int Axis;
  vtkSmartPointer<vtkImageData> Near;
  vtkSmartPointer<vtkImageData> Far;
};

using TimesOfProps = std::vector<std::pair<const vtkProp*, vtkMTimeType>>;

TimesOfProps GetTimes(const std::vector<vtkProp*>& props)
{
  TimesOfProps times;
  std::transform(props.begin(), props.end(), std::back_inserter(times),
    [](vtkProp* prop) { return std::make_pair(prop, vtkDepthPropPainter::GetTime(prop)); });
  return times;
}

/// What buffers show; equal contents look the same.
struct Contents
{
  vtkVoxelGrid Grid;
  TimesOfProps Props;
  std::vector<vtkVoxelMesh::Identity> Mesh;

  bool operator==(const Contents& other) const
  {
    return this->Grid == other.Grid && this->Props == other.Props && this->Mesh == other.Mesh;
  }
};

/// Depths in voxels, on one side, as OpenGL stores them. Throws std::runtime_error.
std::vector<float> ToStoredDepths(vtkImageData* image, const vtkDepthView& view, bool isNear)
{
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  const vtkIdType pixels = vtkIdType(view.Size.x) * view.Size.y;
  const int* n = image->GetDimensions();
  if (!scalars || scalars->GetNumberOfComponents() != 1 || n[0] != view.Size.x ||
    n[1] != view.Size.y || n[2] != 1 || scalars->GetNumberOfTuples() != pixels)
  {
    throw std::runtime_error("A given depth buffer has " + std::to_string(n[0]) + " x " +
      std::to_string(n[1]) + " x " + std::to_string(n[2]) + " pixels and " +
      (scalars ? std::to_string(scalars->GetNumberOfComponents()) : "no") +
      " components; along its axis the grid has " + std::to_string(view.Size.x) + " x " +
      std::to_string(view.Size.y) +
      " columns, and there must be one component. Give it what "
      "GetDepthBuffer gave on this grid.");
  }
  const double length = view.GetViewport().z;
  std::vector<float> depths(pixels);
  for (vtkIdType i = 0; i < pixels; ++i)
  {
    const double part = (scalars->GetComponent(i, 0) + 0.5) / length;
    depths[i] = std::isfinite(part)
      ? static_cast<float>(std::clamp(isNear ? part : 1.0 - part, 0.0, 1.0))
      : 1.0F;
  }
  return depths;
}
}

struct vtkDepthBufferVoxelizer::Scene
{
  std::vector<vtkSmartPointer<vtkProp>> Props;
  vtkWeakPointer<vtkRenderer> Renderer;
  std::vector<glm::dvec3> Views;
  std::vector<GivenPair> Given;
  vtkDepthBuffers Buffers;
  Contents Shown;                                     // by the buffers
  std::vector<vtkDepthBuffers::Direction> Directions; // of this run
  std::vector<vtkDepthBuffers::Given> GivenDepths;    // of this run
  int DrawsExpected = 0;                              // of this run
  int DrawsDone = 0;
  bool IsAskedForTime = false; // a scene may show what this filter made of it

  glm::ivec3 GetFirst() const { return this->Shown.Grid.GetFirst(); }
};

vtkDepthBufferVoxelizer::vtkDepthBufferVoxelizer()
  : Drawn(std::make_unique<Scene>())
{
}

vtkDepthBufferVoxelizer::~vtkDepthBufferVoxelizer() = default;

void vtkDepthBufferVoxelizer::AddProp(vtkProp* prop)
{
  if (!prop)
  {
    vtkErrorMacro("A null prop can't be added.");
    return;
  }
  this->Drawn->Props.emplace_back(prop);
  this->Modified();
}

void vtkDepthBufferVoxelizer::SetProp(vtkProp* prop)
{
  this->RemoveAllProps();
  if (prop)
  {
    this->AddProp(prop);
  }
}

void vtkDepthBufferVoxelizer::RemoveAllProps()
{
  if (!this->Drawn->Props.empty())
  {
    this->Drawn->Props.clear();
    this->Modified();
  }
}

int vtkDepthBufferVoxelizer::GetNumberOfProps()
{
  return static_cast<int>(this->Drawn->Props.size());
}

vtkProp* vtkDepthBufferVoxelizer::GetProp(int index)
{
  return index >= 0 && index < this->GetNumberOfProps() ? this->Drawn->Props[index].Get() : nullptr;
}

void vtkDepthBufferVoxelizer::SetRenderer(vtkRenderer* renderer)
{
  if (this->Drawn->Renderer != renderer)
  {
    this->Drawn->Renderer = renderer;
    this->Modified();
  }
}

vtkRenderer* vtkDepthBufferVoxelizer::GetRenderer()
{
  return this->Drawn->Renderer;
}

void vtkDepthBufferVoxelizer::AddView(double x, double y, double z)
{
  this->Drawn->Views.emplace_back(x, y, z);
  this->Modified();
}

void vtkDepthBufferVoxelizer::RemoveAllViews()
{
  if (!this->Drawn->Views.empty())
  {
    this->Drawn->Views.clear();
    this->Modified();
  }
}

int vtkDepthBufferVoxelizer::GetNumberOfViews()
{
  return static_cast<int>(this->Drawn->Views.size());
}

void vtkDepthBufferVoxelizer::AddDepthBuffers(
  int axis, vtkImageData* nearSide, vtkImageData* farSide)
{
  if (axis < 0 || axis > 2 || !nearSide || !farSide)
  {
    vtkErrorMacro(
      "Given depth buffers need two images and an axis from 0 to 2, not " << axis << ".");
    return;
  }
  this->Drawn->Given.push_back({ axis, nearSide, farSide });
  this->Modified();
}

void vtkDepthBufferVoxelizer::RemoveAllDepthBuffers()
{
  if (!this->Drawn->Given.empty())
  {
    this->Drawn->Given.clear();
    this->Modified();
  }
}

int vtkDepthBufferVoxelizer::GetNumberOfGivenDepthBufferPairs()
{
  return static_cast<int>(this->Drawn->Given.size());
}

int vtkDepthBufferVoxelizer::GetNumberOfBufferDraws()
{
  return this->Drawn->Buffers.GetNumberOfDraws();
}

int vtkDepthBufferVoxelizer::GetNumberOfDepthBufferPairs()
{
  return this->GetSlicemap() ? static_cast<int>(this->Drawn->Buffers.GetPairs().size()) : 0;
}

bool vtkDepthBufferVoxelizer::GetDepthBuffer(int pair, int side, vtkImageData* image)
{
  const bool exists = pair >= 0 && pair < this->GetNumberOfDepthBufferPairs() &&
    (side == BUFFER_NEAR || side == BUFFER_FAR) && image;
  if (!exists)
  {
    vtkErrorMacro("There is no depth buffer "
      << side << " of pair " << pair << ": the last run made "
      << this->GetNumberOfDepthBufferPairs() << " pairs of two.");
    return false;
  }
  const vtkVoxelContext::Scope scope(this->GetContext());
  const auto& buffers = *this->Drawn->Buffers.GetPairs()[pair];
  if (!scope || !buffers.NearDepth)
  {
    vtkErrorMacro("The context of the depth buffers is gone. Update the filter first.");
    return false;
  }
  const bool isNear = side == BUFFER_NEAR;
  const auto depths = this->Drawn->Buffers.ReadDepth(
    buffers, isNear ? vtkDepthBuffers::Side::Near : vtkDepthBuffers::Side::Far);
  const auto length = static_cast<float>(buffers.View.GetViewport().z);
  image->Initialize();
  image->SetDimensions(buffers.View.Size.x, buffers.View.Size.y, 1);
  image->AllocateScalars(VTK_FLOAT, 1);
  image->GetPointData()->GetScalars()->SetName("Depth");
  std::transform(depths.begin(), depths.end(), static_cast<float*>(image->GetScalarPointer()),
    [&](float depth) { return (isNear ? depth : 1.0f - depth) * length - 0.5f; });
  return true;
}

double vtkDepthBufferVoxelizer::GetHiddenVolumeEstimate()
{
  vtkSlicemap* result = this->GetSlicemap();
  vtkDataObject* input = this->GetInputDataObject(0, 0);
  const bool comparable = result && input && this->OutputMode != OUTPUT_MODE_SURFACE &&
    this->Drawn->Props.empty() && !this->Drawn->Renderer && this->Drawn->Given.empty();
  if (!comparable)
  {
    return -1.0;
  }
  vtkNew<vtkImageData> grid;
  result->GetGrid().ApplyTo(grid);
  vtkNew<vtkSlicemapSolidVoxelizer> parity;
  parity->SetInputDataObject(input);
  parity->SetReferenceImage(grid);
  parity->SetRenderWindow(this->GetRenderWindow());
  parity->HostOutputOff();
  parity->Update();
  vtkSlicemap* solid = vtkSlicemap::GetFromImage(parity->GetOutput());
  vtkNew<vtkSlicemap> hidden;
  hidden->SetContext(this->GetContext());
  {
    const vtkVoxelContext::Scope scope(this->GetContext());
    if (!solid || !scope || !hidden->Allocate(result->GetGrid()))
    {
      return -1.0;
    }
    result->GetBuffer().CopyTo(hidden->GetBuffer(), 0, 0, result->GetBuffer().GetSize());
  }
  return hidden->Difference(solid)
    ? hidden->GetNumberOfFilledVoxels() * result->GetGrid().GetVoxelVolume()
    : -1.0;
}

vtkMTimeType vtkDepthBufferVoxelizer::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  if (this->Drawn->IsAskedForTime)
  {
    return time;
  }
  this->Drawn->IsAskedForTime = true;
  for (const auto& prop : this->Drawn->Props)
  {
    time = std::max(time, vtkDepthPropPainter::GetTime(prop));
  }
  for (const GivenPair& given : this->Drawn->Given)
  {
    time = std::max({ time, given.Near->GetMTime(), given.Far->GetMTime() });
  }
  if (vtkRenderer* renderer = this->Drawn->Renderer)
  {
    vtkPropCollection* shown = renderer->GetViewProps();
    time = std::max(time, shown->GetMTime());
    vtkCollectionSimpleIterator iterator;
    shown->InitTraversal(iterator);
    while (vtkProp* prop = shown->GetNextProp(iterator))
    {
      time = std::max(time, vtkDepthPropPainter::GetTime(prop));
    }
  }
  this->Drawn->IsAskedForTime = false;
  return time;
}

int vtkDepthBufferVoxelizer::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return this->Superclass::FillInputPortInformation(port, info);
}

std::vector<vtkProp*> vtkDepthBufferVoxelizer::GetCheckedProps()
{
  std::vector<vtkProp*> props(this->Drawn->Props.begin(), this->Drawn->Props.end());
  if (vtkRenderer* renderer = this->Drawn->Renderer)
  {
    vtkRenderWindow* window = renderer->GetRenderWindow();
    if (window && window != this->GetRenderWindow())
    {
      throw std::runtime_error("The renderer belongs to another window than this filter works in. "
                               "Set RenderWindow to the window of the renderer.");
    }
    vtkPropCollection* shown = renderer->GetViewProps();
    vtkCollectionSimpleIterator iterator;
    shown->InitTraversal(iterator);
    while (vtkProp* prop = shown->GetNextProp(iterator))
    {
      if (prop->GetVisibility())
      {
        props.push_back(prop);
      }
    }
  }
  std::for_each(props.begin(), props.end(), vtkDepthPropPainter::Check);
  return props;
}

bool vtkDepthBufferVoxelizer::GetInputBounds(vtkDataObject* input, double bounds[6])
{
  vtkBoundingBox box;
  if (input && this->Superclass::GetInputBounds(input, bounds))
  {
    box.AddBounds(bounds);
  }
  for (vtkProp* prop : this->GetCheckedProps())
  {
    box.AddBounds(prop->GetBounds());
  }
  box.GetBounds(bounds);
  return box.IsValid() != 0;
}

bool vtkDepthBufferVoxelizer::HasGivenOnly()
{
  return !this->Drawn->Given.empty() && this->Drawn->Props.empty() && !this->Drawn->Renderer &&
    this->GetNumberOfInputConnections(0) == 0;
}

bool vtkDepthBufferVoxelizer::ChoosesAxes(bool hasProps) const
{
  return this->AutomaticAxes && !hasProps && this->OutputMode != OUTPUT_MODE_DENSITY;
}

void vtkDepthBufferVoxelizer::MakeBuffers(
  const vtkVoxelGrid& whole, const std::vector<vtkProp*>& props)
{
  const vtkVoxelContext::Scope scope(this->GetContext());
  if (!scope)
  {
    throw std::runtime_error(this->GetContext()->GetErrorMessage());
  }
  Contents contents{ whole, GetTimes(props),
    vtkVoxelMesh::Identify(this->GetInputDataObject(0, 0)) };
  Scene& scene = *this->Drawn;
  if (!scene.Buffers.IsIn(this->GetContext()->GetRecord()) || !(contents == scene.Shown))
  {
    scene.Buffers.Start(this->GetContext()->GetRecord());
    scene.Shown = std::move(contents);
  }
  scene.GivenDepths.clear();
  for (const GivenPair& given : scene.Given)
  {
    const auto view = vtkDepthView::AlongAxis(whole, given.Axis);
    scene.GivenDepths.push_back({ given.Axis, view, ToStoredDepths(given.Near, view, true),
      ToStoredDepths(given.Far, view, false) });
  }
  scene.Directions.clear();
  if (!this->HasGivenOnly())
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (this->Axes[axis])
      {
        scene.Directions.emplace_back(axis, vtkDepthView::AlongAxis(whole, axis));
      }
    }
    for (const glm::dvec3& direction : scene.Views)
    {
      scene.Directions.emplace_back(
        vtkDepthBuffers::Oblique, vtkDepthView::AlongDirection(whole, direction));
    }
  }
  scene.Buffers.Use({});
  if (!this->ChoosesAxes(!props.empty()))
  {
    scene.Buffers.Use(scene.Directions);
  }
}

bool vtkDepthBufferVoxelizer::DrawMesh(const vtkVoxelMesh& mesh)
{
  Scene& scene = *this->Drawn;
  const bool isEmpty = mesh.GetNumberOfTriangles() == 0;
  if (this->ChoosesAxes(!scene.Shown.Props.empty()) && !isEmpty)
  {
    const auto sufficient = scene.Buffers.FindSufficient(scene.Directions, mesh);
    if (sufficient != scene.Directions.end())
    {
      const auto chosen = *sufficient;
      scene.Directions.erase(std::remove_if(scene.Directions.begin(), scene.Directions.end(),
                               [&](const auto& direction) {
                                 return direction.first != vtkDepthBuffers::Oblique &&
                                   direction.first != chosen.first;
                               }),
        scene.Directions.end());
    }
    scene.Buffers.Use(scene.Directions);
  }
  std::fill_n(this->UsedAxes, 3, false);
  for (const auto& direction : scene.Directions)
  {
    if (direction.first != vtkDepthBuffers::Oblique)
    {
      this->UsedAxes[direction.first] = true;
    }
  }
  if (!scene.Buffers.Draw(isEmpty ? nullptr : &mesh, [this] { return this->ReportDraw(); }))
  {
    return false;
  }
  scene.Buffers.Intersect(scene.GivenDepths);
  return true;
}

bool vtkDepthBufferVoxelizer::ReportDraw()
{
  Scene& scene = *this->Drawn;
  ++scene.DrawsDone;
  return this->ReportProgress(
    ShareOfDraws * std::min(1.0, double(scene.DrawsDone) / scene.DrawsExpected));
}

void vtkDepthBufferVoxelizer::CheckParameters()
{
  if (!this->Axes[0] && !this->Axes[1] && !this->Axes[2] && this->Drawn->Given.empty())
  {
    throw std::runtime_error("There is no axis to look along. Set one of Axes at least.");
  }
  if (this->Connectivity != 4 && this->Connectivity != 8)
  {
    throw std::runtime_error(
      "Connectivity is " + std::to_string(this->Connectivity) + "; it must be 4 or 8.");
  }
  if (this->OutputMode == OUTPUT_MODE_DENSITY && !this->GetHostOutput())
  {
    throw std::runtime_error("Densities are for the host only. Turn HostOutput on.");
  }
  for (const glm::dvec3& view : this->Drawn->Views)
  {
    const double length = glm::length(view);
    if (!(length > 0.0) || !std::isfinite(length))
    {
      throw std::runtime_error("A view has the direction (" + std::to_string(view.x) + ", " +
        std::to_string(view.y) + ", " + std::to_string(view.z) +
        "), which points nowhere. Give it a length.");
    }
  }
}

bool vtkDepthBufferVoxelizer::Prepare(const vtkVoxelGrid& whole)
{
  this->CheckParameters();
  const auto props = this->GetCheckedProps();
  if (props.empty() && this->GetNumberOfInputConnections(0) == 0 && this->Drawn->Given.empty())
  {
    throw std::runtime_error(
      "There is nothing to voxelize. Connect a mesh, add a prop, or set a renderer.");
  }
  this->MakeBuffers(whole, props);
  const auto sides = static_cast<int>(2 * this->Drawn->Directions.size());
  this->Drawn->DrawsExpected = std::max(1, props.empty() ? sides : 2 * sides);
  this->Drawn->DrawsDone = 0;
  if (!props.empty() &&
    !vtkDepthPropPainter::Draw(
      props, this->Drawn->Buffers, this->GetContext(), [this] { return this->ReportDraw(); }))
  {
    return false;
  }
  // Mappers say that they changed when they give their graphics resources back.
  this->Drawn->Shown.Props = GetTimes(props);
  return true;
}

bool vtkDepthBufferVoxelizer::Voxelize(
  vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkSlicemap* slicemap)
{
  if (!this->DrawMesh(mesh) || !this->ReportProgress(ShareOfDraws) || !slicemap->Allocate(grid))
  {
    return false;
  }
  const vtkDepthBuffers& buffers = this->Drawn->Buffers;
  const glm::ivec3 first = grid.GetFirst() - this->Drawn->GetFirst();
  if (this->OutputMode == OUTPUT_MODE_SURFACE)
  {
    buffers.FillSurface(
      slicemap, first, static_cast<vtkDepthBuffers::Neighbours>(this->Connectivity));
  }
  else
  {
    buffers.FillSolid(slicemap, first);
  }
  return this->ReportProgress(1.0);
}

std::int64_t vtkDepthBufferVoxelizer::EstimateBytes(const vtkVoxelGrid& part)
{
  // Those of the whole: two depths, ranges and shells.
  constexpr std::int64_t bytesPerPixel = 4 * 4;
  const auto grid = vtkVoxelGrid::FromInformation(this->GetOutputInformation(0));
  const glm::i64vec3 n(grid.GetDimensions());
  const glm::i64vec3 pixels(n.y * n.z, n.x * n.z, n.x * n.y);
  std::int64_t bytes = this->Superclass::EstimateBytes(part);
  for (int axis = 0; axis < 3; ++axis)
  {
    bytes += this->Axes[axis] ? pixels[axis] * bytesPerPixel : 0;
  }
  return bytes;
}

std::int64_t vtkDepthBufferVoxelizer::GetBytesOfArrays()
{
  return this->OutputMode == OUTPUT_MODE_DENSITY ? static_cast<std::int64_t>(sizeof(float)) : 0;
}

bool vtkDepthBufferVoxelizer::AddArrays(
  vtkVoxelMesh&, const vtkVoxelGrid& grid, vtkDataSetAttributes* voxels)
{
  if (this->OutputMode != OUTPUT_MODE_DENSITY)
  {
    return true;
  }
  const auto density =
    vtkVoxelNewLargeArray<vtkFloatArray>(vtkDensityArrays::DensityName, grid.GetNumberOfVoxels());
  if (!density)
  {
    throw std::runtime_error("There is no memory for the density of " +
      std::to_string(grid.GetNumberOfVoxels()) + " voxels. Use fewer voxels.");
  }
  this->Drawn->Buffers.ReadDensity(
    grid, grid.GetFirst() - this->Drawn->GetFirst(), density->GetPointer(0));
  voxels->AddArray(density);
  return true;
}

void vtkDepthBufferVoxelizer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const modes[] = { "Solid", "Surface", "Density" };
  os << indent << "NumberOfProps: " << this->GetNumberOfProps() << "\n";
  os << indent << "Renderer: " << this->GetRenderer() << "\n";
  os << indent << "Axes: " << this->Axes[0] << " " << this->Axes[1] << " " << this->Axes[2] << "\n";
  os << indent << "AutomaticAxes: " << this->AutomaticAxes << "\n";
  os << indent << "UsedAxes: " << this->UsedAxes[0] << " " << this->UsedAxes[1] << " "
     << this->UsedAxes[2] << "\n";
  os << indent << "NumberOfGivenDepthBufferPairs: " << this->GetNumberOfGivenDepthBufferPairs()
     << "\n";
  os << indent << "NumberOfViews: " << this->GetNumberOfViews() << "\n";
  os << indent << "OutputMode: " << modes[this->OutputMode] << "\n";
  os << indent << "Connectivity: " << this->Connectivity << "\n";
}
