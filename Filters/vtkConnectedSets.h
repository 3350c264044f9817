// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkConnectedSets.h
 * Private header: sets of connected elements, by a representative of each.
 */

#ifndef vtkConnectedSets_h
#define vtkConnectedSets_h

#include "vtkType.h"

#include <numeric>
#include <vector>

class vtkConnectedSets
{
public:
  explicit vtkConnectedSets(vtkIdType elements)
    : Parents(elements)
  {
    std::iota(this->Parents.begin(), this->Parents.end(), vtkIdType(0));
  }

  vtkIdType Find(vtkIdType element)
  {
    while (this->Parents[element] != element)
    {
      this->Parents[element] = this->Parents[this->Parents[element]];
      element = this->Parents[element];
    }
    return element;
  }

  void Join(vtkIdType a, vtkIdType b) { this->Parents[this->Find(a)] = this->Find(b); }

private:
  std::vector<vtkIdType> Parents;
};

#endif
// VTK-HeaderTest-Exclude: vtkConnectedSets.h
