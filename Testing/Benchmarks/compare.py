"""Prints as Markdown what BenchmarkSolid and rivals.py measured: milliseconds, and how many times faster.

    compare.py BENCHMARKS.json RIVALS.json
"""
import json
import sys

SIZES = [64, 128, 256, 512, 1024]


def load(benchmarks, rivals):
    times = {}
    for row in json.load(open(benchmarks))["benchmarks"]:
        if row["run_type"] == "iteration":
            name = row["run_name"].split("/iterations")[0]
            times[name] = min(times.get(name, float("inf")), row["real_time"])
    times.update({k: v for k, v in json.load(open(rivals)).items() if "/" in k})
    return times


def number(value):
    return f"{value:.0f}" if value >= 99.5 else f"{value:.2g}"


def main():
    times = load(*sys.argv[1:])
    meshes = sorted({key.split("/")[1] for key in times if key.startswith("Update/")})
    sizes = [s for s in SIZES if any(f"Update/{m}/{s}" in times for m in meshes)]
    print("| milliseconds | " + " | ".join(f"{s}^3" for s in sizes) + " |")
    print("| --- |" + " --- |" * len(sizes))
    for mesh in meshes:
        for kind, label in (("Update", "image"), ("Bits", "bits on the GPU"),
                            ("Pass", "bits, mesh already there"), ("Scanline", "scanline on the CPU"),
                            ("Stencil", "vtkPolyDataToImageStencil"), ("PyVista", "PyVista")):
            row = [times.get(f"{kind}/{mesh}/{s}") for s in sizes]
            if any(row):
                print(f"| {mesh}, {label} | " +
                      " | ".join(number(t) if t else "" for t in row) + " |")
    print()
    print("| times faster | " + " | ".join(f"{s}^3" for s in sizes) + " |")
    print("| --- |" + " --- |" * len(sizes))
    for mesh in meshes:
        for rival, ours, label in (("PyVista", "Update", "image than PyVista"),
                                   ("PyVista", "Bits", "bits than PyVista"),
                                   ("Stencil", "Update", "image than vtkPolyDataToImageStencil"),
                                   ("Scanline", "Update", "image than the scanline")):
            row = [(times.get(f"{rival}/{mesh}/{s}"), times.get(f"{ours}/{mesh}/{s}")) for s in sizes]
            if any(a and b for a, b in row):
                print(f"| {mesh}, {label} | " +
                      " | ".join(number(a / b) if a and b else "" for a, b in row) + " |")
    for size in sizes:
        scan, clear, copy = (times.get(f"{k}/{size}") for k in ("Scan", "Clear", "Copy"))
        rest = times.get("Scan/8")
        if scan and clear and copy and rest:
            print(f"\nParity scan of {size}^3 bits: {number((scan - clear - rest) / copy)} times a copy of them.")


main()
