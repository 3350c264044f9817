"""Folders of labelled meshes, as data sets for training are laid out: FOLDER/CLASS/MESH.stl, .ply ...

Needs NumPy and VTK alone. Files are read by VTK, in a process of its own: what is damaged may end that
process, and is an error here.
"""
import os
import pickle
import signal
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
from vtkmodules import vtkIOGeometry
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdTypeArray, vtkOutputWindow, vtkPoints, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkIOLegacy import vtkPolyDataReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

__all__ = ["EXTENSIONS", "LabelledMesh", "MeshError", "MeshFolder", "ProgressBar", "read_mesh"]


def _stl_reader():
    reader = vtkIOGeometry.vtkSTLReader()
    # Voxelizers know that points with the same coordinates are one.
    reader.MergingOff()
    return reader


_READERS = {
    ".stl": _stl_reader,
    ".ply": vtkPLYReader,
    ".obj": vtkIOGeometry.vtkOBJReader,
    ".vtp": vtkXMLPolyDataReader,
    ".vtk": vtkPolyDataReader,
}
if hasattr(vtkIOGeometry, "vtkOFFReader"):
    _READERS[".off"] = vtkIOGeometry.vtkOFFReader

EXTENSIONS = tuple(_READERS)


class MeshError(ValueError):
    """A file that can't be read, or a mesh that can't be voxelized; the message names it."""


def _to_arrays(mesh):
    """Points, and polygons as VTK's legacy files have them: count, ids, count, ids ..."""
    polygons = vtkIdTypeArray()
    mesh.GetPolys().ExportLegacyFormat(polygons)
    points = mesh.GetPoints()
    return (vtk_to_numpy(points.GetData()) if points else np.empty((0, 3), np.float32),
            vtk_to_numpy(polygons))


def _from_arrays(arrays):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(arrays[0], deep=True))
    polygons = vtkCellArray()
    polygons.ImportLegacyFormat(numpy_to_vtkIdTypeArray(arrays[1], deep=True))
    mesh = vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(polygons)
    return mesh


def _check_length_of_stl(file):
    """VTK's reader takes what there is of a binary file."""
    length = os.path.getsize(file)
    with open(file, "rb") as stream:
        head = stream.read(84)
    if len(head) == 84 and head[:5].lower() != b"solid":
        triangles = int.from_bytes(head[80:], "little")
        if length < 84 + 50 * triangles:
            raise MeshError(f"it ends too early: {length} bytes can't hold {triangles} triangles")


def _fault(mesh):
    """What the voxelizer can't do with a mesh, or None."""
    if mesh.GetNumberOfPolys() == 0:
        return "it holds no polygons"
    if not np.isfinite(vtk_to_numpy(mesh.GetPoints().GetData())).all():
        return "it has points that are NaN or infinite"
    ids = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray())
    if ids.size == 0 or ids.min() < 0 or ids.max() >= mesh.GetNumberOfPoints():
        return "it has polygons that refer to points which do not exist"
    return None


def _usable(mesh):
    """The polygons of a mesh and no more, those of its strips too. A MeshError says what is wrong with them."""
    if mesh.GetNumberOfStrips():
        triangles = vtkTriangleFilter()
        triangles.SetInputData(mesh)
        triangles.Update()
        mesh = triangles.GetOutput()
    reason = _fault(mesh)
    if reason:
        raise MeshError(reason)
    polygons = vtkPolyData()
    polygons.SetPoints(mesh.GetPoints())
    polygons.SetPolys(mesh.GetPolys())
    return polygons


def _read_here(file):
    """The mesh, or a MeshError. VTK's readers do not survive everything."""
    suffix = Path(file).suffix.lower()
    if suffix == ".stl":
        _check_length_of_stl(file)
    reader = _READERS[suffix]()
    reader.SetFileName(file)
    output = vtkStringOutputWindow()
    before = vtkOutputWindow.GetInstance()
    vtkOutputWindow.SetInstance(output)
    try:
        reader.Update()
    finally:
        vtkOutputWindow.SetInstance(before)
    # Readers only warn where a file ends too early.
    messages = [line.split("): ", 1)[-1] for line in output.GetOutput().splitlines()
                if line and not line.startswith(("ERROR: In", "Warning: In"))]
    if messages:
        raise MeshError(messages[0].rstrip("."))
    return _usable(reader.GetOutput())


def _serve():
    """Reads the files that standard input names, and writes what they hold to standard output."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    questions = sys.stdin.buffer
    while True:
        try:
            file = pickle.load(questions)
        except EOFError:
            return
        try:
            answer = _to_arrays(_read_here(file))
        except Exception as error:  # Whatever it is: it is the file's.
            answer = str(error) or type(error).__name__
        pickle.dump(answer, answers, protocol=pickle.HIGHEST_PROTOCOL)
        answers.flush()


class _Reader:
    """The process that reads; it begins with the first file, and anew after one that ended it."""

    def __init__(self):
        self._process = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._end()

    def _end(self):
        process, self._process = self._process, None
        if process is None:
            return None
        for pipe in process.stdin, process.stdout:
            try:
                pipe.close()
            except BrokenPipeError:
                pass
        return process.wait()

    def read(self, file):
        if self._process is None:
            program = "import sys; sys.path[:] = eval(sys.argv[1]); " \
                      "from vtkvoxelization.meshes import _serve; _serve()"
            self._process = subprocess.Popen(
                [sys.executable, "-c", program, repr(sys.path)],
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        try:
            pickle.dump(str(file), self._process.stdin)
            self._process.stdin.flush()
            answer = pickle.load(self._process.stdout)
        except (EOFError, BrokenPipeError, pickle.UnpicklingError):
            code = self._end()
            how = f"by {signal.Signals(-code).name}" if code < 0 else f"with code {code}"
            raise MeshError(f"{file}: it is damaged, and ended VTK's reader {how}") from None
        if isinstance(answer, str):
            raise MeshError(f"{file}: {answer}")
        return _from_arrays(answer)


def _check_file(file):
    path = Path(file)
    if path.suffix.lower() not in _READERS:
        raise MeshError(f"{path}: meshes of type {path.suffix or 'none'} are not known; known are "
                        + ", ".join(EXTENSIONS))
    if not path.is_file():
        raise MeshError(f"{path}: there is no such file")
    if not os.access(path, os.R_OK):
        raise MeshError(f"{path}: it can't be read, its permissions forbid it")
    return path


def read_mesh(file):
    """The polygons of a file as vtkPolyData. Raises MeshError, which names the file and what is wrong."""
    path = _check_file(file)
    with _Reader() as reader:
        return reader.read(path)


class ProgressBar:
    """Says on the standard error how far a long work is; what it is called with: done, total, name."""

    WIDTH = 30

    def __call__(self, done, total, name):
        filled = self.WIDTH * done // max(total, 1)
        end = "\n" if done == total else ""
        print(f"\r[{'#' * filled:<{self.WIDTH}}] {done}/{total} {name[-40:]:<40}", end=end, file=sys.stderr,
              flush=True)


class LabelledMesh:
    """A mesh (vtkPolyData) with its label, a whole number, and a name for messages. Can be pickled."""

    def __init__(self, mesh, label, name):
        if not isinstance(mesh, vtkPolyData):
            raise TypeError(f"{name} is a {type(mesh).__name__}; give a vtkPolyData")
        try:
            self.mesh = _usable(mesh)
        except MeshError as error:
            raise MeshError(f"{name}: {error}") from None
        self.label = int(label)
        self.name = str(name)

    def __getstate__(self):
        return _to_arrays(self.mesh), self.label, self.name

    def __setstate__(self, state):
        self.mesh = _from_arrays(state[0])
        self.label, self.name = state[1:]

    def __iter__(self):
        return iter((self.mesh, self.label))


class MeshFolder:
    """The meshes of FOLDER/CLASS/MESH.stl (.ply, .obj, .vtp, .vtk, and .off where VTK reads it).

    Classes are numbered in the order of their names; hidden files, and those of other types, are left out.

    root            the folder
    subset          read FOLDER/CLASS/SUBSET/MESH.stl instead, as in "train" and "test" of ModelNet
    on_unreadable   "warn": a file that can't be read is left out, with a warning that names it, and listed
                    in skipped; "error": it is a MeshError
    progress        True for a bar on the standard error, or what is called with done, total, name
    """

    def __init__(self, root, *, subset=None, on_unreadable="warn", progress=None):
        if on_unreadable not in ("warn", "error"):
            raise ValueError(f"on_unreadable is {on_unreadable!r}; it must be 'warn' or 'error'")
        self.root = Path(root)
        if not self.root.is_dir():
            raise MeshError(f"{self.root}: there is no such folder")
        folders = sorted(entry for entry in self.root.iterdir() if entry.is_dir() and entry.name[0] != ".")
        if not folders:
            raise MeshError(f"{self.root}: it has no folders; meshes are looked for in FOLDER/CLASS/MESH.stl")
        self.classes = [folder.name for folder in folders]
        self.skipped = []
        self._meshes = []
        files = [(file, label) for label, folder in enumerate(folders) for file in self._files(folder, subset)]
        self._read(files, on_unreadable, ProgressBar() if progress is True else progress)
        if not self._meshes:
            raise MeshError(f"{self.root}: none of its {len(files)} meshes can be read")

    @staticmethod
    def _files(folder, subset):
        folder = folder / subset if subset else folder
        files = sorted(file for file in folder.iterdir() if file.name[0] != "."
                       and file.suffix.lower() in _READERS) if folder.is_dir() else []
        if not files:
            raise MeshError(f"{folder}: there are no meshes; known are " + ", ".join(EXTENSIONS))
        return files

    def _read(self, files, on_unreadable, progress):
        with _Reader() as reader:
            for done, (file, label) in enumerate(files):
                if progress:
                    progress(done, len(files), str(file))
                try:
                    mesh = reader.read(_check_file(file))
                    self._meshes.append(LabelledMesh(mesh, label, file))
                except MeshError as error:
                    if on_unreadable == "error":
                        raise
                    self.skipped.append(file)
                    warnings.warn(f"left out {error}", stacklevel=4)
        if progress:
            progress(len(files), len(files), str(self.root))

    def __len__(self):
        return len(self._meshes)

    def __getitem__(self, i):
        """A LabelledMesh."""
        return self._meshes[i]
