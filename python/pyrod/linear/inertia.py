"""What resists acceleration: masses of rods and bodies, between which is their compliance."""

from __future__ import annotations

from typing import NamedTuple, Union

import numpy as np
from numpy.typing import ArrayLike

from pyrod.base.arrays import finite
from pyrod.base.immutable import Array
from pyrod.linear.grid import Grid
from pyrod.linear.told import Told
from pyrod.result.equilibrium import Equilibrium
from pyrod.rod.law import within
from pyrod.rod.place import Place, on_rod
from pyrod.rod.rod import Rod
from pyrod.rotation import to_matrix
from pyrod.scene.loads import PointMass
from pyrod.scene.scene import Scene
from pyrod.solving.run import solved

Rotary = Union[bool, ArrayLike]
"""Whether cross-sections resist turning; or what they have per length, of one rod or of each."""


class _Body(NamedTuple):
    """What turns with a vertex."""

    rod: int
    vertex: int
    root: Array  #: (3, 3) of its inertia, in space


class Inertia:
    """The operator M^(1/2) C M^(1/2) on v = M^(1/2) u: C is the compliance, M the masses, lumped.

    A vector v has three numbers for each vertex with a mass; then, if cross-sections resist
    turning, three for each edge; then three for each body that does.
    """

    def __init__(self, grid: Grid, rotary: Rotary) -> None:
        scene = grid.scene
        self._grid, self._rods = grid, len(scene.rods)
        self._masses = [np.sqrt(mass)[:, None] for mass in _lumped(scene)]
        self._turning = [
            _root(rod.edge_lengths[: len(one), None, None] * one)
            for rod, one in zip(scene.rods, turning(scene, rotary), strict=True)
        ]
        self._bodies = _bodies(grid)
        counts = [len(of) for of in (*self._masses, *self._turning)] + [1] * len(self._bodies)
        self._cuts = 3 * np.cumsum(counts)
        heavy = np.ones(self._cuts[-1], dtype=bool)
        masses = np.vstack(self._masses)
        heavy[: 3 * len(masses)] = np.repeat(masses[:, 0] > 0, 3)
        self._heavy, self.size = heavy, int(heavy.sum())

    def __call__(self, v: Array) -> Array:
        """The product with a vector."""
        told = self.answer(v)
        parts = [root * told[f"rods.{i}.positions"] for i, root in enumerate(self._masses)]
        for i, root in enumerate(self._turning):
            parts.append(_times(root, told[f"rods.{i}.frames"]))
        for body in self._bodies:
            parts.append(body.root @ told[f"rods.{body.rod}.rotations"][body.vertex])
        return np.concatenate([part.reshape(-1) for part in parts])[self._heavy]

    def answer(self, v: Array) -> Told:
        """What M^(1/2) v, as loads, does."""
        whole = np.zeros(len(self._heavy))
        whole[self._heavy] = v
        parts = [part.reshape(-1, 3) for part in np.split(whole, self._cuts[:-1])]
        pushed, turned = parts[: self._rods], parts[self._rods : 2 * self._rods]
        compiled = self._grid._compiled
        forces = [root * part for root, part in zip(self._masses, pushed, strict=True)]
        numbers = compiled.of_forces(forces)
        if any(map(len, self._turning)):
            moments = [_times(root, part) for root, part in zip(self._turning, turned, strict=True)]
            numbers = numbers + compiled.of_moments(moments)
        for body, part in zip(self._bodies, parts[2 * self._rods :], strict=True):
            numbers = numbers + compiled.of_moment(body.rod, body.vertex, body.root @ part[0])
        return self._grid.push(numbers)


def _times(roots: Array, vectors: Array) -> Array:
    return np.einsum("eij,ej->ei", roots, vectors[: len(roots)])


def _root(inertia: Array) -> Array:
    """Symmetric roots of (..., 3, 3) inertias."""
    values, axes = np.linalg.eigh(inertia)
    return np.einsum("...ij,...j,...kj->...ik", axes, np.sqrt(np.maximum(values, 0.0)), axes)


# Masses -------------------------------------------------------------------------------------------


def _lumped(scene: Scene) -> list[Array]:
    """(n + 1,) masses of the vertices of each rod, with the bodies there."""
    out = []
    for rod in scene.rods:
        half = rod.edge_lengths * rod.mass_per_length / 2
        out.append(np.append(half, 0.0) + np.append(0.0, half))
    bodies = point_masses(scene)
    if not bodies and any((mass == 0).any() for mass in out):
        raise ValueError(
            "modes: a rod has no mass; give its material a density, or its section mass_per_length="
        )
    for body in bodies:
        for number, vertex, share in _shares(scene, body.at):
            out[number][vertex] += share * body.mass
    return out


def point_masses(scene: Scene) -> list[PointMass]:
    """Those of a scene."""
    return [load for load in scene.loads if isinstance(load, PointMass)]


def _shares(scene: Scene, at: Place) -> list[tuple[int, int, float]]:
    """Vertices that share what is at a place as by a lever: rod, vertex, and part."""
    number, s = on_rod(at, [rod.length for rod in scene.rods])
    rod = scene.rods[number]
    edge = int(np.clip(np.searchsorted(rod.arc_lengths, s, "right") - 1, 0, rod.edges - 1))
    part = (s - rod.arc_lengths[edge]) / rod.edge_lengths[edge]
    both = [(number, edge, 1 - part), (number, edge + 1, part)]
    return [(i, j, share) for i, j, share in both if share > 1e-9]


def _bodies(grid: Grid) -> list[_Body]:
    """Those that resist turning."""
    heavy = [body for body in point_masses(grid.scene) if body.inertia is not None]
    out = []
    here = _on_its_grid(grid) if heavy else grid.result
    for body in heavy:
        assert body.inertia is not None
        matrix = body.inertia if body.inertia.ndim == 2 else np.diag(body.inertia)
        for rod, vertex, share in _shares(grid.scene, body.at):
            R = to_matrix(here.rods[rod].vertex_frames[vertex])
            out.append(_Body(rod, vertex, _root(share * R @ matrix @ R.T)))
    return out


def _on_its_grid(grid: Grid) -> Equilibrium:
    """The equilibrium of the edges: that of a result with a tolerance is of none."""
    if grid.result.accuracy is None:
        return grid.result
    return solved(grid.scene, start=grid.result, stable=False)


# Rotary inertia -----------------------------------------------------------------------------------


def turning(scene: Scene, rotary: Rotary) -> list[Array]:
    """Rotary inertia per length of the edges of each rod [kg m]: (n, 3, 3), or none, (0, 3, 3)."""
    if isinstance(rotary, (bool, np.bool_)):
        if not rotary:
            return [np.zeros((0, 3, 3))] * len(scene.rods)
        return [_by_outline(rod, number) for number, rod in enumerate(scene.rods)]
    given = checked_rotary(rotary, len(scene.rods))
    return [
        np.broadcast_to(np.diag(one), (rod.edges, 3, 3))
        for one, rod in zip(given, scene.rods, strict=True)
    ]


def checked_rotary(rotary: ArrayLike, rods: int) -> Array:
    """(rods, 3) as given."""
    made = finite(rotary, "rotary")
    if made.shape not in ((3,), (rods, 3)) or (made < 0).any():
        raise ValueError(
            "rotary: expected True, or moments of inertia per length about a1, a2, a3 [kg m], not "
            f"negative, of shape (3,) or ({rods}, 3), one row per rod, got {made}"
        )
    return np.broadcast_to(made, (rods, 3))


def _by_outline(rod: Rod, number: int) -> Array:
    """Of sections whose mass is spread evenly over their outlines."""
    if not rod.mass_per_length.any():
        return np.zeros((rod.edges, 3, 3))
    out = []
    for mass, ends in zip(rod.mass_per_length, rod._law.outlines(rod.edge_lengths), strict=True):
        outline = within(ends, 0.5)
        if outline is None:
            raise ValueError(
                f"rotary: rod {number} has no outline, from which its rotary inertia would follow; "
                "give its section an outline=, or numbers: rotary=(J1, J2, J3) [kg m] about a1, "
                "a2, a3"
            )
        if np.abs(outline.centroid).max() > 1e-9 * outline.size:
            raise ValueError(
                f"rotary: the outline of rod {number} has its centroid at "
                f"({outline.centroid[0]:.3g}, {outline.centroid[1]:.3g}), off the axis of the rod, "
                "which is not known here"
            )
        out.append(mass / outline.area * outline.second_moments)
    return np.array(out)
