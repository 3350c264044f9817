"""Proves that where there is no OpenGL, neither a driver for EGL nor EGL itself, and no display, the program
and the filter say once what to install, and fail without a crash or an output.

    TestNoOpenGL.py --program vtkvoxelize -D DATA_DIRECTORY [-T SCRATCH_DIRECTORY]
"""

import os
import subprocess
import sys

import TestProgram
from TestProgram import VOXELIZATION

# Fails itself unless the filter fails with one error that tells what to install.
FILTER = """
from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkFiltersSources import vtkCubeSource
from vtkvoxelization import vtkSlicemapSolidVoxelizer

# The pipeline has an error of its own to add.
vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
vtkOutputWindow.SetInstance(vtkStringOutputWindow())
messages = []
cube = vtkCubeSource()
voxelizer = vtkSlicemapSolidVoxelizer()
voxelizer.SetInputConnection(cube.GetOutputPort())
voxelizer.SetResolution(8)


def keep(_, __, message):
    messages.append(message)


keep.CallDataType = "string0"
voxelizer.AddObserver("ErrorEvent", keep)
assert not voxelizer.GetExecutive().Update()
assert len(messages) == 1 and "libegl1" in messages[0], messages
assert voxelizer.GetOutput().GetNumberOfPoints() == 0
"""


class TestNoOpenGL(TestProgram.ProgramTest):
    def refuse(self, **more):
        environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"} | more
        if self.call("--version", env=environment).returncode:
            self.skipTest("VTK does not even load without EGL")
        mesh = self.mesh()
        for options in [], ["--quiet"], ["--picture", "out.png"], ["--backend", "raster"]:
            with self.subTest(options):
                self.complain(VOXELIZATION, *options, mesh, "out.vti", naming=["libegl1"], env=environment)
                self.assertFalse({"out.vti", "out.png"} & set(self.names()))
        done = subprocess.run([sys.executable, "-c", FILTER], env=environment, capture_output=True,
                              text=True, timeout=300, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_no_driver(self):
        self.refuse(__EGL_VENDOR_LIBRARY_FILENAMES="/nonexistent")

    def test_no_library(self):
        folder = self.folder / "libraries"
        folder.mkdir()
        (folder / "libEGL.so.1").write_bytes(b"")
        path = os.pathsep.join(filter(None, [str(folder), os.environ.get("LD_LIBRARY_PATH")]))
        self.refuse(LD_LIBRARY_PATH=path)


if __name__ == "__main__":
    TestProgram.main()
