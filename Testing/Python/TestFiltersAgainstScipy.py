"""Proves vtkVoxelMorphology and vtkVoxelConnectivity bit for bit against scipy.ndimage, and vtkVoxelBoolean
against NumPy: random voxels on grids of awkward sizes and a solid bunny; every operation, kernel, border and
connectivity, boxes of odd and even sizes, iterations; and expressions, which Python evaluates for itself.

    TestFiltersAgainstScipy.py -D DATA_DIRECTORY

Skipped where there is no scipy.
"""
import argparse
import itertools
import sys
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkvoxelization import (
    vtkHybridSurfaceVoxelizer, vtkSlicemapSolidVoxelizer, vtkVoxelBoolean, vtkVoxelConnectivity,
    vtkVoxelMorphology)

try:
    from scipy import ndimage
except ImportError:
    print("There is no scipy (python3-scipy).")
    sys.exit(125)

DATA = None

# x, y, z: no multiples of 32, full words, more than 128 along x, one voxel thin.
SIZES = ((1, 1, 1), (37, 11, 7), (128, 6, 5), (129, 5, 9), (259, 4, 3), (1, 41, 21), (67, 1, 17), (64, 19, 1),
         (201, 1, 1))
BOXES = ((3, 3, 3), (2, 2, 2), (4, 3, 1), (1, 2, 5), (7, 7, 7), (33, 1, 2), (64, 2, 3))
SPHERES = ((3, 3, 3), (5, 5, 5), (4, 4, 4), (7, 3, 6), (31, 5, 1))

OPERATIONS = ("Dilate", "Erode", "Open", "Close", "InnerGradient", "OuterGradient")
NEIGHBOURS = {"Faces6": 1, "Edges18": 2, "Corners26": 3}
# What scipy takes for voxels beyond the grid, by a dilation and by an erosion.
BORDERS = {"Neutral": (0, 1), "Empty": (0, 0), "Full": (1, 1)}


def to_image(voxels):
    image = vtkImageData()
    image.SetDimensions(*voxels.shape[::-1])
    image.GetPointData().SetScalars(numpy_to_vtk(voxels.astype(np.uint8).ravel(), deep=True))
    return image


def to_voxels(image):
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions()[::-1]) != 0


def random_voxels(size, seed, density):
    """Of nx, ny, nz voxels; z is the first index."""
    return np.random.default_rng(seed).random(size[::-1]) < density


def ellipsoid(size):
    """The voxels of a box of nx, ny, nz with centres in the ellipsoid that it holds."""
    index = np.ogrid[tuple(slice(n) for n in size[::-1])]
    return sum(((i - (n - 1) / 2) / (n / 2)) ** 2 for i, n in zip(index, size[::-1])) <= 1


def expected(voxels, operation, structure, border, iterations=1):
    """By scipy, which turns the structure round to dilate: with an even size, its centre moves by one."""
    at_dilation, at_erosion = BORDERS[border]
    moved = [-(n % 2 == 0) for n in structure.shape]

    def dilated(v, origin):
        return ndimage.binary_dilation(v, structure, iterations, border_value=at_dilation, origin=origin)

    def eroded(v, origin):
        return ndimage.binary_erosion(v, structure, iterations, border_value=at_erosion, origin=origin)

    if operation == "Dilate":
        return dilated(voxels, moved)
    if operation == "Erode":
        return eroded(voxels, 0)
    if operation == "Open":
        return dilated(eroded(voxels, 0), 0)
    if operation == "Close":
        return eroded(dilated(voxels, moved), moved)
    if operation == "InnerGradient":
        return voxels & ~eroded(voxels, 0)
    return dilated(voxels, moved) & ~voxels


class Set:
    """Voxels with the operators of Python's sets, and a complement."""

    def __init__(self, voxels):
        self.voxels = voxels

    def __invert__(self):
        return Set(~self.voxels)

    def __sub__(self, other):
        return Set(self.voxels & ~other.voxels)

    def __and__(self, other):
        return Set(self.voxels & other.voxels)

    def __xor__(self, other):
        return Set(self.voxels ^ other.voxels)

    def __or__(self, other):
        return Set(self.voxels | other.voxels)


def bunny(resolution, voxelizer_class=vtkSlicemapSolidVoxelizer):
    reader = vtkPLYReader()
    reader.SetFileName(DATA + "/bunny_7k.ply")
    voxelizer = voxelizer_class()
    voxelizer.SetInputConnection(reader.GetOutputPort())
    voxelizer.SetResolution(resolution)
    voxelizer.Update()
    return voxelizer


class Morphology(unittest.TestCase):
    def setUp(self):
        self.filter = vtkVoxelMorphology()

    def check(self, voxels, operation, structure, border, iterations=1):
        """The kernel of the filter, and its input, are set already."""
        getattr(self.filter, "SetOperationTo" + operation)()
        getattr(self.filter, "SetBorderValueTo" + border)()
        self.filter.SetIterations(iterations)
        self.filter.Update()
        wrong = to_voxels(self.filter.GetOutput()) ^ expected(voxels, operation, structure, border, iterations)
        self.assertEqual(wrong.sum(), 0, f"{operation}, border {border}, {iterations} iterations")

    def check_all(self, name, kernel, structure, sizes=SIZES, iterations=(1,)):
        """Every operation and border on random voxels of all sizes."""
        getattr(self.filter, "SetKernelTypeTo" + kernel)()
        for seed, (size, operation) in enumerate(itertools.product(sizes, OPERATIONS)):
            grows = operation in ("Dilate", "Close", "OuterGradient")
            # So that some voxels change, but not all.
            share = 0.7 / structure.sum()
            voxels = random_voxels(size, seed, share if grows else 1 - share)
            self.filter.SetInputData(to_image(voxels))
            for border, times in itertools.product(BORDERS, iterations):
                with self.subTest(kernel=name, size=size, seed=seed):
                    self.check(voxels, operation, structure, border, times)

    def test_boxes(self):
        for box in BOXES:
            self.filter.SetKernelSize(box)
            self.check_all(f"box {box}", "Box", np.ones(box[::-1], bool))

    def test_neighbours(self):
        for kernel, connectivity in NEIGHBOURS.items():
            self.check_all(kernel, kernel, ndimage.generate_binary_structure(3, connectivity))

    def test_spheres(self):
        for size in SPHERES:
            self.filter.SetKernelSize(size)
            self.check_all(f"sphere {size}", "Sphere", ellipsoid(size))

    def test_iterations(self):
        sizes = SIZES[1::2]
        for box in (3, 3, 3), (2, 4, 1):
            self.filter.SetKernelSize(box)
            self.check_all(f"box {box}", "Box", np.ones(box[::-1], bool), sizes, (2, 5))
        self.check_all("Faces6", "Faces6", ndimage.generate_binary_structure(3, 1), sizes, (2, 5))
        self.filter.SetKernelSize(4, 5, 3)
        self.check_all("sphere", "Sphere", ellipsoid((4, 5, 3)), sizes, (2, 3))

    def test_openings_and_closings_of_scipy(self):
        """As scipy composes them, on a solid."""
        solid = bunny(70)
        voxels = to_voxels(solid.GetOutput())
        self.filter.SetInputConnection(solid.GetOutputPort())
        self.filter.SetBorderValueToEmpty()
        for box in BOXES:
            structure = np.ones(box[::-1], bool)
            moved = [-(n % 2 == 0) for n in structure.shape]
            self.filter.SetKernelSize(box)
            for operation, function, origin in (("Open", ndimage.binary_opening, 0),
                                                ("Close", ndimage.binary_closing, moved)):
                with self.subTest(box=box, operation=operation):
                    getattr(self.filter, "SetOperationTo" + operation)()
                    self.filter.Update()
                    found = to_voxels(self.filter.GetOutput())
                    self.assertEqual((found ^ function(voxels, structure, origin=origin)).sum(), 0)

    def test_bunny(self):
        solid = bunny(150)
        voxels = to_voxels(solid.GetOutput())
        self.assertGreater(voxels.shape[2], 128)
        self.filter.SetInputConnection(solid.GetOutputPort())
        self.filter.SetKernelSize(5, 4, 3)
        structures = {"Box": np.ones((3, 4, 5), bool), "Sphere": ellipsoid((5, 4, 3))}
        structures.update((k, ndimage.generate_binary_structure(3, c)) for k, c in NEIGHBOURS.items())
        for (kernel, structure), operation in itertools.product(structures.items(), OPERATIONS):
            getattr(self.filter, "SetKernelTypeTo" + kernel)()
            with self.subTest(kernel=kernel):
                self.check(voxels, operation, structure, "Neutral")


# Rank of scipy's structure.
CONNECTIVITIES = {6: 1, 18: 2, 26: 3}


def largest(voxels, connectivity):
    """Of several that are largest, scipy numbers the one with the first voxel first."""
    labels, count = ndimage.label(voxels, ndimage.generate_binary_structure(3, CONNECTIVITIES[connectivity]))
    if count == 0:
        return voxels, 0
    return labels == 1 + np.argmax(np.bincount(labels.ravel())[1:]), count


def filled(voxels, connectivity):
    """Unset voxels hold together by all 26 neighbours where set ones do by 6, otherwise by 6."""
    structure = ndimage.generate_binary_structure(3, 3 if connectivity == 6 else 1)
    result = ndimage.binary_fill_holes(voxels, structure)
    return result, ndimage.label(result & ~voxels, structure)[1]


class Connectivity(unittest.TestCase):
    def check(self, voxels):
        connectivity = vtkVoxelConnectivity()
        connectivity.SetInputData(to_image(voxels))
        for operation, function in ("FillHoles", filled), ("KeepLargest", largest):
            for neighbours in CONNECTIVITIES:
                with self.subTest(operation=operation, connectivity=neighbours):
                    getattr(connectivity, "SetOperationTo" + operation)()
                    connectivity.SetConnectivity(neighbours)
                    connectivity.Update()
                    result, count = function(voxels, neighbours)
                    self.assertEqual((to_voxels(connectivity.GetOutput()) ^ result).sum(), 0)
                    self.assertEqual(connectivity.GetNumberOfComponents(), count)

    def test_random(self):
        densities = 0, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.95, 1
        for seed, (size, density) in enumerate(itertools.product(SIZES, densities)):
            with self.subTest(size=size, density=density, seed=seed):
                self.check(random_voxels(size, seed, density))

    def test_noisy_bunny(self):
        voxels = to_voxels(bunny(100).GetOutput())
        for seed, share in enumerate((0.001, 0.05, 0.2)):
            with self.subTest(share=share, seed=seed):
                self.check(voxels ^ random_voxels(voxels.shape[::-1], seed, share))

    def test_surfaces(self):
        """Surfaces are filled by the connectivity that goes with what they separate."""
        for separability, connectivity in (6, 26), (26, 26), (26, 6):
            with self.subTest(separability=separability, connectivity=connectivity):
                surface = bunny(80, vtkHybridSurfaceVoxelizer)
                surface.SetSeparability(separability)
                surface.SetPadding(2)
                fill = vtkVoxelConnectivity()
                fill.SetInputConnection(surface.GetOutputPort())
                fill.SetConnectivity(connectivity)
                fill.Update()
                voxels = to_voxels(surface.GetOutput())
                self.assertEqual((to_voxels(fill.GetOutput()) ^ filled(voxels, connectivity)[0]).sum(), 0)
                self.assertGreater(fill.GetNumberOfFilledVoxels(), 3 * voxels.sum())


class Boolean(unittest.TestCase):
    def check(self, sets, setting, result):
        """A setting of the filter, which is called with it, and what it makes of the sets."""
        boolean = vtkVoxelBoolean()
        for voxels in sets:
            boolean.AddInputDataObject(to_image(voxels))
        setting(boolean)
        boolean.Update()
        self.assertEqual((to_voxels(boolean.GetOutput()) ^ result).sum(), 0)
        self.assertEqual(boolean.GetVolume(), result.sum())
        self.assertEqual(boolean.GetIntersectionVolume(), np.all(sets, axis=0).sum())

    def test_operations(self):
        for size, count in itertools.product(SIZES, (1, 2, 3, 10)):
            sets = [random_voxels(size, 100 * count + i, 0.5) for i in range(count)]
            results = {"Union": np.any(sets, axis=0), "Intersection": np.all(sets, axis=0),
                       "Difference": sets[0] & ~np.any([False & sets[0]] + sets[1:], axis=0),
                       "Xor": np.logical_xor.reduce(sets)}
            if count == 1:
                results["Complement"] = ~sets[0]
            for operation, result in results.items():
                with self.subTest(operation=operation, size=size, count=count):
                    self.check(sets, lambda boolean: getattr(boolean, "SetOperationTo" + operation)(), result)

    def random_expression(self, random, depth):
        if depth == 0:
            return random.choice(list("ABCD"))
        kind = random.integers(6)
        if kind == 0:
            return "~" + self.random_expression(random, depth - 1)
        if kind == 1:
            return "(" + self.random_expression(random, depth - 1) + ")"
        left, right = (self.random_expression(random, depth - 1) for _ in range(2))
        return f"{left} {random.choice(list('-&^|'))} {right}"

    def test_expressions(self):
        for seed in range(150):
            random = np.random.default_rng(seed)
            sets = [random_voxels(SIZES[seed % len(SIZES)], 1000 * seed + i, 0.5) for i in range(4)]
            expression = self.random_expression(random, 1 + seed % 4)
            result = eval(expression, dict(zip("ABCD", map(Set, sets)))).voxels
            with self.subTest(expression=expression, seed=seed):
                self.check(sets, lambda boolean: boolean.SetExpression(expression), result)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("-D", dest="data", action="append", required=True)
    DATA = parser.parse_known_args()[0].data[0]
    unittest.main(argv=sys.argv[:1])
