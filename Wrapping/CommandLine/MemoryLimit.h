// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file MemoryLimit.h
 * Keeps a damaged file from taking all the memory of the machine.
 */

#ifndef MemoryLimit_h
#define MemoryLimit_h

#include <memory>
#include <string>

/**
 * While it lives, the program gets no more memory than the best packed file of this size could
 * need; std::bad_alloc is thrown beyond. Without effect where the system has no such limit.
 */
class MemoryLimit
{
public:
  explicit MemoryLimit(const std::string& file);
  ~MemoryLimit();
  MemoryLimit(const MemoryLimit&) = delete;
  void operator=(const MemoryLimit&) = delete;

private:
  struct Former;
  std::unique_ptr<Former> Restored;
};

#endif
