// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetraCoveringVoxelizer.h"

#include "vtkAlgorithmOutput.h"
#include "vtkAppendPolyData.h"
#include "vtkDataSetAttributes.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapImage.h"
#include "vtkSlicemapKernel.h" // for vtkSlicemapTexture
#include "vtkSlicemapQuadKernel.h"
#include "vtkSolidComputePass.h"
#include "vtkSolidRasterPass.h"
#include "vtkTetraAugmentation.h"
#include "vtkTetraModel.h"
#include "vtkTetraRasterPass.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVoxelContext.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelMesh.h"
#include "vtkVoxelMeshDisplacement.h"
#include "vtkVoxelMeshVariants.h"

#include "vtkTetraShellGLSL.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>
#include <stdexcept>
#include <tuple>

vtkStandardNewMacro(vtkTetraCoveringVoxelizer);

namespace
{
using Augmentation = vtkTetraAugmentation;

using Displacement = vtkVoxelMeshDisplacement;

constexpr std::int64_t WordsPerQuad = 4;

/// Kept with the context, since it holds buffers worth reusing.
template <typename Kept, typename... Arguments>
Kept& GetKept(const std::string& name, const vtkVoxelGL::Context& context, Arguments... arguments)
{
  auto& cached = context->GetCache()[name];
  if (!cached)
  {
    cached = std::make_shared<Kept>(arguments...);
  }
  return *static_cast<Kept*>(cached.get());
}

/// The voxels of `grid` as the untransformed model sees them.
vtkVoxelGrid TransformBack(const vtkVoxelGrid& grid, const glm::dmat4& transform)
{
  const glm::dmat4 modelFromIndex = glm::inverse(transform) * grid.GetIndexToWorld();
  vtkVoxelGrid oblique;
  oblique.Extent = grid.Extent;
  oblique.Direction = glm::dmat3(modelFromIndex);
  oblique.Origin = glm::dvec3(modelFromIndex[3]);
  return oblique;
}

/// One voxel more on each side, as far as the whole grid goes.
vtkVoxelGrid GrownBy1(const vtkVoxelGrid& grid, const vtkVoxelGrid& whole)
{
  vtkVoxelGrid grown = grid;
  for (int axis = 0; axis < 3; ++axis)
  {
    int& low = grown.Extent[2 * axis];
    int& high = grown.Extent[2 * axis + 1];
    low = std::max(low - 1, whole.Extent[2 * axis]);
    high = std::min(high + 1, whole.Extent[2 * axis + 1]);
  }
  return grown;
}

void AllocateOrThrow(vtkSlicemap* slicemap, const vtkVoxelGrid& grid)
{
  if (!slicemap->Allocate(grid))
  {
    throw std::runtime_error("There is no memory on the GPU for the voxels. Use fewer of them.");
  }
}

/// So many grids, one behind the other along z, as one: for their words only.
vtkVoxelGrid StackOf(const vtkVoxelGrid& grid, int count)
{
  vtkVoxelGrid stack = grid;
  stack.Extent[5] = grid.Extent[4] + count * grid.GetDimensions().z - 1;
  return stack;
}

/// `part`, whose grid lies within that of `all`, becomes a copy of that part.
void CopyPart(vtkSlicemap* all, const vtkVoxelGrid& grid, vtkSlicemap* part)
{
  AllocateOrThrow(part, grid);
  const glm::ivec3 offset = all->GetGrid().GetFirst() - grid.GetFirst();
  part->CopyVoxels(all, { offset.x, offset.y, offset.z });
}

constexpr auto OnSurface = vtkSolidPass::Ties::UpperInside;

vtkSolidComputePass& GetComputePass(const vtkVoxelGL::Context& context)
{
  return GetKept<vtkSolidComputePass>("tetrahedra compute pass", context, context, OnSurface);
}

/// The axis is the same for all parts of `whole`.
bool FillColumns(vtkSolidPass& pass, const vtkVoxelMesh& mesh, const vtkVoxelGrid& whole,
  vtkSlicemap* solid, const std::function<bool(double)>& progress)
{
  const int axis = pass.GetCheapestAxis(mesh, solid->GetGrid().WithExtent(whole.Extent));
  return pass.FillSolid(mesh, solid, axis, vtkSolidPass::Rule::Parity, progress);
}

/// The ring of a seed is kept with the context: all models of a data set have it in common.
std::shared_ptr<const Displacement::Ring> GetRing(
  const vtkVoxelGL::Context& context, const Augmentation& augmentation)
{
  struct Kept
  {
    std::shared_ptr<const Displacement::Ring> Ring;
    std::uint64_t Seed;
    Augmentation::Distribution Distribution;
  };
  auto& kept = GetKept<Kept>("ring of displacements", context);
  if (!kept.Ring || kept.Seed != augmentation.Seed ||
    kept.Distribution != augmentation.Displacements)
  {
    kept = { std::make_shared<Displacement::Ring>(context, augmentation.MakeDisplacements()),
      augmentation.Seed, augmentation.Displacements };
  }
  return kept.Ring;
}
}

struct vtkTetraCoveringVoxelizer::Internals
{
  std::unique_ptr<vtkTetraModel> Model;
  int UploadOfModel = 0;
  vtkVoxelMesh ClosedMesh;
  vtkVoxelMeshDisplacement Displacement;
  /// What the points of the displacement were made from.
  std::tuple<const vtkTetraModel*, bool, const void*> Displaced;
  vtkNew<vtkSlicemap> Solid;
  vtkNew<vtkSlicemap> Shell;
};

struct vtkTetraCoveringVoxelizer::Placement
{
  glm::dmat4 Transform;
  std::uint32_t FirstDisplacement;
};

/// A variant: the voxels as the untransformed model sees them.
struct vtkTetraCoveringVoxelizer::View
{
  vtkVoxelGrid Grid;
  std::uint32_t FirstDisplacement;
};

vtkTetraCoveringVoxelizer::vtkTetraCoveringVoxelizer()
  : Tetra(std::make_unique<Internals>())
{
}

vtkTetraCoveringVoxelizer::~vtkTetraCoveringVoxelizer() = default;

void vtkTetraCoveringVoxelizer::CheckProperties()
{
  const auto require = [](bool holds, const std::string& message)
  {
    if (!holds)
    {
      throw std::runtime_error(message);
    }
  };
  const auto isAxis = [](const double* v)
  {
    const double length = glm::length(glm::dvec3(v[0], v[1], v[2]));
    return length > 0.0 && std::isfinite(length);
  };
  require(this->Shell == SHELL_NONE || this->Shell == SHELL_6 || this->Shell == SHELL_18 ||
      this->Shell == SHELL_26,
    "Shell is " + std::to_string(this->Shell) + "; it must be 0, 6, 18 or 26.");
  require(
    this->Shell == SHELL_NONE || !this->KeepInterior || this->GetOutputScalarType() != VTK_BIT,
    "KeepInterior needs two values and VTK_BIT has one. Set the scalar type to unsigned char.");
  require(isAxis(this->FixedRotation + 1) && std::isfinite(this->FixedRotation[0]),
    "The axis of FixedRotation must have a length, and all its numbers must be finite.");
  require(isAxis(this->RotationAxis), "RotationAxis must have a length, and be finite.");
  require(this->ScaleRange[0] > 0.0 && this->ScaleRange[0] <= this->ScaleRange[1] &&
      std::isfinite(this->ScaleRange[1]),
    "ScaleRange is " + std::to_string(this->ScaleRange[0]) + ", " +
      std::to_string(this->ScaleRange[1]) +
      "; the lower bound must be positive and not above the upper one.");
  require(this->DisplacementAmplitude >= 0.0 && this->DisplacementAmplitude <= 1.0,
    "DisplacementAmplitude is " + std::to_string(this->DisplacementAmplitude) +
      "; it must be 0 to 1.");
}

bool vtkTetraCoveringVoxelizer::HasVariants() const
{
  return this->RotationMode != ROTATION_FIXED || this->FixedRotation[0] != 0.0 ||
    this->ScaleRange[0] != 1.0 || this->ScaleRange[1] != 1.0 ||
    this->DisplacementAmplitude != 0.0 || this->SafeScaleToFit;
}

vtkTetraAugmentation vtkTetraCoveringVoxelizer::GetAugmentation(const vtkTetraModel& model) const
{
  const double* fixed = this->FixedRotation;
  Augmentation augmentation;
  augmentation.Seed = static_cast<std::uint64_t>(this->Seed);
  augmentation.Rotation = static_cast<Augmentation::Rotations>(this->RotationMode);
  augmentation.FixedRotation = glm::dmat3(
    glm::rotate(glm::dmat4(1.0), glm::radians(fixed[0]), glm::dvec3(fixed[1], fixed[2], fixed[3])));
  augmentation.Axis =
    glm::dvec3(this->RotationAxis[0], this->RotationAxis[1], this->RotationAxis[2]);
  augmentation.ScaleRange = { this->ScaleRange[0], this->ScaleRange[1] };
  augmentation.Displacements =
    static_cast<Augmentation::Distribution>(this->DisplacementDistribution);
  augmentation.Amplitude =
    static_cast<float>(this->DisplacementAmplitude * model.GetFrame().GetLongestSide());
  return augmentation;
}

vtkVoxelGrid vtkTetraCoveringVoxelizer::GetWholeGrid()
{
  const auto grid = vtkVoxelGrid::FromInformation(this->GetOutputInformation(0));
  return this->HasCellVoxels() ? grid.CellsToVoxels() : grid;
}

vtkTetraCoveringVoxelizer::Placement vtkTetraCoveringVoxelizer::Place(
  const vtkTetraAugmentation& augmentation, vtkTypeInt64 variant, const vtkTetraModel& model,
  double largestDisplacement)
{
  const auto numbers = augmentation.GetVariant(static_cast<std::uint64_t>(variant));
  const vtkVoxelGrid whole = this->GetWholeGrid();
  return { Augmentation::GetTransform(numbers, model.GetFrame(), largestDisplacement,
             this->SafeScaleToFit ? &whole : nullptr),
    numbers.FirstDisplacement };
}

int vtkTetraCoveringVoxelizer::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  try
  {
    this->CheckProperties();
  }
  catch (const std::runtime_error& error)
  {
    return this->FailInformation(error.what(), outputs);
  }
  return this->Superclass::RequestInformation(request, inputs, outputs);
}

vtkVoxelMesh& vtkTetraCoveringVoxelizer::PrepareMesh(vtkVoxelMesh& mesh)
{
  auto& model = this->Tetra->Model;
  if (!model || this->Tetra->UploadOfModel != mesh.GetNumberOfUploads())
  {
    model =
      std::make_unique<vtkTetraModel>(vtkVoxelMesh::GetLeaves(this->GetInputDataObject(0, 0)));
    this->Tetra->UploadOfModel = mesh.GetNumberOfUploads();
    this->Tetra->Displaced = {};
  }
  this->NumberOfOpenEdges = model->GetNumberOfOpenEdges();
  this->NumberOfNonManifoldEdges = model->GetNumberOfNonManifoldEdges();
  if (model->IsClosed())
  {
    return mesh;
  }
  if (this->GetCheckWatertight())
  {
    vtkWarningMacro("The mesh is not closed: it has "
      << this->NumberOfOpenEdges << " open and " << this->NumberOfNonManifoldEdges
      << " non-manifold edges. Holes are closed by cones to the mean of the points. Close the "
         "mesh, "
      << "for instance by vtkFillHolesFilter, or use vtkSlicemapSolidVoxelizer with the fill rule "
      << "Vote.");
  }
  this->Tetra->ClosedMesh.Update(
    this->GetContext()->GetRecord(), model->GetClosedMesh(), vtkVoxelMesh::Triangulation::Fans);
  return this->Tetra->ClosedMesh;
}

void vtkTetraCoveringVoxelizer::PrepareDisplacement(const vtkTetraAugmentation& augmentation)
{
  const vtkTetraModel& model = *this->Tetra->Model;
  const auto context = this->GetContext()->GetRecord();
  auto& displacement = this->Tetra->Displacement;
  displacement.SetRing(GetRing(context, augmentation), augmentation.Amplitude);
  const bool alongNormals = this->MovesAlongNormals();
  const auto key = std::make_tuple(&model, alongNormals, static_cast<const void*>(context.get()));
  if (this->Tetra->Displaced != key)
  {
    const auto places = model.FindPlaces();
    displacement.SetPoints(
      context, places, alongNormals ? model.ComputeNormals(places) : std::vector<glm::vec3>());
    this->Tetra->Displaced = key;
  }
}

int vtkTetraCoveringVoxelizer::GetNumberOfWorkSlicemaps()
{
  constexpr int ofShell = 3;
  return this->Shell == SHELL_NONE ? 1 : ofShell;
}

bool vtkTetraCoveringVoxelizer::RunPass(
  vtkVoxelMesh& mesh, vtkSlicemap* solid, const std::function<bool(double)>& progress)
{
  const auto context = this->GetContext()->GetRecord();
  if (this->GetUsedBackend() == BACKEND_COMPUTE)
  {
    return FillColumns(GetComputePass(context), mesh, this->GetWholeGrid(), solid, progress);
  }
  if (this->RasterMethod == RASTER_COLUMNS)
  {
    return FillColumns(
      GetKept<vtkSolidRasterPass>("tetrahedra columns pass", context, context, OnSurface), mesh,
      this->GetWholeGrid(), solid, progress);
  }
  auto& pass = GetKept<vtkTetraRasterPass>("tetrahedra raster pass", context, context);
  const auto method = this->RasterMethod == RASTER_SLICES ? vtkTetraRasterPass::Method::Slices
                                                          : vtkTetraRasterPass::Method::Layers;
  return pass.FillSolid(mesh, this->Tetra->Model->GetFrame().Origin, solid, method, progress);
}

/// Displaces the mesh too if the variants are.
vtkTetraCoveringVoxelizer::View vtkTetraCoveringVoxelizer::See(
  vtkTypeInt64 variant, vtkVoxelMesh& mesh, const vtkVoxelGrid& grid)
{
  mesh.SetDisplacement(nullptr);
  if (!this->HasVariants())
  {
    return { grid, 0 };
  }
  const vtkTetraModel& model = *this->Tetra->Model;
  const auto augmentation = this->GetAugmentation(model);
  const bool displaced = augmentation.Amplitude > 0.0f;
  const auto& displacement = this->Tetra->Displacement;
  if (displaced)
  {
    this->PrepareDisplacement(augmentation);
    mesh.SetDisplacement(&displacement);
  }
  const auto placement =
    this->Place(augmentation, variant, model, displaced ? displacement.GetLargest() : 0.0);
  return { TransformBack(grid, placement.Transform), placement.FirstDisplacement };
}

bool vtkTetraCoveringVoxelizer::FillSolid(vtkTypeInt64 variant, vtkVoxelMesh& mesh,
  const vtkVoxelGrid& grid, vtkSlicemap* solid, const std::function<bool(double)>& progress)
{
  const View view = this->See(variant, mesh, grid);
  this->Tetra->Displacement.SetFirst(view.FirstDisplacement);
  // The bits are the same for both grids.
  AllocateOrThrow(solid, view.Grid);
  const bool finished = this->RunPass(mesh, solid, progress);
  mesh.SetDisplacement(nullptr);
  AllocateOrThrow(solid, grid);
  return finished;
}

void vtkTetraCoveringVoxelizer::FindShell(
  vtkSlicemap* solid, const vtkVoxelGrid& grid, vtkSlicemap* shell)
{
  AllocateOrThrow(shell, solid->GetGrid());
  const glm::ivec3 n = grid.GetDimensions();
  const std::int64_t quadsPerRow = solid->GetWordsPerRow() / WordsPerQuad;
  vtkVoxelGL::Program::Defines defines{ { "NEIGHBOURS", std::to_string(this->Shell) } };
  if (quadsPerRow == 1)
  {
    defines["ONE_QUAD"] = "1";
  }
  const auto texture = vtkSlicemapTexture(solid);
  const vtkSlicemapQuadKernel kernel("vtkTetraShell", vtkTetraShellGLSL, defines);
  kernel.Run(this->GetContext()->GetRecord(), shell,
    [&](vtkVoxelGL::Program& program)
    {
      texture.Bind(0);
      program.Set("Solid", 0);
      program.Set("Size", std::array<int, 3>{ n.x, n.y, n.z });
      program.Set("QuadsPerRow", static_cast<unsigned int>(quadsPerRow));
    });
}

bool vtkTetraCoveringVoxelizer::Voxelize(
  vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkSlicemap* slicemap)
{
  vtkVoxelMesh& closed = this->PrepareMesh(mesh);
  const auto progress = [this](double done) { return this->ReportProgress(done); };
  if (this->Shell == SHELL_NONE)
  {
    return this->FillSolid(this->Variant, closed, grid, slicemap, progress);
  }
  vtkSlicemap* solid = this->Tetra->Solid;
  vtkSlicemap* shell = this->Tetra->Shell;
  solid->SetContext(this->GetContext());
  shell->SetContext(this->GetContext());
  const vtkVoxelGrid grown = GrownBy1(grid, this->GetWholeGrid());
  if (!this->FillSolid(this->Variant, closed, grown, solid, progress))
  {
    return false;
  }
  this->FindShell(solid, grown, shell);
  const auto take = [&](vtkSlicemap* all, vtkSlicemap* part)
  {
    if (grown.Extent == grid.Extent)
    {
      part->Swap(all);
    }
    else
    {
      CopyPart(all, grid, part);
    }
  };
  if (!this->KeepInterior)
  {
    take(shell, slicemap);
    return true;
  }
  take(solid, slicemap);
  if (!(grown.Extent == grid.Extent))
  {
    CopyPart(shell, grid, solid);
    shell->Swap(solid);
  }
  return true;
}

bool vtkTetraCoveringVoxelizer::AddArrays(
  vtkVoxelMesh&, const vtkVoxelGrid& grid, vtkDataSetAttributes* arrays)
{
  if (this->Shell == SHELL_NONE || !this->KeepInterior)
  {
    return true;
  }
  // Which voxels are set stays as it was, and so the slicemap remains that of the array.
  auto* values = vtkUnsignedCharArray::SafeDownCast(arrays->GetScalars());
  return this->Tetra->Shell->Read([&](const std::uint32_t* words)
    { vtkSlicemapImage::Overlay(words, grid, this->ShellValue, values->GetPointer(0)); });
}

vtkDataObject* vtkTetraCoveringVoxelizer::UpdateInput()
{
  if (this->GetNumberOfInputConnections(0) == 0)
  {
    vtkErrorMacro("There is no input. Connect a mesh.");
    return nullptr;
  }
  try
  {
    // The pipeline does not ask again for information that it once failed to get.
    this->CheckProperties();
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< error.what());
    return nullptr;
  }
  if (!this->GetExecutive()->UpdateInformation())
  {
    return nullptr;
  }
  this->GetInputAlgorithm(0, 0)->Update(this->GetInputConnection(0, 0)->GetIndex());
  return this->GetInputDataObject(0, 0);
}

/// Where some variants of a batch are on the GPU, one grid behind the other along z.
struct vtkTetraCoveringVoxelizer::Slot
{
  vtkNew<vtkSlicemap> Solid;
  vtkNew<vtkSlicemap> Shell;
  int First = 0;           ///< variant of the batch
  std::vector<int> Places; ///< of that and the following ones
};

int vtkTetraCoveringVoxelizer::GetVariantsAtOnce(
  const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, int count)
{
  return this->GetUsedBackend() == BACKEND_COMPUTE
    ? vtkSolidComputePass::GetVariantsAtOnce(mesh, grid, count)
    : 1;
}

bool vtkTetraCoveringVoxelizer::FillSlot(vtkVoxelMesh& mesh, const vtkVoxelGrid& grid,
  vtkTypeInt64 first, Slot& slot, const std::function<bool(double)>& progress)
{
  const auto count = static_cast<int>(slot.Places.size());
  if (count == 1)
  {
    slot.Places = { 0 };
    return this->FillSolid(first + slot.First, mesh, grid, slot.Solid, progress);
  }
  if (!progress(0.0))
  {
    return false;
  }
  auto& pass = GetComputePass(this->GetContext()->GetRecord());
  std::vector<vtkVoxelMeshVariants::Variant> variants;
  for (int i = 0; i < count; ++i)
  {
    const View view = this->See(first + slot.First + i, mesh, grid);
    variants.push_back({ view.Grid.GetWorldToIndex(), pass.GetCheapestAxis(mesh, view.Grid),
      view.FirstDisplacement });
  }
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&](int a, int b) { return variants[a].ColumnAxis < variants[b].ColumnAxis; });
  std::vector<vtkVoxelMeshVariants::Variant> ordered;
  for (int place = 0; place < count; ++place)
  {
    slot.Places[order[place]] = place;
    ordered.push_back(variants[order[place]]);
  }
  AllocateOrThrow(slot.Solid, StackOf(grid, count));
  pass.FillVariants(mesh, grid, ordered, slot.Solid);
  mesh.SetDisplacement(nullptr);
  for (int i = 1; i <= count; ++i)
  {
    if (!progress(double(i) / count))
    {
      return false;
    }
  }
  return true;
}

bool vtkTetraCoveringVoxelizer::FillBatch(vtkVoxelMesh& mesh, const vtkVoxelGrid& grid,
  vtkTypeInt64 first, int count, const BatchReader& read)
{
  vtkVoxelMesh& closed = this->PrepareMesh(mesh);
  const int atOnce = this->GetVariantsAtOnce(closed, grid, count);
  const int rounds = (count + atOnce - 1) / atOnce;
  // One slot is read back while the GPU is busy with the next one.
  std::array<Slot, 2> slots;
  for (const Slot& slot : slots)
  {
    slot.Solid->SetContext(this->GetContext());
    slot.Shell->SetContext(this->GetContext());
  }
  const auto fill = [&](int round)
  {
    Slot& slot = slots[round % 2];
    slot.First = round * atOnce;
    slot.Places.resize(std::min(atOnce, count - slot.First));
    const auto variants = static_cast<double>(slot.Places.size());
    const bool finished = this->FillSlot(closed, grid, first, slot,
      [&](double done) { return this->ReportProgress((slot.First + done * variants) / count); });
    if (finished && this->Shell != SHELL_NONE)
    {
      this->FindShell(slot.Solid, grid, slot.Shell);
    }
    return finished;
  };
  for (int round = 0; round <= rounds; ++round)
  {
    if ((round < rounds && !fill(round)) || (round > 0 && !read(slots[(round - 1) % 2])))
    {
      return false;
    }
  }
  return true;
}

bool vtkTetraCoveringVoxelizer::RunBatch(vtkTypeInt64 first, int count, std::int64_t bytesPerVoxel,
  const std::function<BatchReader(const vtkVoxelGrid& grid)>& begin)
{
  vtkDataObject* input = this->UpdateInput();
  bool finished = false;
  vtkVoxelGrid grid;
  const auto prepare = [&](const vtkVoxelGrid& whole)
  {
    if (first < 0 || count < 1)
    {
      throw std::runtime_error("A batch of " + std::to_string(count) + " variants from " +
        std::to_string(first) + " on can't be made: ask for one at least, from 0 on at least.");
    }
    grid = whole;
    this->CheckBytes(grid.GetNumberOfVoxels() * bytesPerVoxel * count,
      "batch of " + std::to_string(count) + " variants", "Use fewer voxels, or smaller batches.");
    return true;
  };
  const auto work = [&](vtkVoxelMesh& mesh)
  {
    finished = this->FillBatch(mesh, grid, first, count, begin(grid));
    return finished;
  };
  if (input)
  {
    this->RunOnMesh(input, prepare, work);
  }
  return finished;
}

bool vtkTetraCoveringVoxelizer::VoxelizeBatch(
  vtkTypeInt64 first, int count, vtkUnsignedCharArray* array)
{
  if (!array)
  {
    vtkErrorMacro("There is no array for the voxels of the batch.");
    return false;
  }
  const bool hasShell = this->Shell != SHELL_NONE;
  const auto begin = [&](const vtkVoxelGrid& grid) -> BatchReader
  {
    const std::int64_t voxels = grid.GetNumberOfVoxels();
    array->SetName(vtkSlicemapImage::ArrayName);
    array->SetNumberOfComponents(1);
    array->SetNumberOfTuples(voxels * count);
    if (array->GetNumberOfTuples() != voxels * count)
    {
      throw std::runtime_error("There is no memory for the batch. Use smaller ones.");
    }
    return [=](const Slot& slot)
    {
      std::vector<unsigned char*> outs(slot.Places.size());
      for (std::size_t i = 0; i < outs.size(); ++i)
      {
        outs[slot.Places[i]] = array->GetPointer((slot.First + static_cast<int>(i)) * voxels);
      }
      vtkSlicemap* set = hasShell && !this->KeepInterior ? slot.Shell : slot.Solid;
      bool good = set->Read([&](const std::uint32_t* words)
        { vtkSlicemapImage::Expand(words, grid, this->GetForegroundValue(), outs); });
      if (good && hasShell && this->KeepInterior)
      {
        good = slot.Shell->Read(
          [&](const std::uint32_t* words)
          {
            for (unsigned char* out : outs)
            {
              vtkSlicemapImage::Overlay(words, grid, this->ShellValue, out);
              words += vtkSlicemap::GetNumberOfWords(grid);
            }
          });
      }
      return good;
    };
  };
  const bool finished = this->RunBatch(first, count, 1, begin);
  if (!finished)
  {
    array->Initialize();
  }
  return finished;
}

bool vtkTetraCoveringVoxelizer::VisitBatch(vtkTypeInt64 first, int count,
  const std::function<bool(int i, const vtkVoxelGrid& grid, const std::uint32_t* words)>& visit)
{
  const auto begin = [&](const vtkVoxelGrid& grid) -> BatchReader
  {
    return [=](const Slot& slot)
    {
      vtkSlicemap* set = this->Shell == SHELL_NONE ? slot.Solid : slot.Shell;
      bool goesOn = true;
      const auto visitAll = [&](const std::uint32_t* words)
      {
        const std::int64_t wordsPerGrid = vtkSlicemap::GetNumberOfWords(grid);
        for (std::size_t i = 0; goesOn && i < slot.Places.size(); ++i)
        {
          goesOn =
            visit(slot.First + static_cast<int>(i), grid, words + slot.Places[i] * wordsPerGrid);
        }
      };
      return set->Read(visitAll) && goesOn;
    };
  };
  return this->RunBatch(first, count, 0, begin);
}

bool vtkTetraCoveringVoxelizer::RunWithModel(
  const std::function<void(const vtkTetraModel& model)>& work)
{
  vtkDataObject* input = this->UpdateInput();
  if (!input)
  {
    return false;
  }
  try
  {
    work(vtkTetraModel(vtkVoxelMesh::GetLeaves(input)));
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< error.what());
    return false;
  }
  return true;
}

bool vtkTetraCoveringVoxelizer::GetVariantMatrix(vtkTypeInt64 variant, vtkMatrix4x4* matrix)
{
  return this->RunWithModel(
    [&](const vtkTetraModel& model)
    {
      const auto augmentation = this->GetAugmentation(model);
      const double largest = augmentation.Amplitude > 0.0f ? augmentation.Amplitude *
          Displacement::Ring::GetLongest(
            augmentation.MakeDisplacements(), this->MovesAlongNormals())
                                                           : 0.0;
      const auto transform = this->Place(augmentation, variant, model, largest).Transform;
      for (int row = 0; row < 4; ++row)
      {
        for (int column = 0; column < 4; ++column)
        {
          matrix->SetElement(row, column, transform[column][row]);
        }
      }
    });
}

bool vtkTetraCoveringVoxelizer::GetVariantMesh(vtkTypeInt64 variant, vtkPolyData* mesh)
{
  return this->RunWithModel(
    [&](const vtkTetraModel& model)
    {
      const auto augmentation = this->GetAugmentation(model);
      const bool displaced = augmentation.Amplitude > 0.0f;
      const bool alongNormals = this->MovesAlongNormals();
      const auto ring = displaced ? augmentation.MakeDisplacements() : std::vector<glm::vec3>();
      const auto places = displaced ? model.FindPlaces() : std::vector<std::uint32_t>();
      const auto normals =
        displaced && alongNormals ? model.ComputeNormals(places) : std::vector<glm::vec3>();
      const auto placement = this->Place(augmentation, variant, model,
        augmentation.Amplitude * Displacement::Ring::GetLongest(ring, alongNormals));

      vtkNew<vtkAppendPolyData> append;
      vtkNew<vtkPoints> points;
      points->SetDataTypeToDouble();
      vtkIdType id = 0;
      for (const auto& leaf : model.GetLeaves())
      {
        append->AddInputData(leaf);
        for (vtkIdType i = 0; i < leaf->GetNumberOfPoints(); ++i, ++id)
        {
          glm::dvec3 point;
          leaf->GetPoint(i, &point[0]);
          if (displaced)
          {
            const glm::vec3& free = ring[(places[id] + placement.FirstDisplacement) % ring.size()];
            point += glm::dvec3(alongNormals ? (augmentation.Amplitude * free.x) * normals[id]
                                             : augmentation.Amplitude * free);
          }
          point = glm::dvec3(placement.Transform * glm::dvec4(point, 1.0));
          points->InsertNextPoint(&point[0]);
        }
      }
      append->Update();
      mesh->ShallowCopy(append->GetOutput());
      mesh->SetPoints(points);
    });
}

void vtkTetraCoveringVoxelizer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const methods[] = { "Slices", "Layers", "Columns" };
  const char* const rotations[] = { "Fixed", "Uniform", "Axis" };
  const char* const distributions[] = { "Uniform", "Normal" };
  const char* const directions[] = { "Free", "AlongNormal" };
  const auto print = [&](const char* name, const double* values, int count)
  {
    os << indent << name << ":";
    for (int i = 0; i < count; ++i)
    {
      os << " " << values[i];
    }
    os << "\n";
  };
  os << indent << "RasterMethod: " << methods[this->RasterMethod] << "\n";
  os << indent << "Shell: " << this->Shell << "\n";
  os << indent << "KeepInterior: " << this->KeepInterior << "\n";
  os << indent << "ShellValue: " << this->ShellValue << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Variant: " << this->Variant << "\n";
  os << indent << "RotationMode: " << rotations[this->RotationMode] << "\n";
  print("FixedRotation", this->FixedRotation, 4);
  print("RotationAxis", this->RotationAxis, 3);
  print("ScaleRange", this->ScaleRange, 2);
  os << indent << "DisplacementAmplitude: " << this->DisplacementAmplitude << "\n";
  os << indent << "DisplacementDistribution: " << distributions[this->DisplacementDistribution]
     << "\n";
  os << indent << "DisplacementDirection: " << directions[this->DisplacementDirection] << "\n";
  os << indent << "SafeScaleToFit: " << this->SafeScaleToFit << "\n";
  os << indent << "NumberOfOpenEdges: " << this->NumberOfOpenEdges << "\n";
  os << indent << "NumberOfNonManifoldEdges: " << this->NumberOfNonManifoldEdges << "\n";
}
