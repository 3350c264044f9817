// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelMemory.h"

#include <vtksys/SystemInformation.hxx>

#include <cmath>
#include <stdexcept>

namespace
{
constexpr double BytesPerMebibyte = 1048576.0;

/// Ask the system for its free memory only for outputs that could matter.
constexpr std::int64_t CarelessBytes = std::int64_t(1) << 28;

std::int64_t GetAllowedBytes(std::int64_t limit)
{
  return limit > 0 ? limit : vtkVoxelMemory::GetFreeBytes();
}
}

std::int64_t vtkVoxelMemory::GetFreeBytes()
{
  vtksys::SystemInformation system;
  system.RunMemoryCheck();
  return static_cast<std::int64_t>(system.GetAvailablePhysicalMemory()) * 1048576;
}

bool vtkVoxelMemory::Fits(std::int64_t bytes, std::int64_t limit)
{
  return (limit == 0 && bytes < CarelessBytes) || bytes <= GetAllowedBytes(limit);
}

void vtkVoxelMemory::CheckBytes(
  std::int64_t bytes, std::int64_t limit, const std::string& what, const std::string& remedy)
{
  if (!Fits(bytes, limit))
  {
    const std::int64_t allowed = GetAllowedBytes(limit);
    throw std::runtime_error("The " + what + " takes " +
      std::to_string(std::llround(bytes / BytesPerMebibyte)) + " MiB, but " +
      std::to_string(std::llround(allowed / BytesPerMebibyte)) +
      (limit > 0 ? " MiB are allowed by MemoryLimit. " : " MiB are free. ") + remedy);
  }
}
