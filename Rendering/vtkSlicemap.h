// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSlicemap
 * @brief a binary voxel grid that lives on the GPU, one bit a voxel
 *
 * A slicemap stores a solid (or any other set of voxels) as bits in one OpenGL buffer, together
 * with the grid that the bits belong to. The voxelizers make slicemaps, the filters behind them
 * work on the bits, and nothing is read back until somebody asks for it.
 *
 * Layout of the buffer: bit `x % 32` (least significant first) of the 32-bit word
 * `((z * ny) + y) * WordsPerRow + x / 32` is voxel (x, y, z), counted from the first voxel of the
 * extent. Rows are padded to a multiple of four words (128 voxels) so that they can be read as
 * uvec4; padding bits are always zero.
 *
 * An image made by a filter of this module carries its slicemap in its information, under
 * vtkSlicemap::SLICEMAP(). The next filter takes it from there, provided that it lives in the same
 * context and that the image was not changed since; otherwise the image is uploaded.
 *
 * The idea of packing the columns of a grid into the bits of integer textures, and its name, are
 * those of
 *
 * Elmar Eisemann, Xavier Decoret: Single-Pass GPU Solid Voxelization for Real-Time Applications.
 * Graphics Interface 2008, pp. 73-80, section 4.
 */

#ifndef vtkSlicemap_h
#define vtkSlicemap_h

#include "vtkObject.h"
#include "vtkVoxelizationModule.h" // for export macro

#include <array>      // for offsets
#include <cstdint>    // for 64-bit sizes
#include <functional> // for Read
#include <memory>     // for the implementation
#include <vector>     // for Write

class vtkImageData;
class vtkInformationIdTypeKey;
class vtkInformationObjectBaseKey;
class vtkSlicemapExpression;
class vtkVoxelContext;
struct vtkVoxelGrid;
namespace vtkVoxelGL
{
class Buffer;
}

class VTKVOXELIZATION_EXPORT vtkSlicemap : public vtkObject
{
public:
  static vtkSlicemap* New();
  vtkTypeMacro(vtkSlicemap, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Information key under which an image carries the slicemap that its scalars were made from.
   */
  static vtkInformationObjectBaseKey* SLICEMAP();

  /**
   * Modification time of the scalars that the slicemap of an image stands for; 0 when it has none.
   */
  static vtkInformationIdTypeKey* SCALARS_TIME();

  ///@{
  /**
   * The context the bits live in. Default: the shared headless context of the process.
   * Setting another one releases the bits.
   */
  void SetContext(vtkVoxelContext* context);
  vtkVoxelContext* GetContext();
  ///@}

  ///@{
  /**
   * Geometry of the grid: index extent, world spacing and origin of index (0, 0, 0), and the
   * direction matrix (row major).
   */
  int* GetExtent() VTK_SIZEHINT(6);
  int* GetDimensions() VTK_SIZEHINT(3);
  double* GetSpacing() VTK_SIZEHINT(3);
  double* GetOrigin() VTK_SIZEHINT(3);
  double* GetDirection() VTK_SIZEHINT(9);
  ///@}

  /**
   * Bits as a filled image: takes geometry and scalars of `image`; a voxel is set where the first
   * component of the active point scalars (cell scalars, if there are only those) is not zero.
   * Returns false, after one error, when there is no context or the grid is too large.
   */
  bool Upload(vtkImageData* image);

  /**
   * Reads the bits back: gives `image` this geometry and point scalars named "Occupancy" of type
   * VTK_UNSIGNED_CHAR, `foregroundValue` where the bit is set and 0 elsewhere, or VTK_BIT. The
   * image carries the slicemap afterwards. False after one error when there is no memory.
   */
  bool Download(vtkImageData* image, int scalarType = VTK_UNSIGNED_CHAR, int foregroundValue = 1);

  /**
   * Number of voxels that are set; counted on the GPU, four bytes are read back. -1 on failure.
   */
  vtkIdType GetNumberOfFilledVoxels();

  ///@{
  /**
   * Boolean operations in place with a slicemap on the same grid and context. False, after one
   * error that names both grids, when these differ.
   */
  bool Union(vtkSlicemap* other);
  bool Intersection(vtkSlicemap* other);
  bool Difference(vtkSlicemap* other);
  bool SymmetricDifference(vtkSlicemap* other);
  bool Complement();
  ///@}

  /**
   * Moves the set voxels by whole voxels; those that leave the grid are lost, zeros come in.
   */
  bool Shift(int dx, int dy, int dz);

  ///@{
  /**
   * The slicemap that `image` carries, or null when it carries none or when its scalars or its
   * geometry were modified after it was attached; and its counterpart.
   */
  static vtkSlicemap* GetFromImage(vtkImageData* image);
  void AttachTo(vtkImageData* image);
  ///@}

  /**
   * Whether there are bits in the OpenGL context that `context` hands out.
   */
  bool IsIn(vtkVoxelContext* context);

  ///@{
  /**
   * How often bits were read back to host memory, and uploaded from it, by this process; for tests
   * and for tuning pipelines.
   */
  static vtkIdType GetNumberOfReadBacks();
  static vtkIdType GetNumberOfUploads();
  ///@}

  /**
   * Size of the buffer in bytes.
   */
  vtkIdType GetNumberOfBytes();

  /**
   * Frees the bits; the geometry stays.
   */
  void ReleaseGraphicsResources();

#ifndef __VTK_WRAP__
  ///@{
  /**
   * Allocates all of `slicemaps`, which are in one context, for `grid`, and fills them from the
   * host, some rows of voxels at a time: `write` sets all words of these rows, padding included,
   * those of slicemap i from `words[i]` on; it returns false to stop. Counts as one upload of each.
   * False when stopped, or after one error.
   */
  using RowWriter = std::function<bool(
    std::int64_t firstRow, std::int64_t rows, const std::vector<std::uint32_t*>& words)>;
  static bool Write(
    const vtkVoxelGrid& grid, const std::vector<vtkSlicemap*>& slicemaps, const RowWriter& write);
  ///@}

  ///@{
  /**
   * For the passes of this module. Allocate gives an uninitialised buffer for `grid`, keeping the
   * present one where it fits, and returns false after one error when it can't; Read maps the words
   * for reading while `consume` runs and counts as one read-back, CountReadBack counts what a pass
   * reads otherwise; Swap exchanges the bits; CopyVoxels fills this one, which is allocated, with
   * the voxels of `source`, moved by `offset`, and throws std::runtime_error.
   */
  bool Allocate(const vtkVoxelGrid& grid);
  void CopyVoxels(vtkSlicemap* source, const std::array<int, 3>& offset);
  bool Read(const std::function<void(const std::uint32_t* words)>& consume);
  static void CountReadBack();
  void Swap(vtkSlicemap* other);
  const vtkVoxelGrid& GetGrid() const;
  vtkVoxelGL::Buffer& GetBuffer();
  std::int64_t GetWordsPerRow() const;
  std::int64_t GetNumberOfWords() const;
  static std::int64_t GetWordsPerRow(const vtkVoxelGrid& grid);
  static std::int64_t GetNumberOfWords(const vtkVoxelGrid& grid);
  ///@}
#endif

protected:
  vtkSlicemap();
  ~vtkSlicemap() override;

private:
  vtkSlicemap(const vtkSlicemap&) = delete;
  void operator=(const vtkSlicemap&) = delete;

  bool Combine(const vtkSlicemapExpression& expression, vtkSlicemap* other);

  struct Internals;
  std::unique_ptr<Internals> Storage;
};

#endif
