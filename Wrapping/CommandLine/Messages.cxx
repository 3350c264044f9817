// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Messages.h"

#include "vtkCommand.h"
#include "vtkLogger.h"
#include "vtkOutputWindow.h"

#include <iostream>
#include <stdexcept>
#include <utility>

namespace
{
/**
 * "ERROR: In FILE, line N\nCLASS (ADDRESS): SENTENCE\n\n" becomes SENTENCE, in one line. Functions
 * of no class write (nullptr) instead.
 */
std::string GetSentence(const std::string& text)
{
  std::istringstream lines(text);
  std::string sentence;
  for (std::string line; std::getline(lines, line);)
  {
    const bool isHead = line.find(": In ") != std::string::npos && sentence.empty() &&
      line.find(", line ") != std::string::npos;
    if (line.empty() || isHead)
    {
      continue;
    }
    const auto object = line.find("): ");
    const bool isNamed = line.rfind("(0x", object) < object || line.rfind("(nullptr", 0) == 0;
    if (sentence.empty() && object != std::string::npos && isNamed)
    {
      line.erase(0, object + 3);
    }
    sentence += (sentence.empty() ? "" : " ") + line;
  }
  const auto last = sentence.find_last_not_of(" \t\r.");
  sentence.erase(last == std::string::npos ? 0 : last + 1);
  return sentence;
}
}

Messages::Messages()
  : Window(vtkSmartPointer<vtkOutputWindow>::New())
  , FormerWindow(vtkOutputWindow::GetInstance())
  , FormerBuffer(std::cerr.rdbuf(this->Written.rdbuf()))
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  this->Window->SetDisplayModeToNever();
  this->Window->AddObserver(vtkCommand::ErrorEvent, this, &Messages::KeepError);
  this->Window->AddObserver(vtkCommand::WarningEvent, this, &Messages::KeepWarning);
  vtkOutputWindow::SetInstance(this->Window);
}

Messages::~Messages()
{
  vtkOutputWindow::SetInstance(this->FormerWindow);
  std::cerr.rdbuf(this->FormerBuffer);
}

Messages::Strictness::Strictness(Messages& messages)
  : Keeper(messages)
{
  this->Keeper.IsStrict = true;
}

Messages::Strictness::~Strictness()
{
  this->Keeper.IsStrict = false;
}

void Messages::KeepError(vtkObject* /*caller*/, unsigned long /*event*/, void* text)
{
  this->Keep(this->Errors, text);
}

void Messages::KeepWarning(vtkObject* /*caller*/, unsigned long /*event*/, void* text)
{
  this->Keep(this->Warnings, text);
}

void Messages::Keep(std::vector<std::string>& messages, const void* text) const
{
  messages.push_back(GetSentence(static_cast<const char*>(text)));
  if (this->IsStrict)
  {
    throw std::runtime_error(messages.back());
  }
}

std::vector<std::string> Messages::TakeErrors()
{
  return std::exchange(this->Errors, {});
}

std::vector<std::string> Messages::TakeWarnings()
{
  return std::exchange(this->Warnings, {});
}

std::string Messages::TakeReason()
{
  const auto errors = this->TakeErrors();
  const auto warnings = this->TakeWarnings();
  const std::string written = GetSentence(this->Written.str());
  this->Written.str({});
  return !errors.empty() ? errors.front() : !warnings.empty() ? warnings.front() : written;
}
