// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
// The program vtkvoxelize: reads a mesh, voxelizes it, writes an image.
#include "Failure.h"
#include "FileNames.h"
#include "ImageOutput.h"
#include "MeshReader.h"
#include "Messages.h"
#include "Options.h"
#include "Picture.h"
#include "ReferenceImage.h"
#include "Report.h"
#include "StagedFiles.h"
#include "Terminal.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkSlicemapSolidVoxelizer.h"
#include "vtkVersion.h"

#include <iostream>

namespace
{
void SetGrid(vtkSlicemapSolidVoxelizer* voxelizer, const Options& options, Messages& messages)
{
  if (options.Reference)
  {
    voxelizer->SetReferenceImage(ReferenceImage::Read(*options.Reference, messages));
    return;
  }
  if (options.Dimensions)
  {
    voxelizer->SetSampleDimensions(options.Dimensions->data());
  }
  else if (options.VoxelSize)
  {
    voxelizer->SetVoxelSize(*options.VoxelSize);
  }
  else
  {
    voxelizer->SetResolution(options.Resolution.value_or(Options::DefaultResolution));
  }
  if (options.Bounds)
  {
    voxelizer->SetModelBounds(options.Bounds->data());
  }
  voxelizer->SetPadding(options.Padding.value_or(voxelizer->GetPadding()));
}

void SetVoxels(vtkSlicemapSolidVoxelizer* voxelizer, const Options& options)
{
  voxelizer->SetMode(options.Mode.value_or(voxelizer->GetMode()));
  voxelizer->SetFillRule(options.FillRule.value_or(voxelizer->GetFillRule()));
  voxelizer->SetColumnAxis(options.ColumnAxis.value_or(voxelizer->GetColumnAxis()));
  voxelizer->SetBackend(options.Backend.value_or(voxelizer->GetBackend()));
  voxelizer->SetOutputScalarType(options.ScalarType.value_or(voxelizer->GetOutputScalarType()));
  voxelizer->SetForegroundValue(options.Value.value_or(voxelizer->GetForegroundValue()));
  if (options.Cells)
  {
    voxelizer->SetOutputAttributeTypeToCell();
  }
}

void Voxelize(vtkSlicemapSolidVoxelizer* voxelizer, Messages& messages, Terminal& terminal)
{
  terminal.Watch(voxelizer, "voxelizing");
  voxelizer->Update();
  const auto errors = messages.TakeErrors();
  if (!errors.empty())
  {
    throw Failure(ExitCode::Voxelization, errors.front());
  }
  for (const std::string& warning : messages.TakeWarnings())
  {
    terminal.PrintWarning(warning);
  }
  if (voxelizer->GetNumberOfFilledVoxels() == 0)
  {
    terminal.PrintWarning(
      "no voxel is set: the mesh lies outside of the grid, or is thinner than its voxels");
  }
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

void WritePicture(
  vtkImageData* voxels, const Options& options, const std::string& staged, Terminal& terminal)
{
  terminal.ShowProgress("drawing", 0.0);
  constexpr int y = 1;
  const auto picture = Picture::Draw(voxels, options.UpAxis.value_or(y));
  if (!picture)
  {
    throw Failure(
      ExitCode::Output, "cannot draw " + *options.Picture + ": there is no OpenGL window");
  }
  Picture::Write(picture, staged, *options.Picture);
}

void Run(const Options& options, Terminal& terminal)
{
  Messages messages;
  StagedFiles files;
  const std::string picture = StagePicture(options, files);
  const ImageOutput output(options.Output, files);
  vtkNew<vtkSlicemapSolidVoxelizer> voxelizer;
  SetGrid(voxelizer, options, messages);
  SetVoxels(voxelizer, options);

  Report report;
  report.Time("reading",
    [&] { voxelizer->SetInputDataObject(MeshReader::Read(options.Input, messages, terminal)); });
  report.Time("voxelizing", [&] { Voxelize(voxelizer, messages, terminal); });
  report.Time("writing", [&] { output.Write(voxelizer->GetOutput(), messages, terminal); });
  if (options.Picture)
  {
    report.Time(
      "drawing", [&] { WritePicture(voxelizer->GetOutput(), options, picture, terminal); });
  }
  files.Commit();
  terminal.ClearBar();
  if (options.Info)
  {
    report.Describe(voxelizer);
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
  return static_cast<int>(Main({ argv + 1, argv + argc }));
}
