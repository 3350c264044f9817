"""Times variants of the models of BenchmarkTetra by other packages: each is the model, turned by some rotation,
voxelized as a solid into n^3 voxels. Prints JSON: {"TOOL/MODEL/SIZE": milliseconds a variant}, the minimum of five.

    rivals_variants.py FOLDER [SIZE ...]

The models are the files 10k.ply, 100k.ply and 265k.ply of the folder, which BenchmarkTetra writes; all points are
there as arrays in memory, and rotating them by NumPy is part of the time, since a variant takes that too.

PyVista        voxelize_binary_mask on a grid of n^3 points, which is vtkPolyDataToImageStencil of the VTK it comes with
PythonStencil  that filter and vtkImageStencilToImage on the same grid, called directly
trimesh        voxelized(), which finds the voxels of the surface, and fill()
"""
import json
import pathlib
import sys

import numpy as np
import pyvista
import trimesh
from timing import minimum
from vtkmodules.vtkImagingStencil import vtkImageStencilToImage, vtkPolyDataToImageStencil

# A turn about an axis that is no other's.
ANGLE, AXIS = 0.7, np.array((1, 2, 3)) / np.sqrt(14)


def rotation(step):
    cross = np.cross(np.eye(3), AXIS)
    angle = ANGLE + 0.1 * step
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


class Model:
    def __init__(self, path):
        self.mesh = pyvista.read(path)
        self.points = np.array(self.mesh.points)
        self.center = (self.points.max(axis=0) + self.points.min(axis=0)) / 2
        self.radius = np.linalg.norm(self.points - self.center, axis=1).max()
        self.faces = self.mesh.faces.reshape(-1, 4)[:, 1:]
        self.steps = 0

    def turned(self):
        self.steps += 1
        matrix = rotation(self.steps).astype(self.points.dtype)
        return (self.points - self.center) @ matrix.T + self.center

    def spacing(self, size):
        return 2 * self.radius / size

    def origin(self, size):
        return self.center - self.radius + self.spacing(size) / 2


def with_pyvista(model, size):
    spacing = model.spacing(size)
    grid = pyvista.ImageData(dimensions=(size,) * 3, spacing=(spacing,) * 3, origin=model.origin(size))

    def run():
        mesh = pyvista.PolyData(model.turned(), model.mesh.faces)
        return mesh.voxelize_binary_mask(reference_volume=grid)["mask"]

    return run


def with_stencil(model, size):
    spacing = model.spacing(size)
    stencil = vtkPolyDataToImageStencil()
    stencil.SetOutputOrigin(*map(float, model.origin(size)))
    stencil.SetOutputSpacing(spacing, spacing, spacing)
    stencil.SetOutputWholeExtent(0, size - 1, 0, size - 1, 0, size - 1)
    image = vtkImageStencilToImage()
    image.SetInputConnection(stencil.GetOutputPort())
    image.SetOutputScalarTypeToUnsignedChar()

    def run():
        stencil.SetInputData(pyvista.PolyData(model.turned(), model.mesh.faces))
        image.Update()
        return pyvista.wrap(image.GetOutput()).active_scalars

    return run


def with_trimesh(model, size):
    def run():
        mesh = trimesh.Trimesh(model.turned(), model.faces, process=False)
        return mesh.voxelized(model.spacing(size)).fill().matrix

    return run


def main():
    folder = pathlib.Path(sys.argv[1])
    result = {"PyVista": pyvista.__version__, "VTK": str(pyvista.vtk_version_info), "trimesh": trimesh.__version__}
    for size in [int(size) for size in sys.argv[2:]] or [64, 256]:
        for name in "10k", "100k", "265k":
            model = Model(folder / f"{name}.ply")
            for tool, make in ("PyVista", with_pyvista), ("PythonStencil", with_stencil), ("trimesh", with_trimesh):
                run = make(model, size)
                if not np.any(run()):
                    sys.exit(f"{tool} finds no voxels of {name}")
                key = f"{tool}/{name}/{size}"
                result[key] = minimum(run)
                print(key, result[key], file=sys.stderr)
    print(json.dumps(result, indent=1))


main()
