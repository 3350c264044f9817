// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VoxelPipeline.h
 * From files to voxels: the voxelizers of all meshes, or what takes those of a volume, and the
 * filters that the steps ask for.
 */

#ifndef VoxelPipeline_h
#define VoxelPipeline_h

#include "VoxelOutput.h"

#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

class Messages;
struct Options;
class Terminal;
class vtkDataObject;
class vtkImageData;
class vtkVoxelAlgorithm;
class vtkVoxelFilter;
class vtkVoxelizer;

/**
 * The voxels stay on the GPU up to the last filter, which alone reads its result back, but for
 * those of holes and components. All functions but the getters throw Failure.
 */
class VoxelPipeline
{
public:
  /// Reads what the options have beside meshes, volumes and masks.
  VoxelPipeline(const Options& options, Messages& messages, Terminal& terminal);
  ~VoxelPipeline();
  VoxelPipeline(const VoxelPipeline&) = delete;
  void operator=(const VoxelPipeline&) = delete;

  /// Reads these, and connects all.
  void Read();

  /// Makes voxels of this kind, which there may be of pipelines without steps.
  void Run(VoxelOutput::Kind kind);

  /**
   * The same for `write`, which has the result make its voxels slab by slab, and returns how many
   * are set.
   */
  void RunInSlabs(const std::function<vtkIdType(vtkVoxelAlgorithm* result)>& write);

  /// The last one, whose output are the voxels.
  vtkVoxelAlgorithm* GetResult() const;

  /// A mesh, or a volume as INPUT, and what makes voxels of it.
  struct Source
  {
    std::string File;
    vtkSmartPointer<vtkVoxelAlgorithm> Maker; // a vtkVoxelizer for meshes
  };

  /// INPUT, and then all meshes of steps.
  const std::vector<Source>& GetSources() const { return this->Sources; }

  /// The grid of the voxels, whatever their kind, as an image without arrays.
  vtkSmartPointer<vtkImageData> GetGrid() const;

private:
  vtkSmartPointer<vtkDataObject> Mend(vtkDataObject* object, const std::string& file);
  void FitGrid();
  void Connect();
  vtkVoxelizer* AddSource(vtkDataObject* mesh, const std::string& file);
  vtkImageData* PlaceMask(vtkImageData* mask, const std::string& file);
  void Update(vtkVoxelAlgorithm* algorithm, VoxelOutput::Kind kind, const std::string& label);
  void Conclude(vtkVoxelAlgorithm* algorithm, vtkIdType filled, const std::string& label);
  std::string ExplainEmptiness(vtkVoxelAlgorithm* algorithm) const;

  const Options& Asked;
  Messages& Said;
  Terminal& Shown;

  std::vector<Source> Sources;
  std::vector<vtkSmartPointer<vtkDataObject>> StepObjects; // by step; null where it has no file
  std::vector<vtkSmartPointer<vtkVoxelFilter>> Filters;    // by step
  vtkSmartPointer<vtkImageData> StepGrid;                  // whose points are the voxels
};

#endif
