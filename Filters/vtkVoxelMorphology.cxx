// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelMorphology.h"

#include "vtkMorphologyPass.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapExpression.h"
#include "vtkSlicemapExpressionPass.h"
#include "vtkVoxelContext.h"
#include "vtkVoxelGrid.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace
{
using Element = vtkMorphologyPass::Element;
using Stage = vtkMorphologyPass::Operation;

constexpr int LargestSphere = 2 * Element::LongestRow + 1;
constexpr std::int64_t LargestBox = VTK_INT_MAX / 4;

/// Of a box of so many voxels, as vtkImageDilateErode3D has it.
Element MakeBox(const glm::ivec3& size)
{
  return { -(size / 2), size - 1 - size / 2, {} };
}

/// The voxel and those around it that are off on so many axes at once, at most.
Element MakeNeighbours(int axes)
{
  Element element;
  for (int z = -1; z <= 1; ++z)
  {
    for (int y = -1; y <= 1; ++y)
    {
      const int used = std::abs(y) + std::abs(z);
      if (used <= axes)
      {
        const int reach = used < axes ? 1 : 0;
        element.Rows.push_back({ y, z, -reach, reach });
      }
    }
  }
  return element;
}

/// An ellipsoid with axes of so many voxels, as vtkImageDilateErode3D has it.
Element MakeSphere(const glm::ivec3& size)
{
  const glm::dvec3 centre = 0.5 * glm::dvec3(size - 1);
  const glm::dvec3 radius = 0.5 * glm::dvec3(size);
  const auto square = [](double x) { return x * x; };
  Element element;
  for (int z = 0; z < size.z; ++z)
  {
    for (int y = 0; y < size.y; ++y)
    {
      const double rest = square((y - centre.y) / radius.y) + square((z - centre.z) / radius.z);
      int first = 0;
      while (first < size.x && square((first - centre.x) / radius.x) + rest > 1.0)
      {
        ++first;
      }
      const int last = size.x - 1 - first;
      if (first <= last)
      {
        const glm::ivec3 middle = size / 2;
        element.Rows.push_back({ y - middle.y, z - middle.z, first - middle.x, last - middle.x });
      }
    }
  }
  return element;
}

Element MakeElement(int kernel, const glm::ivec3& size)
{
  switch (kernel)
  {
    case vtkVoxelMorphology::KERNEL_FACES6:
      return MakeNeighbours(1);
    case vtkVoxelMorphology::KERNEL_EDGES18:
      return MakeNeighbours(2);
    case vtkVoxelMorphology::KERNEL_SPHERE:
      return MakeSphere(size);
    case vtkVoxelMorphology::KERNEL_CORNERS26:
      return MakeBox(glm::ivec3(3));
    default:
      return MakeBox(size);
  }
}

std::vector<Stage> GetStages(int operation)
{
  switch (operation)
  {
    case vtkVoxelMorphology::OPERATION_OPEN:
      return { Stage::Erode, Stage::Dilate };
    case vtkVoxelMorphology::OPERATION_CLOSE:
      return { Stage::Dilate, Stage::Erode };
    case vtkVoxelMorphology::OPERATION_ERODE:
    case vtkVoxelMorphology::OPERATION_INNER_GRADIENT:
      return { Stage::Erode };
    default:
      return { Stage::Dilate };
  }
}
}

vtkStandardNewMacro(vtkVoxelMorphology);

void vtkVoxelMorphology::CheckInputs(const std::vector<vtkVoxelGrid>&)
{
  const bool isSphere = this->KernelType == KERNEL_SPHERE;
  if (!isSphere && this->KernelType != KERNEL_BOX)
  {
    return;
  }
  const std::int64_t largest = isSphere ? LargestSphere : LargestBox / this->Iterations;
  if (std::any_of(this->KernelSize, this->KernelSize + 3,
        [&](int size) { return size < 1 || size > largest; }))
  {
    throw std::runtime_error("KernelSize is " + std::to_string(this->KernelSize[0]) + ", " +
      std::to_string(this->KernelSize[1]) + ", " + std::to_string(this->KernelSize[2]) +
      ". Set 1 to " + std::to_string(largest) + " voxels on each axis.");
  }
}

bool vtkVoxelMorphology::Process(const std::vector<vtkSlicemap*>& inputs, vtkSlicemap* output)
{
  const auto& context = this->GetContext()->GetRecord();
  const vtkMorphologyPass pass(context, static_cast<vtkMorphologyPass::Border>(this->BorderValue));
  const glm::ivec3 size(this->KernelSize[0], this->KernelSize[1], this->KernelSize[2]);
  Element element = MakeElement(this->KernelType, size);
  const bool isBox = element.Rows.empty();
  if (isBox)
  {
    element = element.Repeated(this->Iterations);
  }
  const int repetitions = isBox ? 1 : this->Iterations;
  const auto stages = GetStages(this->Operation);

  vtkNew<vtkSlicemap> other;
  other->SetContext(this->GetContext());
  vtkSlicemap* source = inputs[0];
  const double total = double(stages.size()) * repetitions;
  int done = 0;
  for (const Stage stage : stages)
  {
    for (int i = 0; i < repetitions; ++i, ++done)
    {
      if (!this->ReportProgress(done / total))
      {
        return false;
      }
      if (source == output)
      {
        output->Swap(other);
        source = other;
      }
      pass.Run(stage, element, source, output);
      source = output;
    }
    element = element.Mirrored();
  }

  const bool isInner = this->Operation == OPERATION_INNER_GRADIENT;
  if (isInner || this->Operation == OPERATION_OUTER_GRADIENT)
  {
    vtkSlicemapExpressionPass::Run(vtkSlicemapExpression::Join('-', 2), context,
      isInner ? std::vector<vtkSlicemap*>{ inputs[0], output }
              : std::vector<vtkSlicemap*>{ output, inputs[0] },
      output);
  }
  return this->ReportProgress(1.0);
}

void vtkVoxelMorphology::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const operations[] = { "Dilate", "Erode", "Open", "Close", "InnerGradient",
    "OuterGradient" };
  const char* const kernels[] = { "Box", "Faces6", "Edges18", "Corners26", "Sphere" };
  const char* const borders[] = { "Neutral", "Empty", "Full" };
  os << indent << "Operation: " << operations[this->Operation] << "\n";
  os << indent << "KernelType: " << kernels[this->KernelType] << "\n";
  os << indent << "KernelSize: " << this->KernelSize[0] << ", " << this->KernelSize[1] << ", "
     << this->KernelSize[2] << "\n";
  os << indent << "Iterations: " << this->Iterations << "\n";
  os << indent << "BorderValue: " << borders[this->BorderValue] << "\n";
}
