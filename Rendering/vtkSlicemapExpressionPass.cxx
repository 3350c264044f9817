// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSlicemapExpressionPass.h"

#include "vtkSlicemap.h"
#include "vtkSlicemapExpression.h"
#include "vtkSlicemapKernel.h"
#include "vtkSlicemapQuadKernel.h"
#include "vtkSmartPointer.h"
#include "vtkVoxelGLState.h"
#include "vtkVoxelGrid.h"

#include "vtkSlicemapExpressionGLSL.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

namespace
{
using Operand = vtkSlicemapExpression::Operand;
using Step = vtkSlicemapExpression::Step;

constexpr int WordsPerQuad = 4;

/// Sources that one program reads: every OpenGL has 16 texture units, but only these are restored.
constexpr std::size_t SourcesAtOnce = vtkVoxelGLState::Units;

/// One run: the sources of its passes are the inputs and the steps that have become slicemaps.
class Evaluation
{
public:
  Evaluation(const vtkSlicemapExpression& expression, const vtkVoxelGL::Context& context,
    const std::vector<vtkSlicemap*>& inputs)
    : Expression(expression)
    , Context(context)
    , Inputs(inputs)
    , Intermediates(expression.GetSteps().size())
    , SourcesOfSteps(expression.GetSteps().size())
  {
  }

  void Run(vtkSlicemap* target)
  {
    const int steps = static_cast<int>(this->Expression.GetSteps().size());
    for (int i = 0; i < steps; ++i)
    {
      const Step& step = this->Expression.GetSteps()[i];
      // The larger side goes first, and the other one if need be.
      while (this->Union(step).size() > SourcesAtOnce)
      {
        const bool left = this->GetSources(step.Left).size() >= this->GetSources(step.Right).size();
        this->MakeIntermediate(left ? step.Left.Index : step.Right.Index, target);
      }
      this->SourcesOfSteps[i] = this->Union(step);
    }
    this->Compute(this->Expression.GetResult(), target);
  }

private:
  using Source = std::pair<Operand::Kind, int>;
  using Sources = std::set<Source>;

  Sources GetSources(const Operand& operand) const
  {
    const bool isStep = operand.From == Operand::Kind::Step;
    return isStep && !this->Intermediates[operand.Index]
      ? this->SourcesOfSteps[operand.Index]
      : Sources{ { operand.From, operand.Index } };
  }

  Sources Union(const Step& step) const
  {
    Sources sources = this->GetSources(step.Left);
    sources.merge(this->GetSources(step.Right));
    return sources;
  }

  vtkSlicemap* GetSlicemap(const Source& source) const
  {
    return source.first == Operand::Kind::Input ? this->Inputs[source.second]
                                                : this->Intermediates[source.second].Get();
  }

  void MakeIntermediate(int step, vtkSlicemap* target)
  {
    auto slicemap = vtkSmartPointer<vtkSlicemap>::New();
    slicemap->SetContext(target->GetContext());
    if (!slicemap->Allocate(target->GetGrid()))
    {
      throw std::runtime_error("There is no memory on the GPU for a part of the expression. Join "
                               "fewer inputs at once, or use fewer voxels.");
    }
    this->Compute({ Operand::Kind::Step, step }, slicemap);
    this->Intermediates[step] = slicemap;
  }

  /// Steps that are worked out along with `result`, in their order.
  std::vector<int> GetSteps(const Operand& result) const
  {
    std::vector<int> steps;
    std::set<int> needed;
    const auto need = [&](const Operand& operand)
    {
      if (operand.From == Operand::Kind::Step && !this->Intermediates[operand.Index])
      {
        needed.insert(operand.Index);
      }
    };
    need(result);
    while (!needed.empty())
    {
      const int last = *needed.rbegin();
      needed.erase(last);
      steps.push_back(last);
      need(this->Expression.GetSteps()[last].Left);
      need(this->Expression.GetSteps()[last].Right);
    }
    std::reverse(steps.begin(), steps.end());
    return steps;
  }

  void Compute(const Operand& result, vtkSlicemap* target)
  {
    const Sources sources = this->GetSources(result);
    std::map<Source, std::string> names;
    std::map<Source, bool> paddingBits;
    std::string text;
    std::vector<vtkVoxelGL::Texture> textures;
    for (const Source& source : sources)
    {
      const std::string unit = std::to_string(textures.size());
      names[source] = "source" + unit;
      paddingBits[source] = false;
      text += "uvec4 source" + unit + " = INPUT(" + unit + "); ";
      textures.push_back(vtkSlicemapTexture(this->GetSlicemap(source)));
    }
    for (const int i : this->GetSteps(result))
    {
      const Step& step = this->Expression.GetSteps()[i];
      const Source left{ step.Left.From, step.Left.Index };
      const Source right{ step.Right.From, step.Right.Index };
      const Source self{ Operand::Kind::Step, i };
      const bool a = paddingBits[left];
      const bool b = paddingBits[right];
      std::string value;
      switch (step.Operator)
      {
        case '~':
          value = "~" + names[left];
          paddingBits[self] = !a;
          break;
        case '-':
          value = names[left] + " & ~" + names[right];
          paddingBits[self] = a && !b;
          break;
        default:
          value = names[left] + " " + step.Operator + " " + names[right];
          paddingBits[self] = step.Operator == '|' ? a || b
            : step.Operator == '&'                 ? a && b
                                                   : a != b;
      }
      names[self] = "step" + std::to_string(i);
      text += "uvec4 " + names[self] + " = " + value + "; ";
    }

    vtkVoxelGL::Program::Defines defines{ { "INPUTS", std::to_string(textures.size()) },
      { "STEPS", text }, { "RESULT", names[{ result.From, result.Index }] } };
    if (paddingBits[{ result.From, result.Index }])
    {
      defines["SETS_PADDING"] = "1";
    }
    const vtkSlicemapQuadKernel kernel(
      "vtkSlicemapExpression", vtkSlicemapExpressionGLSL, std::move(defines));
    kernel.Run(this->Context, target,
      [&](vtkVoxelGL::Program& program)
      {
        for (int unit = 0; unit < static_cast<int>(textures.size()); ++unit)
        {
          textures[unit].Bind(unit);
          program.Set(("Inputs[" + std::to_string(unit) + "]").c_str(), unit);
        }
        program.Set(
          "QuadsPerRow", static_cast<unsigned int>(target->GetWordsPerRow() / WordsPerQuad));
        program.Set("Columns", target->GetGrid().GetDimensions().x);
      });
    for (const Source& source : sources)
    {
      if (source.first == Operand::Kind::Step)
      {
        this->Intermediates[source.second]->ReleaseGraphicsResources();
      }
    }
  }

  const vtkSlicemapExpression& Expression;
  const vtkVoxelGL::Context& Context;
  const std::vector<vtkSlicemap*>& Inputs;
  std::vector<vtkSmartPointer<vtkSlicemap>> Intermediates; // by step, where it is one
  std::vector<Sources> SourcesOfSteps;
};
}

void vtkSlicemapExpressionPass::Run(const vtkSlicemapExpression& expression,
  const vtkVoxelGL::Context& context, const std::vector<vtkSlicemap*>& inputs, vtkSlicemap* target)
{
  Evaluation(expression, context, inputs).Run(target);
}
