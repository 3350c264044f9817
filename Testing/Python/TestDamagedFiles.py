"""Proves that vtkvoxelize survives damaged files: none ends it by a signal or keeps it busy.

Good files of all formats are damaged at random, in their bytes and in their numbers. Each result is
voxels or one line that says what is wrong, with the exit code for bad input and no file left behind.
The seed of a failure is in its name, the damaged file is kept.

    TestDamagedFiles.py --program vtkvoxelize -D DATA_DIRECTORY [-T SCRATCH_DIRECTORY]
"""

import os
import random
import re
import shutil
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from vtkmodules.vtkIOLegacy import vtkPolyDataWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

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


class TestDamagedFiles(TestProgram.ProgramTest):
    def survive(self, name, content, count):
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            for seed, done in pool.map(lambda seed: self.run_one(name, content, seed), range(count)):
                with self.subTest(seed=seed, name=name):
                    self.check(f"{seed}-{name}", done)

    def run_one(self, name, content, seed):
        mesh = self.file(f"{seed}-{name}", damage(random.Random(f"{seed} {name}"), content))
        return seed, self.call("--quiet", "--resolution", 4, mesh.name, mesh.name + ".vti",
                               errors="replace")

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

    def of_writer(self, writer, name):
        TestProgram.written(writer, polydata(*box()), self.folder / "made")
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


if __name__ == "__main__":
    TestProgram.main()
