"""Proves that others read the files that vtkBinvoxWriter and vtkVoxelBitsWriter write, and that vtkBinvoxReader
reads what others write: readers and writers of a few lines of NumPy here, which know the formats alone, and trimesh
where it is installed. Truncated files are one error in Python, too.

    TestVoxelFiles.py [-D DATA_DIRECTORY] [-T SCRATCH_DIRECTORY]
"""
import argparse
import io
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersSources import vtkSuperquadricSource
from vtkvoxelization import (
    vtkBinvoxReader, vtkBinvoxWriter, vtkTetraCoveringVoxelizer, vtkVoxelBitsReader, vtkVoxelBitsWriter)

try:
    import trimesh
    from trimesh.exchange import binvox as trimesh_binvox
except ImportError:
    trimesh = None

SCRATCH = None
SPACING = 0.25
ORIGIN = (1.5, -2.0, 3.125)
SHAPES = ((5, 4, 3), (16, 16, 16), (1, 40, 7), (33, 2, 65))  # z, y, x


def random_voxels(shape, seed):
    """Runs of some length along z and y, so that there are some beyond 255."""
    coarse = np.random.default_rng(seed).random([n // 4 + 1 for n in shape]) < 0.4
    return np.kron(coarse, np.ones((4, 4, 4), bool))[tuple(slice(n) for n in shape)]


def to_image(voxels):
    image = vtkImageData()
    image.SetDimensions(*voxels.shape[::-1])
    image.SetSpacing(SPACING, SPACING, SPACING)
    image.SetOrigin(*ORIGIN)
    image.GetPointData().SetScalars(numpy_to_vtk(voxels.astype(np.uint8).ravel(), deep=True))
    return image


def to_voxels(image):
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions()[::-1]) != 0


def write(writer, data, path):
    writer.SetInputData(data)
    writer.SetFileName(str(path))
    assert writer.Write()
    return path.read_bytes()


def read(reader, path):
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def binvox_header(content):
    """The lines of the header as a dictionary, and the bytes behind it."""
    head, data = content.split(b"\ndata\n", 1)
    lines = head.decode().split("\n")
    assert lines[0] == "#binvox 1", lines[0]
    return {line.split()[0]: [float(x) for x in line.split()[1:]] for line in lines[1:]}, data


def binvox_voxels(content):
    """By the description of the format: x slowest, then z, then y."""
    header, data = binvox_header(content)
    nx, nz, ny = (int(n) for n in header["dim"])
    values, counts = np.frombuffer(data, np.uint8).reshape(-1, 2).T
    return np.repeat(values != 0, counts).reshape(nx, nz, ny).transpose(1, 2, 0)


def as_binvox(voxels, run=255):
    """With runs of so many voxels at most; the value of set voxels is any other than 0."""
    nz, ny, nx = voxels.shape
    out = io.BytesIO()
    out.write(f"#binvox 1\ndim {nx} {nz} {ny}\ntranslate 1 2 3\nscale 4.5\ndata\n".encode())
    flat = voxels.transpose(2, 0, 1).ravel()
    ends = np.flatnonzero(np.diff(flat, append=not flat[-1])) + 1
    for begin, end in zip(np.concatenate(([0], ends[:-1])), ends):
        for first in range(begin, end, run):
            out.write(bytes((7 if flat[begin] else 0, min(run, end - first))))
    return out.getvalue()


def bits_voxels(content):
    """As the class says in its documentation."""
    head, data = content.split(b"\ndata\n", 1)
    header = dict(line.split(" ", 1) for line in head.decode().split("\n"))
    nx, ny, nz = map(int, header["dim"].split())
    n = int(header["variants"])
    bits = np.frombuffer(data, np.uint8).reshape(n, -1)
    return header, np.unpackbits(bits, axis=1, count=nx * ny * nz).reshape(n, nz, ny, nx)


class FilesTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(dir=SCRATCH)
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def each(self):
        for seed, shape in enumerate(SHAPES):
            with self.subTest(seed=seed, shape=shape):
                yield random_voxels(shape, seed)


class TestBinvox(FilesTest):
    def test_written(self):
        for voxels in self.each():
            content = write(vtkBinvoxWriter(), to_image(voxels), self.folder / "a.binvox")
            header, _ = binvox_header(content)
            corner = np.array(ORIGIN) - SPACING / 2
            np.testing.assert_allclose(header["translate"], corner, rtol=1e-15)
            self.assertEqual(header["scale"], [SPACING * max(voxels.shape)])
            np.testing.assert_array_equal(binvox_voxels(content), voxels)

    def test_read(self):
        for voxels in self.each():
            for run in 255, 3:
                path = self.folder / "a.binvox"
                path.write_bytes(as_binvox(voxels, run))
                image = read(vtkBinvoxReader(), path)
                np.testing.assert_array_equal(to_voxels(image), voxels)
                size = 4.5 / max(voxels.shape)
                np.testing.assert_allclose(image.GetSpacing(), [size] * 3, rtol=1e-15)
                np.testing.assert_allclose(image.GetOrigin(), np.array((1, 2, 3)) + size / 2, rtol=1e-15)

    def test_truncated(self):
        content = as_binvox(random_voxels(SHAPES[1], 1))
        for length in 0, 5, content.index(b"data"), len(content) // 2, len(content) - 1:
            self.assert_one_error(vtkBinvoxReader(), content[:length])

    def assert_one_error(self, reader, content):
        path = self.folder / "bad"
        path.write_bytes(content)
        errors = []
        for source in reader, reader.GetExecutive():
            source.AddObserver("ErrorEvent", lambda caller, event: errors.append(caller))
        image = read(reader, path)
        self.assertEqual(errors.count(reader), 1)
        self.assertEqual(image.GetNumberOfPoints() * image.GetPointData().GetNumberOfArrays(), 0)

    @unittest.skipUnless(trimesh, "there is no trimesh")
    def test_trimesh_reads(self):
        for voxels in self.each():
            if len(set(voxels.shape)) > 1:
                continue  # trimesh wants cubes
            content = write(vtkBinvoxWriter(), to_image(voxels), self.folder / "a.binvox")
            grid = trimesh_binvox.load_binvox(io.BytesIO(content))
            np.testing.assert_array_equal(grid.matrix, voxels.transpose(2, 1, 0))
            np.testing.assert_allclose(grid.translation, np.array(ORIGIN) - SPACING / 2, rtol=1e-12)

    @unittest.skipUnless(trimesh, "there is no trimesh")
    def test_trimesh_writes(self):
        voxels = random_voxels((16, 16, 16), 5)
        grid = trimesh.voxel.VoxelGrid(voxels.transpose(2, 1, 0))
        for order in "xzy", "xyz":
            path = self.folder / "a.binvox"
            path.write_bytes(trimesh_binvox.export_binvox(grid, axis_order=order))
            found = to_voxels(read(vtkBinvoxReader(), path))
            # Its other order is not that of the format.
            expected = voxels if order == "xzy" else voxels.transpose(1, 0, 2)
            np.testing.assert_array_equal(found, expected)


class TestBits(FilesTest):
    def test_written(self):
        for voxels in self.each():
            writer = vtkVoxelBitsWriter()
            writer.SetLabel("chair")
            content = write(writer, to_image(voxels), self.folder / "a.bits")
            header, found = bits_voxels(content)
            np.testing.assert_array_equal(found, voxels[np.newaxis])
            self.assertEqual(header["label"], "chair")
            self.assertEqual([float(x) for x in header["origin"].split()], list(ORIGIN))

    def test_batch(self):
        source = vtkSuperquadricSource()
        source.ToroidalOn()
        voxelizer = vtkTetraCoveringVoxelizer()
        voxelizer.SetInputConnection(source.GetOutputPort())
        voxelizer.SetSampleDimensions(21, 21, 21)
        voxelizer.SetRotationModeToUniform()
        voxelizer.SafeScaleToFitOn()
        voxelizer.CheckWatertightOff()
        expected = vtkUnsignedCharArray()
        self.assertTrue(voxelizer.VoxelizeBatch(2, 3, expected))
        writer = vtkVoxelBitsWriter()
        writer.SetFileName(str(self.folder / "a.bits"))
        self.assertTrue(writer.WriteBatch(voxelizer, 2, 3))
        header, found = bits_voxels((self.folder / "a.bits").read_bytes())
        np.testing.assert_array_equal(found, vtk_to_numpy(expected).reshape(3, 21, 21, 21))
        self.assertEqual(header["first"], "2")
        self.assertGreater(found.sum(), 0)

    def test_read(self):
        for voxels in self.each():
            nz, ny, nx = voxels.shape
            stack = np.stack([voxels, ~voxels, np.roll(voxels, 1, 2)])
            bits = np.packbits(stack.reshape(3, -1), axis=1)
            path = self.folder / "a.bits"
            path.write_bytes(f"#voxelbits 1\ndim {nx} {ny} {nz}\nvariants 3\ndata\n".encode() + bits.tobytes())
            reader = vtkVoxelBitsReader()
            for variant in range(3):
                reader.SetVariant(variant)
                np.testing.assert_array_equal(to_voxels(read(reader, path)), stack[variant])
            array = vtkUnsignedCharArray()
            self.assertTrue(reader.ReadBatch(array))
            np.testing.assert_array_equal(vtk_to_numpy(array).reshape(stack.shape), stack)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("-T")
    SCRATCH = parser.parse_known_args()[0].T
    if SCRATCH:
        Path(SCRATCH).mkdir(parents=True, exist_ok=True)
    unittest.main(argv=sys.argv[:1])
