// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VoxelOutput.h
 * Writes the voxels to a file.
 */

#ifndef VoxelOutput_h
#define VoxelOutput_h

#include "vtkType.h"

#include <cstdint>
#include <string>

class Messages;
struct Options;
class StagedFiles;
class Terminal;
class vtkDataObject;
class vtkImageData;
class vtkTetraCoveringVoxelizer;
class vtkVoxelAlgorithm;

/**
 * The file, or for .mhd two files, that the voxels go to: those of VTK's XML by its writers,
 * .binvox, .bits and .vdb by the module's; MetaImage here, since VTK's writer leaves the direction
 * matrix out, rounds the spacing and tells of no error.
 */
class VoxelOutput
{
public:
  /// What a file may hold; the values are the output ports of vtkHybridSurfaceVoxelizer.
  enum class Kind
  {
    Image = 0,
    List = 1,
    Octree = 2
  };

  /**
   * Stages the files of the target. Throws Failure with ExitCode::Output when there is no format
   * for its extension, or when it can't be written.
   */
  VoxelOutput(const std::string& target, StagedFiles& files);

  /**
   * Writes the voxels, of the kind of the target, to the staged files. Throws Failure with
   * ExitCode::Output when that fails; a full disk is one reason.
   */
  void Write(vtkDataObject* voxels, Messages& messages, Terminal& terminal) const;

  /**
   * Has the voxels made slab by slab, within the limit of the options, and writes them to the
   * staged file. Returns how many are set. Throws Failure with ExitCode::Voxelization when they
   * can't be made so, else what Write throws.
   */
  std::int64_t WriteSlabs(vtkVoxelAlgorithm* voxels, const Options& options, Messages& messages,
    Terminal& terminal) const;

  /**
   * Writes all variants that the options of the voxelizer stand for, from the given one on, where
   * the target takes variants. Throws Failure.
   */
  void WriteBatch(vtkTetraCoveringVoxelizer* voxelizer, vtkTypeInt64 first, int count,
    Messages& messages, Terminal& terminal) const;

  /// What a file of this name holds; an image where the extension is not known.
  static Kind GetKind(const std::string& target);

  ///@{
  /**
   * Whether a file of this name may hold scalars of type VTK_BIT, cell data, and attributes.
   */
  static bool HasBits(const std::string& target);
  static bool HasCells(const std::string& target);
  static bool HasAttributes(const std::string& target);
  ///@}

  /// Whether set voxels are written from a slicemap, without an array of them.
  static bool TakesSlicemap(const std::string& target);

  ///@{
  /**
   * Whether a file of this name can be written by WriteSlabs, and those that can, for messages.
   */
  static bool TakesSlabs(const std::string& target);
  static std::string GetExtensionsOfSlabs();
  ///@}

  /// Whether a file of this name may hold several variants of a model.
  static bool TakesVariants(const std::string& target);

  /// What can be written, for messages: ".vti, .mha ...".
  static std::string GetExtensions();

private:
  void WriteXML(vtkDataObject* voxels, Messages& messages, Terminal& terminal) const;
  template <typename Writer>
  void WriteInPlace(vtkDataObject* voxels, Messages& messages, Terminal& terminal) const;
  template <typename Writer, typename Work>
  std::string RunWriter(Writer* writer, Messages& messages, const Work& work) const;
  void WriteMetaImage(vtkImageData* image) const;
  [[noreturn]] void Refuse(const std::string& why) const;

  std::string Target;
  std::string Extension;
  std::string File;     // staged: the voxels, or the header of a .mhd file
  std::string DataFile; // staged, for .mhd only
};

#endif
