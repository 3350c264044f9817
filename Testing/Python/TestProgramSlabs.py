"""Proves that vtkvoxelize --memory-limit makes the very files that it makes without, and says clearly what can't
be made in slabs; and that no way to die leaves half a file: killed at random moments, and on a disk that is full,
the target is absent, or whole, the former one or the new one.

    TestProgramSlabs.py --program vtkvoxelize -D DATA_DIRECTORY [-T SCRATCH_DIRECTORY]
"""
import os
import random
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np
import TestProgram
from TestProgram import OUTPUT, USAGE, VOXELIZATION
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLImageDataReader
import vtkvoxelization
from vtkvoxelization import vtkBinvoxReader, vtkSlicemapSolidVoxelizer, vtkVoxelBitsReader, vtkVoxelSlabWriter

KILLS = 20
FORMATS = [".vti", ".binvox", ".bits"] + ([".vdb"] if hasattr(vtkvoxelization, "vtkVDBVoxelReader") else [])
READERS = {".vti": vtkXMLImageDataReader, ".binvox": vtkBinvoxReader, ".bits": vtkVoxelBitsReader,
           ".vdb": getattr(vtkvoxelization, "vtkVDBVoxelReader", None)}


def read(name):
    reader = READERS[Path(name).suffix]()
    reader.SetFileName(str(name))
    reader.Update()
    image = reader.GetOutput()
    scalars = image.GetPointData().GetScalars() or image.GetCellData().GetScalars()
    return image, vtk_to_numpy(scalars) if scalars.GetDataTypeAsString() != "bit" else scalars


def content(name):
    """All but the identifier that each .vdb file has of its own."""
    data = name.read_bytes()
    return data[:21] + data[57:] if name.suffix == ".vdb" else data


class ProgramSlabs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(dir=TestProgram.SCRATCH)
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_program(self, *words, before=()):
        return subprocess.run([*before, TestProgram.PROGRAM, *map(str, words)], cwd=self.folder, capture_output=True,
                              text=True, errors="replace")

    def check_same(self, one, other):
        (found, voxels), (expected, expected_voxels) = read(self.folder / one), read(self.folder / other)
        self.assertEqual(found.GetExtent(), expected.GetExtent())
        self.assertEqual(found.GetSpacing(), expected.GetSpacing())
        self.assertEqual(found.GetOrigin(), expected.GetOrigin())
        self.assertTrue(np.array_equal(voxels, expected_voxels))

    def test_same_as_whole(self):
        for extension in FORMATS:
            for words in (["--resolution", 150], ["--resolution", 150, "--method", "surface"],
                          ["--resolution", 60, "--dilate", 2]):
                whole = self.run_program(*words, TestProgram.BUNNY, "whole" + extension)
                self.assertEqual((whole.returncode, whole.stderr), (0, ""))
                slabs = self.run_program(*words, "--memory-limit", "5M", TestProgram.BUNNY, "slabs" + extension)
                self.assertEqual((slabs.returncode, slabs.stderr), (0, ""))
                self.check_same("slabs" + extension, "whole" + extension)

    def test_output_options(self):
        for words in ["--value", 9], ["--cells"], ["--cells", "--value", 3]:
            for limit in [], ["--memory-limit", "5M"]:
                run = self.run_program("--resolution", 70, *words, *limit, TestProgram.BUNNY,
                                       "slabs.vti" if limit else "whole.vti")
                self.assertEqual((run.returncode, run.stderr), (0, ""))
            self.check_same("slabs.vti", "whole.vti")
        run = self.run_program("--type", "bit", "--memory-limit", "5M", TestProgram.BUNNY, "bits.vti")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        image, voxels = read(self.folder / "bits.vti")
        self.assertEqual(voxels.GetDataTypeAsString(), "bit")

    def test_info(self):
        lines = []
        for limit in [], ["--memory-limit", "5M"]:
            run = self.run_program("--info", *limit, TestProgram.BUNNY, "out.binvox")
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            lines.append([line for line in run.stdout.splitlines()
                          if line.startswith(("filled", "voxels", "spacing", "origin", "triangles"))])
        self.assertEqual(lines[0], lines[1])

    def test_refusals(self):
        (self.folder / "old.vti").write_text("as it was")
        for code, words in (
                (USAGE, ["--memory-limit", "much", TestProgram.BUNNY, "old.vti"]),
                (USAGE, ["--memory-limit", "0", TestProgram.BUNNY, "old.vti"]),
                (USAGE, ["--memory-limit", "-1G", TestProgram.BUNNY, "old.vti"]),
                (USAGE, ["--memory-limit", "1M", TestProgram.BUNNY, "out.mha"]),
                (USAGE, ["--memory-limit", "1M", "--method", "surface", TestProgram.BUNNY, "out.vtp"]),
                (USAGE, ["--memory-limit", "1M", "--picture", "a.png", TestProgram.BUNNY, "old.vti"]),
                (VOXELIZATION, ["--memory-limit", "1K", TestProgram.BUNNY, "old.vti"]),
                (VOXELIZATION, ["--memory-limit", "100K", "--dilate", 1, TestProgram.BUNNY, "old.vti"])):
            run = self.run_program(*words)
            self.assertEqual(run.returncode, code, words)
            self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
            self.assertEqual(os.listdir(self.folder), ["old.vti"])
            self.assertEqual((self.folder / "old.vti").read_text(), "as it was")

    def test_killed(self):
        """Half of the kills come at any moment, half while the file is being written."""
        chance = random.Random(8)
        for extension in FORMATS:
            for limit in [], ["--memory-limit", "6M"]:
                words = ["--resolution", 220, *limit, TestProgram.BUNNY]
                start = time.monotonic()
                run = self.run_program(*words, "new" + extension)
                duration = time.monotonic() - start
                self.assertEqual((run.returncode, run.stderr), (0, ""))
                new = content(self.folder / ("new" + extension))
                killed = 0
                for i in range(KILLS // 2):
                    folder = Path(tempfile.mkdtemp(dir=self.folder))
                    target = folder / ("out" + extension)
                    has_former = i % 4 < 2
                    if has_former:
                        target.write_text("as it was")
                    command = [TestProgram.PROGRAM, *map(str, words), target]
                    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                    if i % 2:
                        while process.poll() is None and not any(
                                path != target and path.stat().st_size > 0 for path in folder.iterdir()
                                if path.exists()):
                            time.sleep(0.0005)
                        time.sleep(chance.uniform(0, 0.1 * duration))
                    else:
                        time.sleep(chance.uniform(0, duration))
                    process.send_signal(signal.SIGKILL)
                    killed += process.wait() == -signal.SIGKILL
                    if target.exists():
                        found = content(target)
                        self.assertTrue(found == new or (has_former and found == b"as it was"),
                                        f"{extension} {limit}, kill {i}")
                    else:
                        self.assertFalse(has_former, f"{extension} {limit}, kill {i}")
                    shutil.rmtree(folder)
                self.assertGreater(killed, 0)

    def test_full_disk(self):
        """A file system in memory, which goes with the process that sees it."""
        unshare = next((words for words in (["unshare", "-m"], ["unshare", "-r", "-m"])
                        if shutil.which("unshare") and subprocess.run(
                            [*words, "sh", "-c", f"mount -t tmpfs -o size=64k tmpfs '{self.folder}'"],
                            capture_output=True).returncode == 0), None)
        if not unshare:
            self.skipTest("file systems can't be mounted here")
        script = ("mount -t tmpfs -o size=64k tmpfs \"$PWD\" && cd \"$PWD\" && printf 'as it was' >out$1 && shift && "
                  "\"$@\"; code=$?; cat out*; ls -A | wc -l; exit $code")
        for extension in FORMATS:
            # Runs of .binvox and blocks of .vti pack well.
            for limit in [], ["--memory-limit", "16M"]:
                words = ["--resolution", 400, *limit, TestProgram.BUNNY, "out" + extension]
                run = self.run_program(*words, before=[*unshare, "sh", "-c", script, "sh", extension])
                self.assertEqual((run.returncode, run.stdout), (OUTPUT, "as it was1\n"), run.stderr)
                self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
                self.assertIn("No space left on device", run.stderr)

    def test_python(self):
        """The class behind it."""
        voxelizer = vtkSlicemapSolidVoxelizer()
        reader = vtkPLYReader()
        reader.SetFileName(str(TestProgram.BUNNY))
        voxelizer.SetInputConnection(reader.GetOutputPort())
        voxelizer.SetResolution(100)
        voxelizer.HostOutputOff()
        writer = vtkVoxelSlabWriter()
        writer.SetInputConnection(voxelizer.GetOutputPort())
        writer.SetFileName(str(self.folder / "slabs.vti"))
        writer.SetMaximumSlices(30)
        fractions = []
        writer.AddObserver("ProgressEvent", lambda *_: fractions.append(writer.GetProgress()))
        self.assertEqual(writer.Write(), 1)
        self.assertTrue(all(b >= a - 1e-9 for a, b in zip(fractions, fractions[1:])), fractions)
        self.assertGreater(writer.GetNumberOfSlabs(), 2)
        voxelizer.HostOutputOn()
        voxelizer.Update()
        voxels = vtk_to_numpy(voxelizer.GetOutput().GetPointData().GetScalars())
        self.assertEqual(writer.GetNumberOfFilledVoxels(), voxels.sum())
        self.assertTrue(np.array_equal(read(self.folder / "slabs.vti")[1], voxels))
        self.assertIn("MemoryLimit", str(writer))


if __name__ == "__main__":
    TestProgram.main()
