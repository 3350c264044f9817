// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "StagedFiles.h"

#include "Failure.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>

namespace
{
namespace fs = std::filesystem;

constexpr std::size_t MaximumFiles = 4;
constexpr std::size_t MaximumLength = 4096;

// What the signal handler removes. Plain memory, since a handler may not touch anything else.
std::array<std::array<char, MaximumLength>, MaximumFiles> Registered;
volatile std::sig_atomic_t NumberOfRegistered = 0;

const std::vector<int> EndingSignals = {
  SIGINT,
  SIGTERM,
#ifdef SIGHUP
  SIGHUP,
#endif
#ifdef SIGQUIT
  SIGQUIT,
#endif
};

extern "C" void RemoveRegisteredAndEnd(int signal)
{
  for (int i = 0; i < NumberOfRegistered; ++i)
  {
    std::remove(Registered[i].data());
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// From here on the signals remove what is registered. Those ignored before, by nohup say, stay so.
void HandleSignals()
{
  for (const int signal : EndingSignals)
  {
    if (std::signal(signal, RemoveRegisteredAndEnd) == SIG_IGN)
    {
      std::signal(signal, SIG_IGN);
    }
  }
#ifdef SIGXFSZ
  // Writing beyond the limit of the file size then fails like writing to a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
#endif
}

[[noreturn]] void RefuseToWrite(const std::string& target, const std::string& why)
{
  throw Failure(ExitCode::Output, "cannot write " + target + ": " + why);
}

std::string MakeTemporaryName(const fs::path& target)
{
  std::random_device random;
  return (target.parent_path() /
    ("." + target.stem().string() + "-" + std::to_string(random()) + target.extension().string()))
    .string();
}

/// Where a link points to, so that the link outlives the renaming.
fs::path FollowLinks(const fs::path& target)
{
  std::error_code error;
  const fs::path followed = fs::weakly_canonical(target, error);
  return error ? target : followed;
}
}

StagedFiles::StagedFiles()
{
  HandleSignals();
}

StagedFiles::~StagedFiles()
{
  for (const File& file : this->Files)
  {
    std::remove(file.Temporary.c_str());
  }
  NumberOfRegistered = 0;
}

std::string StagedFiles::Add(const std::string& target)
{
  const fs::path path = FollowLinks(target);
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_regular_file(path, error))
  {
    RefuseToWrite(target, fs::is_directory(path, error) ? "it is a folder" : "it is not a file");
  }
  std::string temporary = MakeTemporaryName(path);
  if (temporary.size() >= MaximumLength || this->Files.size() == MaximumFiles)
  {
    RefuseToWrite(target, std::strerror(ENAMETOOLONG));
  }
  auto& registered = Registered[this->Files.size()];
  registered[temporary.copy(registered.data(), temporary.size())] = '\0';
  this->Files.push_back({ temporary, path.string() });
  NumberOfRegistered = static_cast<int>(this->Files.size());
  FILE* const file = std::fopen(temporary.c_str(), "wbx");
  if (!file)
  {
    RefuseToWrite(target, std::strerror(errno));
  }
  std::fclose(file);
  return temporary;
}

void StagedFiles::Commit()
{
  for (const File& file : this->Files)
  {
    std::error_code error;
    fs::rename(file.Temporary, file.Target, error);
    if (error)
    {
      RefuseToWrite(file.Target, error.message());
    }
  }
  NumberOfRegistered = 0;
  this->Files.clear();
}
