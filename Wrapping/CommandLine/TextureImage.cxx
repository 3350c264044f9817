// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TextureImage.h"

#include "FileNames.h"
#include "InputFile.h"
#include "MemoryLimit.h"
#include "Messages.h"
#include "PngFileCheck.h"

#include "vtkImageData.h"
#include "vtkJPEGReader.h"
#include "vtkPNGReader.h"

#include <algorithm>
#include <new>

namespace
{
template <typename Reader>
vtkSmartPointer<vtkImageReader2> MakeReader()
{
  return vtkSmartPointer<Reader>::New();
}

struct Format
{
  const char* Extension;
  vtkSmartPointer<vtkImageReader2> (*MakeReader)();
  /// Finds what the reader would not survive.
  void (*Check)(const std::string& file);
};

constexpr Format Formats[] = {
  { ".png", MakeReader<vtkPNGReader>, PngFileCheck::Check },
  { ".jpg", MakeReader<vtkJPEGReader>, nullptr },
  { ".jpeg", MakeReader<vtkJPEGReader>, nullptr },
};

const Format& FindFormat(const std::string& file)
{
  const std::string extension = FileNames::GetExtension(file);
  const auto* const found = std::find_if(std::begin(Formats), std::end(Formats),
    [&](const Format& format) { return extension == format.Extension; });
  if (found == std::end(Formats))
  {
    InputFile::Refuse(file, "a texture image is one of " + TextureImage::GetExtensions());
  }
  return *found;
}

/// What VTK says of its pipeline is of no use to anybody; libjpeg's reasons come as warnings.
void RefuseErrors(const std::string& file, Messages& messages)
{
  const auto warnings = messages.TakeWarnings();
  if (!messages.TakeErrors().empty())
  {
    InputFile::Refuse(
      file, warnings.empty() ? "it is damaged" : "it is damaged: " + warnings.front());
  }
}

vtkSmartPointer<vtkImageData> ReadAs(
  const Format& format, const std::string& file, Messages& messages)
{
  if (format.Check)
  {
    format.Check(file);
  }
  const auto reader = format.MakeReader();
  reader->SetFileName(file.c_str());
  reader->UpdateInformation();
  RefuseErrors(file, messages);
  reader->Update();
  RefuseErrors(file, messages);
  vtkImageData* image = reader->GetOutput();
  if (image->GetScalarType() != VTK_UNSIGNED_CHAR)
  {
    InputFile::Refuse(file, "it has more than 8 bits a channel; save it with 8");
  }
  return image;
}
}

vtkSmartPointer<vtkImageData> TextureImage::Read(const std::string& file, Messages& messages)
{
  InputFile::CheckReadable(file);
  const Format& format = FindFormat(file);
  try
  {
    const MemoryLimit limit(file);
    return ReadAs(format, file, messages);
  }
  catch (const std::bad_alloc&)
  {
    InputFile::Refuse(file, "it is damaged, or takes more memory than there is");
  }
}

std::string TextureImage::GetExtensions()
{
  std::string extensions;
  for (const Format& format : Formats)
  {
    extensions += (extensions.empty() ? "" : ", ") + std::string(format.Extension);
  }
  return extensions;
}
