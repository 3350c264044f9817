"""Prints as Markdown what the benchmarks and the rivals_*.py measured: milliseconds, and how many
times faster.

    compare.py RESULTS.json ...
"""
import json
import sys

SOLIDS = (
    ("Update", "image"), ("Bits", "bits on the GPU"), ("Pass", "bits, mesh already there"),
    ("Scanline", "scanline on the CPU"), ("Stencil", "vtkPolyDataToImageStencil"), ("PyVista", "PyVista"))
SOLID_RATIOS = (
    ("PyVista", "Update", "image than PyVista"), ("PyVista", "Bits", "bits than PyVista"),
    ("Stencil", "Update", "image than vtkPolyDataToImageStencil"),
    ("Scanline", "Update", "image than the scanline"))
SURFACES = (
    ("SurfaceImage", "image"), ("SurfaceBits", "bits on the GPU"), ("VoxelModeller", "vtkVoxelModeller"),
    ("OpenVDB", "OpenVDB, narrow band"))
SURFACE_RATIOS = (
    ("VoxelModeller", "SurfaceImage", "image than vtkVoxelModeller"),
    ("VoxelModeller", "SurfaceBits", "bits than vtkVoxelModeller"),
    ("OpenVDB", "SurfaceImage", "image than OpenVDB"), ("OpenVDB", "SurfaceBits", "bits than OpenVDB"))
WAYS = (
    ("Triangle", "Triangle"), ("Fragment", "Fragment"), ("Hybrid", "Hybrid"),
    ("RasterTriangle", "Triangle, Raster"), ("RasterFragment", "Fragment, Raster"),
    ("RasterHybrid", "Hybrid, Raster"))

VOXELS = (
    ("Filters", "image"), ("FilterBits", "bits on the GPU"), ("VTKImaging", "VTK's imaging filters"),
    ("NumPy", "NumPy and scipy"), ("Structure", "scipy.ndimage.binary_dilation"), ("SimpleITK", "SimpleITK"))
FILTERS = (
    ("Dilate", "dilation by a box"), ("Open", "opening by a box"), ("DilateSphere", "dilation by a sphere"),
    ("DilateVTK", "vtkImageDilateErode3D"), ("DensityCount", "counts in boxes"),
    ("Density", "density and normals"), ("DensityCoarse", "density and normals of boxes side by side"),
    ("Chain", "two meshes, difference, dilation, density and normals"),
    ("ChainVTK", "the same, VTK's filters"), ("ChainVTKLines", "the same, VTK's filters, dilated by lines"))
LEVEL_SETS = (
    ("LevelSets/1", "one level set"), ("LevelSets/4", "four level sets"),
    ("CopyScalars/512", "a copy of the scalars"), ("ThresholdVTK/1", "vtkImageThreshold"), ("Union/512", "union of two solids"))
VOXEL_RATIOS = tuple(
    (slow, fast, f"{what} than {label}") for slow, label in VOXELS[2:]
    for fast, what in (("Filters", "image"), ("FilterBits", "bits")))


# Of BenchmarkTetra, whose rows have a batch of variants each.
MODELS = ("10k", "100k", "265k")
VARIANTS = (
    ("Batch", "solids, one-model batch"), ("Rotated", "the same, rotated only as the rivals are"),
    ("Direct", "solids, direct, bits that are stored nowhere"), ("Bits", "solids, one at a time, bits on the GPU"),
    ("Shell", "shells, batch"),
    ("Columns", "solids, Raster backend"), ("Layers", "solids, Raster backend by layers"),
    ("PyVista", "PyVista"), ("PythonStencil", "vtkPolyDataToImageStencil of PyVista's VTK"),
    ("Stencil", "vtkPolyDataToImageStencil"), ("trimesh", "trimesh"))


def load(files):
    times = {}
    for file in files:
        results = json.load(open(file))
        for row in results.get("benchmarks", []):
            if row["run_type"] == "iteration":
                name = row["run_name"].split("/iterations")[0]
                time = row["real_time"]
                if name.split("/")[1:2] and name.split("/")[1] in MODELS:
                    time = 1e3 / row["items_per_second"]
                times[name] = min(times.get(name, float("inf")), time)
        times.update({k: v for k, v in results.items() if "/" in k})
    return times


def number(value):
    return f"{value:.0f}" if value >= 99.5 else f"{value:.2g}"


def table(title, rows):
    """Rows are (label, {size: value}); those without values are left out."""
    rows = [(label, values) for label, values in rows if values]
    sizes = sorted({size for _, values in rows for size in values})
    if not rows:
        return
    print(f"\n| {title} | " + " | ".join(f"{s}^3" for s in sizes) + " |")
    print("| --- |" + " --- |" * len(sizes))
    for label, values in rows:
        cells = (number(values[s]) if s in values else "" for s in sizes)
        print(f"| {label} | " + " | ".join(cells) + " |")


def by_size(times, kind, mesh):
    prefix = f"{kind}/{mesh}/"
    return {int(name[len(prefix):]): t for name, t in times.items() if name.startswith(prefix)}


def ratios(times, slow, fast, mesh):
    ours = by_size(times, fast, mesh)
    return {s: t / ours[s] for s, t in by_size(times, slow, mesh).items() if s in ours}


def by_kernel(times, kind):
    prefix = f"{kind}/"
    return {int(name[len(prefix):]): t for name, t in times.items()
            if name.startswith(prefix) and name.count("/") == 1}


def tables(times, key, title, kinds, comparisons):
    meshes = sorted({name.split("/")[1] for name in times if name.startswith(f"{key}/")})
    table(f"times faster, {title}", [(f"{mesh}, {label}", ratios(times, slow, fast, mesh))
                                     for mesh in meshes for slow, fast, label in comparisons])
    table(f"milliseconds, {title}", [(f"{mesh}, {label}", by_size(times, kind, mesh))
                                     for mesh in meshes for kind, label in kinds])


def main():
    times = load(sys.argv[1:])
    tables(times, "Update", "solid", SOLIDS, SOLID_RATIOS)
    for size in (256, 512, 1024):
        scan, clear, copy = (times.get(f"{kind}/{size}") for kind in ("Scan", "Clear", "Copy"))
        rest = times.get("Scan/8")
        if scan and clear and copy and rest:
            factor = number((scan - clear - rest) / copy)
            print(f"\nParity scan of {size}^3 bits: {factor} times a copy of them.")
    tables(times, "SurfaceBits", "surface", SURFACES, SURFACE_RATIOS)
    tables(times, "NumPy", "work on voxels", VOXELS, VOXEL_RATIOS)
    table("milliseconds, bunny of 512 voxels, by size of the kernel",
          [(label, by_kernel(times, kind)) for kind, label in FILTERS])
    for name, label in LEVEL_SETS:
        if name in times:
            print(f"\n512^3, {label}: {number(times[name])} ms.")
    rivals = [kind for kind, _ in VARIANTS if kind in ("PyVista", "PythonStencil", "Stencil", "trimesh")]
    table("variants a second", [
        (f"{model} triangles, {label}", {size: 1e3 / t for size, t in by_size(times, kind, model).items()})
        for model in MODELS for kind, label in VARIANTS])
    table("times more variants than the best rival", [
        (f"{model} triangles, {label}", {
            size: min(by_size(times, rival, model).get(size, float("inf")) for rival in rivals) / t
            for size, t in by_size(times, kind, model).items()})
        for model in MODELS if by_size(times, "PyVista", model) for kind, label in VARIANTS[:4]])
    tables(times, "Hybrid", "thin surface by strategy", WAYS, ())


main()
