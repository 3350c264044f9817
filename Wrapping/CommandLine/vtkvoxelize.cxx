// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
// The program vtkvoxelize: reads a mesh or a volume, makes voxels of it, writes the voxels.
#include "Failure.h"
#include "FileNames.h"
#include "Messages.h"
#include "Options.h"
#include "Picture.h"
#include "Report.h"
#include "StagedFiles.h"
#include "Terminal.h"
#include "VoxelInput.h"
#include "VoxelOutput.h"
#include "VoxelPipeline.h"
#include "VoxelSet.h"

#include "vtkImageData.h"
#include "vtkPolyData.h"
#include "vtkTetraCoveringVoxelizer.h"
#include "vtkVersion.h"
#include "vtkVoxelAlgorithm.h"

#include <cstdlib>
#include <iostream>
#include <optional>

namespace
{
using Kind = VoxelOutput::Kind;

/// What the picture shows: octrees have a list made of them first.
VoxelSet GetVoxels(VoxelPipeline& pipeline, Kind kind)
{
  vtkVoxelAlgorithm* result = pipeline.GetResult();
  if (kind == Kind::Image)
  {
    return VoxelSet(result->GetOutput());
  }
  if (kind == Kind::Octree)
  {
    pipeline.Run(Kind::List);
  }
  vtkDataObject* list = result->GetOutputDataObject(static_cast<int>(Kind::List));
  return { vtkPolyData::SafeDownCast(list), pipeline.GetGrid() };
}

std::string StagePicture(const Options& options, StagedFiles& files)
{
  if (!options.Picture)
  {
    return {};
  }
  if (FileNames::GetExtension(*options.Picture) != ".png")
  {
    throw Failure(
      ExitCode::Output, "cannot write " + *options.Picture + ": a picture is a .png file");
  }
  return files.Add(*options.Picture);
}

/// The attribute whose colours the picture has; empty when there is none.
std::string GetDrawnAttribute(const Options& options)
{
  if (options.Texture)
  {
    return "Texture";
  }
  return options.Attributes.empty() ? std::string() : options.Attributes.front();
}

void WritePicture(
  const VoxelSet& voxels, const Options& options, const std::string& staged, Terminal& terminal)
{
  terminal.ShowProgress("drawing", 0.0);
  constexpr int y = 1;
  const auto picture =
    Picture::Draw(voxels, GetDrawnAttribute(options), options.UpAxis.value_or(y));
  if (!picture)
  {
    throw Failure(
      ExitCode::Output, "cannot draw " + *options.Picture + ": there is no OpenGL window");
  }
  Picture::Write(picture, staged, *options.Picture);
}

/// From one file of voxels to another.
void Convert(const Options& options, Terminal& terminal)
{
  Messages messages;
  StagedFiles files;
  const VoxelOutput output(options.Output, files);
  output.Write(VoxelInput::Read(options.Input, messages, terminal), messages, terminal);
  files.Commit();
  terminal.ClearBar();
}

/// A file for each variant, or one for all.
void RunVariants(const Options& options, Terminal& terminal)
{
  const vtkTypeInt64 first = options.FirstVariant.value_or(0);
  const int count = *options.Variants;
  const auto number = FileNames::FindNumber(options.Output);
  const auto nameOf = [&](int i) { return number ? (*number)(first + i) : options.Output; };
  {
    // Fails before there is any work, if it must.
    StagedFiles files;
    const VoxelOutput output(nameOf(0), files);
  }
  Messages messages;
  VoxelPipeline pipeline(options, messages, terminal);
  Report report;
  report.Time("reading", [&] { pipeline.Read(); });
  auto* voxelizer = vtkTetraCoveringVoxelizer::SafeDownCast(pipeline.GetSources().front().Maker);
  const auto kind = VoxelOutput::GetKind(options.Output);
  const auto writeEach = [&]
  {
    for (int i = 0; i < count; ++i)
    {
      StagedFiles files;
      const VoxelOutput output(nameOf(i), files);
      voxelizer->SetVariant(first + i);
      pipeline.Run(kind);
      output.Write(
        pipeline.GetResult()->GetOutputDataObject(static_cast<int>(kind)), messages, terminal);
      files.Commit();
    }
  };
  const auto writeAll = [&]
  {
    StagedFiles files;
    const VoxelOutput output(options.Output, files);
    pipeline.Run(kind);
    output.WriteBatch(voxelizer, first, count, messages, terminal);
    files.Commit();
  };
  report.Time("variants", [&] { number ? writeEach() : writeAll(); });
  terminal.ClearBar();
  if (options.Info)
  {
    report.Describe(pipeline, std::nullopt);
    report.Print();
  }
}

void Run(const Options& options, Terminal& terminal)
{
  if (options.Variants)
  {
    RunVariants(options, terminal);
    return;
  }

  if (VoxelInput::IsVoxels(options.Input))
  {
    Convert(options, terminal);
    return;
  }
  Messages messages;
  StagedFiles files;
  const std::string picture = StagePicture(options, files);
  const VoxelOutput output(options.Output, files);
  const auto kind = VoxelOutput::GetKind(options.Output);
  VoxelPipeline pipeline(options, messages, terminal);

  Report report;
  report.Time("reading", [&] { pipeline.Read(); });
  std::optional<vtkIdType> filledInSlabs;
  if (options.MemoryLimit)
  {
    report.Time("slabs",
      [&]
      {
        pipeline.RunInSlabs(
          [&](vtkVoxelAlgorithm* result)
          {
            filledInSlabs = output.WriteSlabs(result, options, messages, terminal);
            return *filledInSlabs;
          });
      });
  }
  else
  {
    report.Time("voxelizing", [&] { pipeline.Run(kind); });
    report.Time("writing",
      [&]
      {
        output.Write(
          pipeline.GetResult()->GetOutputDataObject(static_cast<int>(kind)), messages, terminal);
      });
  }
  if (options.Picture)
  {
    report.Time(
      "drawing", [&] { WritePicture(GetVoxels(pipeline, kind), options, picture, terminal); });
  }
  files.Commit();
  terminal.ClearBar();
  if (options.Info)
  {
    report.Describe(pipeline, filledInSlabs);
    report.Print();
  }
}

ExitCode Main(const std::vector<std::string>& words)
{
  Terminal terminal;
  try
  {
    const Options options = Options::Parse(words);
    if (options.Help)
    {
      std::cout << Options::GetHelp();
      return ExitCode::Success;
    }
    if (options.Version)
    {
      std::cout << "vtkvoxelize " << VTKVOXELIZATION_VERSION << " (VTK "
                << vtkVersion::GetVTKVersion() << ")\n";
      return ExitCode::Success;
    }
    if (options.Quiet)
    {
      terminal.BeQuiet();
    }
    Run(options, terminal);
    return ExitCode::Success;
  }
  catch (const Failure& failure)
  {
    terminal.PrintError(failure.what());
    return failure.GetCode();
  }
  catch (const std::exception& error)
  {
    terminal.PrintError(std::string("out of memory or worse: ") + error.what());
    return ExitCode::Voxelization;
  }
}
}

int main(int argc, char* argv[])
{
  const ExitCode code = Main({ argv + 1, argv + argc });
  // Readers that an exception ended and writers that failed have lost what they held. VTK is not
  // asked to tidy up what they left half done, nor is it anybody's leak.
  if (code == ExitCode::Input || code == ExitCode::Output)
  {
    std::_Exit(static_cast<int>(code));
  }
  return static_cast<int>(code);
}
