// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Terminal.h
 * The standard error of the program: errors, warnings, and a progress bar where somebody looks on.
 */

#ifndef Terminal_h
#define Terminal_h

#include <set>
#include <string>

class vtkAlgorithm;

class Terminal
{
public:
  Terminal();
  ~Terminal();
  Terminal(const Terminal&) = delete;
  void operator=(const Terminal&) = delete;

  /// No bar and no warnings from now on.
  void BeQuiet();

  void PrintError(const std::string& message);

  /// What has been done beside voxels; not when quiet.
  void PrintNote(const std::string& message);

  /// Prints a warning, but none twice.
  void PrintWarning(const std::string& message);

  /// The bar stands for one task at a time; fraction from 0 to 1.
  void ShowProgress(const std::string& task, double fraction);

  /// Shows the progress that the algorithm reports.
  void Watch(vtkAlgorithm* algorithm, const std::string& task);

  /// Takes the bar away.
  void ClearBar();

private:
  void Print(const std::string& kind, const std::string& message);

  bool ShowsBar;
  bool Quiet = false;
  std::string Bar;
  std::set<std::string> Warned;
};

#endif
