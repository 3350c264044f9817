"""Proves of the datasets in vtkvoxelization.torch that

- a sample holds what vtkTetraCoveringVoxelizer gives for its seed, its mesh and its number;
- voxels are written into the memory of the tensor that is handed out, with workers into shared memory;
- samples and batches are the same without workers and with any number of them, forked, spawned and kept from
  one epoch to the next, and epochs, seeds and shuffling change what they should;
- no variant leaves the grid, by safe_scale and by the grid that holds all variants;
- bad arguments, meshes and workers give one clear error.

Skipped where there is no PyTorch.
"""
import pickle
import shutil
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkFiltersSources import vtkConeSource, vtkCubeSource, vtkSphereSource
from vtkmodules.vtkIOGeometry import vtkSTLWriter
from vtkvoxelization import vtkTetraCoveringVoxelizer

try:
    import torch
    from torch.utils.data import DataLoader
except ImportError:
    print("There is no PyTorch (torch).")
    sys.exit(125)

import vtkvoxelization.torch
from vtkvoxelization.torch import MeshError, MeshFolder, VoxelDataset, VoxelStream

SIZE = (12, 16, 20)
VARIED = dict(scale=(0.7, 1.2), displacement=0.02)
SECONDS = 300


def output(source):
    source.Update()
    return source.GetOutput()


def meshes():
    return [(output(kind()), label) for label, kind in enumerate((vtkSphereSource, vtkCubeSource, vtkConeSource))]


def stream(**parameters):
    return VoxelStream(meshes(), SIZE, **{**VARIED, "variants": 3, "seed": 5, "batch_size": 4, **parameters})


def batches(dataset, workers=0, **parameters):
    if workers:
        parameters["timeout"] = SECONDS
    loader = DataLoader(dataset, batch_size=None, num_workers=workers, **parameters)
    return [(voxels.clone(), labels.clone()) for voxels, labels in loader]


def shared(voxels):
    """A transform, which in a worker gives what is not there for tensors of its own."""
    return voxels if voxels.is_shared() else voxels.new_zeros(())


def equal(some, others):
    return len(some) == len(others) and all(
        torch.equal(a, c) and torch.equal(b, d) for (a, b), (c, d) in zip(some, others))


FORKED = {}


def setUpModule():
    """Workers are forked before this process has made its first voxels."""
    if sys.platform.startswith("linux"):
        for workers in (1, 2):
            FORKED[workers] = batches(stream(transform=shared), workers, multiprocessing_context="fork")


class Samples(unittest.TestCase):

    def test_voxels(self):
        dataset = VoxelDataset(meshes(), SIZE, variants=3, seed=5, shell=26, keep_interior=True, **VARIED)
        dataset.set_epoch(2)
        self.assertEqual(len(dataset), 9)
        for i in (0, 4, 8, -1):
            voxels, label = dataset[i]
            mesh, expected_label = meshes()[i % 9 // 3]
            voxelizer = vtkTetraCoveringVoxelizer()
            voxelizer.SetInputData(mesh)
            voxelizer.SetSampleDimensions(SIZE[::-1])
            voxelizer.SetModelBounds(0, SIZE[2], 0, SIZE[1], 0, SIZE[0])
            voxelizer.SetSeed(5)
            voxelizer.SetRotationModeToUniform()
            voxelizer.SetScaleRange(VARIED["scale"])
            voxelizer.SetDisplacementAmplitude(VARIED["displacement"])
            voxelizer.SafeScaleToFitOn()
            voxelizer.SetShell(26)
            voxelizer.KeepInteriorOn()
            array = vtkUnsignedCharArray()
            self.assertTrue(voxelizer.VoxelizeBatch(2 * 9 + i % 9, 1, array))
            self.assertEqual((tuple(voxels.shape), voxels.dtype, label), ((1, *SIZE), torch.uint8, expected_label))
            self.assertTrue(np.array_equal(voxels.numpy().ravel(), vtk_to_numpy(array)))
            self.assertEqual(set(np.unique(voxels)), {0, 1, 2})
        with self.assertRaises(IndexError):
            dataset[9]

    def test_no_copy(self):
        addresses = []
        make = vtkvoxelization.torch.numpy_to_vtk

        def remember(values):
            addresses.append(values.__array_interface__["data"][0])
            return make(values)

        with mock.patch.object(vtkvoxelization.torch, "numpy_to_vtk", remember):
            voxels, _ = VoxelDataset(meshes(), SIZE)[1]
            self.assertEqual(addresses, [voxels.data_ptr()])
            addresses.clear()
            whole, labels = next(iter(DataLoader(stream(), batch_size=None)))
        self.assertEqual(addresses, [whole.data_ptr() + i * int(np.prod(SIZE)) for i in range(4)])
        self.assertEqual(labels.shape, (4,))
        self.assertTrue(all(sample.any() for sample in whole))

    def test_safe(self):
        """What a border cuts off leaves its section there."""
        for parameters in (dict(safe_scale=True), dict(safe_scale=False)):
            dataset = VoxelDataset(meshes(), SIZE, variants=12, scale=(0.5, 1.7), displacement=0.05, **parameters)
            for i in range(len(dataset)):
                voxels = dataset[i][0][0].numpy()
                self.assertTrue(voxels.any())
                sides = [voxels[0], voxels[-1], voxels[:, 0], voxels[:, -1], voxels[:, :, 0], voxels[:, :, -1]]
                self.assertLess(max(side.mean() for side in sides), 0.1)

    def test_epochs_and_seeds(self):
        dataset = VoxelDataset(meshes(), SIZE, variants=2)
        first = [dataset[i][0] for i in range(6)]
        self.assertFalse(torch.equal(first[2], first[3]))
        dataset.set_epoch(1)
        self.assertFalse(torch.equal(dataset[2][0], first[2]))
        dataset.set_epoch(0)
        self.assertTrue(torch.equal(dataset[2][0], first[2]))
        self.assertFalse(torch.equal(VoxelDataset(meshes(), SIZE, variants=2, seed=1)[2][0], first[2]))
        copy = pickle.loads(pickle.dumps(dataset))
        self.assertTrue(all(torch.equal(copy[i][0], voxels) for i, voxels in enumerate(first)))


class Loaders(unittest.TestCase):

    def test_order(self):
        samples = VoxelDataset(meshes(), SIZE, variants=3, seed=5, **VARIED)
        shuffled = stream()
        orders = []
        for epoch in (0, 1):
            shuffled.set_epoch(epoch)
            samples.set_epoch(epoch)
            order = shuffled.order()
            self.assertEqual(sorted(order), list(range(9)))
            found = batches(shuffled)
            self.assertEqual([len(labels) for _, labels in found], [4, 4, 1])
            for number, voxels, label in zip(order, torch.cat([v for v, _ in found]), torch.cat([n for _, n in found])):
                self.assertTrue(torch.equal(voxels, samples[number][0]))
                self.assertEqual(label, number // 3)
            orders.append(list(order))
        self.assertNotEqual(*orders)
        self.assertEqual(list(stream(shuffle=False).order()), list(range(9)))
        self.assertEqual(len(stream(drop_last=True)), 2)
        self.assertEqual(len(batches(stream(drop_last=True))), 2)
        singly = list(DataLoader(stream(batch_size=None), batch_size=None))
        self.assertEqual([tuple(voxels.shape) for voxels, _ in singly], [(1, *SIZE)] * 9)
        self.assertEqual([label for _, label in singly], [number // 3 for number in stream().order()])

    def test_forked(self):
        if not FORKED:
            self.skipTest("no fork")
        expected = batches(stream())
        for workers, found in FORKED.items():
            self.assertTrue(equal(found, expected), workers)

    def test_forked_late(self):
        if not FORKED:
            self.skipTest("no fork")
        batches(stream())
        with self.assertRaisesRegex(RuntimeError, 'multiprocessing_context="spawn"'):
            batches(stream(), 1, multiprocessing_context="fork")
        self.assertEqual(len(batches(stream())), 3)

    def test_spawned(self):
        dataset = stream(transform=shared)
        loader = DataLoader(dataset, batch_size=None, num_workers=2, multiprocessing_context="spawn",
                            persistent_workers=True, timeout=SECONDS)
        found = []
        for epoch in (0, 1):
            dataset.set_epoch(epoch)
            found.append([(voxels.clone(), labels) for voxels, labels in loader])
        here = stream()
        for epoch in (0, 1):
            here.set_epoch(epoch)
            self.assertTrue(equal(found[epoch], batches(here)), epoch)
        self.assertFalse(equal(*found))

    def test_shuffled(self):
        dataset = VoxelDataset(meshes(), SIZE, variants=2)
        loader = DataLoader(dataset, batch_size=6, shuffle=True, generator=torch.Generator().manual_seed(3))
        voxels, labels = next(iter(loader))
        self.assertEqual((tuple(voxels.shape), sorted(labels.tolist())), ((6, 1, *SIZE), [0, 0, 1, 1, 2, 2]))

    def test_folder(self):
        root = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, root)
        for name, (mesh, _) in zip(("ball", "box"), meshes()):
            (root / name).mkdir()
            writer = vtkSTLWriter()
            writer.SetInputData(mesh)
            writer.SetFileName(str(root / name / "mesh.stl"))
            writer.Write()
        (root / "box" / "bad.stl").write_bytes(b"")
        with self.assertWarnsRegex(UserWarning, "bad.stl"):
            dataset = VoxelDataset(root, 16, variants=2)
        self.assertEqual((len(dataset), dataset.labels), (4, [0, 1]))
        with self.assertRaisesRegex(MeshError, "bad.stl"):
            VoxelDataset(str(root), 16, on_unreadable="error")
        with self.assertWarns(UserWarning):
            folder = MeshFolder(root)
        self.assertTrue(torch.equal(VoxelDataset(folder, 16)[1][0], VoxelDataset(list(folder), 16)[1][0]))


class Errors(unittest.TestCase):

    def test_arguments(self):
        for parameters, text in (
                (dict(variants=0), "variants is 0"),
                (dict(variants=1.5), "variants is 1.5"),
                (dict(seed="x"), "seed is 'x'"),
                (dict(rotation="any"), "rotation is 'any'"),
                (dict(rotation=(0, 0, 0)), "axis of rotation"),
                (dict(rotation=(0, 1)), "3 finite numbers"),
                (dict(scale=(0, 1)), "lower bound"),
                (dict(scale=2), "2 finite numbers"),
                (dict(displacement=2), "displacement is 2"),
                (dict(distribution="any"), "distribution is 'any'"),
                (dict(shell=7), "shell is 7"),
                (dict(bounds=(0, 1, 0, 1, 0, 1)), "safe_scale=False"),
                (dict(bounds=(0, 1, 0, 0, 0, 1), safe_scale=False), "xmin, xmax"),
                (dict(properties={"Sed": 1}), "'Sed'"),
                (dict(cached_meshes=0), "cached_meshes is 0")):
            with self.assertRaisesRegex(ValueError, text):
                VoxelDataset(meshes(), SIZE, **parameters)
        for size in (0, (1, 2), "64", (4, 4, -1)):
            with self.assertRaisesRegex(ValueError, "size is"):
                VoxelDataset(meshes(), size)
        with self.assertRaisesRegex(ValueError, "batch_size is 0"):
            stream(batch_size=0)
        with self.assertRaisesRegex(ValueError, "leaves nothing"):
            stream(batch_size=10, drop_last=True)
        with self.assertRaisesRegex(ValueError, "epoch is -1"):
            stream().set_epoch(-1)

    def test_meshes(self):
        with self.assertRaisesRegex(MeshError, "there are no meshes"):
            VoxelDataset([], SIZE)
        with self.assertRaisesRegex(TypeError, "without a label"):
            VoxelDataset([meshes()[0][0]], SIZE)
        with self.assertRaisesRegex(MeshError, "no such folder"):
            VoxelDataset("/nonexistent", SIZE)

    def test_mesh_larger_than_grid(self):
        """A cube of side 1 about the origin, whose half diagonal is 0.866."""
        cube = [(output(vtkCubeSource()), 0)]
        for half, parameters in ((0.49, dict(rotation=None)), (0.8, {}), (0.99, dict(rotation=None, scale=(1, 2))),
                                 (0.55, dict(rotation=None, displacement=0.1))):
            with self.assertRaisesRegex(MeshError, "mesh 0: its variants are larger than the grid"):
                VoxelDataset(cube, 8, safe_scale=False, bounds=(-half, half) * 3, **parameters)
        for half, parameters in ((0.5, dict(rotation=None)), (0.87, {}), (0.61, dict(rotation=None, displacement=0.1))):
            dataset = VoxelDataset(cube, 8, safe_scale=False, bounds=(-half, half) * 3, **parameters)
            self.assertTrue(dataset[0][0].any())

    def test_voxelizer(self):
        """What only the voxelizer knows arrives as an exception, and the next sample is fine."""
        dataset = VoxelDataset(meshes(), 64, properties={"MemoryLimit": 1})
        with self.assertRaisesRegex(RuntimeError, "mesh 1: .*MemoryLimit"):
            dataset[1]


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
