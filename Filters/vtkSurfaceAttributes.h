// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkSurfaceAttributes.h
 * Private header: arrays of a mesh carried over to the voxels that its triangles overlap
 * (OpenGL 4.3). See vtkHybridSurfaceVoxelizer for what is computed.
 */

#ifndef vtkSurfaceAttributes_h
#define vtkSurfaceAttributes_h

#include "vtkSurfacePass.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkImageData;
class vtkSlicemapNumbering;

class vtkSurfaceAttributes
{
public:
  enum class Combination
  {
    Average,
    Minimum,
    Maximum,
    First
  };

  explicit vtkSurfaceAttributes(Combination combination)
    : Combine(combination)
  {
  }

  /// The name of the array that AddImage makes.
  static constexpr const char* ImageName = "Texture";

  ///@{
  /// Adds the point or cell array `name` of `input`, whose triangles are those of `mesh`, or the
  /// colours that an image has at its texture coordinates. Throws std::runtime_error with a message
  /// for the user when it can't be done.
  void AddArray(vtkDataObject* input, const vtkVoxelMesh& mesh, const std::string& name);
  void AddImage(vtkDataObject* input, const vtkVoxelMesh& mesh, vtkImageData* image);
  ///@}

  int GetNumber() const { return static_cast<int>(this->Sources.size()); }

  /// An array of the type and with as many components as the result of attribute `i`, of `n`
  /// tuples; what lies in them is undefined. Throws std::runtime_error when there is no memory.
  vtkSmartPointer<vtkDataArray> NewArray(int i, vtkIdType n) const;

  /// Bytes that the results of all attributes take for one voxel.
  std::int64_t GetBytesPerVoxel() const;

  /// Bytes of the largest buffer that Compute needs for one voxel.
  std::int64_t GetWorkBytesPerVoxel() const;

  /// Attribute `i` at the voxels of `slicemap`, by their numbers, of which there is one at least;
  /// in the current context. Null when told to stop.
  vtkSmartPointer<vtkDataArray> Compute(int i, const vtkVoxelMesh& mesh, vtkSlicemap* slicemap,
    const vtkSlicemapNumbering& numbering, const vtkSurfacePass::Settings& settings,
    const vtkSurfacePass::Progress& progress);

private:
  /// Values of the points or triangles of the mesh, and how to make the result of what is stored.
  struct Source
  {
    std::string Name;
    bool OfPoints = true;
    int Components = 1;
    int ResultType = VTK_FLOAT;
    std::vector<float> Values;
    std::vector<double> Low; ///< of an average: what stands for 0 and for 1, by component
    std::vector<double> High;
    vtkSmartPointer<vtkImageData> Image;
    vtkVoxelGL::Buffer Buffer;
    vtkVoxelGL::Texture Texture;
    vtkVoxelGL::Texture ImageTexture;
  };

  void Normalize(Source& source) const;
  static void Upload(Source& source, const vtkVoxelGL::Context& context);

  Combination Combine;
  std::vector<Source> Sources;
};

#endif
// VTK-HeaderTest-Exclude: vtkSurfaceAttributes.h
