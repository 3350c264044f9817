/**
 * @file   VoxelTestMeshes.h
 * @brief  Meshes for the tests: read from files, generated, random with fixed seeds, made harder.
 *
 * All generated meshes are closed unless said otherwise. The same arguments give the same mesh on
 * every machine.
 */
#ifndef VoxelTestMeshes_h
#define VoxelTestMeshes_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace VoxelTestMeshes
{

using Mesh = vtkSmartPointer<vtkPolyData>;
using Vector = std::array<double, 3>;

///@{
/**
 * Meshes in files.
 * Directories searched: each `-D DIR` among the test's arguments, in their order.
 */
std::vector<std::string> MeshDirectories(int argc, char* argv[]);
std::string FindMeshFile(const std::string& fileName, int argc, char* argv[]); ///< or empty
Mesh ReadPLY(const std::string& fileName, int argc, char* argv[]);             ///< or nullptr
///@}

///@{
/// Simple solids.
Mesh FromTriangles(const std::vector<std::array<Vector, 3>>& triangles); ///< points not shared
Mesh Box(const Vector& low, const Vector& high);                         ///< 12 triangles
Mesh QuadBox(const Vector& low, const Vector& high);                     ///< 6 quadrilaterals
Mesh Tetrahedron(const std::array<Vector, 4>& corners);                  ///< oriented outwards
Mesh Sphere(const Vector& centre, double radius, int resolution = 24);   ///< around the z axis
/// A sphere from pole to pole in so many rows of points, the poles among them.
Mesh Sphere(const Vector& centre, double radius, int around, int rows);
Mesh TorusKnot(double size, int around, int along); ///< 2 * around * along triangles
/// A torus around the z axis; 2 * around * along triangles.
Mesh Torus(double ring, double section, int around, int along);
/// A prism over a star with that many spikes; its two ends are non-convex n-gons.
Mesh StarPrism(const Vector& centre, double radius, double height, int spikes);
/// A square prism with a square hole from end to end, turned about all axes; each end is one n-gon
/// whose hole is joined to its rim by a bridge, or, triangulated, 8 triangles.
Mesh HoledPrism(const Vector& centre, double radius, double height, bool triangulated);
/// Spheres inside each other, alternately solid and hollow under the parity rule.
Mesh NestedShells(const Vector& centre, const std::vector<double>& radii);
/// Objects like those of the paper on depth buffers by Karabassi et al., by name, with as many
/// triangles or about: a polyhedron of 48 faces, a torus of 576, a knot of 1,536, a cross, a
/// cube with letters on two sides, and a truck, of fewer. The latter three are of parts that
/// overlap.
std::map<std::string, Mesh> PaperObjects();
/// Triangles of all sizes: a box, spheres from coarse to fine, and a fine knot in it; 0.5 M of
/// them.
Mesh MixedScene(double size);
///@}

///@{
/// Random closed soups; coordinates lie in [0, size] unless said otherwise.
Mesh RandomTetrahedra(int seed, int count, double size);
/// Tetrahedra as flat as 1e-3, 1e-6 ... of their length, down to exactly flat ones.
Mesh RandomSlivers(int seed, int count, double size);
/// Tetrahedra whose corners lie up to `factor` times the size away on all sides.
Mesh RandomHugeTetrahedra(int seed, int count, double size, double factor = 100.0);
/// Tetrahedra a few units wide from corner to corner of [0, size]^2, up to 4 high: their bounds are
/// large, though they cover little.
Mesh RandomDiagonals(int seed, int count, double size);
Mesh RandomSpheres(int seed, int count, double size, int resolution = 16);
///@}

///@{
/// Changes that keep a closed mesh closed.
Mesh Perturbed(vtkPolyData* mesh, int seed, double amplitude); ///< each shared point moves
/// Moves each point to the nearest multiple of `step`: on voxel centres (1), faces (0.5) and so on.
Mesh OnLattice(vtkPolyData* mesh, double step);
Mesh Rotated(vtkPolyData* mesh); ///< one fixed, arbitrary rotation about the centre of the bounds
Mesh Moved(vtkPolyData* mesh, const Vector& offset, double scale = 1.0); ///< scaled first
Mesh Subdivided(vtkPolyData* mesh, int times); ///< Loop: 4 times the triangles each
Mesh Unshared(vtkPolyData* mesh);              ///< as an STL file: each triangle its own points
/// Cells in another order, each turned cyclically. A non-planar n-gon thus gets another fan.
Mesh Shuffled(vtkPolyData* mesh, int seed);
Mesh Reversed(vtkPolyData* mesh); ///< all orientations
Mesh AsStrips(vtkPolyData* mesh);
Mesh Triangulated(vtkPolyData* mesh); ///< strips and n-gons into triangles
/// Adds triangles without area: points, segments, with equal ids or equal coordinates.
Mesh WithDegenerates(vtkPolyData* mesh, int seed, int count);
Mesh WithDoublePrecision(vtkPolyData* mesh);
Mesh Appended(const std::vector<Mesh>& meshes);
///@}

/// Leaves out triangles: the mesh gets holes.
Mesh WithHoles(vtkPolyData* mesh, int seed, int count);

/// Edges with an odd number of triangles, points being equal when their coordinates are. None: the
/// mesh is closed for the parity rule.
int CountOpenEdges(vtkPolyData* mesh);

}

#endif
