// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Options.h"

#include "Failure.h"
#include "FileNames.h"
#include "MeshReader.h"
#include "ReferenceImage.h"
#include "TextureImage.h"
#include "VoxelOutput.h"

#include "vtkHybridSurfaceVoxelizer.h"
#include "vtkSlicemapSolidVoxelizer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <utility>

namespace
{
using Solid = vtkSlicemapSolidVoxelizer;
using Surface = vtkHybridSurfaceVoxelizer;
using Method = Options::MethodType;

/// The smallest positive double: a lower bound that leaves out zero.
constexpr double Positive = std::numeric_limits<double>::denorm_min();

[[noreturn]] void Refuse(const std::string& message)
{
  throw Failure(ExitCode::Usage, message + " (see vtkvoxelize --help)");
}

/**
 * One value of an option, with checks whose messages name the option.
 */
class Argument
{
public:
  Argument(std::string option, std::string text)
    : Option(std::move(option))
    , Text(std::move(text))
  {
  }

  std::string AsFile() const
  {
    if (this->Text.empty())
    {
      Refuse(this->Option + " needs the name of a file");
    }
    return this->Text;
  }

  int AsInteger(int lowest, int highest = std::numeric_limits<int>::max()) const
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

  double AsReal(double lowest = std::numeric_limits<double>::lowest()) const
  {
    char* rest = nullptr;
    const double value = std::strtod(this->Text.c_str(), &rest);
    if (this->Text.empty() || *rest != '\0' || !std::isfinite(value))
    {
      this->Refuse("is not a number");
    }
    if (value < lowest)
    {
      this->Refuse(value < 0.0 ? "is negative" : "is zero; it must be positive");
    }
    return value;
  }

  /// The values between commas.
  std::vector<Argument> Split(std::size_t count) const
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

  std::vector<std::string> AsNames() const
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

  int AsChoice(const std::vector<std::pair<std::string, int>>& choices) const
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

  std::array<bool, 3> AsAxes() const
  {
    std::array<bool, 3> axes{};
    for (const std::string& name : this->AsNames())
    {
      axes[Argument(this->Option, name).AsChoice({ { "x", 0 }, { "y", 1 }, { "z", 2 } })] = true;
    }
    return axes;
  }

  std::array<int, 3> AsDimensions() const
  {
    std::array<int, 3> dimensions{};
    const auto parts = this->Split(dimensions.size());
    std::transform(parts.begin(), parts.end(), dimensions.begin(),
      [](const Argument& part) { return part.AsInteger(1); });
    return dimensions;
  }

  std::array<double, 6> AsBounds() const
  {
    std::array<double, 6> bounds{};
    const auto parts = this->Split(bounds.size());
    std::transform(parts.begin(), parts.end(), bounds.begin(),
      [](const Argument& part) { return part.AsReal(); });
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

private:
  [[noreturn]] void Refuse(const std::string& complaint) const
  {
    ::Refuse(this->Option + ": '" + this->Text + "' " + complaint);
  }

  std::string Option;
  std::string Text;
};

struct Definition
{
  const char* Name;
  const char* ValueName; // null for a switch
  const char* Help;
  void (*Store)(Options&, const Argument&);
};

struct Group
{
  const char* Title;
  std::vector<Definition> Definitions;
};

const std::vector<Group>& GetGroups()
{
  static const std::vector<Group> groups = {
    { "Grid",
      {
        { "--resolution", "N", "N voxels along the longest side; voxels are cubes (default: 128)",
          [](Options& o, const Argument& a) { o.Resolution = a.AsInteger(1); } },
        { "--dimensions", "X,Y,Z",
          "number of voxels along each axis, before padding; voxels are cubes, and the\n"
          "box grows evenly where the numbers ask for it",
          [](Options& o, const Argument& a) { o.Dimensions = a.AsDimensions(); } },
        { "--voxel-size", "S", "edge length of a voxel, in the units of the mesh",
          [](Options& o, const Argument& a) { o.VoxelSize = a.AsReal(Positive); } },
        { "--bounds", "X0,X1,Y0,Y1,Z0,Z1",
          "the box to voxelize, in the units of the mesh (default: that of the mesh)",
          [](Options& o, const Argument& a) { o.Bounds = a.AsBounds(); } },
        { "--padding", "N", "N more voxels on every side of the box (default: 0)",
          [](Options& o, const Argument& a)
          { o.Padding = a.AsInteger(0, std::numeric_limits<int>::max() / 4); } },
        { "--reference", "IMAGE",
          "take extent, spacing, origin and direction matrix of this image:\n"
          "@REFERENCES@",
          [](Options& o, const Argument& a) { o.Reference = a.AsFile(); } },
      } },
    { "Voxels",
      {
        { "--method", "METHOD",
          "solid    what lies inside of a closed mesh (default)\n"
          "surface  what any mesh touches, with attributes; needs OpenGL 4.3, which\n"
          "         --mode boundary of solids does not\n"
          "depth    what lies between the outermost surfaces along --axes, of any mesh",
          [](Options& o, const Argument& a)
          {
            o.Method =
              static_cast<Method>(a.AsChoice({ { "solid", static_cast<int>(Method::Solid) },
                { "surface", static_cast<int>(Method::Surface) },
                { "depth", static_cast<int>(Method::Depth) } }));
          } },
        { "--backend", "BACKEND",
          "auto, raster (OpenGL 3.2) or compute (OpenGL 4.3); auto is compute where there\n"
          "is such an OpenGL (default). No display and no GPU are needed.",
          [](Options& o, const Argument& a)
          {
            o.Backend = a.AsChoice(
              { { "auto", vtkVoxelizer::BACKEND_AUTO }, { "raster", vtkVoxelizer::BACKEND_RASTER },
                { "compute", vtkVoxelizer::BACKEND_COMPUTE } });
          } },
      } },
    { "Solids",
      {
        { "--mode", "MODE",
          "which voxels are set:\n"
          "center    those whose centre is inside (default)\n"
          "over      these and all that the surface touches\n"
          "under     those that lie inside as a whole\n"
          "boundary  those that the surface touches",
          [](Options& o, const Argument& a)
          {
            o.Mode = a.AsChoice({ { "center", Solid::MODE_CENTER },
              { "over", Solid::MODE_OVER_CONSERVATIVE },
              { "under", Solid::MODE_UNDER_CONSERVATIVE }, { "boundary", Solid::MODE_BOUNDARY } });
          } },
        { "--fill", "RULE",
          "what is inside where surfaces overlap or have holes:\n"
          "parity    an odd number of crossings on the way there (default)\n"
          "nonzero   a winding number other than zero: the union of closed surfaces\n"
          "vote      parity along all three axes, the majority wins: for dirty meshes",
          [](Options& o, const Argument& a)
          {
            o.FillRule = a.AsChoice({ { "parity", Solid::FILL_RULE_PARITY },
              { "nonzero", Solid::FILL_RULE_NON_ZERO }, { "vote", Solid::FILL_RULE_VOTE } });
          } },
        { "--axis", "AXIS",
          "auto, x, y or z: the axis along which crossings are counted; auto is the one\n"
          "with the least work (default)",
          [](Options& o, const Argument& a)
          {
            o.ColumnAxis =
              a.AsChoice({ { "auto", Solid::COLUMN_AXIS_AUTO }, { "x", Solid::COLUMN_AXIS_X },
                { "y", Solid::COLUMN_AXIS_Y }, { "z", Solid::COLUMN_AXIS_Z } });
          } },
      } },
    { "Surfaces (--method surface)",
      {
        { "--separability", "N",
          "26  all voxels that a triangle touches (default)\n"
          "6   a thinner surface, which paths through faces of voxels still can't pass",
          [](Options& o, const Argument& a) {
            o.Separability = a.AsChoice({ { "6", 6 }, { "26", 26 } });
          } },
        { "--attributes", "NAME[,NAME...]",
          "carry these arrays of the points or cells over to the voxels; VTK calls the\n"
          "colours of a .ply file RGB or RGBA, normals Normals",
          [](Options& o, const Argument& a) { o.Attributes = a.AsNames(); } },
        { "--texture", "IMAGE",
          "colour the voxels by this image and the texture coordinates of the mesh, as the\n"
          "attribute Texture: @TEXTURES@",
          [](Options& o, const Argument& a) { o.Texture = a.AsFile(); } },
        { "--combine", "HOW",
          "what becomes of the values of several triangles in one voxel: average\n"
          "(default), min, max, or first, in the order of the mesh",
          [](Options& o, const Argument& a)
          {
            o.Combination =
              a.AsChoice({ { "average", Surface::COMBINE_AVERAGE }, { "min", Surface::COMBINE_MIN },
                { "max", Surface::COMBINE_MAX }, { "first", Surface::COMBINE_FIRST } });
          } },
      } },
    { "Between surfaces (--method depth)",
      {
        { "--axes", "AXIS[,AXIS...]",
          "x, y and z: the axes along which the mesh is looked at (default: x,y,z)",
          [](Options& o, const Argument& a) { o.Axes = a.AsAxes(); } },
      } },
    { "Output",
      {
        { "--type", "TYPE", "uchar (default), or bit, which takes an eighth of the memory",
          [](Options& o, const Argument& a) {
            o.ScalarType = a.AsChoice({ { "uchar", VTK_UNSIGNED_CHAR }, { "bit", VTK_BIT } });
          } },
        { "--value", "V", "value of the voxels that are set, 1 to 255 (default: 1); others are 0",
          [](Options& o, const Argument& a) { o.Value = a.AsInteger(1, 255); } },
        { "--cells", nullptr, "voxels are the cells of the image, instead of its points",
          [](Options& o, const Argument&) { o.Cells = true; } },
        { "--picture", "FILE.png",
          "also draw the voxels that are set, coloured by the texture or else by the first\n"
          "attribute: numbers from blue, the least, to red, vectors by their length",
          [](Options& o, const Argument& a) { o.Picture = a.AsFile(); } },
        { "--up", "AXIS", "x, y or z: the axis that points up in the picture (default: y)",
          [](Options& o, const Argument& a) {
            o.UpAxis = a.AsChoice({ { "x", 0 }, { "y", 1 }, { "z", 2 } });
          } },
        { "--info", nullptr,
          "print triangles, grid, filled voxels and their volume, leaking columns of\n"
          "solids, times and the OpenGL renderer, one a line, on the standard output",
          [](Options& o, const Argument&) { o.Info = true; } },
        { "--quiet", nullptr, "no progress bar and no warnings, errors only",
          [](Options& o, const Argument&) { o.Quiet = true; } },
      } },
    { "Other",
      {
        { "--help", nullptr, "print this text",
          [](Options& o, const Argument&) { o.Help = true; } },
        { "--version", nullptr, "print the version, and that of VTK",
          [](Options& o, const Argument&) { o.Version = true; } },
      } },
  };
  return groups;
}

const Definition& FindDefinition(const std::string& name)
{
  for (const Group& group : GetGroups())
  {
    for (const Definition& definition : group.Definitions)
    {
      if (name == definition.Name)
      {
        return definition;
      }
    }
  }
  Refuse("unknown option " + name);
}

using Names = std::set<std::string>;

void RefuseTogether(const Names& given, const std::string& one,
  const std::vector<std::string>& others, const std::string& why)
{
  for (const std::string& other : others)
  {
    if (given.count(one) && given.count(other))
    {
      std::string message = one;
      message.append(" and ").append(other).append(" contradict each other: ").append(why);
      Refuse(message);
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
  const std::pair<const char*, std::optional<std::string>> files[] = {
    { "INPUT", options.Input },
    { "--reference", options.Reference },
    { "--texture", options.Texture },
    { "OUTPUT", options.Output },
    { "--picture", options.Picture },
  };
  std::vector<NamedFile> before;
  for (const auto& [role, name] : files)
  {
    const bool isWritten = role == std::string("OUTPUT") || role == std::string("--picture");
    for (const NamedFile& other : before)
    {
      if (isWritten && name && FileNames::AreSame(*name, other.Name))
      {
        Refuse(other.Role + " and " + role + " are the same file, " + other.Name);
      }
    }
    if (name)
    {
      before.push_back({ role, *name });
    }
  }
}

void CheckMethod(const Options& options, const Names& given)
{
  const std::string method = options.Method == Method::Depth ? "depth" : "surface";
  for (const char* option : { "--mode", "--fill", "--axis" })
  {
    if (options.Method != Method::Solid && given.count(option))
    {
      Refuse(std::string(option) + " is for solids and does not go with --method " + method);
    }
  }
  for (const char* option : { "--separability", "--attributes", "--texture", "--combine" })
  {
    if (options.Method != Method::Surface && given.count(option))
    {
      Refuse(std::string(option) + " needs --method surface");
    }
  }
  if (options.Method != Method::Depth && given.count("--axes"))
  {
    Refuse("--axes needs --method depth");
  }
  if (given.count("--combine") && options.Attributes.empty() && !options.Texture)
  {
    Refuse("--combine is for the values that --attributes and --texture ask for");
  }
}

void RefuseWithOutput(
  const Names& given, const char* option, const Options& options, const std::string& why)
{
  if (given.count(option))
  {
    Refuse(std::string(option) + " and OUTPUT " + options.Output +
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
      Refuse("OUTPUT " + options.Output + " is " + what + ", which needs --method surface");
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
  RefuseTogether(given, "--reference",
    { "--resolution", "--dimensions", "--voxel-size", "--bounds", "--padding" },
    "the grid is that of the reference image");

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
    Refuse("--up is for the picture that --picture asks for");
  }
}

void StoreFiles(Options& options, const std::vector<std::string>& files)
{
  if (files.empty() || files[0].empty())
  {
    Refuse("INPUT and OUTPUT are missing");
  }
  if (files.size() == 1 || files[1].empty())
  {
    Refuse("OUTPUT is missing");
  }
  if (files.size() > 2)
  {
    Refuse("'" + files[2] + "' is one file too many; there are INPUT and OUTPUT only");
  }
  options.Input = files[0];
  options.Output = files[1];
}

std::string Replaced(std::string text, const std::string& what, const std::string& with)
{
  const auto found = text.find(what);
  return found == std::string::npos ? text : text.replace(found, what.size(), with);
}

void PrintDefinition(std::ostream& out, const Definition& definition)
{
  constexpr std::size_t column = 20;
  std::string head = std::string("  ") + definition.Name;
  if (definition.ValueName)
  {
    head += std::string(" ") + definition.ValueName;
  }
  if (head.size() + 2 > column)
  {
    head += "\n";
    head.append(column, ' ');
  }
  else
  {
    head.resize(column, ' ');
  }
  out << head;
  std::string indent;
  std::istringstream lines(
    Replaced(Replaced(definition.Help, "@REFERENCES@", "any of " + ReferenceImage::GetExtensions()),
      "@TEXTURES@", TextureImage::GetExtensions()));
  for (std::string line; std::getline(lines, line); indent = "\n" + std::string(column, ' '))
  {
    out << indent << line;
  }
  out << "\n";
}
}

Options Options::Parse(const std::vector<std::string>& words)
{
  static const std::map<std::string, std::string> shortNames = { { "-h", "--help" },
    { "-q", "--quiet" } };

  Options options;
  std::vector<std::string> files;
  Names given;
  bool onlyFiles = false;
  for (auto word = words.begin(); word != words.end(); ++word)
  {
    if (onlyFiles || word->size() < 2 || word->front() != '-')
    {
      files.push_back(*word);
      continue;
    }
    if (*word == "--")
    {
      onlyFiles = true;
      continue;
    }
    const auto equals = word->find('=');
    std::string name = word->substr(0, equals);
    if (const auto found = shortNames.find(name); found != shortNames.end())
    {
      name = found->second;
    }
    const Definition& definition = FindDefinition(name);
    std::string value;
    if (equals != std::string::npos)
    {
      if (!definition.ValueName)
      {
        Refuse(name + " takes no value");
      }
      value = word->substr(equals + 1);
    }
    else if (definition.ValueName)
    {
      if (++word == words.end())
      {
        Refuse(name + " needs a value, " + definition.ValueName);
      }
      value = *word;
    }
    if (!given.insert(name).second)
    {
      Refuse(name + " is given twice");
    }
    definition.Store(options, Argument(name, value));
  }
  if (options.Help || options.Version)
  {
    return options;
  }
  StoreFiles(options, files);
  CheckFiles(options);
  CheckMethod(options, given);
  CheckTogether(options, given);
  CheckOutput(options, given);
  return options;
}

std::string Options::GetHelp()
{
  std::ostringstream out;
  out << "Usage: vtkvoxelize [OPTIONS] INPUT OUTPUT\n\n"
         "Turns a mesh into voxels, solid by default, on the graphics processor or what stands in\n"
         "for it.\n\n"
         "  INPUT             the mesh: "
      << MeshReader::GetExtensions()
      << "\n"
         "  OUTPUT            the voxels: "
      << VoxelOutput::GetExtensions()
      << "\n"
         "                    .vti holds all there is, .mha, .mhd and .binvox the set voxels\n"
         "                    alone; with --method surface also .vtp, a list of the voxels, and\n"
         "                    .htg, an octree, for grids too large to be kept as images\n";
  for (const Group& group : GetGroups())
  {
    out << "\n" << group.Title << ":\n";
    for (const Definition& definition : group.Definitions)
    {
      PrintDefinition(out, definition);
    }
  }
  out
    << "\nExamples:\n"
       "  vtkvoxelize bunny.ply bunny.vti\n"
       "  vtkvoxelize --resolution 256 --picture part.png --info part.stl part.vti\n"
       "  vtkvoxelize --fill vote --voxel-size 0.5 scan.obj scan.mha\n"
       "  vtkvoxelize --reference ct.nrrd --value 3 liver.vtp liver.mha\n"
       "  vtkvoxelize --method surface --attributes RGB --resolution 1024 scan.ply scan.vtp\n"
       "  vtkvoxelize --method surface --texture house.jpg house.obj house.vti\n"
       "\nExit codes:\n"
       "  0  all is well\n"
       "  1  the command line makes no sense\n"
       "  2  INPUT, the reference image or the texture can't be read, or INPUT is no mesh\n"
       "  3  voxelization failed: no OpenGL, a grid too large for the memory, an attribute or\n"
       "     texture coordinates that the mesh has not\n"
       "  4  OUTPUT or the picture can't be written\n"
       "Unless all is well, files that were there before are left as they were, and no others are\n"
       "made.\n";
  return out.str();
}
