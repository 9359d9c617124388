"""Frames as they were probably meant: one per edge, with a3 along it, scalar first, columns."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np

import pyrod._core as _core
from pyrod.base.arrays import Array
from pyrod.base.calls import users_level
from pyrod.base.immutable import frozen
from pyrod.curve._warning import CurveWarning
from pyrod.rotation import (
    as_frames,
    conjugate,
    continued,
    exp,
    have_signs,
    log,
    multiply,
    quaternions,
    rotate,
)

FAR = 1.0
"""[rad] A frame whose a3 is farther from its edge than this is not adapted in any sense."""
NEAR = 0.2
"""[rad] If another reading brings every a3 so near, it is what was meant."""


def signed(frames: Any) -> Array:
    """Quaternions; those of matrices with continued signs."""
    q = as_frames(frames, "frames")
    if not have_signs(frames):
        _core.curve.check_continued(q)
        q = continued(q)
    return q


def held(frame: Any, name: str, near: Array) -> Array | None:
    """The frame of an end; that of a matrix with the sign of its neighbour."""
    if frame is None:
        return None
    q = as_frames(quaternions(frame, name)[None], name)[0]
    return frozen(-q if not have_signs(frame) and (near @ q < 0).any() else q)


def between_vertices(frames: Any, edges: int, closed: bool) -> tuple[Array, Array]:
    """Frames of the edges half-way between those of their ends; and these with continued signs."""
    q, points = as_frames(frames, "frames"), edges + (not closed)
    if len(q) != points:
        raise ValueError(f"frames: expected {points} rows (one per vertex), got {len(q)}")
    _core.curve.check_continued(q)
    q = continued(q)
    steps = multiply(conjugate(q), np.roll(q, -1, axis=0))[:edges]
    steps *= np.where(steps[:, :1] < 0, -1.0, 1.0)  # the last step of a closed curve
    return multiply(q[:edges], exp(log(steps) / 2)), q


def check_count(q: Array, edges: int, closed: bool) -> None:
    """Frames belong to edges."""
    if len(q) == edges:
        return
    points = edges + (not closed)
    hint = (
        "; frames at the points are taken by FramedCurve.from_vertex_frames"
        if len(q) == points
        else ""
    )
    raise ValueError(f"frames: expected {edges} rows (one per edge), got {len(q)}{hint}")


def check_reading(frames: Any, q: Array, tangents: Array) -> None:
    """Refuses frames that fit the edges in another order of their numbers only.

    Warns if no frame is near its edge.
    """
    away = _angles(q, tangents)
    if away.max() <= FAR:
        return
    if have_signs(frames):
        other, meant = (
            np.roll(q, 1, axis=1),
            "quaternions (x, y, z, w), as SciPy and ROS order them",
        )
        remedy = "put the scalar first, numpy.roll(q, 1, axis=-1), or give a Rotation"
    else:
        other, meant = conjugate(q), "matrices whose rows are the directors"
        remedy = "transpose them, R.transpose(0, 2, 1)"
    worst = int(np.argmax(away))
    said = f"frames[{worst}]: a3 is {away[worst]:.2g} rad from the edge"
    if _angles(other, tangents).max() < NEAR:
        raise ValueError(f"{said}, but would be along all of them if these were {meant}: {remedy}")
    if away.min() > FAR:
        warnings.warn(
            f"{said}, and more than {FAR:g} rad from every other; quaternions are (w, x, y, z), "
            "matrices have the directors as columns, a3 is along the curve",
            CurveWarning,
            stacklevel=users_level(),
        )


def _angles(q: Array, tangents: Array) -> Array:
    """(n,) angles between a3 and the edges."""
    a3 = rotate(q, [0.0, 0.0, 1.0])
    a3 /= np.linalg.norm(a3, axis=1, keepdims=True)
    sine = np.linalg.norm(np.cross(a3, tangents), axis=1)
    return np.arctan2(sine, np.einsum("ij,ij->i", a3, tangents))
