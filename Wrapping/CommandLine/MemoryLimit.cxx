// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MemoryLimit.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>

struct MemoryLimit::Former
{
  rlimit Limit;
};

namespace
{
/// Pages of address space in use are the first number of this file.
rlim_t GetUsedBytes()
{
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}
}

MemoryLimit::MemoryLimit(const std::string& file)
{
  constexpr rlim_t base = rlim_t(1) << 30;
  constexpr rlim_t perByte = 1100; // zlib packs a thousand bytes into one, at best
  Former former{};
  const rlim_t used = GetUsedBytes();
  if (used == 0 || getrlimit(RLIMIT_AS, &former.Limit) != 0)
  {
    return;
  }
  rlimit limit = former.Limit;
  limit.rlim_cur =
    std::min<rlim_t>(limit.rlim_cur, used + base + perByte * std::filesystem::file_size(file));
  if (setrlimit(RLIMIT_AS, &limit) == 0)
  {
    this->Restored = std::make_unique<Former>(former);
  }
}

MemoryLimit::~MemoryLimit()
{
  if (this->Restored)
  {
    setrlimit(RLIMIT_AS, &this->Restored->Limit);
  }
}
#else
struct MemoryLimit::Former
{
};

MemoryLimit::MemoryLimit(const std::string&) {}

MemoryLimit::~MemoryLimit() = default;
#endif
