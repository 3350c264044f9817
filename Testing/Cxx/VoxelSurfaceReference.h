/**
 * @file   VoxelSurfaceReference.h
 * @brief  Where the surface is: distances from voxel centres, and the voxels it touches.
 *
 * Everything is in index coordinates, so one unit is one voxel, and in double arithmetic. The
 * results are good to about 1e-12 times the largest index coordinate of the mesh.
 */
#ifndef VoxelSurfaceReference_h
#define VoxelSurfaceReference_h

#include "VoxelReference.h"

#include <vector>

namespace VoxelReference
{

/// Euclidean distance from a point to a triangle, which may be degenerate.
double DistanceToTriangle(const Vector& point, const Triangle& triangle);

/**
 * Half the edge of the smallest cube around `centre` that touches the triangle: the distance in the
 * maximum norm. So a triangle touches the closed voxel at `centre` iff this is <= 0.5. Found by the
 * separating axis theorem on the 13 axes of a cube and a triangle.
 */
double CubeDistanceToTriangle(const Vector& centre, const Triangle& triangle);

/// Euclidean distance in voxels from each voxel's centre to the surface; infinity beyond `reach`.
/// The voxels may come in any order.
std::vector<double> DistanceToSurface(vtkPolyData* mesh, const Grid& grid,
  const std::vector<Voxel>& voxels, double reach = 1.0, int threads = DefaultThreads);

/// The bits of TouchedVoxelsReference and ThinVoxelsReference.
enum Touch : unsigned char
{
  TouchedNearly = 1, ///< the surface touches the closed voxel grown by nearMargin on all sides
  TouchedSurely = 2  ///< the surface touches the voxel shrunk by SureMargin on all sides
};
constexpr double NearMargin = 1e-5;
constexpr double SureMargin = 1e-9;

/**
 * For each voxel 0 (not touched), TouchedNearly, or TouchedNearly | TouchedSurely.
 * An over-conservative result has to hold all surely touched voxels, an under-conservative one none
 * of them; voxels that are touched nearly, but not surely, are rounding's to decide.
 */
Volume TouchedVoxelsReference(vtkPolyData* mesh, const Grid& grid, int threads = DefaultThreads,
  double nearMargin = NearMargin);

/**
 * The thin, 6-separating surface, in the encoding of TouchedVoxelsReference and a subset of it.
 *
 * A voxel at the centre c overlaps a triangle with corners v_i, edges from v_i to v_i+1, and normal
 * n iff
 * - (a) the closed voxel meets the triangle's bounds;
 * - (b) |n.(c - v_0)| <= 0.5 max|n_k|: the octahedron in the voxel meets the plane;
 * - (c) in the projections along the three axes, m.(c - v_i) + 0.5 max|m_k| >= 0 for each edge, m
 *   being its normal to the inside: the square in the projected voxel reaches each edge's inside.
 *
 * Nearly: all of these hold with bounds, planes and edges moved outwards by nearMargin along each
 * axis, so by nearMargin times the sum of |n_k|. Surely: moved inwards by SureMargin.
 *
 * A projection without area is a segment, and no side of its edges is the inside. Triangles that
 * shrink to it, of either orientation, overlap |m.(c - v_i)| <= 0.5 max|m_k| in the limit, m being
 * the longest edge's normal: that is (c) then. It follows from (b) when the triangle has area. A
 * triangle without area in all projections lies in many planes: (b) need hold for one of them, and
 * it does by (c); it holds for all of them within sqrt(1/12) of the longest edge, so farther away
 * no voxel is surely touched. A projection has no area when it is narrower than SureMargin.
 */
Volume ThinVoxelsReference(vtkPolyData* mesh, const Grid& grid, int threads = DefaultThreads,
  double nearMargin = NearMargin);

}

#endif
