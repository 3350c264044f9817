// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMorphologyPass.h"

#include "vtkNew.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapKernel.h" // for vtkSlicemapTexture
#include "vtkSlicemapQuadKernel.h"
#include "vtkVoxelGrid.h"

#include "vtkMorphologyGLSL.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

using vtkVoxelGL::Program;

namespace
{
// As in vtkMorphology.glsl.
constexpr std::size_t MaximumRows = 128;
constexpr int MaximumTaps = 4;
constexpr int WordsPerQuad = 4;
constexpr unsigned int FullWord = 0xffffffffu;

constexpr unsigned int SourceUnit = 0;
constexpr unsigned int PartialUnit = 1;

/// A line of voxels from First to Last.
struct Line
{
  int First;
  int Last;

  int GetLength() const { return this->Last - this->First + 1; }
};

/// A line within `whole`, and around `line`, at most MaximumTaps times as long.
Line Grown(const Line& line, const Line& whole)
{
  const int more = std::min(MaximumTaps * line.GetLength(), whole.GetLength()) - line.GetLength();
  const int before = std::min(more, line.First - whole.First);
  return { line.First - before, line.Last + more - before };
}
}

struct vtkMorphologyPass::Step
{
  std::vector<Row> Rows; ///< or, if there are none:
  int Axis = 0;
  int Taps = 0;
  std::array<int, 4> Offsets{};
  bool AddsToRows = false;
};

vtkMorphologyPass::Element vtkMorphologyPass::Element::Mirrored() const
{
  Element mirrored{ -this->Last, -this->First, this->Rows };
  for (Row& row : mirrored.Rows)
  {
    row = { -row.Y, -row.Z, -row.Last, -row.First };
  }
  return mirrored;
}

vtkMorphologyPass::Element vtkMorphologyPass::Element::Repeated(int times) const
{
  return { times * this->First, times * this->Last, {} };
}

vtkMorphologyPass::vtkMorphologyPass(vtkVoxelGL::Context context, Border border)
  : Context(std::move(context))
  , Beyond(border)
{
}

std::vector<vtkMorphologyPass::Step> vtkMorphologyPass::GetSteps(const Element& element) const
{
  std::vector<Step> steps;
  for (std::size_t i = 0; i < element.Rows.size(); i += MaximumRows)
  {
    Step step;
    const auto begin = element.Rows.begin() + static_cast<std::ptrdiff_t>(i);
    const auto left = element.Rows.size() - i;
    step.Rows.assign(begin, begin + static_cast<std::ptrdiff_t>(std::min(left, MaximumRows)));
    step.AddsToRows = i > 0;
    steps.push_back(std::move(step));
  }
  for (int axis = 0; axis < 3 && element.Rows.empty(); ++axis)
  {
    const Line whole{ element.First[axis], element.Last[axis] };
    Line line{ 0, 0 };
    if (axis == 0 && whole.GetLength() > 1)
    {
      constexpr int longest = Element::LongestRow;
      line = { std::max(whole.First, -longest), std::min(whole.Last, longest) };
      Step step;
      step.Rows = { { 0, 0, line.First, line.Last } };
      steps.push_back(std::move(step));
    }
    while (line.GetLength() < whole.GetLength())
    {
      const Line grown = Grown(line, whole);
      Step step;
      step.Axis = axis;
      step.Taps = (grown.GetLength() + line.GetLength() - 1) / line.GetLength();
      for (int tap = 0; tap < step.Taps; ++tap)
      {
        // The last one overlaps the one before where the lengths don't go up.
        step.Offsets[tap] =
          std::min(grown.First + tap * line.GetLength() - line.First, grown.Last - line.Last);
      }
      steps.push_back(step);
      line = grown;
    }
  }
  if (steps.empty())
  {
    Step copy;
    copy.Taps = 1;
    steps.push_back(copy);
  }
  return steps;
}

void vtkMorphologyPass::RunStep(const Step& step, Operation operation, vtkSlicemap* source,
  vtkSlicemap* partial, vtkSlicemap* target) const
{
  Program::Defines defines;
  if (step.Rows.empty())
  {
    defines["AXIS"] = std::to_string(step.Axis);
    defines["TAPS"] = std::to_string(step.Taps);
  }
  else
  {
    defines["ROWS"] = "1";
  }
  if (step.AddsToRows)
  {
    defines["HAS_PARTIAL"] = "1";
  }
  const bool erodes = operation == Operation::Erode;
  const bool borderActs = this->Beyond == (erodes ? Border::Empty : Border::Full);
  const auto sourceTexture = vtkSlicemapTexture(source);
  const auto partialTexture = vtkSlicemapTexture(step.AddsToRows ? partial : source);
  const glm::ivec3 n = source->GetGrid().GetDimensions();
  const vtkSlicemapQuadKernel kernel("vtkMorphology", vtkMorphologyGLSL, std::move(defines));
  kernel.Run(this->Context, target,
    [&](Program& program)
    {
      sourceTexture.Bind(SourceUnit);
      program.Set("Source", int(SourceUnit));
      program.Set("Size", std::array<int, 3>{ n.x, n.y, n.z });
      program.Set(
        "QuadsPerRow", static_cast<unsigned int>(source->GetWordsPerRow() / WordsPerQuad));
      program.Set("Inverted", erodes ? FullWord : 0u);
      program.Set("Border", borderActs ? FullWord : 0u);
      if (step.AddsToRows)
      {
        partialTexture.Bind(PartialUnit);
        program.Set("Partial", int(PartialUnit));
      }
      if (step.Rows.empty())
      {
        program.Set("Offsets", step.Offsets);
        return;
      }
      program.Set("NumberOfRows", static_cast<int>(step.Rows.size()));
      for (std::size_t i = 0; i < step.Rows.size(); ++i)
      {
        const Row& row = step.Rows[i];
        const std::string name = "Rows[" + std::to_string(i) + "]";
        program.Set(name.c_str(), std::array<int, 4>{ row.Y, row.Z, row.First, row.Last });
      }
    });
}

void vtkMorphologyPass::Run(
  Operation operation, const Element& element, vtkSlicemap* source, vtkSlicemap* result) const
{
  const auto steps = this->GetSteps(element);
  vtkNew<vtkSlicemap> other;
  other->SetContext(result->GetContext());
  const auto allocate = [&](vtkSlicemap* slicemap)
  {
    if (!slicemap->Allocate(source->GetGrid()))
    {
      throw std::runtime_error(
        "There is no memory on the GPU for dilated or eroded voxels. Use fewer of them.");
    }
  };
  // Each step reads what the one before has written, or, where rows add up, the source.
  vtkSlicemap* last = nullptr;
  for (const Step& step : steps)
  {
    vtkSlicemap* target = last == result ? other.Get() : result;
    allocate(target);
    this->RunStep(step, operation, step.Rows.empty() && last ? last : source, last, target);
    last = target;
  }
  if (last != result)
  {
    result->Swap(other);
  }
}
