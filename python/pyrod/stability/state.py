"""Equilibria under growing loads, and where they lose their stability."""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np

from pyrod.base.immutable import Array
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.rods import RodEquilibrium, largest_turn

LossKind = Literal["bifurcation", "limit point", "none"]


class State(NamedTuple):
    """An equilibrium under loads times a factor."""

    factor: float
    result: Equilibrium

    @property
    def eigenvalue(self) -> float:
        """The lowest of the second variation; its sign, if it is all but zero, is the index's."""
        value = self.result.lowest_eigenvalue
        assert value is not None
        return -abs(value) if self.result.index > 0 else value

    @property
    def left(self) -> float:
        """The turn [rad] that Newton's method would still have made, by its last steps."""
        steps = self.result.record["step"]
        last, before = float(steps[-1]), float(steps[-2:][0])
        return last**2 / (before - last) if last < before else last


def turn_between(a: State, b: State) -> float:
    """The largest turn of a frame [rad]."""
    pairs = zip(a.result.rods, b.result.rods, strict=True)
    return max(largest_turn(one, other) for one, other in pairs)


class Loss(NamedTuple):
    """Where stability is lost on a grid."""

    kind: LossKind
    at: State  #: there; of limit points, just below; if there is none, under the largest loads
    index_after: int | None  #: just above; None if there is no such equilibrium
    factor: float  #: infinite if there is none
    error: float  #: of the search for it
    states: list[State]  #: stable ones before it


def halved(result: Equilibrium) -> Array:
    """Frames of the same shape where all edges are cut in two."""
    return np.vstack([_halved(rod) for rod in result.rods])


def _halved(rod: RodEquilibrium) -> Array:
    """Halfway between the frame of each edge and those of its ends."""
    ends = np.stack([rod.vertex_frames[:-1], rod.vertex_frames[1:]], axis=1)
    middle = rod.frames[:, None, :]
    ends = np.where((ends * middle).sum(axis=2, keepdims=True) < 0, -ends, ends)
    sums = (ends + middle).reshape(-1, 4)
    return sums / np.linalg.norm(sums, axis=1, keepdims=True)
