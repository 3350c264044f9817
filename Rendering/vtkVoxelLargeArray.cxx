// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelLargeArray.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace
{
/// Asks for huge pages where a range has whole ones.
void PreferHugePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes)
{
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::uintptr_t page = std::uintptr_t(1) << 21;
  const std::uintptr_t before = (page - reinterpret_cast<std::uintptr_t>(memory) % page) % page;
  if (bytes >= before + page)
  {
    madvise(static_cast<char*>(memory) + before, (bytes - before) / page * page, MADV_HUGEPAGE);
  }
#endif
}
}

void* vtkVoxelAllocate(std::int64_t bytes, vtkVoxelInitially content)
{
  const auto size = static_cast<std::size_t>(std::max<std::int64_t>(1, bytes));
  void* memory = content == vtkVoxelInitially::Zero ? std::calloc(size, 1) : std::malloc(size);
  if (memory)
  {
    PreferHugePages(memory, size);
  }
  return memory;
}

void vtkVoxelClear(void* memory, std::int64_t bytes)
{
  constexpr std::int64_t block = std::int64_t(1) << 21;
  auto* first = static_cast<unsigned char*>(memory);
  vtkSMPTools::For(0, (bytes + block - 1) / block,
    [&](vtkIdType begin, vtkIdType end)
    {
      const std::int64_t offset = begin * block;
      std::memset(first + offset, 0, std::min<std::int64_t>(bytes, end * block) - offset);
    });
}
