// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file StagedFiles.h
 * Files that appear under their names only when all of them are complete.
 */

#ifndef StagedFiles_h
#define StagedFiles_h

#include <string>
#include <vector>

/**
 * A file is written under a name of its own, hidden beside its target, and takes the target's place
 * when Commit renames it. Until then whatever ends the program, a signal included, removes it and
 * leaves a former file as it was. One object at a time.
 */
class StagedFiles
{
public:
  StagedFiles();
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  void operator=(const StagedFiles&) = delete;

  /**
   * Makes an empty file beside the target, with its extension, and returns its name. Throws Failure
   * with ExitCode::Output when the target is a folder, or its folder can't be written to.
   */
  std::string Add(const std::string& target);

  /// Gives the files their names, in the order in which they came.
  void Commit();

private:
  struct File
  {
    std::string Temporary;
    std::string Target;
  };

  std::vector<File> Files;
};

#endif
