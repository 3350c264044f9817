// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeFilter.h"

#include "Options.h"

#include "vtkImageToSlicemap.h"
#include "vtkVoxelBoolean.h"

namespace
{
vtkSmartPointer<vtkVoxelFilter> MakeWithoutOutput(const Options& options)
{
  if (!options.ScalarRange)
  {
    // The union of one input is what is not zero in it.
    return vtkSmartPointer<vtkVoxelBoolean>::New();
  }
  const auto [lower, upper] = *options.ScalarRange;
  auto filter = vtkSmartPointer<vtkImageToSlicemap>::New();
  filter->ThresholdBetween(lower, upper);
  return filter;
}
}

vtkSmartPointer<vtkVoxelFilter> VolumeFilter::Make(const Options& options)
{
  auto filter = MakeWithoutOutput(options);
  filter->SetOutputAttributeTypeToPoint();
  return filter;
}
