// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Report.h
 * What --info prints.
 */

#ifndef Report_h
#define Report_h

#include "vtkType.h"

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

class VoxelPipeline;

/// Lines of a name and a value, the values in one column.
class Report
{
public:
  /// Runs a task and adds how long that took.
  template <typename Task>
  void Time(const std::string& name, const Task& task)
  {
    const auto start = std::chrono::steady_clock::now();
    task();
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    this->AddTime(name, time.count());
  }

  /// Adds what a pipeline that has run made of its meshes. Slabs leave their number of
  /// filled voxels behind, and no more.
  void Describe(const VoxelPipeline& pipeline, std::optional<vtkIdType> filledInSlabs);

  void Print() const;

private:
  void Add(const std::string& name, const std::string& value);
  void AddTime(const std::string& name, double milliseconds);

  std::vector<std::pair<std::string, std::string>> Facts;
  std::vector<std::pair<std::string, std::string>> Times;
};

#endif
