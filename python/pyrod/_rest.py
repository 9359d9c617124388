"""Where a rod is at rest, and where a clamp carries it: the default places of supports."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyrod._immutable import Array
from pyrod._places import on_rod
from pyrod.rotation import conjugate, multiply, rotate
from pyrod.supports import Clamp, Support

if TYPE_CHECKING:
    from pyrod.rod import Rod

Carrier = tuple[Support, int]
"""A clamp, and the vertex that it holds."""


def carrier(number: int, supports: tuple[Support, ...], rods: tuple[Rod, ...]) -> Carrier | None:
    """The clamp that carries a rod as a whole to where it holds it.

    It is the first support along the rod, of those that are clamps or have no position of their
    own, if that is a clamp with a position or a frame of its own. Whoever leaves a place before it
    to its default wants the rod to start from there, and bends it into the clamp.
    """
    first, at = None, np.inf
    for support in supports:
        i, s = on_rod(support.at, rods)
        if i == number and s < at and (isinstance(support, Clamp) or support.position is None):
            first, at = support, s
    if not isinstance(first, Clamp) or (first.position is None and first.frame is None):
        return None
    return first, int(np.abs(rods[number].arc_lengths - at).argmin())


class Rest:
    """Where a rod is at rest, or where it is carried; computed when asked for."""

    def __init__(self, rod: Rod, by: Carrier | None = None) -> None:
        self._rod = rod
        self._by = by
        self._shape: tuple[Array, Array] | None = None

    def _at_rest(self) -> tuple[Array, Array]:
        if self._shape is None:
            self._shape = self._rod.at_rest(*self._start())
        return self._shape

    def _start(self) -> tuple[Array, Array]:
        """Position and frame of the rod's start."""
        position, frame = self._rod.placement
        if self._by is None:
            return position, frame
        clamp, vertex = self._by
        fixed, direction = Rest(self._rod).place(vertex)
        if clamp.frame is not None:
            turn = multiply(clamp.frame, conjugate(direction))
            position, frame = fixed + rotate(turn, position - fixed), multiply(turn, frame)
        if clamp.position is not None:
            position = position + (clamp.position - fixed)
        return position, frame

    def position(self, vertex: int) -> Array:
        """(3,) of a vertex."""
        return self.place(vertex)[0]

    def frame(self, vertex: int) -> Array:
        """(4,) of a vertex."""
        return self.place(vertex)[1]

    def place(self, vertex: int) -> tuple[Array, Array]:
        """Position and frame of a vertex."""
        if vertex == 0:
            return self._start()
        positions, frames = self._at_rest()
        return positions[vertex], self._rod.frame_at_rest(vertex, frames)
