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

vtkSmartPointer<vtkVoxelizer> MakeByMethod(const Options& options)
{
  switch (options.Method)
  {
    case Options::MethodType::Surface:
      return MakeSurface(options);
    case Options::MethodType::Depth:
      return MakeDepth(options);
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
