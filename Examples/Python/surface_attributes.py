"""Voxelizes the surface of a mesh with its normals, and writes the voxels as a list.

    surface_attributes.py MESH.ply IMAGE.vti

The list lies beside the image, as IMAGE.vtp: a point for each voxel of the surface, with its index and
the normal there. It takes no memory for the voxels that are not set.
"""
import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
from vtkvoxelization import vtkHybridSurfaceVoxelizer

mesh, image = sys.argv[1:]

reader = vtkPLYReader()
reader.SetFileName(mesh)

normals = vtkPolyDataNormals()
normals.SetInputConnection(reader.GetOutputPort())
normals.SplittingOff()

voxelizer = vtkHybridSurfaceVoxelizer()
voxelizer.SetInputConnection(normals.GetOutputPort())
voxelizer.SetResolution(256)
voxelizer.AddAttribute("Normals")
voxelizer.Update(1)  # the output port of the list

voxels = voxelizer.GetVoxelList()
lengths = np.linalg.norm(vtk_to_numpy(voxels.GetPointData().GetArray("Normals")), axis=1)
print(f"{len(lengths)} voxels of the surface; their normals are {lengths.mean():.3f} long on average")
assert len(lengths) > 0 and 0.9 < lengths.mean() < 1.001

writer = vtkXMLPolyDataWriter()
writer.SetInputData(voxels)
writer.SetFileName(os.path.splitext(image)[0] + ".vtp")
sys.exit(0 if writer.Write() else 1)
