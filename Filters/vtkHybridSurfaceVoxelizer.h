// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkHybridSurfaceVoxelizer
 * @brief the voxels of surfaces, thick or thin, with attributes, dense or sparse
 *
 * Voxelizes any triangles, strips and polygons, open or closed, without gaps, by an exact test of
 * triangles against voxels. The method is that of
 *
 * Randall Rauwendaal: Hybrid Computational Voxelization Using the Graphics Pipeline. Master's
 * thesis, Oregon State University, 2012; chapter 3: overlap test and its factorization, 3.1 to 3.3
 * the three strategies, 3.4 voxel lists, 3.5 attributes.
 *
 * <b>Separability.</b> 26 (default) sets every voxel, a closed cube, that a triangle touches; no
 * path of voxels that share a corner passes through a closed surface. None is missed, and none
 * farther than 1e-5 voxel from a triangle is added. 6 sets a thin surface, which stops only paths
 * of voxels that share a face: the voxel overlaps the bounds of the triangle, its centre lies
 * within half a voxel of the plane along the axis closest to the normal, and in all three
 * projections within half a voxel of the triangle's inside, along the axis closest to the edge's
 * normal.
 *
 * <b>Strategy.</b> Triangle has one invocation a triangle, which is best for small ones; those that
 * cover more than 8,192 columns of voxels are spread all the same. Fragment spreads each triangle
 * over many: tiles of equal size with the Compute backend, fragments of the dilated triangle, seen
 * along the axis closest to its normal, with the Raster backend. Hybrid does triangles whose bounds
 * cover at most CutoffArea columns of voxels at once and defers the others. The result is the same
 * bit for bit; Auto is Hybrid.
 *
 * <b>Attributes.</b> Arrays of points or cells named by AddAttribute, and the colours of a texture
 * image, are carried over to the voxels. A triangle has in a voxel the value at its point nearest
 * to the voxel's centre, in index coordinates, by its barycentric coordinates there. Values of all
 * triangles in a voxel are combined by AttributeCombination; the order of the triangles on the GPU
 * does not matter, two runs give identical results. Results are float, and unsigned char for
 * colours of three or more unsigned char. Values are single precision;
 * beyond that, averages are exact to 1e-6 of the array's range.
 *
 * <b>Output ports.</b>
 *  - 0: vtkImageData, as of all voxelizers (see vtkVoxelizer); attributes are further arrays, zero
 *    in voxels that are not set. Boolean operations and the like see the occupancy only.
 *  - 1: vtkPolyData, a vertex for the centre of each set voxel, ordered with x fastest, with the
 *    point array "VoxelIndex" of three ints (i, j, k) and the attributes. Its field data tell the
 *    grid: "VoxelExtent", "VoxelSpacing", "VoxelOrigin" and "VoxelDirection" (row by row).
 *  - 2: vtkHyperTreeGrid, an octree whose leaves at the deepest level are the set voxels; what lies
 *    between is masked. The grid must not be rotated.
 * Ports 1 and 2 are worked out in slabs and never make a dense array, so that 2048^3 voxels and
 * more are possible. Each port is worked out when it is asked for; update extents and
 * OutputScalarType are those of port 0.
 *
 * <b>Errors</b> are those of vtkVoxelizer, and: no OpenGL 4.3 (vtkSlicemapSolidVoxelizer with mode
 * Boundary needs 3.2 only); an attribute that is missing, is not numeric, has the wrong length or
 * values that are not finite; a rotated grid at port 2.
 *
 * @sa vtkSlicemapSolidVoxelizer
 */

#ifndef vtkHybridSurfaceVoxelizer_h
#define vtkHybridSurfaceVoxelizer_h

#include "vtkVoxelizationModule.h" // for export macro
#include "vtkVoxelizer.h"

#include <string> // for names of attributes
#include <vector> // for names of attributes

class vtkHyperTreeGrid;
class vtkPolyData;
class vtkSurfaceAttributes;

class VTKVOXELIZATION_EXPORT vtkHybridSurfaceVoxelizer : public vtkVoxelizer
{
public:
  static vtkHybridSurfaceVoxelizer* New();
  vtkTypeMacro(vtkHybridSurfaceVoxelizer, vtkVoxelizer);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum StrategyType
  {
    STRATEGY_AUTO = 0,
    STRATEGY_TRIANGLE = 1,
    STRATEGY_FRAGMENT = 2,
    STRATEGY_HYBRID = 3
  };

  enum AttributeCombinationType
  {
    COMBINE_AVERAGE = 0,
    COMBINE_MIN = 1,
    COMBINE_MAX = 2,
    COMBINE_FIRST = 3
  };

  ///@{
  /**
   * 26 (default) or 6; see the class description. Anything else is an error, and changes nothing.
   */
  virtual void SetSeparability(int separability);
  vtkGetMacro(Separability, int);
  void SetSeparabilityTo6() { this->SetSeparability(6); }
  void SetSeparabilityTo26() { this->SetSeparability(26); }
  ///@}

  ///@{
  /**
   * How triangles are spread over the processors; see the class description. Default: Auto.
   */
  vtkSetClampMacro(Strategy, int, STRATEGY_AUTO, STRATEGY_HYBRID);
  vtkGetMacro(Strategy, int);
  void SetStrategyToAuto() { this->SetStrategy(STRATEGY_AUTO); }
  void SetStrategyToTriangle() { this->SetStrategy(STRATEGY_TRIANGLE); }
  void SetStrategyToFragment() { this->SetStrategy(STRATEGY_FRAGMENT); }
  void SetStrategyToHybrid() { this->SetStrategy(STRATEGY_HYBRID); }
  ///@}

  ///@{
  /**
   * For Hybrid: triangles whose bounds, seen along the axis closest to their normal, cover more
   * columns of voxels than this are large; in squares of voxels, at most 8,192. Negative (default)
   * is automatic: the value at which both ways take the same time on this renderer, searched for
   * the first time that triangles of such size come, and remembered as long as the process runs.
   */
  vtkSetClampMacro(CutoffArea, double, -1.0, 8192.0);
  vtkGetMacro(CutoffArea, double);
  ///@}

  ///@{
  /**
   * For geometry that stays: whether the lists of small and of large triangles are kept on the GPU,
   * 16 bytes a triangle, so that further runs on the same mesh and grid, for instance with other
   * attributes, do without the search. Only for grids that a storage buffer holds in one piece.
   * Default: off.
   */
  vtkSetMacro(PreClassification, bool);
  vtkGetMacro(PreClassification, bool);
  vtkBooleanMacro(PreClassification, bool);
  ///@}

  /**
   * The CutoffArea of the last run with Hybrid or Auto; -1 before.
   */
  vtkGetMacro(UsedCutoffArea, double);

  ///@{
  /**
   * Names of the point or cell arrays to carry over; an array of the points wins over one of the
   * cells. Adding a name twice changes nothing. Default: none.
   */
  void AddAttribute(const char* name);
  void RemoveAllAttributes();
  int GetNumberOfAttributes() { return static_cast<int>(this->Attributes.size()); }
  const char* GetAttribute(int i);
  ///@}

  ///@{
  /**
   * A flat image of one to four components of unsigned char, whose colours at the texture
   * coordinates of the input become the attribute "Texture"; pixels are interpolated and the image
   * repeats. Default: none.
   */
  virtual void SetTextureImage(vtkImageData*);
  vtkGetObjectMacro(TextureImage, vtkImageData);
  ///@}

  ///@{
  /**
   * What becomes of the values of several triangles in one voxel: their Average (default), by
   * component the Min or Max, or those of the First triangle in the order of the input.
   */
  vtkSetClampMacro(AttributeCombination, int, COMBINE_AVERAGE, COMBINE_FIRST);
  vtkGetMacro(AttributeCombination, int);
  void SetAttributeCombinationToAverage() { this->SetAttributeCombination(COMBINE_AVERAGE); }
  void SetAttributeCombinationToMin() { this->SetAttributeCombination(COMBINE_MIN); }
  void SetAttributeCombinationToMax() { this->SetAttributeCombination(COMBINE_MAX); }
  void SetAttributeCombinationToFirst() { this->SetAttributeCombination(COMBINE_FIRST); }
  ///@}

  ///@{
  /**
   * Output ports 1 and 2, which GetOutputPort() numbers.
   */
  vtkPolyData* GetVoxelList();
  vtkHyperTreeGrid* GetHyperTreeGrid();
  ///@}

  vtkMTimeType GetMTime() override;

protected:
  vtkHybridSurfaceVoxelizer();
  ~vtkHybridSurfaceVoxelizer() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  bool Voxelize(vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkSlicemap* slicemap) override;
  bool NeedsExactTriangulation() override { return true; }
  bool AddArrays(
    vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkDataSetAttributes* voxels) override;
  std::int64_t GetBytesOfArrays() override;

private:
  vtkHybridSurfaceVoxelizer(const vtkHybridSurfaceVoxelizer&) = delete;
  void operator=(const vtkHybridSurfaceVoxelizer&) = delete;

  struct Slab;
  struct Settings;
  struct SparseArrays;
  class Run;

  bool FillVoxelList(vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkPolyData* output);
  bool FillHyperTreeGrid(vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkHyperTreeGrid* output);
  vtkSurfaceAttributes LoadAttributes(const vtkVoxelMesh& mesh);
  Settings GetSettings(const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid);

  int Separability = 26;
  int Strategy = STRATEGY_AUTO;
  double CutoffArea = -1.0;
  double UsedCutoffArea = -1.0;
  std::vector<std::string> Attributes;
  vtkImageData* TextureImage = nullptr;
  int AttributeCombination = COMBINE_AVERAGE;
  bool PreClassification = false;

  struct Internals;
  std::unique_ptr<Internals> Kept;
};

#endif
