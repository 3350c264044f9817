// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "StepExtent.h"

#include <algorithm>

StepExtent::StepExtent(const std::vector<Options::Step>& steps)
{
  for (const Options::Step& step : steps)
  {
    this->Add(step);
  }
}

void StepExtent::Add(const Options::Step& step)
{
  using Type = Options::Step::Type;
  bool adds = false;
  this->HasNeighbours = this->HasNeighbours || step.Reach > 0;
  switch (step.What)
  {
    case Type::Unite:
      adds = !this->IsSetOutside;
      break;
    case Type::Intersect:
      adds = this->IsSetOutside;
      this->IsSetOutside = false;
      break;
    case Type::Subtract:
      adds = this->IsSetOutside;
      break;
    case Type::Xor:
      adds = true;
      break;
    case Type::Complement:
      this->IsSetOutside = !this->IsSetOutside;
      break;
    case Type::Dilate:
      this->Grow(this->IsSetOutside ? -step.Reach : step.Reach);
      break;
    case Type::Erode:
      this->Grow(this->IsSetOutside ? step.Reach : -step.Reach);
      break;
    case Type::Open:
    case Type::Close:
      if (this->IsSetOutside == (step.What == Type::Open))
      {
        this->Grow(step.Reach);
        this->Grow(-step.Reach);
      }
      break;
    case Type::FillHoles:
      // All holes are holes of the box; set voxels around it must be seen to enclose them.
      this->HasNeighbours = this->HasNeighbours || this->IsSetOutside;
      break;
    case Type::KeepLargest:
      this->Endless = this->Endless || this->IsSetOutside;
      break;
  }
  this->Additions.push_back(adds);
}

void StepExtent::Grow(std::int64_t reach)
{
  this->Reach = std::max<std::int64_t>(0, this->Reach + reach);
  this->Margin = std::max(this->Margin, this->Reach);
}

int StepExtent::GetMargin() const
{
  // One voxel more shows the steps what lies beyond the box.
  const std::int64_t margin = this->HasNeighbours ? this->Margin + 1 : 0;
  return static_cast<int>(std::min<std::int64_t>(margin, Options::LargestPadding));
}
