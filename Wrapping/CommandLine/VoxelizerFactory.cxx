// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelizerFactory.h"

#include "Options.h"
#include "ReferenceImage.h"
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
    voxelizer->SetReferenceImage(ReferenceImage::Read(*options.Reference, messages));
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

void SetVoxels(vtkVoxelizer* voxelizer, const Options& options)
{
  voxelizer->SetBackend(options.Backend.value_or(voxelizer->GetBackend()));
  voxelizer->SetOutputScalarType(options.ScalarType.value_or(voxelizer->GetOutputScalarType()));
  voxelizer->SetForegroundValue(options.Value.value_or(voxelizer->GetForegroundValue()));
  if (options.Cells)
  {
    voxelizer->SetOutputAttributeTypeToCell();
  }
}

vtkSmartPointer<vtkVoxelizer> MakeSolid(const Options& options)
{
  auto voxelizer = vtkSmartPointer<vtkSlicemapSolidVoxelizer>::New();
  voxelizer->SetMode(options.Mode.value_or(voxelizer->GetMode()));
  voxelizer->SetFillRule(options.FillRule.value_or(voxelizer->GetFillRule()));
  voxelizer->SetColumnAxis(options.ColumnAxis.value_or(voxelizer->GetColumnAxis()));
  return voxelizer;
}

vtkSmartPointer<vtkVoxelizer> MakeSurface(const Options& options, Messages& messages)
{
  auto voxelizer = vtkSmartPointer<vtkHybridSurfaceVoxelizer>::New();
  voxelizer->SetSeparability(options.Separability.value_or(voxelizer->GetSeparability()));
  voxelizer->SetAttributeCombination(
    options.Combination.value_or(voxelizer->GetAttributeCombination()));
  for (const std::string& name : options.Attributes)
  {
    voxelizer->AddAttribute(name.c_str());
  }
  if (options.Texture)
  {
    voxelizer->SetTextureImage(TextureImage::Read(*options.Texture, messages));
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
  return voxelizer;
}

vtkSmartPointer<vtkVoxelizer> MakeByMethod(const Options& options, Messages& messages)
{
  switch (options.Method)
  {
    case Options::MethodType::Surface:
      return MakeSurface(options, messages);
    case Options::MethodType::Depth:
      return MakeDepth(options);
    default:
      return MakeSolid(options);
  }
}
}

vtkSmartPointer<vtkVoxelizer> VoxelizerFactory::Make(const Options& options, Messages& messages)
{
  auto voxelizer = MakeByMethod(options, messages);
  SetGrid(voxelizer, options, messages);
  SetVoxels(voxelizer, options);
  return voxelizer;
}
