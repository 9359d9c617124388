"""Rotations as unit quaternions ``(w, x, y, z)``, one or many at a time.

Arrays have shape ``(..., 4)`` for quaternions and ``(..., 3)`` for vectors; leading axes are kept.
A quaternion and its negative are the same frame but not the same turn: ``log`` reaches up to 2 pi
and no function flips a sign (Linn 2020, note 9). Where quaternions are taken, a ``Rotation`` of
SciPy is, too; as an array it has the scalar last, ``as_quat()``, which pyrod cannot tell from its
own order: give the object, or ``as_quat(scalar_first=True)``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import pyrod._core as _core
from pyrod.base.arrays import Array, array, is_rotation
from pyrod.base.words import shortly


def quaternions(values: Any, name: str) -> Array:
    """Numbers, or those of a Rotation of SciPy with the scalar first."""
    if is_rotation(values):
        return np.roll(np.asarray(values.as_quat(), dtype=np.float64), 1, axis=-1)
    return array(values, name)


def _rowwise(function: Callable[[Array], Array], values: Array, last: int, name: str) -> Array:
    """Applies ``function`` of (n, k) arrays to an array with any leading axes."""
    if values.ndim == 0 or values.shape[-1] != last:
        raise ValueError(f"{name}: expected an array of shape (..., {last}), got {values.shape}")
    out = function(values.reshape(-1, last))
    return out.reshape(values.shape[:-1] + out.shape[1:])


def _pairwise(function: Callable[[Array, Array], Array], **named: Array) -> Array:
    """The same for two arrays whose leading axes broadcast: quaternions, and what is named."""
    (first, a), (second, b) = named.items()
    last = 4 if second == "b" else 3
    for name, values, k in ((first, a, 4), (second, b, last)):
        if values.ndim == 0 or values.shape[-1] != k:
            raise ValueError(f"{name}: expected an array of shape (..., {k}), got {values.shape}")
    try:
        leading = np.broadcast_shapes(a.shape[:-1], b.shape[:-1])
    except ValueError:
        raise ValueError(
            f"{first}, {second}: as many of one as of the other, or one, got shapes {a.shape} "
            f"and {b.shape}"
        ) from None
    a, b = np.broadcast_to(a, (*leading, 4)), np.broadcast_to(b, (*leading, last))
    return function(a.reshape(-1, 4), b.reshape(-1, last)).reshape((*leading, last))


def exp(vector: ArrayLike) -> Array:
    """Quaternion that turns by a rotation vector [rad]: (..., 3) -> (..., 4)."""
    return _rowwise(_core.rotation.exp, array(vector, "vector"), 3, "vector")


def log(quaternion: ArrayLike) -> Array:
    """Rotation vector [rad], of length up to 2 pi: (..., 4) -> (..., 3)."""
    return _rowwise(_core.rotation.log, quaternions(quaternion, "quaternion"), 4, "quaternion")


def cayley(vector: ArrayLike) -> Array:
    """(1 + q)/(1 - q): turns by theta with ``tan(theta/4) = |q|`` (Linn 2020, note 3)."""
    return _rowwise(_core.rotation.cayley, array(vector, "vector"), 3, "vector")


def inverse_cayley(quaternion: ArrayLike) -> Array:
    """(p - 1)/(p + 1), the inverse of ``cayley`` unless p = -1."""
    return _rowwise(
        _core.rotation.inverse_cayley, quaternions(quaternion, "quaternion"), 4, "quaternion"
    )


def multiply(a: ArrayLike, b: ArrayLike) -> Array:
    """Hamilton product: the rotation b followed, in space, by a."""
    return _pairwise(_core.rotation.multiply, a=quaternions(a, "a"), b=quaternions(b, "b"))


def rotate(quaternion: ArrayLike, vector: ArrayLike) -> Array:
    """R v: from the frame's components to space. Broadcasts."""
    return _pairwise(
        _core.rotation.rotate,
        quaternion=quaternions(quaternion, "quaternion"),
        vector=array(vector, "vector"),
    )


def conjugate(quaternion: ArrayLike) -> Array:
    """The inverse rotation."""
    q = quaternions(quaternion, "quaternion")
    return _rowwise(lambda rows: rows * np.array([1.0, -1.0, -1.0, -1.0]), q, 4, "quaternion")


def to_matrix(quaternion: ArrayLike) -> Array:
    """Rotation matrices with the directors as columns: (..., 4) -> (..., 3, 3)."""
    return _rowwise(
        _core.rotation.to_matrix, quaternions(quaternion, "quaternion"), 4, "quaternion"
    )


def from_matrix(matrix: ArrayLike) -> Array:
    """Quaternions of rotation matrices: (..., 3, 3) -> (..., 4). Raises if not orthonormal."""
    R = array(matrix, "matrix")
    if R.shape[-2:] != (3, 3):
        raise ValueError(f"matrix: expected shape (..., 3, 3), got {R.shape}")
    return _rowwise(_core.rotation.from_matrix, R.reshape((*R.shape[:-2], 9)), 9, "matrix")


def continued(frames: ArrayLike) -> Array:
    """(n, 4) frames with the signs chosen so that no neighbours differ by more than pi."""
    q = np.array(as_frames(frames, "frames"))
    flips = np.einsum("ij,ij->i", q[1:], q[:-1]) < 0
    q[1:] *= np.where(np.cumsum(flips) % 2 == 1, -1.0, 1.0)[:, None]
    return q


def as_frames(frames: Any, name: str) -> Array:
    """Frames given as quaternions (n, 4), matrices (n, 3, 3) or a Rotation, as quaternions."""
    made = quaternions(frames, name)
    if made.ndim == 3 and made.shape[1:] == (3, 3):
        return from_matrix(made)
    if made.ndim == 2 and made.shape[1] == 4:
        return made
    lies = "; transpose it (.T)" if made.ndim == 2 and made.shape[0] == 4 else ""
    raise ValueError(
        f"{name}: expected quaternions of shape (n, 4) or rotation matrices of shape (n, 3, 3), "
        f"got shape {made.shape}{lies}"
    )


def as_frame(frame: Any, name: str) -> Array:
    """One frame, given as a quaternion (4,), a matrix (3, 3) or a Rotation, as a quaternion."""
    made = quaternions(frame, name)
    if made.shape not in ((4,), (3, 3)):
        raise ValueError(
            f"{name}: expected a quaternion (w, x, y, z) or a rotation matrix (3, 3), got shape "
            f"{made.shape}"
        )
    return as_frames(made[None], name)[0]


def unit_frame(frame: Any, name: str) -> Array:
    """The same, and of length 1."""
    q = as_frame(frame, name)
    if not abs(np.linalg.norm(q) - 1) < 1e-6:
        raise ValueError(f"{name}: expected a unit quaternion (w, x, y, z), got {q}")
    return q


def have_signs(frames: Any) -> bool:
    """Whether frames came as quaternions, whose signs are part of what they tell."""
    return not is_rotation(frames) and np.shape(frames)[-2:] != (3, 3)


def frame_along(tangent: ArrayLike, normal: ArrayLike | None = None) -> Array:
    """Quaternion of the frame with a3 along ``tangent`` and a1 as near to ``normal`` as can be.

    Without a normal, the frame e1, e2, e3 is turned the shortest way.
    """
    t = _direction(tangent, "tangent")
    if normal is None:
        sine = np.hypot(t[0], t[1])
        if sine == 0 and t[2] < 0:  # every way is the shortest: half a turn about e1
            return np.array([0.0, 1.0, 0.0, 0.0])
        turn = np.arctan2(sine, t[2])
        return exp(turn * np.array([-t[1], t[0], 0.0]) / (sine or 1.0))
    n = _direction(normal, "normal")
    a1 = n - (n @ t) * t
    if np.linalg.norm(a1) < 1e-6:
        raise ValueError("normal: must not be parallel to the tangent")
    a1 /= np.linalg.norm(a1)
    a1 -= (a1 @ t) * t  # again, for what cancelled if the normal is near the tangent
    return from_matrix(np.column_stack([a1, np.cross(t, a1), t]))


def _direction(values: ArrayLike, name: str) -> Array:
    v = array(values, name)
    if v.shape != (3,) or not np.isfinite(v).all() or not v.any():
        raise ValueError(
            f"{name}: expected a vector of 3 finite numbers, not zero, got {shortly(values)}"
        )
    v = v / np.abs(v).max()  # so that squares neither overflow nor vanish
    return v / np.linalg.norm(v)
