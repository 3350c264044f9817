// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Options.h"

#include "Argument.h"
#include "ImageReader.h"
#include "MeshReader.h"
#include "OptionChecks.h"
#include "TextureImage.h"
#include "VoxelInput.h"
#include "VoxelOutput.h"

#include "vtkHybridSurfaceVoxelizer.h"
#include "vtkSlicemapSolidVoxelizer.h"
#include "vtkVoxelMorphology.h"

#include <limits>
#include <map>
#include <sstream>
#include <utility>

namespace
{
using Solid = vtkSlicemapSolidVoxelizer;
using Surface = vtkHybridSurfaceVoxelizer;
using Method = Options::MethodType;
using Step = Options::Step;
using Morphology = vtkVoxelMorphology;

/// The smallest positive double: a lower bound that leaves out zero.
constexpr double Positive = std::numeric_limits<double>::denorm_min();

constexpr double Infinity = std::numeric_limits<double>::infinity();

///@{
/// Voxels to either side of vtkVoxelMorphology's largest sphere, and more than any grid has.
constexpr int LongestSphereReach = 31;
constexpr int LongestReach = std::numeric_limits<int>::max() / 16;
///@}

struct Definition
{
  const char* Name;
  const char* ValueName; // null for a switch
  const char* Help;
  void (*Store)(Options&, const Argument&);
  bool Repeats = false; // else to be given once
};

struct Group
{
  const char* Title;
  std::vector<Definition> Definitions;
};

void AddJoin(Options& options, Step::Type what, const Argument& file)
{
  options.Steps.push_back({ what, file.GetOption(), file.AsFile() });
}

void AddMorphology(Options& options, Step::Type what, const Argument& reach)
{
  const bool isSphere = options.Kernel == Morphology::KERNEL_SPHERE;
  options.Steps.push_back({ what, reach.GetOption(), {},
    reach.AsInteger(1, isSphere ? LongestSphereReach : LongestReach), options.Kernel });
  options.KernelIsUsed = true;
}

void AddConnectivity(Options& options, Step::Type what, const Argument& step)
{
  options.Steps.push_back({ what, step.GetOption(), {}, 0, 0, options.Connectivity });
  options.ConnectivityIsUsed = true;
}

const std::vector<Group>& GetGroups()
{
  static const std::vector<Group> groups = {
    { "Grid of meshes",
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
          "the box to voxelize, in the units of the mesh (default: that of the mesh, and of\n"
          "the meshes that --unite and --xor add)",
          [](Options& o, const Argument& a) { o.Bounds = a.AsBounds(); } },
        { "--padding", "N",
          "N more voxels on every side of the box (default: 0, but with steps that grow or\n"
          "shrink, and without --bounds, as many as keep all borders out of their way).\n"
          "What lies beyond the grid changes no voxel: a box that fills it is not eroded.",
          [](Options& o, const Argument& a)
          { o.Padding = a.AsInteger(0, Options::LargestPadding); } },
        { "--reference", "IMAGE",
          "take extent, spacing, origin and direction matrix of this image:\n"
          "any of @REFERENCES@",
          [](Options& o, const Argument& a) { o.Reference = a.AsFile(); } },
      } },
    { "Volumes as INPUT, whose voxels and grid are those of the image",
      {
        { "--iso", "V", "set the voxels whose scalar is V or more",
          [](Options& o, const Argument& a) {
            o.ScalarRange = { a.AsReal(), Infinity };
          } },
        { "--range", "LOWER,UPPER",
          "those whose scalar is in this range, both ends included; inf leaves an end open",
          [](Options& o, const Argument& a) { o.ScalarRange = a.AsRange(); } },
        { "--label", "V",
          "those whose scalar is V. Without any of these three: all that are not 0, as of\n"
          "masks and label maps. Of colours the first component counts.",
          [](Options& o, const Argument& a) {
            o.ScalarRange = { a.AsReal(), a.AsReal() };
          } },
      } },
    { "Voxels of meshes",
      {
        { "--method", "METHOD",
          "solid    what lies inside of a closed mesh (default)\n"
          "surface  what any mesh touches, with attributes; needs OpenGL 4.3, which\n"
          "         --mode boundary of solids does not\n"
          "depth    what lies between the outermost surfaces along --axes, of any mesh\n"
          "tetra    what lies inside, holes closed, for variants and shells; see below",
          [](Options& o, const Argument& a)
          {
            o.Method =
              static_cast<Method>(a.AsChoice({ { "solid", static_cast<int>(Method::Solid) },
                { "surface", static_cast<int>(Method::Surface) },
                { "depth", static_cast<int>(Method::Depth) },
                { "tetra", static_cast<int>(Method::Tetra) } }));
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
        { "--repair", nullptr,
          "first leave out polygons that the mesh has twice, either way round, that are\n"
          "walls within it, or have no area, and tell how many these were",
          [](Options& o, const Argument&) { o.Repair = true; } },
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
        { "--axes", "AXIS[,AXIS...]|auto",
          "x, y and z: the axes along which the mesh is looked at (default: x,y,z);\n"
          "auto: one of them where that tells everything, as of convex meshes",
          [](Options& o, const Argument& a)
          {
            o.AutomaticAxes = a.GetText() == "auto";
            o.Axes = o.AutomaticAxes ? std::array{ true, true, true } : a.AsAxes();
          } },
      } },
    { "Variants and shells (--method tetra)",
      {
        { "--shell", "N",
          "6, 18 or 26: only voxels with one of so many neighbours outside of the solid",
          [](Options& o, const Argument& a) {
            o.Shell = a.AsChoice({ { "6", 6 }, { "18", 18 }, { "26", 26 } });
          } },
        { "--variants", "N",
          "N variants of the mesh at once: in one .bits file, or in a file each, when\n"
          "OUTPUT has a number like %04d in its name, which becomes that of the variant",
          [](Options& o, const Argument& a) { o.Variants = a.AsInteger(1); } },
        { "--first", "N", "number of the first variant, or of the only one (default: 0)",
          [](Options& o, const Argument& a) { o.FirstVariant = a.AsInteger(0); } },
        { "--seed", "S",
          "what all random numbers come from (default: 0): variant N of a seed is the same\n"
          "whenever and wherever it is made",
          [](Options& o, const Argument& a)
          { o.Seed = a.AsInteger(std::numeric_limits<int>::min()); } },
        { "--rotate", "AXIS", "turn by any angle about x, y or z, or about any axis: any",
          [](Options& o, const Argument& a)
          {
            o.RotationAxis =
              a.AsChoice({ { "x", 0 }, { "y", 1 }, { "z", 2 }, { "any", Options::AnyAxis } });
          } },
        { "--scale", "LOWER,UPPER", "scale each axis by a factor of its own in this range",
          [](Options& o, const Argument& a) { o.ScaleRange = a.AsRange(); } },
        { "--displace", "A",
          "move the points by up to A times the longest side of the mesh along each axis",
          [](Options& o, const Argument& a) { o.Displacement = a.AsReal(Positive); } },
        { "--stay", nullptr,
          "variants stay where the mesh is, and may leave the grid; without, those that are\n"
          "turned, scaled or displaced are moved to the middle of the grid, in such a size\n"
          "that they fit however they are turned, and --resolution gives N^3 voxels",
          [](Options& o, const Argument&) { o.StaysInPlace = true; } },
      } },
    { "Steps, which change the voxels one after the other, in the order given here",
      {
        { "--unite", "FILE",
          "add the voxels of this file: a mesh, voxelized as INPUT is, or on the grid of a\n"
          "volume as the options for meshes say; or a mask, an image\n"
          "on the very same grid that is not 0 where voxels are set, one of\n"
          "@MASKS@",
          [](Options& o, const Argument& a) { AddJoin(o, Step::Type::Unite, a); }, true },
        { "--intersect", "FILE", "keep the voxels that are in this file, too",
          [](Options& o, const Argument& a) { AddJoin(o, Step::Type::Intersect, a); }, true },
        { "--subtract", "FILE", "take the voxels of this file away",
          [](Options& o, const Argument& a) { AddJoin(o, Step::Type::Subtract, a); }, true },
        { "--xor", "FILE", "keep what is in one of the two, and not in both",
          [](Options& o, const Argument& a) { AddJoin(o, Step::Type::Xor, a); }, true },
        { "--complement", nullptr, "set the voxels of the grid that are not set, and no others",
          [](Options& o, const Argument& a) {
            o.Steps.push_back({ Step::Type::Complement, a.GetOption(), {} });
          },
          true },
        { "--dilate", "N", "grow by N voxels to every side",
          [](Options& o, const Argument& a) { AddMorphology(o, Step::Type::Dilate, a); }, true },
        { "--erode", "N", "shrink by N voxels from every side",
          [](Options& o, const Argument& a) { AddMorphology(o, Step::Type::Erode, a); }, true },
        { "--open", "N", "erode, then dilate: what is thinner than 2 N + 1 voxels goes",
          [](Options& o, const Argument& a) { AddMorphology(o, Step::Type::Open, a); }, true },
        { "--close", "N", "dilate, then erode: gaps of up to 2 N voxels are filled",
          [](Options& o, const Argument& a) { AddMorphology(o, Step::Type::Close, a); }, true },
        { "--kernel", "KERNEL",
          "what the steps after it grow and shrink by:\n"
          "box        2 N + 1 voxels along each axis (default)\n"
          "sphere     of that diameter, N being 31 at most\n"
          "faces6     N times to the neighbours that share a face,\n"
          "edges18    or also an edge,\n"
          "corners26  or also a corner",
          [](Options& o, const Argument& a)
          {
            OptionChecks::CheckKernelIsUsed(o);
            o.Kernel = a.AsChoice({ { "box", Morphology::KERNEL_BOX },
              { "faces6", Morphology::KERNEL_FACES6 }, { "edges18", Morphology::KERNEL_EDGES18 },
              { "corners26", Morphology::KERNEL_CORNERS26 },
              { "sphere", Morphology::KERNEL_SPHERE } });
            o.KernelIsUsed = false;
          },
          true },
        { "--fill-holes", nullptr,
          "set the voxels of all holes: the unset ones that no path of unset ones joins to\n"
          "the border of the grid",
          [](Options& o, const Argument& a) { AddConnectivity(o, Step::Type::FillHoles, a); },
          true },
        { "--keep-largest", nullptr, "keep the component of most voxels that are set, alone",
          [](Options& o, const Argument& a) { AddConnectivity(o, Step::Type::KeepLargest, a); },
          true },
        { "--connectivity", "N",
          "6, 18 or 26 (default): the neighbours that a set voxel holds together with, for\n"
          "the steps after it; unset ones do so by their faces, and with 6 by their corners",
          [](Options& o, const Argument& a)
          {
            OptionChecks::CheckConnectivityIsUsed(o);
            o.Connectivity = a.AsChoice({ { "6", 6 }, { "18", 18 }, { "26", 26 } });
            o.ConnectivityIsUsed = false;
          },
          true },
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
        { "--memory-limit", "SIZE",
          "make and write the voxels in slabs that take no more memory than this, 1G say,\n"
          "for grids larger than memory; for @SLABS@",
          [](Options& o, const Argument& a) { o.MemoryLimit = a.AsBytes(); } },
        { "--picture", "FILE.png",
          "also draw the voxels that are set, coloured by the texture or else by the first\n"
          "attribute: numbers from blue, the least, to red, vectors by their length",
          [](Options& o, const Argument& a) { o.Picture = a.AsFile(); } },
        { "--up", "AXIS", "x, y or z: the axis that points up in the picture (default: y)",
          [](Options& o, const Argument& a) {
            o.UpAxis = a.AsChoice({ { "x", 0 }, { "y", 1 }, { "z", 2 } });
          } },
        { "--info", nullptr,
          "print triangles of all meshes, scalars of a volume, grid, filled voxels and\n"
          "their volume after the steps, leaking columns of solids, times and the OpenGL\n"
          "renderer, one a line, on the standard output",
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
  Argument::RefuseUsage("unknown option " + name);
}

void StoreFiles(Options& options, const std::vector<std::string>& files)
{
  if (files.empty() || files[0].empty())
  {
    Argument::RefuseUsage("INPUT and OUTPUT are missing");
  }
  if (files.size() == 1 || files[1].empty())
  {
    Argument::RefuseUsage("OUTPUT is missing");
  }
  if (files.size() > 2)
  {
    Argument::RefuseUsage(
      "'" + files[2] + "' is one file too many; there are INPUT and OUTPUT only");
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
  std::string help = Replaced(definition.Help, "any of @REFERENCES@", ImageReader::GetExtensions());
  help = Replaced(help, "@MASKS@", ImageReader::GetImageExtensions());
  help = Replaced(help, "@SLABS@", VoxelOutput::GetExtensionsOfSlabs());
  std::istringstream lines(Replaced(help, "@TEXTURES@", TextureImage::GetExtensions()));
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
  OptionChecks::Names given;
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
        Argument::RefuseUsage(name + " takes no value");
      }
      value = word->substr(equals + 1);
    }
    else if (definition.ValueName)
    {
      if (++word == words.end())
      {
        Argument::RefuseUsage(name + " needs a value, " + definition.ValueName);
      }
      value = *word;
    }
    if (!given.insert(name).second && !definition.Repeats)
    {
      Argument::RefuseUsage(name + " is given twice");
    }
    definition.Store(options, Argument(name, value));
  }
  if (options.Help || options.Version)
  {
    return options;
  }
  StoreFiles(options, files);
  OptionChecks::Check(options, given);
  return options;
}

bool Options::HasVolume() const
{
  return ImageReader::IsImage(this->Input);
}

std::string Options::GetHelp()
{
  std::ostringstream out;
  out << "Usage: vtkvoxelize [OPTIONS] INPUT OUTPUT\n\n"
         "Turns a mesh into voxels, solid by default, on the graphics processor or what stands in\n"
         "for it, or takes those of a volume; and joins them with others, or makes them grow and\n"
         "shrink, step by step.\n\n"
         "  INPUT             the mesh: "
      << MeshReader::GetExtensions()
      << "\n"
         "                    or a volume, a mask or a label map:\n"
         "                    "
      << ImageReader::GetImageExtensions() << "\n"
      << (VoxelInput::GetExtensions().empty()
             ? std::string()
             : "                    or voxels, to be written as they are: " +
               VoxelInput::GetExtensions() + "\n")
      << "  OUTPUT            the voxels: " << VoxelOutput::GetExtensions()
      << "\n"
         "                    .vti holds all there is, .mha, .mhd, .binvox and .bits the set\n"
         "                    voxels alone, the last ones a bit each; with --method surface also\n"
         "                    .vtp, a list of the voxels, and .htg, an octree, for grids too\n"
         "                    large to be kept as images\n";
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
       "  vtkvoxelize part.stl rest.vti --subtract drill.stl --kernel sphere --open 2\n"
       "  vtkvoxelize --reference mask.nii.gz liver.stl shell.mha --dilate 3 --subtract "
       "mask.nii.gz\n"
       "  vtkvoxelize --resolution 4096 --memory-limit 1G bunny.ply bunny.vdb\n"
       "  vtkvoxelize ct.mha bone.vti --iso 300 --keep-largest --fill-holes\n"
       "  vtkvoxelize labels.nrrd liver.mha --label 6 --subtract tumour.stl\n"
       "  vtkvoxelize --method tetra --resolution 64 --rotate any --scale 0.5,1.5 --seed 1 \n"
       "    --variants 1000 --repair chair.obj chair.bits\n"
       "  vtkvoxelize --method tetra --resolution 32 --rotate z --variants 20 car.obj "
       "car_%02d.binvox\n"
       "\nExit codes:\n"
       "  0  all is well\n"
       "  1  the command line makes no sense\n"
       "  2  INPUT, the reference image, the texture or the file of a step can't be read, INPUT "
       "is\n"
       "     neither mesh nor volume, or a mask is on another grid\n"
       "  3  voxelization failed: no OpenGL, a grid too large for the memory, an attribute or\n"
       "     texture coordinates that the mesh has not\n"
       "  4  OUTPUT or the picture can't be written\n"
       "Unless all is well, files that were there before are left as they were, and no others are\n"
       "made; but of variants in a file each, those that are complete stay.\n";
  return out.str();
}
