#include "VoxelTestMeshes.h"

#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkLoopSubdivisionFilter.h>
#include <vtkMath.h>
#include <vtkMinimalStandardRandomSequence.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPoints.h>
#include <vtkReverseSense.h>
#include <vtkSphereSource.h>
#include <vtkStripper.h>
#include <vtkTransform.h>
#include <vtkTriangleFilter.h>

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace VoxelTestMeshes
{
namespace
{

/// Numbers that are the same on every platform.
class Random
{
public:
  explicit Random(int seed) { this->Sequence->Initialize(static_cast<vtkTypeUInt32>(seed)); }

  double Between(double low, double high) { return this->Sequence->GetNextRangeValue(low, high); }

  int Below(int count) { return std::min(static_cast<int>(this->Between(0.0, count)), count - 1); }

  Vector InCube(double low, double high)
  {
    const double x = this->Between(low, high);
    const double y = this->Between(low, high);
    const double z = this->Between(low, high);
    return { x, y, z };
  }

private:
  vtkNew<vtkMinimalStandardRandomSequence> Sequence;
};

using Polygons = std::vector<std::vector<vtkIdType>>;

Mesh MakeMesh(const std::vector<Vector>& corners, const Polygons& polygons)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vector& corner : corners)
  {
    points->InsertNextPoint(corner.data());
  }
  vtkNew<vtkCellArray> cells;
  for (const std::vector<vtkIdType>& polygon : polygons)
  {
    cells->InsertNextCell(static_cast<vtkIdType>(polygon.size()), polygon.data());
  }
  Mesh mesh = Mesh::New();
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  return mesh;
}

std::vector<Vector> PointsOf(vtkPolyData* mesh)
{
  std::vector<Vector> points(mesh->GetNumberOfPoints());
  for (std::size_t point = 0; point < points.size(); ++point)
  {
    mesh->GetPoint(static_cast<vtkIdType>(point), points[point].data());
  }
  return points;
}

Polygons PolygonsOf(vtkPolyData* mesh)
{
  Polygons polygons;
  vtkCellArray* cells = mesh->GetPolys();
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    cells->GetCellAtId(cell, count, points);
    polygons.emplace_back(points, points + count);
  }
  return polygons;
}

std::vector<Vector> BoxCorners(const Vector& low, const Vector& high)
{
  std::vector<Vector> corners;
  corners.reserve(8);
  for (int corner = 0; corner < 8; ++corner)
  {
    corners.push_back({ corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1],
      corner & 4 ? high[2] : low[2] });
  }
  return corners;
}

const Polygons BoxFaces = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 },
  { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };

/// What `change` makes of each point, cells as they are.
template <typename Change>
Mesh WithPoints(vtkPolyData* mesh, Change&& change)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(mesh->GetNumberOfPoints());
  for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
  {
    Vector position;
    mesh->GetPoint(point, position.data());
    position = change(position);
    points->SetPoint(point, position.data());
  }
  Mesh result = Mesh::New();
  result->ShallowCopy(mesh);
  result->SetPoints(points);
  return result;
}

template <typename Filter>
Mesh OutputOf(Filter* filter, vtkPolyData* input)
{
  filter->SetInputData(input);
  filter->Update();
  return filter->GetOutput();
}

}

//------------------------------------------------------------------------------------------------
std::vector<std::string> MeshDirectories(int argc, char* argv[])
{
  std::vector<std::string> directories;
  for (int argument = 1; argument + 1 < argc; ++argument)
  {
    if (std::string(argv[argument]) == "-D")
    {
      directories.emplace_back(argv[argument + 1]);
    }
  }
  return directories;
}

//------------------------------------------------------------------------------------------------
std::string FindMeshFile(const std::string& fileName, int argc, char* argv[])
{
  for (const std::string& directory : MeshDirectories(argc, argv))
  {
    std::string path = directory;
    path.append("/").append(fileName);
    if (vtksys::SystemTools::FileExists(path, true))
    {
      return path;
    }
  }
  return {};
}

//------------------------------------------------------------------------------------------------
Mesh ReadPLY(const std::string& fileName, int argc, char* argv[])
{
  const std::string path = FindMeshFile(fileName, argc, argv);
  if (path.empty())
  {
    return nullptr;
  }
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

//------------------------------------------------------------------------------------------------
Mesh FromTriangles(const std::vector<std::array<Vector, 3>>& triangles)
{
  std::vector<Vector> corners;
  Polygons polygons;
  for (const std::array<Vector, 3>& triangle : triangles)
  {
    const auto first = static_cast<vtkIdType>(corners.size());
    corners.insert(corners.end(), triangle.begin(), triangle.end());
    polygons.push_back({ first, first + 1, first + 2 });
  }
  return MakeMesh(corners, polygons);
}

//------------------------------------------------------------------------------------------------
Mesh QuadBox(const Vector& low, const Vector& high)
{
  return MakeMesh(BoxCorners(low, high), BoxFaces);
}

//------------------------------------------------------------------------------------------------
Mesh Box(const Vector& low, const Vector& high)
{
  Polygons triangles;
  for (const std::vector<vtkIdType>& face : BoxFaces)
  {
    triangles.push_back({ face[0], face[1], face[2] });
    triangles.push_back({ face[0], face[2], face[3] });
  }
  return MakeMesh(BoxCorners(low, high), triangles);
}

//------------------------------------------------------------------------------------------------
Mesh Tetrahedron(const std::array<Vector, 4>& corners)
{
  double edges[3][3];
  for (int edge = 0; edge < 3; ++edge)
  {
    vtkMath::Subtract(corners[edge + 1].data(), corners[0].data(), edges[edge]);
  }
  std::vector<Vector> points(corners.begin(), corners.end());
  if (vtkMath::Determinant3x3(edges[0], edges[1], edges[2]) < 0.0)
  {
    std::swap(points[2], points[3]);
  }
  return MakeMesh(points, { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } });
}

//------------------------------------------------------------------------------------------------
Mesh Sphere(const Vector& centre, double radius, int resolution)
{
  return Sphere(centre, radius, resolution, std::max(3, resolution / 2));
}

Mesh Sphere(const Vector& centre, double radius, int around, int rows)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  sphere->SetCenter(centre[0], centre[1], centre[2]);
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(around);
  sphere->SetPhiResolution(rows);
  sphere->Update();
  return sphere->GetOutput();
}

//------------------------------------------------------------------------------------------------
namespace
{
/// A grid of points that is closed both ways; `pointAt` takes the angles along and around it.
template <typename PointAt>
Mesh ClosedTube(int around, int along, const PointAt& pointAt)
{
  const double fullTurn = 2.0 * vtkMath::Pi();
  std::vector<Vector> points;
  Polygons triangles;
  for (int step = 0; step < along; ++step)
  {
    for (int turn = 0; turn < around; ++turn)
    {
      points.push_back(pointAt(fullTurn * step / along, fullTurn * turn / around));
      const vtkIdType here = static_cast<vtkIdType>(step) * around;
      const vtkIdType there = static_cast<vtkIdType>((step + 1) % along) * around;
      const vtkIdType next = (turn + 1) % around;
      triangles.push_back({ here + turn, here + next, there + next });
      triangles.push_back({ here + turn, there + next, there + turn });
    }
  }
  return MakeMesh(points, triangles);
}
}

Mesh TorusKnot(double size, int around, int along)
{
  // The (2, 3) knot on a torus; a tube about it, its frame made of the knot's own derivative.
  const auto knot = [size](double t) -> Vector
  {
    const double radius = size * (0.3 + 0.1 * std::cos(3.0 * t));
    return { radius * std::cos(2.0 * t), radius * std::sin(2.0 * t),
      size * 0.1 * std::sin(3.0 * t) };
  };
  return ClosedTube(around, along,
    [&](double t, double angle)
    {
      const Vector centre = knot(t);
      const Vector before = knot(t - 1e-3);
      const Vector after = knot(t + 1e-3);
      double tangent[3];
      double normal[3];
      double binormal[3];
      vtkMath::Subtract(after.data(), before.data(), tangent);
      vtkMath::Normalize(tangent);
      vtkMath::Cross(tangent, centre.data(), binormal);
      vtkMath::Normalize(binormal);
      vtkMath::Cross(binormal, tangent, normal);
      Vector point;
      for (int axis = 0; axis < 3; ++axis)
      {
        point[axis] = centre[axis] +
          size * 0.06 * (std::cos(angle) * normal[axis] + std::sin(angle) * binormal[axis]);
      }
      return point;
    });
}

Mesh Torus(double ring, double section, int around, int along)
{
  return ClosedTube(around, along,
    [&](double t, double angle) -> Vector
    {
      const double radius = ring + section * std::cos(angle);
      return { radius * std::cos(t), radius * std::sin(t), -section * std::sin(angle) };
    });
}

//------------------------------------------------------------------------------------------------
std::map<std::string, Mesh> PaperObjects()
{
  const Mesh cross = Appended({ Box({ 0, 4, 4 }, { 12, 8, 8 }), Box({ 4, 0, 4 }, { 8, 12, 8 }),
    Box({ 4, 4, 0 }, { 8, 8, 12 }) });
  // An H stands out of two sides.
  std::vector<Mesh> letters = { Box({ 0, 0, 0 }, { 12, 12, 12 }) };
  for (const double low : { -1.0, 11.5 })
  {
    const double high = low + 1.5;
    letters.push_back(Box({ low, 2, 2 }, { high, 10, 4 }));
    letters.push_back(Box({ low, 2, 8 }, { high, 10, 10 }));
    letters.push_back(Box({ low, 5, 3 }, { high, 7, 9 }));
  }
  std::vector<Mesh> truck = { Box({ 0, 2, 0 }, { 20, 3, 6 }), Box({ 6, 2.5, 0 }, { 20, 9, 6 }),
    Box({ 0, 2.5, 0.5 }, { 4.5, 7, 5.5 }) };
  for (const double x : { 2.5, 11.0, 17.0 })
  {
    for (const double z : { 0.7, 5.3 })
    {
      truck.push_back(Sphere({ x, 1.5, z }, 1.5, 40));
    }
  }
  return { { "Polyhedron", Sphere({ 0, 0, 0 }, 1.0, 8, 5) }, { "Torus", Torus(1.0, 0.35, 12, 24) },
    { "Knot", TorusKnot(1.0, 8, 96) }, { "Cross", cross }, { "Letters", Appended(letters) },
    { "Truck", Appended(truck) } };
}

Mesh StarPrism(const Vector& centre, double radius, double height, int spikes)
{
  const vtkIdType corners = 2 * static_cast<vtkIdType>(spikes);
  std::vector<Vector> points;
  for (int end = 0; end < 2; ++end)
  {
    for (vtkIdType corner = 0; corner < corners; ++corner)
    {
      const double angle = vtkMath::Pi() * (corner + 0.123) / spikes;
      const double reach = corner % 2 == 0 ? radius : 0.4 * radius;
      points.push_back({ centre[0] + reach * std::cos(angle), centre[1] + reach * std::sin(angle),
        centre[2] + (end - 0.5) * height });
    }
  }
  Polygons polygons(2);
  for (vtkIdType corner = 0; corner < corners; ++corner)
  {
    const vtkIdType next = (corner + 1) % corners;
    polygons[0].push_back(corners - 1 - corner);
    polygons[1].push_back(corners + corner);
    polygons.push_back({ corner, next, corners + next, corners + corner });
  }
  return MakeMesh(points, polygons);
}

//------------------------------------------------------------------------------------------------
Mesh HoledPrism(const Vector& centre, double radius, double height, bool triangulated)
{
  std::vector<Vector> points;
  for (const double z : { -0.5 * height, 0.5 * height })
  {
    for (const double reach : { radius, 0.45 * radius })
    {
      for (const auto& [x, y] : { std::pair{ -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } })
      {
        points.push_back({ centre[0] + x * reach, centre[1] + y * reach, centre[2] + z });
      }
    }
  }
  // Points 0 to 3 are the rim of the lower end and 4 to 7 that of its hole, 8 to 15 of the upper
  // one.
  Polygons polygons;
  if (!triangulated)
  {
    polygons.push_back({ 0, 4, 5, 6, 7, 4, 0, 3, 2, 1 });
    polygons.push_back({ 8, 9, 10, 11, 8, 12, 15, 14, 13, 12 });
  }
  for (vtkIdType i = 0; i < 4; ++i)
  {
    const vtkIdType next = (i + 1) % 4;
    polygons.push_back({ i, next, next + 8, i + 8 });
    polygons.push_back({ i + 4, i + 12, next + 12, next + 4 });
    if (triangulated)
    {
      polygons.push_back({ i, i + 4, next });
      polygons.push_back({ i + 4, next + 4, next });
      polygons.push_back({ i + 8, next + 8, i + 12 });
      polygons.push_back({ i + 12, next + 8, next + 12 });
    }
  }
  const Mesh prism = Rotated(MakeMesh(points, polygons));
  return triangulated ? Triangulated(prism) : prism;
}

//------------------------------------------------------------------------------------------------
Mesh NestedShells(const Vector& centre, const std::vector<double>& radii)
{
  std::vector<Mesh> shells;
  shells.reserve(radii.size());
  for (double radius : radii)
  {
    shells.push_back(Sphere(centre, radius));
  }
  return Appended(shells);
}

//------------------------------------------------------------------------------------------------
Mesh MixedScene(double size)
{
  const auto at = [size](double x, double y, double z) -> Vector {
    return { x * size, y * size, z * size };
  };
  return Rotated(Appended({
    Box(at(0.0, 0.0, 0.0), at(1.0, 1.0, 1.0)),
    Sphere(at(0.2, 0.2, 0.2), 0.15 * size, 8),
    Sphere(at(0.8, 0.2, 0.2), 0.15 * size, 32),
    Sphere(at(0.2, 0.8, 0.2), 0.15 * size, 128),
    Sphere(at(0.8, 0.8, 0.2), 0.15 * size, 512),
    Moved(TorusKnot(0.8 * size, 100, 1000), at(0.5, 0.5, 0.65)),
  }));
}

//------------------------------------------------------------------------------------------------
Mesh RandomTetrahedra(int seed, int count, double size)
{
  Random random(seed);
  std::vector<Mesh> tetrahedra;
  for (int number = 0; number < count; ++number)
  {
    std::array<Vector, 4> corners;
    std::generate(corners.begin(), corners.end(), [&] { return random.InCube(0.0, size); });
    tetrahedra.push_back(Tetrahedron(corners));
  }
  return Appended(tetrahedra);
}

//------------------------------------------------------------------------------------------------
Mesh RandomSlivers(int seed, int count, double size)
{
  constexpr std::array<double, 5> thicknesses = { 1e-3, 1e-6, 1e-9, 1e-12, 0.0 };
  Random random(seed);
  std::vector<Mesh> slivers;
  for (int number = 0; number < count; ++number)
  {
    const double thickness = size * thicknesses[number % thicknesses.size()];
    const bool needle = number / thicknesses.size() % 2 == 0;
    std::array<Vector, 4> corners;
    std::generate(corners.begin(), corners.end(), [&] { return random.InCube(0.0, size); });
    const double along = random.Between(0.0, 1.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto onSegment = [&](double t)
      { return corners[0][axis] + t * (corners[1][axis] - corners[0][axis]); };
      const double third = needle ? onSegment(along) : corners[2][axis];
      const double fourth =
        needle ? onSegment(1.0 - along) : (corners[0][axis] + corners[1][axis] + third) / 3.0;
      corners[2][axis] = third + (needle ? random.Between(-thickness, thickness) : 0.0);
      corners[3][axis] = fourth + random.Between(-thickness, thickness);
    }
    slivers.push_back(Tetrahedron(corners));
  }
  return Appended(slivers);
}

//------------------------------------------------------------------------------------------------
Mesh RandomHugeTetrahedra(int seed, int count, double size, double factor)
{
  Random random(seed);
  std::vector<Mesh> tetrahedra;
  for (int number = 0; number < count; ++number)
  {
    std::array<Vector, 4> corners;
    std::generate(
      corners.begin(), corners.end(), [&] { return random.InCube(-factor * size, factor * size); });
    tetrahedra.push_back(Tetrahedron(corners));
  }
  return Appended(tetrahedra);
}

//------------------------------------------------------------------------------------------------
Mesh RandomDiagonals(int seed, int count, double size)
{
  constexpr double width = 4.0;
  Random random(seed);
  std::vector<Mesh> tetrahedra;
  for (int number = 0; number < count; ++number)
  {
    std::array<Vector, 4> corners;
    for (int i = 0; i < 4; ++i)
    {
      corners[i] = random.InCube(0.0, width);
      const double along = i * (size - width) / 3.0;
      corners[i][0] += along;
      corners[i][1] += along;
    }
    tetrahedra.push_back(Tetrahedron(corners));
  }
  return Appended(tetrahedra);
}

//------------------------------------------------------------------------------------------------
Mesh RandomSpheres(int seed, int count, double size, int resolution)
{
  Random random(seed);
  std::vector<Mesh> spheres;
  for (int number = 0; number < count; ++number)
  {
    const double radius = random.Between(0.05 * size, 0.3 * size);
    spheres.push_back(Sphere(random.InCube(radius, size - radius), radius, resolution));
  }
  return Appended(spheres);
}

//------------------------------------------------------------------------------------------------
Mesh Perturbed(vtkPolyData* mesh, int seed, double amplitude)
{
  Random random(seed);
  return WithPoints(mesh,
    [&](const Vector& p) -> Vector
    {
      const Vector offset = random.InCube(-amplitude, amplitude);
      return { p[0] + offset[0], p[1] + offset[1], p[2] + offset[2] };
    });
}

//------------------------------------------------------------------------------------------------
Mesh OnLattice(vtkPolyData* mesh, double step)
{
  const auto snap = [step](double x) { return step * std::round(x / step); };
  return WithPoints(mesh,
    [&](const Vector& p) -> Vector {
      return { snap(p[0]), snap(p[1]), snap(p[2]) };
    });
}

//------------------------------------------------------------------------------------------------
Mesh Rotated(vtkPolyData* mesh)
{
  double centre[3];
  mesh->GetCenter(centre);
  vtkNew<vtkTransform> rotation;
  rotation->Translate(centre);
  rotation->RotateWXYZ(37.3, 0.31, -0.77, 0.55);
  rotation->Translate(-centre[0], -centre[1], -centre[2]);
  return WithPoints(mesh,
    [&rotation](const Vector& p)
    {
      Vector rotated;
      rotation->TransformPoint(p.data(), rotated.data());
      return rotated;
    });
}

//------------------------------------------------------------------------------------------------
Mesh Moved(vtkPolyData* mesh, const Vector& offset, double scale)
{
  return WithPoints(mesh,
    [&](const Vector& p) -> Vector {
      return { scale * p[0] + offset[0], scale * p[1] + offset[1], scale * p[2] + offset[2] };
    });
}

//------------------------------------------------------------------------------------------------
Mesh Subdivided(vtkPolyData* mesh, int times)
{
  vtkNew<vtkLoopSubdivisionFilter> subdivide;
  subdivide->SetNumberOfSubdivisions(times);
  return OutputOf(subdivide.Get(), mesh);
}

//------------------------------------------------------------------------------------------------
Mesh Unshared(vtkPolyData* mesh)
{
  const std::vector<Vector> points = PointsOf(mesh);
  std::vector<Vector> corners;
  Polygons polygons = PolygonsOf(mesh);
  for (std::vector<vtkIdType>& polygon : polygons)
  {
    for (vtkIdType& point : polygon)
    {
      corners.push_back(points[point]);
      point = static_cast<vtkIdType>(corners.size()) - 1;
    }
  }
  return MakeMesh(corners, polygons);
}

//------------------------------------------------------------------------------------------------
Mesh Shuffled(vtkPolyData* mesh, int seed)
{
  Random random(seed);
  Polygons polygons = PolygonsOf(mesh);
  for (std::size_t last = polygons.size(); last > 1; --last)
  {
    std::swap(polygons[last - 1], polygons[random.Below(static_cast<int>(last))]);
  }
  for (std::vector<vtkIdType>& polygon : polygons)
  {
    std::rotate(polygon.begin(), polygon.begin() + random.Below(static_cast<int>(polygon.size())),
      polygon.end());
  }
  return MakeMesh(PointsOf(mesh), polygons);
}

//------------------------------------------------------------------------------------------------
Mesh Reversed(vtkPolyData* mesh)
{
  vtkNew<vtkReverseSense> reverse;
  return OutputOf(reverse.Get(), mesh);
}

//------------------------------------------------------------------------------------------------
Mesh AsStrips(vtkPolyData* mesh)
{
  vtkNew<vtkStripper> strip;
  return OutputOf(strip.Get(), mesh);
}

//------------------------------------------------------------------------------------------------
Mesh Triangulated(vtkPolyData* mesh)
{
  vtkNew<vtkTriangleFilter> triangulate;
  triangulate->PassVertsOff();
  triangulate->PassLinesOff();
  return OutputOf(triangulate.Get(), mesh);
}

//------------------------------------------------------------------------------------------------
Mesh WithDegenerates(vtkPolyData* mesh, int seed, int count)
{
  Random random(seed);
  std::vector<Vector> points = PointsOf(mesh);
  Polygons polygons = PolygonsOf(mesh);
  const auto original = static_cast<int>(points.size());
  const auto copyOf = [&points](vtkIdType point)
  {
    points.emplace_back(points[point]);
    return static_cast<vtkIdType>(points.size()) - 1;
  };
  for (int number = 0; number < count; ++number)
  {
    const vtkIdType a = random.Below(original);
    const vtkIdType b = random.Below(original);
    switch (number % 4)
    {
      case 0:
        polygons.push_back({ a, a, a });
        break;
      case 1:
        polygons.push_back({ a, copyOf(a), copyOf(a) });
        break;
      case 2:
        polygons.push_back({ a, b, a });
        break;
      default:
        polygons.push_back({ copyOf(b), a, b });
        break;
    }
  }
  return MakeMesh(points, polygons);
}

//------------------------------------------------------------------------------------------------
Mesh WithDoublePrecision(vtkPolyData* mesh)
{
  return WithPoints(mesh, [](const Vector& p) { return p; });
}

//------------------------------------------------------------------------------------------------
Mesh Appended(const std::vector<Mesh>& meshes)
{
  vtkNew<vtkAppendPolyData> append;
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  for (const Mesh& mesh : meshes)
  {
    append->AddInputData(mesh);
  }
  append->Update();
  return append->GetOutput();
}

//------------------------------------------------------------------------------------------------
Mesh WithHoles(vtkPolyData* mesh, int seed, int count)
{
  Random random(seed);
  Polygons polygons = PolygonsOf(mesh);
  for (int hole = 0; hole < count && !polygons.empty(); ++hole)
  {
    polygons.erase(polygons.begin() + random.Below(static_cast<int>(polygons.size())));
  }
  return MakeMesh(PointsOf(mesh), polygons);
}

//------------------------------------------------------------------------------------------------
int CountOpenEdges(vtkPolyData* mesh)
{
  const Mesh triangles = Triangulated(mesh);
  const std::vector<Vector> points = PointsOf(triangles);
  std::map<std::pair<Vector, Vector>, int> users;
  for (const std::vector<vtkIdType>& polygon : PolygonsOf(triangles))
  {
    for (std::size_t corner = 0; corner < polygon.size(); ++corner)
    {
      const Vector& a = points[polygon[corner]];
      const Vector& b = points[polygon[(corner + 1) % polygon.size()]];
      users[std::minmax(a, b)] += a == b ? 0 : 1;
    }
  }
  return static_cast<int>(std::count_if(
    users.begin(), users.end(), [](const auto& edge) { return edge.second % 2 != 0; }));
}

}
