// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkTetraCoveringVoxelizer
 * @brief solid voxels by the XOR of tetrahedra, with shells and random variants for training
 * networks
 *
 * Each triangle makes a tetrahedron with one origin common to all, the mean of the points. The
 * voxels of each tetrahedron are flipped; what is set in the end lies in an odd number of
 * tetrahedra, and that is the solid. Polygons of any number of points, concave ones, and those
 * whose holes are joined by bridges, are taken as the fans of triangles about their first point:
 * parts of a fan that lie beyond the polygon are flipped an even number of times. Nothing is
 * tessellated. The method is that of
 *
 * C. J. Ogayar, A. J. Rueda, R. J. Segura, F. R. Feito: Fast and Simple Hardware Accelerated
 * Voxelizations Using Simplicial Coverings. The Visual Computer 23 (2007); and, for networks,
 * GPU-Based Framework for Training 3D Convolutional Neural Networks with Voxelized Polygonal
 * Models, section III (method and augmentation) and IV (batches).
 *
 * The Compute backend flips, along each column of voxels, the interval that lies in a tetrahedron,
 * by two bits and a parity scan afterwards; its arithmetic is double precision. A facet at the
 * origin belongs to the tetrahedra of all triangles at one edge, so that its flips cancel where
 * these are even in number. They are left out; only the facets at other edges, the open ones, are
 * done.
 *
 * The Raster backend does the same with fragments in place of invocations, in pairs of floats, 48
 * bits together (RasterMethod Columns). Its voxels are those of Compute, bit for bit, unless a
 * voxel centre is within some 1e-11 voxel of the surface: there ties decide, which the two may see
 * differently where edges and corners run through voxel centres. Random variants have none.
 *
 * RasterMethod Slices and Layers are the paper's ways: tetrahedra are cut by the slices of voxels,
 * and the sections are drawn with the logic operation XOR. Coordinates are single precision, and
 * corners of sections are snapped to 1/128 voxel, so that voxels differ where a voxel centre is
 * that near to the surface.
 *
 * <b>Ties.</b> The paper includes the upper end of a tetrahedron and excludes the lower one. So
 * here, along each axis: of voxel centres that lie on the surface, those at the upper end of a
 * solid are inside, those at the lower end outside; a box [0, 4]^3 holds the centres 1, 2, 3, 4.
 * vtkSlicemapSolidVoxelizer has it the other way round; apart from ties both give the same voxels.
 *
 * <b>Open meshes.</b> A hole is closed by a cone from its rim to the origin, so that no column
 * leaks. With CheckWatertight a warning tells how many edges are open.
 *
 * <b>Shell.</b> Voxels of the solid of which one of the 6, 18 or 26 neighbours is not; those beyond
 * the grid are not.
 *
 * <b>Variants.</b> The model is scaled along its axes, then rotated, both about the centre of its
 * bounds; and its points are displaced before. The numbers for this depend on Seed and Variant
 * alone, and are the same on all machines. The mesh is sent to the GPU once: a variant is a few
 * numbers. Displacements come from a ring of 65,536 random vectors that the variants begin at
 * different places; points at the same place move together, so that closed meshes stay closed.
 *
 * <b>Errors.</b> Those of vtkVoxelizer; and one error, and an empty output, when a property has a
 * value that is not allowed.
 *
 * @sa vtkSlicemapSolidVoxelizer vtkVoxelMorphology
 */

#ifndef vtkTetraCoveringVoxelizer_h
#define vtkTetraCoveringVoxelizer_h

#include "vtkVoxelizationModule.h" // for export macro
#include "vtkVoxelizer.h"

#include <memory> // for the implementation

class vtkMatrix4x4;
class vtkPolyData;
class vtkTetraModel;
class vtkUnsignedCharArray;
struct vtkTetraAugmentation;

class VTKVOXELIZATION_EXPORT vtkTetraCoveringVoxelizer : public vtkVoxelizer
{
public:
  static vtkTetraCoveringVoxelizer* New();
  vtkTypeMacro(vtkTetraCoveringVoxelizer, vtkVoxelizer);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ShellType
  {
    SHELL_NONE = 0,
    SHELL_6 = 6,
    SHELL_18 = 18,
    SHELL_26 = 26
  };

  enum RotationModeType
  {
    ROTATION_FIXED = 0,
    ROTATION_UNIFORM = 1,
    ROTATION_AXIS = 2
  };

  enum DisplacementDistributionType
  {
    DISPLACEMENT_UNIFORM = 0,
    DISPLACEMENT_NORMAL = 1
  };

  enum DisplacementDirectionType
  {
    DIRECTION_FREE = 0,
    DIRECTION_ALONG_NORMAL = 1
  };

  enum RasterMethodType
  {
    RASTER_SLICES = 0,
    RASTER_LAYERS = 1,
    RASTER_COLUMNS = 2
  };

  ///@{
  /**
   * How the Raster backend draws: Slices, a draw for each slice of voxels; Layers, where the
   * geometry shader cuts a tetrahedron by many slices at once, for the same voxels; or Columns
   * (default), as Compute does it, for the voxels that Compute gives.
   */
  vtkSetClampMacro(RasterMethod, int, RASTER_SLICES, RASTER_COLUMNS);
  vtkGetMacro(RasterMethod, int);
  void SetRasterMethodToSlices() { this->SetRasterMethod(RASTER_SLICES); }
  void SetRasterMethodToLayers() { this->SetRasterMethod(RASTER_LAYERS); }
  void SetRasterMethodToColumns() { this->SetRasterMethod(RASTER_COLUMNS); }
  ///@}

  ///@{
  /**
   * 0 (default): the solid. 6, 18 or 26: its shell by so many neighbours. Others are an error when
   * the filter runs.
   */
  vtkSetMacro(Shell, int);
  vtkGetMacro(Shell, int);
  ///@}

  ///@{
  /**
   * Whether a shell comes with the rest of the solid: shell voxels then have the value ShellValue,
   * the others ForegroundValue. Off by default. The slicemap of the output is that of the solid.
   * Needs scalars of unsigned char.
   */
  vtkSetMacro(KeepInterior, bool);
  vtkGetMacro(KeepInterior, bool);
  vtkBooleanMacro(KeepInterior, bool);
  ///@}

  ///@{
  /**
   * Value of the shell with KeepInterior, 1 to 255. Default: 2. Without, it is ForegroundValue.
   */
  vtkSetClampMacro(ShellValue, int, 1, 255);
  vtkGetMacro(ShellValue, int);
  ///@}

  ///@{
  /**
   * What random numbers depend on: seed, and number of the variant. Default: 0, 0.
   */
  vtkSetMacro(Seed, vtkTypeInt64);
  vtkGetMacro(Seed, vtkTypeInt64);
  vtkSetClampMacro(Variant, vtkTypeInt64, 0, VTK_TYPE_INT64_MAX);
  vtkGetMacro(Variant, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * Fixed (default): all variants are rotated by FixedRotation. Uniform: by any rotation, all with
   * the same probability. Axis: by any angle about RotationAxis.
   */
  vtkSetClampMacro(RotationMode, int, ROTATION_FIXED, ROTATION_AXIS);
  vtkGetMacro(RotationMode, int);
  void SetRotationModeToFixed() { this->SetRotationMode(ROTATION_FIXED); }
  void SetRotationModeToUniform() { this->SetRotationMode(ROTATION_UNIFORM); }
  void SetRotationModeToAxis() { this->SetRotationMode(ROTATION_AXIS); }
  ///@}

  ///@{
  /**
   * Angle in degrees and axis (x, y, z) in world coordinates, as vtkTransform::RotateWXYZ takes
   * them. Default: 0, 0, 0, 1. An axis without a length is an error when the filter runs.
   */
  vtkSetVector4Macro(FixedRotation, double);
  vtkGetVector4Macro(FixedRotation, double);
  ///@}

  ///@{
  /**
   * The axis of mode Axis, in world coordinates. Default: 0, 0, 1.
   */
  vtkSetVector3Macro(RotationAxis, double);
  vtkGetVector3Macro(RotationAxis, double);
  ///@}

  ///@{
  /**
   * Each axis of the model is scaled by a factor of its own, uniform in this range. Default: 1, 1.
   * The lower bound must be positive and not above the upper one.
   */
  vtkSetVector2Macro(ScaleRange, double);
  vtkGetVector2Macro(ScaleRange, double);
  ///@}

  ///@{
  /**
   * How far points are moved, as a fraction of the longest side of the model's bounds: at most so
   * far to either side on each axis (Uniform), or with this standard deviation (Normal). Default:
   * 0, none.
   */
  vtkSetMacro(DisplacementAmplitude, double);
  vtkGetMacro(DisplacementAmplitude, double);
  ///@}

  ///@{
  /**
   * Uniform (default) or Normal; the latter is a sum of twelve uniform numbers, which never is
   * beyond six standard deviations.
   */
  vtkSetClampMacro(DisplacementDistribution, int, DISPLACEMENT_UNIFORM, DISPLACEMENT_NORMAL);
  vtkGetMacro(DisplacementDistribution, int);
  void SetDisplacementDistributionToUniform()
  {
    this->SetDisplacementDistribution(DISPLACEMENT_UNIFORM);
  }
  void SetDisplacementDistributionToNormal()
  {
    this->SetDisplacementDistribution(DISPLACEMENT_NORMAL);
  }
  ///@}

  ///@{
  /**
   * Free (default): three numbers a point, one for each axis. AlongNormal: one number, along the
   * mean normal, by area, of the polygons at the point.
   */
  vtkSetClampMacro(DisplacementDirection, int, DIRECTION_FREE, DIRECTION_ALONG_NORMAL);
  vtkGetMacro(DisplacementDirection, int);
  void SetDisplacementDirectionToFree() { this->SetDisplacementDirection(DIRECTION_FREE); }
  void SetDisplacementDirectionToAlongNormal()
  {
    this->SetDisplacementDirection(DIRECTION_ALONG_NORMAL);
  }
  ///@}

  ///@{
  /**
   * Moves the model to the middle of the grid, and scales it so that the ball about its centre in
   * which it lies, displacements included, just fits: no rotation ever leaves the grid, and all
   * variants of one scale have one size. Off by default.
   */
  vtkSetMacro(SafeScaleToFit, bool);
  vtkGetMacro(SafeScaleToFit, bool);
  vtkBooleanMacro(SafeScaleToFit, bool);
  ///@}

  /**
   * The variants `first` to `first` + `count` - 1 on the whole grid, one after the other, one value
   * a voxel, x fastest, so that the array has the shape (count, nz, ny, nx); room that it has
   * already is used again. Updates the input. False, after one error, when this can't be; the array
   * then is empty. The Compute backend makes variants together, up to 64 of them as long as their
   * bits take no more than 16 MiB, where grids or triangles are small. Progress is told for each of
   * them as soon as they are there, and the batch can be stopped then. HostOutput, Variant and the
   * output of the filter play no role, nor does OutputScalarType, but for KeepInterior, which needs
   * unsigned char here as well.
   */
  bool VoxelizeBatch(vtkTypeInt64 first, int count, vtkUnsignedCharArray* array);

  /**
   * The same variants as bits, which are not expanded to bytes: calls `visit` with the number of
   * each, counted from `first`, its grid and its words, in the layout of vtkSlicemap. Shells come
   * without the interior. False after one error, or when `visit` answers false.
   */
  bool VisitBatch(vtkTypeInt64 first, int count,
    const std::function<bool(int i, const vtkVoxelGrid& grid, const std::uint32_t* words)>& visit);

  /**
   * Where a variant goes, in world coordinates, after the displacement of its points. Updates the
   * input. False after one error.
   */
  bool GetVariantMatrix(vtkTypeInt64 variant, vtkMatrix4x4* matrix);

  /**
   * The mesh of a variant, its points displaced and transformed on the CPU in double precision.
   * Updates the input. False after one error.
   */
  bool GetVariantMesh(vtkTypeInt64 variant, vtkPolyData* mesh);

  ///@{
  /**
   * Edges of the input of the last run that have one polygon, and more than two of them. 0 when the
   * edges of the polygons are all even in number.
   */
  vtkGetMacro(NumberOfOpenEdges, vtkIdType);
  vtkGetMacro(NumberOfNonManifoldEdges, vtkIdType);
  ///@}

protected:
  vtkTetraCoveringVoxelizer();
  ~vtkTetraCoveringVoxelizer() override;

  bool Voxelize(vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkSlicemap* slicemap) override;
  int GetNumberOfWorkSlicemaps() override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  bool AddArrays(
    vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkDataSetAttributes* arrays) override;

private:
  vtkTetraCoveringVoxelizer(const vtkTetraCoveringVoxelizer&) = delete;
  void operator=(const vtkTetraCoveringVoxelizer&) = delete;

  void CheckProperties();
  bool HasVariants() const;
  bool MovesAlongNormals() const { return this->DisplacementDirection == DIRECTION_ALONG_NORMAL; }
  vtkTetraAugmentation GetAugmentation(const vtkTetraModel& model) const;
  vtkVoxelGrid GetWholeGrid();
  struct Placement;
  Placement Place(const vtkTetraAugmentation& augmentation, vtkTypeInt64 variant,
    const vtkTetraModel& model, double largestDisplacement);
  vtkVoxelMesh& PrepareMesh(vtkVoxelMesh& mesh);
  void PrepareDisplacement(const vtkTetraAugmentation& augmentation);
  struct View;
  View See(vtkTypeInt64 variant, vtkVoxelMesh& mesh, const vtkVoxelGrid& grid);
  bool RunPass(vtkVoxelMesh& mesh, vtkSlicemap* solid, const std::function<bool(double)>& progress);
  bool FillSolid(vtkTypeInt64 variant, vtkVoxelMesh& mesh, const vtkVoxelGrid& grid,
    vtkSlicemap* solid, const std::function<bool(double)>& progress);
  void FindShell(vtkSlicemap* solid, const vtkVoxelGrid& grid, vtkSlicemap* shell);
  struct Slot;
  using BatchReader = std::function<bool(const Slot& slot)>;
  int GetVariantsAtOnce(const vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, int count);
  bool FillSlot(vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkTypeInt64 first, Slot& slot,
    const std::function<bool(double)>& progress);
  bool FillBatch(vtkVoxelMesh& mesh, const vtkVoxelGrid& grid, vtkTypeInt64 first, int count,
    const BatchReader& read);
  bool RunBatch(vtkTypeInt64 first, int count, std::int64_t bytesPerVoxel,
    const std::function<BatchReader(const vtkVoxelGrid& grid)>& begin);
  vtkDataObject* UpdateInput();
  bool RunWithModel(const std::function<void(const vtkTetraModel& model)>& work);

  int RasterMethod = RASTER_COLUMNS;
  int Shell = SHELL_NONE;
  bool KeepInterior = false;
  int ShellValue = 2;
  vtkTypeInt64 Seed = 0;
  vtkTypeInt64 Variant = 0;
  int RotationMode = ROTATION_FIXED;
  double FixedRotation[4] = { 0.0, 0.0, 0.0, 1.0 };
  double RotationAxis[3] = { 0.0, 0.0, 1.0 };
  double ScaleRange[2] = { 1.0, 1.0 };
  double DisplacementAmplitude = 0.0;
  int DisplacementDistribution = DISPLACEMENT_UNIFORM;
  int DisplacementDirection = DIRECTION_FREE;
  bool SafeScaleToFit = false;
  vtkIdType NumberOfOpenEdges = 0;
  vtkIdType NumberOfNonManifoldEdges = 0;

  struct Internals;
  std::unique_ptr<Internals> Tetra;
};

#endif
