// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshReader.h"

#include "Failure.h"
#include "FileNames.h"
#include "GltfFileCheck.h"
#include "GltfReader.h"
#include "InputFile.h"
#include "LegacyFileCheck.h"
#include "MemoryLimit.h"
#include "MeshFileCheck.h"
#include "Messages.h"
#include "Terminal.h"
#include "TextureCoordinates.h"

#include "vtkCellArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArrayRange.h"
#include "vtkOBJReader.h"
#include "vtkPLYReader.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataReader.h"
#include "vtkSTLReader.h"
#include "vtkXMLPolyDataReader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <new>
#include <optional>
#include <sstream>
#include <vector>

namespace
{
template <typename Reader>
vtkSmartPointer<vtkAlgorithm> MakeReader(const std::string& file)
{
  auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName(file.c_str());
  return reader;
}

vtkSmartPointer<vtkAlgorithm> MakeSTLReader(const std::string& file)
{
  auto reader = vtkSmartPointer<vtkSTLReader>::New();
  reader->SetFileName(file.c_str());
  // Voxelizers know that points with the same coordinates are one.
  reader->MergingOff();
  return reader;
}

/// VTK wants to have an end to the last line of a text.
vtkSmartPointer<vtkAlgorithm> MakePLYReader(const std::string& file)
{
  auto reader = vtkSmartPointer<vtkPLYReader>::New();
  if (MeshFileCheck::IsPLYWithoutLastLineEnd(file))
  {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf() << '\n';
    reader->SetInputString(text.str());
    reader->ReadFromInputStringOn();
  }
  reader->SetFileName(file.c_str());
  return reader;
}

/// VTK leaves out all arrays but the first of each kind, unless told otherwise.
vtkSmartPointer<vtkAlgorithm> MakeLegacyReader(const std::string& file)
{
  auto reader = vtkSmartPointer<vtkPolyDataReader>::New();
  reader->SetFileName(file.c_str());
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllNormalsOn();
  reader->ReadAllTensorsOn();
  reader->ReadAllColorScalarsOn();
  reader->ReadAllTCoordsOn();
  reader->ReadAllFieldsOn();
  return reader;
}

struct Format
{
  const char* Extension;
  vtkSmartPointer<vtkAlgorithm> (*MakeReader)(const std::string& file);
  /// Finds what the reader would not survive or not notice.
  void (*Check)(const std::string& file);
  /// Brings texture coordinates into the form of the others.
  void (*Amend)(vtkPolyData* part);
};

constexpr Format Formats[] = {
  { ".stl", MakeSTLReader, MeshFileCheck::CheckSTL, nullptr },
  { ".ply", MakePLYReader, MeshFileCheck::CheckPLY, nullptr },
  { ".obj", MakeReader<vtkOBJReader>, MeshFileCheck::CheckOBJ, TextureCoordinates::Join },
  { ".vtp", MakeReader<vtkXMLPolyDataReader>, nullptr, nullptr },
  { ".vtk", MakeLegacyReader, LegacyFileCheck::Check, nullptr },
  { ".gltf", MakeReader<GltfReader>, GltfFileCheck::Check, TextureCoordinates::Flip },
  { ".glb", MakeReader<GltfReader>, GltfFileCheck::Check, TextureCoordinates::Flip },
};

/// Null where the extension is not known.
const Format* FindFormat(const std::string& file)
{
  const std::string extension = FileNames::GetExtension(file);
  const auto* const found = std::find_if(std::begin(Formats), std::end(Formats),
    [&](const Format& format) { return extension == format.Extension; });
  return found == std::end(Formats) ? nullptr : found;
}

const Format& GetFormat(const std::string& file)
{
  const Format* const format = FindFormat(file);
  if (!format)
  {
    const std::string extension = FileNames::GetExtension(file);
    InputFile::Refuse(file,
      (extension.empty() ? "its name has no extension"
                         : "meshes of type " + extension + " are not known") +
        "; known are " + MeshReader::GetExtensions());
  }
  return *format;
}

/**
 * A name for the file that ends in the extension as VTK's reader of GLB wants it, in lower case:
 * the file's own, or else that of a link that goes away with this object.
 */
class LowerCaseName
{
public:
  LowerCaseName(const std::string& file, const std::string& extension)
    : Name(file)
  {
    namespace fs = std::filesystem;
    const fs::path path = fs::absolute(file);
    if (path.extension() == extension || extension != ".glb")
    {
      return;
    }
    this->Link = fs::temp_directory_path() / ("vtkvoxelize-" + path.stem().string() + extension);
    fs::remove(this->Link);
    fs::create_symlink(path, this->Link);
    this->Name = this->Link.string();
  }
  ~LowerCaseName()
  {
    std::error_code ignored;
    std::filesystem::remove(this->Link, ignored);
  }
  LowerCaseName(const LowerCaseName&) = delete;
  void operator=(const LowerCaseName&) = delete;

  const std::string& Get() const { return this->Name; }

private:
  std::string Name;
  std::filesystem::path Link;
};

std::vector<vtkPolyData*> GetParts(vtkDataObject* data)
{
  std::vector<vtkPolyData*> parts;
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    vtkSmartPointer<vtkCompositeDataIterator> leaf;
    leaf.TakeReference(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      parts.push_back(vtkPolyData::SafeDownCast(leaf->GetCurrentDataObject()));
    }
  }
  else
  {
    parts.push_back(vtkPolyData::SafeDownCast(data));
  }
  parts.erase(std::remove(parts.begin(), parts.end(), nullptr), parts.end());
  return parts;
}

bool AreFinite(vtkPoints* points)
{
  const auto values = vtk::DataArrayValueRange<3>(points->GetData());
  return std::all_of(
    values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

bool ReferToPoints(vtkCellArray* cells, vtkIdType numberOfPoints)
{
  if (!cells->IsValid())
  {
    return false;
  }
  const vtkIdType* ids = nullptr;
  vtkIdType count = 0;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    cells->GetCellAtId(cell, count, ids);
    if (!std::all_of(
          ids, ids + count, [&](vtkIdType id) { return id >= 0 && id < numberOfPoints; }))
    {
      return false;
    }
  }
  return true;
}

void CheckMesh(const std::string& file, vtkDataObject* data)
{
  vtkIdType polygons = 0;
  for (vtkPolyData* part : GetParts(data))
  {
    if (part->GetPoints() && !AreFinite(part->GetPoints()))
    {
      InputFile::Refuse(file, "it has points that are NaN or infinite");
    }
    for (vtkCellArray* cells : { part->GetPolys(), part->GetStrips() })
    {
      if (!ReferToPoints(cells, part->GetNumberOfPoints()))
      {
        InputFile::Refuse(file, "it has polygons that refer to points which do not exist");
      }
      polygons += cells->GetNumberOfCells();
    }
  }
  if (polygons == 0)
  {
    InputFile::Refuse(file, "it holds no polygons");
  }
}

void RefuseErrors(const std::string& file, Messages& messages)
{
  const auto errors = messages.TakeErrors();
  if (!errors.empty())
  {
    InputFile::Refuse(file, errors.front());
  }
}

/// Readers of VTK that see damage in the head of a file go on to its body nevertheless.
void Update(vtkAlgorithm* reader, const std::string& file, Messages& messages)
{
  reader->UpdateInformation();
  RefuseErrors(file, messages);
  reader->Update();
  RefuseErrors(file, messages);
}

vtkSmartPointer<vtkDataObject> ReadAs(
  const Format& format, const std::string& file, Messages& messages, Terminal& terminal)
{
  if (format.Check)
  {
    format.Check(file);
  }
  const LowerCaseName name(file, format.Extension);
  const auto reader = format.MakeReader(name.Get());
  terminal.Watch(reader, "reading");
  // The reader of legacy files only warns where the file ends too early.
  std::optional<Messages::Strictness> strictness;
  if (format.Extension == std::string(".vtk"))
  {
    strictness.emplace(messages);
  }
  Update(reader, file, messages);
  return reader->GetOutputDataObject(0);
}
}

vtkSmartPointer<vtkDataObject> MeshReader::Read(
  const std::string& file, Messages& messages, Terminal& terminal)
{
  InputFile::CheckReadable(file);
  try
  {
    const MemoryLimit limit(file);
    const Format& format = GetFormat(file);
    auto data = ReadAs(format, file, messages, terminal);
    CheckMesh(file, data);
    if (format.Amend)
    {
      for (vtkPolyData* part : GetParts(data))
      {
        format.Amend(part);
      }
    }
    return data;
  }
  catch (const Failure&)
  {
    throw;
  }
  catch (const std::bad_alloc&)
  {
    InputFile::Refuse(file, "it is damaged, or takes more memory than there is");
  }
  catch (const std::exception& error)
  {
    InputFile::Refuse(file, std::string("it is damaged: ") + error.what());
  }
}

vtkBoundingBox MeshReader::GetBounds(vtkDataObject* mesh)
{
  vtkBoundingBox box;
  for (vtkPolyData* part : GetParts(mesh))
  {
    box.AddBounds(part->GetBounds());
  }
  return box;
}

bool MeshReader::IsMesh(const std::string& file)
{
  return FindFormat(file);
}

std::string MeshReader::GetExtensions()
{
  std::string extensions;
  for (const Format& format : Formats)
  {
    extensions += (extensions.empty() ? "" : ", ") + std::string(format.Extension);
  }
  return extensions;
}
