// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkVoxelBitsWriter
 * @brief writes voxels, or all variants of a model, as one bit a voxel
 *
 * A .bits file is a header of text, each line of which is a key and its values, and then bits:
 *
 *     #voxelbits 1
 *     dim NX NY NZ
 *     variants N            how many images of this size there are
 *     first F               number of the first variant
 *     seed S                that the variants were made from
 *     index I J K           of the first voxel
 *     origin X Y Z          where index 0, 0, 0 is
 *     spacing X Y Z
 *     direction 9 NUMBERS   row by row
 *     label TEXT            left out when there is none
 *     data
 *
 * Readers take all but dim for optional, and leave out keys that they don't know. The bits of a
 * variant come with x fastest, then y, then z, the first voxel in the highest bit of the first
 * byte, as NumPy's packbits and VTK_BIT have it; rows follow each other without a gap, and each
 * variant begins with a new byte. So in Python
 *
 *     head, data = open("model.bits", "rb").read().split(b"\ndata\n", 1)
 *     bits = numpy.frombuffer(data, numpy.uint8).reshape(n, -1)
 *     voxels = numpy.unpackbits(bits, axis=1, count=nx * ny * nz).reshape(n, nz, ny, nx)
 *
 * The input is a vtkImageData, or carries a vtkSlicemap; a voxel is set where the first component
 * of the active point scalars, or of the active cell scalars if there are only those, is not zero.
 * WriteBatch takes variants from a voxelizer instead.
 *
 * The format is the 1-bit raw one of
 *
 * GPU-Based Framework for Training 3D Convolutional Neural Networks with Voxelized Polygonal
 * Models, section IV
 *
 * with a header.
 *
 * <b>Errors.</b> One error, and no file, or the former one as it was: no file name, an empty image,
 * no voxels, a label of several lines, a file that can't be written. GetErrorCode tells scripts.
 *
 * @sa vtkVoxelBitsReader vtkBinvoxWriter vtkTetraCoveringVoxelizer
 */

#ifndef vtkVoxelBitsWriter_h
#define vtkVoxelBitsWriter_h

#include "vtkVoxelizationModule.h" // for export macro
#include "vtkWriter.h"

#include <functional> // for the implementation

class vtkImageData;
class vtkTetraCoveringVoxelizer;
struct vtkVoxelBitsFile;

class VTKVOXELIZATION_EXPORT vtkVoxelBitsWriter : public vtkWriter
{
public:
  static vtkVoxelBitsWriter* New();
  vtkTypeMacro(vtkVoxelBitsWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to write. Default: none.
   */
  vtkSetStringMacro(FileName);
  vtkGetStringMacro(FileName);
  ///@}

  ///@{
  /**
   * What the voxels show, such as the class of the model; one line of text. Default: none.
   */
  vtkSetStringMacro(Label);
  vtkGetStringMacro(Label);
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

  /**
   * Writes the variants `first` to `first` + `count` - 1 of the voxelizer's model, one at a time,
   * so that the batch takes no memory; shells come without the interior. The input plays no role.
   * False after one error: this one's, which has an error code, or the voxelizer's.
   */
  bool WriteBatch(vtkTetraCoveringVoxelizer* voxelizer, vtkTypeInt64 first, int count);

  vtkImageData* GetInput();

protected:
  vtkVoxelBitsWriter();
  ~vtkVoxelBitsWriter() override;

  void WriteData() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkVoxelBitsWriter(const vtkVoxelBitsWriter&) = delete;
  void operator=(const vtkVoxelBitsWriter&) = delete;

  vtkVoxelBitsFile MakeDescription() const;
  bool Guard(const std::function<bool()>& work);

  char* FileName = nullptr;
  char* Label = nullptr;
  bool InPlace = false;
};

#endif
