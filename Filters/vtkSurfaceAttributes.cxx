// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceAttributes.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSlicemap.h"
#include "vtkSlicemapKernel.h"
#include "vtkSlicemapNumbering.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVoxelGrid.h"
#include "vtkVoxelMesh.h"

#include "vtkSurfaceAttributesGLSL.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

using vtkVoxelGL::Program;

namespace
{
constexpr std::int64_t WordBytes = 4;
constexpr double One = 8388608.0; // as in vtkSurfaceAttributes.glsl
constexpr std::uint32_t AllBits = 0xffffffffu;

constexpr unsigned int QuadsUnit = 4;
constexpr unsigned int OffsetsUnit = 5;
constexpr unsigned int ValuesUnit = 6;
constexpr unsigned int ImageUnit = 7;
constexpr GLuint ResultsBinding = 0;
constexpr GLuint TrianglesBinding = 1;

/// The array of a leaf, checked, and whether it belongs to the points.
struct FoundArray
{
  vtkDataArray* Array;
  bool OfPoints;
};

FoundArray FindArray(vtkPolyData* leaf, const std::string& name)
{
  vtkPointData* points = leaf->GetPointData();
  vtkCellData* cells = leaf->GetCellData();
  const bool ofPoints = points->HasArray(name.c_str());
  vtkAbstractArray* any =
    ofPoints ? points->GetAbstractArray(name.c_str()) : cells->GetAbstractArray(name.c_str());
  if (!any)
  {
    std::string names;
    for (vtkFieldData* data :
      { static_cast<vtkFieldData*>(points), static_cast<vtkFieldData*>(cells) })
    {
      for (int i = 0; i < data->GetNumberOfArrays(); ++i)
      {
        const char* other = data->GetArrayName(i);
        names += (names.empty() ? "" : ", ") + std::string(other ? other : "(unnamed)");
      }
    }
    throw std::runtime_error("The input has no point or cell array named \"" + name + "\"; " +
      (names.empty() ? "it has no arrays at all." : "its arrays are: " + names + "."));
  }
  auto* array = vtkDataArray::SafeDownCast(any);
  if (!array)
  {
    throw std::runtime_error("The array \"" + name + "\" is a " + any->GetClassName() +
      "; only arrays of numbers can be carried over to voxels.");
  }
  const vtkIdType wanted = ofPoints ? leaf->GetNumberOfPoints() : leaf->GetNumberOfCells();
  if (array->GetNumberOfTuples() != wanted)
  {
    throw std::runtime_error("The array \"" + name + "\" has " +
      std::to_string(array->GetNumberOfTuples()) + " tuples, but the mesh has " +
      std::to_string(wanted) + (ofPoints ? " points." : " cells.") + " Make the array anew.");
  }
  return { array, ofPoints };
}

void AppendTuple(
  vtkDataArray* array, vtkIdType id, std::vector<double>& tuple, std::vector<float>& values)
{
  array->GetTuple(id, tuple.data());
  values.insert(values.end(), tuple.begin(), tuple.end());
}

float FromOrderedBits(std::uint32_t ordered)
{
  constexpr std::uint32_t sign = 0x80000000u;
  const std::uint32_t bits = (ordered & sign) ? ordered & ~sign : ~ordered;
  float value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

double Rounded(double value, int type)
{
  return type == VTK_UNSIGNED_CHAR ? std::clamp(std::round(value), 0.0, 255.0) : value;
}
}

void vtkSurfaceAttributes::AddArray(
  vtkDataObject* input, const vtkVoxelMesh& mesh, const std::string& name)
{
  Source source;
  source.Name = name;
  bool first = true;
  mesh.VisitLeaves(input,
    [&](vtkPolyData* leaf, const std::vector<vtkIdType>& cellsOfTriangles)
    {
      const auto found = FindArray(leaf, name);
      const int components = found.Array->GetNumberOfComponents();
      const bool isColor = found.Array->GetDataType() == VTK_UNSIGNED_CHAR && components >= 3;
      if (!first && (components != source.Components || found.OfPoints != source.OfPoints))
      {
        throw std::runtime_error("The array \"" + name +
          "\" is not of the same kind in all blocks "
          "of the input.");
      }
      first = false;
      source.OfPoints = found.OfPoints;
      source.Components = components;
      source.ResultType = isColor ? VTK_UNSIGNED_CHAR : VTK_FLOAT;
      std::vector<double> tuple(components);
      if (found.OfPoints)
      {
        for (vtkIdType i = 0; i < found.Array->GetNumberOfTuples(); ++i)
        {
          AppendTuple(found.Array, i, tuple, source.Values);
        }
      }
      else
      {
        for (const vtkIdType cell : cellsOfTriangles)
        {
          AppendTuple(found.Array, cell, tuple, source.Values);
        }
      }
    });
  for (const float value : source.Values)
  {
    if (!std::isfinite(value))
    {
      throw std::runtime_error(
        "The array \"" + name + "\" has values that are NaN or infinite. Replace them before.");
    }
  }
  this->Normalize(source);
  this->Sources.push_back(std::move(source));
}

void vtkSurfaceAttributes::AddImage(
  vtkDataObject* input, const vtkVoxelMesh& mesh, vtkImageData* image)
{
  auto* colors = vtkUnsignedCharArray::SafeDownCast(image->GetPointData()->GetScalars());
  const int* n = image->GetDimensions();
  if (!colors || n[2] != 1 || colors->GetNumberOfComponents() > 4)
  {
    throw std::runtime_error("The texture image must be flat, with one to four components of "
                             "unsigned char; cast it with vtkImageCast before.");
  }
  Source source;
  source.Name = ImageName;
  mesh.VisitLeaves(input,
    [&](vtkPolyData* leaf, const std::vector<vtkIdType>&)
    {
      vtkDataArray* coordinates = leaf->GetPointData()->GetTCoords();
      if (!coordinates || coordinates->GetNumberOfComponents() < 2 ||
        coordinates->GetNumberOfTuples() != leaf->GetNumberOfPoints())
      {
        throw std::runtime_error("The input has no texture coordinates for the texture image. Make "
                                 "some, for instance with vtkTextureMapToPlane.");
      }
      std::vector<double> tuple(coordinates->GetNumberOfComponents());
      for (vtkIdType i = 0; i < coordinates->GetNumberOfTuples(); ++i)
      {
        coordinates->GetTuple(i, tuple.data());
        source.Values.insert(source.Values.end(), tuple.begin(), tuple.begin() + 2);
      }
    });
  source.Components = colors->GetNumberOfComponents();
  source.ResultType = VTK_UNSIGNED_CHAR;
  source.Image = image;
  source.Low.assign(source.Components, 0.0);
  source.High.assign(source.Components, 255.0);
  this->Sources.push_back(std::move(source));
}

void vtkSurfaceAttributes::Normalize(Source& source) const
{
  source.Low.assign(source.Components, 0.0);
  source.High.assign(source.Components, 1.0);
  if (this->Combine != Combination::Average)
  {
    return;
  }
  const auto n = source.Values.size() / source.Components;
  for (int c = 0; c < source.Components; ++c)
  {
    double low = std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::lowest();
    for (std::size_t i = 0; i < n; ++i)
    {
      const double value = source.Values[i * source.Components + c];
      low = std::min(low, value);
      high = std::max(high, value);
    }
    source.Low[c] = low;
    source.High[c] = high;
    const double scale = high > low ? 1.0 / (high - low) : 0.0;
    for (std::size_t i = 0; i < n; ++i)
    {
      float& value = source.Values[i * source.Components + c];
      value = static_cast<float>((value - low) * scale);
    }
  }
}

vtkSmartPointer<vtkDataArray> vtkSurfaceAttributes::NewArray(int i, vtkIdType n) const
{
  const Source& source = this->Sources[i];
  auto array =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(source.ResultType));
  array->SetName(source.Name.c_str());
  array->SetNumberOfComponents(source.Components);
  if (!array->Allocate(n * source.Components))
  {
    throw std::runtime_error("There is no memory for the array \"" + source.Name + "\" of " +
      std::to_string(n) + " voxels. Use fewer voxels.");
  }
  array->SetNumberOfTuples(n);
  return array;
}

std::int64_t vtkSurfaceAttributes::GetBytesPerVoxel() const
{
  std::int64_t bytes = 0;
  for (const Source& source : this->Sources)
  {
    bytes += std::int64_t(source.Components) * vtkDataArray::GetDataTypeSize(source.ResultType);
  }
  return bytes;
}

std::int64_t vtkSurfaceAttributes::GetWorkBytesPerVoxel() const
{
  std::int64_t components = 0;
  for (const Source& source : this->Sources)
  {
    components = std::max<std::int64_t>(components, source.Components);
  }
  return components * WordBytes * (this->Combine == Combination::Average ? 2 : 1);
}

void vtkSurfaceAttributes::Upload(Source& source, const vtkVoxelGL::Context& context)
{
  source.Buffer = vtkVoxelGL::Buffer(context);
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
  if (source.Values.size() > std::size_t(limit) ||
    !source.Buffer.Allocate(source.Values.size() * sizeof(float), source.Values.data()))
  {
    throw std::runtime_error(
      "OpenGL has no memory left for the values of the array \"" + source.Name + "\".");
  }
  source.Texture = vtkVoxelGL::Texture(context, GL_TEXTURE_BUFFER);
  source.Texture.AttachBuffer(GL_R32F, source.Buffer);
  if (source.Image)
  {
    constexpr GLenum internalFormats[] = { GL_R8, GL_RG8, GL_RGB8, GL_RGBA8 };
    constexpr GLenum formats[] = { GL_RED, GL_RG, GL_RGB, GL_RGBA };
    const int* n = source.Image->GetDimensions();
    source.ImageTexture = vtkVoxelGL::Texture(context, GL_TEXTURE_2D);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (!source.ImageTexture.Allocate2D(internalFormats[source.Components - 1], n[0], n[1],
          formats[source.Components - 1], GL_UNSIGNED_BYTE,
          vtkUnsignedCharArray::SafeDownCast(source.Image->GetPointData()->GetScalars())
            ->GetPointer(0)))
    {
      throw std::runtime_error("OpenGL has no memory left for the texture image of " +
        std::to_string(n[0]) + " x " + std::to_string(n[1]) + " pixels.");
    }
    source.ImageTexture.FilterAndRepeat();
  }
  source.Values = {};
}

vtkSmartPointer<vtkDataArray> vtkSurfaceAttributes::Compute(int i, const vtkVoxelMesh& mesh,
  vtkSlicemap* slicemap, const vtkSlicemapNumbering& numbering,
  const vtkSurfacePass::Settings& settings, const vtkSurfacePass::Progress& progress)
{
  const vtkVoxelGL::Context& context = slicemap->GetBuffer().GetContext();
  Source& source = this->Sources[i];
  if (!source.Buffer)
  {
    Upload(source, context);
  }
  const bool averages = this->Combine == Combination::Average;
  const auto count = static_cast<std::int64_t>(numbering.GetCount());
  const std::int64_t words = count * source.Components * (averages ? 2 : 1);
  vtkVoxelGL::Buffer results;
  vtkVoxelGL::Buffer triangles;
  vtkVoxelGL::Prepare(results, context, words * WordBytes);
  vtkVoxelGL::Prepare(triangles, context, count * WordBytes);
  results.Fill(this->Combine == Combination::Minimum ? AllBits : 0);
  triangles.Fill(averages ? 0 : AllBits);

  const vtkVoxelGL::Texture quads = vtkSlicemapTexture(slicemap);
  vtkSurfacePass::Visitor visitor;
  visitor.Source = vtkSurfaceAttributesGLSL;
  visitor.Defines["COMPONENTS"] = std::to_string(source.Components);
  if (source.OfPoints)
  {
    visitor.Defines["OF_POINTS"] = "1";
  }
  if (source.Image)
  {
    visitor.Defines["IMAGE"] = "1";
  }
  visitor.Bind = [&](Program& program)
  {
    results.BindBase(GL_SHADER_STORAGE_BUFFER, ResultsBinding);
    triangles.BindBase(GL_SHADER_STORAGE_BUFFER, TrianglesBinding);
    quads.Bind(QuadsUnit);
    program.Set("Quads", int(QuadsUnit));
    numbering.GetOffsets().Bind(OffsetsUnit);
    program.Set("Offsets", int(OffsetsUnit));
    source.Texture.Bind(ValuesUnit);
    program.Set("Values", int(ValuesUnit));
    if (source.Image)
    {
      source.ImageTexture.Bind(ImageUnit);
      program.Set("Image", int(ImageUnit));
    }
  };
  auto& pass = vtkSurfacePass::Get(context);
  const auto run = [&](const char* combination)
  {
    visitor.Defines["COMBINATION"] = combination;
    return pass.Visit(mesh, slicemap, settings, visitor, progress);
  };
  const bool finished = this->Combine == Combination::Average ? run("AVERAGE")
    : this->Combine == Combination::Minimum                   ? run("MINIMUM")
    : this->Combine == Combination::Maximum                   ? run("MAXIMUM")
                                            : run("FIND_FIRST") && run("STORE_FIRST");
  if (!finished)
  {
    return nullptr;
  }

  auto array = this->NewArray(i, count);
  const vtkVoxelGL::MappedBuffer mapped(results, 0, results.GetSize(), GL_MAP_READ_BIT);
  const vtkVoxelGL::MappedBuffer counts(triangles, 0, triangles.GetSize(), GL_MAP_READ_BIT);
  if (!mapped.Get() || !counts.Get())
  {
    throw std::runtime_error("OpenGL could not map the array \"" + source.Name + "\".");
  }
  const auto* combined = static_cast<const std::uint32_t*>(mapped.Get());
  const auto* trianglesOf = static_cast<const std::uint32_t*>(counts.Get());
  for (vtkIdType voxel = 0; voxel < count; ++voxel)
  {
    for (int c = 0; c < source.Components; ++c)
    {
      const vtkIdType at = voxel * source.Components + c;
      double value = 0.0;
      if (averages)
      {
        const double sum = combined[2 * at] + 4294967296.0 * combined[2 * at + 1];
        value = source.Low[c] + (source.High[c] - source.Low[c]) * sum / (One * trianglesOf[voxel]);
      }
      else if (this->Combine == Combination::First)
      {
        float first;
        std::memcpy(&first, combined + at, sizeof(first));
        value = first;
      }
      else
      {
        value = FromOrderedBits(combined[at]);
      }
      const double scale = source.Image && !averages ? 255.0 : 1.0;
      array->SetComponent(voxel, c, Rounded(scale * value, source.ResultType));
    }
  }
  return array;
}
