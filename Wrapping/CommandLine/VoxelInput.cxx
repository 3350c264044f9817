// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelInput.h"

#include "FileNames.h"
#include "InputFile.h"
#include "Messages.h"
#include "Terminal.h"

#include "vtkBinvoxReader.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkVoxelBitsReader.h"

#ifdef VTKVOXELIZATION_HAS_OPENVDB
#include "vtkVDBVoxelReader.h"
#endif

#include <algorithm>
#include <iterator>

namespace
{
template <typename Reader>
vtkSmartPointer<vtkImageData> ReadBy(
  const std::string& file, Messages& messages, Terminal& terminal)
{
  vtkNew<Reader> reader;
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

struct Format
{
  const char* Extension;
  vtkSmartPointer<vtkImageData> (*Read)(const std::string&, Messages&, Terminal&);
};

constexpr Format Formats[] = {
#ifdef VTKVOXELIZATION_HAS_OPENVDB
  { ".vdb", ReadBy<vtkVDBVoxelReader> },
#endif
  { ".binvox", ReadBy<vtkBinvoxReader> },
  { ".bits", ReadBy<vtkVoxelBitsReader> },
};

/// Null where the file is not one of voxels.
const Format* FindFormat(const std::string& file)
{
  const std::string extension = FileNames::GetExtension(file);
  const auto* const found = std::find_if(std::begin(Formats), std::end(Formats),
    [&](const Format& format) { return extension == format.Extension; });
  return found == std::end(Formats) ? nullptr : found;
}
}

bool VoxelInput::IsVoxels(const std::string& file)
{
  return FindFormat(file) != nullptr;
}

vtkSmartPointer<vtkImageData> VoxelInput::Read(
  const std::string& file, Messages& messages, Terminal& terminal)
{
  InputFile::CheckReadable(file);
  return FindFormat(file)->Read(file, messages, terminal);
}

std::string VoxelInput::GetExtensions()
{
  std::string extensions;
  for (const Format& format : Formats)
  {
    extensions += (extensions.empty() ? "" : ", ") + std::string(format.Extension);
  }
  return extensions;
}
