/**
 * @file   VoxelTestFiles.h
 * @brief  What the tests of readers and writers share: a folder for their files, bytes, damage.
 */
#ifndef VoxelTestFiles_h
#define VoxelTestFiles_h

#include <string>

namespace VoxelTestFiles
{

/// Makes an empty folder of this name in the test's temporary one (the argument -T), for PathOf.
void UseFolder(const std::string& name, int argc, char* argv[]);

/// Of a file in the folder; of the folder itself without a name.
std::string PathOf(const std::string& name = {});

std::string ReadBytes(const std::string& path);
void WriteBytes(const std::string& path, const std::string& bytes);

/// With three bytes changed: seeds that are even damage the first `header` bytes, others any.
std::string Damaged(std::string bytes, unsigned int seed, std::size_t header);

}

#endif
