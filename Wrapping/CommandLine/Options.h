// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Options.h
 * The command line of vtkvoxelize: one table gives both its parser and its help.
 */

#ifndef Options_h
#define Options_h

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

struct Options
{
  enum class MethodType
  {
    Solid,
    Surface,
    Depth,
    Tetra
  };

  /// What is done to the voxels of INPUT, and to what the steps before have made of them.
  struct Step
  {
    enum class Type
    {
      Unite,
      Intersect,
      Subtract,
      Xor,
      Complement,
      Dilate,
      Erode,
      Open,
      Close,
      FillHoles,
      KeepLargest
    };

    Type What;
    std::string Option;   // as it is given, for messages
    std::string File;     // of Unite to Xor
    int Reach = 0;        // of Dilate to Close: voxels to either side
    int Kernel = 0;       // of these: a constant of vtkVoxelMorphology
    int Connectivity = 0; // of FillHoles and KeepLargest: neighbours of a set voxel
  };

  std::string Input;
  std::string Output;

  /// Lower and upper end of the scalars of a volume that make voxels; unset is all but zero.
  std::optional<std::array<double, 2>> ScalarRange;

  std::optional<int> Resolution;
  std::optional<std::array<int, 3>> Dimensions;
  std::optional<double> VoxelSize;
  std::optional<std::array<double, 6>> Bounds;
  std::optional<int> Padding;
  std::optional<std::string> Reference;

  MethodType Method = MethodType::Solid;

  ///@{
  /**
   * Constants of the voxelizers of this module; unset is their default.
   */
  std::optional<int> Backend;
  std::optional<int> Mode; // solids, as the next two
  std::optional<int> FillRule;
  std::optional<int> ColumnAxis;
  std::optional<int> Separability; // surfaces, as the next
  std::optional<int> Combination;
  ///@}

  /**
   * Axes along which --method depth looks.
   */
  std::optional<std::array<bool, 3>> Axes;
  bool AutomaticAxes = false; ///< one of them where that does

  ///@{
  /**
   * What surfaces carry over to their voxels: arrays, and an image in a file.
   */
  std::vector<std::string> Attributes;
  std::optional<std::string> Texture;
  ///@}

  /// Whether meshes are mended before.
  bool Repair = false;

  ///@{
  /**
   * Of --method tetra: neighbours of a shell, and what variants there are. The axis about which
   * they are rotated is x, y or z, or any.
   */
  std::optional<int> Shell;
  std::optional<int> Variants;
  std::optional<int> FirstVariant;
  std::optional<int> Seed;
  std::optional<int> RotationAxis;
  static constexpr int AnyAxis = 3;
  std::optional<std::array<double, 2>> ScaleRange;
  std::optional<double> Displacement;
  bool StaysInPlace = false;
  ///@}

  std::vector<Step> Steps;

  ///@{
  /**
   * Kernel and connectivity for the steps to come, and whether one has had them.
   */
  int Kernel = 0;
  bool KernelIsUsed = true;
  int Connectivity = 26;
  bool ConnectivityIsUsed = true;
  ///@}

  std::optional<int> ScalarType;
  std::optional<int> Value;
  bool Cells = false;

  /// Bytes that slabs may take; unset is no slabs, but all voxels at once.
  std::optional<std::int64_t> MemoryLimit;

  std::optional<std::string> Picture;
  std::optional<int> UpAxis;

  bool Info = false;
  bool Quiet = false;
  bool Help = false;
  bool Version = false;

  static constexpr int DefaultResolution = 128;
  static constexpr int LargestPadding = std::numeric_limits<int>::max() / 4;

  /**
   * The options in the words that follow the program's name. Throws Failure with ExitCode::Usage
   * for words that make no sense, alone or together.
   */
  static Options Parse(const std::vector<std::string>& words);

  static std::string GetHelp();

  /// Whether the mesh is turned, scaled or displaced at random.
  bool HasRandomVariants() const
  {
    return this->RotationAxis || this->ScaleRange || this->Displacement;
  }

  /// Whether INPUT is a volume, and not a mesh.
  bool HasVolume() const;
};

#endif
