"""Proves that .vdb files are what other tools expect: OpenVDB's vdb_print lists their grids, types, places and
voxels, and its module for Python reads them; that grids of arrays come back to Python as they were; and that vtkvoxelize writes and reads them.

    TestVDBVoxels.py --program vtkvoxelize -D DATA_DIRECTORY [-T SCRATCH_DIRECTORY]
"""
import importlib.util
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
import TestProgram
from TestProgram import INPUT, OUTPUT, USAGE
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOXML import vtkXMLImageDataReader
from vtkvoxelization import vtkVDBVoxelReader, vtkVDBVoxelWriter


def make_image():
    """A block of 130 x 20 x 9 set voxels among 140 x 30 x 19, oriented, and a scalar and a vector."""
    image = vtkImageData()
    image.SetExtent(-5, 134, -6, 23, 7, 25)
    image.SetSpacing(0.5, 0.5, 0.5)
    image.SetOrigin(1, 2, 3)
    image.SetDirectionMatrix(0, 1, 0, -1, 0, 0, 0, 0, 1)
    occupancy = np.zeros((19, 30, 140), np.uint8)
    occupancy[4:13, 5:25, 3:133] = 1
    random = np.random.default_rng(1)
    arrays = {
        "Occupancy": occupancy.ravel(),
        "Density": random.random(occupancy.size, np.float32),
        "Normals": random.random((occupancy.size, 3), np.float32),
    }
    for name, values in arrays.items():
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        image.GetPointData().AddArray(array)
    image.GetPointData().SetActiveScalars("Occupancy")
    return image, arrays


def read_vti(name):
    reader = vtkXMLImageDataReader()
    reader.SetFileName(str(name))
    reader.Update()
    return reader.GetOutput()


class VDBVoxels(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(dir=TestProgram.SCRATCH)
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name, **settings):
        image, arrays = make_image()
        writer = vtkVDBVoxelWriter()
        writer.SetInputData(image)
        writer.SetFileName(str(self.folder / name))
        for setting, value in settings.items():
            getattr(writer, "Set" + setting)(value)
        self.assertEqual(writer.Write(), 1)
        return arrays

    def test_types(self):
        for occupancy, kind in (0, "bool"), (1, "mask"), (2, "float"):
            self.write("out.vdb", OccupancyGrid=occupancy)
            reader = vtkVDBVoxelReader()
            reader.SetFileName(str(self.folder / "out.vdb"))
            reader.UpdateInformation()
            self.assertEqual([reader.GetTypeOfGrid(i) for i in range(3)],
                             [f"Tree_{kind}_5_4_3", "Tree_float_5_4_3", "Tree_vec3s_5_4_3"])

    def run_program(self, *words):
        return subprocess.run([TestProgram.PROGRAM, *map(str, words)], cwd=self.folder, capture_output=True, text=True)

    def test_print(self):
        tool = shutil.which("vdb_print")
        if not tool:
            self.skipTest("there is no vdb_print")
        for occupancy, kind in (0, "bool"), (1, "bool"), (2, "float"):
            for compression in 0, 1, 2:
                if not vtkVDBVoxelWriter.IsCompressionAvailable(compression):
                    continue
                self.write("out.vdb", OccupancyGrid=occupancy, Compression=compression)
                brief = subprocess.run([tool, "out.vdb"], cwd=self.folder, capture_output=True, text=True)
                self.assertEqual((brief.returncode, brief.stderr), (0, ""))
                lines = {line.split()[0]: line for line in brief.stdout.splitlines() if line.strip()}
                self.assertIn(kind, lines["Occupancy"])
                if occupancy != 2:
                    self.assertIn("130x20x9", lines["Occupancy"])
                    self.assertIn("(-2,-1,11)->(127,18,19)", lines["Occupancy"].replace(" ", ""))
                self.assertIn("float", lines["Density"])
                self.assertIn("vec3s", lines["Normals"])
                long = subprocess.run([tool, "-l", "out.vdb"], cwd=self.folder, capture_output=True, text=True)
                self.assertEqual((long.returncode, long.stderr), (0, ""))
                self.assertIn("VTKVoxelization", long.stdout)
                if occupancy != 2:
                    self.assertIn("23,400", long.stdout)
                else:
                    self.assertIn("level set", long.stdout)

    def test_python_module(self):
        """OpenVDB's own module for Python, which is called openvdb from version 12 on."""
        module = next((importlib.import_module(name) for name in ("openvdb", "pyopenvdb")
                       if importlib.util.find_spec(name)), None)
        if not module:
            self.skipTest("there is no module of OpenVDB for Python")
        arrays = self.write("out.vdb")
        name = str(self.folder / "out.vdb")
        grids = {grid.name: grid for grid in module.readAllGridMetadata(name)}
        self.assertEqual(set(grids), set(arrays))
        occupancy = module.read(name, "Occupancy")
        self.assertEqual(occupancy.activeVoxelCount(), 23400)
        self.assertEqual(tuple(map(tuple, occupancy.evalActiveVoxelBoundingBox())), ((-2, -1, 11), (127, 18, 19)))
        found = np.zeros((140, 30, 19), bool)
        occupancy.copyToArray(found, ijk=(-5, -6, 7))
        self.assertTrue(np.array_equal(found.transpose(2, 1, 0).ravel(), arrays["Occupancy"] != 0))
        # Index to world: 0.5 a voxel, x along y and y against x.
        self.assertTrue(np.allclose(occupancy.transform.indexToWorld((2, 4, 6)), (1 + 2, 2 - 1, 3 + 3)))
        density = module.read(name, "Density")
        values = np.zeros((140, 30, 19), np.float32)
        density.copyToArray(values, ijk=(-5, -6, 7))
        self.assertTrue(np.array_equal(values.transpose(2, 1, 0).ravel(), arrays["Density"]))

    def test_round_trip(self):
        for compression in 0, 1:
            arrays = self.write("out.vdb", Compression=compression)
            self.assertTrue(vtkVDBVoxelReader.CanReadFile(str(self.folder / "out.vdb")))
            reader = vtkVDBVoxelReader()
            reader.SetFileName(str(self.folder / "out.vdb"))
            reader.Update()
            self.assertEqual([reader.GetNameOfGrid(i) for i in range(3)], list(arrays))
            self.assertEqual(reader.GetMetadata("creator"), "VTKVoxelization")
            image = reader.GetOutput()
            self.assertEqual(image.GetExtent(), (-5, 134, -6, 23, 7, 25))
            for name, values in arrays.items():
                found = vtk_to_numpy(image.GetPointData().GetArray(name))
                self.assertTrue(np.array_equal(found, values), name)

    def test_properties(self):
        writer = vtkVDBVoxelWriter()
        for name, value in {"InPlace": True, "OccupancyGrid": 2, "HalfBandWidth": 4.5, "Background": -1.0,
                            "Compression": 1, "FileName": "a.vdb"}.items():
            getattr(writer, "Set" + name)(value)
            self.assertEqual(getattr(writer, "Get" + name)(), value, name)
        writer.SetOccupancyGridToMask()
        self.assertEqual(writer.GetOccupancyGrid(), vtkVDBVoxelWriter.GRID_MASK)
        writer.SetInputName(1, "b")
        self.assertEqual((writer.GetInputName(0), writer.GetInputName(1)), (None, "b"))
        writer.SetMetadata("a", "text")
        self.assertEqual(writer.GetMetadata("a"), "text")
        self.assertIn("text", str(writer))
        reader = vtkVDBVoxelReader()
        reader.SetGridName("b")
        reader.SetMemoryLimit(123)
        self.assertEqual((reader.GetGridName(), reader.GetMemoryLimit()), ("b", 123))
        self.assertIsNone(reader.GetNameOfGrid(0))
        self.assertIn("123", str(reader))

    def test_program(self):
        for words in ["--resolution", 48], ["--resolution", 48, "--method", "surface"]:
            for output in "out.vdb", "out.vti":
                run = self.run_program(*words, TestProgram.BUNNY, output)
                self.assertEqual((run.returncode, run.stderr), (0, ""))
            run = self.run_program("out.vdb", "back.vti")
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            found, expected = (read_vti(self.folder / name) for name in ("back.vti", "out.vti"))
            self.assertEqual(found.GetExtent(), expected.GetExtent())
            self.assertEqual(found.GetSpacing(), expected.GetSpacing())
            self.assertEqual(found.GetOrigin(), expected.GetOrigin())
            self.assertTrue(np.array_equal(vtk_to_numpy(found.GetPointData().GetScalars()),
                                           vtk_to_numpy(expected.GetPointData().GetScalars())))

    def test_program_errors(self):
        self.write("out.vdb")
        good = (self.folder / "out.vdb").read_bytes()
        (self.folder / "short.vdb").write_bytes(good[:len(good) // 2])
        (self.folder / "text.vdb").write_text("nothing\n")
        before = sorted(os.listdir(self.folder))
        for code, words in (
            (INPUT, ["short.vdb", "new.vti"]),
            (INPUT, ["text.vdb", "new.vti"]),
            (INPUT, ["none.vdb", "new.vti"]),
            (USAGE, ["--resolution", 7, "out.vdb", "new.vti"]),
            (USAGE, ["out.vdb", "new.vtp"]),
            (OUTPUT, [TestProgram.BUNNY, "nowhere/new.vdb"]),
        ):
            run = self.run_program(*words)
            self.assertEqual(run.returncode, code, words)
            self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), before)

    def test_program_keeps_floats_out_of_masks(self):
        image, _ = make_image()
        image.GetPointData().RemoveArray("Occupancy")
        writer = vtkVDBVoxelWriter()
        writer.SetInputData(image)
        writer.SetFileName(str(self.folder / "density.vdb"))
        writer.Write()
        run = self.run_program("density.vdb", "new.mha")
        self.assertEqual(run.returncode, OUTPUT)
        self.assertIn(".vti", run.stderr)


if __name__ == "__main__":
    TestProgram.main()
