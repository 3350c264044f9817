/**
 * @file   VoxelFlood.h
 * @brief  What can be reached past voxels, from outside or from a voxel: whether a surface
 * separates, and what holds together.
 */
#ifndef VoxelFlood_h
#define VoxelFlood_h

#include "VoxelReference.h"

namespace VoxelReference
{

/**
 * The voxels that a flood from outside reaches, 0 or 1 a voxel. It spreads from unset voxel to
 * unset voxel, over faces (connectivity 6), edges too (18), or corners too (26); all around the
 * grid lies one more layer of voxels, which are outside. Throws std::invalid_argument for another
 * connectivity.
 */
Volume FloodFromOutside(const Volume& barrier, int connectivity);

/**
 * The set voxels that a flood over set voxels reaches, from where it reaches most; of several such
 * places, from the first voxel in the order of offsets. Empty when no voxel is set.
 */
Volume LargestFlood(const Volume& voxels, int connectivity);

}

#endif
