// Writes small .vdb files of many kinds into a folder, for FuzzVDB to begin with.

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <fstream>
#include <string>

namespace
{
const openvdb::CoordBBox Box(openvdb::Coord(-2, 1, 3), openvdb::Coord(9, 5, 8));

template <typename Grid>
typename Grid::Ptr MakeGrid(const std::string& name, const typename Grid::ValueType& value)
{
  // As OpenVDB's library makes it, which saves compiling that here.
  const auto grid = openvdb::gridPtrCast<Grid>(openvdb::GridBase::createGrid(Grid::gridType()));
  auto accessor = grid->getAccessor();
  for (auto place = Box.begin(); place; ++place)
  {
    accessor.setValue(*place, value);
  }
  grid->setName(name);
  grid->insertMeta("vtk_extent_min", openvdb::Vec3IMetadata(openvdb::Vec3i(-3, 0, 2)));
  grid->insertMeta("vtk_extent_max", openvdb::Vec3IMetadata(openvdb::Vec3i(10, 6, 9)));
  return grid;
}

void Write(const std::string& file, const openvdb::GridCPtrVec& grids, std::uint32_t compression)
{
  openvdb::io::File archive(file);
  archive.setCompression(compression);
  archive.write(grids);
}
}

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    return EXIT_FAILURE;
  }
  const std::string folder = std::string(argv[1]) + "/";
  openvdb::initialize();

  const auto occupancy = MakeGrid<openvdb::BoolGrid>("occupancy", true);
  const auto density = MakeGrid<openvdb::FloatGrid>("density", 0.5f);
  const auto normals = MakeGrid<openvdb::Vec3SGrid>("normals", openvdb::Vec3s(1.0f, 0.0f, 0.0f));
  const auto labels = MakeGrid<openvdb::Int32Grid>("labels", 7);
  const auto ids = MakeGrid<openvdb::Int64Grid>("ids", 7);
  const auto depth = MakeGrid<openvdb::DoubleGrid>("depth", 7.0);
  const auto half = MakeGrid<openvdb::FloatGrid>("half", 0.5f);
  half->setSaveFloatAsHalf(true);
  half->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
  const auto twin = density->copyWithNewTree();
  twin->setTree(density->treePtr());

  namespace io = openvdb::io;
  Write(folder + "bool-none", { occupancy }, io::COMPRESS_NONE);
  Write(folder + "bool-zip", { occupancy }, io::COMPRESS_ZIP | io::COMPRESS_ACTIVE_MASK);
  Write(folder + "float-mask", { density }, io::COMPRESS_ACTIVE_MASK);
  Write(folder + "float-zip", { density }, io::COMPRESS_ZIP | io::COMPRESS_ACTIVE_MASK);
  Write(folder + "half-zip", { half }, io::COMPRESS_ZIP);
  Write(folder + "vectors-zip", { normals }, io::COMPRESS_ZIP | io::COMPRESS_ACTIVE_MASK);
  Write(
    folder + "integers-zip", { labels, ids, depth }, io::COMPRESS_ZIP | io::COMPRESS_ACTIVE_MASK);
  Write(folder + "twins-zip", { density, twin }, io::COMPRESS_ZIP | io::COMPRESS_ACTIVE_MASK);
  if (io::Archive::hasBloscCompression())
  {
    Write(folder + "float-blosc", { density }, io::COMPRESS_BLOSC | io::COMPRESS_ACTIVE_MASK);
    Write(folder + "vectors-blosc", { normals }, io::COMPRESS_BLOSC);
  }
  std::ofstream stream(folder + "stream", std::ios::binary);
  io::Stream(stream).write(openvdb::GridCPtrVec{ occupancy, half });
  return EXIT_SUCCESS;
}
