// Fuzz target: expressions of vtkVoxelBoolean, given any text. Whatever is understood is in order:
// operands are inputs or steps before, and each step is used once.

#include "FuzzInput.h"

#include <vtkSlicemapExpression.h>

#include <stdexcept>

namespace
{
using Operand = vtkSlicemapExpression::Operand;

const std::vector<std::string> Names = { "A", "B", "mask_2" };

void Use(const Operand& operand, std::vector<bool>& isFree)
{
  if (operand.From == Operand::Kind::Input)
  {
    FuzzRequire(operand.Index >= 0 && operand.Index < static_cast<int>(Names.size()),
      "there is such an input");
    return;
  }
  FuzzRequire(
    operand.Index >= 0 && operand.Index < static_cast<int>(isFree.size()), "the step comes before");
  FuzzRequire(isFree[operand.Index], "a step is used once");
  isFree[operand.Index] = false;
}

void Check(const vtkSlicemapExpression& expression)
{
  std::vector<bool> isFree;
  for (const vtkSlicemapExpression::Step& step : expression.GetSteps())
  {
    Use(step.Left, isFree);
    if (step.Operator != '~')
    {
      Use(step.Right, isFree);
    }
    isFree.push_back(true);
  }
  Use(expression.GetResult(), isFree);
  for (const bool isLeft : isFree)
  {
    FuzzRequire(!isLeft, "each step is used");
  }
}
}

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  vtkSlicemapExpression::IsName(text);
  try
  {
    Check(vtkSlicemapExpression::Parse(text, Names));
  }
  catch (const std::runtime_error& error)
  {
    FuzzRequire(std::string(error.what()).find(" at column ") != std::string::npos, "a column");
  }
  return 0;
}
