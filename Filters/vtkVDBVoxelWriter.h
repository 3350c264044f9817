// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkVDBVoxelWriter
 * @brief writes voxels as sparse grids of OpenVDB
 *
 * Each input is a vtkImageData, which may carry a vtkSlicemap, or a vtkPolyData of points, such as
 * the voxel list of vtkHybridSurfaceVoxelizer. All grids of all inputs go into one .vdb file, with
 * their spacing, origin and direction matrix as transform; voxels keep their indices, so that index
 * (i, j, k) of the image is index (i, j, k) of the grid. Metadata "vtk_extent_min" and
 * "vtk_extent_max" hold the extent of the image, for vtkVDBVoxelReader.
 *
 * <b>Occupancy</b> of an image is its slicemap, or its array "Occupancy", or active scalars of type
 * VTK_BIT; that of a list is where its points are. It becomes a grid "Occupancy" of OccupancyGrid:
 *  - Bool (default): set voxels are active and true. The type that most tools read.
 *  - Mask: the same in half of the memory.
 *  - LevelSet: a narrow band of signed distances to the surface of the solid, in world units,
 *    negative inside, HalfBandWidth voxels to each side. A distance is that from the centre of the
 *    voxel to the nearest centre of the other kind, less half a voxel: right on average, and within
 *    half a voxel of the true one for surfaces that are smooth at the size of voxels. Voxels must
 *    be cubes.
 * Leaves (8^3 voxels) are filled from the bits, and what is full or empty becomes a tile; no
 * dense array lies between.
 *
 * <b>Other arrays</b> of the points of an image, or of its cells where the points have none, and of
 * the points of a list become a grid each, with the name of the array: float and double for these
 * types, int32 or int64 for integers, vec3 for three components; unsigned char of three or four
 * components are colours, and become vec3s of 0 to 1, without their alpha. Voxels of an image are
 * active where they differ from Background (vectors: from zero), the voxels of a list always. An
 * array "Density" becomes a fog volume.
 *
 * The format, and what an active voxel, a leaf and a tile are:
 *
 * Ken Museth: VDB: High-Resolution Sparse Volumes with Dynamic Topology. ACM Transactions on
 * Graphics 32(3), 2013, section 3.
 *
 * <b>Errors.</b> One error, and no file, or the former one as it was: no file name, an empty image,
 * no voxels, an array whose type or number of components no grid has, axes that are not at right
 * angles, a level set of voxels that are no cubes, points without a grid, a compression that
 * OpenVDB was built without, a file that can't be written, a full disk. GetErrorCode tells scripts.
 * An aborted write leaves no file either.
 *
 * Only where this module was built with OpenVDB.
 *
 * @sa vtkVDBVoxelReader vtkSlicemap
 */

#ifndef vtkVDBVoxelWriter_h
#define vtkVDBVoxelWriter_h

#include "vtkVoxelizationModule.h" // for export macro
#include "vtkWriter.h"

#include <map>    // for names and metadata
#include <set>    // for names of arrays
#include <string> // for names and metadata

class vtkImageData;

class VTKVOXELIZATION_EXPORT vtkVDBVoxelWriter : public vtkWriter
{
public:
  static vtkVDBVoxelWriter* New();
  vtkTypeMacro(vtkVDBVoxelWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum OccupancyGridType
  {
    GRID_BOOL = 0,
    GRID_MASK = 1,
    GRID_LEVEL_SET = 2
  };

  enum CompressionType
  {
    COMPRESSION_NONE = 0,
    COMPRESSION_ZIP = 1,
    COMPRESSION_BLOSC = 2
  };

  ///@{
  /**
   * The file to write. Default: none.
   */
  vtkSetStringMacro(FileName);
  vtkGetStringMacro(FileName);
  ///@}

  ///@{
  /**
   * Whether the file itself is written, for callers that see to a failure. When off (default) the
   * bytes go to FileName.part, which takes the name when it is complete.
   */
  vtkSetMacro(InPlace, bool);
  vtkGetMacro(InPlace, bool);
  vtkBooleanMacro(InPlace, bool);
  ///@}

  ///@{
  /**
   * What becomes of the occupancy; see the class description. Default: Bool.
   */
  vtkSetClampMacro(OccupancyGrid, int, GRID_BOOL, GRID_LEVEL_SET);
  vtkGetMacro(OccupancyGrid, int);
  void SetOccupancyGridToBool() { this->SetOccupancyGrid(GRID_BOOL); }
  void SetOccupancyGridToMask() { this->SetOccupancyGrid(GRID_MASK); }
  void SetOccupancyGridToLevelSet() { this->SetOccupancyGrid(GRID_LEVEL_SET); }
  ///@}

  ///@{
  /**
   * Half the width of the band of a level set, in voxels, 1 to 7. Default: 3.
   */
  vtkSetClampMacro(HalfBandWidth, double, 1.0, 7.0);
  vtkGetMacro(HalfBandWidth, double);
  ///@}

  ///@{
  /**
   * The value of grids of scalars where there is no voxel. Default: 0.
   */
  vtkSetMacro(Background, double);
  vtkGetMacro(Background, double);
  ///@}

  ///@{
  /**
   * How the values are compressed. Blosc is fast, Zip smaller; the bits of bool and mask grids are
   * stored as they are. Default: Blosc where OpenVDB was built with it, else Zip or None.
   */
  vtkSetClampMacro(Compression, int, COMPRESSION_NONE, COMPRESSION_BLOSC);
  vtkGetMacro(Compression, int);
  void SetCompressionToNone() { this->SetCompression(COMPRESSION_NONE); }
  void SetCompressionToZip() { this->SetCompression(COMPRESSION_ZIP); }
  void SetCompressionToBlosc() { this->SetCompression(COMPRESSION_BLOSC); }
  static bool IsCompressionAvailable(int compression);
  ///@}

  ///@{
  /**
   * The names of the arrays to write, "Occupancy" being that of the bits as well. Adding a name
   * twice changes nothing. Default: none, which writes all.
   */
  void AddArray(const char* name);
  void RemoveAllArrays();
  ///@}

  ///@{
  /**
   * A name for the grids of input i: the name of its only grid, or put before the names of its
   * arrays, with a point between. Null removes it. Default: none; where several grids have a name,
   * OpenVDB numbers them.
   */
  void SetInputName(int i, const char* name);
  const char* GetInputName(int i);
  ///@}

  ///@{
  /**
   * Metadata of the file: a text for a name. Default: "creator" is this module.
   */
  void SetMetadata(const char* name, const char* text);
  const char* GetMetadata(const char* name);
  void RemoveAllMetadata();
  ///@}

  ///@{
  /**
   * The grid of points that come without one, whose scalars don't matter. A list of voxels brings
   * its own in its field data. Default: none.
   */
  virtual void SetReferenceImage(vtkImageData* image);
  vtkGetObjectMacro(ReferenceImage, vtkImageData);
  ///@}

  /**
   * Number of active voxels of all grids that the last call of Write has written.
   */
  vtkGetMacro(NumberOfActiveVoxels, vtkTypeInt64);

protected:
  vtkVDBVoxelWriter();
  ~vtkVDBVoxelWriter() override;

  void WriteData() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkVDBVoxelWriter(const vtkVDBVoxelWriter&) = delete;
  void operator=(const vtkVDBVoxelWriter&) = delete;

  class Grids;

  char* FileName = nullptr;
  bool InPlace = false;
  int OccupancyGrid = GRID_BOOL;
  double HalfBandWidth = 3.0;
  double Background = 0.0;
  int Compression;
  std::set<std::string> Arrays;
  std::map<int, std::string> InputNames;
  std::map<std::string, std::string> Metadata;
  vtkImageData* ReferenceImage = nullptr;
  vtkTypeInt64 NumberOfActiveVoxels = 0;
};

#endif
