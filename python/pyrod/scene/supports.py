"""What holds rods."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import pyrod._core as _core
from pyrod.base.arrays import number
from pyrod.base.immutable import Array, Immutable, frozen, vector
from pyrod.rod.place import Place, checked
from pyrod.rotation import frame_along, rotate, unit_frame

FREE = np.eye(3)
HELD = np.zeros((0, 3))
MOST_TURNS = 10**6


@dataclass(frozen=True, eq=False, init=False)
class Support(Immutable):
    """Base of all supports: a place, and where its point and its frame are held."""

    position: Array | None
    frame: Array | None
    at: Place

    #: whether the support takes hold of the frame of the rod
    holds_frame = True

    def __init__(
        self,
        position: ArrayLike | None = None,
        frame: ArrayLike | None = None,
        *,
        tangent: ArrayLike | None = None,
        normal: ArrayLike | None = None,
        at: Place = "start",
    ) -> None:
        self._set(
            position=None if position is None else vector(position, "position"),
            frame=placed_frame(frame, tangent, normal),
            at=checked(at),
        )

    def _free(self, frame: Array) -> Array:
        """(k, 3) directions in which the point may move."""
        return HELD

    def _turns(self, frame: Array) -> Array:
        """(k, 3) material axes about which the cross-section may turn."""
        return HELD

    @cached_property
    def _compiled(self) -> Any:
        raise NotImplementedError


def placed_frame(
    frame: ArrayLike | None, tangent: ArrayLike | None, normal: ArrayLike | None
) -> Array | None:
    if frame is not None and (tangent is not None or normal is not None):
        raise ValueError("frame: give either a frame or a tangent, not both")
    if normal is not None and tangent is None:
        raise ValueError("normal: needs a tangent, too")
    if tangent is not None:
        return frozen(frame_along(tangent, normal))
    if frame is None:
        return None
    return frozen(unit_frame(frame, "frame"))


@dataclass(frozen=True, eq=False, init=False)
class Clamp(Support):
    """Holds a cross-section in position and frame.

    Parameters
    ----------
    position : (3,) array [m]
        Default: where the rod is at rest, its start in the origin unless made from a curve.
    frame : (4,) or (3, 3) array
        Unit quaternion or matrix; or, instead,
    tangent, normal : (3,) array
        Directions of a3 and, as near as can be, of a1. Default: the frame at rest; a rod that is
        not made from a curve starts along z, with a1 along x.
    at : "start", "end", float [m], or (int, one of these)
        An end (default "start"), an arc length, or these with the number of the rod.
    turns : int
        Full turns about a3 that are put into the rod between the support before and this one,
        besides what it has at rest and what the frames ask for at the least. They decide which of
        the shapes with these frames is looked for.
    """

    turns: int

    def __init__(
        self,
        position: ArrayLike | None = None,
        frame: ArrayLike | None = None,
        *,
        tangent: ArrayLike | None = None,
        normal: ArrayLike | None = None,
        at: Place = "start",
        turns: int = 0,
    ) -> None:
        super().__init__(position, frame, tangent=tangent, normal=normal, at=at)
        self._set(turns=whole_turns(turns))

    @cached_property
    def _compiled(self) -> _core.Clamp:
        return _core.Clamp(self.position, self.frame, self.at, self.turns)


@dataclass(frozen=True, eq=False, init=False)
class Hinge(Support):
    """Holds the position of a point of the rod, which may turn in every way (a ball joint to
    ground).

    Parameters
    ----------
    position : (3,) array [m]
        Default: where the rod is at rest.
    at : as for `Clamp`
    """

    holds_frame = False

    def __init__(self, position: ArrayLike | None = None, *, at: Place = "start") -> None:
        super().__init__(position, at=at)

    @cached_property
    def _compiled(self) -> _core.Hinge:
        return _core.Hinge(self.position, self.at)

    def _turns(self, frame: Array) -> Array:
        return FREE


@dataclass(frozen=True, eq=False, init=False)
class Slider(Support):
    """Lets a point of the rod slide along a line or in a plane; the rod may turn unless it is held.

    Parameters
    ----------
    along : (3,) array
        Direction of the line; or
    normal : (3,) array
        Normal of the plane.
    position : (3,) array [m]
        A point of the line or plane; default: where the rod is at rest.
    frame : (4,) or (3, 3) array
        Holds the cross-section in this frame.
    clamped : bool
        Holds the cross-section in the frame that it has at rest.
    at : as for `Clamp`
    """

    along: Array | None
    normal: Array | None
    clamped: bool

    def __init__(
        self,
        along: ArrayLike | None = None,
        *,
        normal: ArrayLike | None = None,
        position: ArrayLike | None = None,
        frame: ArrayLike | None = None,
        clamped: bool = False,
        at: Place = "end",
    ) -> None:
        super().__init__(position, frame, at=at)
        if (along is None) == (normal is None):
            raise ValueError("along: give either it or the normal of a plane")
        self._set(
            along=unit(along, "along"),
            normal=unit(normal, "normal"),
            clamped=clamped or frame is not None,
        )

    @cached_property
    def _compiled(self) -> _core.Slider:
        held = self.position, self.frame, self.clamped
        return _core.Slider(self.along, self.normal, *held, self.at)

    @property
    def holds_frame(self) -> bool:  # type: ignore[override]
        """Whether the frame is held as well."""
        return self.clamped

    def _free(self, frame: Array) -> Array:
        return self.along[None] if self.along is not None else _across(self.normal)

    def _turns(self, frame: Array) -> Array:
        return HELD if self.clamped else FREE


@dataclass(frozen=True, eq=False, init=False)
class Sleeve(Support):
    """Holds the frame of a cross-section, which may slide along its a3.

    Parameters
    ----------
    position, frame, tangent, normal, at : as for `Clamp`
    """

    @cached_property
    def _compiled(self) -> _core.Sleeve:
        return _core.Sleeve(self.position, self.frame, self.at)

    def _free(self, frame: Array) -> Array:
        return rotate(frame, np.array([[0.0, 0.0, 1.0]]))


@dataclass(frozen=True, eq=False, init=False)
class Pivot(Support):
    """Holds a position, and lets the cross-section turn about one axis only (a pin).

    Parameters
    ----------
    axis : (3,) array
        Direction in space.
    position, frame, at : as for `Clamp`
        The frame is that before it turns.
    along : (3,) array
        Direction in which the pin may slide; default: none.
    """

    axis: Array
    along: Array | None

    def __init__(
        self,
        axis: ArrayLike,
        position: ArrayLike | None = None,
        frame: ArrayLike | None = None,
        *,
        at: Place = "start",
        along: ArrayLike | None = None,
    ) -> None:
        super().__init__(position, frame, at=at)
        self._set(axis=unit(axis, "axis"), along=unit(along, "along"))

    @cached_property
    def _compiled(self) -> _core.Pivot:
        return _core.Pivot(self.axis, self.position, self.frame, self.at, self.along)

    def _free(self, frame: Array) -> Array:
        return HELD if self.along is None else self.along[None]

    def _turns(self, frame: Array) -> Array:
        return rotate(frame * np.array([1.0, -1.0, -1.0, -1.0]), self.axis)[None]


@dataclass(frozen=True, eq=False, init=False)
class Spring(Support):
    """Draws a point towards a position, and its cross-section towards a frame, with linear springs.

    Parameters
    ----------
    stiffness : float [N/m]
        In every direction; not negative.
    torsion : float [N m]
        About every axis: the moment is ``torsion`` times the rotation vector.
    position, frame, at : as for `Clamp`
        Where the springs are at rest.
    """

    stiffness: float
    torsion: float

    def __init__(
        self,
        stiffness: float = 0.0,
        torsion: float = 0.0,
        position: ArrayLike | None = None,
        frame: ArrayLike | None = None,
        *,
        at: Place = "end",
    ) -> None:
        super().__init__(position, frame, at=at)
        stiffness, torsion = number(stiffness, "stiffness"), number(torsion, "torsion")
        for name, value in (("stiffness", stiffness), ("torsion", torsion)):
            if not (np.isfinite(value) and value >= 0):
                raise ValueError(f"{name}: must be finite and not negative, got {value}")
        self._set(stiffness=stiffness, torsion=torsion)

    @cached_property
    def _compiled(self) -> _core.Spring:
        return _core.Spring(self.stiffness, self.torsion, self.position, self.frame, self.at)

    @property
    def holds_frame(self) -> bool:  # type: ignore[override]
        """Whether there is a torsional spring."""
        return self.torsion > 0

    def _free(self, frame: Array) -> Array:
        return FREE

    def _turns(self, frame: Array) -> Array:
        return FREE


def whole_turns(turns: float) -> int:
    value = number(turns, "turns")
    if not (np.isfinite(value) and value == int(value)):
        raise ValueError(f"turns: must be a whole number, got {turns}; fractions are the frame's")
    if abs(value) > MOST_TURNS:
        raise ValueError(f"turns: must be at most {MOST_TURNS:g}, got {turns}")
    return int(value)


def unit(values: ArrayLike | None, name: str) -> Array | None:
    if values is None:
        return None
    v = vector(values, name)
    if not v.any():
        raise ValueError(f"{name}: expected a direction, got the zero vector")
    if np.abs(v).max() <= 1 and abs(v @ v - 1) < 1e-15:
        return v  # to the last bit, so that what is written and read again is the same
    v = v / np.abs(v).max()
    return frozen(v / np.linalg.norm(v))


def _across(n: Array | None) -> Array:
    """Two unit vectors across a direction."""
    assert n is not None
    a = np.cross(n, np.eye(3)[np.argmin(np.abs(n))])
    a /= np.linalg.norm(a)
    return np.array([a, np.cross(n, a)])
