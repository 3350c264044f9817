// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ImageOutput.h
 * Writes the voxels to a file.
 */

#ifndef ImageOutput_h
#define ImageOutput_h

#include <string>

class Messages;
class StagedFiles;
class Terminal;
class vtkImageData;

/**
 * The file, or for .mhd two files, that the image goes to: .vti by VTK's writer; MetaImage here,
 * since VTK's writer leaves the direction matrix out, rounds the spacing and tells of no error.
 */
class ImageOutput
{
public:
  /**
   * Stages the files of the target. Throws Failure with ExitCode::Output when there is no format
   * for its extension, or when it can't be written.
   */
  ImageOutput(const std::string& target, StagedFiles& files);

  /**
   * Writes the image to the staged files. Throws Failure with ExitCode::Output when that fails; a
   * full disk is one reason.
   */
  void Write(vtkImageData* image, Messages& messages, Terminal& terminal) const;

  ///@{
  /**
   * Whether a file of this name may hold scalars of type VTK_BIT, and cell data.
   */
  static bool HasBits(const std::string& target);
  static bool HasCells(const std::string& target);
  ///@}

  /// What can be written, for messages: ".vti, .mha ...".
  static std::string GetExtensions();

private:
  void WriteXML(vtkImageData* image, Messages& messages, Terminal& terminal) const;
  void WriteMetaImage(vtkImageData* image) const;
  [[noreturn]] void Refuse(const std::string& why) const;

  std::string Target;
  std::string Extension;
  std::string File;     // staged: the image, or the header of a .mhd file
  std::string DataFile; // staged, for .mhd only
};

#endif
