"""Trains a small 3D network to tell shapes apart, from voxels that are made as it asks for them.

    train_network.py MESH.ply PICTURE.png [--steps N] [--workers N]

The shapes are primitives of VTK and a mesh, in any rotation, stretched and with points moved at random. The
picture shows the accuracy on variants that the network was not trained with. Needs PyTorch.
"""
import argparse
import sys
import time

from vtkmodules.vtkChartsCore import vtkAxis, vtkChart, vtkChartLegend, vtkChartXY
from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
from vtkmodules.vtkCommonDataModel import vtkTable
from vtkmodules.vtkFiltersSources import (
    vtkConeSource, vtkCubeSource, vtkCylinderSource, vtkParametricFunctionSource, vtkPlatonicSolidSource,
    vtkSphereSource, vtkSuperquadricSource)
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingContext2D import vtkContextActor
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkWindowToImageFilter
from vtkmodules.util.numpy_support import numpy_to_vtk
import numpy as np
import vtkmodules.vtkRenderingContextOpenGL2  # noqa: F401
import vtkmodules.vtkRenderingFreeType  # noqa: F401
from vtkvoxelization import vtkVoxelContext

try:
    import torch
    from torch import nn
    from torch.utils.data import DataLoader
except ImportError:
    print("There is no PyTorch (torch).")
    sys.exit(125)

from vtkvoxelization.torch import VoxelDataset, VoxelStream, read_mesh

SIZE = 32
BATCH = 32
VARIANTS_TO_VALIDATE = 24
AUGMENTATION = dict(rotation="uniform", scale=(0.75, 1.3), displacement=0.01)


def source(kind, **properties):
    instance = kind()
    for name, value in properties.items():
        getattr(instance, f"Set{name}")(value)
    instance.Update()
    return instance.GetOutput()


def shapes(mesh_file):
    """Pairs of a name and a mesh."""
    return [
        ("ball", source(vtkSphereSource, ThetaResolution=32, PhiResolution=32)),
        ("box", source(vtkCubeSource)),
        ("cone", source(vtkConeSource, Resolution=32)),
        ("cylinder", source(vtkCylinderSource, Resolution=32)),
        ("torus", source(vtkParametricFunctionSource, ParametricFunction=vtkParametricTorus())),
        ("star", source(vtkSuperquadricSource, ThetaRoundness=3.0, PhiRoundness=3.0)),
        ("tetrahedron", source(vtkPlatonicSolidSource, SolidType=0)),
        (mesh_file, read_mesh(mesh_file)),
    ]


def make_network(classes):
    return nn.Sequential(
        nn.Conv3d(1, 8, 5, stride=2, padding=2), nn.BatchNorm3d(8), nn.ReLU(),
        nn.Conv3d(8, 16, 3, padding=1), nn.BatchNorm3d(16), nn.ReLU(), nn.MaxPool3d(2),
        nn.Conv3d(16, 32, 3, padding=1), nn.BatchNorm3d(32), nn.ReLU(), nn.MaxPool3d(2),
        nn.Flatten(), nn.LazyLinear(classes))


def make_loader(meshes, steps, workers, size=SIZE, batch=BATCH, seed=1):
    """`steps` batches, of which each worker makes its share while the network is busy."""
    variants = -(-steps * batch // len(meshes))
    stream = VoxelStream(meshes, size, variants=variants, seed=seed, batch_size=batch, **AUGMENTATION)
    return DataLoader(stream, batch_size=None, num_workers=workers,
                      multiprocessing_context="spawn" if workers else None)


class Training:
    """Steps of training, and how long they took and waited for voxels."""

    def __init__(self, network, steps):
        self._network = network
        self._optimizer = torch.optim.Adam(network.parameters(), lr=2e-3)
        self._schedule = torch.optim.lr_scheduler.OneCycleLR(self._optimizer, 5e-3, total_steps=steps)
        self._steps = steps
        self.waited = []
        self.taken = []

    def _step(self, voxels, labels):
        self._network.train()
        self._optimizer.zero_grad()
        loss = nn.functional.cross_entropy(self._network(voxels.float()), labels)
        loss.backward()
        self._optimizer.step()
        self._schedule.step()

    def run(self, loader, after_step=lambda step: None):
        batches = iter(loader)
        for step in range(1, self._steps + 1):
            begin = time.perf_counter()
            voxels, labels = next(batches)
            middle = time.perf_counter()
            self._step(voxels, labels)
            end = time.perf_counter()
            self.waited.append(middle - begin)
            self.taken.append(end - begin)
            after_step(step)

    def summary(self, skip=3):
        """Milliseconds of a step and those waited, means without the first steps, which start the workers."""
        skip = min(skip, len(self.taken) - 1)
        return 1e3 * np.mean(self.taken[skip:]), 1e3 * np.mean(self.waited[skip:])


def accuracy(network, voxels, labels):
    network.eval()
    with torch.no_grad():
        return (network(voxels.float()).argmax(1) == labels).float().mean().item()


def draw_curve(points, chance, file):
    """Writes pairs (step, accuracy) as a chart."""
    steps, values = np.array(points, float).T
    table = vtkTable()
    for name, column in (("step", steps), ("accuracy", 100 * values), ("chance", np.full(len(steps), 100 * chance))):
        array = numpy_to_vtk(column, deep=True)
        array.SetName(name)
        table.AddColumn(array)
    chart = vtkChartXY()
    chart.SetShowLegend(True)
    chart.GetLegend().SetVerticalAlignment(vtkChartLegend.CENTER)
    chart.SetTitle("Accuracy on held-out variants")
    for column, color in ((1, (30, 90, 180, 255)), (2, (150, 150, 150, 255))):
        line = chart.AddPlot(vtkChart.LINE)
        line.SetInputData(table, 0, column)
        line.SetColor(*color)
        line.SetWidth(3.0)
    for axis, title in ((vtkAxis.LEFT, "per cent"), (vtkAxis.BOTTOM, "step")):
        chart.GetAxis(axis).SetTitle(title)
    chart.GetAxis(vtkAxis.LEFT).SetRange(0, 100)
    chart.GetAxis(vtkAxis.LEFT).SetBehavior(vtkAxis.FIXED)
    actor = vtkContextActor()
    actor.GetScene().AddItem(chart)
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(actor)
    actor.GetScene().SetRenderer(renderer)
    window = vtkVoxelContext.NewHeadlessRenderWindow()
    window.SetMultiSamples(0)
    window.SetSize(800, 500)
    window.AddRenderer(renderer)
    window.Render()
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(file)
    writer.Write()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mesh")
    parser.add_argument("picture")
    parser.add_argument("--steps", type=int, default=150)
    parser.add_argument("--workers", type=int, default=1)
    arguments = parser.parse_args()

    begin = time.perf_counter()
    torch.manual_seed(1)
    meshes = [(mesh, label) for label, (_, mesh) in enumerate(shapes(arguments.mesh))]
    chance = 1 / len(meshes)
    held_out = VoxelDataset(meshes, SIZE, variants=VARIANTS_TO_VALIDATE, seed=2, **AUGMENTATION)
    voxels, labels = next(iter(DataLoader(held_out, batch_size=len(held_out))))
    network = make_network(len(meshes))
    curve = [(0, accuracy(network, voxels, labels))]

    def validate(step):
        if step % max(arguments.steps // 15, 1) == 0 or step == arguments.steps:
            curve.append((step, accuracy(network, voxels, labels)))
            print(f"step {step}: {100 * curve[-1][1]:.1f} % of the held-out variants are told right", flush=True)

    training = Training(network, arguments.steps)
    training.run(make_loader(meshes, arguments.steps, arguments.workers), validate)
    taken, waited = training.summary()
    draw_curve(curve, chance, arguments.picture)
    print(f"{arguments.steps} steps in {time.perf_counter() - begin:.0f} s; a step took {taken:.1f} ms, of which it "
          f"waited {waited:.2f} ms ({100 * waited / taken:.1f} %) for voxels")
    # With few steps, as in tests, still well above chance.
    return 0 if curve[-1][1] > 2 * chance else 1


if __name__ == "__main__":
    sys.exit(main())
