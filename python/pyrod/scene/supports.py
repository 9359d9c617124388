"""What holds rods."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

import numpy as np
from numpy.typing import ArrayLike

import pyrod._core as _core
from pyrod.base.arrays import not_negative, number, yes_or_no
from pyrod.base.immutable import Array, frozen, vector
from pyrod.rod.place import Place, checked
from pyrod.rotation import frame_along, quaternions, unit_frame
from pyrod.scene.part import Part

MOST_TURNS = 10**6


@dataclass(frozen=True, eq=False, init=False)
class Support(Part):
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
    if quaternions(frame, "frame").shape == (3,):
        raise ValueError(
            "frame: expected a quaternion (w, x, y, z) or a rotation matrix (3, 3), got 3 numbers; "
            "for directions of a3 and a1 there are tangent and normal"
        )
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
    _kind = _core.Clamp

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
    _kind = _core.Hinge

    def __init__(self, position: ArrayLike | None = None, *, at: Place = "start") -> None:
        super().__init__(position, at=at)


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
    _kind = _core.Slider

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
            clamped=yes_or_no(clamped, "clamped") or frame is not None,
        )

    @property
    def holds_frame(self) -> bool:  # type: ignore[override]
        """Whether the frame is held as well."""
        return self.clamped


@dataclass(frozen=True, eq=False, init=False)
class Sleeve(Support):
    """Holds the frame of a cross-section, which may slide along its a3.

    Parameters
    ----------
    position, frame, tangent, normal, at : as for `Clamp`
    """

    _kind = _core.Sleeve


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
    _kind = _core.Pivot

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
    _kind = _core.Spring

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
        self._set(
            stiffness=not_negative(stiffness, "stiffness"), torsion=not_negative(torsion, "torsion")
        )

    @property
    def holds_frame(self) -> bool:  # type: ignore[override]
        """Whether there is a torsional spring."""
        return self.torsion > 0


def whole_turns(turns: float) -> int:
    if type(turns) is int and abs(turns) <= MOST_TURNS:
        return turns
    value = number(turns, "turns")
    if not (isfinite(value) and value == int(value)):
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
