// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OptionChecks.h"

#include "Argument.h"
#include "FileNames.h"
#include "ImageReader.h"
#include "Options.h"
#include "StepExtent.h"
#include "VoxelInput.h"
#include "VoxelOutput.h"

#include "vtkSlicemapSolidVoxelizer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace
{
using Names = OptionChecks::Names;
using Solid = vtkSlicemapSolidVoxelizer;
using Method = Options::MethodType;
using OptionNames = std::vector<std::string>;

///@{
/// What goes together, or with nothing.
const OptionNames GridOptions = { "--resolution", "--dimensions", "--voxel-size", "--bounds",
  "--padding" };
const OptionNames SolidOptions = { "--mode", "--fill", "--axis" };
const OptionNames VariantOptions = { "--shell", "--variants", "--first", "--seed", "--rotate",
  "--scale", "--displace", "--stay" };
const OptionNames AttributeOptions = { "--attributes", "--texture", "--combine" };
///@}

/// The first of these options that is given.
std::optional<std::string> FindGiven(
  const Names& given, OptionNames options, const OptionNames& more = {})
{
  options.insert(options.end(), more.begin(), more.end());
  const auto found = std::find_if(options.begin(), options.end(),
    [&](const std::string& option) { return given.count(option) > 0; });
  return found == options.end() ? std::nullopt : std::make_optional(*found);
}

void RefuseTogether(
  const Names& given, const std::string& one, const OptionNames& others, const std::string& why)
{
  for (const std::string& other : others)
  {
    if (given.count(one) && given.count(other))
    {
      std::string message = one;
      message.append(" and ").append(other).append(" contradict each other: ").append(why);
      Argument::RefuseUsage(message);
    }
  }
}

/// A file and what it is to the command line.
struct NamedFile
{
  std::string Role;
  std::string Name;
};

void CheckFiles(const Options& options)
{
  std::vector<NamedFile> files = { { "INPUT", options.Input } };
  const auto add = [&](const std::string& role, const std::optional<std::string>& name)
  {
    if (name && !name->empty())
    {
      files.push_back({ role, *name });
    }
  };
  const auto addWritten = [&](const std::string& role, const std::optional<std::string>& name)
  {
    for (const NamedFile& other : files)
    {
      if (name && FileNames::AreSame(*name, other.Name))
      {
        Argument::RefuseUsage(other.Role + " and " + role + " are the same file, " + other.Name);
      }
    }
    add(role, name);
  };
  add("--reference", options.Reference);
  add("--texture", options.Texture);
  for (const Options::Step& step : options.Steps)
  {
    add(step.Option, step.File);
  }
  addWritten("OUTPUT", options.Output);
  addWritten("--picture", options.Picture);
}

void CheckVolume(const Options& options, const Names& given)
{
  const std::string input = "INPUT " + options.Input;
  if (const auto option = FindGiven(given, AttributeOptions, VariantOptions))
  {
    Argument::RefuseUsage(*option + " is for a mesh as INPUT, but " + input + " is a volume");
  }
  if (const auto option = FindGiven(given, { "--reference" }, GridOptions))
  {
    Argument::RefuseUsage(
      *option + " and " + input + " contradict each other: the grid is that of the volume");
  }
  const bool hasMesh = std::any_of(options.Steps.begin(), options.Steps.end(),
    [](const Options::Step& step)
    { return !step.File.empty() && !ImageReader::IsImage(step.File); });
  const auto option = FindGiven(
    given, { "--method", "--backend", "--separability", "--axes", "--repair" }, SolidOptions);
  if (option && !hasMesh)
  {
    Argument::RefuseUsage(
      *option + " is for meshes, but " + input + " is a volume, and no step has a mesh");
  }
  if (VoxelOutput::GetKind(options.Output) != VoxelOutput::Kind::Image)
  {
    Argument::RefuseUsage(input + " and OUTPUT " + options.Output +
      " contradict each other: the voxels of a volume are an image; write a .vti file");
  }
}

void CheckInput(const Options& options, const Names& given)
{
  const std::string oneRange = "each says which scalars of the volume make voxels";
  RefuseTogether(given, "--iso", { "--range", "--label" }, oneRange);
  RefuseTogether(given, "--range", { "--label" }, oneRange);
  if (options.HasVolume())
  {
    CheckVolume(options, given);
    return;
  }
  if (const auto option = FindGiven(given, { "--iso", "--range", "--label" }))
  {
    Argument::RefuseUsage(*option + " is for a volume as INPUT, one of " +
      ImageReader::GetImageExtensions() + ", which INPUT " + options.Input + " is not");
  }
}

void CheckMethod(const Options& options, const Names& given)
{
  const std::string method = options.Method == Method::Depth ? "depth"
    : options.Method == Method::Tetra                        ? "tetra"
                                                             : "surface";
  if (const auto option = FindGiven(given, SolidOptions); option && options.Method != Method::Solid)
  {
    Argument::RefuseUsage(*option + " is for solids and does not go with --method " + method);
  }
  if (const auto option = FindGiven(given, { "--separability" }, AttributeOptions);
      option && options.Method != Method::Surface)
  {
    Argument::RefuseUsage(*option + " needs --method surface");
  }
  if (given.count("--axes") && options.Method != Method::Depth)
  {
    Argument::RefuseUsage("--axes needs --method depth");
  }
  if (const auto option = FindGiven(given, VariantOptions);
      option && options.Method != Method::Tetra)
  {
    Argument::RefuseUsage(*option + " needs --method tetra");
  }
  if (given.count("--combine") && options.Attributes.empty() && !options.Texture)
  {
    Argument::RefuseUsage("--combine is for the values that --attributes and --texture ask for");
  }
}

void RefuseWithOutput(
  const Names& given, const char* option, const Options& options, const std::string& why)
{
  if (given.count(option))
  {
    Argument::RefuseUsage(std::string(option) + " and OUTPUT " + options.Output +
      " contradict each other: " + why + "; write a .vti file");
  }
}

void CheckOutput(const Options& options, const Names& given)
{
  const auto kind = VoxelOutput::GetKind(options.Output);
  if (kind != VoxelOutput::Kind::Image)
  {
    const std::string what =
      kind == VoxelOutput::Kind::List ? "a list of voxels" : "an octree of voxels";
    if (options.Method != Method::Surface)
    {
      Argument::RefuseUsage(
        "OUTPUT " + options.Output + " is " + what + ", which needs --method surface");
    }
    for (const char* option : { "--type", "--value", "--cells" })
    {
      RefuseWithOutput(given, option, options, what + " is no image");
    }
  }
  if (options.ScalarType == VTK_BIT && !VoxelOutput::HasBits(options.Output))
  {
    RefuseWithOutput(given, "--type", options, "this format has no bits");
  }
  if (!VoxelOutput::HasCells(options.Output))
  {
    RefuseWithOutput(given, "--cells", options, "this format has no cells");
  }
  for (const char* option : { "--attributes", "--texture" })
  {
    if (!VoxelOutput::HasAttributes(options.Output))
    {
      RefuseWithOutput(given, option, options, "this format has no attributes");
    }
  }
}

void CheckTogether(const Options& options, const Names& given)
{
  const std::string oneSize = "each gives the size of the voxels";
  RefuseTogether(given, "--resolution", { "--dimensions", "--voxel-size" }, oneSize);
  RefuseTogether(given, "--dimensions", { "--voxel-size" }, oneSize);
  RefuseTogether(given, "--reference", GridOptions, "the grid is that of the reference image");

  if (options.Mode == Solid::MODE_BOUNDARY)
  {
    RefuseTogether(
      given, "--mode", { "--fill", "--axis" }, "the mode boundary looks at the surface alone");
  }
  if (options.FillRule == Solid::FILL_RULE_VOTE)
  {
    RefuseTogether(given, "--fill", { "--axis" }, "the rule vote takes all three axes");
  }
  if (options.ScalarType == VTK_BIT && options.Value.value_or(1) != 1)
  {
    RefuseTogether(given, "--type", { "--value" }, "a bit that is set is 1");
  }
  if (options.UpAxis && !options.Picture)
  {
    Argument::RefuseUsage("--up is for the picture that --picture asks for");
  }
}

void CheckSteps(const Options& options, const Names& given)
{
  OptionChecks::CheckKernelIsUsed(options);
  OptionChecks::CheckConnectivityIsUsed(options);
  if (options.Steps.empty())
  {
    return;
  }
  const std::string& step = options.Steps.front().Option;
  for (const char* option : { "--attributes", "--texture" })
  {
    RefuseTogether(given, step, { option }, "steps change which voxels are set, and no more");
  }
  if (VoxelOutput::GetKind(options.Output) != VoxelOutput::Kind::Image)
  {
    RefuseWithOutput(given, step.c_str(), options, "steps make an image");
  }
  const bool gridIsGiven =
    options.HasVolume() || options.Reference || options.Bounds || options.Padding;
  if (!gridIsGiven && StepExtent(options.Steps).IsEndless())
  {
    Argument::RefuseUsage(
      "--keep-largest after --complement: the voxels go on beyond any grid that is made for the "
      "mesh; give one by --bounds, --padding or --reference");
  }
}

void CheckSlabs(const Options& options, const Names& given)
{
  if (!options.MemoryLimit)
  {
    return;
  }
  RefuseTogether(given, "--memory-limit", { "--picture", "--attributes", "--texture" },
    "voxels that are made in slabs are set or not, and gone when they are written");
  RefuseTogether(given, "--memory-limit", { "--variants" }, "each variant is made as a whole");
  if (!VoxelOutput::TakesSlabs(options.Output))
  {
    Argument::RefuseUsage("--memory-limit and OUTPUT " + options.Output +
      " contradict each other: formats that are written in slabs are " +
      VoxelOutput::GetExtensionsOfSlabs());
  }
}

void CheckVariants(const Options& options, const Names& given)
{
  if (options.ScaleRange &&
    !((*options.ScaleRange)[0] > 0.0 && std::isfinite((*options.ScaleRange)[1])))
  {
    Argument::RefuseUsage("--scale: both factors must be positive and finite");
  }
  if (options.Displacement.value_or(0.0) > 1.0)
  {
    Argument::RefuseUsage("--displace: more than the size of the mesh, 1, makes no sense");
  }
  if (!options.Variants)
  {
    return;
  }
  RefuseTogether(given, "--variants", { "--picture" }, "there is no picture of several");
  const bool isNumbered = FileNames::FindNumber(options.Output).has_value();
  const bool isBatch = VoxelOutput::TakesVariants(options.Output);
  if (!isNumbered && !isBatch)
  {
    Argument::RefuseUsage("--variants and OUTPUT " + options.Output +
      " contradict each other: several files need a number in their name, such as %04d, once; one "
      "file for all is a .bits file");
  }
  if (!isNumbered && !options.Steps.empty())
  {
    Argument::RefuseUsage(options.Steps.front().Option + " and OUTPUT " + options.Output +
      " contradict each other: steps make one variant after the other; put a number such as %04d "
      "into the name");
  }
}

/// Voxels of a file are written as they are.
void CheckVoxels(const Options& options, const Names& given)
{
  for (const std::string& option : given)
  {
    if (VoxelInput::IsVoxels(options.Input) && option != "--quiet")
    {
      Argument::RefuseUsage(
        option + " is for meshes, and INPUT " + options.Input + " holds voxels");
    }
  }
}
}

void OptionChecks::CheckKernelIsUsed(const Options& options)
{
  if (!options.KernelIsUsed)
  {
    Argument::RefuseUsage(
      "--kernel is for the --dilate, --erode, --open and --close after it, but there are none");
  }
}

void OptionChecks::CheckConnectivityIsUsed(const Options& options)
{
  if (!options.ConnectivityIsUsed)
  {
    Argument::RefuseUsage(
      "--connectivity is for the --fill-holes and --keep-largest after it, but there are none");
  }
}

void OptionChecks::Check(const Options& options, const Names& given)
{
  CheckFiles(options);
  CheckVoxels(options, given);
  CheckInput(options, given);
  CheckMethod(options, given);
  CheckVariants(options, given);
  CheckTogether(options, given);
  CheckOutput(options, given);
  CheckSteps(options, given);
  CheckSlabs(options, given);
}
