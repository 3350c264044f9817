// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSlicemapExpression.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace
{
constexpr int MaximumDepth = 200;
constexpr std::size_t MaximumSteps = 2000;

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
