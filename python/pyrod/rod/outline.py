"""Outlines of cross-sections in the plane of a1 and a2: what a rod looks like."""

from __future__ import annotations

from dataclasses import asdict, dataclass, fields
from math import isfinite, pi
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pyrod.base.arrays import Array, finite, number, whole
from pyrod.base.calls import Answering, spelled
from pyrod.rod.polygons import (
    Corners,
    corners,
    first_moments,
    is_inside,
    second_moments,
    signed_area,
)


@dataclass(frozen=True, repr=False)
class Outline(Answering):
    """The outline of a cross-section, with a hole or without; see the makers.

    Outlines are equal if they were made from the same numbers. They serve pictures, files of solids
    and rotary inertia only; stiffnesses are told by the `Section`.
    """

    @staticmethod
    @spelled
    def circle(radius: float) -> Outline:
        """A disc of the given radius [m]."""
        return Circle(number(radius, "radius"))

    @staticmethod
    @spelled
    def tube(outer_radius: float, inner_radius: float) -> Outline:
        """The ring between two radii [m]; with ``inner_radius=0`` it is the disc."""
        outer = number(outer_radius, "outer_radius")
        inner = number(inner_radius, "inner_radius")
        return Circle(outer) if inner == 0 else Tube(outer, inner)

    @staticmethod
    @spelled
    def rectangle(width: float, height: float) -> Outline:
        """A rectangle, ``width`` along a1 and ``height`` along a2 [m]."""
        return Rectangle(number(width, "width"), number(height, "height"))

    @staticmethod
    @spelled
    def polygon(points: ArrayLike, hole: ArrayLike | None = None) -> Outline:
        """A polygon.

        Parameters
        ----------
        points : (k, 2) array [m]
            Corners, at least 3, in either sense; the last is not the first again.
        hole : (l, 2) array [m]
            Corners of a hole inside of it; default: none.

        Raises
        ------
        ValueError
            Too few or not finite points, no area, sides that cross, a hole that is not inside.
        """
        outer = corners(points, "points")
        inner = None if hole is None else corners(hole, "hole")
        if inner is not None and not is_inside(inner, outer):
            raise ValueError("hole: must be inside of the outer loop, without touching it")
        return Polygon(outer, inner)

    @staticmethod
    def from_dict(document: dict[str, dict[str, Any]]) -> Outline:
        """The outline whose `to_dict` this is.

        Raises
        ------
        ValueError
            Not one known kind, or numbers that its maker refuses.
        TypeError
            Numbers of other names than the maker's.
        """
        kinds = {"circle", "tube", "rectangle", "polygon"}
        if len(document) != 1 or not kinds.issuperset(document):
            raise ValueError(
                f"outline: expected one of {', '.join(sorted(kinds))}, got {', '.join(document)}"
            )
        ((kind, numbers),) = document.items()
        return getattr(Outline, kind)(**numbers)

    def to_dict(self) -> dict[str, dict[str, Any]]:
        """What it was made from as plain numbers: ``{"circle": {"radius": 0.01}}`` and so on."""
        numbers = {name: _lists(value) for name, value in asdict(self).items() if value is not None}
        return {type(self).__name__.lower(): numbers}

    @property
    def area(self) -> float:
        """Exact area, of circles, too [m^2]."""
        raise NotImplementedError

    @property
    def second_moments(self) -> Array:
        """(3, 3) exact moments of inertia of the area about the axis of the rod [m^4].

        Integral of ``|x|^2 - x x^T``, x from the axis: about a1 and a2 those of bending, about a3
        their sum.
        """
        xx, yy, xy = self._products()
        return np.array([[yy, -xy, 0.0], [-xy, xx, 0.0], [0.0, 0.0, xx + yy]])

    @property
    def centroid(self) -> Array:
        """(2,) of the area, along a1 and a2 [m]."""
        return np.zeros(2)

    def _products(self) -> tuple[float, float, float]:
        """Integrals of x^2, y^2 and x y over the area, along a1 and a2."""
        raise NotImplementedError

    @property
    def size(self) -> float:
        """The larger of the extents along a1 and a2 [m]."""
        return float(np.ptp(self.loops(24)[0], axis=0).max())

    def loops(self, sides: int = 24) -> tuple[Array, ...]:
        """Corners of the outline, and of its hole if there is one.

        Parameters
        ----------
        sides : int
            Into how many chords a circle is cut, at least 3; default 24.

        Returns
        -------
        list of (k, 2) arrays [m]
            Along a1 and a2, counter-clockwise seen from the tip of a3; of a hole, clockwise.
        """
        raise NotImplementedError

    def __repr__(self) -> str:
        ((kind, numbers),) = self.to_dict().items()
        return f"Outline.{kind}({', '.join(f'{name}={x}' for name, x in numbers.items())})"

    def towards(self, other: Outline, part: float) -> Outline:
        """The outline between this (``part`` 0) and another (1): its numbers are linear.

        Of two outlines of different kinds there is none between: the nearer is returned.
        """
        part = number(finite(part, "part"), "part")
        corners = [[len(loop) for loop in outline.loops()] for outline in (self, other)]
        if type(self) is not type(other) or corners[0] != corners[1]:
            return self if part < 0.5 else other
        pairs = [(getattr(self, f.name), getattr(other, f.name)) for f in fields(self)]
        return type(self)(*[_between(a, b, part) for a, b in pairs])


@dataclass(frozen=True, repr=False)
class Circle(Outline):
    """A disc; see `Outline.circle`."""

    radius: float

    def __post_init__(self) -> None:
        _check_positive(self.radius, "radius")

    @property
    def area(self) -> float:
        """Exact area [m^2]."""
        return pi * self.radius**2

    def _products(self) -> tuple[float, float, float]:
        one = pi * self.radius**4 / 4
        return one, one, 0.0

    def loops(self, sides: int = 24) -> tuple[Array, ...]:
        """One loop with its corners on the circle."""
        return (_circle(self.radius, sides),)


@dataclass(frozen=True, repr=False)
class Tube(Outline):
    """The ring between two circles; see `Outline.tube`."""

    outer_radius: float
    inner_radius: float

    def __post_init__(self) -> None:
        _check_positive(self.outer_radius, "outer_radius")
        _check_positive(self.inner_radius, "inner_radius")
        if self.inner_radius >= self.outer_radius:
            raise ValueError(
                f"inner_radius: must be less than outer_radius={self.outer_radius}, "
                f"got {self.inner_radius}"
            )

    @property
    def area(self) -> float:
        """Exact area [m^2]."""
        return pi * (self.outer_radius**2 - self.inner_radius**2)

    def _products(self) -> tuple[float, float, float]:
        one = pi * (self.outer_radius**4 - self.inner_radius**4) / 4
        return one, one, 0.0

    def loops(self, sides: int = 24) -> tuple[Array, ...]:
        """Two loops with their corners on the circles."""
        return _circle(self.outer_radius, sides), _circle(self.inner_radius, sides)[::-1]


@dataclass(frozen=True, repr=False)
class Rectangle(Outline):
    """A rectangle; see `Outline.rectangle`."""

    width: float
    height: float

    def __post_init__(self) -> None:
        _check_positive(self.width, "width")
        _check_positive(self.height, "height")

    @property
    def area(self) -> float:
        """Exact area [m^2]."""
        return self.width * self.height

    def _products(self) -> tuple[float, float, float]:
        return self.area * self.width**2 / 12, self.area * self.height**2 / 12, 0.0

    def loops(self, sides: int = 24) -> tuple[Array, ...]:
        """One loop of four corners."""
        signs = np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]])
        return (signs * [self.width / 2, self.height / 2],)


@dataclass(frozen=True, repr=False)
class Polygon(Outline):
    """A polygon with a hole or without; see `Outline.polygon`."""

    points: Corners
    hole: Corners | None = None

    @property
    def area(self) -> float:
        """Exact area [m^2]."""
        return sum(map(signed_area, self.loops()))

    @property
    def centroid(self) -> Array:
        """(2,) of the area, along a1 and a2 [m]."""
        return np.sum([first_moments(loop) for loop in self.loops()], axis=0) / self.area

    def _products(self) -> tuple[float, float, float]:
        xx, yy, xy = np.sum([second_moments(loop) for loop in self.loops()], axis=0).tolist()
        return xx, yy, xy

    def loops(self, sides: int = 24) -> tuple[Array, ...]:
        """The corners as given, turned into the right sense."""
        outer = np.array(self.points)
        if self.hole is None:
            return (outer,)
        return outer, np.array(self.hole)[::-1]

    def __repr__(self) -> str:
        hole = "" if self.hole is None else f", hole of {len(self.hole)}"
        return f"Outline.polygon({len(self.points)} corners{hole})"


def _circle(radius: float, sides: int) -> Array:
    sides = whole(sides, "sides")
    if not sides >= 3:
        raise ValueError(f"sides: must be at least 3, got {sides}")
    angles = 2 * pi * np.arange(sides) / sides
    return radius * np.column_stack([np.cos(angles), np.sin(angles)])


def _check_positive(value: float, name: str) -> None:
    if not (isfinite(value) and value > 0):
        raise ValueError(f"{name}: must be positive and finite, got {value}")


def _between(a: Any, b: Any, part: float) -> Any:
    """Numbers, or tuples of them, or None, linear between two."""
    if isinstance(a, tuple):
        return tuple(_between(x, y, part) for x, y in zip(a, b, strict=True))
    return None if a is None else (1 - part) * a + part * b


def _lists(value: Any) -> Any:
    """Lists in place of tuples, as files have them."""
    return [_lists(x) for x in value] if isinstance(value, tuple) else value
