"""Proves what vtkvoxelize promises of volumes as INPUT.

Voxels are those that NumPy finds in the scalars: of level sets, ranges, labels and masks, of all types of
scalars, in all formats, of points and of cells, on the very grid of the image. Steps go on from there, and
join them with meshes and masks on that grid. Outputs and reports are those of meshes, and there is one
error for each option that only meshes have, and for each damaged file.

    TestProgramVolumes.py --program vtkvoxelize -D DATA_DIRECTORY [-T SCRATCH_DIRECTORY]
"""

import gzip
import itertools
import random

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkBitArray
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkIOImage import vtkNIFTIImageWriter
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

import TestProgram
from TestProgram import (
    INPUT, USAGE, ProgramTest, obj, ply_binary, box, read_binvox, read_meta, read_vti, turned, written)
from TestProgramSteps import CHANGES, Grid, StepsTest, filled, largest

SHAPE = 15, 11, 13  # z, y, x
SPACING = 0.5, 0.4, 0.6
ORIGIN = -2.0, -4.5, -4.0


def hounsfield(dtype=np.int16):
    """Two balls of tissue around hollow bones, with noise."""
    z, y, x = np.indices(SHAPE)
    near = np.minimum((x - 4) ** 2 + (y - 5) ** 2 + (z - 5) ** 2, 1.7 * ((x - 9) ** 2 + (y - 6) ** 2 + (z - 11) ** 2))
    values = 900 - 65 * np.abs(near - 7) + np.random.default_rng(3).integers(-40, 40, SHAPE)
    return np.clip(values, -1000, 1000).astype(dtype)


def image_of(values, cells=False, direction=None, spacing=SPACING, origin=ORIGIN, first=(0, 0, 0)):
    """The first voxel is at the origin if it has the index 0, whether it is a point or a cell."""
    image = TestProgram.vtkImageData()
    nz, ny, nx = values.shape[:3]
    more = int(cells)
    image.SetExtent(*(x for n, low in zip((nx, ny, nz), first) for x in (low, low + n - 1 + more)))
    image.SetSpacing(spacing)
    image.SetOrigin(origin)
    image.SetDirectionMatrix(direction or turned(0))
    if cells:
        half = [0.0, 0.0, 0.0]
        image.TransformContinuousIndexToPhysicalPoint(-0.5, -0.5, -0.5, half)
        image.SetOrigin(half)
    array = numpy_to_vtk(np.ascontiguousarray(values).reshape(nx * ny * nz, -1), deep=True)
    (image.GetCellData() if cells else image.GetPointData()).SetScalars(array)
    return image


def ints(numbers):
    return " ".join(map(repr, numbers))


class VolumesTest(StepsTest):
    def volume(self, name="ct.vti", values=None, **more):
        self.values = hounsfield() if values is None else values
        written(vtkXMLImageDataWriter(), image_of(self.values, **more), self.folder / name)
        return name

    def check(self, wanted, *words, **more):
        warnings = [] if wanted.any() else ["no voxel is set"]
        got = self.voxels(*words, warnings=warnings, **more)
        np.testing.assert_array_equal(got.bits, wanted)
        return got


class TestSelections(VolumesTest):
    def test_level_sets_ranges_and_labels(self):
        ct = self.volume()
        v = self.values
        level = int(v[7, 5, 6])
        for words, wanted in (
                (["--iso", 300], v >= 300), (["--iso", level], v >= level), (["--iso", level + 0.5], v > level),
                (["--iso=-200"], v >= -200), (["--iso", 1e9], v > 1e9), (["--iso", "-1e300"], v > -9999),
                (["--range", f"-200,{level}"], (v >= -200) & (v <= level)),
                (["--range=100,inf"], v >= 100), (["--range", "-inf,100"], v <= 100),
                (["--range", f"{level},{level}"], v == level), (["--label", level], v == level),
                (["--label", 0.5], v > 1e9), ([], v != 0)):
            with self.subTest(words):
                self.check(wanted, *words, ct)
                self.check(wanted, ct, *words)

    def test_types_of_scalars(self):
        for dtype in (np.int8, np.uint8, np.int16, np.uint16, np.int32, np.uint32, np.int64, np.uint64, np.float32,
                      np.float64):
            labels = np.random.default_rng(4).integers(0, 5, SHAPE).astype(dtype)
            with self.subTest(dtype):
                name = self.volume("labels.vti", labels)
                self.check(labels == 3, name, "--label", 3)
                self.check(labels != 0, name)
                self.check(labels >= 2, name, "--iso", 1.5)

    def test_values_that_are_no_numbers(self):
        values = hounsfield(np.float32)
        values[3:5] = np.nan
        values[5] = np.inf
        values[6] = -np.inf
        name = self.volume("ct.vti", values)
        with np.errstate(invalid="ignore"):
            self.check(values >= 0, name, "--iso", 0)
            self.check(values <= 0, name, "--range=-inf,0")

    def test_bits(self):
        bits = np.random.default_rng(4).integers(0, 2, SHAPE)
        image = image_of(bits.astype(np.uint8))
        array = vtkBitArray()
        for bit in bits.ravel():
            array.InsertNextValue(int(bit))
        image.GetPointData().SetScalars(array)
        written(vtkXMLImageDataWriter(), image, self.folder / "bits.vti")
        for words in [], ["--label", 1], ["--iso", 1]:
            self.check(bits == 1, "bits.vti", *words)
        self.assertEqual(self.info("bits.vti", "out.vti")["scalars"], "bit, 0 to 1")

    def test_first_component_counts(self):
        colors = np.random.default_rng(4).integers(0, 256, (*SHAPE, 3)).astype(np.uint8)
        name = self.volume("colors.vti", colors)
        self.check(colors[..., 0] >= 100, name, "--iso", 100)


class TestGrids(VolumesTest):
    def same_place(self, got, direction, first=(0, 0, 0)):
        image = image_of(self.values, direction=direction)
        place = [0.0, 0.0, 0.0]
        image.TransformContinuousIndexToPhysicalPoint(*first, place)
        np.testing.assert_allclose(got.first, place, atol=1e-12)
        np.testing.assert_allclose(got.spacing, SPACING)

    def test_points_and_cells(self):
        """Voxels are points of the output, unless --cells asks for cells, whatever they were in the volume."""
        for cells, options, words in itertools.product((False, True), ([], ["--cells"]), ([], ["--erode", 1])):
            with self.subTest(cells=cells, options=options, words=words):
                ct = self.volume(cells=cells, direction=turned(30))
                wanted = self.values >= 300
                wanted = CHANGES["--erode"](wanted, "box", 1) if words else wanted
                self.same_place(self.check(wanted, ct, "--iso", 300, *words, *options), turned(30))
                image = read_vti(self.folder / "out.vti")
                self.assertEqual(image.cells, bool(options))
                np.testing.assert_allclose(
                    [image.data.GetDirectionMatrix().GetElement(i // 3, i % 3) for i in range(9)], turned(30))

    def test_indices_are_kept(self):
        for cells in False, True:
            ct = self.volume(first=(4, -3, 20), cells=cells)
            self.same_place(self.check(self.values >= 300, ct, "--iso", 300), None, (4, -3, 20))
            self.assertEqual(read_vti(self.folder / "out.vti").extent, (4, 16, -3, 7, 20, 34))

    def test_thin(self):
        for shape in (1, 11, 13), (1, 1, 40), (1, 1, 1), (3, 1, 2):
            values = np.random.default_rng(4).integers(0, 9, shape).astype(np.int16)
            values.flat[0] = 5
            with self.subTest(shape):
                self.check(values >= 4, self.volume("thin.vti", values), "--iso", 4)


class TestFormats(VolumesTest):
    """Of a turned image of shorts."""

    def all_formats(self):
        d = turned(30)
        self.volume("ct.vti", direction=d)
        raw = self.values.astype("<i2").tobytes()
        columns = ints(d[3 * (i % 3) + i // 3] for i in range(9))
        head = ("ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
                f"TransformMatrix = {columns}\nOffset = {ints(ORIGIN)}\nElementSpacing = {ints(SPACING)}\n"
                f"DimSize = {ints(SHAPE[::-1])}\nElementType = MET_SHORT\nElementDataFile = ").encode()
        self.file("ct.mha", head + b"LOCAL\n" + raw)
        self.file("ct.mhd", head + b"mhd.raw\n")
        self.file("mhd.raw", raw)
        vectors = " ".join("(%r,%r,%r)" % tuple(d[3 * row + axis] * SPACING[axis] for row in range(3))
                           for axis in range(3))
        nrrd = ("NRRD0004\ntype: short\ndimension: 3\nspace dimension: 3\n" f"sizes: {ints(SHAPE[::-1])}\n"
                f"space directions: {vectors}\nkinds: domain domain domain\nendian: little\nencoding: %s\n"
                "space origin: (%r,%r,%r)\n%%s\n" % ("%s", *ORIGIN))
        self.file("ct.nrrd", (nrrd % ("raw", "")).encode() + raw)
        self.file("gzip.nrrd", (nrrd % ("gzip", "")).encode() + gzip.compress(raw))
        self.file("ct.nhdr", (nrrd % ("raw", "data file: nhdr.raw\n")).encode())
        self.file("nhdr.raw", raw)
        matrix = vtkMatrix4x4()
        for row, column in itertools.product(range(3), repeat=2):
            matrix.SetElement(row, column, d[3 * row + column])
        for row, value in enumerate(ORIGIN):
            matrix.SetElement(row, 3, value)
        for name in "ct.nii", "ct.nii.gz":
            writer = vtkNIFTIImageWriter()
            writer.SetQFormMatrix(matrix)
            writer.SetInputData(image_of(self.values, origin=(0, 0, 0)))
            writer.SetFileName(str(self.folder / name))
            writer.Write()
        return "ct.vti", "ct.mha", "ct.mhd", "ct.nrrd", "gzip.nrrd", "ct.nhdr", "ct.nii", "ct.nii.gz"

    def test_formats(self):
        image = image_of(hounsfield(), direction=turned(30))
        for name in self.all_formats():
            with self.subTest(name):
                got = self.check(self.values >= 300, name, "--iso", 300)
                np.testing.assert_allclose(got.first, image.GetOrigin(), atol=1e-6)
                np.testing.assert_allclose(got.spacing, SPACING, atol=1e-6)

    def test_slope_and_intercept(self):
        """Of NIfTI: 300 are Hounsfield units, whatever stands for them in the file."""
        for name, (slope, intercept) in itertools.product(
                ("a.nii", "a.nii.gz"), ((1, -1024), (0.5, 0), (0.25, 100.5), (-2, 7), (0, 50))):
            values = hounsfield()
            writer = vtkNIFTIImageWriter()
            writer.SetRescaleSlope(slope)
            writer.SetRescaleIntercept(intercept)
            writer.SetInputData(image_of(values))
            writer.SetFileName(str(self.folder / name))
            writer.Write()
            scaled = values * slope + intercept if slope else values
            with self.subTest(name=name, slope=slope, intercept=intercept):
                self.check(scaled >= -300, name, "--iso", -300)
                self.check(scaled != 0, name)
                self.check(scaled == scaled[3, 3, 3], name, "--label", float(scaled[3, 3, 3]))

    def test_own_outputs(self):
        """What the program has written it takes as INPUT."""
        mesh = self.ball("a.vtp", (0.03, 0.02, 0.01), 4.17)
        wanted = self.voxels("--voxel-size", 0.5, mesh)
        for name, *options in (
                ("b.vti",), ("bits.vti", "--type", "bit"), ("cells.vti", "--cells"), ("value.vti", "--value", 7),
                ("b.mha",), ("b.mhd",), ("b.binvox",)):
            with self.subTest(name):
                self.succeed("--voxel-size", 0.5, *options, mesh, name)
                got = self.voxels(name)
                np.testing.assert_array_equal(got.bits, wanted.bits)
                np.testing.assert_allclose(got.first, wanted.first, atol=1e-6)

    def test_damaged(self):
        names = self.all_formats()
        self.succeed("--voxel-size", 0.5, self.ball("a.vtp", (0, 0, 0), 1), "ct.binvox")
        for whole in *names, "ct.binvox":
            content = (self.folder / whole).read_bytes()
            for damage, damaged in {
                    "truncated": content[:-200], "short": content[:40], "header": content[:60], "empty": b"",
                    "text": b"This is no image at all, but prose.\n" * 40}.items():
                if damage == "truncated" and whole in ("ct.mhd", "ct.nhdr", "ct.binvox"):
                    continue
                with self.subTest(whole=whole, damage=damage):
                    name = damage + whole[whole.index("."):]
                    self.file(name, damaged)
                    self.complain(INPUT, name, "--iso", 300, "out.vti", naming=["cannot read " + name])

    def test_random_damage(self):
        """Whatever the damage, there is an output or one error."""
        for name in "ct.vti", "ct.mha", "ct.nrrd", "ct.nii":
            whole = (self.folder / self.all_formats()[0]).parent.joinpath(name).read_bytes()
            for seed in range(12):
                rng = random.Random(seed)
                content = bytearray(whole)
                for _ in range(rng.randrange(1, 6)):
                    content[rng.randrange(min(len(content), 600))] = rng.randrange(256)
                damaged = self.file("damaged" + name[2:], bytes(content)).name
                with self.subTest(name=name, seed=seed):
                    done = self.call(damaged, "--iso", 300, "out.vti", "--quiet")
                    self.assertIn(done.returncode, (0, INPUT, 3), done.stderr)
                    self.assertEqual(len(done.stderr.splitlines()), int(done.returncode != 0), done.stderr)


class TestSteps(VolumesTest):
    def test_steps(self):
        ct = self.volume()
        bone = self.values >= 500
        for words, wanted in (
                (["--fill-holes"], filled(bone)), (["--keep-largest"], largest(bone)),
                (["--keep-largest", "--fill-holes"], filled(largest(bone))),
                (["--connectivity", 6, "--keep-largest"], largest(bone, 6)),
                (["--complement"], ~bone), (["--complement", "--keep-largest"], largest(~bone)),
                (["--kernel", "sphere", "--close", 1], CHANGES["--close"](bone, "sphere", 1)),
                (["--dilate", 2], CHANGES["--dilate"](bone, "box", 2)),
                (["--kernel", "faces6", "--erode", 1], CHANGES["--erode"](bone, "faces6", 1))):
            with self.subTest(words):
                got = self.voxels(ct, "--iso", 500, *words)
                np.testing.assert_array_equal(got.bits, wanted)
                self.assertFalse((wanted == bone).all())

    def test_meshes_and_masks(self):
        ct = self.volume(direction=turned(30))
        bone = self.values >= 500
        center = [0.0, 0.0, 0.0]
        image_of(self.values, direction=turned(30)).TransformContinuousIndexToPhysicalPoint(8, 5, 5, center)
        mesh = self.ball("implant.vtp", center, 1.3)
        mask = np.random.default_rng(9).integers(0, 2, SHAPE).astype(np.uint8)
        written(vtkXMLImageDataWriter(), image_of(mask, direction=turned(30)), self.folder / "mask.vti")
        for options in [], ["--mode", "over"], ["--fill", "nonzero", "--axis", "y"], ["--backend", "raster"], [
                "--method", "surface", "--separability", 6]:
            implant = self.voxels("--reference", ct, mesh, *options).bits
            self.assertTrue((implant & ~bone).any() and (implant & bone).any() and (bone & ~implant).any())
            for step, wanted in (("--unite", bone | implant), ("--subtract", bone & ~implant),
                                 ("--intersect", bone & implant), ("--xor", bone ^ implant)):
                with self.subTest(step=step, options=options):
                    np.testing.assert_array_equal(self.voxels(ct, "--iso", 500, step, mesh, *options).bits, wanted)
        got = self.voxels(ct, "--range", "500,900", "--subtract", "mask.vti", "--unite", mesh)
        implant = self.voxels("--reference", ct, mesh).bits
        np.testing.assert_array_equal(got.bits, bone & (self.values <= 900) & (mask == 0) | implant)
        np.testing.assert_array_equal(self.voxels("mask.vti", "--xor", "mask.vti", "--unite", mesh).bits, implant)

    def test_mask_on_another_grid(self):
        ct = self.volume()
        self.volume("other.vti", origin=(0, 0, 0))
        text = self.complain(INPUT, ct, "--unite", "other.vti", "out.vti", naming=["other.vti", "not on the grid"])
        self.assertNotIn("--reference", text)

    def test_bunny_of_a_volume(self):
        """The voxels of a mesh, by way of a file, take steps as the mesh itself does."""
        grid = ["--resolution", 40, "--padding", 3, TestProgram.BUNNY]
        self.succeed(*grid, "bunny.vti")
        for steps in ["--close", 3, "--erode", 1], ["--complement", "--keep-largest"]:
            np.testing.assert_array_equal(self.voxels("bunny.vti", *steps).bits, self.voxels(*grid, *steps).bits)


class TestOutputs(VolumesTest):
    def test_formats(self):
        ct = self.volume(spacing=(0.5, 0.5, 0.5))
        for name, read in ("a.vti", read_vti), ("a.mha", read_meta), ("a.mhd", read_meta), ("a.binvox", read_binvox):
            for steps in [], ["--keep-largest"]:
                with self.subTest(name=name, steps=steps):
                    self.succeed(ct, "--iso", 500, *steps, name)
                    bone = self.values >= 500
                    np.testing.assert_array_equal(Grid(read(self.folder / name)).bits,
                                                  largest(bone) if steps else bone)
        self.succeed(ct, "--iso", 500, "--type", "bit", "bits.vti")
        image = read_vti(self.folder / "bits.vti")
        self.assertEqual(image.scalars.GetClassName(), "vtkBitArray")
        self.succeed(ct, "--iso", 500, "--value", 200, "value.vti")
        scalars = vtk_to_numpy(read_vti(self.folder / "value.vti").scalars).reshape(SHAPE)
        np.testing.assert_array_equal(scalars, 200 * (self.values >= 500))

    def test_report(self):
        ct = self.volume(direction=turned(30), first=(1, 2, 3))
        mesh = self.ball("a.vtp", (0, 0, 0), 2.5)
        count = int((self.values >= 500).sum())
        for options in [], ["--cells"]:
            report = self.info(ct, "--iso", 500, *options, "out.vti")
            self.assertEqual(report["scalars"], f"short, {self.values.min()} to {self.values.max()}")
            self.assertEqual(report["voxels"], "13 x 11 x 15")
            self.assertEqual(report["spacing"], "0.5 0.4 0.6")
            self.assertEqual(report["first index"], "1 2 3")
            self.assertIn("direction", report)
            self.assertEqual(int(report["filled voxels"].split()[0]), count)
            self.assertAlmostEqual(float(report["filled volume"]), count * 0.12, places=4)
            self.assertTrue(report["renderer"])
            for task in "reading", "voxelizing", "writing":
                self.assertRegex(report[task], r"^[0-9.e+-]+ ms$")
            for name in "triangles", "leaking columns", "backend":
                self.assertNotIn(name, report)
        report = self.info(ct, "--iso", 500, "--unite", mesh, "out.vti")
        self.assertGreater(int(report["triangles"]), 100)
        self.assertEqual(report["leaking columns"], "0")
        self.assertIn(report["backend"], ("compute", "raster"))
        self.assertIn("scalars", report)
        report = self.info(ct, "--unite", mesh, "--method", "surface", "out.vti")
        self.assertNotIn("leaking columns", report)
        self.assertNotIn("scalars", self.info(mesh, "out.vti"))

    def test_picture(self):
        """That of the voxels of a mesh, by way of a file."""
        grid = ["--resolution", 24, self.ball("a.vtp", (0, 0, 0), 2.5)]
        self.succeed(*grid, "--picture", "mesh.png", "a.vti")
        self.succeed("a.vti", "--iso", 1, "--picture", "volume.png", "b.vti")
        self.assertEqual((self.folder / "mesh.png").read_bytes(), (self.folder / "volume.png").read_bytes())

    def test_warnings(self):
        ct = self.volume()
        self.succeed(ct, "--iso", 5000, "out.vti", warnings=["no voxel is set: the volume has no such scalars"])
        self.succeed(ct, "--iso", 5000, "--complement", "out.vti", warnings=[ct + ": no voxel is set"])
        self.succeed(ct, "--iso", 500, "--subtract", ct, "out.vti", warnings=["the steps leave none"])
        self.succeed(ct, "--iso", 5000, "out.vti", "--quiet")


class TestErrors(VolumesTest):
    def test_values(self):
        bad = {
            "--iso": ["", "x", "nan", "inf", "-inf", "1,2", "300HU"],
            "--label": ["", "x", "nan", "inf", "1,2"],
            "--range": ["", "1", "1,2,3", "2,1", "inf,-inf", "nan,1", "1,nan", "1,x", "1,", ",1"],
        }
        for option, values in bad.items():
            for value in values:
                with self.subTest(option=option, value=value):
                    self.complain(USAGE, option, value, "ct.mha", "b.vti", naming=[option])
            self.complain(USAGE, "ct.mha", "b.vti", option, naming=[option, "needs a value"])
            self.complain(USAGE, option, "1,2", option, "1,2", "ct.mha", "b.vti", naming=[option]
                          + ["twice"] * (option == "--range"))
        self.complain(USAGE, "--range", "2,1", "ct.mha", "b.vti", naming=["'2,1'", "lower end"])

    def test_one_selection(self):
        for one, other in itertools.combinations((["--iso", 1], ["--range", "1,2"], ["--label", 3]), 2):
            with self.subTest(one=one, other=other):
                self.complain(USAGE, *one, *other, "ct.mha", "b.vti", naming=[one[0], other[0], "scalars"])

    def test_meshes(self):
        for words in ["--iso", 1], ["--range", "1,2"], ["--label", 3]:
            for mesh in "a.ply", "a.vtk", "a", "a.dae":
                with self.subTest(words=words, mesh=mesh):
                    self.complain(USAGE, *words, mesh, "b.vti", naming=[words[0], "volume", mesh, ".nii.gz"])

    def test_options_of_grids(self):
        for option, value in (("--resolution", 9), ("--dimensions", "9,9,9"), ("--voxel-size", 1), ("--padding", 1),
                              ("--bounds", "0,1,0,1,0,1"), ("--reference", "r.vti")):
            for words in [], ["--iso", 300], ["--unite", "a.ply"]:
                with self.subTest(option=option, words=words):
                    self.complain(USAGE, option, value, *words, "ct.mha", "b.vti",
                                  naming=[option, "ct.mha", "the grid is that of the volume"])

    def test_options_of_meshes(self):
        for option in ("--method=surface", "--method=solid", "--backend=raster", "--mode=over", "--fill=vote",
                       "--axis=x", "--separability=6"):
            for words in [], ["--iso", 300], ["--unite", "mask.vti", "--dilate", 1]:
                with self.subTest(option=option, words=words):
                    self.complain(USAGE, option, *words, "ct.mha", "b.vti",
                                  naming=[option.split("=")[0], "ct.mha", "for meshes"])
        for option in "--attributes=RGB", "--texture=t.png", "--combine=min":
            for words in [], ["--method", "surface", "--unite", "a.ply"]:
                with self.subTest(option=option, words=words):
                    self.complain(USAGE, option, *words, "ct.mha", "b.vti",
                                  naming=[option.split("=")[0], "ct.mha", "volume"])
        for words in [], ["--method", "surface", "--unite", "a.ply"]:
            for name in "b.vtp", "b.htg":
                with self.subTest(words=words, name=name):
                    self.complain(USAGE, *words, "ct.mha", name, naming=["ct.mha", name, ".vti"])
        self.complain(USAGE, "--mode=over", "--method=surface", "--unite", "a.ply", "ct.mha", "b.vti",
                      naming=["--mode", "--method surface"])

    def test_files(self):
        self.complain(INPUT, "none.mha", "--iso", 3, "out.vti", naming=["none.mha", "No such file"])
        (self.folder / "folder.vti").mkdir()
        self.complain(INPUT, "folder.vti", "out.vti", naming=["folder"])
        self.complain(USAGE, "a.vti", "a.vti", naming=["INPUT", "OUTPUT", "a.vti"])
        image = image_of(hounsfield())
        image.GetPointData().Initialize()
        written(vtkXMLImageDataWriter(), image, self.folder / "bare.vti")
        self.complain(INPUT, "bare.vti", "out.vti", naming=["bare.vti", "scalars"])
        ct = self.volume()
        self.complain(INPUT, ct, "--unite", "none.stl", "out.vti", naming=["none.stl", "No such file"])


class TestHelp(ProgramTest):
    def test_help(self):
        text = self.succeed("--help")
        for word in "--iso V", "--range LOWER,UPPER", "--label V", "--fill-holes", "or a volume", ".nii.gz":
            self.assertIn(word, text)
        self.assertLessEqual(max(map(len, text.splitlines())), 100)


if __name__ == "__main__":
    TestProgram.main()
