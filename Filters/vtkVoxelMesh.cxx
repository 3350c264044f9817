// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVoxelMesh.h"

#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkTriangleFilter.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkVoxelMeshDisplacement.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>

namespace
{
using Leaves = std::vector<vtkSmartPointer<vtkPolyData>>;

constexpr std::size_t BytesOfTriple = 12;
constexpr vtkIdType SampleSize = 2048;

/// OpenGL has no empty buffers.
std::size_t BytesOfTriples(std::size_t count)
{
  return std::max<std::size_t>(1, count) * BytesOfTriple;
}

/// Maps normals that have the length of an area.
glm::dmat3 GetCofactors(const glm::dmat4& worldToIndex)
{
  const glm::dmat3 linear(worldToIndex);
  return glm::determinant(linear) * glm::transpose(glm::inverse(linear));
}

vtkVoxelGL::Texture TextureOver(const vtkVoxelGL::Buffer& buffer, GLenum format)
{
  vtkVoxelGL::Texture texture(buffer.GetContext(), GL_TEXTURE_BUFFER);
  texture.AttachBuffer(format, buffer);
  return texture;
}

/// Triangles of cells with three points each, by whole arrays; false when there are others.
template <typename IdArray>
bool CopyTriangles(
  vtkCellArray* cells, std::uint32_t firstPoint, vtkIdType numberOfPoints, std::uint32_t* out)
{
  auto* connectivity = IdArray::FastDownCast(cells->GetConnectivityArray());
  auto* offsets = IdArray::FastDownCast(cells->GetOffsetsArray());
  if (!connectivity || !offsets)
  {
    return false;
  }
  const auto* ids = connectivity->GetPointer(0);
  const auto* starts = offsets->GetPointer(0);
  std::atomic<bool> onlyTriangles{ true };
  std::atomic<bool> valid{ true };
  vtkSMPTools::For(0, cells->GetNumberOfCells(),
    [&](vtkIdType begin, vtkIdType end)
    {
      using Id = typename IdArray::ValueType;
      Id misplaced = 0;
      for (vtkIdType cell = begin; cell <= end; ++cell)
      {
        misplaced |= starts[cell] ^ static_cast<Id>(3 * cell);
      }
      if (misplaced)
      {
        onlyTriangles = false;
        return;
      }
      bool inside = true;
      for (vtkIdType i = 3 * begin; i < 3 * end; ++i)
      {
        inside = inside &
          (static_cast<std::uint64_t>(ids[i]) < static_cast<std::uint64_t>(numberOfPoints));
        out[i] = static_cast<std::uint32_t>(ids[i]) + firstPoint;
      }
      if (!inside)
      {
        valid = false;
      }
    });
  if (!valid)
  {
    throw std::runtime_error("A polygon of the input refers to a point that does not exist. Check "
                             "what made the mesh.");
  }
  return onlyTriangles;
}

/// Calls add(a, b, c) for the triangles of any cells, fans for polygons.
template <typename Add>
void VisitTriangles(vtkCellArray* cells, bool strips, vtkIdType numberOfPoints, Add&& add)
{
  vtkNew<vtkIdList> cell;
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
  {
    cells->GetCellAtId(i, cell);
    const vtkIdType* p = cell->GetPointer(0);
    const vtkIdType n = cell->GetNumberOfIds();
    for (vtkIdType j = 0; j < n; ++j)
    {
      if (p[j] < 0 || p[j] >= numberOfPoints)
      {
        throw std::runtime_error("A polygon of the input refers to a point that does not exist. "
                                 "Check what made the mesh.");
      }
    }
    for (vtkIdType j = 2; j < n; ++j)
    {
      if (!strips)
      {
        add(p[0], p[j - 1], p[j]);
      }
      else if (j % 2 == 0)
      {
        add(p[j - 2], p[j - 1], p[j]);
      }
      else
      {
        add(p[j - 1], p[j - 2], p[j]);
      }
    }
  }
}

void TriangulateExactly(Leaves& leaves)
{
  for (auto& leaf : leaves)
  {
    vtkNew<vtkTriangleFilter> triangulate;
    triangulate->PassVertsOff();
    triangulate->PassLinesOff();
    triangulate->SetInputData(leaf);
    triangulate->Update();
    leaf = triangulate->GetOutput();
  }
}

bool MayBeTriangles(vtkCellArray* cells)
{
  return cells->GetNumberOfConnectivityIds() == 3 * cells->GetNumberOfCells();
}

/// A cell of n points makes n - 2 triangles; those of less than three make none.
vtkIdType CountTriangles(vtkCellArray* cells)
{
  vtkIdType count = 0;
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
  {
    count += std::max<vtkIdType>(0, cells->GetCellSize(i) - 2);
  }
  return count;
}
}

Leaves vtkVoxelMesh::GetLeaves(vtkDataObject* input)
{
  Leaves leaves;
  const auto add = [&leaves](vtkDataObject* object)
  {
    auto* mesh = vtkPolyData::SafeDownCast(object);
    if (mesh && mesh->GetPoints())
    {
      leaves.emplace_back(mesh);
    }
  };
  add(input);
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(input))
  {
    const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      add(iterator->GetCurrentDataObject());
    }
  }
  return leaves;
}

bool vtkVoxelMesh::GetBounds(vtkDataObject* input, double bounds[6])
{
  vtkBoundingBox box;
  for (const auto& leaf : GetLeaves(input))
  {
    if (leaf->GetNumberOfPoints() > 0)
    {
      box.AddBounds(leaf->GetBounds());
    }
  }
  box.GetBounds(bounds);
  return box.IsValid() != 0;
}

std::vector<vtkVoxelMesh::Identity> vtkVoxelMesh::Identify(vtkDataObject* input)
{
  std::vector<Identity> identities;
  for (const auto& leaf : GetLeaves(input))
  {
    vtkCellArray* polygons = leaf->GetPolys();
    vtkCellArray* strips = leaf->GetStrips();
    identities.push_back({ leaf->GetPoints()->GetData(), polygons, strips,
      std::max({ leaf->GetPoints()->GetMTime(), leaf->GetPoints()->GetData()->GetMTime(),
        polygons->GetMTime(), strips->GetMTime() }) });
  }
  return identities;
}

void vtkVoxelMesh::Update(
  const vtkVoxelGL::Context& context, vtkDataObject* input, Triangulation triangulation)
{
  Leaves leaves = GetLeaves(input);
  const std::vector<Identity> identities = Identify(input);
  const bool onlyTriangles = std::all_of(leaves.begin(), leaves.end(),
    [](const auto& leaf) { return MayBeTriangles(leaf->GetPolys()); });
  const bool present = this->Context == context && this->Points && this->Triangles &&
    this->Uploaded == identities && (this->UploadedAs == triangulation || onlyTriangles);
  if (present)
  {
    return;
  }

  this->Uploaded.clear();
  this->Context = context;
  this->IsTriangulated = triangulation == Triangulation::Exact && !onlyTriangles;
  if (this->IsTriangulated)
  {
    TriangulateExactly(leaves);
  }
  this->UploadPoints(leaves);
  this->UploadTriangles(leaves, true);
  this->SampleAreas(leaves);
  ++this->NumberOfUploads;
  this->Uploaded = identities;
  this->UploadedAs = triangulation;
}

void vtkVoxelMesh::VisitLeaves(vtkDataObject* input,
  const std::function<void(vtkPolyData* leaf, const std::vector<vtkIdType>& cellsOfTriangles)>&
    visit) const
{
  Leaves leaves = GetLeaves(input);
  if (this->IsTriangulated)
  {
    TriangulateExactly(leaves);
  }
  for (const auto& leaf : leaves)
  {
    std::vector<vtkIdType> cellsOfTriangles;
    vtkIdType cell = leaf->GetNumberOfVerts() + leaf->GetNumberOfLines();
    for (vtkCellArray* cells : { leaf->GetPolys(), leaf->GetStrips() })
    {
      for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i, ++cell)
      {
        const vtkIdType triangles = std::max<vtkIdType>(0, cells->GetCellSize(i) - 2);
        cellsOfTriangles.insert(cellsOfTriangles.end(), triangles, cell);
      }
    }
    visit(leaf, cellsOfTriangles);
  }
}

void vtkVoxelMesh::UploadPoints(const Leaves& leaves)
{
  std::size_t total = 0;
  bool needsLow = false;
  for (const auto& leaf : leaves)
  {
    total += leaf->GetNumberOfPoints();
    needsLow = needsLow || !vtkFloatArray::FastDownCast(leaf->GetPoints()->GetData());
  }
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
  if (total > std::size_t(limit))
  {
    throw std::runtime_error("The input has " + std::to_string(total) + " points; " +
      this->Context->GetRendererName() + " takes " + std::to_string(limit) +
      ". Voxelize the mesh in parts and combine the results by exclusive or.");
  }
  vtkVoxelGL::Prepare(this->Points, this->Context, BytesOfTriples(total));
  // Not a vector, which would write zeros first.
  const std::unique_ptr<float[]> low(needsLow ? new float[3 * total] : nullptr);
  std::atomic<bool> finite{ true };
  std::atomic<bool> lowUsed{ false };
  double largest = 0.0;
  {
    const vtkVoxelGL::MappedBuffer mapped(
      this->Points, 0, this->Points.GetSize(), GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    auto* high = static_cast<float*>(mapped.Get());
    if (!high)
    {
      throw std::runtime_error("OpenGL could not map a buffer for the points of the mesh.");
    }
    std::size_t first = 0;
    for (const auto& leaf : leaves)
    {
      vtkDataArray* points = leaf->GetPoints()->GetData();
      const vtkIdType n = points->GetNumberOfTuples();
      std::atomic<float> largestOfLeaf{ 0.0f };
      const auto note = [&](float sum, float most)
      {
        // A sum of products with zero is zero unless something is not finite.
        if (sum != 0.0f)
        {
          finite = false;
        }
        float known = largestOfLeaf;
        while (most > known && !largestOfLeaf.compare_exchange_weak(known, most))
        {
        }
      };
      if (auto* floats = vtkFloatArray::FastDownCast(points))
      {
        const float* in = floats->GetPointer(0);
        vtkSMPTools::For(0, 3 * n,
          [&](vtkIdType begin, vtkIdType end)
          {
            std::memcpy(high + 3 * first + begin, in + begin, (end - begin) * sizeof(float));
            if (low)
            {
              std::fill_n(low.get() + 3 * first + begin, end - begin, 0.0f);
            }
            float sum = 0.0f;
            float most = 0.0f;
            for (vtkIdType i = begin; i < end; ++i)
            {
              sum += in[i] * 0.0f;
              most = std::max(most, std::abs(in[i]));
            }
            note(sum, most);
          });
      }
      else
      {
        auto* doubleArray = vtkDoubleArray::FastDownCast(points);
        const double* doubles = doubleArray ? doubleArray->GetPointer(0) : nullptr;
        vtkSMPTools::For(0, n,
          [&](vtkIdType begin, vtkIdType end)
          {
            float sum = 0.0f;
            float most = 0.0f;
            bool used = false;
            double tuple[3];
            for (vtkIdType i = begin; i < end; ++i)
            {
              const double* p = doubles ? doubles + 3 * i : tuple;
              if (!doubles)
              {
                points->GetTuple(i, tuple);
              }
              for (int axis = 0; axis < 3; ++axis)
              {
                const auto rounded = static_cast<float>(p[axis]);
                const auto rest = static_cast<float>(p[axis] - rounded);
                high[3 * (first + i) + axis] = rounded;
                low[3 * (first + i) + axis] = rest;
                sum += rounded * 0.0f;
                most = std::max(most, std::abs(rounded));
                used = used || rest != 0.0f;
              }
            }
            note(sum, most);
            if (used)
            {
              lowUsed = true;
            }
          });
      }
      largest = std::max<double>(largest, largestOfLeaf);
      first += n;
    }
  }
  if (!finite)
  {
    throw std::runtime_error("The input has points that are NaN, infinite or beyond the range of "
                             "floats. Remove them, for instance with vtkCleanPolyData after "
                             "replacing their coordinates.");
  }
  this->LowPoints = lowUsed;
  if (this->LowPoints)
  {
    vtkVoxelGL::Prepare(this->PointsLow, this->Context, BytesOfTriples(total));
    this->PointsLow.Upload(0, 3 * total * sizeof(float), low.get());
    this->PointsLowTexture = TextureOver(this->PointsLow, GL_RGB32F);
  }
  this->PointsTexture = TextureOver(this->Points, GL_RGB32F);
  this->NumberOfPoints = static_cast<std::uint32_t>(total);
  this->LargestCoordinate = largest;
}

void vtkVoxelMesh::UploadTriangles(const Leaves& leaves, bool expectTriangles)
{
  std::size_t total = 0;
  for (const auto& leaf : leaves)
  {
    vtkCellArray* polygons = leaf->GetPolys();
    total += expectTriangles && MayBeTriangles(polygons) ? polygons->GetNumberOfCells()
                                                         : CountTriangles(polygons);
    total += CountTriangles(leaf->GetStrips());
  }
  if (total == 0)
  {
    throw std::runtime_error("The input has no polygons, so there is nothing to voxelize. Vertices "
                             "and lines don't count; extract the surface of volume meshes first.");
  }
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
  if (total > std::size_t(limit))
  {
    throw std::runtime_error("The input has " + std::to_string(total) + " triangles; " +
      this->Context->GetRendererName() + " takes " + std::to_string(limit) +
      ". Voxelize the mesh in parts and combine the results by exclusive or.");
  }
  vtkVoxelGL::Prepare(this->Triangles, this->Context, BytesOfTriples(total));
  bool onlyTriangles = true;
  {
    const vtkVoxelGL::MappedBuffer mapped(this->Triangles, 0, this->Triangles.GetSize(),
      GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    auto* out = static_cast<std::uint32_t*>(mapped.Get());
    if (!out)
    {
      throw std::runtime_error("OpenGL could not map a buffer for the triangles of the mesh.");
    }
    std::uint32_t firstPoint = 0;
    for (const auto& leaf : leaves)
    {
      const vtkIdType points = leaf->GetNumberOfPoints();
      const auto add = [&](vtkIdType a, vtkIdType b, vtkIdType c)
      {
        for (const vtkIdType id : { a, b, c })
        {
          *out++ = static_cast<std::uint32_t>(id) + firstPoint;
        }
      };
      vtkCellArray* polygons = leaf->GetPolys();
      if (expectTriangles && MayBeTriangles(polygons))
      {
        if (!CopyTriangles<vtkTypeInt64Array>(polygons, firstPoint, points, out) &&
          !CopyTriangles<vtkTypeInt32Array>(polygons, firstPoint, points, out))
        {
          onlyTriangles = false;
          break;
        }
        out += 3 * polygons->GetNumberOfCells();
      }
      else
      {
        VisitTriangles(polygons, false, points, add);
      }
      VisitTriangles(leaf->GetStrips(), true, points, add);
      firstPoint += static_cast<std::uint32_t>(points);
    }
  }
  if (!onlyTriangles)
  {
    // Three points a cell on average, but not in each.
    this->UploadTriangles(leaves, false);
    return;
  }
  this->TrianglesTexture = TextureOver(this->Triangles, GL_RGB32UI);
  this->NumberOfTriangles = static_cast<std::uint32_t>(total);
}

void vtkVoxelMesh::SampleAreas(const Leaves& leaves)
{
  this->SampledNormals.clear();
  vtkIdType cells = 0;
  for (const auto& leaf : leaves)
  {
    cells += leaf->GetNumberOfPolys() + leaf->GetNumberOfStrips();
  }
  const vtkIdType stride = std::max<vtkIdType>(1, cells / SampleSize);
  vtkNew<vtkIdList> cell;
  for (const auto& leaf : leaves)
  {
    for (vtkCellArray* polygons : { leaf->GetPolys(), leaf->GetStrips() })
    {
      for (vtkIdType i = 0; i < polygons->GetNumberOfCells(); i += stride)
      {
        polygons->GetCellAtId(i, cell);
        for (vtkIdType j = 2; j < cell->GetNumberOfIds(); ++j)
        {
          glm::dvec3 p[3];
          leaf->GetPoint(cell->GetId(j - 2), &p[0][0]);
          leaf->GetPoint(cell->GetId(j - 1), &p[1][0]);
          leaf->GetPoint(cell->GetId(j), &p[2][0]);
          this->SampledNormals.push_back(0.5 * glm::cross(p[1] - p[0], p[2] - p[0]));
        }
      }
    }
  }
  this->AreaOfSample = static_cast<double>(stride);
}

double vtkVoxelMesh::EstimateLargestArea(const glm::dmat4& worldToIndex) const
{
  const glm::dmat3 cofactors = GetCofactors(worldToIndex);
  double largest = 0.0;
  for (const glm::dvec3& normal : this->SampledNormals)
  {
    const glm::dvec3 area = glm::abs(cofactors * normal);
    largest = std::max({ largest, area.x, area.y, area.z });
  }
  return 2.0 * largest;
}

glm::dvec3 vtkVoxelMesh::EstimateProjectedAreas(const glm::dmat4& worldToIndex) const
{
  const glm::dmat3 cofactors = GetCofactors(worldToIndex);
  glm::dvec3 areas(0.0);
  for (const glm::dvec3& normal : this->SampledNormals)
  {
    areas += glm::abs(cofactors * normal);
  }
  return this->AreaOfSample * areas;
}

double vtkVoxelMesh::GetLargestCoordinate() const
{
  return this->LargestCoordinate + (this->Displacement ? this->Displacement->GetLargest() : 0.0);
}

vtkVoxelGL::Program::Defines vtkVoxelMesh::GetDefines() const
{
  vtkVoxelGL::Program::Defines defines;
  if (this->LowPoints)
  {
    defines["POINTS_ARE_DOUBLE"] = "1";
  }
  if (this->Displacement)
  {
    defines.merge(this->Displacement->GetDefines());
  }
  return defines;
}

void vtkVoxelMesh::Bind(vtkVoxelGL::Program& program, unsigned int unit) const
{
  this->TrianglesTexture.Bind(unit);
  program.Set("Triangles", static_cast<int>(unit));
  this->PointsTexture.Bind(unit + 1);
  program.Set("Points", static_cast<int>(unit + 1));
  if (this->LowPoints)
  {
    this->PointsLowTexture.Bind(unit + 2);
    program.Set("PointsLow", static_cast<int>(unit + 2));
  }
  if (this->Displacement)
  {
    this->Displacement->Bind(program, unit + 3);
  }
  program.Set("FirstTriangle", 0u);
  program.Set("NumberOfTriangles", this->NumberOfTriangles);
}
