// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkNewVoxelFile.h
 * Private header: a file that takes its name when it is complete, and leaves nothing behind
 * otherwise.
 */

#ifndef vtkNewVoxelFile_h
#define vtkNewVoxelFile_h

#include <filesystem>
#include <fstream>
#include <string>

class vtkNewVoxelFile
{
public:
  /**
   * Opens NAME.part, or the file itself when `inPlace`. Throws vtkVoxelFileError when there is no
   * name, or nothing can be written there.
   */
  vtkNewVoxelFile(const char* name, bool inPlace);
  ~vtkNewVoxelFile();
  vtkNewVoxelFile(const vtkNewVoxelFile&) = delete;
  void operator=(const vtkNewVoxelFile&) = delete;

  std::ostream& GetStream() { return this->Stream; }

  /**
   * Gives the file its name. Throws vtkVoxelFileError when not all bytes have arrived.
   */
  void Commit();

  /**
   * Throws what Commit does then, for callers that notice before.
   */
  [[noreturn]] void Fail(const std::string& why) const;

private:
  std::filesystem::path Name;
  std::filesystem::path Partial;
  std::ofstream Stream;
  bool Exists = false;
};

#endif
// VTK-HeaderTest-Exclude: vtkNewVoxelFile.h
