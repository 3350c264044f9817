"""Proves that every wrapped class can be made, printed and used from Python, that all its properties keep
what they are given, and that the voxels are a NumPy array of shape (nz, ny, nx)."""
import re
import sys
import unittest

import vtkvoxelization
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkvoxelization import vtkSlicemap, vtkSlicemapSolidVoxelizer, vtkVoxelContext, vtkVoxelizer

VALUES = {
    "SampleDimensions": (3, 4, 5),
    "Resolution": 17,
    "VoxelSize": 0.25,
    "ModelBounds": (0.0, 1.0, 0.0, 2.0, 0.0, 3.0),
    "CubicVoxels": False,
    "Padding": 2,
    "OutputWholeExtent": (1, 2, 3, 4, 5, 6),
    "OutputSpacing": (1.0, 2.0, 3.0),
    "OutputOrigin": (4.0, 5.0, 6.0),
    "OutputDirection": (0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0),
    "ForegroundValue": 9,
    "OutputScalarType": 1,
    "OutputAttributeType": 1,
    "HostOutput": False,
    "Backend": 1,
    "CheckWatertight": False,
    "MemoryLimit": 123456,
    "Mode": 3,
    "FillRule": 2,
    "ColumnAxis": 1,
}


class Smoke(unittest.TestCase):
    def test_instances(self):
        for name in ("vtkSlicemap", "vtkSlicemapSolidVoxelizer", "vtkVoxelContext"):
            instance = getattr(vtkvoxelization, name)()
            self.assertEqual(instance.GetClassName(), name)
            self.assertIn(name, str(instance))
        with self.assertRaises(TypeError):
            vtkVoxelizer()

    def test_properties(self):
        voxelizer = vtkSlicemapSolidVoxelizer()
        for name, value in VALUES.items():
            getattr(voxelizer, "Set" + name)(value)
            self.assertEqual(getattr(voxelizer, "Get" + name)(), value, name)
        image = vtkImageData()
        voxelizer.SetReferenceImage(image)
        self.assertIs(voxelizer.GetReferenceImage(), image)

    def test_enumerations(self):
        voxelizer = vtkSlicemapSolidVoxelizer()
        setters = [s for s in dir(voxelizer) if re.match(
            r"Set(Backend|OutputScalarType|OutputAttributeType|Mode|FillRule|ColumnAxis)To", s)]
        self.assertEqual(len(setters), 3 + 2 + 2 + 4 + 3 + 4)
        for setter in setters:
            getattr(voxelizer, setter)()
        self.assertEqual(vtkSlicemapSolidVoxelizer.MODE_BOUNDARY, 3)

    def test_voxels(self):
        source = vtkSphereSource()
        source.SetThetaResolution(40)
        source.SetPhiResolution(40)
        voxelizer = vtkSlicemapSolidVoxelizer()
        voxelizer.SetInputConnection(source.GetOutputPort())
        voxelizer.SetSampleDimensions(30, 40, 50)
        voxelizer.CubicVoxelsOff()
        voxelizer.Update()
        voxels = vtk_to_numpy(voxelizer.GetOutput().GetPointData().GetScalars())
        voxels = voxels.reshape(50, 40, 30)
        self.assertTrue(voxels[25, 20, 15])
        self.assertFalse(voxels[0, 0, 0])
        self.assertEqual(voxels.sum(), voxelizer.GetNumberOfFilledVoxels())
        self.assertEqual(voxelizer.GetNumberOfLeakingColumns(), 0)
        self.assertTrue(voxelizer.GetRendererName())

    def test_slicemap(self):
        image = vtkImageData()
        image.SetDimensions(5, 6, 7)
        image.AllocateScalars(3, 1)
        image.GetPointData().GetScalars().Fill(1)
        slicemap = vtkSlicemap()
        self.assertTrue(slicemap.Upload(image))
        self.assertEqual(slicemap.GetNumberOfFilledVoxels(), 210)
        self.assertEqual(tuple(slicemap.GetDimensions()), (5, 6, 7))
        self.assertTrue(slicemap.Complement())
        self.assertEqual(slicemap.GetNumberOfFilledVoxels(), 0)

    def test_context(self):
        context = vtkVoxelContext()
        self.assertTrue(context.MakeCurrent(), context.GetErrorMessage())
        self.assertGreaterEqual(context.GetVersion(), 32)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
