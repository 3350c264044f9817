#include "VoxelTestFiles.h"

#include <vtkTestUtilities.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

namespace
{
std::string Folder;
}

namespace VoxelTestFiles
{

void UseFolder(const std::string& name, int argc, char* argv[])
{
  char* temporary = vtkTestUtilities::GetArgOrEnvOrDefault("-T", argc, argv, "VTK_TEMP_DIR", ".");
  Folder = std::string(temporary) + "/" + name;
  delete[] temporary;
  std::filesystem::remove_all(Folder);
  std::filesystem::create_directories(Folder);
}

std::string PathOf(const std::string& name)
{
  return name.empty() ? Folder : Folder + "/" + name;
}

std::string ReadBytes(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), {} };
}

void WriteBytes(const std::string& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string Damaged(std::string bytes, unsigned int seed, std::size_t header)
{
  std::mt19937 random(seed);
  for (int i = 0; i < 3; ++i)
  {
    bytes[random() % (seed % 2 ? bytes.size() : header)] = static_cast<char>(random());
  }
  return bytes;
}

}
