// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSlicemapExpression.h"

#include "vtkSlicemap.h"
#include "vtkSlicemapKernel.h"
#include "vtkSlicemapQuadKernel.h"
#include "vtkSmartPointer.h"
#include "vtkVoxelGLState.h"
#include "vtkVoxelGrid.h"

#include "vtkSlicemapExpressionGLSL.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <stdexcept>

namespace
{
constexpr int MaximumDepth = 200;
constexpr std::size_t MaximumSteps = 2000;
constexpr int WordsPerQuad = 4;

/// From the loosest to the tightest.
constexpr char BinaryOperators[] = { '|', '^', '&', '-' };
constexpr int NumberOfBinaryOperators = 4;

bool IsNameStart(char c)
{
  return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
}

bool IsNamePart(char c)
{
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

std::string Quoted(const std::string& text)
{
  return "\"" + text + "\"";
}

/// Sources that one program reads: every OpenGL has 16 texture units, but only these are restored.
constexpr std::size_t SourcesAtOnce = vtkVoxelGLState::Units;
}

class vtkSlicemapExpression::Parser
{
public:
  Parser(const std::string& text, const std::vector<std::string>& names)
    : Text(text)
    , Names(names)
  {
  }

  vtkSlicemapExpression Parse()
  {
    this->Expression.Result = this->ParseBinary(0);
    if (this->Peek() == ')')
    {
      this->Fail("\")\" has no \"(\" before it", this->Position);
    }
    if (this->Peek())
    {
      this->Fail("an operator is missing here: one of | & - ^", this->Position);
    }
    return this->Expression;
  }

private:
  [[noreturn]] void Fail(const std::string& what, std::size_t column) const
  {
    std::string line = this->Text;
    std::replace_if(
      line.begin(), line.end(), [](char c) { return std::isspace(static_cast<unsigned char>(c)); },
      ' ');
    throw std::runtime_error("The expression is wrong at column " + std::to_string(column + 1) +
      ": " + what + ".\n  " + line + "\n  " + std::string(column, ' ') + "^");
  }

  /// The next character that is no space; 0 at the end.
  char Peek()
  {
    while (this->Position < this->Text.size() &&
      std::isspace(static_cast<unsigned char>(this->Text[this->Position])))
    {
      ++this->Position;
    }
    return this->Position < this->Text.size() ? this->Text[this->Position] : '\0';
  }

  Operand Append(char operation, Operand left, Operand right, std::size_t column)
  {
    if (this->Expression.Steps.size() == MaximumSteps)
    {
      this->Fail("it has more than " + std::to_string(MaximumSteps) + " operators", column);
    }
    return this->Expression.Append(operation, left, right);
  }

  Operand ParseBinary(int level)
  {
    if (level == NumberOfBinaryOperators)
    {
      return this->ParseUnary();
    }
    Operand left = this->ParseBinary(level + 1);
    while (this->Peek() == BinaryOperators[level])
    {
      const std::size_t column = this->Position++;
      const Operand right = this->ParseBinary(level + 1);
      left = this->Append(BinaryOperators[level], left, right, column);
    }
    return left;
  }

  Operand ParseUnary()
  {
    const char next = this->Peek();
    const std::size_t column = this->Position;
    if (IsNameStart(next))
    {
      return this->ParseName();
    }
    if (next != '~' && next != '(')
    {
      this->Fail("the name of an input is missing here", column);
    }
    if (++this->Depth > MaximumDepth)
    {
      this->Fail("it is nested too deep", column);
    }
    ++this->Position;
    Operand operand;
    if (next == '~')
    {
      operand = this->ParseUnary();
      operand = this->Append('~', operand, operand, column);
    }
    else
    {
      operand = this->ParseBinary(0);
      if (!this->Peek())
      {
        this->Fail("this \"(\" is never closed", column);
      }
      if (this->Peek() != ')')
      {
        this->Fail("an operator or \")\" is missing here", this->Position);
      }
      ++this->Position;
    }
    --this->Depth;
    return operand;
  }

  Operand ParseName()
  {
    const std::size_t begin = this->Position;
    while (this->Position < this->Text.size() && IsNamePart(this->Text[this->Position]))
    {
      ++this->Position;
    }
    const std::string name = this->Text.substr(begin, this->Position - begin);
    const auto found = std::find(this->Names.begin(), this->Names.end(), name);
    if (found == this->Names.end())
    {
      std::string known;
      for (const std::string& other : this->Names)
      {
        known += (known.empty() ? "" : ", ") + other;
      }
      this->Fail("there is no input " + Quoted(name) + ", only " + known, begin);
    }
    return { Operand::Kind::Input, static_cast<int>(found - this->Names.begin()) };
  }

  const std::string& Text;
  const std::vector<std::string>& Names;
  std::size_t Position = 0;
  int Depth = 0;
  vtkSlicemapExpression Expression;
};

/// One run: the sources of its passes are the inputs and the steps that have become slicemaps.
class vtkSlicemapExpression::Evaluation
{
public:
  Evaluation(const vtkSlicemapExpression& expression, const vtkVoxelGL::Context& context,
    const std::vector<vtkSlicemap*>& inputs)
    : Expression(expression)
    , Context(context)
    , Inputs(inputs)
    , Intermediates(expression.Steps.size())
    , SourcesOfSteps(expression.Steps.size())
  {
  }

  void Run(vtkSlicemap* target)
  {
    const int steps = static_cast<int>(this->Expression.Steps.size());
    for (int i = 0; i < steps; ++i)
    {
      const Step& step = this->Expression.Steps[i];
      // The larger side goes first, and the other one if need be.
      while (this->Union(step).size() > SourcesAtOnce)
      {
        const bool left = this->GetSources(step.Left).size() >= this->GetSources(step.Right).size();
        this->MakeIntermediate(left ? step.Left.Index : step.Right.Index, target);
      }
      this->SourcesOfSteps[i] = this->Union(step);
    }
    this->Compute(this->Expression.Result, target);
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
      need(this->Expression.Steps[last].Left);
      need(this->Expression.Steps[last].Right);
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
      const Step& step = this->Expression.Steps[i];
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

bool vtkSlicemapExpression::IsName(const std::string& text)
{
  return !text.empty() && IsNameStart(text[0]) && std::all_of(text.begin(), text.end(), IsNamePart);
}

vtkSlicemapExpression vtkSlicemapExpression::Parse(
  const std::string& text, const std::vector<std::string>& names)
{
  return Parser(text, names).Parse();
}

vtkSlicemapExpression::Operand vtkSlicemapExpression::Append(
  char operation, Operand left, Operand right)
{
  this->Steps.push_back({ operation, left, right });
  return { Operand::Kind::Step, static_cast<int>(this->Steps.size()) - 1 };
}

vtkSlicemapExpression vtkSlicemapExpression::Join(char operation, int count)
{
  vtkSlicemapExpression expression;
  for (int i = 1; i < count; ++i)
  {
    expression.Result =
      expression.Append(operation, expression.Result, { Operand::Kind::Input, i });
  }
  return expression;
}

vtkSlicemapExpression vtkSlicemapExpression::Complement()
{
  vtkSlicemapExpression expression;
  expression.Result = expression.Append('~', expression.Result, expression.Result);
  return expression;
}

void vtkSlicemapExpression::Evaluate(const vtkVoxelGL::Context& context,
  const std::vector<vtkSlicemap*>& inputs, vtkSlicemap* target) const
{
  Evaluation(*this, context, inputs).Run(target);
}
