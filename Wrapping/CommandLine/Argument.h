// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Argument.h
 * One value of an option, with checks whose messages name the option.
 */

#ifndef Argument_h
#define Argument_h

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

/**
 * The methods give the value as what it must be, or throw Failure with ExitCode::Usage.
 */
class Argument
{
public:
  Argument(std::string option, std::string text)
    : Option(std::move(option))
    , Text(std::move(text))
  {
  }

  const std::string& GetOption() const { return this->Option; }
  const std::string& GetText() const { return this->Text; }

  std::string AsFile() const;
  int AsInteger(int lowest, int highest = std::numeric_limits<int>::max()) const;
  /// A number of bytes, which K, M, G or T may follow for powers of 1024.
  std::int64_t AsBytes() const;
  double AsReal(double lowest = std::numeric_limits<double>::lowest()) const;
  std::array<double, 2> AsRange() const;
  std::vector<std::string> AsNames() const;
  int AsChoice(const std::vector<std::pair<std::string, int>>& choices) const;
  std::array<bool, 3> AsAxes() const;
  std::array<int, 3> AsDimensions() const;
  std::array<double, 6> AsBounds() const;

  /// Ends the program with a message on the command line.
  [[noreturn]] static void RefuseUsage(const std::string& message);

private:
  [[noreturn]] void Refuse(const std::string& complaint) const;

  /// A number, or an infinity.
  double AsEnd() const;

  /// The values between commas.
  std::vector<Argument> Split(std::size_t count) const;

  std::string Option;
  std::string Text;
};

#endif
