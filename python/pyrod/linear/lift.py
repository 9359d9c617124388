"""Arrays along a rod on finer edges: as the rod brings its own there."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyrod.base.immutable import Array
from pyrod.rod.rod import Rod

AT_VERTICES = ("bending", "K0")


class Lift:
    """What changes of one of these arrays change of that of the rod with every edge cut in 2^level.

    A linear map, and its transpose. Of arrays at vertices each fine value goes with the two at the
    ends of its edge: one has an even number and one an odd one, so that two changes tell all.
    """

    def __init__(self, rod: Rod, name: str, level: int) -> None:
        self.shape = np.shape(getattr(rod, name))
        self._name, self._parts = name, 2**level
        if name not in AT_VERTICES:
            return
        fine = np.arange(rod.edges * self._parts + 1) // self._parts
        edge = np.minimum(fine, rod.edges - 1)
        self._ends = [edge + edge % 2, edge + (edge + 1) % 2]  # the even one, the odd one
        self._weights = [
            _slope(rod, name, level, np.arange(rod.edges + 1) % 2 == odd) for odd in (0, 1)
        ]

    def up(self, v: Array) -> Array:
        """A change on the fine edges."""
        if self._name in AT_VERTICES:
            even, odd = (w * v[i] for w, i in zip(self._weights, self._ends, strict=True))
            return even + odd
        fine = np.repeat(v, self._parts, axis=0)
        return fine / self._parts if self._name == "edge_lengths" else fine

    def down(self, g: Array) -> Array:
        """Of a gradient on the fine edges, in bending, K0 or stretching."""
        out = np.zeros(self.shape)
        if self._name in AT_VERTICES:
            for w, i in zip(self._weights, self._ends, strict=True):
                np.add.at(out, i, w * g)
            return out
        return g.reshape(-1, self._parts, *self.shape[1:]).sum(axis=1)


def _slope(rod: Rod, name: str, level: int, where: Array) -> Array:
    """Of what is linear in K0 and in 1/bending, and so as smooth as can be; of sixth order."""
    value = getattr(rod, name)
    size = np.where(value.any(axis=0), np.abs(value).max(axis=0), 1.0)
    step = 0.003 * size * where[:, None]

    def at(k: int) -> Array:
        moved = replace(rod, **{name: value + k * step})
        return getattr(moved.refined(level), name)

    differences = ((45, 1), (-9, 2), (1, 3))
    return sum(c * (at(k) - at(-k)) for c, k in differences) / (60 * 0.003 * size)
