// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkImageToSlicemap
 * @brief level sets of a scalar volume, or labels of a label map, as bits on the GPU
 *
 * Makes voxels of the scalars of an image, such as a CT: a set of voxels for each value, all of
 * them in one pass over the scalars. The output of value i is at port i; it carries its
 * vtkSlicemap, so that vtkVoxelMorphology, vtkVoxelBoolean and others work on the sets without a
 * transfer.
 * | mode | voxels of value i |
 * | --- | --- |
 * | IsoValues | scalar >= value, the inside of VTK's contour filters |
 * | Ranges | lower <= scalar <= upper, see SetRange |
 * | Labels | scalar == value |
 *
 * The scalars are the active ones of the points, or those of the cells if there are only those,
 * unless SetInputArrayToProcess names others. They may be of any numeric type or VTK_BIT; of tuples
 * the first component counts. NaN is in no set. Scalars are compared in their own type, exactly: a
 * value of 299.5 parts integers between 299 and 300, one beyond the range of the type puts all of
 * them, or none, into the set. (Arrays of other layouts than VTK's by tuples and by components are
 * compared as double.)
 *
 * The bits are packed on the host and sent to the GPU in slabs, an eighth of a byte for each voxel
 * and value; neither a copy of the scalars is made nor do they go to the GPU. The grid is that of
 * the image: extent, spacing, origin and direction. All of the input is asked for.
 *
 * <b>Output.</b> As vtkVoxelFilter tells, the voxels of each value at a port of its own; there are
 * as many ports as values. GetNumberOfFilledVoxels is that of the first one.
 *
 * <b>Errors.</b> One error, and empty outputs: those of vtkVoxelFilter; no values, a value that is
 * not set or NaN, a range with its lower end above its upper one; no such array, or one of strings.
 *
 * Level sets of large CT volumes that are kept as slicemaps, several at a time, are from
 *
 * Elmar Eisemann, Xavier Decoret: Single-Pass GPU Solid Voxelization for Real-Time Applications.
 * Graphics Interface 2008, pp. 73-80, section 7.
 *
 * @sa vtkVoxelFilter vtkSlicemap vtkVoxelMorphology vtkVoxelBoolean
 */

#ifndef vtkImageToSlicemap_h
#define vtkImageToSlicemap_h

#include "vtkVoxelFilter.h"
#include "vtkVoxelizationModule.h" // for export macro

#include <array>  // for ranges
#include <vector> // for values

class VTKVOXELIZATION_EXPORT vtkImageToSlicemap : public vtkVoxelFilter
{
public:
  static vtkImageToSlicemap* New();
  vtkTypeMacro(vtkImageToSlicemap, vtkVoxelFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ModeType
  {
    MODE_ISO_VALUES = 0,
    MODE_RANGES = 1,
    MODE_LABELS = 2
  };

  /**
   * Most values, and so output ports, that there may be.
   */
  enum
  {
    MAXIMUM_NUMBER_OF_VALUES = 4096
  };

  ///@{
  /**
   * Which voxels belong to a value, see above. Default: IsoValues.
   */
  vtkSetClampMacro(Mode, int, MODE_ISO_VALUES, MODE_LABELS);
  vtkGetMacro(Mode, int);
  void SetModeToIsoValues() { this->SetMode(MODE_ISO_VALUES); }
  void SetModeToRanges() { this->SetMode(MODE_RANGES); }
  void SetModeToLabels() { this->SetMode(MODE_LABELS); }
  ///@}

  ///@{
  /**
   * Value i, counted from 0; there are i + 1 values at least afterwards. In the mode Ranges it is
   * the range from `value` to `value`, and GetValue its lower end. NaN where none was set.
   */
  void SetValue(int i, double value);
  double GetValue(int i);
  ///@}

  ///@{
  /**
   * Range i for the mode Ranges, both ends included; infinities leave an end open. GetRange gives
   * the two ends.
   */
  void SetRange(int i, double lower, double upper);
  double* GetRange(int i) VTK_SIZEHINT(2);
  ///@}

  ///@{
  /**
   * How many values there are. Default: 0. The output has as many ports, and one for no values. New
   * values are to be set; connections to ports that go are removed.
   */
  void SetNumberOfValues(int number);
  int GetNumberOfValues();
  ///@}

  ///@{
  /**
   * The mode Ranges with one range, in the words of vtkImageThreshold: lower <= scalar <= upper,
   * scalar >= value, and scalar <= value.
   */
  void ThresholdBetween(double lower, double upper);
  void ThresholdByUpper(double value);
  void ThresholdByLower(double value);
  ///@}

protected:
  vtkImageToSlicemap();
  ~vtkImageToSlicemap() override = default;

  void CheckInputs(const std::vector<vtkVoxelGrid>& inputs) override;
  vtkDataArray* FindScalars(vtkImageData* image, bool& ofCells) override;
  bool ExecuteOnImages(
    const std::vector<vtkImageData*>& inputs, const std::vector<vtkImageData*>& outputs) override;
  std::int64_t GetBytesOfOutput(const vtkVoxelGrid& grid) override;

private:
  vtkImageToSlicemap(const vtkImageToSlicemap&) = delete;
  void operator=(const vtkImageToSlicemap&) = delete;

  using Range = std::array<double, 2>;

  bool HasValue(int i);
  Range GetBounds(int i);

  int Mode = MODE_ISO_VALUES;
  std::vector<Range> Ranges;
  Range Answer; // the one that GetRange gave last
};

#endif
