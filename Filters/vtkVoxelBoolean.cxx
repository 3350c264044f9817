// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelBoolean.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapExpression.h"
#include "vtkSlicemapExpressionPass.h"
#include "vtkVoxelContext.h"
#include "vtkVoxelContextScope.h"
#include "vtkVoxelGrid.h"

#include <algorithm>
#include <stdexcept>

namespace
{
/// A, B, ... Z, AA, AB, ...
std::string GetDefaultName(int i)
{
  constexpr int letters = 26;
  std::string name;
  for (int rest = i + 1; rest > 0; rest = (rest - 1) / letters)
  {
    name.insert(name.begin(), static_cast<char>('A' + (rest - 1) % letters));
  }
  return name;
}
}

struct vtkVoxelBoolean::Internals
{
  vtkSlicemapExpression Expression;
};

vtkStandardNewMacro(vtkVoxelBoolean);

vtkVoxelBoolean::vtkVoxelBoolean()
  : Compiled(std::make_unique<Internals>())
{
}

vtkVoxelBoolean::~vtkVoxelBoolean()
{
  this->SetExpression(nullptr);
}

void vtkVoxelBoolean::SetInputName(int i, const char* name)
{
  const std::string text = name ? name : "";
  if (i < 0 || (!text.empty() && !vtkSlicemapExpression::IsName(text)))
  {
    vtkErrorMacro("Input " << i << " can't be named \"" << text
                           << "\". Inputs are numbered from 0, and names have letters, digits and "
                              "underscores, but no digit first.");
    return;
  }
  const auto known = this->InputNames.find(i);
  const bool same = known == this->InputNames.end() ? text.empty() : known->second == text;
  if (same)
  {
    return;
  }
  if (text.empty())
  {
    this->InputNames.erase(known);
  }
  else
  {
    this->InputNames[i] = text;
  }
  this->Modified();
}

const char* vtkVoxelBoolean::GetInputName(int i)
{
  const auto known = this->InputNames.find(i);
  if (known != this->InputNames.end())
  {
    return known->second.c_str();
  }
  this->DefaultName = GetDefaultName(i);
  return this->DefaultName.c_str();
}

std::vector<std::string> vtkVoxelBoolean::GetInputNames(std::size_t count)
{
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::string name = this->GetInputName(static_cast<int>(i));
    if (std::find(names.begin(), names.end(), name) != names.end())
    {
      throw std::runtime_error(
        "Two inputs are named \"" + name + "\". Give each a name of its own by SetInputName.");
    }
    names.push_back(name);
  }
  return names;
}

int vtkVoxelBoolean::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return this->Superclass::FillInputPortInformation(port, info);
}

void vtkVoxelBoolean::CheckGrids(const std::vector<vtkVoxelGrid>& inputs)
{
  for (std::size_t i = 1; i < inputs.size(); ++i)
  {
    if (!inputs[i].IsSameAs(inputs[0]))
    {
      throw std::runtime_error("Input " + std::to_string(i) +
        " is not on the grid of input 0: " + inputs[i].Describe() + " there, " +
        inputs[0].Describe() + " here. Voxelize both on one by SetReferenceImage, or resample it.");
    }
  }
}

void vtkVoxelBoolean::CheckInputs(const std::vector<vtkVoxelGrid>& inputs)
{
  const auto count = static_cast<int>(inputs.size());
  if (this->Expression && *this->Expression)
  {
    this->Compiled->Expression =
      vtkSlicemapExpression::Parse(this->Expression, this->GetInputNames(inputs.size()));
  }
  else if (this->Operation == OPERATION_COMPLEMENT)
  {
    if (count != 1)
    {
      throw std::runtime_error("Complement takes one input, but there are " +
        std::to_string(count) + ". Set an expression such as ~(A | B).");
    }
    this->Compiled->Expression = vtkSlicemapExpression::Complement();
  }
  else
  {
    constexpr char operators[] = { '|', '&', '-', '^' };
    this->Compiled->Expression = vtkSlicemapExpression::Join(operators[this->Operation], count);
  }
  this->CheckGrids(inputs);
}

bool vtkVoxelBoolean::Process(const std::vector<vtkSlicemap*>& inputs, vtkSlicemap* output)
{
  if (!this->ReportProgress(0.0) || !output->Allocate(inputs[0]->GetGrid()))
  {
    return false;
  }
  vtkSlicemapExpressionPass::Run(
    this->Compiled->Expression, this->GetContext()->GetRecord(), inputs, output);
  return this->ReportProgress(1.0);
}

double vtkVoxelBoolean::GetVolume()
{
  vtkSlicemap* slicemap = this->GetSlicemap();
  return slicemap ? slicemap->GetNumberOfFilledVoxels() * slicemap->GetGrid().GetVoxelVolume()
                  : -1.0;
}

double vtkVoxelBoolean::GetIntersectionVolume()
{
  if (!this->GetSlicemap())
  {
    return -1.0;
  }
  try
  {
    vtkVoxelContext::Scope scope(this->GetContext());
    if (!scope)
    {
      throw std::runtime_error(this->GetContext()->GetErrorMessage());
    }
    const auto inputs = this->GetInputSlicemaps();
    std::vector<vtkVoxelGrid> grids;
    for (vtkSlicemap* input : inputs)
    {
      grids.push_back(input->GetGrid());
    }
    this->CheckGrids(grids);
    vtkNew<vtkSlicemap> common;
    common->SetContext(this->GetContext());
    if (!common->Allocate(grids[0]))
    {
      return -1.0;
    }
    vtkSlicemapExpressionPass::Run(
      vtkSlicemapExpression::Join('&', static_cast<int>(inputs.size())),
      this->GetContext()->GetRecord(), inputs, common);
    return common->GetNumberOfFilledVoxels() * grids[0].GetVoxelVolume();
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< error.what());
    return -1.0;
  }
}

bool vtkVoxelBoolean::IsEmpty()
{
  return this->GetNumberOfFilledVoxels() <= 0;
}

void vtkVoxelBoolean::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const operations[] = { "Union", "Intersection", "Difference", "Xor", "Complement" };
  os << indent << "Operation: " << operations[this->Operation] << "\n";
  os << indent << "Expression: " << (this->Expression ? this->Expression : "(none)") << "\n";
  os << indent << "InputNames:";
  for (const auto& [i, name] : this->InputNames)
  {
    os << " " << i << "=" << name;
  }
  os << "\n";
}
