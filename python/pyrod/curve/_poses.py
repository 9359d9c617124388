"""Poses as robots, trackers and base pairs have them, and frames at any place of a curve."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pyrod.base.arrays import Array, array, is_rotation, whole, yes_or_no
from pyrod.base.words import shortly
from pyrod.curve._framed import FramedCurve
from pyrod.curve._places import at_arc_lengths
from pyrod.curve._polyline import Polyline
from pyrod.curve._resampling import resampled
from pyrod.rotation import as_frames, conjugate, exp, log, multiply, rotate

Order = Literal["wxyz", "xyzw"]
_ADAPTED = 1e-6
"""Sine of the angle to the edge below which a3 is along it."""


def from_poses(
    poses: Any,
    *,
    order: Order | None = None,
    along: Literal["x", "y", "z"] = "z",
    closed: bool = False,
) -> FramedCurve:
    """The curve through poses: positions, and frames at the points.

    Parameters
    ----------
    poses : (k, 4, 4) array, (k, 7) array, or pair
        Homogeneous matrices; rows of a position and a quaternion, whose order must be told; or
        positions and frames, ``(positions, frames)``, as `FramedCurve.from_vertex_frames` takes
        them. Directions of frames are the columns of matrices.
    order : "wxyz" or "xyzw"
        Where the scalar of quaternions is: "xyzw" in ROS, SciPy and most trackers.
    along : "x", "y" or "z"
        Which axis of the frames is along the curve and becomes a3; the one after it becomes a1.
        Default: "z", as base pairs have it; "x" for vehicles and many tools.
    closed : bool
        Whether the last pose is followed by the first.

    Raises
    ------
    ValueError
        Another shape; quaternions without ``order``; a last row of a matrix that is not 0, 0, 0, 1.
    """
    if along not in ("x", "y", "z"):
        raise ValueError(f"along: expected 'x', 'y' or 'z', got {shortly(along)}")
    positions, frames = _positions_and_frames(poses, order)
    turned = multiply(frames, as_frames(_cycle(along)[None], "along")[0])
    return FramedCurve.from_vertex_frames(
        Polyline(positions, closed=yes_or_no(closed, "closed")), turned
    )


def _cycle(along: str) -> Array:
    """Columns: the axes that become a1, a2, a3."""
    last = "xyz".index(along)
    return np.eye(3)[:, [(last + 1) % 3, (last + 2) % 3, last]]


def _positions_and_frames(poses: Any, order: Order | None) -> tuple[ArrayLike, Array]:
    """Positions, and frames as quaternions with the scalar first."""
    if isinstance(poses, tuple) and len(poses) == 2:
        positions, frames = poses
        if is_rotation(frames) or np.ndim(frames) == 3:
            return positions, as_frames(frames, "poses[1]")
        return positions, _scalar_first(array(frames, "poses[1]"), order)
    made = array(poses, "poses")
    if made.ndim == 3 and made.shape[1:] == (4, 4):
        odd = np.abs(made[:, 3] - [0, 0, 0, 1]).max(axis=1) > 1e-9
        if odd.any():
            j = int(np.argmax(odd))
            raise ValueError(
                f"poses[{j}]: expected the last row 0, 0, 0, 1, got {made[j, 3]}; transpose the "
                "matrices if their translations are there"
            )
        return made[:, :3, 3], as_frames(made[:, :3, :3], "poses")
    if made.ndim == 2 and made.shape[1] == 7:
        return made[:, :3], _scalar_first(made[:, 3:], order)
    raise ValueError(
        f"poses: expected shape (k, 4, 4), (k, 7) or a pair (positions, frames), got {made.shape}"
    )


def _scalar_first(q: Array, order: Order | None) -> Array:
    if order not in ("wxyz", "xyzw"):
        raise ValueError(
            "order: say where the scalar of the quaternions is, 'wxyz' or 'xyzw' (ROS, SciPy), got "
            f"{shortly(order)}"
        )
    return as_frames(np.roll(q, 1, axis=-1) if order == "xyzw" else q, "poses")


# Frames at any place ------------------------------------------------------------------------------


def places_with_frames(curve: FramedCurve, s: ArrayLike) -> tuple[Array, Array]:
    """Points of the curve and the frames there, by arc length.

    Points are on the edges, frames on the shortest way from the centre of an edge to that of the
    next, or to the frame that holds an end: of second order.

    Parameters
    ----------
    curve : `FramedCurve`
    s : (...) array [m]
        Arc length of its polyline, from 0 to the length; that of a closed one goes round.

    Returns
    -------
    positions : (..., 3) array [m]
    frames : (..., 4) array
    """
    at = array(s, "s")
    positions = at_arc_lengths(curve.polyline, at)
    where = at.ravel() % curve.polyline.length if curve.polyline.closed else at.ravel()
    return positions, _frames_at(curve, where).reshape((*at.shape, 4))


def resampled_frames(curve: FramedCurve, edges: int, *, smooth: bool = True) -> FramedCurve:
    """The same curve on as many edges of equal length; frames along the edges stay so.

    Parameters
    ----------
    curve : `FramedCurve`
    edges : int
    smooth : bool
        See `Polyline.resampled`.
    """
    old = curve.polyline
    arc = resampled(old, whole(edges, "edges"), smooth=smooth)
    frames = _frames_at(curve, arc.centre_arc_lengths * (old.length / arc.length))
    made = FramedCurve(arc, frames, None, curve.start_frame, curve.end_frame)
    a3 = rotate(curve.frames, [0.0, 0.0, 1.0])
    is_adapted = np.abs(a3 - old.tangents).max() < _ADAPTED
    return made.adapted() if is_adapted else made


def _frames_at(curve: FramedCurve, s: Array) -> Array:
    """Frames at arc lengths in the one way round."""
    at, q = _places_of_frames(curve)
    piece = np.clip(np.searchsorted(at, s, side="right") - 1, 0, len(at) - 2)
    steps = log(multiply(conjugate(q[:-1]), q[1:]))
    part = (s - at[piece]) / np.diff(at)[piece]
    part = np.clip(part, 0.0, 1.0)
    return multiply(q[piece], exp(part[:, None] * steps[piece]))


def _places_of_frames(curve: FramedCurve) -> tuple[Array, Array]:
    """Where frames are known, so far that all of the curve lies between."""
    arc, q = curve.polyline, curve.frames
    at = arc.centre_arc_lengths
    if arc.closed:
        around: NDArray[np.intp] = np.r_[-1, np.arange(len(q)), 0]
        places = np.concatenate([at[-1:] - arc.length, at, at[:1] + arc.length])
        return places, _shorter(q[around])
    start = q[:1] if curve.start_frame is None else curve.start_frame[None]
    end = q[-1:] if curve.end_frame is None else curve.end_frame[None]
    return np.concatenate([[0.0], at, [arc.length]]), np.vstack([start, q, end])


def _shorter(q: Array) -> Array:
    """Signs at the seam of a closed curve by the shorter way, inside as they were."""
    q = q.copy()
    q[0] *= np.sign(q[0] @ q[1]) or 1.0
    q[-1] *= np.sign(q[-1] @ q[-2]) or 1.0
    return q
