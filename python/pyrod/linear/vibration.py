"""Vibration about an equilibrium."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from pyrod.base.immutable import Array, Immutable
from pyrod.linear.grid import Grid
from pyrod.rotation import rotate

_BLOCK = 4
"""Vectors at a time: so many modes of one frequency are found together."""


@dataclass(frozen=True, eq=False)
class Modes(Immutable):
    """Small vibrations: masses of the rods, lumped at their vertices, on their linear response.

    With accelerations as dead loads, u = w^2 C M u, where C is the compliance of the vertices. The
    inertia of turning cross-sections is left out.
    """

    frequencies: Array = field(repr=False)  #: (k,) [Hz], the lowest first
    shapes: tuple[Array, ...] = field(repr=False)
    """Of each rod (k, n + 1, 3) displacements of the vertices, with the sum of m u^2 one."""
    frames: tuple[Array, ...] = field(repr=False)
    """Of each rod (k, n, 3) rotation vectors of the edges, in their components."""
    errors: Array | None = None
    """(k,) estimates of the errors of the frequencies [Hz], if the result has a tolerance. Then the
    frequencies are what those of finer and finer grids tend to; shapes are those of the first."""

    @property
    def angular_frequencies(self) -> Array:
        """(k,) [rad/s]."""
        return 2 * np.pi * self.frequencies


def modes_of(grid: Grid, count: int) -> Modes:
    """See `Linearised.modes`."""
    if not isinstance(count, int) or count < 1:
        raise ValueError(f"modes: expected a number of them, 1 or more, got {count}")
    _refuse(grid)
    masses = [_lumped(rod.edge_lengths, rod.mass_per_length) for rod in grid.scene.rods]
    if any((m == 0).any() for m in masses):
        raise ValueError(
            "modes: a rod has no mass; give its material a density, or its section mass_per_length="
        )
    root = np.sqrt(np.concatenate([np.repeat(m, 3) for m in masses]))
    cuts = np.cumsum([3 * len(m) for m in masses])[:-1]

    def apply(v: Array) -> Array:
        forces = [part.reshape(-1, 3) for part in np.split(root * v, cuts)]
        told = grid.under_forces(forces)
        moved = [told[f"rods.{i}.positions"].reshape(-1) for i in range(len(forces))]
        return root * np.concatenate(moved)

    planar = grid.scene.space == "planar"
    values, vectors = _highest(apply, len(root), count, _plane(grid) if planar else None)
    shapes, frames = _turns_too(grid, values, vectors, root, cuts)
    return Modes(1 / (2 * np.pi * np.sqrt(values)), shapes, frames)


def _refuse(grid: Grid) -> None:
    if not grid.symmetric:
        raise ValueError("modes: the loads have no potential, and so vibrations no modes here")
    if grid.result.index != 0:
        raise ValueError(
            f"modes: the equilibrium is unstable, with index {grid.result.index}: it does not "
            "vibrate"
        )


def _lumped(h: Array, per_length: Array) -> Array:
    half = h * per_length / 2
    out = np.zeros(len(h) + 1)
    out[:-1] += half
    out[1:] += half
    return out


def _plane(grid: Grid) -> Array:
    """The projection on the plane."""
    normal = rotate(grid.scene.plane[1], np.array([0.0, 1.0, 0.0]))
    return np.eye(3) - np.outer(normal, normal)


def _highest(
    apply: Callable[[Array], Array], size: int, count: int, plane: Array | None
) -> tuple[Array, Array]:
    """The largest eigenvalues of a symmetric operator, and their vectors, by blocks of Lanczos
    vectors that are all kept orthogonal."""
    rng = np.random.default_rng(1)
    block = rng.standard_normal((size, _BLOCK))
    if plane is not None:
        block = np.einsum("ij,vjk->vik", plane, block.reshape(-1, 3, _BLOCK)).reshape(size, _BLOCK)
    basis = np.zeros((size, 0))
    images = np.zeros((size, 0))
    for _ in range(max(12, 4 * count)):
        fresh = _orthonormal(block, basis)
        if fresh.shape[1] == 0:
            break
        new = np.stack([apply(v) for v in fresh.T], axis=1)
        basis, images = np.hstack([basis, fresh]), np.hstack([images, new])
        small = basis.T @ images
        values, parts = np.linalg.eigh((small + small.T) / 2)
        order = np.argsort(values)[::-1][:count]
        values, parts = values[order], parts[:, order]
        left = images @ parts - basis @ parts * values
        if (
            len(values) == count
            and (np.linalg.norm(left, axis=0) <= 1e-9 * np.maximum(values, 1e-6 * values[0])).all()
        ):
            return values, basis @ parts
        block = new
    if len(values) < count or not (values > 1e-14 * values[0]).all():
        raise ValueError(f"modes: there are fewer than {count} on these edges")
    raise ValueError(f"modes: the {count} lowest were not found to the digits there are")


def _orthonormal(block: Array, basis: Array) -> Array:
    """Of the block what is not in the basis."""
    scale = np.linalg.norm(block, axis=0).max()
    for _ in range(2):
        block = block - basis @ (basis.T @ block)
    q, r = np.linalg.qr(block)
    q = q[:, np.abs(np.diag(r)) > 1e-12 * scale]
    return np.linalg.qr(q - basis @ (basis.T @ q))[0]


def _turns_too(
    grid: Grid, values: Array, vectors: Array, root: Array, cuts: Array
) -> tuple[tuple[Array, ...], tuple[Array, ...]]:
    """Displacements and turns of the modes: those under their own inertia."""
    positions, frames = [], []
    for value, v in zip(values, vectors.T, strict=True):
        forces = [part.reshape(-1, 3) for part in np.split(root * v / value, cuts)]
        told = grid.under_forces(forces)
        positions.append([told[f"rods.{i}.positions"] for i in range(len(forces))])
        frames.append([told[f"rods.{i}.frames"] for i in range(len(forces))])
    return _by_rod(positions), _by_rod(frames)


def _by_rod(modes: list[list[Array]]) -> tuple[Array, ...]:
    return tuple(np.array(rod) for rod in zip(*modes, strict=True))
