// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkVoxelFileError.h
 * Private header: what readers and writers of files throw within, and report once.
 */

#ifndef vtkVoxelFileError_h
#define vtkVoxelFileError_h

#include "vtkErrorCode.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

/// What went wrong, and the code that vtkAlgorithm knows for it.
struct vtkVoxelFileError : std::runtime_error
{
  vtkVoxelFileError(unsigned long code, const std::string& what)
    : std::runtime_error(what)
    , Code(code)
  {
  }

  unsigned long Code;

  /// Throws one unless there is such a file to read.
  static void RequireFile(const char* name)
  {
    if (!name || !*name)
    {
      throw vtkVoxelFileError(vtkErrorCode::NoFileNameError, "There is no file name. Set one.");
    }
    std::error_code none;
    if (!std::filesystem::is_regular_file(name, none))
    {
      throw vtkVoxelFileError(
        vtkErrorCode::FileNotFoundError, "There is no file " + std::string(name) + ".");
    }
  }

  /// The file to read; throws one when there is none, or it can't be opened.
  static std::ifstream OpenFile(const char* name)
  {
    RequireFile(name);
    std::ifstream stream(name, std::ios::binary);
    if (!stream)
    {
      throw vtkVoxelFileError(
        vtkErrorCode::CannotOpenFileError, "The file " + std::string(name) + " can't be opened.");
    }
    return stream;
  }
};

#endif
// VTK-HeaderTest-Exclude: vtkVoxelFileError.h
