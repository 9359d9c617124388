"""Frames that are carried along an arc: those of Frenet, of Bishop, and such as close."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from pyrod.base.arrays import Array, whole
from pyrod.curve._arc import require_closed
from pyrod.curve._framed import FramedCurve
from pyrod.curve._polyline import NO_ANGLE, Polyline
from pyrod.rotation import frame_along, unit_frame


def frenet(arc: Polyline) -> FramedCurve:
    """The arc with Frenet frames (n, b, t) on its edges, b half-way between the vertices'."""
    return _framed(arc, arc._compiled.edge_frenet_frames(arc.binormals, arc.dihedral_angles))


def bishop(
    arc: Polyline,
    normal: ArrayLike | None = None,
    angles: ArrayLike = NO_ANGLE,
    frame: ArrayLike | None = None,
) -> FramedCurve:
    """The arc with frames that do not twist, or that twist as told (Linn 6.2.1).

    Frames of a closed arc start on edge 0 and meet it again turned by the `Polyline.holonomy`, all
    of which is in the turn at vertex 0; see `Polyline.closed_ribbon` for frames that close.

    Parameters
    ----------
    arc : `Polyline`
    normal : (3,) array
        a1 of the start is as near to it as can be; default: the frame e1, e2, e3 turned the least
        way.
    angles : float or (n,) array [rad]
        Turns the frames about the tangents by a given angle, one for all or one for each.
    frame : (4,) or (3, 3) array
        The frame at the start instead of ``normal``, turned the least way to the tangent.
    """
    if frame is None:
        start = arc.tangents[0] if arc.start_tangent is None else arc.start_tangent
        q = frame_along(start, normal)
    elif normal is not None:
        raise ValueError("normal: give either it or frame")
    else:
        q = unit_frame(frame, "frame at the start")
    first, frames = arc._compiled.bishop_frames(q)
    framed = _framed(arc, frames, first if arc.start_tangent is not None else None)
    return framed if angles is NO_ANGLE else framed.turned(angles)


def closed_ribbon(
    arc: Polyline, link: int | None = None, normal: ArrayLike | None = None
) -> FramedCurve:
    """Frames that close and have the linking number ``link``, twisted evenly along the arc.

    O(n^2), for the writhe.

    Parameters
    ----------
    arc : `Polyline`
    link : int
        Default: the one that needs the least twist, half a turn at most.
    normal : (3,) array
        See `bishop`.
    """
    require_closed(arc, "closed_ribbon")
    writhe = arc.writhe()
    link = round(writhe) if link is None else whole(link, "link")
    twist = 2 * np.pi * (link - writhe) * arc.cell_lengths / arc.length
    worst = int(np.argmax(np.abs(twist)))
    if not abs(twist[worst]) < np.pi:
        raise ValueError(
            f"link: {link} takes half a turn or more at vertex {worst}, which frames cannot "
            "tell from less; use more edges"
        )
    return bishop(arc, normal, np.concatenate([[0.0], np.cumsum(twist[1:])]))


def _framed(arc: Polyline, frames: Array, start_frame: Array | None = None) -> FramedCurve:
    return FramedCurve(arc, frames, start_frame=start_frame)
