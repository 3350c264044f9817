// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVDBVoxelWriter.h"

#include "vtkBitArray.h"
#include "vtkCellData.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkImageVoxels.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkNewVoxelFile.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSlicemapImage.h"
#include "vtkVDBArrays.h"
#include "vtkVDBGridFiller.h"
#include "vtkVDBLattice.h"
#include "vtkVDBLevelSet.h"
#include "vtkVDBNewGrid.h"
#include "vtkVDBOutput.h"
#include "vtkVoxelFileError.h"
#include "vtkVoxelGrid.h"

#include <openvdb/io/Archive.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <new>
#include <vector>

namespace
{
using GridPtr = openvdb::GridBase::Ptr;
using Watcher = std::function<bool(double)>;

constexpr char IndexName[] = "VoxelIndex";
constexpr char DensityName[] = "Density";
constexpr double ShareOfMaking = 0.7; // of the progress

struct Aborted
{
};

[[noreturn]] void Refuse(const std::string& what)
{
  throw vtkVoxelFileError(vtkErrorCode::UserError, what);
}

/// The points of a list as voxels.
struct VoxelList
{
  VoxelList(vtkPolyData* points, vtkImageData* reference)
    : Lattice(reference ? vtkVoxelGrid::FromImage(reference)
                        : vtkVoxelGrid::FromFieldData(points->GetFieldData()))
  {
    if (this->Lattice.IsEmpty())
    {
      Refuse("The points have no grid of voxels. Take them from vtkHybridSurfaceVoxelizer, or call "
             "SetReferenceImage.");
    }
    this->Voxels.reserve(points->GetNumberOfPoints());
    auto* indices = vtkIntArray::SafeDownCast(points->GetPointData()->GetArray(IndexName));
    if (indices && indices->GetNumberOfComponents() == 3)
    {
      for (vtkIdType i = 0; i < indices->GetNumberOfTuples(); ++i)
      {
        int voxel[3];
        indices->GetTypedTuple(i, voxel);
        this->Voxels.emplace_back(voxel[0], voxel[1], voxel[2]);
      }
      return;
    }
    const glm::dmat4 worldToIndex = this->Lattice.GetWorldToIndex();
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
    {
      glm::dvec3 point;
      points->GetPoint(i, &point[0]);
      const glm::dvec3 voxel(worldToIndex * glm::dvec4(point, 1.0));
      constexpr double farthest = VTK_INT_MAX / 2;
      if (!glm::all(glm::lessThan(glm::abs(voxel), glm::dvec3(farthest))))
      {
        Refuse("Point " + std::to_string(i) + " is not finite, or too far away for the grid of " +
          this->Lattice.Describe() + ".");
      }
      this->Voxels.emplace_back(static_cast<int>(std::lround(voxel.x)),
        static_cast<int>(std::lround(voxel.y)), static_cast<int>(std::lround(voxel.z)));
    }
  }

  vtkVoxelGrid Lattice;
  std::vector<openvdb::Coord> Voxels;
};

template <typename Tree>
void Fill(Tree& tree, const vtkImageVoxels& voxels, const Watcher& progress)
{
  vtkVDBGridFiller<Tree> filler(tree);
  voxels.Read([&](const std::uint32_t* words) { filler.AddLayers(words, voxels.Grid, progress); });
  filler.Finish();
}

template <typename Tree>
void Fill(Tree& tree, const VoxelList& list, const Watcher&)
{
  openvdb::tree::ValueAccessor<Tree> accessor(tree);
  for (const openvdb::Coord& voxel : list.Voxels)
  {
    accessor.setValueOn(voxel, true);
  }
  openvdb::tools::prune(tree);
}
}

/// The grids of the inputs, in their order.
class vtkVDBVoxelWriter::Grids
{
public:
  Grids(vtkVDBVoxelWriter* writer, Watcher progress)
    : Writer(writer)
    , Report(std::move(progress))
  {
    const int count = writer->GetNumberOfInputConnections(0);
    for (int i = 0; i < count; ++i)
    {
      this->First = this->All.size();
      this->Begin = double(i) / count;
      this->Share = 1.0 / count;
      vtkDataObject* input = writer->GetInputDataObject(0, i);
      if (auto* image = vtkImageData::SafeDownCast(input))
      {
        this->AddImage(image);
      }
      else if (auto* points = vtkPolyData::SafeDownCast(input))
      {
        this->AddList(points);
      }
      this->NameAll(writer->GetInputName(i));
    }
    if (this->All.empty())
    {
      Refuse("The inputs have none of the arrays named by AddArray.");
    }
  }

  const std::vector<GridPtr>& Get() const { return this->All; }

private:
  bool IsWanted(const std::string& name) const
  {
    return this->Writer->Arrays.empty() || this->Writer->Arrays.count(name) > 0;
  }

  void Advance(double fraction) const
  {
    if (!this->Report(this->Begin + this->Share * fraction))
    {
      throw Aborted();
    }
  }

  Watcher GetProgress() const
  {
    return [this](double fraction)
    {
      this->Advance(fraction);
      return true;
    };
  }

  void Add(const GridPtr& grid, const std::string& name, const vtkVoxelGrid& lattice)
  {
    grid->setName(name);
    vtkVDBLattice::ApplyTo(lattice, *grid);
    this->All.push_back(grid);
  }

  template <typename Source>
  void AddOccupancy(const Source& source, const vtkVoxelGrid& lattice)
  {
    GridPtr grid;
    if (this->Writer->OccupancyGrid == GRID_BOOL)
    {
      grid = this->MakeBits<openvdb::BoolGrid>(source);
    }
    else if (this->Writer->OccupancyGrid == GRID_MASK)
    {
      grid = this->MakeBits<openvdb::MaskGrid>(source);
    }
    else
    {
      vtkVDBLevelSet::Check(lattice);
      const auto solid = this->MakeBits<openvdb::MaskGrid>(source);
      grid = vtkVDBLevelSet::Make(solid->constTree(), std::abs(lattice.Spacing.x),
        this->Writer->HalfBandWidth, this->GetProgress());
    }
    this->Add(grid, vtkSlicemapImage::ArrayName, lattice);
  }

  template <typename Grid, typename Source>
  typename Grid::Ptr MakeBits(const Source& source) const
  {
    const auto grid = vtkVDBNewGrid<Grid>();
    Fill(grid->tree(), source, this->GetProgress());
    return grid;
  }

  GridPtr MakeGrid(vtkDataArray* array) const
  {
    const GridPtr grid = vtkVDBArrays::MakeGrid(array, this->Writer->Background);
    if (!grid)
    {
      Refuse("The array \"" + this->GetName(array) + "\" of " +
        std::to_string(array->GetNumberOfComponents()) + " components of type " +
        array->GetDataTypeAsString() +
        " fits into no grid of OpenVDB. Name those to write by AddArray, or convert it.");
    }
    if (this->GetName(array) == DensityName)
    {
      grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    }
    return grid;
  }

  static std::string GetName(vtkDataArray* array)
  {
    const char* name = array->GetName();
    return name ? name : "Scalars";
  }

  void AddImage(vtkImageData* image)
  {
    const vtkImageVoxels voxels(image);
    vtkDataArray* occupancy = nullptr; // array that the bits stand for
    if (voxels.Slicemap || this->IsOccupancy(voxels.Scalars))
    {
      voxels.Check();
      occupancy = voxels.Scalars;
      if (this->IsWanted(vtkSlicemapImage::ArrayName))
      {
        this->AddOccupancy(voxels, voxels.Grid);
      }
    }
    const bool areCells = image->GetPointData()->GetNumberOfArrays() == 0;
    vtkFieldData* arrays = areCells ? static_cast<vtkFieldData*>(image->GetCellData())
                                    : static_cast<vtkFieldData*>(image->GetPointData());
    vtkVoxelGrid lattice = vtkVoxelGrid::FromImage(image);
    if (areCells)
    {
      lattice = lattice.CellsToVoxels();
    }
    int numberOfArrays = 0;
    for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = arrays->GetArray(i);
      if (array)
      {
        ++numberOfArrays;
      }
      if (array && array != occupancy && this->IsWanted(GetName(array)))
      {
        this->AddImageArray(array, lattice);
      }
    }
    if (numberOfArrays == 0 && !voxels.Slicemap)
    {
      voxels.Check();
    }
  }

  void AddImageArray(vtkDataArray* array, const vtkVoxelGrid& lattice)
  {
    if (array->GetNumberOfTuples() != lattice.GetNumberOfVoxels() || lattice.IsEmpty())
    {
      Refuse("The array \"" + GetName(array) + "\" of the image has " +
        std::to_string(array->GetNumberOfTuples()) + " values, but its " + lattice.Describe() +
        " takes " + std::to_string(lattice.GetNumberOfVoxels()) + ".");
    }
    const GridPtr grid = this->MakeGrid(array);
    vtkVDBArrays::FillImage(array, lattice, *grid, this->GetProgress());
    this->Add(grid, GetName(array), lattice);
  }

  static bool IsOccupancy(vtkDataArray* scalars)
  {
    return scalars && scalars->GetNumberOfComponents() == 1 &&
      (vtkBitArray::SafeDownCast(scalars) || GetName(scalars) == vtkSlicemapImage::ArrayName);
  }

  void AddList(vtkPolyData* points)
  {
    const VoxelList list(points, this->Writer->ReferenceImage);
    if (this->IsWanted(vtkSlicemapImage::ArrayName))
    {
      this->AddOccupancy(list, list.Lattice);
    }
    vtkPointData* arrays = points->GetPointData();
    for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = arrays->GetArray(i);
      if (array && GetName(array) != IndexName && this->IsWanted(GetName(array)))
      {
        const GridPtr grid = this->MakeGrid(array);
        vtkVDBArrays::FillList(array, list.Voxels, *grid);
        this->Add(grid, GetName(array), list.Lattice);
      }
    }
  }

  void NameAll(const char* name)
  {
    const bool isOnly = this->All.size() == this->First + 1;
    for (std::size_t i = this->First; name && i < this->All.size(); ++i)
    {
      this->All[i]->setName(isOnly ? name : std::string(name) + "." + this->All[i]->getName());
    }
  }

  vtkVDBVoxelWriter* Writer;
  Watcher Report;
  double Begin = 0.0;
  double Share = 1.0;
  std::size_t First = 0; // of the input
  std::vector<GridPtr> All;
};

vtkStandardNewMacro(vtkVDBVoxelWriter);
vtkCxxSetObjectMacro(vtkVDBVoxelWriter, ReferenceImage, vtkImageData);

vtkVDBVoxelWriter::vtkVDBVoxelWriter()
  : Compression(vtkVDBOutput::GetDefaultCompression())
  , Metadata(vtkVDBOutput::GetDefaultMetadata())
{
}

vtkVDBVoxelWriter::~vtkVDBVoxelWriter()
{
  this->SetFileName(nullptr);
  this->SetReferenceImage(nullptr);
}

bool vtkVDBVoxelWriter::IsCompressionAvailable(int compression)
{
  switch (compression)
  {
    case COMPRESSION_BLOSC:
      return openvdb::io::Archive::hasBloscCompression();
    case COMPRESSION_ZIP:
      return openvdb::io::Archive::hasZLibCompression();
    default:
      return compression == COMPRESSION_NONE;
  }
}

void vtkVDBVoxelWriter::AddArray(const char* name)
{
  if (name && this->Arrays.insert(name).second)
  {
    this->Modified();
  }
}

void vtkVDBVoxelWriter::RemoveAllArrays()
{
  if (!this->Arrays.empty())
  {
    this->Arrays.clear();
    this->Modified();
  }
}

void vtkVDBVoxelWriter::SetInputName(int i, const char* name)
{
  if (name && *name)
  {
    this->InputNames[i] = name;
  }
  else
  {
    this->InputNames.erase(i);
  }
  this->Modified();
}

const char* vtkVDBVoxelWriter::GetInputName(int i)
{
  const auto found = this->InputNames.find(i);
  return found == this->InputNames.end() ? nullptr : found->second.c_str();
}

void vtkVDBVoxelWriter::SetMetadata(const char* name, const char* text)
{
  if (name && *name)
  {
    this->Metadata[name] = text ? text : "";
    this->Modified();
  }
}

const char* vtkVDBVoxelWriter::GetMetadata(const char* name)
{
  const auto found = this->Metadata.find(name ? name : "");
  return found == this->Metadata.end() ? nullptr : found->second.c_str();
}

void vtkVDBVoxelWriter::RemoveAllMetadata()
{
  this->Metadata.clear();
  this->Modified();
}

int vtkVDBVoxelWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return 1;
}

void vtkVDBVoxelWriter::WriteData()
{
  this->NumberOfActiveVoxels = 0;
  const auto progress = [this](double fraction)
  {
    this->UpdateProgress(fraction);
    return this->GetAbortExecute() == 0;
  };
  try
  {
    if (!IsCompressionAvailable(this->Compression))
    {
      Refuse("OpenVDB was built without this compression. Choose another one.");
    }
    openvdb::initialize();
    vtkNewVoxelFile file(this->FileName, this->InPlace);
    const Grids grids(this, [&](double fraction) { return progress(ShareOfMaking * fraction); });
    const bool written = vtkVDBOutput::Write(file, grids.Get(), this->Metadata, this->Compression,
      [&](double fraction) { return progress(ShareOfMaking + (1.0 - ShareOfMaking) * fraction); });
    if (!written)
    {
      return;
    }
    file.Commit();
    for (const GridPtr& grid : grids.Get())
    {
      this->NumberOfActiveVoxels += static_cast<vtkTypeInt64>(grid->activeVoxelCount());
    }
  }
  catch (const Aborted&)
  {
  }
  catch (const vtkVoxelFileError& error)
  {
    this->SetErrorCode(error.Code);
    vtkErrorMacro(<< error.what());
  }
  catch (const std::bad_alloc&)
  {
    this->SetErrorCode(vtkErrorCode::UserError);
    vtkErrorMacro("There is no memory for the grids of the file.");
  }
  catch (const std::exception& error)
  {
    this->SetErrorCode(vtkErrorCode::UserError);
    vtkErrorMacro("OpenVDB could not write the file: " << error.what());
  }
}

void vtkVDBVoxelWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "InPlace: " << this->InPlace << "\n";
  os << indent << "OccupancyGrid: " << this->OccupancyGrid << "\n";
  os << indent << "HalfBandWidth: " << this->HalfBandWidth << "\n";
  os << indent << "Background: " << this->Background << "\n";
  os << indent << "Compression: " << this->Compression << "\n";
  os << indent << "Arrays:" << (this->Arrays.empty() ? " (all)" : "");
  for (const std::string& name : this->Arrays)
  {
    os << " \"" << name << "\"";
  }
  os << "\n" << indent << "InputNames:";
  for (const auto& [i, name] : this->InputNames)
  {
    os << " " << i << ": \"" << name << "\"";
  }
  os << "\n" << indent << "Metadata:";
  for (const auto& [name, text] : this->Metadata)
  {
    os << " " << name << ": \"" << text << "\"";
  }
  os << "\n" << indent << "ReferenceImage: " << this->ReferenceImage << "\n";
  os << indent << "NumberOfActiveVoxels: " << this->NumberOfActiveVoxels << "\n";
}
