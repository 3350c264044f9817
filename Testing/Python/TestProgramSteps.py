"""Proves what vtkvoxelize promises of its steps, which change voxels one after the other.

Meshes and masks of all formats are joined as NumPy joins their voxels. Kernels are those of
vtkImageDilateErode3D and of formulas, holes and components those that a flood finds. Any sequence of steps gives what NumPy makes of it on a grid so
wide that no border matters, though the program's grid is a small one. Grids, outputs, reports and
errors are as the help says.

    TestProgramSteps.py --program vtkvoxelize -D DATA_DIRECTORY [-T SCRATCH_DIRECTORY]
"""

import gzip
import itertools
import random

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkImagingMorphological import vtkImageDilateErode3D
from vtkmodules.vtkIOImage import vtkNIFTIImageWriter
from vtkmodules.vtkIOLegacy import vtkPolyDataWriter
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLImageDataWriter, vtkXMLPolyDataWriter

import TestProgram
from TestProgram import (
    INPUT, USAGE, VOXELIZATION, ProgramTest, box, glb, gltf, obj, ply_binary, ply_text, read_binvox, read_meta,
    read_vti, stl_binary, stl_text, turned, written)

KERNELS = "box", "sphere", "faces6", "edges18", "corners26"
JOINS = {
    "--unite": np.logical_or,
    "--intersect": np.logical_and,
    "--subtract": lambda a, b: a & ~b,
    "--xor": np.logical_xor,
}


class Grid:
    """Voxels as an array [z, y, x] with the place of the first, and the spacing."""

    def __init__(self, image):
        n = image.dimensions
        self.bits = vtk_to_numpy(image.scalars).reshape(n[2], n[1], n[0]) != 0
        shift = 0.5 if image.cells else 0.0
        point = [0.0, 0.0, 0.0]
        image.data.TransformContinuousIndexToPhysicalPoint(
            *(index + shift for index in image.extent[::2]), point)
        self.first = np.array(point)
        self.spacing = np.array(image.data.GetSpacing())


def element(kernel, n):
    """The voxels around one that n steps of the kernel reach, as a small array."""
    distances = np.abs(np.indices(3 * (2 * n + 1,)) - n)
    if kernel == "sphere":
        return ((distances / (n + 0.5)) ** 2).sum(axis=0) <= 1
    reach = {"faces6": n, "edges18": 2 * n}.get(kernel, 3 * n)
    return distances.sum(axis=0) <= reach


def dilated(bits, kernel, n):
    """Beyond the border, voxels are like those at the border."""
    wide = np.pad(bits, n, mode="edge")
    out = np.zeros_like(bits)
    for z, y, x in np.argwhere(element(kernel, n)):
        out |= wide[z:z + bits.shape[0], y:y + bits.shape[1], x:x + bits.shape[2]]
    return out


def eroded(bits, kernel, n):
    return ~dilated(~bits, kernel, n)


CHANGES = {
    "--dilate": dilated,
    "--erode": eroded,
    "--open": lambda bits, *kernel: dilated(eroded(bits, *kernel), *kernel),
    "--close": lambda bits, *kernel: eroded(dilated(bits, *kernel), *kernel),
}


NEIGHBOURS = {6: "faces6", 18: "edges18", 26: "corners26"}
UNSET_NEIGHBOURS = {6: "corners26", 18: "faces6", 26: "faces6"}


def flooded(bits, seeds, kernel):
    """What can be reached from the seeds on set voxels."""
    reached = bits & seeds
    while True:
        more = dilated(reached, kernel, 1) & bits
        if (more == reached).all():
            return reached
        reached = more


def filled(bits, connectivity=26):
    border = np.ones_like(bits)
    border[1:-1, 1:-1, 1:-1] = False
    return ~flooded(~bits, border, UNSET_NEIGHBOURS[connectivity])


def largest(bits, connectivity=26):
    """The first one of those with most voxels, in the order of VTK."""
    best, left = np.zeros_like(bits), bits.copy()
    while left.any():
        seed = np.zeros_like(bits)
        seed.flat[left.argmax()] = True
        component = flooded(left, seed, NEIGHBOURS[connectivity])
        best = component if component.sum() > best.sum() else best
        left &= ~component
    return best


COMPONENTS = {"--fill-holes": filled, "--keep-largest": largest}


def is_endless(steps):
    """Whether the largest component is asked for when all around is set."""
    outside = False
    for step, *_ in steps:
        if step == "--complement":
            outside = not outside
        elif step == "--intersect":
            outside = False
        elif step == "--keep-largest" and outside:
            return True
    return False


def warnings_of(wanted):
    return [] if wanted.any() else ["the steps leave none"]


def ball(center, radius):
    source = vtkSphereSource()
    source.SetCenter(center)
    source.SetRadius(radius)
    source.SetThetaResolution(16)
    source.SetPhiResolution(12)
    source.Update()
    return source.GetOutput()


class StepsTest(ProgramTest):
    def ball(self, name, center, radius):
        written(vtkXMLPolyDataWriter(), ball(center, radius), self.folder / name)
        return name

    def balls(self):
        """Two that overlap, one inside, and one far away."""
        return [self.ball("a.vtp", (0.03, 0.02, 0.01), 4.17), self.ball("b.vtp", (3.11, 1.07, -0.5), 3.41),
                self.ball("c.vtp", (0.2, 0.3, 0.1), 2.13), self.ball("d.vtp", (-12.3, 2.9, 1.1), 2.59)]

    def voxels(self, *words, output="out.vti", **more):
        self.succeed(*words, output, **more)
        return Grid(read_vti(self.folder / output))


class TestJoins(StepsTest):
    GRID = ("--voxel-size", 0.5, "--bounds", "-5,7,-5,5,-5,5")

    def alone(self, mesh, *options):
        return self.voxels(*self.GRID, *options, mesh).bits

    def test_meshes(self):
        a, b, c, _ = self.balls()
        for options in [], ["--mode", "over"], ["--backend", "raster"], ["--method", "surface"]:
            alone = [self.alone(mesh, *options) for mesh in (a, b, c)]
            pairs = itertools.product(JOINS.items(), repeat=2) if not options else zip(
                JOINS.items(), reversed(JOINS.items()))
            for (one, join), (other, join2) in pairs:
                with self.subTest(one=one, other=other, options=options):
                    wanted = join2(join(alone[0], alone[1]), alone[2])
                    got = self.voxels(*self.GRID, *options, a, one, b, other, c, warnings=warnings_of(wanted))
                    np.testing.assert_array_equal(got.bits, wanted)
            self.assertTrue((alone[0] & alone[1] & ~alone[2]).any())

    def test_complement(self):
        a, b, *_ = self.balls()
        got = self.voxels(*self.GRID, a, "--complement", "--intersect", b)
        np.testing.assert_array_equal(got.bits, self.alone(b) & ~self.alone(a))
        got = self.voxels(*self.GRID, a, "--complement", "--complement")
        np.testing.assert_array_equal(got.bits, self.alone(a))

    def test_many(self):
        a, *others = [self.ball(f"{i}.vtp", (0.6 * i - 4.03, 0.1 * i, 0.01), 1.07) for i in range(12)]
        wanted = self.alone(a)
        for other in others:
            wanted = wanted ^ self.alone(other)
        words = [word for other in others for word in ("--xor", other)]
        np.testing.assert_array_equal(self.voxels(*self.GRID, a, *words).bits, wanted)

    def test_formats_of_meshes(self):
        a = self.ball("a.vtp", (2.03, 3.02, 4.01), 3.17)
        grid = ["--voxel-size", 0.5, "--bounds", "-2,6,-1,7,0,8"]
        points, triangles = box()
        files = [self.file(name, content) for name, content in {
            "text.stl": stl_text(points, triangles), "binary.STL": stl_binary(points, triangles),
            "text.ply": ply_text(points, triangles), "binary.ply": ply_binary(points, triangles),
            "box.obj": obj(points, triangles), "box.gltf": gltf(), "box.glb": glb()}.items()]
        for name, writer in ("box.vtp", vtkXMLPolyDataWriter()), ("box.vtk", vtkPolyDataWriter()):
            written(writer, TestProgram.polydata(points, triangles), self.folder / name)
            files.append(self.folder / name)
        wanted = self.voxels(*grid, a).bits & ~self.voxels(*grid, files[0]).bits
        self.assertTrue(wanted.any())
        for file in files:
            with self.subTest(file.name):
                np.testing.assert_array_equal(self.voxels(*grid, a, "--subtract", file.name).bits, wanted)


class TestMasks(StepsTest):
    """Half of the voxels of a grid, in all formats of images."""

    def image(self, direction=None, spacing=(0.5, 0.5, 0.5), origin=(-3.0, -2.5, -4.0)):
        image = TestProgram.vtkImageData()
        image.SetDimensions(13, 11, 15)
        image.SetSpacing(spacing)
        image.SetOrigin(origin)
        if direction:
            image.SetDirectionMatrix(direction)
        self.bits = np.random.default_rng(7).integers(0, 2, (15, 11, 13)).astype(np.uint8)
        image.GetPointData().SetScalars(numpy_to_vtk(3 * self.bits.ravel(), deep=True))
        return image

    def check(self, name, reference=None):
        ball = self.ball("ball.vtp", (0.03, 0.02, 0.01), 2.41)
        with self.subTest(name):
            grid = ["--reference", reference or name]
            alone = self.voxels(*grid, ball).bits
            got = self.voxels(*grid, ball, "--subtract", name)
            np.testing.assert_array_equal(got.bits, alone & (self.bits == 0))
            self.assertTrue(got.bits.any())

    def test_vti(self):
        image = self.image(turned(30), (0.5, 0.4, 0.6), (-2.0, -4.5, -4.0))
        written(vtkXMLImageDataWriter(), image, self.folder / "points.vti")
        self.check("points.vti")
        cells = TestProgram.vtkImageData()
        cells.SetDimensions(14, 12, 16)
        cells.SetSpacing(0.5, 0.4, 0.6)
        cells.SetDirectionMatrix(turned(30))
        half = [0.0, 0.0, 0.0]
        image.TransformContinuousIndexToPhysicalPoint(-0.5, -0.5, -0.5, half)
        cells.SetOrigin(half)
        cells.GetCellData().SetScalars(image.GetPointData().GetScalars())
        written(vtkXMLImageDataWriter(), cells, self.folder / "cells.vti")
        self.check("cells.vti", "points.vti")

    def test_indices_do_not_matter(self):
        image = self.image()
        written(vtkXMLImageDataWriter(), image, self.folder / "mask.vti")
        image.SetExtent(4, 16, -3, 7, 20, 34)
        image.SetOrigin(-5.0, -1.0, -14.0)
        written(vtkXMLImageDataWriter(), image, self.folder / "reference.vti")
        self.check("mask.vti", "reference.vti")

    def test_own_outputs(self):
        a, b, *_ = self.balls()
        grid = ["--voxel-size", 0.5, "--bounds", "-5,7,-5,5,-5,5"]
        wanted = self.voxels(*grid, a, "--unite", b)
        for name, *options in (
                ("b.vti",), ("bits.vti", "--type", "bit"), ("cells.vti", "--cells"), ("b.mha",), ("b.mhd",),
                ("b.binvox",)):
            with self.subTest(name):
                self.succeed(*grid, *options, b, name)
                np.testing.assert_array_equal(self.voxels(*grid, a, "--unite", name).bits, wanted.bits)
                np.testing.assert_array_equal(
                    self.voxels(*grid, "--cells", a, "--unite", name).bits, wanted.bits)

    def test_reference_binvox(self):
        a, b, *_ = self.balls()
        self.succeed("--voxel-size", 0.5, "--bounds", "-5,7,-5,5,-5,5", b, "b.binvox")
        got = self.voxels("--reference", "b.binvox", a, "--intersect", "b.binvox")
        wanted = self.voxels("--voxel-size", 0.5, "--bounds", "-5,7,-5,5,-5,5", a, "--intersect", b)
        np.testing.assert_array_equal(got.bits, wanted.bits)
        np.testing.assert_allclose(got.first, wanted.first)

    def test_meta_image(self):
        d = turned(30)
        self.image()
        columns = " ".join(repr(d[3 * (i % 3) + i // 3]) for i in range(9))
        head = (f"ObjectType = Image\nNDims = 3\nBinaryData = True\nTransformMatrix = {columns}\n"
                "Offset = -2 -4.5 -4\nElementSpacing = 0.5 0.4 0.6\nDimSize = 13 11 15\n"
                "ElementType = MET_UCHAR\nElementDataFile = ").encode()
        self.file("mask.mha", head + b"LOCAL\n" + self.bits.tobytes())
        self.file("mask.mhd", head + b"mask.raw\n")
        self.file("mask.raw", self.bits.tobytes())
        self.check("mask.mha")
        self.check("mask.mhd")

    def test_nrrd(self):
        d, spacing = turned(30), (0.5, 0.4, 0.6)
        self.image()
        vectors = " ".join("(%r,%r,%r)" % tuple(d[3 * row + axis] * spacing[axis] for row in range(3))
                           for axis in range(3))
        head = ("NRRD0004\ntype: uchar\ndimension: 3\nspace dimension: 3\nsizes: 13 11 15\n"
                f"space directions: {vectors}\nkinds: domain domain domain\nencoding: %s\n"
                "space origin: (-2,-4.5,-4)\n%s\n")
        self.file("raw.nrrd", (head % ("raw", "")).encode() + self.bits.tobytes())
        self.file("gzip.nrrd", (head % ("gzip", "")).encode() + gzip.compress(self.bits.tobytes()))
        self.file("mask.nhdr", (head % ("raw", "data file: mask.raw\n")).encode())
        self.file("mask.raw", self.bits.tobytes())
        for name in "raw.nrrd", "gzip.nrrd", "mask.nhdr":
            self.check(name)

    def test_nifti(self):
        d, image = turned(30), self.image(None, (0.5, 0.4, 0.6), (0, 0, 0))
        matrix = vtkMatrix4x4()
        for row, column in itertools.product(range(3), repeat=2):
            matrix.SetElement(row, column, d[3 * row + column])
        for row, value in enumerate((-2.0, -4.5, -4.0)):
            matrix.SetElement(row, 3, value)
        self.image(d, (0.5, 0.4, 0.6), (-2.0, -4.5, -4.0))
        wanted = self.image(d, (0.5, 0.4, 0.6), (-2.0, -4.5, -4.0))
        written(vtkXMLImageDataWriter(), wanted, self.folder / "same.vti")
        for name, form in ("q.nii", "SetQFormMatrix"), ("s.nii", "SetSFormMatrix"), ("s.nii.gz", "SetSFormMatrix"):
            writer = vtkNIFTIImageWriter()
            getattr(writer, form)(matrix)
            writer.SetInputData(image)
            writer.SetFileName(str(self.folder / name))
            writer.Write()
            self.check(name)
            self.check(name, "same.vti")

    def test_other_grids(self):
        ball = self.ball("ball.vtp", (0.03, 0.02, 0.01), 2.41)
        image = self.image()
        written(vtkXMLImageDataWriter(), image, self.folder / "reference.vti")
        others = {
            "dimensions.vti": lambda: image.SetDimensions(11, 13, 15),
            "origin.vti": lambda: image.SetOrigin(-3.0, -2.5, -3.9),
            "spacing.vti": lambda: image.SetSpacing(0.5, 0.5, 0.501),
            "direction.vti": lambda: image.SetDirectionMatrix(turned(1)),
        }
        for name, change in others.items():
            image = self.image()
            change()
            written(vtkXMLImageDataWriter(), image, self.folder / name)
            with self.subTest(name):
                text = self.complain(
                    INPUT, "--reference", "reference.vti", ball, "--unite", name, "out.vti",
                    naming=[name, "not on the grid", "extent (0, 12, 0, 10, 0, 14)", "--reference " + name])
                self.assertEqual(text.count("spacing ("), 2)
        self.complain(INPUT, "--resolution", 9, ball, "--unite", "reference.vti", "out.vti",
                      naming=["reference.vti", "not on the grid", "extent (0, 8, 0, 8, 0, 8)"])

    def test_damaged(self):
        ball = self.ball("ball.vtp", (0.03, 0.02, 0.01), 2.41)
        written(vtkXMLImageDataWriter(), self.image(), self.folder / "grid.vti")
        self.succeed("--reference", "grid.vti", ball, "whole.mha")
        self.succeed("--reference", "grid.vti", ball, "whole.binvox")
        self.file("whole.nrrd", b"NRRD0004\ntype: uchar\ndimension: 3\nspace dimension: 3\nsizes: 13 11 15\n"
                  b"space directions: (0.5,0,0) (0,0.5,0) (0,0,0.5)\nencoding: raw\n"
                  b"space origin: (-3,-2.5,-4)\n\n" + self.bits.tobytes())
        writer = vtkNIFTIImageWriter()
        writer.SetInputData(self.image())
        for name in "whole.nii", "whole.nii.gz":
            writer.SetFileName(str(self.folder / name))
            writer.Write()
        for whole in "grid.vti", "whole.mha", "whole.binvox", "whole.nrrd", "whole.nii", "whole.nii.gz":
            content = (self.folder / whole).read_bytes()
            for damage, damaged in {
                    "truncated": content[:-100], "short": content[:40], "header": content[:60], "empty": b"",
                    "text": b"This is no image at all, but prose.\n" * 40}.items():
                with self.subTest(whole=whole, damage=damage):
                    name = damage + whole[whole.index("."):]
                    self.file(name, damaged)
                    self.complain(INPUT, "--reference", "grid.vti", ball, "--unite", name, "out.vti",
                                  naming=["cannot read " + name])

    def test_image_without_scalars(self):
        image = self.image()
        image.GetPointData().Initialize()
        written(vtkXMLImageDataWriter(), image, self.folder / "bare.vti")
        ball = self.ball("ball.vtp", (0.03, 0.02, 0.01), 2.41)
        self.complain(INPUT, "--reference", "bare.vti", ball, "--unite", "bare.vti", "out.vti",
                      naming=["bare.vti", "scalars"])


class TestKernels(StepsTest):
    def test_spheres_of_vtk(self):
        ball = self.ball("ball.vtp", (0.03, 0.02, 0.01), 3.17)
        grid = ["--voxel-size", 0.5, "--padding", 12]
        self.succeed(*grid, ball, "ball.vti")
        reader = vtkXMLImageDataReader()
        reader.SetFileName(str(self.folder / "ball.vti"))
        for n, (step, grown, shrunk) in itertools.product((1, 2, 5), (("--dilate", 1, 0), ("--erode", 0, 1))):
            with self.subTest(n=n, step=step):
                changed = vtkImageDilateErode3D()
                changed.SetInputConnection(reader.GetOutputPort())
                changed.SetKernelSize(*3 * [2 * n + 1])
                changed.SetDilateValue(grown)
                changed.SetErodeValue(shrunk)
                changed.Update()
                wanted = vtk_to_numpy(changed.GetOutput().GetPointData().GetScalars()) != 0
                got = self.voxels(*grid, "--kernel", "sphere", step, n, ball)
                np.testing.assert_array_equal(got.bits.ravel(), wanted)
                self.assertTrue(wanted.any())

    def test_kernels(self):
        ball = self.ball("ball.vtp", (0.03, 0.02, 0.01), 3.17)
        grid = ["--voxel-size", 0.5, "--padding", 8]
        alone = self.voxels(*grid, ball).bits
        for kernel, n, (step, change) in itertools.product(KERNELS, (1, 3), CHANGES.items()):
            with self.subTest(kernel=kernel, n=n, step=step):
                got = self.voxels(*grid, "--kernel", kernel, step, n, ball)
                np.testing.assert_array_equal(got.bits, change(alone, kernel, n))

    def test_kernel_is_for_the_steps_after_it(self):
        ball = self.ball("ball.vtp", (0.03, 0.02, 0.01), 3.17)
        grid = ["--voxel-size", 0.5, "--padding", 8]
        got = self.voxels(*grid, "--dilate", 2, "--kernel", "faces6", "--erode", 1, "--erode=2", "--kernel=sphere",
                          "--dilate", 3, ball)
        wanted = self.voxels(*grid, ball).bits
        for step, kernel, n in (("--dilate", "box", 2), ("--erode", "faces6", 1), ("--erode", "faces6", 2),
                                ("--dilate", "sphere", 3)):
            wanted = CHANGES[step](wanted, kernel, n)
        np.testing.assert_array_equal(got.bits, wanted)


class TestComponents(StepsTest):
    GRID = ("--voxel-size", 0.5, "--bounds", "-6,6,-6,6,-6,6")

    def test_hollow_and_loose(self):
        """A shell with a ball inside, beside a smaller ball."""
        shell = [self.ball("a.vtp", (0.03, 0.02, 0.01), 4.17), "--subtract", self.ball("b.vtp", (0, 0, 0), 3.1),
                 "--unite", self.ball("c.vtp", (0.1, 0, 0), 1.1), "--unite", self.ball("d.vtp", (5, 5, 5), 0.9)]
        alone = self.voxels(*self.GRID, *shell).bits
        whole, kept = (self.voxels(*self.GRID, *shell, step).bits for step in COMPONENTS)
        np.testing.assert_array_equal(whole, filled(alone))
        np.testing.assert_array_equal(kept, largest(alone))
        self.assertTrue(kept.sum() < alone.sum() < whole.sum())
        both = self.voxels(*self.GRID, *shell, *COMPONENTS).bits
        np.testing.assert_array_equal(both, largest(whole))
        np.testing.assert_array_equal(self.voxels("--voxel-size", 0.5, *shell[:3], "--fill-holes").bits,
                                      self.voxels("--voxel-size", 0.5, *shell[:1]).bits)

    def noise(self, density=0.45):
        image = TestProgram.vtkImageData()
        image.SetDimensions(19, 14, 16)
        bits = np.random.default_rng(5).random((16, 14, 19)) < density
        image.GetPointData().SetScalars(numpy_to_vtk(bits.astype(np.uint8).ravel(), deep=True))
        written(vtkXMLImageDataWriter(), image, self.folder / "noise.vti")
        far = self.ball("far.vtp", (-50, 0, 0), 1)
        nothing = far + ": no voxel is set"
        return bits, ["--reference", "noise.vti", far, "--unite", "noise.vti"], [nothing]

    def test_connectivity(self):
        for (step, change), density, results in zip(COMPONENTS.items(), (0.92, 0.12), (2, 3), strict=True):
            bits, words, warnings = self.noise(density)
            found = set()
            for connectivity in 6, 18, 26:
                with self.subTest(step=step, connectivity=connectivity):
                    got = self.voxels(*words, "--connectivity", connectivity, step, warnings=warnings).bits
                    np.testing.assert_array_equal(got, change(bits, connectivity))
                    found.add(got.tobytes())
            self.assertEqual(len(found), results, "connectivities make a difference")
            self.assertTrue(bits.tobytes() not in found)

    def test_connectivity_is_for_the_steps_after_it(self):
        bits, words, warnings = self.noise()
        got = self.voxels(*words, "--keep-largest", "--connectivity=6", "--fill-holes", "--keep-largest", "--xor",
                          "noise.vti", "--connectivity", 18, "--keep-largest", warnings=warnings).bits
        wanted = largest(filled(largest(bits), 6), 6) ^ bits
        np.testing.assert_array_equal(got, largest(wanted, 18))

    def test_report(self):
        _, words, warnings = self.noise()
        wanted = self.voxels(*words, "--keep-largest", warnings=warnings).bits
        report = self.info(*words, "--keep-largest", "out.vti", warnings=warnings)
        self.assertEqual(int(report["filled voxels"].split()[0]), wanted.sum())


class TestSequences(StepsTest):
    SIZE = 0.5
    WIDE = 18  # more voxels than any of the sequences reaches

    def check(self, meshes, first, steps):
        """The program's result on its own grid is that of a wide one, which has nothing beyond."""
        words = ["--voxel-size", self.SIZE, first]
        kernel, connectivity, wanted = "box", 26, meshes[first]
        for step, *rest in steps:
            words += [step, *rest[:1]]
            if step == "--kernel":
                kernel = rest[0]
            elif step == "--connectivity":
                connectivity = rest[0]
            elif step == "--complement":
                wanted = ~wanted
            elif step in COMPONENTS:
                wanted = COMPONENTS[step](wanted, connectivity)
            elif step in JOINS:
                wanted = JOINS[step](wanted, meshes[rest[0]])
            else:
                wanted = CHANGES[step](wanted, kernel, rest[0])
        got = self.voxels(*words, warnings=warnings_of(wanted))
        place = np.rint((got.first - self.first) / self.SIZE)
        np.testing.assert_allclose(self.first + place * self.SIZE, got.first, atol=1e-9)
        x, y, z = place.astype(int)
        nz, ny, nx = got.bits.shape
        inside = np.zeros_like(wanted)
        inside[z:z + nz, y:y + ny, x:x + nx] = True
        self.assertEqual(inside.sum(), got.bits.size)
        np.testing.assert_array_equal(got.bits, wanted[inside].reshape(got.bits.shape))
        self.assertLessEqual(np.unique(wanted[~inside]).size, 1, "voxels are alike beyond the grid")

    def meshes(self, names):
        """Voxels of each mesh on a wide grid, whose lattice is that of the box around all."""
        lattice = ["--voxel-size", self.SIZE, "--padding", self.WIDE]
        whole = [word for name in names[1:] for word in ("--unite", name)]
        self.first = self.voxels(*lattice, names[0], *whole).first
        reference = ["--reference", "out.vti"]
        (self.folder / "out.vti").rename(self.folder / "wide.vti")
        reference = ["--reference", "wide.vti"]
        return {name: self.voxels(*reference, name).bits for name in names}

    def test_sequences(self):
        names = self.balls()[:3]
        meshes = self.meshes(names)
        sequences = [
            [("--dilate", 3)],
            [("--erode", 2)],
            [("--open", 3)],
            [("--close", 3)],
            [("--complement",)],
            [("--complement",), ("--erode", 3)],
            [("--complement",), ("--open", 3), ("--complement",)],
            [("--dilate", 2), ("--complement",), ("--dilate", 2)],
            [("--kernel", "sphere"), ("--close", 4), ("--xor", "a.vtp"), ("--dilate", 1)],
            [("--fill-holes",)],
            [("--subtract", "a.vtp"), ("--connectivity", 6), ("--keep-largest",), ("--dilate", 3), ("--fill-holes",)],
            [("--complement",), ("--fill-holes",)],
            [("--complement",), ("--fill-holes",), ("--intersect", "b.vtp"), ("--keep-largest",)],
        ]
        for steps in sequences:
            with self.subTest(steps=steps):
                # All meshes add, so that the lattice is that of all.
                self.check(meshes, "a.vtp", [("--unite", "b.vtp"), ("--unite", "c.vtp"), *steps])

    def test_random_sequences(self):
        names = self.balls()[:3]
        meshes = self.meshes(names)
        refused = 0
        for seed in range(60):
            rng = random.Random(seed)
            steps = [("--unite", "b.vtp")]
            for _ in range(rng.randrange(1, 6)):
                step = rng.choice([*JOINS, *CHANGES, *CHANGES, *COMPONENTS, "--complement"])
                if step in COMPONENTS:
                    steps.append(("--connectivity", rng.choice(list(NEIGHBOURS))))
                    steps.append((step,))
                elif step in JOINS:
                    steps.append((step, rng.choice(names)))
                elif step in CHANGES:
                    steps.append(("--kernel", rng.choice(KERNELS)))
                    steps.append((step, rng.randrange(1, 4)))
                else:
                    steps.append((step,))
            with self.subTest(seed=seed, steps=steps):
                if is_endless(steps):
                    self.complain(USAGE, "a.vtp", *itertools.chain(*steps), "out.vti", naming=["--keep-largest"])
                    refused += 1
                else:
                    self.check(meshes, "a.vtp", steps)
        self.assertTrue(0 < refused < 10, refused)


class TestGrids(StepsTest):
    def size(self, *words, **more):
        return self.voxels("--voxel-size", 1, *words, **more).bits.shape[::-1]

    def setUp(self):
        super().setUp()
        self.file("a.ply", ply_binary(*box((0, 0, 0), (6, 5, 4))))
        self.file("b.ply", ply_binary(*box((3, 0, 0), (10, 5, 4))))

    def test_meshes_that_add(self):
        wide, narrow = (10, 5, 4), (6, 5, 4)
        for steps, size in (
                (["--unite", "b.ply"], wide), (["--xor", "b.ply"], wide),
                (["--subtract", "b.ply"], narrow), (["--intersect", "b.ply"], narrow),
                (["--complement", "--intersect", "b.ply"], wide), (["--complement", "--xor", "b.ply"], wide),
                (["--complement", "--subtract", "b.ply"], wide),
                (["--complement", "--unite", "b.ply", "--complement"], narrow)):
            with self.subTest(steps):
                warnings = ["the steps leave none"] if steps == ["--complement", "--subtract", "b.ply"] else []
                self.assertEqual(self.size("a.ply", *steps, warnings=warnings), size)

    def test_room_for_steps(self):
        for steps, margin in (
                (["--dilate", 3], 4), (["--erode", 3], 1), (["--open", 3], 1), (["--close", 3], 4),
                (["--dilate", 3, "--erode", 3, "--dilate", 2], 4), (["--dilate", 3, "--dilate", 2], 6),
                (["--complement", "--erode", 3], 4), (["--complement", "--dilate", 3], 1),
                (["--complement"], 0), (["--fill-holes"], 0), (["--keep-largest"], 0),
                (["--complement", "--fill-holes"], 1), (["--fill-holes", "--dilate", 2], 3)):
            with self.subTest(steps):
                warnings = ["the steps leave none"] if steps in (
                    ["--erode", 3], ["--open", 3], ["--complement"]) else []
                self.assertEqual(self.size("a.ply", *steps, warnings=warnings),
                                 tuple(n + 2 * margin for n in (6, 5, 4)))

    def test_grids_of_the_user(self):
        steps = ["--dilate", 2, "--unite", "b.ply"]
        self.assertEqual(self.size("a.ply", *steps, "--padding", 1), (12, 7, 6))
        self.assertEqual(self.size("a.ply", *steps, "--bounds", "0,4,0,4,0,4"), (4, 4, 4))
        self.assertEqual(self.size("a.ply", *steps, "--bounds", "0,4,0,4,0,4", "--padding", 1), (6, 6, 6))
        self.succeed("--voxel-size", 1, "a.ply", "a.vti")
        got = self.voxels("--reference", "a.vti", "a.ply", *steps)
        self.assertEqual(got.bits.shape, (4, 5, 6))

    def test_borders_change_nothing(self):
        """A box that fills its grid is neither eroded from the border, nor opened, nor closed there."""
        for step in "--dilate", "--erode", "--open", "--close":
            with self.subTest(step):
                got = self.voxels("--voxel-size", 1, "--padding", 0, "a.ply", step, 2)
                self.assertEqual(got.bits.shape, (4, 5, 6))
                self.assertTrue(got.bits.all())

    def test_resolution_and_dimensions(self):
        got = self.voxels("--resolution", 20, "a.ply", "--unite", "b.ply", "--dilate", 1)
        self.assertEqual(got.bits.shape, (12, 14, 24))
        np.testing.assert_allclose(got.spacing, 0.5)
        got = self.voxels("--dimensions", "20,10,8", "a.ply", "--unite", "b.ply", "--dilate", 1)
        self.assertEqual(got.bits.shape, (12, 14, 24))

    def test_too_large(self):
        self.complain(VOXELIZATION, "a.ply", "--dilate", 100000, "out.vti", naming=["voxels"])
        self.complain(VOXELIZATION, "a.ply", "--dilate", 134217727, "--dilate", 134217727, "--close", 134217727,
                      "--dilate", 134217727, "--dilate", 134217727, "out.vti", naming=["voxels"])


class TestOutputs(StepsTest):
    WORDS = ("--voxel-size", 0.5, "a.vtp", "--unite", "b.vtp", "--dilate", 1)

    def test_formats(self):
        self.balls()
        wanted = self.voxels(*self.WORDS).bits
        for name, read in ("a.vti", read_vti), ("a.mha", read_meta), ("a.mhd", read_meta), ("a.binvox", read_binvox):
            with self.subTest(name):
                self.succeed(*self.WORDS, name)
                np.testing.assert_array_equal(Grid(read(self.folder / name)).bits, wanted)

    def test_forms(self):
        self.balls()
        wanted = self.voxels(*self.WORDS)
        got = self.voxels(*self.WORDS, "--cells")
        np.testing.assert_array_equal(got.bits, wanted.bits)
        np.testing.assert_allclose(got.first, wanted.first)
        self.succeed(*self.WORDS, "--type", "bit", "bits.vti")
        image = read_vti(self.folder / "bits.vti")
        self.assertEqual(image.scalars.GetClassName(), "vtkBitArray")
        self.assertEqual(image.values(), wanted.bits.ravel().astype(int).tolist())
        self.succeed(*self.WORDS, "--value", 200, "value.vti")
        image = read_vti(self.folder / "value.vti")
        self.assertEqual(image.values(), (200 * wanted.bits.ravel().astype(int)).tolist())

    def test_report_is_of_the_result(self):
        self.balls()
        wanted = self.voxels(*self.WORDS)
        triangles = sum(ball((0, 0, 0), 1).GetNumberOfPolys() for _ in range(2))
        for options, name in ([], "a.vti"), (["--cells"], "a.vti"), ([], "a.mha"):
            report = self.info(*self.WORDS, *options, name)
            count = int(wanted.bits.sum())
            self.assertEqual(int(report["filled voxels"].split()[0]), count)
            self.assertAlmostEqual(float(report["filled volume"]), count * 0.125, places=3)
            self.assertEqual(report["voxels"], " x ".join(map(str, wanted.bits.shape[::-1])))
            self.assertEqual(report["triangles"], str(triangles))
            self.assertEqual(report["leaking columns"], "0")
            for task in "reading", "voxelizing", "writing":
                self.assertRegex(report[task], r"^[0-9.e+-]+ ms$")

    def test_picture(self):
        self.balls()
        self.succeed(*self.WORDS, "--picture", "steps.png", "a.vti")
        (self.folder / "steps.png").rename(self.folder / "first.png")
        self.succeed(*self.WORDS, "--cells", "--picture", "steps.png", "a.vti")
        self.assertEqual((self.folder / "first.png").read_bytes(), (self.folder / "steps.png").read_bytes())

    def test_warnings_name_the_mesh(self):
        self.balls()
        self.file("open.ply", ply_binary(*TestProgram.open_box()))
        self.succeed("--voxel-size", 0.5, "--axis", "x", "a.vtp", "--unite", "open.ply", "a.vti",
                     warnings=["open.ply: "])
        self.succeed("--voxel-size", 0.5, "a.vtp", "--subtract", "d.vtp", "a.vti",
                     warnings=["d.vtp: no voxel is set"])
        self.succeed("--voxel-size", 0.5, "a.vtp", "--intersect", "d.vtp", "--quiet", "a.vti")
        self.succeed("--voxel-size", 0.5, "a.vtp", "--subtract", "a.vtp", "a.vti", warnings=["the steps leave none"])


class TestErrors(StepsTest):
    def test_values(self):
        for option in "--unite", "--intersect", "--subtract", "--xor":
            with self.subTest(option):
                self.complain(USAGE, option, "", "a.ply", "b.vti", naming=[option, "name of a file"])
                self.complain(USAGE, "a.ply", "b.vti", option, naming=[option, "needs a value"])
        for option in CHANGES:
            for value in "", "x", "1.5", "0", "-3", "3x", "99999999999", "134217728", "--quiet":
                with self.subTest(option=option, value=value):
                    self.complain(USAGE, option, value, "a.ply", "b.vti",
                                  naming=[option, f"'{value}'"] if value else [option])
            with self.subTest(option=option, value=None):
                self.complain(USAGE, "a.ply", "b.vti", option, naming=[option, "needs a value"])
            with self.subTest(option=option, value="sphere"):
                self.complain(USAGE, "--kernel", "sphere", option, 32, "a.ply", "b.vti",
                              naming=[option, "'32'", "most is 31"])
        for value in "", "cube", "Box":
            with self.subTest(value):
                self.complain(USAGE, "--kernel", value, "--dilate", 1, "a.ply", "b.vti", naming=["--kernel", "faces6"])
        self.complain(USAGE, "--complement=1", "a.ply", "b.vti", naming=["--complement", "no value"])

    def test_idle_kernels(self):
        for words in (["--kernel", "box"], ["--dilate", 1, "--kernel", "box"],
                      ["--kernel", "box", "--kernel", "sphere", "--dilate", 1], ["--kernel", "box", "--unite", "c.ply"]):
            with self.subTest(words):
                self.complain(USAGE, *words, "a.ply", "b.vti", naming=["--kernel", "--dilate"])

    def test_connectivity(self):
        for value in "", "4", "27", "corners26":
            with self.subTest(value):
                self.complain(USAGE, "--connectivity", value, "--fill-holes", "a.ply", "b.vti",
                              naming=["--connectivity", "6, 18, 26"])
        for words in (["--connectivity", 6], ["--fill-holes", "--connectivity", 6],
                      ["--connectivity", 6, "--connectivity", 18, "--keep-largest"],
                      ["--connectivity", 6, "--dilate", 1]):
            with self.subTest(words):
                self.complain(USAGE, *words, "a.ply", "b.vti", naming=["--connectivity", "--fill-holes"])
        for step in COMPONENTS:
            self.complain(USAGE, step + "=1", "a.ply", "b.vti", naming=[step, "no value"])

    def test_components_without_end(self):
        ball = self.ball("a.vtp", (0, 0, 0), 1)
        words = [ball, "--complement", "--keep-largest", "out.vti"]
        self.complain(USAGE, *words, naming=["--keep-largest", "--complement", "--bounds", "--padding"])
        self.succeed("--resolution", 8, *words[:3], "reference.vti", "--padding", 1)
        for grid in ["--padding", 1], ["--bounds", "-2,2,-2,2,-2,2"], ["--reference", "reference.vti"]:
            self.succeed(*grid, *words)
        self.succeed(ball, "--complement", "--complement", "--keep-largest", "out.vti")
        self.succeed(ball, "--complement", "--intersect", ball, "--keep-largest", "out.vti",
                     warnings=["the steps leave none"])

    def test_outputs_without_steps(self):
        for step in ["--unite", "c.ply"], ["--complement"], ["--dilate", 2], ["--fill-holes"]:
            for name in "b.vtp", "b.htg":
                with self.subTest(step=step, name=name):
                    self.complain(USAGE, "--method", "surface", *step, "a.ply", name, naming=[step[0], name, ".vti"])
            for option in ["--attributes", "RGB"], ["--texture", "t.png"]:
                with self.subTest(step=step, option=option):
                    self.complain(USAGE, "--method", "surface", *option, *step, "a.ply", "b.vti",
                                  naming=[step[0], option[0]])

    def test_files(self):
        ball = self.ball("a.vtp", (0, 0, 0), 1)
        for name in "none.stl", "none.vti":
            self.complain(INPUT, ball, "--unite", name, "out.vti", naming=[name, "No such file"])
        self.complain(INPUT, ball, "--unite", ".", "out.vti", naming=["folder"])
        self.file("mesh.dae", b"x")
        self.complain(INPUT, ball, "--xor", "mesh.dae", "out.vti", naming=["mesh.dae", ".stl", ".mha"])
        self.file("mesh", b"x")
        self.complain(INPUT, ball, "--xor", "mesh", "out.vti", naming=["mesh: ", ".stl", ".mha"])
        self.file("bad.ply", b"This is no mesh at all, but prose.\n" * 40)
        self.complain(INPUT, ball, "--subtract", "bad.ply", "out.vti", naming=["cannot read bad.ply"])
        self.complain(USAGE, ball, "--subtract", "b.vti", "b.vti", naming=["--subtract", "OUTPUT", "b.vti"])
        self.complain(USAGE, ball, "--unite", "b.png", "--picture", "b.png", "b.vti", naming=["--unite", "--picture"])


class TestHelp(ProgramTest):
    def test_help(self):
        text = self.succeed("--help")
        for word in (*JOINS, *CHANGES, *KERNELS, *COMPONENTS, "--connectivity", "--complement", "--kernel", ".nii.gz", "in the order given"):
            self.assertIn(word, text)


if __name__ == "__main__":
    TestProgram.main()
