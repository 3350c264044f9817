// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkSlicemapExpression.h
 * Private header: Boolean expressions of slicemaps on one grid, as steps in their order.
 */

#ifndef vtkSlicemapExpression_h
#define vtkSlicemapExpression_h

#include <string>
#include <vector>

class vtkSlicemapExpression
{
public:
  /**
   * An expression of names by the operators of Python's sets, in the order of precedence: `~`
   * complement, `-` difference, `&` intersection, `^` symmetric difference, `|` union; operators of
   * one kind from left to right; parentheses. Input i has the i-th name. Throws std::runtime_error
   * that points at the column where the text is wrong.
   */
  static vtkSlicemapExpression Parse(
    const std::string& text, const std::vector<std::string>& names);

  /**
   * Whether the text can be a name: letters, digits and underscores, no digit first.
   */
  static bool IsName(const std::string& text);

  /**
   * All of `count` inputs, one at least, joined by one of the operators `|`, `&`, `^`, `-`.
   */
  static vtkSlicemapExpression Join(char operation, int count);

  /**
   * The complement of one input.
   */
  static vtkSlicemapExpression Complement();

  /// Either the result of a step or an input.
  struct Operand
  {
    enum class Kind
    {
      Input,
      Step
    };
    Kind From;
    int Index;
  };

  struct Step
  {
    char Operator; ///< one of | & ^ - and ~, which has no right operand
    Operand Left;
    Operand Right;
  };

  /// A step's operands precede it, and each is used by one step.
  const std::vector<Step>& GetSteps() const { return this->Steps; }
  const Operand& GetResult() const { return this->Result; }

private:
  class Parser;

  Operand Append(char operation, Operand left, Operand right);

  std::vector<Step> Steps;
  Operand Result{ Operand::Kind::Input, 0 };
};

#endif
// VTK-HeaderTest-Exclude: vtkSlicemapExpression.h
