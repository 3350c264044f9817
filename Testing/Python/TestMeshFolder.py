"""Proves that vtkvoxelization.meshes reads all its formats, labels meshes by their folders, survives damaged
files, of which it names each with what is wrong, and refuses folders that hold nothing. Needs no PyTorch.

    TestMeshFolder.py -D DATA_DIRECTORY
"""
import argparse
import pickle
import shutil
import struct
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkSphereSource, vtkSuperquadricSource
from vtkmodules.vtkIOGeometry import vtkOBJWriter, vtkSTLWriter
from vtkmodules.vtkIOLegacy import vtkPolyDataWriter
from vtkmodules.vtkIOPLY import vtkPLYWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
from vtkvoxelization.meshes import LabelledMesh, MeshError, MeshFolder, read_mesh

DATA = None
WRITERS = {".stl": vtkSTLWriter, ".ply": vtkPLYWriter, ".obj": vtkOBJWriter, ".vtp": vtkXMLPolyDataWriter,
           ".vtk": vtkPolyDataWriter}


def write(source, file):
    file.parent.mkdir(parents=True, exist_ok=True)
    writer = WRITERS[file.suffix.lower()]()
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetFileName(str(file))
    writer.Write()


def sphere():
    source = vtkSphereSource()
    source.SetCenter(1, 2, 3)
    return source


class Folder(unittest.TestCase):

    def setUp(self):
        self.root = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.root)

    def damaged(self):
        """Files that can't be read, each with a pattern of what is said about it; VTK's versions differ."""
        bunny = (DATA / "bunny_7k.ply").read_bytes()
        write(sphere(), self.root / "whole.vtk")
        legacy = (self.root / "whole.vtk").read_bytes()
        (self.root / "whole.vtk").unlink()
        return {
            "cut.ply": (bunny[:5000], "damaged|PLY|polygons"),
            "cut.stl": (b"\0" * 80 + struct.pack("<I", 100) + b"\0" * 500, "100 triangles"),
            "cut.vtk": (legacy[:len(legacy) // 2], ""),
            "empty.obj": (b"", ""),
            "empty.ply": (b"", ""),
            "empty.stl": (b"", ""),
            "nan.stl": (b"\0" * 80 + struct.pack("<I12fH", 1, 0, 0, 1, *[float("nan")] * 9, 0), "NaN"),
            "page.obj": (b"<html>404</html>\n", ""),
            "page.vtp": (b"<html>404</html>\n", ""),
        }

    def test_formats(self):
        source = sphere()
        source.Update()
        for i, suffix in enumerate(WRITERS):
            file = self.root / f"class{i}" / f"mesh{suffix if i else suffix.upper()}"
            write(source, file)
            (file.parent / ".hidden.stl").write_bytes(b"no mesh")
            (file.parent / "notes.txt").write_text("no mesh")
            mesh = read_mesh(file)
            self.assertEqual(mesh.GetNumberOfPolys(), source.GetOutput().GetNumberOfPolys(), suffix)
            np.testing.assert_allclose(mesh.GetBounds(), source.GetOutput().GetBounds(), atol=1e-5)
        calls = []
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            folder = MeshFolder(self.root, progress=lambda *call: calls.append(call))
        self.assertEqual(folder.classes, [f"class{i}" for i in range(len(WRITERS))])
        self.assertEqual([label for _, label in folder], list(range(len(WRITERS))))
        self.assertEqual([done for done, _, _ in calls], list(range(len(WRITERS) + 1)))
        self.assertEqual({total for _, total, _ in calls}, {len(WRITERS)})
        self.assertEqual(folder.skipped, [])

    def test_subset(self):
        for subset, classes in (("train", "ab"), ("test", "ab")):
            for name in classes:
                write(sphere(), self.root / name / subset / f"{subset}.stl")
        folder = MeshFolder(self.root, subset="test")
        self.assertEqual([Path(mesh.name).name for mesh in folder], ["test.stl", "test.stl"])
        with self.assertRaisesRegex(MeshError, "a: there are no meshes"):
            MeshFolder(self.root)

    def test_damaged(self):
        files = self.damaged()
        write(sphere(), self.root / "bad" / "good.stl")
        write(sphere(), self.root / "good" / "good.stl")
        for name, (content, _) in files.items():
            (self.root / "bad" / name).write_bytes(content)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            folder = MeshFolder(self.root)
        self.assertEqual([file.name for file in folder.skipped], sorted(files))
        self.assertEqual(len(caught), len(files))
        for warning, name in zip(caught, sorted(files)):
            self.assertIn(str(self.root / "bad" / name), str(warning.message))
            self.assertRegex(str(warning.message), f"{name}: .*({files[name][1]})")
            self.assertNotIn("\n", str(warning.message))
        self.assertEqual([label for _, label in folder], [0, 1])
        with self.assertRaisesRegex(MeshError, "cut.ply: "):
            MeshFolder(self.root, on_unreadable="error")
        shutil.rmtree(self.root / "good")
        (self.root / "bad" / "good.stl").unlink()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with self.assertRaisesRegex(MeshError, f"none of its {len(files)} meshes"):
                MeshFolder(self.root)

    def test_refused(self):
        with self.assertRaisesRegex(MeshError, "no such folder"):
            MeshFolder(self.root / "nothing")
        with self.assertRaisesRegex(MeshError, "FOLDER/CLASS"):
            MeshFolder(self.root)
        (self.root / "empty").mkdir()
        with self.assertRaisesRegex(MeshError, "empty: there are no meshes"):
            MeshFolder(self.root)
        with self.assertRaisesRegex(ValueError, "on_unreadable"):
            MeshFolder(self.root, on_unreadable="ignore")
        with self.assertRaisesRegex(MeshError, "no such file"):
            read_mesh(self.root / "nothing.stl")
        with self.assertRaisesRegex(MeshError, "meshes of type .step"):
            read_mesh(self.root / "part.step")
        with self.assertRaisesRegex(MeshError, "nothing: it holds no polygons"):
            LabelledMesh(vtkPolyData(), 0, "nothing")
        with self.assertRaisesRegex(TypeError, "a.stl is a str"):
            LabelledMesh("a.stl", 0, "a.stl")

    def test_pickled(self):
        """Strips are polygons afterwards, and polygons of four points stay what they are."""
        for source, polygons in ((vtkCubeSource(), 6), (vtkSuperquadricSource(), None)):
            source.Update()
            mesh = LabelledMesh(source.GetOutput(), 3, "it")
            again = pickle.loads(pickle.dumps(mesh))
            self.assertEqual((again.label, again.name), (3, "it"))
            self.assertEqual(again.mesh.GetNumberOfPolys(), polygons or mesh.mesh.GetNumberOfPolys())
            self.assertGreater(again.mesh.GetNumberOfPolys(), 0)
            for part in (lambda m: m.GetPoints().GetData(), lambda m: m.GetPolys().GetConnectivityArray()):
                self.assertTrue(np.array_equal(vtk_to_numpy(part(again.mesh)), vtk_to_numpy(part(mesh.mesh))))


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("-D", action="append", type=Path)
    arguments, _ = parser.parse_known_args()
    DATA = arguments.D[0]
    unittest.main(argv=sys.argv[:1])
