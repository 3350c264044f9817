"""Times work on voxels by this module's filters, by VTK's imaging filters, by NumPy and scipy.ndimage, and by
SimpleITK where it is installed, in one process: on the solid bunny with so many voxels along its longest side,
and the same bunny beside it on the same grid. Prints JSON: {"TOOL/STEP/SIZE": milliseconds}, the minimum of five.

    rivals_bits.py DATA_DIR [SIZE ...]

Steps, each from voxels in memory to its result in memory:
    dilate 3, dilate 7  by a box of so many voxels on each axis
    difference          of the two solids
    density             float means of 8^3 voxels, or of 7^3 by tools that have boxes of odd sizes only
    normals             density, and the gradients of it, of unit length but for SimpleITK
    chain               dilate 7 of the second solid, difference from the first, normals of that
    fill holes          of the first solid with one voxel in a thousand turned over
    keep largest        of the components of the same by faces
Tools:
    Filters             bits on the GPU to an image, of a chain with one read-back at its end
    FilterBits          bits on the GPU to bits on the GPU
    VTKImaging          VTK's filters, image to image; its kernel is an ellipsoid, so a box is three lines
    NumPy               arrays of bool; scipy.ndimage.maximum_filter dilates, which is separable
    Structure           scipy.ndimage.binary_dilation
    SimpleITK           images of 8 bits
"""
import json
import pathlib
import sys

import numpy as np
import scipy
from scipy import ndimage
from timing import minimum
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkImagingGeneral import vtkImageGradient, vtkImageNormalize, vtkImageSeparableConvolution
from vtkmodules.vtkImagingMath import vtkImageLogic
from vtkmodules.vtkImagingMorphological import vtkImageConnectivityFilter, vtkImageDilateErode3D
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkvoxelization import (
    vtkSlicemapSolidVoxelizer, vtkVoxelBoolean, vtkVoxelConnectivity, vtkVoxelDensityNormals, vtkVoxelMorphology)

try:
    import SimpleITK
except ImportError:
    SimpleITK = None

BOXES = (3, 7)
DENSITY_BOX = 8
ODD_DENSITY_BOX = 7
SHIFT = 0.1  # of the second solid, in lengths of the first
NOISE = 0.001


class Inputs:
    """The two solids, as filters whose output is up to date, images, and arrays; a noisy one."""

    def __init__(self, folder, size):
        self.reader = vtkPLYReader()
        names = [name for name in ("bunny.ply", "bunny_7k.ply") if (folder / name).exists()]
        self.reader.SetFileName(str(folder / names[0]))
        self.reader.Update()
        bounds = self.reader.GetOutput().GetBounds()
        transform = vtkTransform()
        transform.Translate(SHIFT * (bounds[1] - bounds[0]), 0, 0)
        moved = vtkTransformPolyDataFilter()
        moved.SetTransform(transform)
        moved.SetInputConnection(self.reader.GetOutputPort())
        self.solids = [vtkSlicemapSolidVoxelizer(), vtkSlicemapSolidVoxelizer()]
        self.solids[0].SetInputConnection(self.reader.GetOutputPort())
        self.solids[0].SetResolution(size)
        self.solids[0].Update()
        self.solids[1].SetInputConnection(moved.GetOutputPort())
        self.solids[1].SetReferenceImage(self.solids[0].GetOutput())
        self.solids[1].CheckWatertightOff()  # it leaves the grid
        self.solids[1].Update()
        self.images = [solid.GetOutput() for solid in self.solids]
        self.arrays = [to_array(image) != 0 for image in self.images]
        noise = np.random.default_rng(1).random(self.arrays[0].shape, np.float32) < NOISE
        self.noisy_array = self.arrays[0] ^ noise
        self.noisy_image = vtkImageData()
        self.noisy_image.CopyStructure(self.images[0])
        self.noisy_image.GetPointData().SetScalars(
            numpy_to_vtk(self.noisy_array.view(np.uint8).ravel(), deep=True))


def to_array(image):
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions()[::-1])


def filters(inputs, host_output=True):
    """This module's, which leave bits on the GPU for each other."""
    a, b = (solid.GetOutputPort() for solid in inputs.solids)

    def dilated(port, size):
        dilation = vtkVoxelMorphology()
        dilation.SetInputConnection(port)
        dilation.SetKernelSize(size, size, size)
        return dilation

    def difference(first, second):
        boolean = vtkVoxelBoolean()
        boolean.SetInputConnection(first)
        boolean.AddInputConnection(second)
        boolean.SetOperationToDifference()
        return boolean

    def density(port, has_normals):
        result = vtkVoxelDensityNormals()
        result.SetInputConnection(port)
        result.SetKernelSize(DENSITY_BOX, DENSITY_BOX, DENSITY_BOX)
        if has_normals:
            result.SetNormalModeToSymmetric()
        else:
            result.SetNormalModeToOff()
        return result

    def connected(operation, connectivity):
        result = vtkVoxelConnectivity()
        result.SetInputData(inputs.noisy_image)
        result.SetOperation(operation)
        result.SetConnectivity(connectivity)
        return result

    def updated(*chain):
        for link in chain[:-1]:
            link.HostOutputOff()
        last = chain[-1]
        last.SetHostOutput(host_output)

        def run():
            chain[0].Modified()
            last.Update()
            if host_output:
                return last.GetOutput()
            last.GetNumberOfFilledVoxels()  # so that the GPU has finished
            return None

        run()
        return run

    steps = {f"dilate {size}": updated(dilated(a, size)) for size in BOXES}
    steps["difference"] = updated(difference(a, b))
    steps["fill holes"] = updated(connected(vtkVoxelConnectivity.OPERATION_FILL_HOLES, 26))
    steps["keep largest"] = updated(connected(vtkVoxelConnectivity.OPERATION_KEEP_LARGEST, 6))
    if host_output:
        steps["density"] = updated(density(a, False))
        steps["normals"] = updated(density(a, True))
        first = dilated(b, BOXES[-1])
        middle = difference(a, first.GetOutputPort())
        steps["chain"] = updated(first, middle, density(middle.GetOutputPort(), True))
    return steps


def filter_bits(inputs):
    return filters(inputs, False)


def vtk_imaging(inputs):
    def dilated(image, size):
        for line in (size, 1, 1), (1, size, 1), (1, 1, size):
            dilation = vtkImageDilateErode3D()
            dilation.SetInputData(image)
            dilation.SetKernelSize(*line)
            dilation.SetDilateValue(1)
            dilation.SetErodeValue(0)
            dilation.Update()
            image = dilation.GetOutput()
        return image

    def difference(first, second):
        inverse = vtkImageLogic()
        inverse.SetInput1Data(second)
        inverse.SetOperationToNot()
        both = vtkImageLogic()
        both.SetInput1Data(first)
        both.SetInputConnection(1, inverse.GetOutputPort())
        both.SetOperationToAnd()
        for logic in inverse, both:
            logic.SetOutputTrueValue(1)
        both.Update()
        return both.GetOutput()

    def density(image):
        weights = vtkFloatArray()
        for _ in range(ODD_DENSITY_BOX):
            weights.InsertNextValue(1 / ODD_DENSITY_BOX)
        mean = vtkImageSeparableConvolution()
        mean.SetInputData(image)
        for axis in "XYZ":
            getattr(mean, f"Set{axis}Kernel")(weights)
        mean.Update()
        return mean.GetOutput()

    def normals(image):
        gradient = vtkImageGradient()
        gradient.SetInputData(density(image))
        gradient.SetDimensionality(3)
        unit = vtkImageNormalize()
        unit.SetInputConnection(gradient.GetOutputPort())
        unit.Update()
        return unit.GetOutput()

    def largest():
        connectivity = vtkImageConnectivityFilter()
        connectivity.SetInputData(inputs.noisy_image)
        connectivity.SetScalarRange(1, 1)  # VTK 9.1 rounds its default range down to 0
        connectivity.SetExtractionModeToLargestRegion()
        connectivity.Update()
        return connectivity.GetOutput()

    steps = steps_of(*inputs.images, dilated, difference, density, normals)
    steps["keep largest"] = largest
    return steps


def numpy_and_scipy(inputs):
    def dilated(array, size):
        return ndimage.maximum_filter(array.view(np.uint8), size).view(bool)

    def density(array):
        return ndimage.uniform_filter(array, DENSITY_BOX, np.float32, mode="constant")

    def normals(array):
        gradient = np.stack(np.gradient(density(array)), axis=-1)
        length = np.sqrt(np.einsum("...i,...i", gradient, gradient))
        length[length == 0] = 1
        gradient /= length[..., np.newaxis]
        return gradient

    def largest():
        labels = ndimage.label(inputs.noisy_array)[0]
        return labels == 1 + np.argmax(np.bincount(labels.ravel())[1:])

    steps = steps_of(*inputs.arrays, dilated, np.greater, density, normals)
    steps["fill holes"] = lambda: ndimage.binary_fill_holes(inputs.noisy_array)
    steps["keep largest"] = largest
    return steps


def scipy_structure(inputs):
    def step(size):
        structure = np.ones((size, size, size), bool)
        return lambda: ndimage.binary_dilation(inputs.arrays[0], structure)

    return {f"dilate {size}": step(size) for size in BOXES}


def simpleitk(inputs):
    def dilated(image, size):
        return SimpleITK.BinaryDilate(image, (size // 2,) * 3, SimpleITK.sitkBox, 0, 1)

    def density(image):
        return SimpleITK.BoxMean(SimpleITK.Cast(image, SimpleITK.sitkFloat32), (ODD_DENSITY_BOX // 2,) * 3)

    def normals(image):
        return SimpleITK.Gradient(density(image))

    def largest():
        components = SimpleITK.RelabelComponent(SimpleITK.ConnectedComponent(noisy))
        return SimpleITK.Equal(components, 1)

    *images, noisy = (
        SimpleITK.GetImageFromArray(array.view(np.uint8)) for array in inputs.arrays + [inputs.noisy_array])
    steps = steps_of(*images, dilated, SimpleITK.Greater, density, normals)
    steps["fill holes"] = lambda: SimpleITK.BinaryFillhole(noisy, False, 1)
    steps["keep largest"] = largest
    return steps


def steps_of(a, b, dilated, difference, density, normals):
    steps = {f"dilate {size}": (lambda size=size: dilated(a, size)) for size in BOXES}
    steps["difference"] = lambda: difference(a, b)
    steps["density"] = lambda: density(a)
    steps["normals"] = lambda: normals(a)
    steps["chain"] = lambda: normals(difference(a, dilated(b, BOXES[-1])))
    return steps


# How to make the steps of each tool, and an array of a result; the first of those is believed.
TOOLS = {
    "NumPy": (numpy_and_scipy, np.asarray),
    "Filters": (filters, to_array),
    "FilterBits": (filter_bits, None),
    "VTKImaging": (vtk_imaging, to_array),
    "Structure": (scipy_structure, np.asarray),
}
if SimpleITK:
    TOOLS["SimpleITK"] = (simpleitk, SimpleITK.GetArrayFromImage)
STEPS_OF_BITS = ("dilate 3", "dilate 7", "difference", "fill holes", "keep largest")


def main():
    folder = pathlib.Path(sys.argv[1])
    result = {"VTK": vtkVersion.GetVTKVersion(), "NumPy": np.__version__, "scipy": scipy.__version__}
    if SimpleITK:
        result["SimpleITK"] = SimpleITK.Version_VersionString()
    for size in [int(size) for size in sys.argv[2:]] or [256, 512]:
        inputs = Inputs(folder, size)
        expected = {}
        for tool, (make_steps, to_voxels) in TOOLS.items():
            for step, run in make_steps(inputs).items():
                key = f"{tool}/{step}/{size}"
                if step in STEPS_OF_BITS and to_voxels:
                    voxels = to_voxels(run()) != 0
                    if not np.array_equal(voxels, expected.setdefault(step, voxels)):
                        sys.exit(f"{key} has other voxels than the first tool")
                result[key] = minimum(run)
                print(key, result[key], file=sys.stderr)
    print(json.dumps(result, indent=1))


main()
