"""Proves that vtkvoxelize survives damaged files: none ends it by a signal or keeps it busy.

Good files of all formats are damaged at random, in their bytes and in their numbers. Each result is
voxels or one line that says what is wrong, with the exit code for bad input and no file left behind.
The seed of a failure is in its name, the damaged file is kept.

    TestDamagedFiles.py --program vtkvoxelize -D DATA_DIRECTORY [-T SCRATCH_DIRECTORY]
"""

import math
import os
import random
import re
import shutil
import tempfile
import zlib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from vtkmodules.vtkIOImage import vtkJPEGWriter, vtkNIFTIImageWriter, vtkPNGReader
from vtkmodules.vtkIOLegacy import vtkPolyDataWriter
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPolyDataWriter

import TestProgram
from TestProgram import INPUT, VOXELIZATION, box, polydata

WORDS = [b"-1", b"0", b"1", b"7", b"255", b"65536", b"2147483647", b"-2147483648", b"4294967295",
         b"99999999999999999999", b"1e9", b"1e400", b"nan", b'"x"', b"{}", b"[]", b"null"]
INTEGERS = [b"\0\0\0\0", b"\1\0\0\0", b"\xff\xff\xff\xff", b"\xff\xff\xff\x7f", b"\0\0\0\x80"]


def damage(rng, content):
    """Replaces, removes, repeats and inserts bytes, numbers in text and in binary."""
    data = bytearray(content)
    for _ in range(rng.choice([1, 1, 1, 2, 3, 8])):
        i = rng.randrange(len(data))
        kind = rng.randrange(7)
        if kind == 0:
            data[i] = rng.randrange(256)
        elif kind == 1:
            data[i] ^= 1 << rng.randrange(8)
        elif kind == 2:
            del data[i:min(i + rng.choice([1, 2, 4, 20, 200]), len(data) - 1)]
        elif kind == 3:
            data[i:i] = rng.randbytes(rng.choice([1, 2, 4]))
        elif kind == 4:
            j = rng.randrange(len(data))
            data[i:i] = data[j:j + rng.choice([1, 4, 16, 64])]
        elif kind == 5:
            data[i:i + 4] = rng.choice(INTEGERS)
        else:
            numbers = list(re.finditer(rb"-?\d+", bytes(data)))
            if numbers:
                start, end = rng.choice(numbers).span()
                data[start:end] = rng.choice(WORDS)
    return bytes(data)


def with_right_sums(content):
    """A damaged PNG file whose chunks have the sums that belong to their bytes."""
    data, position = bytearray(content), 8
    while position + 12 <= len(data):
        size = int.from_bytes(data[position:position + 4], "big")
        end = position + 8 + size
        if end + 4 > len(data):
            break
        data[end:end + 4] = zlib.crc32(data[position + 4:end]).to_bytes(4, "big")
        position = end + 4
    return bytes(data)


class TestDamagedFiles(TestProgram.ProgramTest):
    def survive(self, name, content, count, words=("{}",), mend=lambda damaged: damaged):
        """The words of the command line have the name of the damaged file in the place of {}."""
        def run(seed):
            damaged = mend(damage(random.Random(f"{seed} {name}"), content))
            return self.run_one(f"{seed}-{name}", damaged, seed, words)

        with ThreadPoolExecutor(os.cpu_count()) as pool:
            for seed, done in pool.map(run, range(count)):
                with self.subTest(seed=seed, name=name):
                    self.check(f"{seed}-{name}", done)

    def run_one(self, name, content, seed, words):
        file = self.file(name, content).name
        return seed, self.call("--quiet", "--resolution", 4, *(word.format(file) for word in words),
                               file + ".vti", errors="replace")

    def check(self, name, done):
        try:
            self.assertEqual(done.stdout, "")
            if done.returncode == 0:
                self.assertEqual(done.stderr, "")
                self.assertIn(name + ".vti", self.names())
                return
            self.assertIn(done.returncode, (INPUT, VOXELIZATION))
            self.assertRegex(done.stderr, r"^vtkvoxelize: error: [^\n]+\n$")
            self.assertNotIn(name + ".vti", self.names())
        except AssertionError:
            shutil.copy(self.folder / name, Path(TestProgram.SCRATCH or tempfile.gettempdir()) / name)
            raise

    def of_writer(self, writer, name, data=None):
        TestProgram.written(writer, data or polydata(*box()), self.folder / "made")
        return name, (self.folder / "made").read_bytes()

    def test_gltf(self):
        self.survive("box.gltf", TestProgram.gltf(), 80)

    def test_glb(self):
        self.survive("box.glb", TestProgram.glb(), 80)

    def test_stl(self):
        self.survive("text.stl", TestProgram.stl_text(*box()), 20)
        self.survive("binary.stl", TestProgram.stl_binary(*box()), 20)

    def test_ply(self):
        self.survive("text.ply", TestProgram.ply_text(*box()), 40)
        self.survive("binary.ply", TestProgram.ply_binary(*box()), 20)

    def test_obj(self):
        self.survive("box.obj", TestProgram.obj(*box()), 20)

    def test_vtp(self):
        text = vtkXMLPolyDataWriter()
        text.SetDataModeToAscii()
        self.survive(*self.of_writer(text, "text.vtp"), 20)
        plain = vtkXMLPolyDataWriter()
        plain.SetCompressorTypeToNone()
        self.survive(*self.of_writer(plain, "plain.vtp"), 20)

    def test_vtk(self):
        for version in 42, 51:
            for kind in "ASCII", "Binary":
                writer = vtkPolyDataWriter()
                writer.SetFileVersion(version)
                getattr(writer, "SetFileTypeTo" + kind)()
                self.survive(*self.of_writer(writer, f"{kind}{version}.vtk"), 20)

    def test_arrays(self):
        data = TestProgram.polydata_with_arrays()
        words = ["--method", "surface", "--attributes", "Position,Height,Side", "{}"]
        text = vtkXMLPolyDataWriter()
        text.SetDataModeToAscii()
        self.survive(*self.of_writer(text, "arrays.vtp", data), 20, words)
        for kind in "ASCII", "Binary":
            writer = vtkPolyDataWriter()
            getattr(writer, "SetFileTypeTo" + kind)()
            self.survive(*self.of_writer(writer, f"arrays{kind}.vtk", data), 20, words)

    def test_textures(self):
        self.file("wall.obj", TestProgram.textured_obj())
        words = ["--method", "surface", "--texture", "{}", "wall.obj"]
        self.survive("checks.png", TestProgram.checks(), 10, words)
        self.survive("sums.png", TestProgram.checks(), 60, words, with_right_sums)
        palette = TestProgram.png_chunk(b"PLTE", bytes(range(30)))
        rows = [bytes(random.Random(1).randrange(10) for _ in range(16))] * 16
        self.survive("palette.png", TestProgram.png(rows, color=3, rest=palette), 20, words)
        self.file("good.png", TestProgram.checks())
        reader = vtkPNGReader()
        reader.SetFileName(str(self.folder / "good.png"))
        writer = vtkJPEGWriter()
        writer.SetInputConnection(reader.GetOutputPort())
        writer.SetFileName(str(self.folder / "good.jpg"))
        writer.Write()
        self.survive("checks.jpg", (self.folder / "good.jpg").read_bytes(), 40, words)

    def test_masks(self):
        mesh = self.mesh().name
        for name in "mask.vti", "mask.mha", "mask.binvox":
            self.succeed("--resolution", 4, mesh, name)
        reader = vtkXMLImageDataReader()
        reader.SetFileName(str(self.folder / "mask.vti"))
        reader.Update()
        image = reader.GetOutput()
        written_by_vtk = vtkNIFTIImageWriter()
        for name in "mask.nii", "mask.nii.gz":
            written_by_vtk.SetFileName(str(self.folder / name))
            written_by_vtk.SetInputData(image)
            written_by_vtk.Write()
        sizes, spacing, origin = image.GetDimensions(), image.GetSpacing(), image.GetOrigin()
        self.file("mask.nrrd", (
            "NRRD0004\ntype: uchar\ndimension: 3\nspace dimension: 3\nsizes: %d %d %d\n" % sizes
            + "space directions: (%r,0,0) (0,%r,0) (0,0,%r)\nencoding: raw\n" % spacing
            + "space origin: (%r,%r,%r)\n\n" % origin).encode() + bytes(math.prod(sizes)))
        for name in "mask.vti", "mask.mha", "mask.binvox", "mask.nii", "mask.nii.gz", "mask.nrrd":
            self.survive(name, (self.folder / name).read_bytes(), 40, [mesh, "--unite", "{}"])


if __name__ == "__main__":
    TestProgram.main()
