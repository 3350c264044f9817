"""Proves what vtkvoxelize promises of --method tetra: variants in one .bits file and in a file each are those that
the class makes, shells and seeds and all else that the options say; meshes are mended on request, and a note tells
how; .binvox and .bits files are read; and there is one error for what makes no sense, with no file left behind.

    TestProgramVariants.py --program vtkvoxelize -D DATA_DIRECTORY [-T SCRATCH_DIRECTORY]
"""
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkvoxelization import vtkBinvoxReader, vtkTetraCoveringVoxelizer, vtkVoxelBitsReader

import TestProgram
from TestProgram import (
    BOX_VOXELS, INPUT, OUTPUT, USAGE, VOXELIZATION, ProgramTest, box, joined, open_box, ply_binary, read_vti)

TETRA = "--method", "tetra"
RANDOM = "--rotate", "any", "--scale", "0.5,1.5", "--displace", 0.01, "--seed", 5


def reversed_triangles(points, triangles):
    return points, [t[::-1] for t in triangles]


def read_bits(path):
    reader = vtkVoxelBitsReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    array = vtkUnsignedCharArray()
    assert reader.ReadBatch(array)
    return reader, vtk_to_numpy(array)


class TestVariants(ProgramTest):
    def expected(self, first, count, size, **settings):
        reader = vtkPLYReader()
        reader.SetFileName(TestProgram.BUNNY)
        voxelizer = vtkTetraCoveringVoxelizer()
        voxelizer.SetInputConnection(reader.GetOutputPort())
        voxelizer.SetSampleDimensions(size, size, size)
        voxelizer.SetRotationModeToUniform()
        voxelizer.SetScaleRange(0.5, 1.5)
        voxelizer.SetDisplacementAmplitude(0.01)
        voxelizer.SetSeed(5)
        voxelizer.SafeScaleToFitOn()
        for name, value in settings.items():
            getattr(voxelizer, "Set" + name)(value)
        array = vtkUnsignedCharArray()
        assert voxelizer.VoxelizeBatch(first, count, array)
        voxels = vtk_to_numpy(array).reshape(count, -1).copy()
        assert voxels.any(axis=1).all() and (voxels[0] != voxels[1]).any()
        return voxels

    def test_one_file_for_all(self):
        self.assertEqual(self.succeed(*TETRA, *RANDOM, "--resolution", 24, "--variants", 4, "--first", 2,
                                      TestProgram.BUNNY, "all.bits"), "")
        reader, voxels = read_bits(self.folder / "all.bits")
        np.testing.assert_array_equal(voxels.reshape(4, -1), self.expected(2, 4, 24))
        self.assertEqual((reader.GetNumberOfVariants(), reader.GetFirstVariant(), reader.GetSeed()), (4, 2, 5))
        self.assertEqual(self.names(), ["all.bits"])

    def test_a_file_each(self):
        self.succeed(*TETRA, *RANDOM, "--resolution", 24, "--variants", 3, "--first", 9, TestProgram.BUNNY,
                     "v_%03d.binvox")
        self.assertEqual(self.names(), ["v_009.binvox", "v_010.binvox", "v_011.binvox"])
        for name, expected in zip(self.names(), self.expected(9, 3, 24)):
            reader = vtkBinvoxReader()
            reader.SetFileName(str(self.folder / name))
            reader.Update()
            found = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
            np.testing.assert_array_equal(found, expected)

    def test_steps_on_each(self):
        self.succeed(*TETRA, *RANDOM, "--resolution", 24, "--variants", 2, "--complement", TestProgram.BUNNY,
                     "v%d.vti")
        self.assertEqual(self.names(), ["v0.vti", "v1.vti"])
        for name, expected in zip(self.names(), self.expected(0, 2, 24)):
            np.testing.assert_array_equal(read_vti(self.folder / name).values(), 1 - expected)

    def test_options(self):
        Tetra = vtkTetraCoveringVoxelizer
        for words, settings in (
                (["--shell", 18], {"Shell": 18}),
                (["--backend", "raster"], {}),
                (["--rotate", "y"], {"RotationMode": Tetra.ROTATION_AXIS, "RotationAxis": (0, 1, 0)})):
            with self.subTest(words=words):
                options = [*RANDOM[2:], *words] if "--rotate" in words else [*RANDOM, *words]
                self.succeed(*TETRA, *options, "--resolution", 20, "--variants", 2, TestProgram.BUNNY, "o.bits")
                np.testing.assert_array_equal(
                    read_bits(self.folder / "o.bits")[1].reshape(2, -1), self.expected(0, 2, 20, **settings))

    def test_one_variant(self):
        report = self.info(*TETRA, *RANDOM, "--resolution", 24, "--first", 3, TestProgram.BUNNY, "one.vti")
        expected = self.expected(3, 2, 24)[0]
        np.testing.assert_array_equal(read_vti(self.folder / "one.vti").values(), expected)
        self.assertEqual(report["voxels"], "24 x 24 x 24")
        self.assertEqual(report["filled voxels"].split()[0], str(expected.sum()))

    def test_as_it_is(self):
        """Without what is random: the solid that the other method makes, on the same grid."""
        self.succeed(*TETRA, "--resolution", 40, TestProgram.BUNNY, "tetra.vti")
        self.succeed("--resolution", 40, TestProgram.BUNNY, "solid.vti")
        tetra, solid = (read_vti(self.folder / f"{name}.vti") for name in ("tetra", "solid"))
        self.assertEqual(tetra.values(), solid.values())
        self.assertEqual(tetra.dimensions, solid.dimensions)
        self.succeed(*TETRA, "--stay", "--rotate", "any", "--resolution", 40, TestProgram.BUNNY, "stay.vti")
        stay = read_vti(self.folder / "stay.vti")
        self.assertEqual(stay.dimensions, solid.dimensions)
        self.assertEqual(stay.data.GetOrigin(), solid.data.GetOrigin())
        self.assertNotEqual(stay.values(), solid.values())

    def test_holes(self):
        mesh = self.file("open.ply", ply_binary(*open_box()))
        self.succeed(*TETRA, "--voxel-size", 0.5, mesh, "out.vti", warnings=["The mesh is not closed"])
        self.assertTrue(0 < read_vti(self.folder / "out.vti").filled() < BOX_VOXELS)
        # An open mesh among variants is told once.
        self.succeed(*TETRA, "--variants", 3, "--rotate", "z", mesh, "v%d.vti", warnings=["The mesh is not closed"])


class TestRepair(ProgramTest):
    def note(self, *words):
        done = self.call(*words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr

    def test_doubled(self):
        mesh = self.file("doubled.ply", ply_binary(*joined(box(), reversed_triangles(*box()))))
        for method in [], TETRA, ["--fill", "nonzero"]:
            with self.subTest(method=method):
                self.assertEqual(
                    self.note(*method, "--voxel-size", 0.5, "--repair", mesh, "out.vti"),
                    f"vtkvoxelize: note: {mesh}: left out 12 of 24 polygons: 12 with a twin of the opposite normal\n")
                self.assertEqual(read_vti(self.folder / "out.vti").values(), [1] * BOX_VOXELS)
        # Without, nothing is found; and quiet is quiet.
        self.succeed("--voxel-size", 0.5, mesh, "out.vti", warnings=["no voxel is set"])
        self.assertEqual(self.note("--quiet", "--repair", mesh, "out.vti"), "")

    def test_steps(self):
        low = self.file("low.ply", ply_binary(*joined(box(), box())))
        self.assertEqual(
            self.note("--voxel-size", 0.5, "--repair", "--unite", low, self.mesh(), "out.vti").splitlines(),
            [f"vtkvoxelize: note: {self.folder / 'box.ply'}: nothing to mend in 12 polygons",
             f"vtkvoxelize: note: {low}: left out 12 of 24 polygons: 12 with an equal twin"])
        self.assertEqual(read_vti(self.folder / "out.vti").filled(), BOX_VOXELS)

    def test_nothing_left(self):
        mesh = self.file("flat.ply", ply_binary([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)]))
        done = self.call("--repair", mesh, "out.vti")
        self.assertEqual(done.returncode, INPUT)
        self.assertIn("degenerate", done.stderr.splitlines()[-1])
        self.assertEqual(self.names(), ["flat.ply"])


class TestVoxelFiles(ProgramTest):
    def test_conversions(self):
        self.succeed("--voxel-size", 0.5, self.mesh(), "a.bits")
        self.succeed("a.bits", "b.binvox")
        self.succeed("b.binvox", "c.vti")
        image = read_vti(self.folder / "c.vti")
        self.assertEqual(image.values(), [1] * BOX_VOXELS)
        self.assertEqual(image.data.GetOrigin(), (1.25, 2.25, 3.25))
        self.assertEqual(image.data.GetSpacing(), (0.5, 0.5, 0.5))

    def test_truncated(self):
        self.succeed("--voxel-size", 0.5, self.mesh(), "a.bits")
        self.succeed("--voxel-size", 0.5, self.mesh(), "a.binvox")
        for name in "a.bits", "a.binvox":
            content = (self.folder / name).read_bytes()
            for length in 4, len(content) // 2, len(content) - 1:
                bad = self.file("bad." + name.split(".")[1], content[:length])
                self.complain(INPUT, bad, "out.vti", naming=["cannot read", bad.name])


class TestErrors(ProgramTest):
    def test_usage(self):
        for option in ("--shell=6", "--variants=3", "--first=1", "--seed=1", "--rotate=z", "--scale=0.5,1",
                       "--displace=0.1", "--stay"):
            with self.subTest(option=option):
                self.complain(USAGE, option, "a.ply", "b.vti", naming=[option.split("=")[0], "--method tetra"])
                self.complain(USAGE, *TETRA, option, "ct.mha", "b.vti", naming=[option.split("=")[0], "volume"])
        for words, naming in (
                (["--variants=0"], ["--variants"]), (["--variants=-3"], ["--variants"]),
                (["--shell=7"], ["--shell"]), (["--scale=0,1"], ["--scale"]), (["--scale=2,1"], ["--scale"]),
                (["--scale=1,inf"], ["--scale"]), (["--displace=0"], ["--displace"]),
                (["--displace=2"], ["--displace"]), (["--rotate=w"], ["--rotate"]), (["--first=-1"], ["--first"]),
                (["--mode=over"], ["--mode", "--method tetra"]), (["--axes=x"], ["--axes"]),
                (["--variants=2"], ["--variants", "b.vti", "%04d"])):
            with self.subTest(words=words):
                self.complain(USAGE, *TETRA, *words, "a.ply", "b.vti", naming=naming)
        self.complain(USAGE, *TETRA, "--variants=2", "a.ply", "b%d_%d.vti", naming=["%04d", "once"])
        self.complain(USAGE, *TETRA, "--variants=2", "--dilate=1", "a.ply", "b.bits", naming=["--dilate", "%04d"])
        self.complain(USAGE, *TETRA, "--variants=2", "--picture=p.png", "a.ply", "b.bits", naming=["--picture"])
        self.complain(USAGE, "--repair", "a.mha", "b.vti", naming=["--repair", "volume"])

    def test_failures(self):
        mesh = self.mesh()
        self.complain(INPUT, *TETRA, "--variants", 2, "none.ply", "b.bits", naming=["none.ply"])
        self.complain(OUTPUT, *TETRA, "--variants", 2, mesh, "none/b.bits", naming=["none/b.bits"])
        self.complain(OUTPUT, *TETRA, "--variants", 2, mesh, "b%d.xyz", naming=[".xyz"])
        (self.folder / "b1.vti").mkdir()
        done = self.call(*TETRA, "--variants", 3, "--resolution", 8, mesh, "b%d.vti")
        self.assertEqual(done.returncode, OUTPUT)
        self.assertIn("b1.vti", done.stderr)
        self.assertEqual(self.names(), ["b0.vti", "b1.vti", "box.ply"])
        self.complain(VOXELIZATION, *TETRA, "--variants", 2, "--resolution", 2000000, mesh, "b.bits",
                      naming=["voxels"])

    def test_mesh_larger_than_the_grid(self):
        self.succeed(*TETRA, "--bounds", "1.5,2.5,2.5,4,3.5,5", "--voxel-size", 0.5, self.mesh(), "part.vti")
        self.assertEqual(read_vti(self.folder / "part.vti").values(), [1] * (2 * 3 * 3))


if __name__ == "__main__":
    TestProgram.main()
