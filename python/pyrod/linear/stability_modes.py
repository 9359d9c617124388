"""The softest motions of an equilibrium: the lowest modes of the second variation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from pyrod.base.immutable import Array
from pyrod.linear.grid import Grid
from pyrod.linear.motions import Motions, by_rod, checked_count
from pyrod.linear.rungs import Rungs
from pyrod.linear.spectrum import largest


@dataclass(frozen=True, eq=False, repr=False)
class StabilityModes(Motions):
    """Motions in which the energy grows least, or falls: those of the second variation.

    The first has the ``lowest_eigenvalue`` of the result; as many are negative as its ``index``
    says. ``shapes`` and ``frames`` are for modes with int ``|phi|^2`` ds/L = 1.
    """

    eigenvalues: Array = field(kw_only=True)  #: (k,) [N m], the lowest first
    errors: Array | None = field(default=None, kw_only=True)
    """(k,) estimates of their errors [N m], if the result has a tolerance. Then the eigenvalues are
    what those of finer and finer grids tend to; shapes are those of the first."""

    def title(self, number: int) -> str:
        """The eigenvalue of one mode."""
        return f"eigenvalue {self.eigenvalues[number]:.4g} N m"

    def __repr__(self) -> str:
        told = ", ".join(f"{value:.4g}" for value in self.eigenvalues[:6])
        more = len(self.eigenvalues) - 6
        return f"StabilityModes({told} N m{f'; and {more} more' if more > 0 else ''})"


def stability_modes_of(rungs: Rungs, count: int) -> StabilityModes:
    """See `Linearised.stability_modes`."""
    count = checked_count(count, "stability_modes")
    if not rungs.climbs:
        return _softest(rungs.first, count)
    found: list[StabilityModes] = []

    def of(grid: Grid) -> dict[str, Any]:
        found.append(_softest(grid, count))
        return {str(i): value for i, value in enumerate(found[-1].eigenvalues)}

    limits, errors = rungs.judged(of)
    told, off = (np.array([float(of[str(i)]) for i in range(count)]) for of in (limits, errors))
    return replace(found[0], eigenvalues=told, errors=np.abs(told) * off)


def _softest(grid: Grid, count: int) -> StabilityModes:
    """On one grid."""
    if not grid.symmetric:
        raise ValueError("stability_modes: the loads have no potential, and so no second variation")
    if grid.result.neutral:
        raise ValueError(
            f"stability_modes: the equilibrium can move without a change of energy "
            f"({grid.result.free_motion}), to rounding; hold that motion"
        )
    compiled = grid._compiled
    root = np.sqrt(compiled.weights)
    own = root > 0  # but for multipliers

    def moved(v: Array) -> Array:
        rows = np.zeros(len(root))
        rows[own] = root[own] * v
        return compiled.solved(rows)

    def soft(v: Array) -> Array:
        return (root * moved(v))[own]

    values, vectors = _lowest(soft, int(own.sum()), count, grid.result.index)
    pairs = zip(vectors.T, values, strict=True)
    told = [compiled.follow(value * moved(v)) for v, value in pairs]
    shapes, frames = (by_rod(told, len(grid.scene.rods), of) for of in ("positions", "frames"))
    return StabilityModes(grid.result, shapes, frames, eigenvalues=values)


def _lowest(
    soft: Callable[[Array], Array], size: int, count: int, negative: int
) -> tuple[Array, Array]:
    """Eigenvalues (k,) of the stiffness, and vectors (size, k), by the ends of those of its
    inverse: negative ones first, of which there are so many."""
    values, vectors = np.zeros(0), np.zeros((size, 0))
    if negative:
        falling, vectors = largest(lambda v: -soft(v), size, negative)
        values, vectors = -1 / falling[::-1], vectors[:, ::-1]
    if count > negative:
        rising, more = largest(soft, size, count - negative)
        values, vectors = np.append(values, 1 / rising), np.hstack([vectors, more])
    if len(values) < max(count, negative):
        raise ValueError(f"stability_modes: there are fewer than {count}, {len(values)}")
    return values[:count], vectors[:, :count]
