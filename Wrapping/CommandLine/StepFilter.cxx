// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "StepFilter.h"

#include "vtkVoxelBoolean.h"
#include "vtkVoxelConnectivity.h"
#include "vtkVoxelMorphology.h"

namespace
{
using Type = Options::Step::Type;

vtkSmartPointer<vtkVoxelFilter> MakeBoolean(int operation)
{
  auto filter = vtkSmartPointer<vtkVoxelBoolean>::New();
  filter->SetOperation(operation);
  return filter;
}

vtkSmartPointer<vtkVoxelFilter> MakeMorphology(int operation, const Options::Step& step)
{
  auto filter = vtkSmartPointer<vtkVoxelMorphology>::New();
  filter->SetOperation(operation);
  filter->SetKernelType(step.Kernel);
  const bool hasSize = step.Kernel == vtkVoxelMorphology::KERNEL_BOX ||
    step.Kernel == vtkVoxelMorphology::KERNEL_SPHERE;
  if (hasSize)
  {
    const int size = 2 * step.Reach + 1;
    filter->SetKernelSize(size, size, size);
  }
  else
  {
    filter->SetIterations(step.Reach);
  }
  return filter;
}

vtkSmartPointer<vtkVoxelFilter> MakeConnectivity(int operation, const Options::Step& step)
{
  auto filter = vtkSmartPointer<vtkVoxelConnectivity>::New();
  filter->SetOperation(operation);
  filter->SetConnectivity(step.Connectivity);
  return filter;
}
}

vtkSmartPointer<vtkVoxelFilter> StepFilter::Make(const Options::Step& step)
{
  switch (step.What)
  {
    case Type::Unite:
      return MakeBoolean(vtkVoxelBoolean::OPERATION_UNION);
    case Type::Intersect:
      return MakeBoolean(vtkVoxelBoolean::OPERATION_INTERSECTION);
    case Type::Subtract:
      return MakeBoolean(vtkVoxelBoolean::OPERATION_DIFFERENCE);
    case Type::Xor:
      return MakeBoolean(vtkVoxelBoolean::OPERATION_XOR);
    case Type::Complement:
      return MakeBoolean(vtkVoxelBoolean::OPERATION_COMPLEMENT);
    case Type::Dilate:
      return MakeMorphology(vtkVoxelMorphology::OPERATION_DILATE, step);
    case Type::Erode:
      return MakeMorphology(vtkVoxelMorphology::OPERATION_ERODE, step);
    case Type::Open:
      return MakeMorphology(vtkVoxelMorphology::OPERATION_OPEN, step);
    case Type::Close:
      return MakeMorphology(vtkVoxelMorphology::OPERATION_CLOSE, step);
    case Type::FillHoles:
      return MakeConnectivity(vtkVoxelConnectivity::OPERATION_FILL_HOLES, step);
    case Type::KeepLargest:
      return MakeConnectivity(vtkVoxelConnectivity::OPERATION_KEEP_LARGEST, step);
  }
  return nullptr;
}
