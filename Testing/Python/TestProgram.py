"""Proves what vtkvoxelize promises, by running it.

Voxels: boxes of every format that it reads come out with the very voxels whose centres they hold, in
every format that it writes; grids, modes, fill rules, backends and reference images do what the help
says. Surfaces: arrays and textures of every format arrive at the voxels that they belong to, in every
format that holds attributes. Manners: one line on the standard error for each bad command line, bad input or failing output,
the documented exit code, no file left behind, and none touched that was there before.

    TestProgram.py --program vtkvoxelize -D DATA_DIRECTORY [-T SCRATCH_DIRECTORY]
"""

import argparse
import base64
import itertools
import json
import math
import os
import pty
import resource
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib
from pathlib import Path

from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR, vtkFloatArray, vtkPoints, vtkStringArray, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray, vtkHyperTreeGridNonOrientedGeometryCursor, vtkImageData, vtkPolyData)
from vtkmodules.vtkIOImage import vtkJPEGWriter, vtkMetaImageReader, vtkPNGReader
from vtkmodules.vtkIOLegacy import vtkPolyDataWriter, vtkStructuredPointsWriter
from vtkmodules.vtkIOXML import (
    vtkXMLHyperTreeGridReader, vtkXMLImageDataReader, vtkXMLImageDataWriter, vtkXMLPolyDataReader,
    vtkXMLPolyDataWriter)

USAGE, INPUT, VOXELIZATION, OUTPUT = 1, 2, 3, 4

PROGRAM = None
BUNNY = None
SCRATCH = None

# A box whose faces lie between voxel centres of grids with voxels of size 0.5.
LOW, HIGH = (1.0, 2.0, 3.0), (3.0, 5.0, 7.0)
BOX_VOXELS = 4 * 6 * 8
BOX_VOLUME = 24.0


def box(low=LOW, high=HIGH):
    """Points and outward triangles of a box."""
    points = list(itertools.product(*zip(low, high)))
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return points, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def joined(*meshes):
    points, triangles = [], []
    for more_points, more_triangles in meshes:
        triangles += [tuple(i + len(points) for i in t) for t in more_triangles]
        points += more_points
    return points, triangles


def open_box():
    """A box without its side of greatest x."""
    points, triangles = box()
    return points, [t for t in triangles if not all(points[i][0] == HIGH[0] for i in t)]


def polydata(points, triangles, lines=()):
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    for point in points:
        data.GetPoints().InsertNextPoint(point)
    for cells, set_cells in ((triangles, data.SetPolys), (lines, data.SetLines)):
        array = vtkCellArray()
        for cell in cells:
            array.InsertNextCell(len(cell))
            for i in cell:
                array.InsertCellPoint(i)
        set_cells(array)
    return data


def written(writer, data, path):
    writer.SetInputData(data)
    writer.SetFileName(str(path))
    assert writer.Write()


# Writers of meshes, by name of the file that they make. --------------------------------------------


def stl_text(points, triangles):
    text = "solid box\n"
    for triangle in triangles:
        text += " facet normal 0 0 0\n  outer loop\n"
        text += "".join("   vertex %g %g %g\n" % points[i] for i in triangle)
        text += "  endloop\n endfacet\n"
    return (text + "endsolid box\n").encode()


def stl_binary(points, triangles):
    facets = [struct.pack("<12fH", 0, 0, 0, *(x for i in t for x in points[i]), 0) for t in triangles]
    return bytes(80) + struct.pack("<I", len(triangles)) + b"".join(facets)


def ply_head(points, triangles, encoding, list_name="vertex_indices"):
    return (
        f"ply\nformat {encoding} 1.0\ncomment a box\nelement vertex {len(points)}\n"
        "property float x\nproperty float y\nproperty float z\n"
        f"element face {len(triangles)}\nproperty list uchar int {list_name}\nend_header\n"
    ).encode()


def ply_text(points, triangles, list_name="vertex_indices"):
    lines = ["%g %g %g" % p for p in points] + ["3 %d %d %d" % t for t in triangles]
    return ply_head(points, triangles, "ascii", list_name) + ("\n".join(lines) + "\n").encode()


def ply_binary(points, triangles, order="<"):
    encoding = "binary_little_endian" if order == "<" else "binary_big_endian"
    body = [struct.pack(order + "3f", *p) for p in points]
    body += [struct.pack(order + "B3i", 3, *t) for t in triangles]
    return ply_head(points, triangles, encoding) + b"".join(body)


def obj(points, triangles):
    lines = ["v %g %g %g" % p for p in points]
    return ("\n".join(lines + ["f %d %d %d" % tuple(i + 1 for i in t) for t in triangles]) + "\n").encode()


def gltf_parts():
    """The unit cube, which the matrices of two nodes move to the place of the box."""
    points, triangles = box((0, 0, 0), (1, 1, 1))
    data = b"".join(struct.pack("<3f", *p) for p in points)
    indices = b"".join(struct.pack("<3H", *t) for t in triangles)
    size = [h - l for l, h in zip(LOW, HIGH)]
    scene = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [
            {"translation": [LOW[0], LOW[1], LOW[2]], "children": [1]},
            {"scale": size, "mesh": 0},
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": len(data) + len(indices)}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": len(data), "target": 34962},
            {"buffer": 0, "byteOffset": len(data), "byteLength": len(indices), "target": 34963},
        ],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3",
             "min": [0, 0, 0], "max": [1, 1, 1]},
            {"bufferView": 1, "componentType": 5123, "count": 3 * len(triangles), "type": "SCALAR"},
        ],
    }
    return scene, data + indices


def gltf(parts=None):
    scene, data = parts or gltf_parts()
    scene["buffers"][0]["uri"] = (
        "data:application/octet-stream;base64," + base64.b64encode(data).decode())
    return json.dumps(scene).encode()


def glb(parts=None):
    scene, data = parts or gltf_parts()
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    data += bytes(-len(data) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
    chunks += struct.pack("<II", len(data), 0x004E4942) + data
    return struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks


# Meshes with attributes ----------------------------------------------------------------------------


def named(array, name, tuples):
    array.SetName(name)
    array.SetNumberOfComponents(len(tuples[0]))
    for t in tuples:
        array.InsertNextTuple(t)
    return array


def polydata_with_arrays():
    """A box whose points have x, y, z, as "Position", and whose cells the number of their side."""
    points, triangles = box()
    data = polydata(points, triangles)
    data.GetPointData().AddArray(named(vtkFloatArray(), "Position", points))
    data.GetPointData().AddArray(named(vtkFloatArray(), "Height", [(p[2],) for p in points]))
    data.GetCellData().AddArray(
        named(vtkFloatArray(), "Side", [(i // 2,) for i in range(len(triangles))]))
    return data


def ply_with_colors():
    """The box with red points where x is least, and green ones where it is greatest."""
    points, triangles = box()
    text = ply_text(points, triangles).decode()
    text = text.replace("property float z\n", "property float z\n" + "".join(
        f"property uchar {channel}\n" for channel in ("red", "green", "blue")))
    for p in points:
        color = "255 0 0" if p[0] == LOW[0] else "0 255 0"
        text = text.replace("\n%g %g %g\n" % p, "\n%g %g %g %s\n" % (*p, color))
    return text.encode()


RED, GREEN, BLUE, WHITE = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)
SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]


def png_chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def png(rows, depth=8, color=2, rest=b""):
    """Rows from the top one down, of bytes."""
    width = len(rows[0]) * 8 // depth // (3 if color == 2 else 1)
    head = struct.pack(">2I5B", width, len(rows), depth, color, 0, 0, 0)
    pixels = zlib.compress(b"".join(b"\0" + row for row in rows))
    return (b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", head) + rest + png_chunk(b"IDAT", pixels)
            + png_chunk(b"IEND", b""))


def checks(size=16):
    """A picture of four fields: red and green below, blue and white above."""
    half = size // 2
    rows = [bytes(BLUE) * half + bytes(WHITE) * half] * half
    return png(rows + [bytes(RED) * half + bytes(GREEN) * half] * half)


def wall(z=0.25):
    """A square of side 8 in the x-y plane."""
    return [(8 * u, 8 * v, z) for u, v in SQUARE], [(0, 1, 2), (0, 2, 3)]


def color_of_wall(x, y):
    """What checks() stretched over the wall has at a point; none where the pixels blend."""
    if min(abs(x - 4), abs(y - 4), x, 8 - x, y, 8 - y) < 0.5:
        return None
    return ((RED, GREEN), (BLUE, WHITE))[y > 4][x > 4]


def textured_obj(unused=0, materials=False):
    """The wall; its coordinates come in another order than its points."""
    points, triangles = wall()
    order = [2, 0, 3, 1]
    lines = ["v %g %g %g" % p for p in points] + ["vt %g %g" % SQUARE[i] for i in order]
    lines += ["vt 0.5 0.5"] * unused
    for number, t in enumerate(triangles):
        lines += [f"usemtl material{number}"] * materials
        lines.append("f " + " ".join(f"{i + 1}/{order.index(i) + 1}" for i in t))
    return ("\n".join(lines) + "\n").encode()


def textured_gltf():
    """The wall; the coordinates of this format count from the top."""
    points, triangles = wall()
    parts = [b"".join(struct.pack("<3f", *p) for p in points),
             b"".join(struct.pack("<3H", *t) for t in triangles),
             b"".join(struct.pack("<2f", u, 1 - v) for u, v in SQUARE)]
    views, offset = [], 0
    for part in parts:
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": len(part)})
        offset += len(part)
    accessors = [
        {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
         "min": [0, 0, 0.25], "max": [8, 8, 0.25]},
        {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
        {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"},
    ]
    scene = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 2}, "indices": 1}]}],
        "buffers": [{"byteLength": offset}], "bufferViews": views, "accessors": accessors,
    }
    return gltf((scene, b"".join(parts)))


# Images --------------------------------------------------------------------------------------------


def turned(about_z):
    c, s = math.cos(math.radians(about_z)), math.sin(math.radians(about_z))
    return [c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0]


class Image:
    """Geometry and scalars of an image, whose voxels are its points or its cells."""

    def __init__(self, data):
        cells = data.GetPointData().GetScalars() is None
        self.scalars = (data.GetCellData() if cells else data.GetPointData()).GetScalars()
        self.dimensions = tuple(n - cells for n in data.GetDimensions())
        self.extent = data.GetExtent()
        self.data = data
        self.cells = cells

    def values(self):
        return [int(self.scalars.GetTuple1(i)) for i in range(self.scalars.GetNumberOfTuples())]

    def filled(self):
        return sum(value != 0 for value in self.values())

    def centers(self):
        """World positions of the voxels' centres, in the order of the scalars."""
        first = self.extent[::2]
        shift = 0.5 if self.cells else 0.0
        for k, j, i in itertools.product(*(range(n) for n in reversed(self.dimensions))):
            point = [0.0, 0.0, 0.0]
            self.data.TransformContinuousIndexToPhysicalPoint(
                first[0] + i + shift, first[1] + j + shift, first[2] + k + shift, point)
            yield point


def read_vti(path):
    reader = vtkXMLImageDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return Image(reader.GetOutput())


class Voxels:
    """Centres of the set voxels, and values of each attribute in the same order."""

    def __init__(self, centers, arrays):
        self.centers = centers
        self.arrays = arrays

    def of(self, name):
        return {tuple(round(x, 4) for x in center): value
                for center, value in zip(self.centers, self.arrays[name])}


def arrays_of(data, ids):
    arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
    return {a.GetName(): [a.GetTuple(i) for i in ids] for a in arrays}


def image_voxels(path):
    image = read_vti(path)
    data = image.data.GetCellData() if image.cells else image.data.GetPointData()
    ids = [i for i, value in enumerate(image.values()) if value]
    centers = list(image.centers())
    return Voxels([centers[i] for i in ids], arrays_of(data, ids))


def list_voxels(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    ids = range(data.GetNumberOfPoints())
    assert data.GetNumberOfVerts() == len(ids)
    return Voxels([data.GetPoint(i) for i in ids], arrays_of(data.GetPointData(), ids))


def octree_voxels(path):
    reader = vtkXMLHyperTreeGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    tree = reader.GetOutput()
    cursor = vtkHyperTreeGridNonOrientedGeometryCursor()
    centers, ids = [], []

    def visit():
        if cursor.IsMasked():
            return
        if cursor.IsLeaf():
            point = [0.0, 0.0, 0.0]
            cursor.GetPoint(point)
            centers.append(point)
            ids.append(cursor.GetGlobalNodeIndex())
            return
        for child in range(cursor.GetNumberOfChildren()):
            cursor.ToChild(child)
            visit()
            cursor.ToParent()

    for i in range(tree.GetMaxNumberOfTrees()):
        if tree.GetTree(i):
            tree.InitializeNonOrientedGeometryCursor(cursor, i, False)
            visit()
    return Voxels(centers, arrays_of(tree.GetCellData(), ids))


READERS = {".vti": image_voxels, ".vtp": list_voxels, ".htg": octree_voxels}


def read_meta(path):
    """By VTK's reader, which leaves the direction matrix out; it is taken from the header."""
    reader = vtkMetaImageReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = vtkImageData()
    image.DeepCopy(reader.GetOutput())
    header = path.read_bytes().partition(b"ElementDataFile")[0].decode()
    fields = dict(line.split(" = ", 1) for line in header.splitlines())
    columns = [float(x) for x in fields["TransformMatrix"].split()]
    image.SetDirectionMatrix([columns[3 * (i % 3) + i // 3] for i in range(9)])
    return Image(image)


def read_binvox(path):
    head, _, runs = path.read_bytes().partition(b"data\n")
    fields = dict(line.split(" ", 1) for line in head.decode().splitlines())
    nx, nz, ny = (int(n) for n in fields["dim"].split())
    spacing = float(fields["scale"]) / max(nx, ny, nz)
    image = vtkImageData()
    image.SetDimensions(nx, ny, nz)
    image.SetSpacing(3 * [spacing])
    image.SetOrigin([float(x) + spacing / 2 for x in fields["translate"].split()])
    image.AllocateScalars(VTK_UNSIGNED_CHAR, 1)
    values = [value for value, count in zip(runs[::2], runs[1::2]) for _ in range(count)]
    for value, (x, z, y) in zip(values, itertools.product(range(nx), range(nz), range(ny)), strict=True):
        image.SetScalarComponentFromDouble(x, y, z, 0, value)
    return Image(image)


def is_in_box(point):
    return all(low <= x < high for low, x, high in zip(LOW, point, HIGH))


class ProgramTest(unittest.TestCase):
    maxDiff = 2000

    def setUp(self):
        folder = tempfile.TemporaryDirectory(dir=SCRATCH)
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def file(self, name, content):
        path = self.folder / name
        path.write_bytes(content)
        return path

    def mesh(self):
        return self.file("box.ply", ply_binary(*box()))

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def call(self, *words, **more):
        return subprocess.run(
            [PROGRAM, *map(str, words)], cwd=self.folder, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=300, check=False, **more)

    def succeed(self, *words, warnings=(), **more):
        done = self.call(*words, **more)
        lines = done.stderr.splitlines()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(lines), len(warnings), done.stderr)
        for line, text in zip(lines, warnings):
            self.assertTrue(line.startswith("vtkvoxelize: warning: "), line)
            self.assertIn(text, line)
        return done.stdout

    def complain(self, code, *words, naming=(), **more):
        """One line that names what is wrong, and all files as they were."""
        before = {path: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}
        done = self.call(*words, **more)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("vtkvoxelize: error: "), done.stderr)
        self.assertTrue(done.stderr.endswith("\n"))
        for text in naming:
            self.assertIn(text, done.stderr)
        after = {path: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}
        self.assertEqual(after, before)
        return done.stderr

    def info(self, *words, **more):
        """The lines of --info, by name."""
        lines = self.succeed("--info", *words, **more).splitlines()
        return {line[:17].strip(): line[17:] for line in lines}


class TestMeshes(ProgramTest):
    def check(self, name):
        """The file holds the box; its voxels are all there are."""
        out = self.folder / "out.vti"
        report = self.info("--voxel-size", 0.5, name, out)
        self.assertEqual(report["triangles"], "12")
        self.assertEqual(report["filled voxels"], f"{BOX_VOXELS} (100 %)")
        image = read_vti(out)
        self.assertEqual(image.dimensions, (4, 6, 8))
        self.assertEqual(image.data.GetOrigin(), (1.25, 2.25, 3.25))
        self.assertEqual(image.values(), [1] * BOX_VOXELS)

    def test_formats(self):
        meshes = {
            "text.stl": stl_text(*box()),
            "binary.stl": stl_binary(*box()),
            "UPPER.STL": stl_binary(*box()),
            "text.ply": ply_text(*box()),
            "vertex_index.ply": ply_text(*box(), "vertex_index"),
            "little.ply": ply_binary(*box()),
            "big.ply": ply_binary(*box(), ">"),
            "mesh.obj": obj(*box()),
            "data_uri.gltf": gltf(),
            "mesh.glb": glb(),
            "Mesh.GlB": glb(),
        }
        for name, content in meshes.items():
            with self.subTest(name):
                self.check(self.file(name, content))

    def test_formats_of_vtk(self):
        for name, writer in ("box.vtp", vtkXMLPolyDataWriter()), ("box.vtk", vtkPolyDataWriter()):
            with self.subTest(name):
                written(writer, polydata(*box()), self.folder / name)
                self.check(name)

    def test_gltf_with_a_file_of_data(self):
        scene, data = gltf_parts()
        scene["buffers"][0]["uri"] = "box.bin"
        self.file("box.bin", data)
        self.check(self.file("box.gltf", json.dumps(scene).encode()))

    def test_gltf_without_its_textures(self):
        for image in {"uri": "lost.png"}, {"bufferView": 0, "mimeType": "image/png"}:
            with self.subTest(image):
                scene, data = gltf_parts()
                scene["images"] = [image]
                scene["textures"] = [{"source": 0}]
                self.check(self.file("box.glb", glb((scene, data))))

    def test_text_without_a_last_line_end(self):
        meshes = {"box.obj": obj(*box()), "box.ply": ply_text(*box()), "box.stl": stl_text(*box())}
        for name, content in meshes.items():
            with self.subTest(name):
                self.check(self.file(name, content.rstrip(b"\n")))


    def test_obj_with_relative_indices_and_textures(self):
        points, triangles = box()
        text = "".join("v %g %g %g\n" % p for p in points) + "vt 0 0\nvn 0 0 1\n"
        for t in triangles:
            text += "f " + " ".join(f"{i - len(points)}/-1/1" for i in t) + "\n"
        self.check(self.file("box.obj", text.encode()))

    def test_lines_beside_polygons_are_left_out(self):
        points, triangles = box()
        lines = [(0, len(points))]
        written(vtkXMLPolyDataWriter(), polydata(points + [(0, 0, 0)], triangles, lines),
                self.folder / "box.vtp")
        report = self.info("--voxel-size", 0.5, "--bounds", "1,3,2,5,3,7", "box.vtp", "out.vti")
        self.assertEqual(report["triangles"], "12")
        self.assertEqual(report["filled voxels"].split()[0], str(BOX_VOXELS))


class TestGrids(ProgramTest):
    def voxelize(self, *options, **more):
        self.succeed(*options, self.mesh(), "out.vti", **more)
        return read_vti(self.folder / "out.vti")

    def check(self, image):
        """Every voxel is set whose centre lies in the box, and no other."""
        self.assertEqual(
            image.values(), [int(is_in_box(center)) for center in image.centers()])
        self.assertIn(1, image.values())

    def test_default_resolution(self):
        self.assertEqual(max(self.voxelize().dimensions), 128)

    def test_resolution(self):
        image = self.voxelize("--resolution", 16)
        self.assertEqual(image.dimensions, (8, 12, 16))
        self.check(image)

    def test_dimensions(self):
        image = self.voxelize("--dimensions", "6,6,6")
        self.assertEqual(image.dimensions, (6, 6, 6))
        self.assertEqual(len(set(image.data.GetSpacing())), 1)
        self.check(image)

    def test_voxel_size_and_padding(self):
        image = self.voxelize("--voxel-size=0.5", "--padding=2")
        self.assertEqual(image.dimensions, (8, 10, 12))
        self.assertEqual(image.data.GetSpacing(), (0.5, 0.5, 0.5))
        self.check(image)

    def test_bounds(self):
        image = self.voxelize("--voxel-size", 0.5, "--bounds", "-2,2,0,4,-1,5")
        self.assertEqual(image.dimensions, (8, 8, 12))
        self.check(image)

    def test_bounds_beside_the_mesh_warn(self):
        image = self.voxelize("--voxel-size", 1, "--bounds", "20,24,0,4,0,4",
                              warnings=["no voxel is set"])
        self.assertEqual(image.filled(), 0)

    def reference(self):
        image = vtkImageData()
        image.SetExtent(5, 24, -3, 16, 2, 21)
        image.SetSpacing(0.31, 0.37, 0.43)
        image.SetDirectionMatrix(turned(30))
        image.SetOrigin(0.7, -1.4, 0.9)
        image.AllocateScalars(3, 1)
        return image

    def check_reference(self, name, extent, spacing, origin, direction):
        image = self.voxelize("--reference", self.folder / name)
        self.assertEqual(image.extent, extent)
        for got, wanted in (
            (image.data.GetSpacing(), spacing),
            (image.data.GetOrigin(), origin),
            (self.direction(image), direction),
        ):
            for a, b in zip(got, wanted):
                self.assertAlmostEqual(a, b, places=12)
        self.check(image)

    @staticmethod
    def direction(image):
        matrix = image.data.GetDirectionMatrix()
        return [matrix.GetElement(i // 3, i % 3) for i in range(9)]

    def test_reference_vti(self):
        image = self.reference()
        written(vtkXMLImageDataWriter(), image, self.folder / "reference.vti")
        self.check_reference("reference.vti", image.GetExtent(), image.GetSpacing(),
                             image.GetOrigin(), turned(30))

    def test_reference_vtk(self):
        image = self.reference()
        image.SetDirectionMatrix([1, 0, 0, 0, 1, 0, 0, 0, 1])  # which this format can't hold
        writer = vtkStructuredPointsWriter()
        writer.WriteExtentOn()
        written(writer, image, self.folder / "reference.vtk")
        self.check_reference("reference.vtk", image.GetExtent(), image.GetSpacing(),
                             image.GetOrigin(), [1, 0, 0, 0, 1, 0, 0, 0, 1])

    def test_reference_meta_image(self):
        d = turned(30)
        columns = " ".join(repr(d[3 * (i % 3) + i // 3]) for i in range(9))
        head = ("ObjectType = Image\nNDims = 3\nBinaryData = True\n"
                f"TransformMatrix = {columns}\nOffset = 1 -2 3\nElementSpacing = 0.3 0.4 0.5\n"
                "DimSize = 12 14 10\nElementType = MET_UCHAR\nElementDataFile = ")
        self.file("reference.mha", head.encode() + b"LOCAL\n" + bytes(12 * 14 * 10))
        self.file("reference.mhd", head.encode() + b"reference.raw\n")
        self.file("reference.raw", bytes(12 * 14 * 10))
        for name in "reference.mha", "reference.mhd":
            with self.subTest(name):
                self.check_reference(name, (0, 11, 0, 13, 0, 9), (0.3, 0.4, 0.5), (1, -2, 3), d)

    def test_reference_nrrd(self):
        d, spacing = turned(30), (0.3, 0.4, 0.5)
        vectors = " ".join(
            "(%r,%r,%r)" % tuple(d[3 * row + axis] * spacing[axis] for row in range(3))
            for axis in range(3))
        head = ("NRRD0004\ntype: uchar\ndimension: 3\nspace dimension: 3\nsizes: 12 14 10\n"
                f"space directions: {vectors}\nkinds: domain domain domain\nencoding: raw\n"
                "space origin: (1,-2,3)\n\n")
        self.file("reference.nrrd", head.encode() + bytes(12 * 14 * 10))
        self.check_reference("reference.nrrd", (0, 11, 0, 13, 0, 9), spacing, (1, -2, 3), d)

    def test_reference_into_meta_image(self):
        image = self.reference()
        written(vtkXMLImageDataWriter(), image, self.folder / "reference.vti")
        self.succeed("--reference", "reference.vti", self.mesh(), "out.mha")
        self.check(read_meta(self.folder / "out.mha"))

    def test_bad_references(self):
        mesh = self.mesh()
        self.complain(INPUT, "--reference", "none.vti", mesh, "out.vti", naming=["none.vti"])
        self.complain(INPUT, "--reference", ".", mesh, "out.vti", naming=["folder"])
        self.complain(INPUT, "--reference", mesh, mesh.name, "out.vti", naming=["box.ply", ".mha"])
        for name in "text.vti", "text.mha", "text.nrrd", "text.vtk":
            with self.subTest(name):
                self.file(name, b"this is no image\n" * 20)
                self.complain(INPUT, "--reference", name, mesh, "out.vti", naming=[name])
        for header, reason in (b"NRRD0004\ntype: uchar\nsizes: 4 4 4", "no end"), (b"NRRD0004\n\n", "sizes"), (
                b"NRRD0004\ntype uchar\n\n", "field"):
            with self.subTest(header):
                self.file("head.nrrd", header)
                self.complain(INPUT, "--reference", "head.nrrd", mesh, "out.vti", naming=["head.nrrd", reason])


class TestVoxels(ProgramTest):
    def filled(self, *options, mesh=None, **more):
        mesh = self.mesh() if mesh is None else self.file("mesh.ply", ply_binary(*mesh))
        report = self.info(*options, mesh, "out.vti", **more)
        return int(report["filled voxels"].split()[0])

    def test_modes(self):
        # Voxels from 0.75 to 3.25 and so on: the box ends in the middle of the outermost ones.
        grid = ["--voxel-size", 0.5, "--bounds", "0.75,3.25,1.75,5.25,2.75,7.25"]
        outer, inner = 5 * 7 * 9, 3 * 5 * 7
        self.assertEqual(self.filled("--mode", "over", *grid), outer)
        self.assertEqual(self.filled("--mode", "under", *grid), inner)
        self.assertEqual(self.filled("--mode", "boundary", *grid), outer - inner)
        grid = ["--voxel-size", 0.5]
        self.assertEqual(self.filled("--mode", "center", *grid), BOX_VOXELS)

    def test_fill_rules(self):
        mesh = joined(box((0, 0, 0), (4, 4, 4)), box((2, 0, 0), (6, 4, 4)))
        for rule, filled in ("parity", 64), ("nonzero", 96):
            with self.subTest(rule):
                self.assertEqual(self.filled("--fill", rule, "--voxel-size", 1, mesh=mesh), filled)

    def test_holes(self):
        leaky = ["--voxel-size", 0.5, "--padding", 2, "--axis", "x"]
        self.filled(*leaky, mesh=open_box(), warnings=["4 open"])
        self.assertEqual(self.filled(*leaky, mesh=box()), BOX_VOXELS)
        vote = ["--voxel-size", 0.5, "--padding", 2, "--fill", "vote"]
        self.assertEqual(self.filled(*vote, mesh=open_box()), BOX_VOXELS)

    def test_quiet_has_no_warnings(self):
        self.assertNotEqual(
            self.filled("--voxel-size", 0.5, "--axis", "x", "--quiet", mesh=open_box()), 0)

    def test_axes_and_backends(self):
        for axis, backend in itertools.product(("auto", "x", "y", "z"), ("auto", "raster", "compute")):
            with self.subTest(axis=axis, backend=backend):
                report = self.info("--voxel-size", 0.5, "--axis", axis, "--backend", backend,
                                   self.mesh(), "out.vti")
                self.assertEqual(report["filled voxels"].split()[0], str(BOX_VOXELS))
                self.assertIn(report["backend"], ("raster", "compute"))
                if backend != "auto":
                    self.assertEqual(report["backend"], backend)

    def test_too_large(self):
        self.complain(VOXELIZATION, "--dimensions", "60000,60000,60000", self.mesh(), "out.vti",
                  naming=["60000 x 60000 x 60000", "MiB"])


class TestDepth(ProgramTest):
    def filled(self, *options, mesh):
        report = self.info("--method", "depth", *options, mesh, "out.vti")
        self.assertNotIn("leaking columns", report)
        self.assertEqual(str(read_vti(self.folder / "out.vti").filled()), report["filled voxels"].split()[0])
        return int(report["filled voxels"].split()[0])

    def test_box(self):
        for axes in [], ["--axes", "z"], ["--axes", "y,x"], ["--axes", "auto"]:
            with self.subTest(axes):
                self.assertEqual(self.filled("--voxel-size", 0.5, *axes, mesh=self.mesh()), 4 * 6 * 8)

    def test_fewer_axes_fill_more(self):
        counts = [self.filled("--resolution", 40, "--axes", axes, mesh=BUNNY) for axes in ("x", "x,y", "x,y,z")]
        self.assertEqual(counts, sorted(counts, reverse=True))
        self.assertLess(counts[-1], counts[0])
        # No single axis shows all of it.
        self.assertEqual(self.filled("--resolution", 40, "--axes", "auto", mesh=BUNNY), counts[-1])


class TestSurface(ProgramTest):
    SURFACE = ("--method", "surface")

    def voxelize(self, *options, mesh, output="out.vti", **more):
        self.succeed(*self.SURFACE, *options, mesh, output, **more)
        return READERS[Path(output).suffix](self.folder / output)

    def box_mesh(self, name="box.vtp", writer=None):
        written(writer or vtkXMLPolyDataWriter(), polydata_with_arrays(), self.folder / name)
        return name

    # The box ends in the middle of the outermost voxels of this grid.
    GRID = ("--voxel-size", 0.5, "--bounds", "0.75,3.25,1.75,5.25,2.75,7.25")
    SHELL = 5 * 7 * 9 - 3 * 5 * 7

    def test_shell(self):
        report = self.info(*self.SURFACE, *self.GRID, self.mesh(), "out.vti")
        self.assertEqual(report["filled voxels"].split()[0], str(self.SHELL))
        self.assertEqual(report["triangles"], "12")
        self.assertNotIn("leaking columns", report)
        self.assertEqual(read_vti(self.folder / "out.vti").filled(), self.SHELL)

    def test_open_mesh_without_warning(self):
        mesh = self.file("wall.ply", ply_binary(*wall()))
        self.assertEqual(len(self.voxelize("--voxel-size", 1, mesh=mesh).arrays["Occupancy"]), 64)

    def test_separability(self):
        counts = {n: int(self.info(*self.SURFACE, "--separability", n, "--resolution", 40, BUNNY, "out.vti")
                         ["filled voxels"].split()[0]) for n in (6, 26)}
        self.assertLess(counts[6], 0.8 * counts[26])
        default = self.info(*self.SURFACE, "--resolution", 40, BUNNY, "out.vti")
        self.assertEqual(default["filled voxels"].split()[0], str(counts[26]))

    def test_backends(self):
        for backend in "compute", "raster":
            report = self.info(*self.SURFACE, *self.GRID, "--backend", backend, self.mesh(), "out.vti")
            self.assertEqual(report["backend"], backend)
            self.assertEqual(report["filled voxels"].split()[0], str(self.SHELL))

    def test_outputs(self):
        mesh = self.box_mesh()
        reports, found = [], []
        for name in "a.vti", "b.vtp", "c.htg", "D.VTP":
            with self.subTest(name):
                report = self.info(*self.SURFACE, *self.GRID, "--attributes", "Position,Height,Side", mesh, name)
                reports.append({key: value for key, value in report.items() if " ms" not in value})
                voxels = READERS[Path(name).suffix.lower()](self.folder / name)
                found.append([voxels.of(array) for array in ("Position", "Height", "Side")])
        self.assertEqual(reports, 4 * reports[:1])
        self.assertEqual(reports[0]["voxels"], "5 x 7 x 9")
        self.assertEqual(reports[0]["filled voxels"].split()[0], str(self.SHELL))
        self.assertEqual(found, 4 * found[:1])
        self.assertEqual(len(found[0][0]), self.SHELL)
        for center, position in found[0][0].items():
            for x, low, high, value in zip(center, LOW, HIGH, position):
                self.assertAlmostEqual(value, min(max(x, low), high), delta=0.3)
        self.assertEqual(self.names(), ["D.VTP", "a.vti", "b.vtp", "box.vtp", "c.htg"])

    def test_cells_and_bits(self):
        mesh = self.box_mesh()
        wanted = self.voxelize(*self.GRID, "--attributes", "Height", mesh=mesh).of("Height")
        for options in ["--cells"], ["--type", "bit"], ["--value", 9]:
            with self.subTest(options):
                voxels = self.voxelize(*self.GRID, "--attributes", "Height", *options, mesh=mesh)
                self.assertEqual(voxels.of("Height"), wanted)

    def test_voxel_list_has_indices(self):
        voxels = self.voxelize(*self.GRID, mesh=self.mesh(), output="out.vtp")
        for center, index in voxels.of("VoxelIndex").items():
            self.assertEqual(center, tuple(low + 0.5 * i for low, i in zip(LOW, index)))

    def test_reference(self):
        image = vtkImageData()
        image.SetExtent(5, 24, -3, 16, 2, 21)
        image.SetSpacing(0.31, 0.37, 0.43)
        image.SetOrigin(0.7, 3.4, 0.9)
        found = []
        for turn in 0, 30:
            image.SetDirectionMatrix(turned(turn))
            image.AllocateScalars(3, 1)
            written(vtkXMLImageDataWriter(), image, self.folder / f"turned{turn}.vti")
            options = ["--reference", f"turned{turn}.vti"]
            dense, listed = (self.voxelize(*options, mesh=self.mesh(), output=name).centers
                             for name in ("a.vti", "a.vtp"))
            self.assertTrue(dense)
            self.assertLess(max(abs(x - y) for a, b in zip(dense, listed) for x, y in zip(a, b)), 1e-5)
            self.assertEqual(len(dense), len(listed))
        self.complain(VOXELIZATION, *self.SURFACE, "--reference", "turned30.vti", self.mesh(), "out.htg",
                      naming=["rotated"])

    def test_combinations(self):
        mesh = self.box_mesh()
        first, low, middle, high = (
            self.voxelize(*self.GRID, "--attributes", "Side", "--combine", name, mesh=mesh).of("Side")
            for name in ("first", "min", "average", "max"))
        # The sides meet here that have the numbers 0, 2 and 4.
        self.assertEqual((first[LOW], low[LOW], high[LOW]), ((0,), (0,), (4,)))
        for center, (value,) in middle.items():
            self.assertLessEqual(low[center][0], value + 1e-5)
            self.assertLessEqual(value, high[center][0] + 1e-5)
            self.assertEqual(first[center], low[center])  # sides are numbered in the order of the mesh

    def test_colors_of_ply(self):
        for output in "out.vti", "out.vtp", "out.htg":
            with self.subTest(output):
                colors = self.voxelize(*self.GRID, "--attributes", "RGB", output=output,
                                       mesh=self.file("box.ply", ply_with_colors())).of("RGB")
                for (x, *_), color in colors.items():
                    green = (min(max(x, LOW[0]), HIGH[0]) - LOW[0]) / (HIGH[0] - LOW[0])
                    # Triangles that end within the voxel have their nearest points beside its centre.
                    self.assertAlmostEqual(color[0], 255 * (1 - green), delta=255 * 0.125)
                    self.assertAlmostEqual(color[1], 255 - color[0], delta=1)
                    self.assertEqual(color[2], 0)

    def test_arrays_of_legacy_files(self):
        for binary in False, True:
            writer = vtkPolyDataWriter()
            (writer.SetFileTypeToBinary if binary else writer.SetFileTypeToASCII)()
            mesh = self.box_mesh("box.vtk", writer)
            for name in "Position", "Height", "Side":
                with self.subTest(binary=binary, name=name):
                    voxels = self.voxelize(*self.GRID, "--attributes", name, mesh=mesh)
                    self.assertEqual(set(voxels.arrays), {"Occupancy", name})

    def test_second_scalars_of_legacy_files(self):
        points, triangles = box()
        lines = ["# vtk DataFile Version 3.0", "box", "ASCII", "DATASET POLYDATA", f"POINTS {len(points)} float"]
        lines += ["%g %g %g" % p for p in points]
        lines += [f"POLYGONS {len(triangles)} {4 * len(triangles)}"] + ["3 %d %d %d" % t for t in triangles]
        lines += [f"POINT_DATA {len(points)}"]
        for name in "first", "second":
            lines += [f"SCALARS {name} float 1", "LOOKUP_TABLE default"] + ["7"] * len(points)
        mesh = self.file("box.vtk", ("\n".join(lines) + "\n").encode())
        values = self.voxelize(*self.GRID, "--attributes", "first,second", mesh=mesh).of("second")
        self.assertEqual(set(values.values()), {(7.0,)})

    def check_texture(self, mesh, image, delta=1, **more):
        voxels = self.voxelize("--voxel-size", 0.5, "--texture", image, mesh=mesh, **more)
        seen = set()
        for (x, y, _), color in voxels.of("Texture").items():
            wanted = color_of_wall(x, y)
            if wanted:
                seen.add(wanted)
                for value, channel in zip(color, wanted):
                    self.assertAlmostEqual(value, channel, delta=delta, msg=(x, y))
        self.assertEqual(len(seen), 4)

    def test_texture(self):
        image = self.file("checks.png", checks())
        for name, content in (("wall.obj", textured_obj()), ("unused.obj", textured_obj(unused=3)),
                              ("materials.obj", textured_obj(materials=True)),
                              ("both.obj", textured_obj(2, True)), ("wall.gltf", textured_gltf())):
            with self.subTest(name):
                self.check_texture(self.file(name, content), image)
        for output in "out.vtp", "out.htg":
            with self.subTest(output):
                self.check_texture("wall.obj", image, output=output)

    def test_texture_of_ply(self):
        points, triangles = wall()
        text = ply_text(points, triangles).decode().replace(
            "property float z\n", "property float z\nproperty float u\nproperty float v\n")
        for p, uv in zip(points, SQUARE):
            text = text.replace("\n%g %g %g\n" % p, "\n%g %g %g %g %g\n" % (*p, *uv))
        self.check_texture(self.file("wall.ply", text.encode()), self.file("checks.png", checks()))

    def test_texture_as_jpeg(self):
        reader = vtkPNGReader()
        reader.SetFileName(str(self.file("checks.png", checks(64))))
        mesh = self.file("wall.obj", textured_obj())
        for name in "checks.jpg", "CHECKS.JPEG":
            writer = vtkJPEGWriter()
            writer.SetInputConnection(reader.GetOutputPort())
            writer.SetFileName(str(self.folder / name))
            writer.SetQuality(100)
            writer.Write()
            self.check_texture(mesh, name, delta=12)

    def test_kinds_of_png(self):
        mesh = self.file("wall.obj", textured_obj())
        palette = png_chunk(b"PLTE", bytes((*RED, *GREEN, *BLUE, *WHITE)))
        rows = [bytes([2] * 8 + [3] * 8)] * 8 + [bytes([0] * 8 + [1] * 8)] * 8
        self.check_texture(mesh, self.file("palette.png", png(rows, color=3, rest=palette)))
        gray = self.file("gray.png", png([bytes([200] * 4)] * 4, color=0))
        values = self.voxelize("--voxel-size", 1, "--texture", gray, mesh=mesh).of("Texture").values()
        self.assertEqual(set(values), {(200.0,)})
        bits = self.file("bits.png", png([b"\xff"] * 8, depth=1, color=0))
        values = self.voxelize("--voxel-size", 1, "--texture", bits, mesh=mesh).of("Texture").values()
        self.assertEqual(set(values), {(255.0,)})

    def refuse(self, code, *words, naming):
        self.file("out.vti", b"old")
        for output in "out.vti", "out.vtp", "out.htg":
            with self.subTest(words=words, output=output):
                self.complain(code, *self.SURFACE, *words, output, naming=naming)

    def test_bad_attributes(self):
        mesh = self.box_mesh()
        self.refuse(VOXELIZATION, "--attributes", "Hight", mesh, naming=['"Hight"', "Position, Height, Side"])
        self.refuse(VOXELIZATION, "--attributes", "Height,Hight", mesh, naming=['"Hight"'])
        self.refuse(VOXELIZATION, "--attributes", "RGB", self.mesh(), naming=['"RGB"', "no arrays"])
        data = polydata_with_arrays()
        data.GetPointData().GetArray("Position").SetName("VoxelIndex")
        data.GetPointData().GetArray("Height").SetName("Occupancy")
        written(vtkXMLPolyDataWriter(), data, self.folder / "taken.vtp")
        for name in "VoxelIndex", "Occupancy":
            self.refuse(VOXELIZATION, "--attributes", name, "taken.vtp", naming=[name, "Rename"])
        data = polydata_with_arrays()
        names = vtkStringArray()
        names.SetName("Name")
        for i in range(data.GetNumberOfPoints()):
            names.InsertNextValue(f"point {i}")
        data.GetPointData().AddArray(names)
        data.GetPointData().GetArray("Height").SetValue(3, float("nan"))
        written(vtkXMLPolyDataWriter(), data, self.folder / "names.vtp")
        self.refuse(VOXELIZATION, "--attributes", "Name", "names.vtp", naming=['"Name"', "numbers"])
        self.refuse(VOXELIZATION, "--attributes", "Height", "names.vtp", naming=['"Height"', "NaN"])

    def test_array_of_a_wrong_length(self):
        writer = vtkXMLPolyDataWriter()
        writer.SetDataModeToAscii()
        text = (self.folder / self.box_mesh(writer=writer)).read_text()
        head, values = text.split('Name="Height"')
        end = values.index("<", values.index(">") + 1)
        short = values[:end].rstrip()
        short = short[:short.rindex(" ")] + "\n" + values[end:]
        self.file("short.vtp", (head + 'Name="Height"' + short).encode())
        self.refuse(INPUT, "--attributes", "Height", "short.vtp", naming=["short.vtp", "Height"])

    def test_texture_without_coordinates(self):
        image = self.file("checks.png", checks())
        for name, content in ("box.ply", ply_binary(*box())), ("box.obj", obj(*box())), ("box.glb", glb()):
            self.refuse(VOXELIZATION, "--texture", image, self.file(name, content),
                        naming=["no texture coordinates"])

    def test_bad_textures(self):
        mesh = self.file("wall.obj", textured_obj())
        good = checks()
        (self.folder / "folder.png").mkdir()
        self.refuse(INPUT, "--texture", "none.png", mesh, naming=["none.png", "No such file"])
        self.refuse(INPUT, "--texture", "folder.png", mesh, naming=["folder.png", "folder"])
        self.refuse(INPUT, "--texture", mesh, mesh, naming=["wall.obj", ".png", ".jpg"])
        header = good[:33]
        damaged = {
            "empty": (b"", "empty"),
            "text": (b"no picture\n" * 20, "no PNG"),
            "head": (good[:20], "truncated"),
            "half": (good[:len(good) // 2], "truncated"),
            "end": (good[:-1], "truncated"),
            "sum": (good[:-20] + bytes([good[-20] ^ 1]) + good[-19:], "damaged"),
            "large": (good[:8] + png_chunk(b"IHDR", struct.pack(">2I5B", 30000, 30000, 8, 2, 0, 0, 0))
                      + good[33:], "fewer pixels"),
            "larger": (good[:8] + png_chunk(b"IHDR", struct.pack(">2I5B", 17, 16, 8, 2, 0, 0, 0))
                       + good[33:], "damaged"),
            "zero": (good[:8] + png_chunk(b"IHDR", struct.pack(">2I5B", 0, 16, 8, 2, 0, 0, 0))
                     + good[33:], "header"),
            "kind": (good[:8] + png_chunk(b"IHDR", struct.pack(">2I5B", 16, 16, 8, 5, 0, 0, 0))
                     + good[33:], "header"),
            "palette": (png([bytes(4)] * 4, color=3), "palette"),
            "filter": (header + png_chunk(b"IDAT", zlib.compress((b"\5" + bytes(48)) * 16))
                       + png_chunk(b"IEND", b""), "pixels"),
            "none": (header + png_chunk(b"IEND", b""), "fewer pixels"),
            "zlib": (header + png_chunk(b"IDAT", bytes(200)) + png_chunk(b"IEND", b""), "pixels"),
            "chunk": (header + png_chunk(b"KNOW", b"") + good[33:], "chunk"),
            "order": (good[8:33] + header, "PNG"),
            "bits": (png([bytes(24)] * 4, depth=16), "8 bits"),
        }
        for name, (content, naming) in damaged.items():
            self.file(name + ".png", content)
            self.refuse(INPUT, "--texture", name + ".png", mesh, naming=[name + ".png", naming])
        self.file("noise.jpg", b"no picture\n" * 20)
        self.refuse(INPUT, "--texture", "noise.jpg", mesh, naming=["noise.jpg", "damaged"])

    def test_truncated_jpeg(self):
        reader = vtkPNGReader()
        reader.SetFileName(str(self.file("checks.png", checks(64))))
        writer = vtkJPEGWriter()
        writer.SetInputConnection(reader.GetOutputPort())
        writer.SetFileName(str(self.folder / "good.jpg"))
        writer.Write()
        good = (self.folder / "good.jpg").read_bytes()
        mesh = self.file("wall.obj", textured_obj())
        for part in 0.05, 0.5, 0.9:
            self.file("bad.jpg", good[:int(part * len(good))])
            self.refuse(INPUT, "--texture", "bad.jpg", mesh, naming=["bad.jpg", "damaged"])

    def test_too_large_for_an_image_but_not_for_a_list(self):
        many = ["--attributes", "Position,Height,Side", "--dimensions", "20000,20000,20000"]
        self.complain(VOXELIZATION, *self.SURFACE, *many, self.box_mesh(), "out.vti", naming=["MiB"])

    def test_nothing_set(self):
        for output in "out.vti", "out.vtp", "out.htg":
            voxels = self.voxelize("--bounds", "50,60,50,60,50,60", "--resolution", 8, "--attributes", "Height",
                                   mesh=self.box_mesh(), output=output, warnings=["no voxel is set"])
            self.assertEqual(voxels.centers, [])


class TestOutput(ProgramTest):
    def test_formats(self):
        for name, read in ("a.vti", read_vti), ("b.mha", read_meta), ("c.mhd", read_meta), (
                "D.VTI", read_vti), ("e.binvox", read_binvox):
            with self.subTest(name):
                before = set(self.names()) | {"box.ply"}
                self.succeed("--voxel-size", 0.5, "--padding", 1, self.mesh(), name)
                image = read(self.folder / name)
                self.assertEqual(image.dimensions, (6, 8, 10))
                self.assertEqual(
                    image.values(), [int(is_in_box(center)) for center in image.centers()])
                made = set(self.names()) - before
                self.assertEqual(made, {name, "c.zraw"} if name == "c.mhd" else {name})

    def test_binvox_has_cubes_along_axes(self):
        mesh = self.mesh()
        self.file("flat.mha", b"NDims = 3\nDimSize = 4 4 4\nElementSpacing = 1 1 2\n"
                  b"ElementType = MET_UCHAR\nElementDataFile = LOCAL\n" + bytes(64))
        self.complain(OUTPUT, "--reference", "flat.mha", mesh, "out.binvox", naming=["out.binvox", "cubic"])
        self.complain(USAGE, "--type", "bit", mesh, "out.binvox", naming=["--type", ".vti"])

    def test_value(self):
        self.succeed("--value", 200, "--resolution", 8, "--padding", 1, self.mesh(), "out.vti")
        self.assertEqual(set(read_vti(self.folder / "out.vti").values()), {0, 200})

    def test_bits(self):
        self.succeed("--type", "bit", "--voxel-size", 0.5, "--padding", 1, self.mesh(), "out.vti")
        image = read_vti(self.folder / "out.vti")
        self.assertEqual(image.scalars.GetClassName(), "vtkBitArray")
        self.assertEqual(image.values(), [int(is_in_box(center)) for center in image.centers()])

    def test_cells(self):
        self.succeed("--cells", "--voxel-size", 0.5, "--padding", 1, self.mesh(), "out.vti")
        image = read_vti(self.folder / "out.vti")
        self.assertTrue(image.cells)
        self.assertEqual(image.dimensions, (6, 8, 10))
        self.assertEqual(image.values(), [int(is_in_box(center)) for center in image.centers()])

    def test_info(self):
        report = self.info("--voxel-size", 0.5, "--padding", 1, self.mesh(), "out.vti")
        self.assertEqual(report["voxels"], "6 x 8 x 10")
        self.assertEqual(report["spacing"], "0.5 0.5 0.5")
        self.assertEqual(report["origin"], "0.75 1.75 2.75")
        self.assertEqual(report["filled voxels"], f"{BOX_VOXELS} (40 %)")
        self.assertEqual(float(report["filled volume"]), BOX_VOLUME)
        self.assertEqual(report["leaking columns"], "0")
        self.assertTrue(report["renderer"])
        for task in "reading", "voxelizing", "writing":
            self.assertRegex(report[task], r"^[0-9.e+-]+ ms$")

    def test_silent_unless_asked(self):
        self.assertEqual(self.succeed("--resolution", 16, BUNNY, "out.vti"), "")

    def test_name_that_begins_with_a_dash(self):
        self.file("-box.ply", ply_binary(*box()))
        self.succeed("--resolution", 8, "--", "-box.ply", "-out.vti")
        self.assertIn("-out.vti", self.names())

    def test_link_stays_a_link(self):
        self.file("real.vti", b"old")
        (self.folder / "link.vti").symlink_to("real.vti")
        self.succeed("--resolution", 8, self.mesh(), "link.vti")
        self.assertTrue((self.folder / "link.vti").is_symlink())
        self.assertEqual(max(read_vti(self.folder / "real.vti").dimensions), 8)

    def test_old_output_is_replaced(self):
        self.file("out.vti", b"old")
        self.succeed("--resolution", 8, self.mesh(), "out.vti")
        self.assertEqual(max(read_vti(self.folder / "out.vti").dimensions), 8)
        self.assertEqual(self.names(), ["box.ply", "out.vti"])

    def test_unwritable(self):
        mesh = self.mesh()
        (self.folder / "folder.vti").mkdir()
        self.complain(OUTPUT, mesh, "folder.vti", naming=["folder.vti", "folder"])
        self.complain(OUTPUT, mesh, "none/out.vti", naming=["none/out.vti", "No such file"])
        self.complain(OUTPUT, mesh, "box.ply/out.vti", naming=["box.ply/out.vti"])
        self.complain(OUTPUT, mesh, "/proc/out.vti", naming=["/proc/out.vti"])
        self.complain(OUTPUT, mesh, "out.nrrd", naming=["NRRD", ".vti", ".mha"])
        self.complain(OUTPUT, mesh, "out.png", naming=[".png", ".vti"])
        self.complain(OUTPUT, mesh, "out", naming=["no extension", ".vti"])
        self.complain(OUTPUT, "--picture", "out.jpg", mesh, "out.vti", naming=["out.jpg", ".png"])

    def test_disk_full(self):
        def limit(size):
            return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

        for name in "out.vti", "out.mha", "out.mhd", "out.binvox":
            with self.subTest(name):
                self.file(name, b"old")
                self.complain(OUTPUT, BUNNY, name, preexec_fn=limit(4096), naming=[name, "File too large"])
        for name in "out.vtp", "out.htg":
            with self.subTest(name):
                self.file(name, b"old")
                self.complain(OUTPUT, "--method", "surface", BUNNY, name, preexec_fn=limit(4096),
                              naming=[name, "File too large"])
        with self.subTest("picture"):
            self.complain(OUTPUT, "--resolution", 16, "--picture", "out.png", BUNNY, "out.vti",
                      preexec_fn=limit(20000), naming=["out.png", "File too large"])

    def test_disk_full_at_the_very_end(self):
        options = ["--method", "surface", "--resolution", 16, "--attributes", "Normals"]
        for extension in ".vti", ".vtp", ".htg":
            self.succeed(*options, self.normals(), "full" + extension)
            size = (self.folder / ("full" + extension)).stat().st_size
            for missing in 1, 20, 300:
                with self.subTest(extension=extension, missing=missing):
                    name = "out" + extension
                    self.complain(OUTPUT, *options, "normals.vtp", name, naming=[name],
                                  preexec_fn=lambda: resource.setrlimit(
                                      resource.RLIMIT_FSIZE, (size - missing,) * 2))

    def normals(self):
        """The box, whose normals at its points point outwards."""
        points, triangles = box()
        data = polydata(points, triangles)
        middle = [(low + high) / 2 for low, high in zip(LOW, HIGH)]
        normals = [tuple(x - m for x, m in zip(p, middle)) for p in points]
        data.GetPointData().AddArray(named(vtkFloatArray(), "Normals", normals))
        written(vtkXMLPolyDataWriter(), data, self.folder / "normals.vtp")
        return "normals.vtp"

    def test_signals_leave_nothing(self):
        self.file("out.vti", b"old")
        for number in signal.SIGINT, signal.SIGTERM, signal.SIGHUP:
            with self.subTest(number):
                with subprocess.Popen(
                        [PROGRAM, "--resolution", "400", "--picture", "out.png", BUNNY, "out.vti"],
                        cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
                    deadline = time.monotonic() + 60
                    while len(self.names()) < 3 and time.monotonic() < deadline:
                        time.sleep(0.01)
                    self.assertEqual(len(self.names()), 3)  # the old one and both staged ones
                    time.sleep(0.2)
                    process.send_signal(number)
                    _, error = process.communicate(timeout=60)
                self.assertEqual(process.returncode, -number)
                self.assertEqual(error, b"")
                self.assertEqual(self.names(), ["out.vti"])
                self.assertEqual((self.folder / "out.vti").read_bytes(), b"old")


class TestPicture(ProgramTest):
    def pixels(self, name):
        reader = vtkPNGReader()
        reader.SetFileName(str(self.folder / name))
        reader.Update()
        image = reader.GetOutput()
        width, height, _ = image.GetDimensions()
        colors = bytes(memoryview(image.GetPointData().GetScalars()))
        return width, height, [colors[i:i + 3] for i in range(0, len(colors), 3)]

    def check_drawn(self, name, background=(0.2, 0.95)):
        """White at the border, and a good part of the rest is not."""
        width, height, pixels = self.pixels(name)
        self.assertEqual(max(width, height), 1200)
        border = pixels[:width] + pixels[-width:] + pixels[::width] + pixels[width - 1::width]
        self.assertEqual(set(border), {b"\xff\xff\xff"})
        colored = sum(max(p) - min(p) > 60 for p in pixels) / len(pixels)
        self.assertGreater(colored, 1.0 - background[1])
        self.assertLess(colored, 1.0 - background[0])
        return width, height

    def test_bunny(self):
        self.succeed("--resolution", 48, "--picture", "out.png", BUNNY, "out.vti")
        self.assertEqual(self.names(), ["out.png", "out.vti"])
        self.check_drawn("out.png")

    def test_up(self):
        mesh = self.file("pole.ply", ply_binary(*box((0, 0, 0), (1, 1, 9))))
        shapes = {}
        for axis in "xyz":
            self.succeed("--voxel-size", 0.5, "--picture", "out.png", "--up", axis, mesh, "out.vti")
            shapes[axis] = self.check_drawn("out.png")
        self.assertGreater(shapes["z"][1], 2 * shapes["z"][0])  # the pole stands
        self.assertLess(shapes["y"][1], 2 * shapes["y"][0])  # and lies

    def test_bits_and_cells_look_the_same(self):
        pictures = []
        for options in [], ["--type", "bit"], ["--cells"], ["--value", "9"]:
            self.succeed("--resolution", 8, "--picture", "out.png", *options, BUNNY, "out.vti")
            pictures.append((self.folder / "out.png").read_bytes())
        self.assertEqual(len(set(pictures)), 1)

    def test_surfaces_look_the_same_from_all_outputs(self):
        mesh = self.file("wall.obj", textured_obj())
        image = self.file("checks.png", checks())
        pictures = []
        for output in "out.vti", "out.vtp", "out.htg":
            self.succeed("--method", "surface", "--resolution", 16, "--texture", image, "--up", "z",
                         "--picture", "out.png", mesh, output)
            pictures.append((self.folder / "out.png").read_bytes())
        self.assertEqual(len(set(pictures)), 1)
        _, _, pixels = self.pixels("out.png")
        for name, channel in ("red", 0), ("green", 1), ("blue", 2):
            colored = sum(p[channel] - max(p[:channel] + p[channel + 1:]) > 60 for p in pixels)
            self.assertGreater(colored / len(pixels), 0.05, name)

    def test_attributes_as_colors(self):
        points, triangles = box((0, 0, 0), (1, 1, 4))
        data = polydata(points, triangles)
        data.GetPointData().AddArray(named(vtkFloatArray(), "Height", [(p[2],) for p in points]))
        written(vtkXMLPolyDataWriter(), data, self.folder / "pole.vtp")
        self.succeed("--method", "surface", "--voxel-size", 0.25, "--attributes", "Height", "--up", "z",
                     "--picture", "out.png", "pole.vtp", "out.vti")
        width, height, pixels = self.pixels("out.png")
        middle = width // 2
        low, high = (pixels[width * int(part * height) + middle] for part in (0.15, 0.85))
        self.assertGreater(low[2], low[0] + 60)   # blue below; rows of the image go up
        self.assertGreater(high[0], high[2] + 60)

    def test_nothing_to_draw(self):
        self.succeed("--bounds", "50,60,50,60,50,60", "--resolution", 8, "--picture", "out.png",
                     BUNNY, "out.vti", warnings=["no voxel is set"])
        self.assertEqual(set(self.pixels("out.png")[2]), {b"\xff\xff\xff"})


class TestTerminal(ProgramTest):
    def watch(self, *options):
        """What a terminal in the place of the standard error is given."""
        ours, theirs = pty.openpty()
        try:
            process = subprocess.Popen(
                [PROGRAM, *options, BUNNY, "out.vti"], cwd=self.folder, stdout=subprocess.PIPE,
                stderr=theirs)
            os.close(theirs)
            text = b""
            while True:
                try:
                    chunk = os.read(ours, 4096)
                except OSError:  # the other end was closed
                    break
                if not chunk:
                    break
                text += chunk
            self.assertEqual(process.communicate(timeout=60)[0], b"")
            self.assertEqual(process.returncode, 0)
            return text.decode()
        finally:
            os.close(ours)

    def test_progress_on_a_terminal(self):
        text = self.watch("--resolution", "64")
        for task in "reading", "voxelizing", "writing":
            self.assertRegex(text, task + r" +\[[#.]{40}\] +\d+%")
        self.assertTrue(text.endswith(" \r"), repr(text[-40:]))  # the bar is wiped out

    def test_no_progress_when_quiet(self):
        self.assertEqual(self.watch("--quiet"), "")
        self.assertEqual(self.watch("--quiet", "--picture", "out.png"), "")


class TestUsage(ProgramTest):
    def test_help(self):
        text = self.succeed("--help")
        self.assertEqual(text, self.succeed("-h"))
        for word in ("--resolution", "--reference", "Exit codes", "Examples", ".glb", ".mha", "128",
                     "--method", "--attributes", "RGB", ".htg", ".jpg"):
            self.assertIn(word, text)
        self.assertLessEqual(max(map(len, text.splitlines())), 100)

    def test_version(self):
        self.assertRegex(self.succeed("--version"), r"^vtkvoxelize \d+\.\d+\.\d+ \(VTK 9\.[\d.]+\)\n$")

    def test_files(self):
        self.complain(USAGE, naming=["INPUT and OUTPUT are missing"])
        self.complain(USAGE, "a.ply", naming=["OUTPUT is missing"])
        self.complain(USAGE, "a.ply", "b.vti", "c.vti", naming=["'c.vti'"])
        self.complain(USAGE, "a.ply", "", naming=["OUTPUT is missing"])
        self.complain(USAGE, "--reference", "a.vti", "a.ply", "a.vti", naming=["--reference", "OUTPUT"])
        self.complain(USAGE, "--picture", "a.vti", "a.ply", "a.vti", naming=["--picture", "OUTPUT"])

    def test_unknown(self):
        for word in "--colour", "-x", "--colour=3", "--resolutio":
            with self.subTest(word):
                self.complain(USAGE, word, "a.ply", "b.vti", naming=[word.split("=")[0], "--help"])

    def test_values(self):
        bad = {
            "--resolution": ["", "x", "1.5", "0", "-8", "3x", "99999999999", "--quiet"],
            "--dimensions": ["3", "3,3", "3,3,3,3", "3,3,", "3,,3", "0,3,3", "3,-3,3", "3,3,x"],
            "--voxel-size": ["", "x", "0", "-1", "nan", "inf", "1mm"],
            "--bounds": ["1,2,3", "0,1,0,1,0,x", "0,1,0,1,1,1", "1,0,0,1,0,1", "0,1,0,1,0,nan"],
            "--padding": ["-1", "x", "0.5", "2147483647"],
            "--reference": [""],
            "--mode": ["inside", "", "Center"],
            "--fill": ["even"],
            "--axis": ["w"],
            "--method": ["shell", "", "Surface"],
            "--separability": ["18", "x", "-6"],
            "--attributes": ["", "a,,b", ",a", "a,"],
            "--combine": ["median", ""],
            "--texture": [""],
            "--backend": ["cuda"],
            "--type": ["float"],
            "--value": ["0", "256", "-1", "x"],
            "--picture": [""],
            "--up": ["w"],
        }
        for option, values in bad.items():
            for value in values:
                with self.subTest(option=option, value=value):
                    named = value and "," not in value
                    naming = [option, f"'{value}'"] if named else [option]
                    self.complain(USAGE, option, value, "a.ply", "b.vti", naming=naming)
            with self.subTest(option=option, value=None):
                self.complain(USAGE, "a.ply", "b.vti", option, naming=[option, "value"])

    def test_switch_with_a_value(self):
        self.complain(USAGE, "--info=1", "a.ply", "b.vti", naming=["--info"])

    def test_twice(self):
        self.complain(USAGE, "--padding", 1, "--padding=1", "a.ply", "b.vti", naming=["--padding", "twice"])

    def test_options_of_the_other_method(self):
        for option in "--mode=over", "--fill=vote", "--axis=x":
            with self.subTest(option):
                self.complain(USAGE, "--method", "surface", option, "a.ply", "b.vti",
                              naming=[option.split("=")[0], "--method surface", "solids"])
        surface = ["--separability=6", "--attributes=RGB", "--texture=t.png", "--combine=min"]
        for method in [], ["--method", "solid"]:
            for option in surface:
                with self.subTest(option=option, method=method):
                    self.complain(USAGE, *method, option, "a.ply", "b.vti",
                                  naming=[option.split("=")[0], "needs --method surface"])
            for name in "b.vtp", "b.htg", "b.VTP":
                with self.subTest(name=name, method=method):
                    self.complain(USAGE, *method, "a.ply", name, naming=[name, "needs --method surface"])

    def test_options_of_depth(self):
        for option in "--mode=over", "--fill=vote", "--axis=x":
            with self.subTest(option):
                self.complain(USAGE, "--method", "depth", option, "a.ply", "b.vti",
                              naming=[option.split("=")[0], "--method depth", "solids"])
        self.complain(USAGE, "--method", "depth", "--texture=t.png", "a.ply", "b.vti",
                      naming=["--texture", "needs --method surface"])
        self.complain(USAGE, "--axes=x", "a.ply", "b.vti", naming=["--axes", "needs --method depth"])
        for axes in "", "w", "x,,y", "xy":
            with self.subTest(axes=axes):
                self.complain(USAGE, "--method", "depth", f"--axes={axes}", "a.ply", "b.vti", naming=["--axes"])

    def test_outputs_of_surfaces(self):
        surface = ["--method", "surface"]
        self.complain(USAGE, *surface, "--combine", "min", "a.ply", "b.vti",
                      naming=["--combine", "--attributes", "--texture"])
        for option in "--attributes=RGB", "--texture=t.png":
            for name in "b.mha", "b.mhd", "b.MHA":
                with self.subTest(option=option, name=name):
                    self.complain(USAGE, *surface, option, "a.ply", name,
                                  naming=[option.split("=")[0], name, ".vti"])
        for option in "--cells", "--type=bit", "--type=uchar", "--value=3":
            for name in "b.vtp", "b.htg":
                with self.subTest(option=option, name=name):
                    self.complain(USAGE, *surface, option, "a.ply", name,
                                  naming=[option.split("=")[0], name, ".vti"])
        self.complain(USAGE, *surface, "--texture", "t.png", "--picture", "t.png", "a.ply", "b.vti",
                      naming=["--texture", "--picture", "t.png"])
        self.complain(USAGE, *surface, "a.vtp", "a.vtp", naming=["INPUT", "OUTPUT"])

    def test_contradictions(self):
        resolution, dimensions = ["--resolution", "8"], ["--dimensions", "8,8,8"]
        size, bounds, padding = ["--voxel-size", "1"], ["--bounds", "0,1,0,1,0,1"], ["--padding", "1"]
        reference, axis = ["--reference", "r.vti"], ["--axis", "x"]
        fill, vote = ["--fill", "nonzero"], ["--fill", "vote"]
        boundary, bit = ["--mode", "boundary"], ["--type", "bit"]
        pairs = [(resolution, dimensions), (resolution, size), (dimensions, size), (reference, resolution),
                 (reference, dimensions), (reference, size), (reference, bounds), (reference, padding),
                 (boundary, fill), (boundary, axis), (vote, axis), (bit, ["--value", "2"])]
        for one, other in pairs:
            with self.subTest(one=one, other=other):
                for words in one + other, other + one:
                    self.complain(USAGE, *words, "a.ply", "b.vti", naming=[one[0], other[0]])
        for option in bit, ["--cells"]:
            for name in "b.mha", "b.MHD":
                with self.subTest(option=option, name=name):
                    self.complain(USAGE, *option, "a.ply", name, naming=[option[0], name])
        self.complain(USAGE, "--up", "z", "a.ply", "b.vti", naming=["--up", "--picture"])


class TestBadInput(ProgramTest):
    def refuse(self, name, content, *naming):
        with self.subTest(name):
            self.file("out.vti", b"old")
            self.file(name, content)
            self.complain(INPUT, name, "out.vti", naming=[name, *naming])

    def test_no_file(self):
        self.complain(INPUT, "none.ply", "out.vti", naming=["none.ply", "No such file"])
        (self.folder / "folder.ply").mkdir()
        self.complain(INPUT, "folder.ply", "out.vti", naming=["folder.ply", "folder"])
        os.mkfifo(self.folder / "pipe.ply")
        self.complain(INPUT, "pipe.ply", "out.vti", naming=["pipe.ply", "pipe"])

    def test_unknown_type(self):
        self.refuse("mesh.dae", b"x", ".dae", ".stl", ".glb")
        self.refuse("mesh", b"x", "no extension")

    ALL = ("a.stl", "a.ply", "a.obj", "a.vtp", "a.vtk", "a.gltf", "a.glb")

    def test_empty_files(self):
        for name in self.ALL:
            self.refuse(name, b"", "empty")

    def test_garbage(self):
        noise = bytes((i * 7919 + i * i * 31) % 256 for i in range(5000))
        for name in self.ALL:
            self.refuse("text" + name, b"This is no mesh at all, but prose.\n" * 40)
            self.refuse("noise" + name, noise)

    def contents(self):
        """A file of every format, without spaces at its end."""
        made = {"text.stl": stl_text(*box()), "binary.stl": stl_binary(*box()),
                "text.ply": ply_text(*box()), "binary.ply": ply_binary(*box()),
                "box.gltf": gltf(), "box.glb": glb()}
        for name, writer in (("box.vtp", vtkXMLPolyDataWriter()), ("box.vtk", vtkPolyDataWriter())):
            if name == "box.vtk":
                writer.SetFileTypeToBinary()
            written(writer, polydata(*box()), self.folder / name)
            made[name] = (self.folder / name).read_bytes()
            (self.folder / name).unlink()
        return {name: content.rstrip() for name, content in made.items()}

    def test_truncated(self):
        for name, content in self.contents().items():
            for part in 0.05, 0.3, 0.6, 0.9, 0.97:
                with self.subTest(name=name, part=part):
                    self.refuse(f"{part}-{name}", content[:int(part * len(content))])

    def test_no_polygons(self):
        points, _ = box()
        self.refuse("points.ply", ply_text(points, []), "no polygons")
        self.refuse("points.obj", obj(points, []), "no polygons")
        self.refuse("empty.stl", stl_binary([], []), "no polygons")
        self.refuse("empty_text.stl", b"solid x\nendsolid x\n", "no polygons")
        for name, lines in ("empty.vtp", []), ("lines.vtp", [(0, 1, 2)]):
            path = self.folder / ("made" + name)
            written(vtkXMLPolyDataWriter(), polydata(points if lines else [], [], lines), path)
            self.refuse(name, path.read_bytes(), "no polygons")

    def test_points_that_are_no_numbers(self):
        for name, value in ("nan", float("nan")), ("infinite", float("inf")):
            points, triangles = box()
            points[3] = (value, 0.0, 0.0)
            self.refuse(name + ".ply", ply_binary(points, triangles), "NaN or infinite")
            self.refuse(name + ".stl", stl_binary(points, triangles), "NaN or infinite")
            self.refuse(name + "-text.stl", stl_text(points, triangles))

    def test_other_data(self):
        image = vtkImageData()
        image.SetDimensions(2, 2, 2)
        image.AllocateScalars(3, 1)
        written(vtkXMLImageDataWriter(), image, self.folder / "made.vti")
        self.refuse("image.vtp", (self.folder / "made.vti").read_bytes())
        written(vtkStructuredPointsWriter(), image, self.folder / "made.vtk")
        self.refuse("image.vtk", (self.folder / "made.vtk").read_bytes())

    def test_polygons_of_points_that_do_not_exist(self):
        points, triangles = box()
        triangles[5] = (0, 1, 800)
        self.refuse("text.ply", ply_text(points, triangles), "800")
        self.refuse("binary.ply", ply_binary(points, triangles), "800")
        self.refuse("mesh.obj", obj(points, triangles), "801")
        triangles[5] = (0, 1, -3)
        self.refuse("negative.ply", ply_binary(points, triangles), "-3")
        path = self.folder / "made.vtp"
        written(vtkXMLPolyDataWriter(), polydata(points, [(0, 1, 800)]), path)
        self.refuse("mesh.vtp", path.read_bytes())

    def test_obj_of_texture_coordinates_that_do_not_exist(self):
        points = "".join("v %g %g %g\n" % p for p in box()[0])
        self.refuse("texture.obj", (points + "f 1/1/1 2/2/2 3/3/3\n").encode(), "texture coordinate 1")
        self.refuse("normal.obj", (points + "f 1//1 2//2 3//3\n").encode(), "normal 1")
        self.refuse("zero.obj", (points + "f 0 1 2\n").encode(), "point 0")
        self.refuse("early.obj", b"f -1 -2 -3\n" + points.encode(), "point -1")
        self.refuse("words.obj", (points + "f a b c\n").encode())

    def test_ply_heads(self):
        points, triangles = box()
        good = ply_text(points, triangles).decode()
        for old, new in (
            ("format ascii 1.0", "format morse 1.0"),
            ("element vertex 8", "element vertex -8"),
            ("element vertex 8", "element vertex 4000000000"),
            ("element face 12", "element face 13"),
            ("property float z\n", ""),
            ("property float z", "property list uchar int z"),
            ("property float z", "property long z"),
            ("property list uchar int vertex_indices\n", "property uchar red\n"),
            ("element face 12", "element cat 12"),
            ("end_header\n", ""),
            ("ply\n", "plyx\n"),
            ("comment a box\n", "\n"),
            ("comment a box", "comment " + 5000 * "x"),
            ("comment a box", "comment \0"),
            ("list uchar int", "list float int"),
            ("list uchar int", "list uchar float"),
            ("end_header", "property float texcoord\nend_header"),
            ("end_header", "property list uchar int red\nend_header"),
            ("end_header", "element vertex 1\nproperty int x\nend_header"),
        ):
            with self.subTest(new=new):
                self.assertIn(old, good)
                self.refuse("head.ply", good.replace(old, new, 1).encode())

    def test_ply_lines(self):
        good = ply_text(*box()).decode()
        self.refuse("last.ply", good[:good.rindex(" ")].encode(), "face 11", "too short")
        for old, new in (("1 2 3\n", "1 2\n"), ("1 2 3\n", "\n1 2 3\n"), ("1 2 3\n", "1 2 three\n"),
                         ("\n3 0 1 3\n", "\n300 0 1 3\n"), ("\n3 0 1 3\n", "\n-3 0 1 3\n"),
                         ("\n3 0 1 3\n", "\n3 0 1 3" + 5000 * " " + "\n"),
                         ("\n3 0 1 3\n", "\n3 0 1 \0 3\n"), ("\n3 0 1 3\n", "\n12e-1 0 1\n")):
            with self.subTest(new=new[:20]):
                self.assertIn(old, good)
                self.refuse("line.ply", good.replace(old, new, 1).encode())

    def legacy(self, binary, version):
        writer = vtkPolyDataWriter()
        writer.SetFileVersion(version)
        (writer.SetFileTypeToBinary if binary else writer.SetFileTypeToASCII)()
        written(writer, polydata(*box()), self.folder / "made.vtk")
        return (self.folder / "made.vtk").read_bytes()

    def test_legacy_counts(self):
        for binary in False, True:
            good = self.legacy(binary, 42)
            for old, new in ((b"POLYGONS 12 48", b"POLYGONS 12 47"), (b"POLYGONS 12 48", b"POLYGONS 13 48"),
                             (b"POLYGONS 12 48", b"POLYGONS 12 4800000000000"),
                             (b"POLYGONS 12 48", b"POLYGONS -12 48"), (b"POLYGONS 12 48", b"POLYGONS 12 -48"),
                             (b"POINTS 8", b"POINTS 9"), (b"POINTS 8", b"POINTS 2147483647"),
                             (b"POINTS 8", b"POINTS -8"), (b"POINTS 8", b"POINTS x")):
                with self.subTest(binary=binary, new=new):
                    self.assertIn(old, good)
                    self.refuse("counts.vtk", good.replace(old, new, 1))

    def test_legacy_cells(self):
        good = self.legacy(True, 42)
        first = struct.pack(">4i", 3, 0, 1, 3)
        for corners in -1, 47, 2**31 - 1:
            with self.subTest(corners):
                self.assertIn(first, good)
                self.refuse("cells.vtk", good.replace(first, struct.pack(">i", corners) + first[4:], 1),
                            "polygons are damaged")

    def test_legacy_offsets(self):
        good = self.legacy(True, 51)
        offsets = struct.pack(">4q", 0, 3, 6, 9)
        for second in -3, 30000, 2**62:
            with self.subTest(second):
                self.assertIn(offsets, good)
                self.refuse("offsets.vtk", good.replace(offsets, struct.pack(">4q", 0, second, 6, 9), 1),
                            "points which do not exist")

    @unittest.skipIf("asan" in os.environ.get("LD_PRELOAD", ""), "ends where memory ends")
    @unittest.skipUnless(sys.platform == "linux", "memory is limited on Linux only")
    def test_vtp_that_wants_all_memory(self):
        written(vtkXMLPolyDataWriter(), polydata(*box()), self.folder / "made.vtp")
        good = (self.folder / "made.vtp").read_bytes()
        one_block = b"_" + base64.b64encode(struct.pack("<2I", 1, 2**15))[:6]
        self.assertIn(one_block, good)
        self.refuse("blocks.vtp", good.replace(one_block, b"_////fw", 1), "memory")


class TestBadGltf(ProgramTest):
    """Lies in glTF files: each is named, with its place."""

    def refuse(self, change, *naming):
        """Of a file that `change` is applied to, as text and binary; data may be returned by it."""
        for name, write in ("lie.gltf", gltf), ("lie.glb", glb):
            with self.subTest(change=change, name=name):
                scene, data = gltf_parts()
                if isinstance(change, dict):
                    self.set(scene, change)
                else:
                    data = change(scene, data) or data
                self.file(name, write((scene, data)))
                self.complain(INPUT, name, "out.vti", naming=[name, *naming])

    @staticmethod
    def set(scene, values):
        """Values by place: numbers and names with dots in between; None removes."""
        for place, value in values.items():
            *path, last = [int(word) if word.isdigit() else word for word in place.split(".")]
            item = scene
            for word in path:
                item = item[word]
            if value is None:
                del item[last]
            else:
                item[last] = value

    def test_references(self):
        for place, naming in (
            ("scene", "scene is 9, but there are 1 scenes"),
            ("scenes.0.nodes.0", "scenes[0].nodes[0] is 9, but there are 2 nodes"),
            ("nodes.0.children.0", "nodes[0].children[0] is 9"),
            ("nodes.1.mesh", "nodes[1].mesh is 9"),
            ("nodes.1.skin", "nodes[1].skin is 9, but there are 0 skins"),
            ("meshes.0.primitives.0.attributes.POSITION", "attributes.POSITION is 9"),
            ("meshes.0.primitives.0.attributes.TEXCOORD_0", "attributes.TEXCOORD_0 is 9"),
            ("meshes.0.primitives.0.indices", "meshes[0].primitives[0].indices is 9"),
            ("accessors.1.bufferView", "accessors[1].bufferView is 9"),
            ("bufferViews.1.buffer", "bufferViews[1].buffer is 9, but there are 1 buffers"),
        ):
            self.refuse({place: 9}, naming, "export it again")
            self.refuse({place: -1}, naming.split(" is ")[0], "whole number")
            self.refuse({place: "0"}, naming.split(" is ")[0], "whole number")

    def test_lengths(self):
        self.refuse({"bufferViews.1.byteLength": 73}, "bufferViews[1] ends at byte 169 of a buffer of 168")
        self.refuse({"bufferViews.1.byteOffset": 97}, "bufferViews[1] ends at byte 169")
        self.refuse({"bufferViews.1.byteLength": 71}, "accessors[1] ends at byte 72", "71")
        self.refuse({"accessors.1.byteOffset": 1}, "accessors[1] ends at byte 73")
        self.refuse({"accessors.1.count": 37}, "accessors[1] ends at byte 74")
        self.refuse({"accessors.1.componentType": 5125}, "accessors[1] ends at byte 144")
        self.refuse({"accessors.0.type": "VEC4"}, "accessors[0] ends at byte 128")
        self.refuse({"bufferViews.0.byteStride": 16}, "accessors[0] ends at byte 124")
        self.refuse({"bufferViews.0.byteStride": 8}, "bufferViews[0] has a byteStride of 8")
        self.refuse({"buffers.0.byteLength": 100000}, "buffers[0] is to have 100000 bytes")
        self.refuse(lambda scene, data: data[:-4], "buffers[0] is to have 168 bytes", "164")

    def test_numbers(self):
        for place in ("accessors.0.count", "bufferViews.0.byteLength", "buffers.0.byteLength"):
            for value in -1, 2**31, 2**64, 1.5, "8", [], None:
                self.refuse({place: value}, place.split(".")[-1])
        self.refuse({"accessors.0.count": 0}, "accessors[0] is empty")
        self.refuse({"accessors.0.count": 2**31 - 1}, "accessors[0] ends at byte")
        self.refuse({"accessors.0.componentType": 5124}, "accessors[0].componentType is 5124")
        self.refuse({"accessors.0.type": "VEC5"}, "accessors[0].type")
        self.refuse({"meshes.0.primitives.0.mode": 7}, "mode")
        self.refuse({"nodes.1.scale": [1, 1]}, "nodes[1].scale is no list of 3 numbers")
        self.refuse({"nodes.1.scale": [1, 1, "1"]}, "nodes[1].scale is no list of 3 numbers")
        self.refuse({"nodes.1.matrix": [1, 0]}, "nodes[1].matrix is no list of 16 numbers")

    def test_types(self):
        for place in "bufferViews", "accessors", "meshes", "nodes", "scenes":
            self.refuse({place + ".0": 5}, f"{place}[0] is no object")
            self.refuse({place: "x"}, f"{place} is no list")
        self.refuse({"asset": None}, "asset")
        self.refuse({"asset.version": "1.0"}, "version")
        self.refuse({"scenes": None}, "scene is 0, but there are 0 scenes")

    def test_missing_parts(self):
        self.refuse({"meshes.0.primitives.0.attributes.POSITION": None}, "no POSITION")
        self.refuse({"accessors.0.bufferView": None}, "accessors[0] has no bufferView", "compressed")
        self.refuse({"meshes.0": {}}, "meshes[0] has no primitives")
        self.refuse({"meshes.0.primitives": []}, "meshes[0] has no primitives")

    def test_attributes(self):
        self.refuse({"accessors.0.type": "VEC2"}, "POSITION", "VEC3")
        self.refuse({"accessors.0.componentType": 5123}, "POSITION", "quantization")
        self.refuse({"accessors.1.componentType": 5122}, "indices", "componentType")
        self.refuse({"accessors.1.type": "VEC2", "accessors.1.count": 18}, "indices")
        attribute = "meshes.0.primitives.0.attributes."
        self.refuse({attribute + "NORMAL": 1}, "NORMAL has 36 elements for 8 points")
        self.refuse({attribute + "JOINTS_0": 0}, "JOINTS_0", "VEC4")
        self.refuse({attribute + "WEIGHTS_0": 0}, "WEIGHTS_0", "VEC4")
        self.refuse({"meshes.0.primitives.0.targets": [{"POSITION": 1}]}, "targets[0].POSITION", "36")

    def test_points_that_do_not_exist(self):
        self.refuse(lambda scene, data: data[:-2] + b"\x08\0", "indices has an index 8 into 8 elements")
        self.refuse(lambda scene, data: data[:-2] + b"\xff\xff", "indices has an index 65535")

    def test_sparse(self):
        def sparse(**more):
            return {"accessors.0.sparse": {
                "count": 1, "indices": {"bufferView": 1, "byteOffset": 0, "componentType": 5123},
                "values": {"bufferView": 0, "byteOffset": 0}} | more}

        self.refuse(sparse(count=9), "sparse.values ends at byte 108")
        self.refuse(sparse(count=37), "sparse.indices ends at byte 74")
        self.refuse(sparse(indices={"bufferView": 0, "byteOffset": 20, "componentType": 5125}),
                    "sparse.indices has an index")
        self.refuse(sparse(values={"bufferView": 7, "byteOffset": 0}), "sparse.values.bufferView is 7")

    def test_nodes_in_circles(self):
        self.refuse({"nodes.1.children": [0]}, "scenes[0].nodes[0]", "child")
        self.refuse({"nodes.1.children": [1]}, "nodes[1].children[0]", "child")
        self.refuse({"nodes.0.children": [0]}, "scenes[0].nodes[0]", "child")
        self.refuse({"nodes.0.children": [1, 1]}, "nodes[0].children[1]", "child")

    def test_nodes_too_deep(self):
        depth = 50000
        chain = [{"children": [i + 1]} for i in range(depth)] + [{"mesh": 0}]
        self.refuse({"nodes": chain}, "nodes[1001]", "flatten")

    def test_skins(self):
        self.refuse({"skins": [{"joints": [0, 1]}], "nodes.1.skin": 0}, "skins[0] has no inverseBindMatrices")
        self.refuse({"skins": [{"joints": [7]}]}, "skins[0].joints[0] is 7")
        self.refuse({"skins": [{"joints": [0], "inverseBindMatrices": 0}], "scenes.0.nodes": [1],
                     "nodes.0.children": [], "nodes.1.skin": 0}, "skins[0].joints[0]", "no scene")

    def test_containers(self):
        good = glb()
        for name, content, naming in (
            ("magic", b"glTX" + good[4:], "glTF"),
            ("version", good[:4] + struct.pack("<I", 1) + good[8:], "version 1"),
            ("short", good[:-4], "truncated"),
            ("long", good + bytes(4), "header"),
            ("chunk", good[:12] + struct.pack("<I", 2**32 - 4) + good[16:], "chunk"),
            ("type", good[:16] + b"BIN\0" + good[20:], "JSON"),
            ("head", good[:12], "header"),
        ):
            with self.subTest(name):
                self.file(name + ".glb", content)
                self.complain(INPUT, name + ".glb", "out.vti", naming=[naming])

    def test_binary_parts(self):
        scene, data = gltf_parts()
        scene["buffers"].append({"byteLength": 4})
        self.file("two.glb", glb((scene, data)))
        self.complain(INPUT, "two.glb", "out.vti", naming=["buffers", ".gltf"])
        scene, data = gltf_parts()
        scene["buffers"][0]["uri"] = "box.bin"
        self.file("uri.glb", glb((scene, data)))
        self.complain(INPUT, "uri.glb", "out.vti", naming=["buffers[0]", ".gltf"])
        for buffers, naming in ([], "there are 0 buffers"), ([5], "buffers[0] is no object"):
            scene, data = gltf_parts()
            scene["buffers"] = buffers
            self.file("none.glb", glb((scene, data)))
            self.complain(INPUT, "none.glb", "out.vti", naming=[naming])

    def test_json(self):
        good = gltf()
        for name, content, naming in (
            ("open", good[:-1], "JSON"),
            ("more", good + b"{}", "JSON"),
            ("comma", good.replace(b", ", b",, ", 1), "JSON"),
            ("deep", b"[" * 100000, "JSON"),
            ("list", b"[]", "no object"),
        ):
            with self.subTest(name):
                self.file(name + ".gltf", content)
                self.complain(INPUT, name + ".gltf", "out.vti", naming=[naming])

    def test_uris(self):
        good = gltf_parts()[1]
        self.file("short.bin", good[:-1])
        self.file("long.bin", good + b"x")
        (self.folder / "folder").mkdir()
        os.mkfifo(self.folder / "pipe")
        base64_of_good = base64.b64encode(good).decode()
        for uri, *naming in (
            ("lost.bin", "lost.bin", "No such file"),
            ("folder", "folder"),
            ("pipe", "pipe"),
            ("short.bin", "buffers[0]", "168", "short.bin", "167"),
            ("long.bin", "buffers[0]", "168", "long.bin", "169"),
            ("data:;base64," + base64_of_good[:-4], "buffers[0]", "168", "165"),
            ("data:;base64," + base64_of_good[:100] + "?" + base64_of_good[101:], "base64", "byte 75"),
            ("data:;base64,", "buffers[0]", "0"),
            ("data:", "buffers[0]", "0"),
            (5, "buffers[0].uri is no text"),
        ):
            with self.subTest(uri):
                scene, _ = gltf_parts()
                scene["buffers"][0]["uri"] = uri
                self.file("lie.gltf", json.dumps(scene).encode())
                self.complain(INPUT, "lie.gltf", "out.vti", naming=naming)
        scene, _ = gltf_parts()
        self.file("lie.gltf", json.dumps(scene).encode())
        self.complain(INPUT, "lie.gltf", "out.vti", naming=["buffers[0].uri is missing"])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True, type=os.path.abspath)
    parser.add_argument("-D", dest="data", required=True, action="append", type=os.path.abspath)
    parser.add_argument("-T", dest="scratch", type=os.path.abspath)
    arguments, rest = parser.parse_known_args()
    global PROGRAM, BUNNY, SCRATCH
    PROGRAM = arguments.program
    BUNNY = os.path.join(arguments.data[0], "bunny_7k.ply")
    SCRATCH = arguments.scratch
    if rest[:1] == ["-V"]:  # the baseline, which this test has none of
        rest = rest[2:]
    unittest.main(argv=[sys.argv[0], *rest])


if __name__ == "__main__":
    main()
