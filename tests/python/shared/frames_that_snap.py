"""Structures that turn back or branch, in units of L (or R) and EI, on any number of edges."""

from __future__ import annotations

from typing import Any

import numpy as np
from support import FLAT, X, Y, Z, about_y

from pyrod import Clamp, Force, Hinge, Joint, Pivot, Rod, Scene, Section

DEEP = np.deg2rad(215.0)


def arch(n: int, angle: float = DEEP, clamped: bool = True, space: str = "planar") -> Scene:
    """A circle's arc of radius 1, loaded at the crown, towards x; one foot is clamped or hinged."""
    rod = Rod.precurved(angle, n, FLAT, Y).placed((0, 0, 0), about_y(-angle / 2))
    start = Clamp() if clamped else Hinge()
    return Scene(rod, [start, Hinge(at="end")], Force((0, 0, 0), at=angle / 2), space)


def lee(n: int) -> Scene:
    """A right-angled frame with hinged feet, loaded at a fifth of its beam."""
    column = Rod.straight(1.0, n, FLAT)
    beam = Rod.straight(1.0, n, FLAT).placed((0, 0, 1), about_y(np.pi / 2))
    feet = [Hinge(at=(0, "start")), Hinge(at=(1, "end"))]
    corner = Joint(((0, "end"), (1, "start")))
    return Scene([column, beam], feet, Force((0, 0, 0), at=(1, 0.2)), "planar", joints=[corner])


def column(n: int, space: str = "planar", **more: Any) -> Scene:
    """Pinned at both ends, in the plane x, z."""
    ends: list[Any] = [Hinge(), Pivot(Y, at="end", along=Z)]
    if space == "spatial":
        ends[0] = Pivot(Y)
    strip = Section(EI1=40.0, EI2=1.0, GJ=20.0)
    return Scene(Rod.straight(1.0, n, strip), ends, Force((0, 0, 0)), space, **more)


DOWN = {"arch": X, "lee": -Z, "column": -Z}
"""The directions of the loads."""
