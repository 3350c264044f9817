// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Terminal.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkNew.h"

#include <algorithm>
#include <cctype>
#include <cstdio>

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

namespace
{
bool IsTerminal(FILE* stream)
{
#ifdef _WIN32
  return _isatty(_fileno(stream)) != 0;
#else
  return isatty(fileno(stream)) != 0;
#endif
}

/// Damaged files bring these into messages.
bool IsControl(unsigned char character)
{
  return std::iscntrl(character) != 0;
}

struct Watched
{
  Terminal* Screen;
  std::string Task;
};

void ShowWatched(vtkObject* caller, unsigned long /*event*/, void* data, void* /*callData*/)
{
  const auto* watched = static_cast<const Watched*>(data);
  watched->Screen->ShowProgress(watched->Task, static_cast<vtkAlgorithm*>(caller)->GetProgress());
}
}

Terminal::Terminal()
  : ShowsBar(IsTerminal(stderr))
{
}

Terminal::~Terminal()
{
  this->ClearBar();
}

void Terminal::BeQuiet()
{
  this->ClearBar();
  this->Quiet = true;
  this->ShowsBar = false;
}

void Terminal::PrintError(const std::string& message)
{
  this->Print("error", message);
}

void Terminal::PrintNote(const std::string& message)
{
  if (!this->Quiet)
  {
    this->Print("note", message);
  }
}

void Terminal::PrintWarning(const std::string& message)
{
  if (!this->Quiet && this->Warned.insert(message).second)
  {
    this->Print("warning", message);
  }
}

void Terminal::Print(const std::string& kind, const std::string& message)
{
  this->ClearBar();
  std::string line = message;
  std::replace_if(line.begin(), line.end(), IsControl, '?');
  std::fprintf(stderr, "vtkvoxelize: %s: %s\n", kind.c_str(), line.c_str());
}

void Terminal::ShowProgress(const std::string& task, double fraction)
{
  if (!this->ShowsBar)
  {
    return;
  }
  constexpr int width = 40;
  const double done = std::clamp(fraction, 0.0, 1.0);
  std::string bar = task + " ";
  bar.resize(12, ' ');
  bar += "[" + std::string(static_cast<std::size_t>(width * done), '#');
  bar.resize(13 + width, '.');
  char percent[8];
  std::snprintf(percent, sizeof(percent), "] %3d%%", static_cast<int>(100.0 * done));
  bar += percent;
  if (bar != this->Bar)
  {
    std::fprintf(stderr, "\r%s", bar.c_str());
    std::fflush(stderr);
    this->Bar = bar;
  }
}

void Terminal::ClearBar()
{
  if (!this->Bar.empty())
  {
    std::fprintf(stderr, "\r%*s\r", static_cast<int>(this->Bar.size()), "");
    std::fflush(stderr);
    this->Bar.clear();
  }
}

void Terminal::Watch(vtkAlgorithm* algorithm, const std::string& task)
{
  if (!this->ShowsBar)
  {
    return;
  }
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(new Watched{ this, task });
  command->SetClientDataDeleteCallback([](void* data) { delete static_cast<Watched*>(data); });
  command->SetCallback(ShowWatched);
  algorithm->AddObserver(vtkCommand::ProgressEvent, command);
  this->ShowProgress(task, 0.0);
}
