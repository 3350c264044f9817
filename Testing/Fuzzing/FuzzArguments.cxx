// Fuzz target: values of the options of vtkvoxelize, given any text. Whatever is taken keeps what
// the header promises; everything else is a failure of usage.

#include "FuzzInput.h"

#include <Argument.h>
#include <Failure.h>

#include <cmath>

namespace
{
template <typename Read>
void Try(const Read& read)
{
  try
  {
    read();
  }
  catch (const Failure& failure)
  {
    FuzzRequire(failure.GetCode() == ExitCode::Usage, "a failure of usage");
    FuzzRequire(*failure.what() != '\0', "a failure says what is wrong");
  }
}
}

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  // Words of a command line end at a zero.
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  const Argument argument("--option", text.substr(0, text.find('\0')));
  Try([&] { FuzzRequire(!argument.AsFile().empty(), "a name"); });
  Try(
    [&]
    {
      const int value = argument.AsInteger(-3, 1000);
      FuzzRequire(value >= -3 && value <= 1000, "an integer within its limits");
    });
  Try(
    [&]
    {
      const double value = argument.AsReal(0.5);
      FuzzRequire(std::isfinite(value) && value >= 0.5, "a number within its limits");
    });
  Try(
    [&]
    {
      const auto range = argument.AsRange();
      FuzzRequire(range[0] <= range[1], "a range");
    });
  Try(
    [&]
    {
      for (const std::string& name : argument.AsNames())
      {
        FuzzRequire(!name.empty(), "a name");
      }
    });
  Try([&] { argument.AsAxes(); });
  Try(
    [&]
    {
      for (const int dimension : argument.AsDimensions())
      {
        FuzzRequire(dimension > 0, "a dimension");
      }
    });
  Try(
    [&]
    {
      const auto bounds = argument.AsBounds();
      for (const int i : { 0, 2, 4 })
      {
        FuzzRequire(bounds[i] < bounds[i + 1], "a box");
      }
    });
  return 0;
}
