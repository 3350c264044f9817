/**
 * @file   VoxelExactInside.h
 * @brief  Is a voxel's centre inside? By brute force over all triangles in exact arithmetic.
 *
 * It decides by the rule of VoxelReference.h, but shares no step of the computation with the
 * scanline: every decision is the sign of a polynomial in the index coordinates, evaluated without
 * any rounding as a sum of doubles (floating-point expansions: J. R. Shewchuk, "Adaptive Precision
 * Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997, section 2). It is slow,
 * and is there to check the scanline on small meshes.
 */
#ifndef VoxelExactInside_h
#define VoxelExactInside_h

#include "VoxelReference.h"

namespace VoxelReference
{

/// `mesh` has its points in the grid's index coordinates; see IndexMesh.
bool PointInMeshExact(const IndexMesh& mesh, const Voxel& voxel, Axis column = Axis::Z,
  FillRule rule = FillRule::Parity);

}

#endif
