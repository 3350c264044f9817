// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSlicemap.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationIdTypeKey.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSlicemapExpression.h"
#include "vtkSlicemapExpressionPass.h"
#include "vtkSlicemapImage.h"
#include "vtkSlicemapKernel.h"
#include "vtkSlicemapPacker.h"
#include "vtkSmartPointer.h"
#include "vtkVoxelContext.h"
#include "vtkVoxelContextScope.h"
#include "vtkVoxelGrid.h"

#include "vtkSlicemapCountGLSL.h"
#include "vtkSlicemapLayoutGLSL.h"
#include "vtkSlicemapShiftGLSL.h"

#include <algorithm>
#include <atomic>
#include <list>
#include <stdexcept>

namespace
{
constexpr std::int64_t WordBits = 32;
constexpr std::int64_t WordsPerQuad = 4;
constexpr std::int64_t WordBytes = 4;

/// Of words that are sent at a time: little beside the scalars they are made of, and enough to keep
/// all threads busy.
constexpr std::int64_t SlabBytes = std::int64_t(1) << 20;

std::atomic<vtkIdType> ReadBacks{ 0 };
std::atomic<vtkIdType> Uploads{ 0 };
}

vtkInformationKeyMacro(vtkSlicemap, SLICEMAP, ObjectBase);

// Modification time of the scalars that the slicemap of an image stands for.
vtkInformationKeyMacro(vtkSlicemap, SCALARS_TIME, IdType);

struct vtkSlicemap::Internals
{
  vtkSmartPointer<vtkVoxelContext> Context;
  vtkVoxelGrid Grid;
  vtkVoxelGL::Buffer Buffer;
  glm::ivec3 Dimensions{ 0 };
  std::array<double, 9> Direction{};
};

vtkStandardNewMacro(vtkSlicemap);

vtkSlicemap::vtkSlicemap()
  : Storage(std::make_unique<Internals>())
{
}

vtkSlicemap::~vtkSlicemap() = default;

void vtkSlicemap::SetContext(vtkVoxelContext* context)
{
  if (this->Storage->Context != context)
  {
    this->ReleaseGraphicsResources();
    this->Storage->Context = context;
    this->Modified();
  }
}

vtkVoxelContext* vtkSlicemap::GetContext()
{
  if (!this->Storage->Context)
  {
    this->Storage->Context = vtkSmartPointer<vtkVoxelContext>::New();
  }
  return this->Storage->Context;
}

int* vtkSlicemap::GetExtent()
{
  return this->Storage->Grid.Extent.data();
}

int* vtkSlicemap::GetDimensions()
{
  this->Storage->Dimensions = this->Storage->Grid.GetDimensions();
  return &this->Storage->Dimensions[0];
}

double* vtkSlicemap::GetSpacing()
{
  return &this->Storage->Grid.Spacing[0];
}

double* vtkSlicemap::GetOrigin()
{
  return &this->Storage->Grid.Origin[0];
}

double* vtkSlicemap::GetDirection()
{
  this->Storage->Direction = this->Storage->Grid.GetDirectionRows();
  return this->Storage->Direction.data();
}

const vtkVoxelGrid& vtkSlicemap::GetGrid() const
{
  return this->Storage->Grid;
}

vtkVoxelGL::Buffer& vtkSlicemap::GetBuffer()
{
  return this->Storage->Buffer;
}

std::int64_t vtkSlicemap::GetWordsPerRow(const vtkVoxelGrid& grid)
{
  const std::int64_t bitsPerQuad = WordBits * WordsPerQuad;
  return (grid.GetDimensions().x + bitsPerQuad - 1) / bitsPerQuad * WordsPerQuad;
}

std::int64_t vtkSlicemap::GetNumberOfWords(const vtkVoxelGrid& grid)
{
  const glm::ivec3 n = grid.GetDimensions();
  return GetWordsPerRow(grid) * n.y * n.z;
}

std::int64_t vtkSlicemap::GetWordsPerRow() const
{
  return GetWordsPerRow(this->Storage->Grid);
}

std::int64_t vtkSlicemap::GetNumberOfWords() const
{
  return GetNumberOfWords(this->Storage->Grid);
}

vtkIdType vtkSlicemap::GetNumberOfBytes()
{
  return static_cast<vtkIdType>(this->Storage->Buffer.GetSize());
}

bool vtkSlicemap::Allocate(const vtkVoxelGrid& grid)
{
  if (grid.IsEmpty())
  {
    vtkErrorMacro("The grid is empty: " << grid.Describe() << ". Give it one voxel at least.");
    return false;
  }
  vtkVoxelContext::Scope scope(this->GetContext());
  if (!scope)
  {
    vtkErrorMacro(<< this->GetContext()->GetErrorMessage());
    return false;
  }
  const auto context = this->GetContext()->GetRecord();
  auto& buffer = this->Storage->Buffer;
  const std::int64_t words = GetNumberOfWords(grid);
  const auto bytes = static_cast<std::size_t>(words * WordBytes);
  GLint texels = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
  const bool reusable = buffer && buffer.GetContext() == context && buffer.GetSize() == bytes;
  if (!reusable)
  {
    buffer = vtkVoxelGL::Buffer();
    if (words / WordsPerQuad <= texels)
    {
      buffer = vtkVoxelGL::Buffer(context);
    }
    if (!buffer || !buffer.Allocate(bytes))
    {
      buffer = vtkVoxelGL::Buffer();
      vtkErrorMacro("The grid with " << grid.Describe() << " needs " << bytes / 1048576.0
                                     << " MiB in one piece on the OpenGL renderer "
                                     << context->GetRendererName()
                                     << ", which can't be had. Use fewer voxels, or update the "
                                        "output in parts by update extents.");
      return false;
    }
  }
  this->Storage->Grid = grid;
  this->Modified();
  return true;
}

void vtkSlicemap::ReleaseGraphicsResources()
{
  this->Storage->Buffer = vtkVoxelGL::Buffer();
}

void vtkSlicemap::Swap(vtkSlicemap* other)
{
  std::swap(this->Storage, other->Storage);
  this->Modified();
  other->Modified();
}

void vtkSlicemap::CountReadBack()
{
  ++ReadBacks;
}

bool vtkSlicemap::Read(const std::function<void(const std::uint32_t* words)>& consume)
{
  vtkVoxelContext::Scope scope(this->GetContext());
  if (!scope || !this->Storage->Buffer)
  {
    vtkErrorMacro(
      "There are no bits to read" << (scope ? "." : ": " + this->GetContext()->GetErrorMessage()));
    return false;
  }
  const vtkVoxelGL::MappedBuffer mapped(
    this->Storage->Buffer, 0, this->Storage->Buffer.GetSize(), GL_MAP_READ_BIT);
  if (!mapped.Get())
  {
    vtkErrorMacro(
      "OpenGL could not map the bits of the grid with " << this->Storage->Grid.Describe() << ".");
    return false;
  }
  CountReadBack();
  consume(static_cast<const std::uint32_t*>(mapped.Get()));
  return true;
}

bool vtkSlicemap::Upload(vtkImageData* image)
{
  vtkDataArray* scalars = image ? vtkSlicemapImage::GetScalars(image) : nullptr;
  if (!scalars)
  {
    vtkErrorMacro("The image has no scalars to upload.");
    return false;
  }
  auto grid = vtkVoxelGrid::FromImage(image);
  if (scalars == image->GetCellData()->GetScalars())
  {
    grid = grid.CellsToVoxels();
  }
  if (scalars->GetNumberOfTuples() != grid.GetNumberOfVoxels())
  {
    vtkErrorMacro("The scalars of the image have "
      << scalars->GetNumberOfTuples() << " values, but the grid with " << grid.Describe()
      << " takes " << grid.GetNumberOfVoxels() << ".");
    return false;
  }
  const vtkSlicemapPacker packer(scalars, grid, { vtkSlicemapPacker::Criterion::NotZero() });
  return Write(grid, { this },
    [&](std::int64_t firstRow, std::int64_t rows, const std::vector<std::uint32_t*>& words)
    {
      packer.Pack(firstRow, rows, words);
      return true;
    });
}

bool vtkSlicemap::Write(
  const vtkVoxelGrid& grid, const std::vector<vtkSlicemap*>& slicemaps, const RowWriter& write)
{
  for (vtkSlicemap* slicemap : slicemaps)
  {
    if (!slicemap->Allocate(grid))
    {
      return false;
    }
  }
  vtkVoxelContext::Scope scope(slicemaps.front()->GetContext());
  const glm::ivec3 n = grid.GetDimensions();
  const std::int64_t rows = std::int64_t(n.y) * n.z;
  const std::int64_t rowBytes = GetWordsPerRow(grid) * WordBytes;
  const std::int64_t rowsOfSlab = std::max<std::int64_t>(1, SlabBytes / rowBytes);
  for (std::int64_t first = 0; first < rows; first += rowsOfSlab)
  {
    const std::int64_t count = std::min(rowsOfSlab, rows - first);
    std::list<vtkVoxelGL::MappedBuffer> slabs;
    std::vector<std::uint32_t*> words;
    for (vtkSlicemap* slicemap : slicemaps)
    {
      slabs.emplace_back(slicemap->GetBuffer(), first * rowBytes, count * rowBytes,
        GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_RANGE_BIT);
      words.push_back(static_cast<std::uint32_t*>(slabs.back().Get()));
      if (!words.back())
      {
        vtkErrorWithObjectMacro(
          slicemap, "OpenGL could not map the bits of the grid with " << grid.Describe() << ".");
        return false;
      }
    }
    if (!write(first, count, words))
    {
      return false;
    }
  }
  Uploads += static_cast<vtkIdType>(slicemaps.size());
  return true;
}

bool vtkSlicemap::Download(vtkImageData* image, int scalarType, int foregroundValue)
{
  const auto array = vtkSlicemapImage::NewArray(this->GetGrid(), scalarType);
  if (!array)
  {
    vtkErrorMacro("There is no memory for the " << this->GetGrid().GetNumberOfVoxels()
                                                << " voxels of the grid with "
                                                << this->GetGrid().Describe() << ".");
    return false;
  }
  const bool read = this->Read([&](const std::uint32_t* words)
    { vtkSlicemapImage::Expand(words, this->GetGrid(), foregroundValue, array); });
  if (read)
  {
    this->GetGrid().ApplyTo(image);
    image->GetPointData()->SetScalars(array);
    this->AttachTo(image);
  }
  return read;
}

vtkIdType vtkSlicemap::GetNumberOfFilledVoxels()
{
  vtkVoxelContext::Scope scope(this->GetContext());
  if (!scope || !this->Storage->Buffer)
  {
    return -1;
  }
  const auto context = this->GetContext()->GetRecord();
  if (!context->SupportsCompute())
  {
    vtkIdType count = 0;
    this->Read([&](const std::uint32_t* words)
      { count = vtkSlicemapImage::Count(words, this->GetNumberOfWords()); });
    return count;
  }
  try
  {
    auto& program = vtkVoxelGetProgram(context, "vtkSlicemapCount", {},
      { { GL_COMPUTE_SHADER, { vtkSlicemapLayoutGLSL, vtkSlicemapCountGLSL } } });
    program.Use();
    std::array<std::uint32_t, 2> count{ 0, 0 };
    vtkVoxelGL::Buffer result(context);
    result.Allocate(sizeof(count), count.data());
    result.BindBase(GL_SHADER_STORAGE_BUFFER, 0);
    const auto texture = vtkSlicemapTexture(this);
    texture.Bind(0);
    program.Set("Quads", 0);
    const auto quads = static_cast<unsigned int>(this->GetNumberOfWords() / WordsPerQuad);
    program.Set("NumberOfQuads", quads);
    constexpr unsigned int quadsAtOnce = 64;
    glDispatchCompute(std::min(quads / (64 * quadsAtOnce) + 1, 65535u), 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    result.Download(0, sizeof(count), count.data());
    return static_cast<vtkIdType>(std::uint64_t(count[1]) << 32 | count[0]);
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< error.what());
    return -1;
  }
}

bool vtkSlicemap::Combine(const vtkSlicemapExpression& expression, vtkSlicemap* other)
{
  if (other && !this->GetGrid().IsSameAs(other->GetGrid()))
  {
    vtkErrorMacro("The two slicemaps are on different grids: "
      << this->GetGrid().Describe() << " here, " << other->GetGrid().Describe()
      << " there. Voxelize both on one.");
    return false;
  }
  vtkVoxelContext::Scope scope(this->GetContext());
  if (!scope || !this->Storage->Buffer)
  {
    vtkErrorMacro("The slicemap has no bits to work on.");
    return false;
  }
  const auto context = this->GetContext()->GetRecord();
  if (other && (!other->Storage->Buffer || other->Storage->Buffer.GetContext() != context))
  {
    vtkErrorMacro("The other slicemap has no bits in this OpenGL context. Give both filters the "
                  "same render window.");
    return false;
  }
  try
  {
    vtkSlicemapExpressionPass::Run(expression, context, { this, other }, this);
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< error.what());
    return false;
  }
  this->Modified();
  return true;
}

bool vtkSlicemap::Union(vtkSlicemap* other)
{
  return this->Combine(vtkSlicemapExpression::Join('|', 2), other);
}

bool vtkSlicemap::Intersection(vtkSlicemap* other)
{
  return this->Combine(vtkSlicemapExpression::Join('&', 2), other);
}

bool vtkSlicemap::Difference(vtkSlicemap* other)
{
  return this->Combine(vtkSlicemapExpression::Join('-', 2), other);
}

bool vtkSlicemap::SymmetricDifference(vtkSlicemap* other)
{
  return this->Combine(vtkSlicemapExpression::Join('^', 2), other);
}

bool vtkSlicemap::Complement()
{
  return this->Combine(vtkSlicemapExpression::Complement(), nullptr);
}

void vtkSlicemap::CopyVoxels(vtkSlicemap* source, const std::array<int, 3>& offset)
{
  const vtkSlicemapKernel kernel("vtkSlicemapShift", vtkSlicemapShiftGLSL);
  const auto texture = vtkSlicemapTexture(source);
  const glm::ivec3 n = this->GetGrid().GetDimensions();
  const glm::ivec3 sourceSize = source->GetGrid().GetDimensions();
  kernel.Run(this->GetContext()->GetRecord(), this,
    [&](vtkVoxelGL::Program& program)
    {
      texture.Bind(0);
      program.Set("Source", 0);
      program.Set("SourceSize", std::array<int, 3>{ sourceSize.x, sourceSize.y, sourceSize.z });
      program.Set("SourceWordsPerRow", static_cast<unsigned int>(source->GetWordsPerRow()));
      program.Set("Size", std::array<int, 3>{ n.x, n.y, n.z });
      program.Set("Offset", offset);
    });
}

bool vtkSlicemap::Shift(int dx, int dy, int dz)
{
  vtkVoxelContext::Scope scope(this->GetContext());
  if (!scope || !this->Storage->Buffer)
  {
    vtkErrorMacro("The slicemap has no bits to work on.");
    return false;
  }
  vtkNew<vtkSlicemap> result;
  result->SetContext(this->GetContext());
  if (!result->Allocate(this->GetGrid()))
  {
    return false;
  }
  try
  {
    result->CopyVoxels(this, { dx, dy, dz });
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< error.what());
    return false;
  }
  this->Swap(result);
  return true;
}

bool vtkSlicemap::IsIn(vtkVoxelContext* context)
{
  const auto& buffer = this->Storage->Buffer;
  return buffer && buffer.GetContext() == context->GetRecord();
}

vtkSlicemap* vtkSlicemap::GetFromImage(vtkImageData* image)
{
  vtkInformation* information = image->GetInformation();
  auto* slicemap = vtkSlicemap::SafeDownCast(information->Get(SLICEMAP()));
  vtkDataArray* scalars = vtkSlicemapImage::GetScalars(image);
  const vtkIdType time = scalars ? static_cast<vtkIdType>(scalars->GetMTime()) : 0;
  if (!slicemap || information->Get(SCALARS_TIME()) != time)
  {
    return nullptr;
  }
  const auto grid = vtkVoxelGrid::FromImage(image);
  const bool isOnGrid =
    slicemap->GetGrid().IsSameAs(grid) || slicemap->GetGrid().VoxelsToCells().IsSameAs(grid);
  return isOnGrid ? slicemap : nullptr;
}

void vtkSlicemap::AttachTo(vtkImageData* image)
{
  vtkDataArray* scalars = vtkSlicemapImage::GetScalars(image);
  image->GetInformation()->Set(SLICEMAP(), this);
  image->GetInformation()->Set(
    SCALARS_TIME(), scalars ? static_cast<vtkIdType>(scalars->GetMTime()) : 0);
}

vtkIdType vtkSlicemap::GetNumberOfReadBacks()
{
  return ReadBacks;
}

vtkIdType vtkSlicemap::GetNumberOfUploads()
{
  return Uploads;
}

void vtkSlicemap::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Context: " << this->Storage->Context << "\n";
  os << indent << "Grid: " << this->Storage->Grid.Describe() << "\n";
  os << indent << "NumberOfBytes: " << this->GetNumberOfBytes() << "\n";
}
