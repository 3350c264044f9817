// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBinvoxWriter.h"

#include "vtkBinvoxSlabs.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkImageVoxels.h"
#include "vtkInformation.h"
#include "vtkNewVoxelFile.h"
#include "vtkObjectFactory.h"
#include "vtkVoxelFileError.h"

#include <new>

vtkStandardNewMacro(vtkBinvoxWriter);

vtkBinvoxWriter::vtkBinvoxWriter() = default;

vtkBinvoxWriter::~vtkBinvoxWriter()
{
  this->SetFileName(nullptr);
}

vtkImageData* vtkBinvoxWriter::GetInput()
{
  return vtkImageData::SafeDownCast(this->Superclass::GetInput());
}

int vtkBinvoxWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

void vtkBinvoxWriter::WriteData()
{
  try
  {
    const vtkImageVoxels voxels(this->GetInput());
    voxels.Check();
    vtkBinvoxSlabs::Check(voxels.Grid);
    vtkNewVoxelFile file(this->FileName, this->InPlace);
    vtkBinvoxSlabs whole(file.GetStream(), voxels.Grid);
    bool aborted = false;
    const auto progress = [&](double fraction)
    {
      this->UpdateProgress(fraction);
      aborted = this->GetAbortExecute() != 0;
      return !aborted;
    };
    voxels.Read(
      [&](const std::uint32_t* words)
      {
        if (whole.Add(words, voxels.Grid, progress))
        {
          whole.Finish(progress);
        }
      });
    if (!aborted)
    {
      file.Commit();
    }
  }
  catch (const vtkVoxelFileError& error)
  {
    this->SetErrorCode(error.Code);
    vtkErrorMacro(<< error.what());
  }
  catch (const std::bad_alloc&)
  {
    this->SetErrorCode(vtkErrorCode::UserError);
    vtkErrorMacro("There is no memory for the bits of the image.");
  }
}

void vtkBinvoxWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "InPlace: " << this->InPlace << "\n";
}
