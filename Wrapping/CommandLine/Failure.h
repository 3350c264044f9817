// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Failure.h
 * What ends the program early: a sentence for the user and the exit code.
 */

#ifndef Failure_h
#define Failure_h

#include <stdexcept>
#include <string>

enum class ExitCode
{
  Success = 0,
  Usage = 1,
  Input = 2,
  Voxelization = 3,
  Output = 4
};

class Failure : public std::runtime_error
{
public:
  Failure(ExitCode code, const std::string& message)
    : std::runtime_error(message)
    , Code(code)
  {
  }

  ExitCode GetCode() const { return this->Code; }

private:
  ExitCode Code;
};

#endif
