"""Frames by a rule: a1 up, towards a point of view, or towards another curve."""

from __future__ import annotations

from typing import Literal, Union

import numpy as np
from numpy.typing import ArrayLike

from pyrod.base.arrays import Array, array, transposed
from pyrod.base.words import shortly
from pyrod.curve._framed import FramedCurve
from pyrod.curve._places import nearest
from pyrod.curve._polyline import Polyline, as_polyline

_PARALLEL = 1e-6
"""Sine of the angle to the tangent below which a direction has no part across it."""


def facing(arc: Polyline, directions: ArrayLike) -> FramedCurve:
    """Frames whose a1 looks as near to directions as can be: a `FramedCurve`.

    a3 is along the edges. With one direction for all these are frames as roads, ribbons of cloth
    and cameras have them, up (0, 0, 1); they twist where the curve makes them, and jump where it
    goes past the direction.

    Parameters
    ----------
    arc : `Polyline`
    directions : (3,) or (k, 3) array
        One for all, or one for each of the k vertices: edges have the mean of two, and the ends of
        an open arc are held by theirs.

    Raises
    ------
    ValueError
        A direction is along the curve; which, is told.
    """
    d = array(directions, "directions")
    if d.shape not in ((3,), arc.positions.shape):
        raise ValueError(
            f"directions: expected 3 numbers or {len(arc.positions)} times 3 (one per vertex), "
            f"got shape {d.shape}{transposed(d, 3)}"
        )
    d = np.broadcast_to(d, arc.positions.shape)
    behind = np.roll(d, -1, axis=0) if arc.closed else d[1:]
    frames = _looking(arc.tangents, (d[: arc.edges] + behind) / 2, "edge")
    if arc.closed:
        return FramedCurve(arc, frames)
    t = arc.tangents[[0, -1]].copy()
    for i, held in enumerate((arc.start_tangent, arc.end_tangent)):
        if held is not None:
            t[i] = held / np.linalg.norm(held)
    ends = _looking(t, d[[0, -1]], "end")
    return FramedCurve(arc, frames, None, ends[0], ends[1])


def towards(
    arc: Polyline,
    other: Union[Polyline, ArrayLike],
    *,
    by: Literal["number", "nearest"] = "number",
) -> FramedCurve:
    """The ribbon from this arc to another, a `FramedCurve`: a1 points there.

    Its twist is how often the other winds about this one, in turns; with the writhe of a closed
    arc it adds up to their linking number. Edges must be short beside the turns.

    Parameters
    ----------
    arc : `Polyline`
    other : `Polyline` or (k, 3) array [m]
        A strand beside the axis, the second strand, a guide.
    by : "number" or "nearest"
        To which of its points a vertex looks: that of the same number (default), or that which is
        nearest.

    Raises
    ------
    ValueError
        Another number of points, with "number"; they meet.
    """
    if by not in ("number", "nearest"):
        raise ValueError(f"by: expected 'number' or 'nearest', got {shortly(by)}")
    them = as_polyline(other, "other", closed=arc.closed)
    if by == "nearest":
        return facing(arc, nearest(them, arc.positions).positions - arc.positions)
    if len(them.positions) != len(arc.positions):
        raise ValueError(
            f"other: expected as many points, {len(arc.positions)}, got {len(them.positions)}; "
            "take by='nearest', or resampled()"
        )
    return facing(arc, them.positions - arc.positions)


def _looking(t: Array, d: Array, place: str) -> Array:
    """(n, 3, 3) with a3 = t and a1 in the plane of t and d."""
    across = d - np.einsum("ni,ni->n", d, t)[:, None] * t
    size = np.linalg.norm(across, axis=1)
    bad = ~(size > _PARALLEL * np.linalg.norm(d, axis=1))
    if bad.any():
        j = int(np.argmax(bad))
        raise ValueError(
            f"directions: at {place} {j} there is none across the curve, got {d[j]}, along {t[j]}; "
            "give others there, or take bishop()"
        )
    a1 = across / size[:, None]
    a1 -= np.einsum("ni,ni->n", a1, t)[:, None] * t  # again, for what cancelled
    a1 /= np.linalg.norm(a1, axis=1, keepdims=True)
    return np.stack([a1, np.cross(t, a1), t], axis=2)
