"""Reads a mesh, voxelizes it, looks at the voxels as a NumPy array, and writes the image.

    voxelize_bunny.py MESH.ply IMAGE.vti
"""
import sys

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter
from vtkvoxelization import vtkSlicemapSolidVoxelizer

mesh, image = sys.argv[1:]

reader = vtkPLYReader()
reader.SetFileName(mesh)

voxelizer = vtkSlicemapSolidVoxelizer()
voxelizer.SetInputConnection(reader.GetOutputPort())
voxelizer.SetResolution(128)
voxelizer.SetPadding(1)
voxelizer.Update()

output = voxelizer.GetOutput()
nx, ny, nz = output.GetDimensions()
voxels = vtk_to_numpy(output.GetPointData().GetScalars()).reshape(nz, ny, nx)
print(f"{nx} x {ny} x {nz} voxels, {voxels.sum()} inside, on {voxelizer.GetRendererName()}")
assert voxels.any() and not voxels[0].any()

writer = vtkXMLImageDataWriter()
writer.SetInputData(output)
writer.SetFileName(image)
sys.exit(0 if writer.Write() else 1)
