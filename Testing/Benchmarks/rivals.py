"""Times PyVista's voxelize_binary_mask on the meshes of BenchmarkSolid, with as many voxels along the
longest side. Prints JSON: {"PyVista/MESH/SIZE": milliseconds}, the minimum of five.

    rivals.py DATA_DIR [SIZE ...]
"""
import json
import pathlib
import sys

import pyvista

from timing import minimum


def main():
    folder = pathlib.Path(sys.argv[1])
    sizes = [int(size) for size in sys.argv[2:]] or [64, 128, 256, 512, 1024]
    meshes = {}
    if (folder / "dragon.ply").exists():
        meshes["bunny"] = pyvista.read(folder / "bunny.ply")
        meshes["dragon"] = pyvista.read(folder / "dragon.ply")
        meshes["dragon_1.6M"] = meshes["dragon"].subdivide(2, "loop")
    else:
        meshes["bunny_7k"] = pyvista.read(folder / "bunny_7k.ply")
    result = {"PyVista": pyvista.__version__, "VTK": pyvista.vtk_version_info.__str__()}
    for name, mesh in meshes.items():
        bounds = mesh.bounds
        lengths = [bounds[2 * i + 1] - bounds[2 * i] for i in range(3)]
        for size in sizes:
            step = max(lengths) / size
            dimensions = [max(1, round(length / step)) for length in lengths]
            key = f"PyVista/{name}/{size}"
            result[key] = minimum(lambda: mesh.voxelize_binary_mask(dimensions=dimensions))
            print(key, result[key], file=sys.stderr)
    print(json.dumps(result, indent=1))


main()
