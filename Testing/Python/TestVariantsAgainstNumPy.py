"""Proves that variants of vtkTetraCoveringVoxelizer are what NumPy makes of the same seed: random numbers by a
Philox generator of its own, meshes rotated, scaled and displaced in NumPy, and those voxelized the plain way, by
another class as well. And that shells are what scipy.ndimage takes from a solid at 6, 18 and 26 neighbours.

    TestVariantsAgainstNumPy.py -D DATA_DIRECTORY

Shells are skipped where there is no scipy.
"""
import argparse
import pathlib
import sys
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkvoxelization import vtkSlicemapSolidVoxelizer, vtkTetraCoveringVoxelizer, vtkVoxelContext

try:
    from scipy import ndimage
except ImportError:
    ndimage = None

DATA = None
SIZE = 40

# What random numbers are for.
ROTATION, SCALE, OFFSET, DISPLACEMENT = range(4)


def philox(counters, key):
    """Philox 4x32 with ten rounds: Salmon et al., SC 2011; counters of shape (n, 4)."""
    c = [counters[:, i].astype(np.uint64) for i in range(4)]
    key = [int(k) for k in key]
    low = np.uint64(0xFFFFFFFF)
    for _ in range(10):
        first, second = c[0] * np.uint64(0xD2511F53), c[2] * np.uint64(0xCD9E8D57)
        c = [second >> np.uint64(32) ^ c[1] ^ np.uint64(key[0]), second & low,
             first >> np.uint64(32) ^ c[3] ^ np.uint64(key[1]), first & low]
        key = [key[0] + 0x9E3779B9 & 0xFFFFFFFF, key[1] + 0xBB67AE85 & 0xFFFFFFFF]
    return np.stack(c, axis=1)


def random_words(seed, variant, stream, count):
    """The first numbers of 32 bits that a seed has for a variant and a purpose."""
    blocks = -(-count // 4)
    counters = np.zeros((blocks, 4), np.uint64)
    counters[:, 0] = np.arange(blocks)
    counters[:, 1:] = stream, variant & 0xFFFFFFFF, variant >> 32
    seed &= 0xFFFFFFFFFFFFFFFF
    return philox(counters, (seed & 0xFFFFFFFF, seed >> 32)).ravel()[:count]


def signed(words):
    return (words.astype(float) + 0.5) * 2.0 ** -31 - 1.0


def points_in_disk(words):
    """Those pairs of numbers that lie in the unit disk, without its middle."""
    pairs = signed(words).reshape(-1, 2)
    squares = (pairs ** 2).sum(axis=1)
    inside = (squares < 1) & (squares > 0)
    return pairs[inside], squares[inside]


def any_rotation(seed, variant):
    """Marsaglia 1972: a unit quaternion from two points in a disk."""
    (a, b, *_), (a2, b2, *_) = points_in_disk(random_words(seed, variant, ROTATION, 64))
    w, x, y, z = *a, *(b * np.sqrt((1 - a2) / b2))
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def rotation_by(axis, cosine, sine):
    """Rodrigues' formula."""
    x, y, z = axis = np.array(axis, float) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + sine * cross + (1 - cosine) * cross @ cross


def rotation_about(axis, seed, variant):
    (direction, *_), (square, *_) = points_in_disk(random_words(seed, variant, ROTATION, 64))
    return rotation_by(axis, *direction / np.sqrt(square))


def scales(low, high, seed, variant):
    return low + random_words(seed, variant, SCALE, 3) * 2.0 ** -32 * (high - low)


def displacements(seed, variant, normal):
    """The ring of displacements from where the variant begins."""
    if normal:
        words = random_words(seed, 0, DISPLACEMENT, 65536 * 3 * 6).astype(np.uint64)
        halves = (words >> np.uint64(16)) + (words & np.uint64(0xFFFF))
        ring = (halves.reshape(-1, 6).sum(axis=1).astype(float) + 6) / 65536 - 6
    else:
        ring = signed(random_words(seed, 0, DISPLACEMENT, 65536 * 3))
    first = int(random_words(seed, variant, OFFSET, 1)[0]) % 65536
    return np.roll(ring.reshape(-1, 3), -first, axis=0)


class Bunny:
    def __init__(self):
        reader = vtkPLYReader()
        reader.SetFileName(str(pathlib.Path(DATA) / "bunny_7k.ply"))
        reader.Update()
        self.mesh = reader.GetOutput()
        self.points = vtk_to_numpy(self.mesh.GetPoints().GetData()).astype(float)
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        self.center, self.longest = (low + high) / 2, (high - low).max()
        self.grid = vtkImageData()
        self.grid.SetDimensions(SIZE, SIZE, SIZE)
        size = 1.5 * self.longest / SIZE
        self.grid.SetSpacing(size, size, size)
        self.grid.SetOrigin(self.center - size * (SIZE / 2 - 0.4))

    def moved(self, points):
        mesh = vtkPolyData()
        mesh.ShallowCopy(self.mesh)
        mesh.SetPoints(vtkPoints())
        mesh.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
        return mesh

    def voxelizer(self, kind, mesh=None, backend=None):
        voxelizer = kind()
        voxelizer.SetInputData(mesh or self.mesh)
        voxelizer.SetReferenceImage(self.grid)
        if backend is not None:
            voxelizer.SetBackend(backend)
        return voxelizer


def voxels_of(voxelizer):
    voxelizer.Update()
    return vtk_to_numpy(voxelizer.GetOutput().GetPointData().GetScalars()).reshape(SIZE, SIZE, SIZE).copy()


def backends():
    if vtkVoxelContext().SupportsCompute():
        yield vtkTetraCoveringVoxelizer.BACKEND_COMPUTE
    yield vtkTetraCoveringVoxelizer.BACKEND_RASTER


class TestVariants(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.bunny = Bunny()

    def check(self, settings, move):
        """`settings` are properties of the voxelizer; `move` gives the points of a variant."""
        bunny = self.bunny
        for seed, variant in (0, 0), (7, 3), (-5, 2 ** 33 + 1):
            expected = move(bunny.points, seed, variant)
            mesh = bunny.moved(expected)
            plain = voxels_of(bunny.voxelizer(vtkTetraCoveringVoxelizer, mesh))
            np.testing.assert_array_equal(voxels_of(bunny.voxelizer(vtkSlicemapSolidVoxelizer, mesh)), plain)
            self.assertGreater(plain.sum(), 100)
            for backend in backends():
                with self.subTest(seed=seed, variant=variant, backend=backend):
                    voxelizer = bunny.voxelizer(vtkTetraCoveringVoxelizer, backend=backend)
                    for name, value in {**settings, "Seed": seed, "Variant": variant}.items():
                        getattr(voxelizer, "Set" + name)(value)
                    found = vtkPolyData()
                    self.assertTrue(voxelizer.GetVariantMesh(variant, found))
                    np.testing.assert_allclose(
                        vtk_to_numpy(found.GetPoints().GetData()), expected, atol=1e-7 * bunny.longest)
                    np.testing.assert_array_equal(voxels_of(voxelizer), plain)
                    batch = vtkUnsignedCharArray()
                    self.assertTrue(voxelizer.VoxelizeBatch(variant, 1, batch))
                    np.testing.assert_array_equal(vtk_to_numpy(batch).reshape(plain.shape), plain)

    def about_center(self, points, matrix):
        return (points - self.bunny.center) @ matrix.T + self.bunny.center

    def test_fixed_rotation(self):
        angle, axis = 37, (1, 2, -0.5)
        matrix = rotation_by(axis, np.cos(np.radians(angle)), np.sin(np.radians(angle)))
        self.check({"FixedRotation": (angle, *axis)}, lambda p, seed, variant: self.about_center(p, matrix))

    def test_any_rotation(self):
        self.check({"RotationMode": vtkTetraCoveringVoxelizer.ROTATION_UNIFORM},
                   lambda p, seed, variant: self.about_center(p, any_rotation(seed, variant)))

    def test_rotation_about_axis(self):
        axis = (1, 0.5, 3)
        self.check({"RotationMode": vtkTetraCoveringVoxelizer.ROTATION_AXIS, "RotationAxis": axis},
                   lambda p, seed, variant: self.about_center(p, rotation_about(axis, seed, variant)))

    def test_scale(self):
        self.check({"ScaleRange": (0.5, 1.5)},
                   lambda p, seed, variant: self.about_center(p, np.diag(scales(0.5, 1.5, seed, variant))))

    def test_displacements(self):
        for normal in False, True:
            def move(points, seed, variant, normal=normal):
                # As the GPU has them, in single precision.
                ring = displacements(seed, variant, normal).astype(np.float32)
                return points + np.float32(0.02 * self.bunny.longest) * ring[:len(points)]

            self.check({"DisplacementAmplitude": 0.02, "DisplacementDistribution": int(normal)}, move)

    def test_all(self):
        def move(points, seed, variant):
            ring = displacements(seed, variant, False).astype(np.float32)
            moved = points + np.float32(0.01 * self.bunny.longest) * ring[:len(points)]
            return self.about_center(moved, any_rotation(seed, variant) @ np.diag(scales(0.7, 1.2, seed, variant)))

        self.check({"RotationMode": vtkTetraCoveringVoxelizer.ROTATION_UNIFORM, "ScaleRange": (0.7, 1.2),
                    "DisplacementAmplitude": 0.01}, move)


@unittest.skipUnless(ndimage, "there is no scipy")
class TestShells(unittest.TestCase):
    def test_shells(self):
        bunny = Bunny()
        # The second solid reaches beyond the grid on all sides.
        for size in 1.0, 2.2:
            mesh = bunny.moved((bunny.points - bunny.center) * size + bunny.center)
            for backend in backends():
                voxelizer = bunny.voxelizer(vtkTetraCoveringVoxelizer, mesh, backend)
                solid = voxels_of(voxelizer)
                for neighbours, connectivity in {6: 1, 18: 2, 26: 3}.items():
                    with self.subTest(size=size, backend=backend, neighbours=neighbours):
                        structure = ndimage.generate_binary_structure(3, connectivity)
                        self.assertEqual(structure.sum(), neighbours + 1)
                        inner = ndimage.binary_erosion(solid, structure)
                        voxelizer.SetShell(neighbours)
                        voxelizer.KeepInteriorOff()
                        shell = voxels_of(voxelizer)
                        np.testing.assert_array_equal(shell, solid & ~inner)
                        self.assertGreater(inner.sum(), 0)
                        voxelizer.KeepInteriorOn()
                        np.testing.assert_array_equal(voxels_of(voxelizer), solid + shell)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("-D", required=True)
    DATA = parser.parse_known_args()[0].D
    unittest.main(argv=sys.argv[:1])
