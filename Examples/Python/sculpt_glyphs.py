"""Voxelizes glyphs that VTK draws as instances of a mesh, and sculpts them with a second mesh.

    sculpt_glyphs.py MESH.ply IMAGE.vti

Glyphs exist nowhere as a mesh, so they are voxelized from what the depth buffers see of them. What the
buffers of the mesh leave of them are two-dimensional images, which take the place of the voxels.
"""
import sys

from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersSources import vtkCubeSource
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkGlyph3DMapper
from vtkvoxelization import vtkDepthBufferVoxelizer

mesh, image = sys.argv[1:]

reader = vtkPLYReader()
reader.SetFileName(mesh)
reader.Update()
size = max(reader.GetOutput().GetBounds()[1::2])

cube = vtkCubeSource()
mapper = vtkGlyph3DMapper()
mapper.SetInputConnection(reader.GetOutputPort())
mapper.SetSourceConnection(cube.GetOutputPort())
mapper.SetScaleFactor(0.02 * size)
mapper.ScalarVisibilityOff()
actor = vtkActor()
actor.SetMapper(mapper)

glyphs = vtkDepthBufferVoxelizer()
glyphs.AddProp(actor)
glyphs.SetResolution(96)
glyphs.Update()

# The same grid, and between the buffers of both.
sculpture = vtkDepthBufferVoxelizer()
sculpture.SetInputConnection(reader.GetOutputPort())
sculpture.SetReferenceImage(glyphs.GetOutput())
for axis in range(3):
    sides = [vtkImageData(), vtkImageData()]
    for side, depths in enumerate(sides):
        glyphs.GetDepthBuffer(axis, side, depths)
    sculpture.AddDepthBuffers(axis, *sides)
sculpture.Update()

before, after = glyphs.GetNumberOfFilledVoxels(), sculpture.GetNumberOfFilledVoxels()
print(f"{before} voxels of cubes, {after} of them in the mesh")
assert 0 < after < before

writer = vtkXMLImageDataWriter()
writer.SetInputConnection(sculpture.GetOutputPort())
writer.SetFileName(image)
sys.exit(0 if writer.Write() else 1)
