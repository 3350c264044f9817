// Fuzz target: what vtkvoxelize checks before VTK's reader sees a file, given any bytes. Compiled
// once for each check, whose header is CHECK_HEADER, and whose function is CHECK_FUNCTION.

#include "FuzzInput.h"

#include CHECK_HEADER

#include <Failure.h>

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  if (size == 0)
  {
    return 0; // refused before
  }
  const FuzzFile file(bytes, size);
  try
  {
    CHECK_FUNCTION(file.GetName());
  }
  catch (const Failure& failure)
  {
    FuzzRequire(failure.GetCode() == ExitCode::Input, "a failure of input");
    FuzzRequire(*failure.what() != '\0', "a failure says what is wrong");
  }
  return 0;
}
