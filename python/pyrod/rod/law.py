"""What a rod is made of, as a user gave it, from which it is made on any grid."""

from __future__ import annotations

import pickle
from dataclasses import dataclass
from typing import Any, Union

import numpy as np

import pyrod._core as _core
from pyrod.base.arrays import Array
from pyrod.curve._sampling import along
from pyrod.rod.along import Curvature, EndOutlines, Sections, outlines_of, section_rows
from pyrod.rod.outline import Outline
from pyrod.rod.section import Model

Placement = tuple[Array, Array]
Jumps = tuple[list[int], Array]
"""Inner vertices, and for each (4, 3): bending and K0 before it, bending and K0 behind it."""
NO_JUMPS: Jumps = ([], np.zeros((0, 4, 3)))


@dataclass(frozen=True, eq=False)
class Made:
    """Sections and curvature as a user gives them; sequences belong to edges of lengths ``base``.

    Between vertices for which it is given the curvature is linear.
    """

    section: Sections
    curvature: Curvature
    base: Array
    corners = False

    def compiled(self, model: Model | None, place: Placement, chooses: bool) -> _core.Rod:
        """On the edges of the base."""
        n = len(self.base)
        return _core.Rod.of_sections(
            self.base,
            section_rows(self.section, n),
            along(self.curvature, n + 1, "curvature", "vertex"),
            self.corners,
            model,
            chooses,
            *place,
        )

    def outlines(self, h: Array) -> tuple[EndOutlines, ...]:
        return outlines_of(self._sections(h), h)

    def _sections(self, h: Array) -> Sections:
        if not isinstance(self.section, (list, tuple)) or h is self.base:
            return self.section
        s = _arc_lengths(h)
        return [self.section[i] for i in _edges_at((s[1:] + s[:-1]) / 2, self.base)]

    @property
    def portable(self) -> bool:
        """Whether it can be pickled: functions may be local ones."""
        if not callable(self.section) and not callable(self.curvature):
            return True
        try:
            pickle.dumps((self.section, self.curvature))
        except (pickle.PicklingError, AttributeError, TypeError):
            return False
        return True


@dataclass(frozen=True, eq=False)
class Points(Made):
    """Sections along a polygon, which turns at the vertices of ``base`` alone, on any grid."""

    corners = True


@dataclass(frozen=True, eq=False)
class Table:
    """The arrays of a discrete rod: compliance and curvature are linear between its vertices.

    ``corners`` : all of its turn is at these, as of a polygon.
    """

    base: Array
    bending: Array
    stretching: Array
    K0: Array
    mass: Array
    shapes: tuple[EndOutlines, ...] = ()
    """Outlines of the edges, linear along each; empty: none are known."""
    corners: bool = False
    jumps: Jumps = NO_JUMPS
    portable = True

    def compiled(self, model: Model | None, place: Placement, chooses: bool) -> _core.Rod:
        """On the edges of the base, which nobody chooses."""
        arrays = self.base, self.bending, self.stretching, self.K0, self.mass
        return _core.Rod.of_arrays(*arrays, self.corners, *self.jumps, model or "cosserat", *place)

    def outlines(self, h: Array) -> tuple[EndOutlines, ...]:
        if not self.shapes:
            return ((None, None),) * len(h)
        s, start = _arc_lengths(h), _arc_lengths(self.base)
        edges = _edges_at((s[1:] + s[:-1]) / 2, self.base)
        parts = (np.column_stack([s[:-1], s[1:]]) - start[edges, None]) / self.base[edges, None]
        return tuple(
            (within(self.shapes[i], a), within(self.shapes[i], b))
            for i, (a, b) in zip(edges, parts, strict=True)
        )


Law = Union[Made, Table]
"""Tells what a rod is made of."""


def table_of(rod: Any) -> Table:
    """The law that tells the arrays of a rod, and nothing between vertices.

    Outlines and corners are those of the law it has, if that is of the same length.
    """
    law, h = rod._law, rod.edge_lengths
    is_of_it = law is not None and abs(law.base.sum() - h.sum()) <= 1e-9 * h.sum()
    shapes = law.outlines(h) if is_of_it else ()
    corners = law is not None and law.corners
    return Table(h, rod.bending, rod.stretching, rod.K0, rod.mass_per_length, shapes, corners)


def within(ends: EndOutlines, part: float) -> Outline | None:
    """The outline between the ends of an edge, ``part`` of its length from the start."""
    a, b = ends
    if a is None or b is None:
        return a if part < 0.5 else b
    return a.towards(b, part)


def _arc_lengths(h: Array) -> Array:
    return np.concatenate([[0.0], np.cumsum(h)])


def _edges_at(s: Array, h: Array) -> Array:
    return np.clip(np.searchsorted(_arc_lengths(h), s, "right") - 1, 0, len(h) - 1)
