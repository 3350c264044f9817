"""Measures how long a step of training waits for voxels, which are made as it goes, and prints a table.

    feeding.py MESH.ply [STEPS]

The network and the shapes are those of Examples/Python/train_network.py, on the CPU. Needs PyTorch, and the
module on PYTHONPATH. The better of two rounds counts: the one whose steps took least.
"""
import sys
from pathlib import Path

import torch

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "Examples" / "Python"))

import train_network  # noqa: E402

ROUNDS = 2
# Voxels on each side, samples in a batch, workers.
CASES = ((32, 32, 0), (32, 32, 1), (64, 8, 0), (64, 8, 1))


def measure(meshes, size, batch, workers, steps):
    torch.manual_seed(1)
    network = train_network.make_network(len(meshes))
    training = train_network.Training(network, steps)
    training.run(train_network.make_loader(meshes, steps, workers, size, batch))
    return training.summary()


def main():
    steps = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    meshes = [(mesh, label) for label, (_, mesh) in enumerate(train_network.shapes(sys.argv[1]))]
    print("| milliseconds of a training step | step | waited for voxels | per cent |")
    print("| --- | --- | --- | --- |")
    for size, batch, workers in CASES:
        taken, waited = min(measure(meshes, size, batch, workers, steps) for _ in range(ROUNDS))
        name = f"{batch} variants of {size}^3, {workers} worker{'' if workers == 1 else 's'}"
        print(f"| {name} | {taken:.1f} | {waited:.2f} | {100 * waited / taken:.1f} |", flush=True)


if __name__ == "__main__":
    main()
