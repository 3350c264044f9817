// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Argument.h"

#include "Failure.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <sstream>

void Argument::RefuseUsage(const std::string& message)
{
  throw Failure(ExitCode::Usage, message + " (see vtkvoxelize --help)");
}

std::string Argument::AsFile() const
{
  if (this->Text.empty())
  {
    RefuseUsage(this->Option + " needs the name of a file");
  }
  return this->Text;
}

int Argument::AsInteger(int lowest, int highest) const
{
  const char* const end = this->Text.data() + this->Text.size();
  int value = 0;
  const auto [rest, error] = std::from_chars(this->Text.data(), end, value);
  if (error == std::errc::invalid_argument || rest != end)
  {
    this->Refuse("is not a whole number");
  }
  const bool negative = this->Text.front() == '-';
  if (error == std::errc::result_out_of_range)
  {
    this->Refuse(negative ? "is negative" : "is too large");
  }
  if (value < lowest)
  {
    this->Refuse((negative ? "is negative; the least is " : "is too small; the least is ") +
      std::to_string(lowest));
  }
  if (value > highest)
  {
    this->Refuse("is too large; the most is " + std::to_string(highest));
  }
  return value;
}

double Argument::AsEnd() const
{
  char* rest = nullptr;
  const double value = std::strtod(this->Text.c_str(), &rest);
  if (this->Text.empty() || *rest != '\0' || std::isnan(value))
  {
    this->Refuse("is not a number");
  }
  return value;
}

double Argument::AsReal(double lowest) const
{
  const double value = this->AsEnd();
  if (std::isinf(value))
  {
    this->Refuse("is not a number");
  }
  if (value < lowest)
  {
    this->Refuse(value < 0.0 ? "is negative" : "is zero; it must be positive");
  }
  return value;
}

std::int64_t Argument::AsBytes() const
{
  constexpr double kibi = 1024.0;
  constexpr double most = 9e18;
  const std::string units = "KMGT";
  std::string number = this->Text;
  double bytes = 1.0;
  if (const auto unit = number.empty() ? std::string::npos : units.find(number.back());
      unit != std::string::npos)
  {
    bytes = std::pow(kibi, static_cast<double>(unit + 1));
    number.pop_back();
  }
  char* rest = nullptr;
  bytes *= std::strtod(number.c_str(), &rest);
  if (number.empty() || *rest != '\0' || !(bytes >= 1.0 && bytes < most))
  {
    this->Refuse("is no number of bytes, such as 512M or 1.5G");
  }
  return static_cast<std::int64_t>(bytes);
}

std::array<double, 2> Argument::AsRange() const
{
  std::array<double, 2> ends{};
  const auto parts = this->Split(ends.size());
  std::transform(
    parts.begin(), parts.end(), ends.begin(), [](const Argument& part) { return part.AsEnd(); });
  if (ends[0] > ends[1])
  {
    this->Refuse("is no range: its lower end is above its upper one");
  }
  return ends;
}

std::vector<Argument> Argument::Split(std::size_t count) const
{
  std::vector<Argument> parts;
  std::istringstream text(this->Text);
  for (std::string part; std::getline(text, part, ',');)
  {
    parts.emplace_back(this->Option, part);
  }
  if (parts.size() != count || this->Text.back() == ',')
  {
    this->Refuse("is not a list of " + std::to_string(count) + " numbers with commas between");
  }
  return parts;
}

std::vector<std::string> Argument::AsNames() const
{
  std::vector<std::string> names;
  std::istringstream text(this->Text + ",");
  for (std::string name; std::getline(text, name, ',');)
  {
    if (name.empty())
    {
      this->Refuse("has an empty name; names stand between commas");
    }
    names.push_back(name);
  }
  return names;
}

int Argument::AsChoice(const std::vector<std::pair<std::string, int>>& choices) const
{
  std::string names;
  for (const auto& [name, value] : choices)
  {
    if (name == this->Text)
    {
      return value;
    }
    names += (names.empty() ? "" : ", ") + name;
  }
  this->Refuse("is none of " + names);
}

std::array<bool, 3> Argument::AsAxes() const
{
  std::array<bool, 3> axes{};
  for (const std::string& name : this->AsNames())
  {
    axes[Argument(this->Option, name).AsChoice({ { "x", 0 }, { "y", 1 }, { "z", 2 } })] = true;
  }
  return axes;
}

std::array<int, 3> Argument::AsDimensions() const
{
  std::array<int, 3> dimensions{};
  const auto parts = this->Split(dimensions.size());
  std::transform(parts.begin(), parts.end(), dimensions.begin(),
    [](const Argument& part) { return part.AsInteger(1); });
  return dimensions;
}

std::array<double, 6> Argument::AsBounds() const
{
  std::array<double, 6> bounds{};
  const auto parts = this->Split(bounds.size());
  std::transform(
    parts.begin(), parts.end(), bounds.begin(), [](const Argument& part) { return part.AsReal(); });
  for (const std::size_t axis : { 0, 1, 2 })
  {
    if (!(bounds[2 * axis] < bounds[2 * axis + 1]))
    {
      this->Refuse(std::string("is no box: its upper bound along ") + "xyz"[axis] +
        " must be greater than its lower one");
    }
  }
  return bounds;
}

void Argument::Refuse(const std::string& complaint) const
{
  RefuseUsage(this->Option + ": '" + this->Text + "' " + complaint);
}
