// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelizerFactory.h"

#include "ImageReader.h"
#include "Options.h"
#include "TextureImage.h"

#include "vtkDepthBufferVoxelizer.h"
#include "vtkHybridSurfaceVoxelizer.h"
#include "vtkImageData.h"
#include "vtkSlicemapSolidVoxelizer.h"
#include "vtkTetraCoveringVoxelizer.h"

namespace
{
void SetGrid(vtkVoxelizer* voxelizer, const Options& options, Messages& messages)
{
  if (options.Reference)
  {
    voxelizer->SetReferenceImage(ImageReader::ReadGeometry(*options.Reference, messages));
    return;
  }
  if (options.Dimensions)
  {
    voxelizer->SetSampleDimensions(options.Dimensions->data());
  }
  else if (options.VoxelSize)
  {
    voxelizer->SetVoxelSize(*options.VoxelSize);
  }
  else if (options.HasRandomVariants() && !options.StaysInPlace)
  {
    const int n = options.Resolution.value_or(Options::DefaultResolution);
    voxelizer->SetSampleDimensions(n, n, n);
  }
  else
  {
    voxelizer->SetResolution(options.Resolution.value_or(Options::DefaultResolution));
  }
  if (options.Bounds)
  {
    voxelizer->SetModelBounds(options.Bounds->data());
  }
  voxelizer->SetPadding(options.Padding.value_or(voxelizer->GetPadding()));
}

vtkSmartPointer<vtkVoxelizer> MakeSolid(const Options& options)
{
  auto voxelizer = vtkSmartPointer<vtkSlicemapSolidVoxelizer>::New();
  voxelizer->SetMode(options.Mode.value_or(voxelizer->GetMode()));
  voxelizer->SetFillRule(options.FillRule.value_or(voxelizer->GetFillRule()));
  voxelizer->SetColumnAxis(options.ColumnAxis.value_or(voxelizer->GetColumnAxis()));
  return voxelizer;
}

vtkSmartPointer<vtkHybridSurfaceVoxelizer> MakeSurface(const Options& options)
{
  auto voxelizer = vtkSmartPointer<vtkHybridSurfaceVoxelizer>::New();
  voxelizer->SetSeparability(options.Separability.value_or(voxelizer->GetSeparability()));
  voxelizer->SetAttributeCombination(
    options.Combination.value_or(voxelizer->GetAttributeCombination()));
  for (const std::string& name : options.Attributes)
  {
    voxelizer->AddAttribute(name.c_str());
  }
  return voxelizer;
}

vtkSmartPointer<vtkVoxelizer> MakeDepth(const Options& options)
{
  auto voxelizer = vtkSmartPointer<vtkDepthBufferVoxelizer>::New();
  if (options.Axes)
  {
    voxelizer->SetAxes((*options.Axes)[0], (*options.Axes)[1], (*options.Axes)[2]);
  }
  voxelizer->SetAutomaticAxes(options.AutomaticAxes);
  return voxelizer;
}

vtkSmartPointer<vtkVoxelizer> MakeTetra(const Options& options)
{
  auto voxelizer = vtkSmartPointer<vtkTetraCoveringVoxelizer>::New();
  voxelizer->SetShell(options.Shell.value_or(voxelizer->GetShell()));
  return voxelizer;
}

void SetVariants(vtkTetraCoveringVoxelizer* voxelizer, const Options& options)
{
  voxelizer->SetVariant(options.FirstVariant.value_or(0));
  voxelizer->SetSeed(options.Seed.value_or(0));
  if (options.RotationAxis == Options::AnyAxis)
  {
    voxelizer->SetRotationModeToUniform();
  }
  else if (options.RotationAxis)
  {
    std::array<double, 3> axis{ 0.0, 0.0, 0.0 };
    axis[*options.RotationAxis] = 1.0;
    voxelizer->SetRotationModeToAxis();
    voxelizer->SetRotationAxis(axis.data());
  }
  if (options.ScaleRange)
  {
    voxelizer->SetScaleRange(options.ScaleRange->data());
  }
  voxelizer->SetDisplacementAmplitude(options.Displacement.value_or(0.0));
  voxelizer->SetSafeScaleToFit(options.HasRandomVariants() && !options.StaysInPlace);
}

vtkSmartPointer<vtkVoxelizer> MakeByMethod(const Options& options)
{
  switch (options.Method)
  {
    case Options::MethodType::Surface:
      return MakeSurface(options);
    case Options::MethodType::Depth:
      return MakeDepth(options);
    case Options::MethodType::Tetra:
      return MakeTetra(options);
    default:
      return MakeSolid(options);
  }
}

vtkSmartPointer<vtkVoxelizer> MakeWithoutGrid(const Options& options)
{
  auto voxelizer = MakeByMethod(options);
  voxelizer->SetBackend(options.Backend.value_or(voxelizer->GetBackend()));
  return voxelizer;
}
}

vtkSmartPointer<vtkVoxelizer> VoxelizerFactory::Make(const Options& options, Messages& messages)
{
  auto voxelizer = MakeWithoutGrid(options);
  if (options.Texture)
  {
    vtkHybridSurfaceVoxelizer::SafeDownCast(voxelizer)->SetTextureImage(
      TextureImage::Read(*options.Texture, messages));
  }
  if (auto* tetra = vtkTetraCoveringVoxelizer::SafeDownCast(voxelizer))
  {
    SetVariants(tetra, options);
  }
  SetGrid(voxelizer, options, messages);
  return voxelizer;
}

vtkSmartPointer<vtkVoxelizer> VoxelizerFactory::MakeOnGrid(
  const Options& options, vtkImageData* grid)
{
  auto voxelizer = MakeWithoutGrid(options);
  voxelizer->SetReferenceImage(grid);
  return voxelizer;
}

void VoxelizerFactory::SetOutput(vtkVoxelAlgorithm* algorithm, const Options& options)
{
  algorithm->SetOutputScalarType(options.ScalarType.value_or(algorithm->GetOutputScalarType()));
  algorithm->SetForegroundValue(options.Value.value_or(algorithm->GetForegroundValue()));
  if (options.Cells)
  {
    algorithm->SetOutputAttributeTypeToCell();
  }
}
