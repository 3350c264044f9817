// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkDepthBufferVoxelizer
 * @brief voxels of anything that VTK can draw, from depth buffers on its sides
 *
 * The scene is looked at from both sides along one to three index axes of the grid, each time into
 * a pair of depth buffers with one pixel a column of voxels. A voxel is inside when its centre lies
 * between both depths of all pairs. Nothing but depth is asked of what is drawn, so besides meshes
 * on the input port there may be any props with opaque surfaces: glyphs, clipped or displaced
 * surfaces, level-of-detail actors, assemblies, all that a renderer shows. The method is that of
 *
 * Aggeliki Karabassi, George Papaioannou, Theoharis Theoharis: A Fast Depth-Buffer-Based
 * Voxelization Algorithm. Journal of Graphics Tools 4(4), 1999, pp. 5-10; section 2 (solid), 4.1
 * (surface), 4.2 (density).
 *
 * Its cost is that of drawing the scene, and then grows with the number of pixels, whatever part of
 * the grid is filled: only the voxels of columns that end within a cell of 32 x 4 x 8 are looked
 * at, all others are set a word at a time. Densities are a number for each voxel, and oblique views
 * (see AddView) look at each voxel that is left. For several resolutions run it at each, or
 * vtkVoxelDensityNormals with Downsample on the finest.
 * Progress is reported and abort honoured between buffers.
 *
 * <b>Limits.</b> What no buffer sees is filled: cavities inside, and hollows that are hidden along
 * all axes. What is convex, or convex along each column of one of the axes (a torus along its axis
 * of symmetry), is exact. Surfaces need not be closed. Depth has single precision, and columns are
 * sampled as OpenGL rasterizes, to 1/256 voxel. Where the surface passes through voxel centres, the
 * half open rule of vtkSlicemapSolidVoxelizer holds along depth, and across it that of the driver.
 *
 * <b>Props</b> are drawn by VTK in the window of the context (RenderWindow) at the size of the
 * grid, and left as they were. Their
 * bounds are those that they tell; set ModelBounds where a shader moves them beyond. A prop that
 * other windows show gives its graphics resources there back, and makes them anew when it is drawn
 * there next; set RenderWindow to that window to avoid it. A vtkVolume whose mapper blends
 * iso-surfaces is seen as the level sets that its property names, contoured on the CPU: such
 * mappers write no depth, and what they give by RenderToImage are the places of samples behind the
 * surface. Cropping by its mapper is ignored. What clipping planes cut open is open: look along
 * axes that lie in the cut.
 *
 * <b>Grid.</b> That of vtkVoxelizer, where the bounds are those of the input and of all props.
 * Backend is of no consequence.
 *
 * <b>Errors.</b> Those of vtkVoxelizer; no input, no prop and no given buffers; a prop that is
 * invisible, has no bounds, or is translucent; a volume whose mapper does not blend iso-surfaces; a
 * renderer in another window than RenderWindow; no axis; buffers larger than OpenGL allows; given
 * buffers of another size than the grid's, or of several components; a view without a
 * direction; a Connectivity other than 4 and 8; Density without HostOutput.
 *
 * @sa vtkSlicemapSolidVoxelizer vtkHybridSurfaceVoxelizer
 */

#ifndef vtkDepthBufferVoxelizer_h
#define vtkDepthBufferVoxelizer_h

#include "vtkVoxelizationModule.h" // for export macro
#include "vtkVoxelizer.h"

#include <memory> // for the implementation
#include <vector> // for the props

class vtkProp;
class vtkRenderer;

class VTKVOXELIZATION_EXPORT vtkDepthBufferVoxelizer : public vtkVoxelizer
{
public:
  static vtkDepthBufferVoxelizer* New();
  vtkTypeMacro(vtkDepthBufferVoxelizer, vtkVoxelizer);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum OutputModeType
  {
    OUTPUT_MODE_SOLID = 0,
    OUTPUT_MODE_SURFACE = 1,
    OUTPUT_MODE_DENSITY = 2
  };

  ///@{
  /**
   * Props to voxelize, besides the input, which then is optional. SetProp takes one instead of all
   * others.
   */
  void AddProp(vtkProp* prop);
  void SetProp(vtkProp* prop);
  void RemoveAllProps();
  int GetNumberOfProps();
  vtkProp* GetProp(int index);
  ///@}

  ///@{
  /**
   * A renderer all of whose visible props are voxelized too, as they are when the filter runs. It
   * is referenced weakly. If it is in a window, RenderWindow must be that window. Default: none.
   */
  void SetRenderer(vtkRenderer* renderer);
  vtkRenderer* GetRenderer();
  ///@}

  ///@{
  /**
   * Whether there is a pair of buffers along the index axes x, y and z. Default: all three.
   */
  vtkSetVector3Macro(Axes, bool);
  vtkGetVector3Macro(Axes, bool);
  ///@}

  ///@{
  /**
   * When on, one of Axes does for all of them where it tells everything: where each column of
   * voxels along it crosses the surface never or exactly twice. So it is for convex meshes along
   * every axis, and for such as a torus along its axis of symmetry (section 2.3 of the paper). This
   * is decided by counting the crossings of every column in the stencil while the near side is
   * drawn, the axes with the fewest pixels first, so that there are never more draws than without.
   * What counts are the samples that voxels are made from, not the mesh: a mesh with holes may thus
   * become a solid that three axes would not find, and where columns run along faces, rounding may
   * rule out an axis that would have done. Along x filling is fastest.
   *
   * It is for meshes on the input port alone: with props, with Density, which is better the more
   * axes there are, and where each of Axes hides something, all of Axes are used. UsedAxes are the
   * axes of the last run. Default: off.
   */
  vtkSetMacro(AutomaticAxes, bool);
  vtkGetMacro(AutomaticAxes, bool);
  vtkBooleanMacro(AutomaticAxes, bool);
  vtkGetVector3Macro(UsedAxes, bool);
  ///@}

  ///@{
  /**
   * More pairs of buffers, which look along any direction in world coordinates, and carve what the
   * axes can't see into. Their pixels are as large as the smallest spacing. A cavity keeps a margin
   * of a pixel or two, so that no voxel is lost to a slope or to a ridge between pixels (up to 60
   * degrees steep, as the view sees it). A direction without a length is an error when the filter
   * runs. Default: none.
   */
  void AddView(double x, double y, double z);
  void RemoveAllViews();
  int GetNumberOfViews();
  ///@}

  ///@{
  /**
   * - Solid (default).
   * - Surface: of each column the voxels from both of its ends on as far inwards as the ends of the
   *   neighbouring columns lie, one at least. Where the grid cuts the solid, the cut is surface.
   *   With views, the voxels of the solid that have a neighbour outside.
   * - Density: the solid, and beside the occupancy an array "Density" of floats from 0 to 1, the
   *   product over the axes of how much of the voxel's length is inside. That is an estimate of the
   *   voxel's part that is inside, for convex shapes; views don't change it. It needs HostOutput.
   */
  vtkSetClampMacro(OutputMode, int, OUTPUT_MODE_SOLID, OUTPUT_MODE_DENSITY);
  vtkGetMacro(OutputMode, int);
  void SetOutputModeToSolid() { this->SetOutputMode(OUTPUT_MODE_SOLID); }
  void SetOutputModeToSurface() { this->SetOutputMode(OUTPUT_MODE_SURFACE); }
  void SetOutputModeToDensity() { this->SetOutputMode(OUTPUT_MODE_DENSITY); }
  ///@}

  ///@{
  /**
   * How many neighbours of a pixel the surface is closed against, 4 (default) or 8. With 4 nothing
   * gets through its voxels over faces; 8 makes it thicker, and nothing gets through over edges
   * within slices of the grid either. An error otherwise.
   */
  vtkSetMacro(Connectivity, int);
  vtkGetMacro(Connectivity, int);
  ///@}

  enum BufferSide
  {
    BUFFER_NEAR = 0,
    BUFFER_FAR = 1
  };

  ///@{
  /**
   * The depth buffers of the last run: pairs along axes in the order of x, y and z, then views,
   * each with two sides. GetDepthBuffer gives `image` one pixel a column and float scalars "Depth",
   * in voxels (of views, in pixels) from the centre of the first voxel towards the far side. Where
   * there is nothing, the near side has a depth behind all voxels, the far side one before them.
   * Returns false after one error when there is no such buffer.
   */
  int GetNumberOfDepthBufferPairs();
  bool GetDepthBuffer(int pair, int side, vtkImageData* image);
  ///@}

  ///@{
  /**
   * For sculpting: pairs of buffers along an index axis, 0 to 2, that come from elsewhere, as
   * GetDepthBuffer gives them: from an earlier run of this filter or of another one on the same
   * grid, or worked on as the images they are. Voxels are those between these and all other pairs.
   * The images are referenced. Without input and props the given pairs alone make the voxels, and
   * Axes does not matter; the grid must be set then. Each needs one component and as many pixels as
   * there are columns; depths that are not finite stand for nothing. Default: none.
   *
   * A result that views carved is intersected with another one by vtkVoxelBoolean.
   */
  void AddDepthBuffers(int axis, vtkImageData* nearSide, vtkImageData* farSide);
  void RemoveAllDepthBuffers();
  int GetNumberOfGivenDepthBufferPairs();
  ///@}

  /**
   * How many depth buffers this filter has drawn so far. Buffers stay as long as scene and grid are
   * what they were: another OutputMode or Connectivity, fewer axes or views, another part of the
   * grid or given buffers draw nothing, one more axis or view draws two.
   */
  int GetNumberOfBufferDraws();

  /**
   * How much of the last Solid, in cubes of world units, is no solid of the input by parity: the
   * cavities that no buffer sees. The input must be a closed mesh; it is voxelized once more. -1
   * without a run, and with props or given buffers, which parity knows nothing of.
   */
  double GetHiddenVolumeEstimate();

  vtkMTimeType GetMTime() override;

#ifndef __VTK_WRAP__
  std::int64_t EstimateBytes(const vtkVoxelGrid& part) override;
#endif

protected:
  vtkDepthBufferVoxelizer();
  ~vtkDepthBufferVoxelizer() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  bool GetInputBounds(vtkDataObject* input, double bounds[6]) override;
  bool Prepare(const vtkVoxelGrid& whole) override;
  bool Voxelize(vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkSlicemap* slicemap) override;
  bool NeedsExactTriangulation() override
  {
    return true;
  }
  bool AddArrays(
    vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkDataSetAttributes* voxels) override;
  std::int64_t GetBytesOfArrays() override;

private:
  vtkDepthBufferVoxelizer(const vtkDepthBufferVoxelizer&) = delete;
  void operator=(const vtkDepthBufferVoxelizer&) = delete;

  void CheckParameters();
  std::vector<vtkProp*> GetCheckedProps();
  bool HasGivenOnly();
  bool ChoosesAxes(bool hasProps) const;
  void MakeBuffers(const vtkVoxelGrid& whole, const std::vector<vtkProp*>& props);
  bool DrawMesh(const vtkVoxelMesh& mesh);
  bool ReportDraw();

  bool Axes[3] = { true, true, true };
  bool AutomaticAxes = false;
  bool UsedAxes[3] = { false, false, false };
  int OutputMode = OUTPUT_MODE_SOLID;
  int Connectivity = 4;

  struct Scene;
  std::unique_ptr<Scene> Drawn;
};

#endif
