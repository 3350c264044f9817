"""Labels a mesh on the grid of an oriented image, as segmentations of medical images need it.

    oriented_reference.py MESH.ply IMAGE.vti

The label map has the extent, spacing, origin and direction matrix of the reference image, so the two can
be compared voxel by voxel.
"""
import math
import sys

from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter
from vtkvoxelization import vtkSlicemapSolidVoxelizer

mesh, image = sys.argv[1:]

reader = vtkPLYReader()
reader.SetFileName(mesh)
reader.Update()
bounds = reader.GetOutput().GetBounds()

# Stands for a CT series: turned by 20 degrees about z, and its extent does not begin at zero.
c, s = math.cos(math.radians(20)), math.sin(math.radians(20))
reference = vtkImageData()
reference.SetExtent(10, 109, 20, 119, 5, 64)
reference.SetSpacing(0.003, 0.003, 0.004)
reference.SetDirectionMatrix(c, -s, 0, s, c, 0, 0, 0, 1)
middle = [(bounds[2 * i] + bounds[2 * i + 1]) / 2 for i in range(3)]
offset = [0.0, 0.0, 0.0]
reference.TransformContinuousIndexToPhysicalPoint(59.5, 69.5, 34.5, offset)
reference.SetOrigin([m - o for m, o in zip(middle, offset)])

voxelizer = vtkSlicemapSolidVoxelizer()
voxelizer.SetInputConnection(reader.GetOutputPort())
voxelizer.SetReferenceImage(reference)
voxelizer.SetForegroundValue(7)
voxelizer.Update()

labels = voxelizer.GetOutput()
assert labels.GetExtent() == reference.GetExtent()
assert labels.GetPointData().GetScalars().GetRange() == (0, 7)
print(f"{voxelizer.GetNumberOfFilledVoxels()} voxels of the reference image are labelled")

writer = vtkXMLImageDataWriter()
writer.SetInputData(labels)
writer.SetFileName(image)
sys.exit(0 if writer.Write() else 1)
