"""Proves that every wrapped class can be made, printed and used from Python, that all its properties keep
what they are given, that the voxels are a NumPy array of shape (nz, ny, nx), and that those of surfaces
carry the same attributes in every output."""
import re
import sys
import tempfile
import unittest

import numpy as np
import vtkvoxelization
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import (
    vtkHyperTreeGrid, vtkHyperTreeGridNonOrientedCursor, vtkImageData, vtkPolyData)
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkvoxelization import (
    vtkBinvoxReader, vtkBinvoxWriter, vtkHybridSurfaceVoxelizer, vtkImageToSlicemap, vtkSlicemap,
    vtkSlicemapSolidVoxelizer, vtkTetraCoveringVoxelizer, vtkVoxelAlgorithm, vtkVoxelBoolean,
    vtkVoxelConnectivity, vtkVoxelContext, vtkVoxelDensityNormals, vtkVoxelFilter, vtkVoxelizer,
    vtkVoxelMorphology)

# What all voxelizers have, and what each has besides.
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
}
SOLID_VALUES = {"Mode": 3, "FillRule": 2, "ColumnAxis": 1}
TETRA_VALUES = {
    "Shell": 18,
    "KeepInterior": True,
    "ShellValue": 5,
    "Seed": -12345678901,
    "Variant": 7,
    "RotationMode": 2,
    "FixedRotation": (30.0, 1.0, 2.0, 3.0),
    "RotationAxis": (0.0, 1.0, 2.0),
    "ScaleRange": (0.5, 1.5),
    "DisplacementAmplitude": 0.05,
    "DisplacementDistribution": 1,
    "DisplacementDirection": 1,
    "SafeScaleToFit": True,
    "RasterMethod": 0,
}
SURFACE_VALUES = {"Separability": 6, "Strategy": 2, "CutoffArea": 3.5, "AttributeCombination": 3}


def sphere():
    """With the normals, and the x of the points as an array of this name."""
    source = vtkSphereSource()
    source.SetThetaResolution(40)
    source.SetPhiResolution(40)
    source.Update()
    mesh = source.GetOutput()
    x = numpy_to_vtk(vtk_to_numpy(mesh.GetPoints().GetData())[:, 0].copy(), deep=True)
    x.SetName("x")
    mesh.GetPointData().AddArray(x)
    return mesh


def leaves(tree):
    """Ids of the cells that are voxels, in the order of the trees."""
    cursor = vtkHyperTreeGridNonOrientedCursor()
    ids = []

    def visit():
        if cursor.IsMasked():
            return
        if cursor.IsLeaf():
            ids.append(cursor.GetGlobalNodeIndex())
            return
        for child in range(cursor.GetNumberOfChildren()):
            cursor.ToChild(child)
            visit()
            cursor.ToParent()

    for i in range(tree.GetMaxNumberOfTrees()):
        if tree.GetTree(i):
            tree.InitializeNonOrientedCursor(cursor, i, False)
            visit()
    return ids


class Smoke(unittest.TestCase):

    def test_instances(self):
        abstract = vtkVoxelAlgorithm, vtkVoxelFilter, vtkVoxelizer
        classes = {name: value for name, value in vars(vtkvoxelization).items() if isinstance(value, type)}
        self.assertIn("vtkSlicemapSolidVoxelizer", classes)
        for name, one in classes.items():
            if one in abstract:
                with self.assertRaises(TypeError):
                    one()
            else:
                instance = one()
                self.assertEqual(instance.GetClassName(), name)
                self.assertIn(name, str(instance))

    def test_boolean(self):
        ball = vtkSlicemapSolidVoxelizer()
        ball.SetInputData(sphere())
        ball.SetResolution(24)
        ball.Update()
        mask = vtkImageData()
        mask.DeepCopy(ball.GetOutput())
        mask.GetPointData().SetScalars(numpy_to_vtk(np.arange(mask.GetNumberOfPoints()) % 2, deep=True))
        boolean = vtkVoxelBoolean()
        boolean.SetInputConnection(ball.GetOutputPort())
        boolean.AddInputDataObject(mask)
        boolean.SetInputName(1, "mask")
        boolean.SetExpression("A - mask")
        boolean.Update()
        a = vtk_to_numpy(ball.GetOutput().GetPointData().GetScalars())
        b = vtk_to_numpy(mask.GetPointData().GetScalars())
        found = vtk_to_numpy(boolean.GetOutput().GetPointData().GetScalars())
        self.assertTrue(np.array_equal(found, a & (1 - b)))
        size = np.prod(mask.GetSpacing())
        self.assertAlmostEqual(boolean.GetVolume(), found.sum() * size)
        self.assertAlmostEqual(boolean.GetIntersectionVolume(), (a & b).sum() * size)
        self.assertFalse(boolean.IsEmpty())

    def test_morphology(self):
        values = np.zeros((9, 11, 13), np.uint8)
        values[4, 5, 6] = 1
        image = vtkImageData()
        image.SetDimensions(13, 11, 9)
        image.GetPointData().SetScalars(numpy_to_vtk(values.ravel(), deep=True))
        morphology = vtkVoxelMorphology()
        morphology.SetInputData(image)
        morphology.SetKernelSize(3, 5, 1)
        morphology.Update()
        values[4, 3:8, 5:8] = 1
        found = vtk_to_numpy(morphology.GetOutput().GetPointData().GetScalars())
        self.assertTrue(np.array_equal(found.reshape(9, 11, 13), values))

    def test_density(self):
        values = np.zeros((8, 12, 16), np.uint8)
        values[:, :, 5:] = 1
        image = vtkImageData()
        image.SetDimensions(16, 12, 8)
        image.GetPointData().SetScalars(numpy_to_vtk(values.ravel(), deep=True))
        density = vtkVoxelDensityNormals()
        density.SetInputData(image)
        density.SetKernelSize(4, 2, 2)
        density.DownsampleOn()
        density.Update()
        data = density.GetOutput().GetPointData()
        found = vtk_to_numpy(data.GetArray("Density")).reshape(4, 6, 4)
        self.assertTrue(np.array_equal(found[1, 2], [0.0, 0.75, 1.0, 1.0]))
        normals = vtk_to_numpy(data.GetArray("Normals")).reshape(4, 6, 4, 3)
        self.assertTrue(np.array_equal(normals[2, 3], [[-1, 0, 0], [-1, 0, 0], [-1, 0, 0], [0, 0, 0]]))
        self.assertEqual(density.GetOutput().GetOrigin(), (1.5, 0.5, 0.5))

    def test_connectivity(self):
        values = np.ones((9, 11, 13), np.uint8)
        values[4, 5, 6] = 0
        values[0, 1:4, 1:12] = 0
        image = vtkImageData()
        image.SetDimensions(13, 11, 9)
        image.GetPointData().SetScalars(numpy_to_vtk(values.ravel(), deep=True))
        connectivity = vtkVoxelConnectivity()
        connectivity.SetInputData(image)
        connectivity.Update()
        values[4, 5, 6] = 1
        found = vtk_to_numpy(connectivity.GetOutput().GetPointData().GetScalars())
        self.assertTrue(np.array_equal(found.reshape(9, 11, 13), values))
        self.assertEqual(connectivity.GetNumberOfComponents(), 1)
        for neighbours in "6", "18", "26":
            getattr(connectivity, "SetConnectivityTo" + neighbours)()
            self.assertEqual(connectivity.GetConnectivity(), int(neighbours))

    def test_level_sets(self):
        values = np.random.default_rng(3).integers(-1000, 3000, (9, 11, 13), np.int16)
        image = vtkImageData()
        image.SetDimensions(13, 11, 9)
        image.GetPointData().SetScalars(numpy_to_vtk(values.ravel(), deep=True))
        sets = vtkImageToSlicemap()
        sets.SetInputData(image)
        levels = 500, 1150.5, -3
        for i, level in enumerate(levels):
            sets.SetValue(i, level)
            self.assertEqual(sets.GetValue(i), level)
        sets.Update()
        self.assertEqual(sets.GetNumberOfOutputPorts(), sets.GetNumberOfValues())
        for i, level in enumerate(levels):
            found = vtk_to_numpy(sets.GetOutput(i).GetPointData().GetScalars())
            self.assertTrue(np.array_equal(found.reshape(9, 11, 13), values >= level))
        sets.ThresholdBetween(0, 100)
        self.assertEqual(sets.GetRange(0), (0.0, 100.0))
        sets.Update()
        self.assertEqual(sets.GetNumberOfFilledVoxels(), ((values >= 0) & (values <= 100)).sum())

    def test_variants(self):
        voxelizer = vtkTetraCoveringVoxelizer()
        voxelizer.SetInputData(sphere())
        voxelizer.SetSampleDimensions(20, 20, 20)
        voxelizer.SetRotationModeToUniform()
        voxelizer.SetScaleRange(0.5, 1.5)
        voxelizer.SafeScaleToFitOn()
        array = vtkUnsignedCharArray()
        self.assertTrue(voxelizer.VoxelizeBatch(3, 4, array))
        batch = vtk_to_numpy(array).reshape(4, 20, 20, 20)
        voxelizer.SetVariant(5)
        voxelizer.Update()
        single = vtk_to_numpy(voxelizer.GetOutput().GetPointData().GetScalars())
        self.assertTrue(np.array_equal(batch[2], single.reshape(20, 20, 20)))
        self.assertTrue(single.any() and not np.array_equal(batch[0], batch[1]))
        matrix = vtkMatrix4x4()
        self.assertTrue(voxelizer.GetVariantMatrix(5, matrix))
        mesh = vtkPolyData()
        self.assertTrue(voxelizer.GetVariantMesh(5, mesh))
        point = sphere().GetPoint(7) + (1.0,)
        np.testing.assert_allclose(mesh.GetPoint(7), matrix.MultiplyPoint(point)[:3], atol=1e-12)

    def test_binvox(self):
        ball = vtkSlicemapSolidVoxelizer()
        ball.SetInputData(sphere())
        ball.SetResolution(24)
        with tempfile.TemporaryDirectory() as folder:
            writer = vtkBinvoxWriter()
            writer.SetInputConnection(ball.GetOutputPort())
            writer.SetFileName(folder + "/ball.binvox")
            self.assertEqual(writer.Write(), 1)
            self.assertTrue(vtkBinvoxReader.CanReadFile(folder + "/ball.binvox"))
            reader = vtkBinvoxReader()
            reader.SetFileName(folder + "/ball.binvox")
            reader.Update()
        self.assertTrue(np.array_equal(vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()),
                                       vtk_to_numpy(ball.GetOutput().GetPointData().GetScalars())))

    def test_properties(self):
        for voxelizer, own in (
                (vtkSlicemapSolidVoxelizer(), SOLID_VALUES), (vtkHybridSurfaceVoxelizer(), SURFACE_VALUES),
                (vtkTetraCoveringVoxelizer(), TETRA_VALUES)):
            for name, value in {**VALUES, **own}.items():
                getattr(voxelizer, "Set" + name)(value)
                self.assertEqual(getattr(voxelizer, "Get" + name)(), value, name)
            image = vtkImageData()
            voxelizer.SetReferenceImage(image)
            self.assertIs(voxelizer.GetReferenceImage(), image)

    def test_lists_of_attributes(self):
        voxelizer = vtkHybridSurfaceVoxelizer()
        image = vtkImageData()
        voxelizer.SetTextureImage(image)
        self.assertIs(voxelizer.GetTextureImage(), image)
        for name in "a", "b", "a":
            voxelizer.AddAttribute(name)
        count = voxelizer.GetNumberOfAttributes()
        self.assertEqual([voxelizer.GetAttribute(i) for i in range(count)], ["a", "b"])
        self.assertIsNone(voxelizer.GetAttribute(2))
        voxelizer.RemoveAllAttributes()
        self.assertEqual(voxelizer.GetNumberOfAttributes(), 0)

    def check_enumerations(self, voxelizer, numbers):
        """Number of setters for each property; each sets a value that no other does."""
        for name, number in {"Backend": 3, "OutputScalarType": 2, "OutputAttributeType": 2, **numbers}.items():
            setters = [s for s in dir(voxelizer) if re.match(f"Set{name}To", s)]
            values = set()
            for setter in setters:
                getattr(voxelizer, setter)()
                values.add(getattr(voxelizer, "Get" + name)())
            self.assertEqual((len(setters), len(values)), (number, number), name)

    def test_enumerations(self):
        self.check_enumerations(
            vtkSlicemapSolidVoxelizer(), {"Mode": 4, "FillRule": 3, "ColumnAxis": 4})
        self.assertEqual(vtkSlicemapSolidVoxelizer.MODE_BOUNDARY, 3)
        self.check_enumerations(
            vtkHybridSurfaceVoxelizer(), {"Separability": 2, "Strategy": 4, "AttributeCombination": 4})
        self.assertEqual(vtkHybridSurfaceVoxelizer.STRATEGY_HYBRID, 3)
        self.assertEqual(vtkHybridSurfaceVoxelizer.COMBINE_FIRST, 3)

    def test_voxels(self):
        voxelizer = vtkSlicemapSolidVoxelizer()
        voxelizer.SetInputData(sphere())
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

    def surface(self, resolution=30):
        voxelizer = vtkHybridSurfaceVoxelizer()
        voxelizer.SetInputData(sphere())
        voxelizer.SetResolution(resolution)
        for name in "Normals", "x":
            voxelizer.AddAttribute(name)
        return voxelizer

    def test_surface_outputs(self):
        voxelizer = self.surface()
        voxelizer.Update()
        image = voxelizer.GetOutput()
        n = image.GetDimensions()
        voxels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(n[::-1])
        count = voxelizer.GetNumberOfFilledVoxels()
        self.assertEqual(voxels.sum(), count)
        self.assertFalse(voxels[n[2] // 2, n[1] // 2, n[0] // 2])

        voxelizer.Update(1)
        self.assertEqual(voxelizer.GetNumberOfFilledVoxels(), count)
        points = voxelizer.GetVoxelList().GetPointData()
        i, j, k = vtk_to_numpy(points.GetArray("VoxelIndex")).T
        self.assertEqual(len(i), count)
        self.assertTrue(voxels[k, j, i].all())

        voxelizer.Update(2)
        self.assertEqual(voxelizer.GetNumberOfFilledVoxels(), count)
        tree = voxelizer.GetHyperTreeGrid()
        self.assertIsInstance(tree, vtkHyperTreeGrid)
        ids = leaves(tree)
        self.assertEqual(len(ids), count)

        for name, components in ("Normals", 3), ("x", 1):
            dense = vtk_to_numpy(image.GetPointData().GetArray(name)).reshape(n[::-1] + (components,))
            listed = vtk_to_numpy(points.GetArray(name)).reshape(-1, components)
            self.assertEqual((dense[k, j, i] - listed).any(), False)
            self.assertFalse(dense[voxels == 0].any())
            in_tree = vtk_to_numpy(tree.GetCellData().GetArray(name)).reshape(-1, components)[ids]
            self.assertEqual(sorted(map(tuple, in_tree)), sorted(map(tuple, listed)))
        # The normals of a sphere of radius 0.5 point as its points do.
        centres = vtk_to_numpy(voxelizer.GetVoxelList().GetPoints().GetData())
        normals = vtk_to_numpy(points.GetArray("Normals"))
        self.assertLess(abs(normals - 2 * centres).max(), 0.15)

    def test_surface_runs_are_identical(self):
        def run():
            voxelizer = self.surface(60)
            voxelizer.Update(1)
            points = voxelizer.GetVoxelList().GetPointData()
            return [vtk_to_numpy(points.GetArray(i)).tobytes() for i in range(points.GetNumberOfArrays())]

        first = run()
        self.assertEqual(len(first), 3)
        self.assertEqual([run() for _ in range(3)], 3 * [first])

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
