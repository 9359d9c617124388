"""What a rod is made of as functions of arc length, from which it is made on any grid."""

from __future__ import annotations

import pickle
from dataclasses import dataclass, replace
from typing import NamedTuple, Protocol

import numpy as np

from pyrod._along import Curvature, Ends, Model, Sections, outlines, stiffness
from pyrod._arrays import Array, array
from pyrod._sampling import sampled
from pyrod.outline import Outline
from pyrod.section import Section

Jumps = tuple[list[int], Array]
"""Inner vertices, and for each (4, 3): bending and K0 before it, bending and K0 behind it."""
NO_JUMPS: Jumps = ([], np.zeros((0, 4, 3)))


class Material(NamedTuple):
    """What a rod of n edges is made of."""

    bending: Array  #: (n + 1, 3) at the vertices
    stretching: Array  #: (n, 3) of the edges
    K0: Array  #: (n + 1, 3) at the vertices
    mass: Array  #: (n,) of the edges
    jumps: Jumps = NO_JUMPS


class Law(Protocol):
    """Tells what a rod is made of for edges of lengths ``h``."""

    @property
    def portable(self) -> bool: ...

    @property
    def asks(self) -> bool: ...

    @property
    def base(self) -> Array: ...

    @property
    def corners(self) -> bool: ...

    def outlines(self, h: Array) -> tuple[Ends, ...]: ...

    def on(self, h: Array) -> Material: ...

    def marked(self, at: Array) -> Law: ...


@dataclass(frozen=True, eq=False)
class Made:
    """Sections and curvature as a user gives them; sequences belong to edges of lengths ``base``.

    Between vertices for which it is given the curvature is linear. ``marks``: arc lengths at which
    a function may jump; it is asked on both sides.
    """

    section: Sections
    curvature: Curvature
    base: Array
    marks: tuple[float, ...] = ()
    corners = False

    def on(self, h: Array) -> Material:
        bending, stretching, mass, _ = self.stiffness(h)
        return self._with_jumps(h, Material(bending, stretching, self._K0(h), mass))

    def stiffness(self, h: Array) -> tuple[Array, Array, Array, Model]:
        return stiffness(self._sections(h), h)

    def outlines(self, h: Array) -> tuple[Ends, ...]:
        return outlines(self._sections(h), h)

    def _sections(self, h: Array) -> Sections:
        if not isinstance(self.section, (list, tuple)) or h is self.base:
            return self.section
        s = _arc_lengths(h)
        return [self.section[i] for i in _edges_at((s[1:] + s[:-1]) / 2, self.base)]

    def _K0(self, h: Array) -> Array:
        s = _arc_lengths(h)
        if not callable(self.curvature) and h is not self.base:
            given = array(self.curvature, "curvature")
            if given.ndim == 2:
                return _interpolated(s, _arc_lengths(self.base), given)
        return sampled(self.curvature, s, "curvature", "vertex")

    def _with_jumps(self, h: Array, smooth: Material) -> Material:
        """The cells of vertices where something jumps are halves of either side."""
        at = self._jumping_vertices(h)
        if not len(at):
            return smooth
        s = _arc_lengths(h)
        sides = np.array([[*self._side(h, s, j, -1), *self._side(h, s, j, 1)] for j in at])
        change = np.abs(sides[:, :2] - sides[:, 2:])
        real = (change > 1e-6 * np.abs(sides[:, :2]).max(axis=2, keepdims=True)).any(axis=(1, 2))
        at, sides = at[real], sides[real]
        before, behind = h[at - 1][:, None], h[at][:, None]
        bending, K0 = smooth.bending.copy(), smooth.K0.copy()
        compliance = before / sides[:, 0] + behind / sides[:, 2]
        bending[at] = (before + behind) / compliance
        K0[at] = (before * sides[:, 1] + behind * sides[:, 3]) / (before + behind)
        return smooth._replace(bending=bending, K0=K0, jumps=(at.tolist(), sides))

    @property
    def steps(self) -> tuple[float, ...]:
        """Arc lengths at which the sections of a sequence change."""
        if not isinstance(self.section, (list, tuple)):
            return ()
        ends = _arc_lengths(self.base)[1:-1]
        pairs = zip(self.section, self.section[1:])  # noqa: B905  one end fewer
        return tuple(float(s) for s, (a, b) in zip(ends, pairs, strict=True) if a != b)

    def _jumping_vertices(self, h: Array) -> Array:
        s, places = _arc_lengths(h), list(self.steps)
        if callable(self.section) or callable(self.curvature):
            places += self.marks
        near = np.searchsorted(s, np.array(places) - 1e-9 * s[-1]).astype(int)
        return np.unique(near[(near > 0) & (near < len(h))])

    def _side(self, h: Array, s: Array, j: int, side: int) -> tuple[Array, Array]:
        """Stiffness and curvature just before or behind vertex j."""
        edge = j - 1 if side < 0 else j
        place = s[j] + side * 1e-9 * s[-1]
        section = self._sections(h)
        if callable(section):
            section = section(place)
        elif not isinstance(section, Section):
            section = section[edge]
        K0 = self.curvature(place) if callable(self.curvature) else self._K0(h)[j]
        return np.array(section.bending), array(K0, "curvature")

    @property
    def asks(self) -> bool:
        """Whether a finer grid needs to ask it, for more than means between vertices."""
        return not isinstance(self.section, Section) or callable(self.curvature)

    def marked(self, at: Array) -> Made:
        """The same with more places where a function may jump."""
        functions = callable(self.section) or callable(self.curvature)
        if not functions or set(np.ravel(at)) <= set(self.marks):
            return self
        return replace(self, marks=tuple(np.union1d(self.marks, at).tolist()))

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

    def _K0(self, h: Array) -> Array:
        return _at_corners(np.asarray(self.curvature), self.base, h)

    @property
    def asks(self) -> bool:
        return super().asks or bool(np.any(np.asarray(self.curvature)))


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
    shapes: tuple[Ends, ...] = ()
    """Outlines of the edges, linear along each; empty: none are known."""
    corners: bool = False
    portable = True

    @property
    def asks(self) -> bool:
        return self.corners and bool(self.K0.any())

    def on(self, h: Array) -> Material:
        s, base = _arc_lengths(h), _arc_lengths(self.base)
        edge = _edges_at((s[1:] + s[:-1]) / 2, self.base)
        return Material(
            self._bending(s, base),
            self.stretching[edge],
            self._K0(h),
            self.mass[edge],
        )

    def _bending(self, s: Array, base: Array) -> Array:
        """Where nothing changes along the rod it is kept to the last bit."""
        out = 1 / _interpolated(s, base, 1 / self.bending)
        same = (self.bending == self.bending[0]).all(axis=0)
        out[:, same] = self.bending[0, same]
        return out

    def _K0(self, h: Array) -> Array:
        if self.corners:
            return _at_corners(self.K0, self.base, h)
        return _interpolated(_arc_lengths(h), _arc_lengths(self.base), self.K0)

    def outlines(self, h: Array) -> tuple[Ends, ...]:
        if not self.shapes:
            return ((None, None),) * len(h)
        s, start = _arc_lengths(h), _arc_lengths(self.base)
        edges = _edges_at((s[1:] + s[:-1]) / 2, self.base)
        parts = (np.column_stack([s[:-1], s[1:]]) - start[edges, None]) / self.base[edges, None]
        return tuple(
            (within(self.shapes[i], a), within(self.shapes[i], b))
            for i, (a, b) in zip(edges, parts, strict=True)
        )

    def marked(self, at: Array) -> Table:
        return self


def kept_outlines(law: Law | None, h: Array) -> tuple[Ends, ...]:
    """What a law says of outlines, for a rod that has other arrays than it says."""
    if law is None or abs(law.base.sum() - h.sum()) > 1e-9 * h.sum():
        return ()
    return law.outlines(h)


def within(ends: Ends, part: float) -> Outline | None:
    """The outline between the ends of an edge, ``part`` of its length from the start."""
    a, b = ends
    if a is None or b is None:
        return a if part < 0.5 else b
    return a.towards(b, part)


def _arc_lengths(h: Array) -> Array:
    return np.concatenate([[0.0], np.cumsum(h)])


def _at_corners(K0: Array, base: Array, h: Array) -> Array:
    """Curvature whose turns, those of a polygon with edges ``base``, are all at its vertices."""
    s, corners = _arc_lengths(h), _arc_lengths(base)
    at = np.searchsorted((s[1:] + s[:-1]) / 2, corners)  # the nearest
    out = np.zeros((len(s), 3))
    out[at] = K0 * (_cells(base) / _cells(h)[at])[:, None]
    return out


def _cells(h: Array) -> Array:
    return np.convolve(h, [0.5, 0.5])


def _edges_at(s: Array, h: Array) -> Array:
    return np.clip(np.searchsorted(_arc_lengths(h), s, "right") - 1, 0, len(h) - 1)


def _interpolated(s: Array, at: Array, values: Array) -> Array:
    return np.column_stack([np.interp(s, at, values[:, i]) for i in range(values.shape[1])])
