/**
 * @file   FuzzInput.h
 * @brief  What the fuzz targets share: bytes as a file in memory, and a stop for what must not be.
 */
#ifndef FuzzInput_h
#define FuzzInput_h

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

/// Called by libFuzzer for each input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

/// Ends the process, which libFuzzer reports along with the input, unless the condition holds.
inline void FuzzRequire(bool holds, const std::string& what)
{
  if (!holds)
  {
    std::cerr << "This must hold: " << what << "\n";
    std::abort();
  }
}

/// A file that only memory has, under a name that readers can open, while this lives.
class FuzzFile
{
public:
  FuzzFile(const std::uint8_t* bytes, std::size_t size)
    : Descriptor(memfd_create("fuzz", MFD_CLOEXEC))
    , Name("/proc/self/fd/" + std::to_string(this->Descriptor))
  {
    FuzzRequire(this->Descriptor >= 0, "there is room for a file in memory");
    const ssize_t written = write(this->Descriptor, bytes, size);
    FuzzRequire(written == static_cast<ssize_t>(size), "the file in memory is whole");
  }
  ~FuzzFile() { close(this->Descriptor); }
  FuzzFile(const FuzzFile&) = delete;
  FuzzFile& operator=(const FuzzFile&) = delete;

  const std::string& GetName() const { return this->Name; }

private:
  int Descriptor;
  std::string Name;
};

#endif
