"""Data sets of PyTorch whose voxels are made when they are asked for, by vtkTetraCoveringVoxelizer.

    from torch.utils.data import DataLoader
    from vtkvoxelization.torch import MeshFolder, VoxelDataset, VoxelStream

    meshes = MeshFolder("ModelNet10", subset="train")           # FOLDER/CLASS/train/MESH.stl ...
    stream = VoxelStream(meshes, 32, variants=100, seed=1, batch_size=64, scale=(0.8, 1.2))
    loader = DataLoader(stream, batch_size=None, num_workers=2, multiprocessing_context="spawn")
    for epoch in range(10):
        stream.set_epoch(epoch)
        for voxels, labels in loader:                           # (64, 1, 32, 32, 32), unsigned bytes
            network(voxels.float())

Nothing is stored, and nothing copied on the CPU: the voxelizer writes into the memory of the tensors, with
workers into memory that these share with the trainer.

Each sample is a variant of a mesh by its number. Sample i of epoch e is variant e * N + i of mesh
i // variants, where N is the number of samples; with a seed, it is the same on each machine and with any
number of workers. Data sets of one seed have the same variants: give those for training and for validation
different seeds.

Workers make an OpenGL context each, when they make their first voxels. Those that are forked can do so only
if the process that they come from has made none yet; multiprocessing_context="spawn" (or "forkserver")
always works, and persistent_workers=True keeps the workers from one epoch to the next.
"""
import math
import os
from collections import OrderedDict
from numbers import Integral

import numpy as np
from vtkmodules.util.misc import calldata_type
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import VTK_STRING

from . import vtkTetraCoveringVoxelizer
from .meshes import LabelledMesh, MeshError, MeshFolder, ProgressBar, read_mesh

try:
    import torch
    from torch.utils.data import Dataset, IterableDataset, get_worker_info
except ImportError as error:
    raise ImportError("vtkvoxelization.torch needs PyTorch, the package torch; all else does without") from error

__all__ = ["LabelledMesh", "MeshError", "MeshFolder", "ProgressBar", "VoxelDataset", "VoxelStream", "read_mesh"]

# A sum of twelve uniform numbers never is beyond six standard deviations.
_LARGEST_NORMAL = 6.0


def _whole(name, value, least):
    if isinstance(value, bool) or not isinstance(value, Integral) or value < least:
        raise ValueError(f"{name} is {value!r}; it must be a whole number of at least {least}")
    return int(value)


def _pair(name, values, count):
    try:
        numbers = tuple(float(value) for value in values)
    except (TypeError, ValueError):
        numbers = ()
    if len(numbers) != count or not all(map(math.isfinite, numbers)):
        raise ValueError(f"{name} is {values!r}; it must be {count} finite numbers")
    return numbers


def _size(value):
    """(depth, height, width)"""
    if isinstance(value, Integral):
        value = (value,) * 3
    if not isinstance(value, (tuple, list)) or len(value) != 3:
        raise ValueError(f"size is {value!r}; it must be one number of voxels, or (depth, height, width)")
    return tuple(_whole("size", n, 1) for n in value)


def _labelled(meshes, on_unreadable, progress):
    if isinstance(meshes, (str, os.PathLike)):
        meshes = MeshFolder(meshes, on_unreadable=on_unreadable, progress=progress)
    labelled = []
    for i, entry in enumerate(meshes):
        if not isinstance(entry, LabelledMesh):
            try:
                mesh, label = entry
            except (TypeError, ValueError):
                raise TypeError(f"mesh {i} comes without a label; give pairs (vtkPolyData, label)") from None
            entry = LabelledMesh(mesh, label, f"mesh {i}")
        labelled.append(entry)
    if not labelled:
        raise MeshError("there are no meshes; give a folder, or pairs (vtkPolyData, label)")
    return labelled


class _Settings:
    """What the voxelizers of all meshes have in common; checked here, so that no worker has to complain."""

    def __init__(self, size, seed, rotation, scale, displacement, distribution, along_normals, safe_scale, bounds,
                 shell, keep_interior, properties):
        self.size = _size(size)
        self.seed = _whole("seed", seed, -2 ** 63)
        self.rotation = rotation
        if rotation is not None and not (isinstance(rotation, str) and rotation == "uniform"):
            if isinstance(rotation, str):
                raise ValueError(f"rotation is {rotation!r}; it must be 'uniform', an axis (x, y, z), or None")
            self.rotation = _pair("rotation", rotation, 3)
            if not any(self.rotation):
                raise ValueError("the axis of rotation must have a length")
        self.scale = _pair("scale", scale, 2)
        if not 0.0 < self.scale[0] <= self.scale[1]:
            raise ValueError(f"scale is {scale!r}; the lower bound must be positive and not above the upper one")
        self.displacement = float(displacement)
        if not 0.0 <= self.displacement <= 1.0:
            raise ValueError(f"displacement is {displacement!r}; it must be 0 to 1")
        if distribution not in ("uniform", "normal"):
            raise ValueError(f"distribution is {distribution!r}; it must be 'uniform' or 'normal'")
        self.distribution = distribution
        self.along_normals = bool(along_normals)
        self.safe_scale = bool(safe_scale)
        self.bounds = None if bounds is None else _pair("bounds", bounds, 6)
        if self.bounds and safe_scale:
            raise ValueError("bounds need safe_scale=False: else each mesh is scaled to the grid")
        if self.bounds and not all(low < high for low, high in zip(self.bounds[::2], self.bounds[1::2])):
            raise ValueError(f"bounds are {bounds!r}; they must be (xmin, xmax, ymin, ymax, zmin, zmax)")
        if shell not in (0, 6, 18, 26):
            raise ValueError(f"shell is {shell!r}; it must be 0, 6, 18 or 26")
        self.shell = shell
        self.keep_interior = bool(keep_interior)
        self.properties = dict(properties or {})
        for name in self.properties:
            if not hasattr(vtkTetraCoveringVoxelizer, f"Set{name}"):
                raise ValueError(f"properties name {name!r}, which vtkTetraCoveringVoxelizer does not have")

    def _room(self, model):
        """Middle of a mesh, and how far its variants go from there on each axis, at most."""
        bounds = np.reshape(model.mesh.GetBounds(), (3, 2))
        half = (bounds[:, 1] - bounds[:, 0]) / 2
        largest = _LARGEST_NORMAL if self.distribution == "normal" else 1.0
        half = half + self.displacement * largest * 2 * half.max()
        if self.rotation is not None:
            half = np.full(3, np.linalg.norm(half))
        return bounds.mean(axis=1), half * self.scale[1]

    def _box(self, model):
        """The box that the grid of a mesh fills, (3, 2), of cubic voxels where it is not given."""
        voxels = np.array(self.size[::-1], float)
        if self.safe_scale:
            return np.stack([np.zeros(3), voxels], axis=1)
        middle, half = self._room(model)
        if self.bounds is None:
            half = voxels * (half / voxels).max()
            return np.stack([middle - half, middle + half], axis=1)
        box = np.reshape(self.bounds, (3, 2))
        low, high = middle - half, middle + half
        margin = 1e-6 * (box[:, 1] - box[:, 0])
        if (low < box[:, 0] - margin).any() or (high > box[:, 1] + margin).any():
            needed = ", ".join(f"{value:.6g}" for value in np.stack([low, high], axis=1).ravel())
            raise MeshError(f"{model.name}: its variants are larger than the grid, and need bounds of ({needed}) "
                            "at most; give such ones, or safe_scale=True")
        return box

    def check(self, model):
        self._box(model)

    def voxelizer(self, model):
        voxelizer = vtkTetraCoveringVoxelizer()
        voxelizer.SetInputData(model.mesh)
        voxelizer.SetSampleDimensions(*self.size[::-1])
        voxelizer.SetModelBounds(self._box(model).ravel())
        voxelizer.CubicVoxelsOff()
        # A training set has meshes that are not closed; their holes are closed by the voxelizer.
        voxelizer.CheckWatertightOff()
        voxelizer.SetSeed(self.seed)
        if self.rotation is None:
            voxelizer.SetRotationModeToFixed()
        elif self.rotation == "uniform":
            voxelizer.SetRotationModeToUniform()
        else:
            voxelizer.SetRotationModeToAxis()
            voxelizer.SetRotationAxis(self.rotation)
        voxelizer.SetScaleRange(self.scale)
        voxelizer.SetDisplacementAmplitude(self.displacement)
        if self.distribution == "normal":
            voxelizer.SetDisplacementDistributionToNormal()
        if self.along_normals:
            voxelizer.SetDisplacementDirectionToAlongNormal()
        voxelizer.SetSafeScaleToFit(self.safe_scale)
        voxelizer.SetShell(self.shell)
        voxelizer.SetKeepInterior(self.keep_interior)
        for name, value in self.properties.items():
            getattr(voxelizer, f"Set{name}")(*value if isinstance(value, (tuple, list)) else (value,))
        return voxelizer


class _Voxelizers:
    """The voxelizers of the meshes used last, in this process; a mesh stays on the GPU with its voxelizer."""

    def __init__(self, limit):
        self._limit = limit
        self._kept = OrderedDict()
        self._messages = []
        self._process = os.getpid()
        self._left_to_parent = None

    def __reduce__(self):
        return _Voxelizers, (self._limit,)

    def _find(self, i, model, settings):
        if self._process != os.getpid():
            # Their OpenGL objects are those of the process that this one was forked from.
            self._left_to_parent, self._kept = self._kept, OrderedDict()
            self._process = os.getpid()
        voxelizer = self._kept.pop(i, None)
        if voxelizer is None:
            voxelizer = settings.voxelizer(model)
            voxelizer.AddObserver("ErrorEvent", self._listener())
            while len(self._kept) >= self._limit:
                self._kept.popitem(last=False)
        self._kept[i] = voxelizer
        return voxelizer

    def _listener(self):
        messages = self._messages

        @calldata_type(VTK_STRING)
        def listen(_object, _event, text):
            messages.append(text)

        return listen

    def fill(self, i, model, settings, variant, out):
        """Writes a variant of mesh i into a tensor of unsigned bytes."""
        voxelizer = self._find(i, model, settings)
        array = numpy_to_vtk(out.view(-1).numpy())
        address = array.GetVoidPointer(0)
        self._messages.clear()
        if voxelizer.VoxelizeBatch(variant, 1, array):
            assert array.GetVoidPointer(0) == address, "the voxels went elsewhere"
            return
        reason = self._messages[0].strip().split("): ", 1)[-1] if self._messages else "it was not voxelized"
        if get_worker_info() and "forked" in reason:
            reason += ' Give DataLoader multiprocessing_context="spawn".'
        raise RuntimeError(f"{model.name}: {reason}")


class _Voxels:
    """What both datasets have in common."""

    def __init__(self, meshes, size, *, variants=1, seed=0, rotation="uniform", scale=(1.0, 1.0), displacement=0.0,
                 distribution="uniform", along_normals=False, safe_scale=True, bounds=None, shell=0,
                 keep_interior=False, properties=None, transform=None, cached_meshes=64, on_unreadable="warn",
                 progress=None):
        super().__init__()
        self._settings = _Settings(size, seed, rotation, scale, displacement, distribution, along_normals, safe_scale,
                                   bounds, shell, keep_interior, properties)
        self.variants = _whole("variants", variants, 1)
        self.transform = transform
        self._voxelizers = _Voxelizers(_whole("cached_meshes", cached_meshes, 1))
        self._meshes = _labelled(meshes, on_unreadable, progress)
        for model in self._meshes:
            self._settings.check(model)
        self.labels = [model.label for model in self._meshes]
        # Workers that live longer than an epoch see what is set meanwhile.
        self._epoch = torch.zeros((), dtype=torch.int64).share_memory_()

    @property
    def epoch(self):
        return int(self._epoch)

    def set_epoch(self, epoch):
        """Other variants; call it before each pass over the samples. Epoch 0 is the first one."""
        self._epoch.fill_(_whole("epoch", epoch, 0))

    @property
    def number_of_samples(self):
        return len(self._meshes) * self.variants

    def _empty(self, *shape):
        return torch.empty(*shape, 1, *self._settings.size, dtype=torch.uint8)

    def _fill(self, sample, out):
        """Writes the voxels of a sample into a tensor, and returns the label."""
        i = sample // self.variants
        model = self._meshes[i]
        variant = self.epoch * self.number_of_samples + sample
        self._voxelizers.fill(i, model, self._settings, variant, out)
        return model.label

    def _finish(self, voxels):
        return self.transform(voxels) if self.transform else voxels


_PARAMETERS = """
    meshes          a folder, FOLDER/CLASS/MESH.stl; a MeshFolder; or pairs (vtkPolyData, label)
    size            voxels on each axis, or (depth, height, width), which are z, y and x
    variants        samples of each mesh in an epoch
    seed            what all random numbers depend on
    rotation        "uniform", any; (x, y, z), by any angle about this axis; None
    scale           each axis of the mesh is scaled by a number between these two
    displacement    how far points are moved, as a fraction of the mesh's longest side; with distribution
                    "uniform" or "normal", and along_normals or freely
    safe_scale      move the mesh to the middle of the grid, and scale it so that no variant leaves it
    bounds          without safe_scale, the box that the grid fills, (xmin, xmax, ymin, ymax, zmin, zmax); a
                    mesh whose variants might leave it is a MeshError. By default a box of cubic voxels for each
                    mesh, which holds all variants
    shell           0, solids; 6, 18 or 26, their shells by so many neighbours; with keep_interior the shell has
                    the value 2, the rest 1
    properties      further properties of vtkTetraCoveringVoxelizer, by their names: {"RasterMethod": 0}
    transform       called with each tensor, gives the one that is handed out
    cached_meshes   how many meshes stay on the GPU, for each process
    on_unreadable, progress    of a folder: see MeshFolder

    Bad values are a ValueError, bad meshes a MeshError, and what fails when voxels are made a RuntimeError.
"""


class VoxelDataset(_Voxels, Dataset):
    __doc__ = f"""Samples by their number: (1, depth, height, width) of unsigned bytes, and the label.

    The loader shuffles, and makes batches of them.
    {_PARAMETERS}"""

    def __len__(self):
        return self.number_of_samples

    def __getitem__(self, i):
        i = int(i)
        if not -len(self) <= i < len(self):
            raise IndexError(f"there is no sample {i}, but {len(self)} of them")
        voxels = self._empty()
        label = self._fill(i % len(self), voxels)
        return self._finish(voxels), label


class VoxelStream(_Voxels, IterableDataset):
    __doc__ = f"""All samples of an epoch, one after the other or in batches, without a copy even of these.

    Hand it to a DataLoader with batch_size=None: the order is the same, then, whatever the number of workers.

    batch_size      None: (1, depth, height, width) and the label. Else (batch_size, 1, depth, height, width) and
                    a tensor of the labels; the last batch may be smaller
    drop_last       leave out a last batch that is smaller
    shuffle         mix the samples, by seed and epoch; else they come by their numbers
    {_PARAMETERS}"""

    def __init__(self, meshes, size, *, batch_size=None, drop_last=False, shuffle=True, **parameters):
        super().__init__(meshes, size, **parameters)
        self.batch_size = None if batch_size is None else _whole("batch_size", batch_size, 1)
        self.drop_last = bool(drop_last)
        self.shuffle = bool(shuffle)
        if len(self) == 0:
            raise ValueError(f"drop_last leaves nothing: there are {self.number_of_samples} samples, fewer than a "
                             f"batch of {batch_size}")

    def __len__(self):
        """Batches, or samples where there are none."""
        if self.batch_size is None:
            return self.number_of_samples
        whole, rest = divmod(self.number_of_samples, self.batch_size)
        return whole + (1 if rest and not self.drop_last else 0)

    def order(self):
        """The numbers of the samples in the order in which they come."""
        count = self.number_of_samples
        if not self.shuffle:
            return np.arange(count)
        return np.random.default_rng((self._settings.seed % 2 ** 64, self.epoch)).permutation(count)

    def __iter__(self):
        worker = get_worker_info()
        first, step = (worker.id, worker.num_workers) if worker else (0, 1)
        order = self.order()
        for i in range(first, len(self), step):
            if self.batch_size is None:
                yield self._sample(int(order[i]))
            else:
                yield self._batch(order[i * self.batch_size:(i + 1) * self.batch_size])

    def _sample(self, number):
        voxels = self._empty()
        label = self._fill(number, voxels)
        return self._finish(voxels), label

    def _batch(self, numbers):
        voxels = self._empty(len(numbers))
        if get_worker_info():
            voxels.share_memory_()
        labels = [self._fill(int(number), out) for number, out in zip(numbers, voxels)]
        return self._finish(voxels), torch.tensor(labels)
