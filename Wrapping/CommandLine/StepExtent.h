// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file StepExtent.h
 * How much room steps need.
 */

#ifndef StepExtent_h
#define StepExtent_h

#include "Options.h"

#include <cstdint>
#include <vector>

/**
 * Follows the box outside of which all voxels are alike: unset at first, set after a complement. It
 * begins as that of the meshes that can change anything beyond, grows and shrinks with the steps,
 * and never reaches the border of a grid with the margin that this asks for.
 */
class StepExtent
{
public:
  explicit StepExtent(const std::vector<Options::Step>& steps);

  /// Whether the file of a step can set voxels outside of what the steps before have set.
  bool Adds(std::size_t step) const { return this->Additions[step]; }

  /// Voxels on every side of the box of all meshes that add, so that no border changes the result.
  int GetMargin() const;

  /// Whether a step compares the sizes of components of which one has no end.
  bool IsEndless() const { return this->Endless; }

private:
  void Add(const Options::Step& step);
  void Grow(std::int64_t reach);

  std::vector<bool> Additions;
  bool IsSetOutside = false;
  bool HasNeighbours = false;
  bool Endless = false;
  std::int64_t Reach = 0; // of the box, beyond that of the meshes
  std::int64_t Margin = 0;
};

#endif
