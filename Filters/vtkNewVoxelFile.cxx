// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNewVoxelFile.h"

#include "vtkVoxelFileError.h"

#include <cerrno>
#include <cstring>

vtkNewVoxelFile::vtkNewVoxelFile(const char* name, bool inPlace)
{
  if (!name || !*name)
  {
    throw vtkVoxelFileError(vtkErrorCode::NoFileNameError, "There is no file name. Set one.");
  }
  this->Name = name;
  this->Partial = inPlace ? std::string(name) : std::string(name) + ".part";
  std::error_code none;
  if (std::filesystem::is_directory(this->Name, none))
  {
    throw vtkVoxelFileError(
      vtkErrorCode::CannotOpenFileError, this->Name.string() + " is a folder. Name a file.");
  }
  errno = 0;
  this->Stream.open(this->Partial, std::ios::binary);
  if (!this->Stream)
  {
    throw vtkVoxelFileError(vtkErrorCode::CannotOpenFileError,
      "The file " + this->Name.string() + " can't be written: " + std::strerror(errno) + ".");
  }
  this->Exists = true;
}

vtkNewVoxelFile::~vtkNewVoxelFile()
{
  if (this->Exists)
  {
    this->Stream.exceptions(std::ios::goodbit);
    this->Stream.close();
    std::error_code none;
    std::filesystem::remove(this->Partial, none);
  }
}

void vtkNewVoxelFile::Commit()
{
  this->Stream.exceptions(std::ios::goodbit);
  this->Stream.close();
  if (!this->Stream)
  {
    this->Fail("the disk may be full");
  }
  std::error_code error;
  std::filesystem::rename(this->Partial, this->Name, error);
  if (error)
  {
    this->Fail(error.message());
  }
  this->Exists = false;
}

void vtkNewVoxelFile::Fail(const std::string& why) const
{
  throw vtkVoxelFileError(vtkErrorCode::OutOfDiskSpaceError,
    "The file " + this->Name.string() + " can't be written: " + why + ".");
}
