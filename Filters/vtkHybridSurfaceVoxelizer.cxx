// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridSurfaceVoxelizer.h"

#include "vtkCellArray.h"
#include "vtkCommand.h"
#include "vtkDataSetAttributes.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkFieldData.h"
#include "vtkHyperTreeGrid.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapNumbering.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkSurfaceAttributes.h"
#include "vtkSurfacePass.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkVoxelCompatibility.h"
#include "vtkVoxelContext.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelMesh.h"
#include "vtkVoxelTree.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace
{
enum Port
{
  IMAGE_PORT = 0,
  LIST_PORT = 1,
  TREE_PORT = 2
};

/// Slabs are so small that their bits, and what is kept for their set voxels, stay below this.
constexpr std::int64_t SlabBytes = std::int64_t(1) << 26;

constexpr std::int64_t IndexBytes = 4;

/// Of the progress of an image with attributes.
constexpr double ShareOfOccupancy = 0.25;

/// Place, index and vertex of a voxel in a list; code and order of one while a tree is built, and
/// some three nodes.
constexpr std::int64_t ListBytes = 12 + 12 + 8;
constexpr std::int64_t TreeBytes = 8 + 4 + 3 * 4;

/// Floats tell the centres of voxels apart up to this many voxels from the world's origin.
constexpr double LargestFloatIndex = 1048576.0;

using Arrays = std::vector<vtkSmartPointer<vtkDataArray>>;

/// A vertex for each of n points, with small ids where they do.
template <typename IdArray>
vtkSmartPointer<vtkCellArray> MakeVertices(vtkIdType n)
{
  using Id = typename IdArray::ValueType;
  vtkNew<IdArray> offsets;
  offsets->SetNumberOfValues(n + 1);
  std::iota(offsets->GetPointer(0), offsets->GetPointer(0) + n + 1, Id(0));
  vtkNew<IdArray> points;
  points->SetNumberOfValues(n);
  std::iota(points->GetPointer(0), points->GetPointer(0) + n, Id(0));
  auto vertices = vtkSmartPointer<vtkCellArray>::New();
  vertices->SetData(offsets, points);
  return vertices;
}
}

struct vtkHybridSurfaceVoxelizer::Settings : vtkSurfacePass::Settings
{
};

struct vtkHybridSurfaceVoxelizer::Internals
{
  vtkSurfacePass::Classification Triangles;
};

/// A few slices of the grid, and what is known of their set voxels.
struct vtkHybridSurfaceVoxelizer::Slab
{
  vtkVoxelGrid Grid;
  const std::uint32_t* Indices; ///< x + nx * (y + ny * z) in the slab, ascending
  vtkIdType Count;
  Arrays Values; ///< one array an attribute, a tuple a set voxel

  glm::ivec3 GetVoxel(vtkIdType i) const
  {
    const glm::uvec3 n(this->Grid.GetDimensions());
    const std::uint32_t row = this->Indices[i] / n.x;
    return { this->Indices[i] % n.x, row % n.y, row / n.y };
  }
};

/// The attributes of all set voxels, slab after slab.
struct vtkHybridSurfaceVoxelizer::SparseArrays
{
  explicit SparseArrays(const vtkSurfaceAttributes& attributes)
  {
    for (int i = 0; i < attributes.GetNumber(); ++i)
    {
      this->All.push_back(attributes.NewArray(i, 0));
    }
  }

  void Append(const Slab& slab)
  {
    for (std::size_t i = 0; i < this->All.size(); ++i)
    {
      this->All[i]->InsertTuples(this->All[i]->GetNumberOfTuples(), slab.Count, 0, slab.Values[i]);
    }
  }

  Arrays All;
};

/// Works through the slabs of a grid.
class vtkHybridSurfaceVoxelizer::Run
{
public:
  using Consume = std::function<void(const Slab&)>;

  Run(vtkHybridSurfaceVoxelizer* filter, const vtkVoxelMesh& mesh, vtkSurfaceAttributes& attributes,
    const vtkSurfacePass::Settings& settings)
    : Filter(filter)
    , Mesh(mesh)
    , Attributes(attributes)
    , Settings(settings)
  {
  }

  /// False when told to stop. Progress goes from `from` to 1. Throws std::runtime_error.
  bool ForEachSlab(const vtkVoxelGrid& grid, const Consume& consume, double from = 0.0)
  {
    const int slices = grid.GetDimensions().z;
    const std::int64_t sliceBytes = vtkSlicemap::GetNumberOfWords(grid) / slices *
      static_cast<std::int64_t>(sizeof(std::uint32_t));
    const int atOnce =
      static_cast<int>(std::clamp<std::int64_t>(SlabBytes / sliceBytes, 1, slices));
    for (int first = 0; first < slices; first += atOnce)
    {
      const int end = std::min(first + atOnce, slices);
      if (!this->Filter->ReportProgress(from + (1.0 - from) * first / slices) ||
        !this->DoSlices(grid, first, end, consume))
      {
        return false;
      }
    }
    return this->Filter->ReportProgress(1.0);
  }

  /// All voxels so far must find room, at so many bytes each beside their attributes.
  void CheckBytes(std::int64_t voxels, std::int64_t bytesPerVoxel, const std::string& what) const
  {
    this->Filter->CheckBytes(voxels * (bytesPerVoxel + this->Attributes.GetBytesPerVoxel()),
      what + " of " + std::to_string(voxels) + " voxels and more",
      "Use fewer voxels or attributes.");
  }

private:
  bool DoSlices(const vtkVoxelGrid& grid, int first, int end, const Consume& consume)
  {
    Slab slab{ grid.WithSlices(first, end - first), nullptr, 0, {} };
    vtkNew<vtkSlicemap> slicemap;
    slicemap->SetContext(this->Filter->GetContext());
    if (!slicemap->Allocate(slab.Grid))
    {
      throw std::runtime_error("There is no room for the bits of a slab.");
    }
    slicemap->GetBuffer().Fill(0);
    const auto proceed = [&](double) { return !vtkVoxelCompatibility::CheckAbort(this->Filter); };
    auto& pass = vtkSurfacePass::Get(this->Filter->GetContext()->GetRecord());
    if (!pass.Run(this->Mesh, slicemap, this->Settings, proceed))
    {
      return false;
    }
    const vtkSlicemapNumbering numbering(slicemap);
    slab.Count = static_cast<vtkIdType>(numbering.GetCount());
    if (slab.Count == 0)
    {
      return true;
    }
    const std::int64_t bytesPerVoxel =
      std::max(IndexBytes, this->Attributes.GetWorkBytesPerVoxel());
    if (slab.Count * bytesPerVoxel > SlabBytes && end - first > 1)
    {
      const int middle = (first + end) / 2;
      return this->DoSlices(grid, first, middle, consume) &&
        this->DoSlices(grid, middle, end, consume);
    }
    for (int i = 0; i < this->Attributes.GetNumber(); ++i)
    {
      slab.Values.push_back(
        this->Attributes.Compute(i, this->Mesh, slicemap, numbering, this->Settings, proceed));
      if (!slab.Values.back())
      {
        return false;
      }
    }
    const auto indices = numbering.MakeIndices();
    const vtkVoxelGL::MappedBuffer mapped(indices, 0, indices.GetSize(), GL_MAP_READ_BIT);
    slab.Indices = static_cast<const std::uint32_t*>(mapped.Get());
    if (!slab.Indices)
    {
      throw std::runtime_error("OpenGL could not map the list of voxels.");
    }
    consume(slab);
    return true;
  }

  vtkHybridSurfaceVoxelizer* Filter;
  const vtkVoxelMesh& Mesh;
  vtkSurfaceAttributes& Attributes;
  vtkSurfacePass::Settings Settings;
};

vtkStandardNewMacro(vtkHybridSurfaceVoxelizer);
vtkCxxSetObjectMacro(vtkHybridSurfaceVoxelizer, TextureImage, vtkImageData);

vtkHybridSurfaceVoxelizer::vtkHybridSurfaceVoxelizer()
  : Kept(std::make_unique<Internals>())
{
  this->SetNumberOfOutputPorts(3);
}

vtkHybridSurfaceVoxelizer::~vtkHybridSurfaceVoxelizer()
{
  this->SetTextureImage(nullptr);
}

void vtkHybridSurfaceVoxelizer::SetSeparability(int separability)
{
  if (separability != 6 && separability != 26)
  {
    vtkErrorMacro("Separability must be 6 or 26, not " << separability << ".");
    return;
  }
  if (this->Separability != separability)
  {
    this->Separability = separability;
    this->Modified();
  }
}

void vtkHybridSurfaceVoxelizer::AddAttribute(const char* name)
{
  if (!name || !*name)
  {
    vtkErrorMacro("AddAttribute wants the name of an array.");
    return;
  }
  auto& names = this->Attributes;
  if (std::find(names.begin(), names.end(), name) == names.end())
  {
    names.emplace_back(name);
    this->Modified();
  }
}

void vtkHybridSurfaceVoxelizer::RemoveAllAttributes()
{
  if (!this->Attributes.empty())
  {
    this->Attributes.clear();
    this->Modified();
  }
}

const char* vtkHybridSurfaceVoxelizer::GetAttribute(int i)
{
  return i >= 0 && i < this->GetNumberOfAttributes() ? this->Attributes[i].c_str() : nullptr;
}

vtkPolyData* vtkHybridSurfaceVoxelizer::GetVoxelList()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(LIST_PORT));
}

vtkHyperTreeGrid* vtkHybridSurfaceVoxelizer::GetHyperTreeGrid()
{
  return vtkHyperTreeGrid::SafeDownCast(this->GetOutputDataObject(TREE_PORT));
}

vtkMTimeType vtkHybridSurfaceVoxelizer::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  if (this->TextureImage)
  {
    time = std::max(time, this->TextureImage->GetMTime());
  }
  return time;
}

int vtkHybridSurfaceVoxelizer::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* const types[] = { "vtkImageData", "vtkPolyData", "vtkHyperTreeGrid" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

vtkTypeBool vtkHybridSurfaceVoxelizer::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_NOT_GENERATED()))
  {
    // One port at a time, so that none is worked out in vain.
    const int asked = std::max(0, request->Get(vtkDemandDrivenPipeline::FROM_OUTPUT_PORT()));
    for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
    {
      if (port != asked)
      {
        outputs->GetInformationObject(port)->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
      }
    }
  }
  return this->Superclass::ProcessRequest(request, inputs, outputs);
}

int vtkHybridSurfaceVoxelizer::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const int port = request->Get(vtkDemandDrivenPipeline::FROM_OUTPUT_PORT());
  if (port <= IMAGE_PORT)
  {
    return this->Superclass::RequestData(request, inputs, outputs);
  }
  vtkInformation* info = outputs->GetInformationObject(port);
  vtkDataObject* output = info->Get(vtkDataObject::DATA_OBJECT());
  output->Initialize();
  // All of it is in the first piece.
  if (info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) > 0)
  {
    return 1;
  }
  vtkVoxelGrid grid;
  bool finished = false;
  const int result = this->RunOnMesh(
    inputs[0]->GetInformationObject(0)->Get(vtkDataObject::DATA_OBJECT()),
    [&](const vtkVoxelGrid& whole)
    {
      grid = whole;
      return true;
    },
    [&](vtkVoxelMesh& mesh)
    {
      finished = port == LIST_PORT
        ? this->FillVoxelList(mesh, grid, vtkPolyData::SafeDownCast(output))
        : this->FillHyperTreeGrid(mesh, grid, vtkHyperTreeGrid::SafeDownCast(output));
      return finished;
    });
  if (!finished || !result)
  {
    output->Initialize();
  }
  return result;
}

vtkSurfaceAttributes vtkHybridSurfaceVoxelizer::LoadAttributes(const vtkVoxelMesh& mesh)
{
  using Combination = vtkSurfaceAttributes::Combination;
  constexpr Combination combinations[] = { Combination::Average, Combination::Minimum,
    Combination::Maximum, Combination::First };
  vtkSurfaceAttributes attributes(combinations[this->AttributeCombination]);
  vtkDataObject* input = this->GetInputDataObject(0, 0);
  for (const std::string& name : this->Attributes)
  {
    const bool isTexture = this->TextureImage && name == vtkSurfaceAttributes::ImageName;
    if (isTexture || name == "Occupancy" || name == "VoxelIndex")
    {
      throw std::runtime_error("The attribute \"" + name +
        "\" has the name of an array that the output has itself. Rename the array of the input.");
    }
    attributes.AddArray(input, mesh, name);
  }
  if (this->TextureImage)
  {
    attributes.AddImage(input, mesh, this->TextureImage);
  }
  return attributes;
}

vtkHybridSurfaceVoxelizer::Settings vtkHybridSurfaceVoxelizer::GetSettings(
  const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid)
{
  const auto context = this->GetContext()->GetRecord();
  if (!context->SupportsCompute())
  {
    throw std::runtime_error("vtkHybridSurfaceVoxelizer needs OpenGL 4.3, which " +
      context->GetRendererName() +
      " has not. vtkSlicemapSolidVoxelizer with mode Boundary does without.");
  }
  Settings settings;
  settings.Separability = this->Separability;
  settings.Classified = this->PreClassification ? &this->Kept->Triangles : nullptr;
  settings.Large = this->GetUsedBackend() == BACKEND_RASTER
    ? vtkSurfacePass::LargeTriangles::Fragments
    : vtkSurfacePass::LargeTriangles::Tiles;
  if (this->Strategy == STRATEGY_TRIANGLE)
  {
    settings.CutoffArea = vtkSurfacePass::LargestCutoffArea;
  }
  else if (this->Strategy == STRATEGY_FRAGMENT)
  {
    settings.CutoffArea = vtkSurfacePass::AllAreLarge;
  }
  else
  {
    settings.CutoffArea = this->CutoffArea >= 0.0
      ? static_cast<float>(this->CutoffArea)
      : vtkSurfacePass::Get(context).FindCutoffArea(this->GetContext(), mesh, grid, settings.Large);
    this->UsedCutoffArea = settings.CutoffArea;
  }
  return settings;
}

bool vtkHybridSurfaceVoxelizer::Voxelize(
  vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkSlicemap* slicemap)
{
  const auto settings = this->GetSettings(mesh, grid);
  if (!slicemap->Allocate(grid))
  {
    return false;
  }
  slicemap->GetBuffer().Fill(0);
  const double share = this->GetBytesOfArrays() > 0 ? ShareOfOccupancy : 1.0;
  return vtkSurfacePass::Get(this->GetContext()->GetRecord())
    .Run(mesh, slicemap, settings, [&](double done) { return this->ReportProgress(share * done); });
}

std::int64_t vtkHybridSurfaceVoxelizer::GetBytesOfArrays()
{
  constexpr std::int64_t typicalComponents = 3;
  return static_cast<std::int64_t>(this->Attributes.size()) * typicalComponents *
    static_cast<std::int64_t>(sizeof(float)) +
    (this->TextureImage ? this->TextureImage->GetNumberOfScalarComponents() : 0);
}

bool vtkHybridSurfaceVoxelizer::AddArrays(
  vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkDataSetAttributes* voxels)
{
  auto attributes = this->LoadAttributes(mesh);
  if (attributes.GetNumber() == 0)
  {
    return true;
  }
  Arrays arrays;
  for (int i = 0; i < attributes.GetNumber(); ++i)
  {
    arrays.push_back(attributes.NewArray(i, grid.GetNumberOfVoxels()));
    arrays.back()->Fill(0.0);
    voxels->AddArray(arrays.back());
  }
  const std::int64_t sliceVoxels = grid.GetNumberOfVoxels() / grid.GetDimensions().z;
  Run run(this, mesh, attributes, this->GetSettings(mesh, grid));
  return run.ForEachSlab(
    grid,
    [&](const Slab& slab)
    {
      const vtkIdType first = sliceVoxels * (slab.Grid.GetFirst().z - grid.GetFirst().z);
      for (std::size_t i = 0; i < arrays.size(); ++i)
      {
        for (vtkIdType voxel = 0; voxel < slab.Count; ++voxel)
        {
          arrays[i]->SetTuple(first + slab.Indices[voxel], voxel, slab.Values[i]);
        }
      }
    },
    ShareOfOccupancy);
}

bool vtkHybridSurfaceVoxelizer::FillVoxelList(
  vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkPolyData* output)
{
  auto attributes = this->LoadAttributes(mesh);
  const glm::dmat4 indexToWorld = grid.GetIndexToWorld();
  const double farthest =
    glm::length(glm::dvec3(grid.GetWorldToIndex() * glm::dvec4(0.0, 0.0, 0.0, 1.0)));
  vtkNew<vtkPoints> points;
  points->SetDataType(farthest > LargestFloatIndex ? VTK_DOUBLE : VTK_FLOAT);
  vtkNew<vtkIntArray> indices;
  indices->SetName("VoxelIndex");
  indices->SetNumberOfComponents(3);
  SparseArrays arrays(attributes);
  Run run(this, mesh, attributes, this->GetSettings(mesh, grid));
  const bool finished = run.ForEachSlab(grid,
    [&](const Slab& slab)
    {
      run.CheckBytes(points->GetNumberOfPoints() + slab.Count, ListBytes, "list");
      for (vtkIdType i = 0; i < slab.Count; ++i)
      {
        const glm::ivec3 voxel = slab.Grid.GetFirst() + slab.GetVoxel(i);
        const glm::dvec3 centre(indexToWorld * glm::dvec4(glm::dvec3(voxel), 1.0));
        points->InsertNextPoint(&centre[0]);
        indices->InsertNextTypedTuple(&voxel[0]);
      }
      arrays.Append(slab);
    });
  output->SetPoints(points);
  const vtkIdType n = points->GetNumberOfPoints();
  this->SetNumberOfFilledVoxels(n);
  output->SetVerts(n < VTK_TYPE_INT32_MAX ? MakeVertices<vtkTypeInt32Array>(n)
                                          : MakeVertices<vtkTypeInt64Array>(n));
  output->GetPointData()->AddArray(indices);
  grid.ApplyTo(output->GetFieldData());
  for (const auto& array : arrays.All)
  {
    output->GetPointData()->AddArray(array);
  }
  return finished;
}

bool vtkHybridSurfaceVoxelizer::FillHyperTreeGrid(
  vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkHyperTreeGrid* output)
{
  vtkVoxelTree tree(grid);
  auto attributes = this->LoadAttributes(mesh);
  SparseArrays arrays(attributes);
  Run run(this, mesh, attributes, this->GetSettings(mesh, grid));
  const bool finished = run.ForEachSlab(grid,
    [&](const Slab& slab)
    {
      run.CheckBytes(
        static_cast<std::int64_t>(tree.GetNumberOfVoxels()) + slab.Count, TreeBytes, "octree");
      const glm::ivec3 offset = slab.Grid.GetFirst() - grid.GetFirst();
      for (vtkIdType i = 0; i < slab.Count; ++i)
      {
        tree.AddVoxel(offset + slab.GetVoxel(i));
      }
      arrays.Append(slab);
    });
  this->SetNumberOfFilledVoxels(static_cast<vtkIdType>(tree.GetNumberOfVoxels()));
  return finished &&
    tree.Build(
      output, arrays.All, [&](double) { return !vtkVoxelCompatibility::CheckAbort(this); });
}

void vtkHybridSurfaceVoxelizer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const strategies[] = { "Auto", "Triangle", "Fragment", "Hybrid" };
  const char* const combinations[] = { "Average", "Min", "Max", "First" };
  os << indent << "Separability: " << this->Separability << "\n";
  os << indent << "Strategy: " << strategies[this->Strategy] << "\n";
  os << indent << "CutoffArea: " << this->CutoffArea << "\n";
  os << indent << "PreClassification: " << this->PreClassification << "\n";
  os << indent << "UsedCutoffArea: " << this->UsedCutoffArea << "\n";
  os << indent << "Attributes:";
  for (const std::string& name : this->Attributes)
  {
    os << " " << name;
  }
  os << "\n";
  os << indent << "TextureImage: " << this->TextureImage << "\n";
  os << indent << "AttributeCombination: " << combinations[this->AttributeCombination] << "\n";
}
