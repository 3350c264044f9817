// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkVoxelizer
 * @brief abstract base of the filters that turn geometry into voxels on the GPU
 *
 * The input is a vtkPolyData with triangles, triangle strips and polygons, or a composite dataset
 * of them, all leaves of which go into one grid. Vertices and lines among the cells are ignored.
 * The output is a vtkImageData.
 *
 * <b>Grid.</b> A voxel is the box of size Spacing centred at an image point; it is solid when that
 * point is inside. The first that is set wins:
 *  1. ReferenceImage: its whole extent, spacing, origin and direction matrix are copied;
 *  2. OutputWholeExtent with OutputSpacing, OutputOrigin and OutputDirection;
 *  3. a box, ModelBounds or else the bounds of the input, cut into voxels by VoxelSize, by
 *     Resolution, or by SampleDimensions. The voxels' outer faces enclose the box: with
 *     VoxelSize or Resolution the grid is enlarged evenly to a whole number of voxels, with
 *     CubicVoxels the other axes of SampleDimensions get the spacing of the coarsest one. Padding
 *     adds whole voxels on every side.
 *
 * <b>Output.</b> As vtkVoxelAlgorithm tells. Sub-extents requested by UPDATE_EXTENT equal the same
 * part of the whole.
 *
 * <b>Errors.</b> One error that says what is wrong and what to do, and an empty output: no input,
 * no polygons, NaN or infinite points, an empty or negative grid, a result larger than MemoryLimit,
 * no OpenGL context.
 *
 * Progress is reported and abort honoured between tiles.
 *
 * @sa vtkSlicemapSolidVoxelizer vtkSlicemap vtkVoxelContext
 */

#ifndef vtkVoxelizer_h
#define vtkVoxelizer_h

#include "vtkVoxelAlgorithm.h"
#include "vtkVoxelizationModule.h" // for export macro

#include <cstdint>    // for 64-bit sizes
#include <functional> // for RunOnMesh
#include <memory>     // for the implementation

class vtkDataSetAttributes;
class vtkImageData;
class vtkSlicemap;
class vtkVoxelMesh;
struct vtkVoxelGrid;

class VTKVOXELIZATION_EXPORT vtkVoxelizer : public vtkVoxelAlgorithm
{
public:
  vtkTypeMacro(vtkVoxelizer, vtkVoxelAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum BackendType
  {
    BACKEND_AUTO = 0,
    BACKEND_RASTER = 1,
    BACKEND_COMPUTE = 2
  };

  ///@{
  /**
   * Number of voxels along x, y and z over the box (ModelBounds or the input's bounds), before
   * Padding. Default: 64, 64, 64. Zero or less is an error when the filter runs.
   */
  vtkSetVector3Macro(SampleDimensions, int);
  vtkGetVector3Macro(SampleDimensions, int);
  ///@}

  ///@{
  /**
   * Number of voxels along the longest side of the box, voxels being cubes; wins over
   * SampleDimensions. 0 (default) is off.
   */
  vtkSetMacro(Resolution, int);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * Edge length of cubic voxels in world units; wins over Resolution and SampleDimensions. 0
   * (default) is off.
   */
  vtkSetMacro(VoxelSize, double);
  vtkGetMacro(VoxelSize, double);
  ///@}

  ///@{
  /**
   * The box to voxelize, (xmin, xmax, ymin, ymax, zmin, zmax) in world units. Default: (0, -1, 0,
   * -1, 0, -1), which stands for the bounds of the input.
   */
  vtkSetVector6Macro(ModelBounds, double);
  vtkGetVector6Macro(ModelBounds, double);
  ///@}

  ///@{
  /**
   * Whether SampleDimensions gives cubes (default): the coarsest of the three spacings is used on
   * all axes and the box is enlarged evenly. When off each axis has its own spacing.
   */
  vtkSetMacro(CubicVoxels, bool);
  vtkGetMacro(CubicVoxels, bool);
  vtkBooleanMacro(CubicVoxels, bool);
  ///@}

  ///@{
  /**
   * Voxels of margin on every side of the box. Default: 0.
   */
  vtkSetClampMacro(Padding, int, 0, VTK_INT_MAX / 4);
  vtkGetMacro(Padding, int);
  ///@}

  ///@{
  /**
   * An image whose extent, spacing, origin and direction matrix the output takes over. Its scalars
   * don't matter. Default: none.
   */
  virtual void SetReferenceImage(vtkImageData*);
  vtkGetObjectMacro(ReferenceImage, vtkImageData);
  ///@}

  ///@{
  /**
   * Index extent of the whole output; with OutputSpacing, OutputOrigin (of index 0, 0, 0) and
   * OutputDirection (3x3, row major) it fixes the grid. Default: (0, -1, 0, -1, 0, -1), which is
   * off; spacing 1, origin 0, identity.
   */
  vtkSetVector6Macro(OutputWholeExtent, int);
  vtkGetVector6Macro(OutputWholeExtent, int);
  vtkSetVector3Macro(OutputSpacing, double);
  vtkGetVector3Macro(OutputSpacing, double);
  vtkSetVector3Macro(OutputOrigin, double);
  vtkGetVector3Macro(OutputOrigin, double);
  vtkSetVectorMacro(OutputDirection, double, 9);
  vtkGetVectorMacro(OutputDirection, double, 9);
  ///@}

  ///@{
  /**
   * Raster draws the mesh into integer render targets (OpenGL 3.2); Compute runs compute shaders in
   * double precision (OpenGL 4.3). Auto (default) takes Compute where the context has it.
   */
  vtkSetClampMacro(Backend, int, BACKEND_AUTO, BACKEND_COMPUTE);
  vtkGetMacro(Backend, int);
  void SetBackendToAuto() { this->SetBackend(BACKEND_AUTO); }
  void SetBackendToRaster() { this->SetBackend(BACKEND_RASTER); }
  void SetBackendToCompute() { this->SetBackend(BACKEND_COMPUTE); }
  ///@}

  ///@{
  /**
   * When on (default), a mesh that let columns leak is examined, and a warning names the number of
   * its open and of its non-manifold edges. Leaks are found at no cost while voxelizing, so closed
   * meshes pay nothing.
   */
  vtkSetMacro(CheckWatertight, bool);
  vtkGetMacro(CheckWatertight, bool);
  vtkBooleanMacro(CheckWatertight, bool);
  ///@}

  /**
   * Number of triangles that the last run voxelized.
   */
  vtkIdType GetNumberOfTriangles();

  /**
   * How often this filter sent a mesh to the GPU; a change of the grid alone sends nothing.
   */
  int GetNumberOfMeshUploads();

  /**
   * Backend of the last run: BACKEND_RASTER or BACKEND_COMPUTE; BACKEND_AUTO before any run.
   */
  vtkGetMacro(UsedBackend, int);

  vtkMTimeType GetMTime() override;

#ifndef __VTK_WRAP__
  /**
   * For those who drive it in slabs: bytes that a run for such a part of the output takes, output
   * included, beside those of the mesh.
   */
  virtual std::int64_t EstimateBytes(const vtkVoxelGrid& part);
#endif

protected:
  vtkVoxelizer();
  ~vtkVoxelizer() override;

  /**
   * Fills `slicemap`, which is not yet allocated, with the voxels of `mesh` on `grid`, in the
   * current context. Returns false after having reported an error, or when aborted.
   */
  virtual bool Voxelize(vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkSlicemap* slicemap) = 0;

  /**
   * Bounds of what is to be voxelized, and false when it has none. Here: those of the input, which
   * is null where the port is optional and nothing is connected. Throws std::runtime_error.
   */
  virtual bool GetInputBounds(vtkDataObject* input, double bounds[6]);

  /**
   * For what must happen before a run takes the context, such as rendering by VTK. Returns false
   * when aborted. Throws std::runtime_error.
   */
  virtual bool Prepare(const vtkVoxelGrid& vtkNotUsed(whole))
  {
    return true;
  }

  /**
   * Adds more arrays to the voxels of `grid`, which have been filled and read back, in the current
   * context. Returns false after having reported an error, or when aborted.
   */
  virtual bool AddArrays(
    vtkVoxelMesh& vtkNotUsed(mesh), const vtkVoxelGrid& vtkNotUsed(grid), vtkDataSetAttributes*)
  {
    return true;
  }

  /**
   * Number of slicemaps that a run has at a time on the grid of its output. Here: 1.
   */
  virtual int GetNumberOfWorkSlicemaps()
  {
    return 1;
  }

  /**
   * The grid of the whole output during a run. What must not depend on which part is asked for is
   * decided by it.
   */
  const vtkVoxelGrid& GetGridOfWhole() const;

  /**
   * Bytes a voxel that these arrays take.
   */
  virtual std::int64_t GetBytesOfArrays()
  {
    return 0;
  }
  std::int64_t GetBytesOfOutput(const vtkVoxelGrid& grid) override;

  /**
   * The frame of every run: `prepare` gets the checked grid of the whole output, before any work,
   * and may return false when there is nothing to do; `work` finds the mesh on the GPU and the
   * context current. See RunInContext.
   */
  int RunOnMesh(vtkDataObject* input, const std::function<bool(const vtkVoxelGrid& whole)>& prepare,
    const std::function<bool(vtkVoxelMesh& mesh)>& work);

  /**
   * Whether polygons must be cut into triangles that cover them exactly (ear clipping), or into
   * fans, which keep parity and winding also for concave polygons, and are cheaper.
   */
  virtual bool NeedsExactTriangulation()
  {
    return false;
  }

  /**
   * Backend to run: Backend, with Auto resolved for the current context. Reports an error and
   * returns BACKEND_AUTO when the context can't do what was asked for.
   */
  int ResolveBackend();

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkVoxelizer(const vtkVoxelizer&) = delete;
  void operator=(const vtkVoxelizer&) = delete;

  vtkVoxelGrid GridFromBox(const double box[6]) const;
  vtkVoxelGrid GetWholeGrid(vtkDataObject* input);
  vtkVoxelGrid GetCheckedGrid(vtkDataObject* input);
  vtkVoxelGrid GetRequestedPart(const vtkVoxelGrid& whole, vtkInformation* outputInfo);

  int SampleDimensions[3] = { 64, 64, 64 };
  int Resolution = 0;
  double VoxelSize = 0.0;
  double ModelBounds[6] = { 0.0, -1.0, 0.0, -1.0, 0.0, -1.0 };
  bool CubicVoxels = true;
  int Padding = 0;
  vtkImageData* ReferenceImage = nullptr;
  int OutputWholeExtent[6] = { 0, -1, 0, -1, 0, -1 };
  double OutputSpacing[3] = { 1.0, 1.0, 1.0 };
  double OutputOrigin[3] = { 0.0, 0.0, 0.0 };
  double OutputDirection[9] = { 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 };
  int Backend = BACKEND_AUTO;
  int UsedBackend = BACKEND_AUTO;
  bool CheckWatertight = true;

  struct Internals;
  std::unique_ptr<Internals> State;
};

#endif
