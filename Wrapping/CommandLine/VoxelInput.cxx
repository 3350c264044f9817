// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelInput.h"

#include "FileNames.h"
#include "InputFile.h"
#include "Messages.h"
#include "Terminal.h"

#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkNew.h"

#ifdef VTKVOXELIZATION_HAS_OPENVDB
#include "vtkVDBVoxelReader.h"

namespace
{
constexpr char Extension[] = ".vdb";
}

bool VoxelInput::IsVoxels(const std::string& file)
{
  return FileNames::GetExtension(file) == Extension;
}

vtkSmartPointer<vtkImageData> VoxelInput::Read(
  const std::string& file, Messages& messages, Terminal& terminal)
{
  InputFile::CheckReadable(file);
  vtkNew<vtkVDBVoxelReader> reader;
  reader->SetFileName(file.c_str());
  terminal.Watch(reader, "reading");
  reader->Update();
  const auto errors = messages.TakeErrors();
  if (!errors.empty())
  {
    InputFile::Refuse(file, errors.front());
  }
  return reader->GetOutput();
}

std::string VoxelInput::GetExtensions()
{
  return Extension;
}

#else

bool VoxelInput::IsVoxels(const std::string&)
{
  return false;
}

vtkSmartPointer<vtkImageData> VoxelInput::Read(const std::string& file, Messages&, Terminal&)
{
  InputFile::Refuse(file, "this program was built without a reader for it");
}

std::string VoxelInput::GetExtensions()
{
  return {};
}

#endif
