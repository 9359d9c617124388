"""Rotations as unit quaternions ``(w, x, y, z)``, one or many at a time.

Arrays have shape ``(..., 4)`` for quaternions and ``(..., 3)`` for vectors; leading axes are kept.
A quaternion and its negative are the same frame but not the same turn: ``log`` reaches up to 2 pi
and no function flips a sign (Linn 2020, note 9).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from pyrod import _core
from pyrod._immutable import Array


def _rowwise(function: Callable[[Array], Array], values: ArrayLike, last: int) -> Array:
    """Applies ``function`` of (n, k) arrays to an array with any leading axes."""
    array = np.asarray(values, dtype=np.float64)
    if array.ndim == 0 or array.shape[-1] != last:
        raise ValueError(f"expected an array of shape (..., {last}), got {array.shape}")
    out = function(array.reshape(-1, last))
    return out.reshape(array.shape[:-1] + out.shape[1:])


def _pairwise(
    function: Callable[[Array, Array], Array], a: ArrayLike, b: ArrayLike, last: int
) -> Array:
    """The same for two arrays whose leading axes broadcast."""
    a, b = np.asarray(a, dtype=np.float64), np.asarray(b, dtype=np.float64)
    for name, array, k in (("first", a, 4), ("second", b, last)):
        if array.ndim == 0 or array.shape[-1] != k:
            raise ValueError(f"{name} argument: expected shape (..., {k}), got {array.shape}")
    leading = np.broadcast_shapes(a.shape[:-1], b.shape[:-1])
    a, b = np.broadcast_to(a, (*leading, 4)), np.broadcast_to(b, (*leading, last))
    return function(a.reshape(-1, 4), b.reshape(-1, last)).reshape((*leading, last))


def exp(vector: ArrayLike) -> Array:
    """Quaternion that turns by a rotation vector [rad]: (..., 3) -> (..., 4)."""
    return _rowwise(_core.rotation.exp, vector, 3)


def log(quaternion: ArrayLike) -> Array:
    """Rotation vector [rad], of length up to 2 pi: (..., 4) -> (..., 3)."""
    return _rowwise(_core.rotation.log, quaternion, 4)


def cayley(vector: ArrayLike) -> Array:
    """(1 + q)/(1 - q): turns by theta with tan(theta/4) = |q| (Linn 2020, note 3)."""
    return _rowwise(_core.rotation.cayley, vector, 3)


def inverse_cayley(quaternion: ArrayLike) -> Array:
    """(p - 1)/(p + 1), the inverse of ``cayley`` unless p = -1."""
    return _rowwise(_core.rotation.inverse_cayley, quaternion, 4)


def multiply(a: ArrayLike, b: ArrayLike) -> Array:
    """Hamilton product: the rotation b followed, in space, by a."""
    return _pairwise(_core.rotation.multiply, a, b, 4)


def rotate(quaternion: ArrayLike, vector: ArrayLike) -> Array:
    """R v: from the frame's components to space. Broadcasts."""
    return _pairwise(_core.rotation.rotate, quaternion, vector, 3)


def conjugate(quaternion: ArrayLike) -> Array:
    """The inverse rotation."""
    return _rowwise(lambda q: q * np.array([1.0, -1.0, -1.0, -1.0]), quaternion, 4)


def to_matrix(quaternion: ArrayLike) -> Array:
    """Rotation matrices with the directors as columns: (..., 4) -> (..., 3, 3)."""
    return _rowwise(_core.rotation.to_matrix, quaternion, 4)


def from_matrix(matrix: ArrayLike) -> Array:
    """Quaternions of rotation matrices: (..., 3, 3) -> (..., 4). Raises if not orthonormal."""
    matrix = np.asarray(matrix, dtype=np.float64)
    if matrix.shape[-2:] != (3, 3):
        raise ValueError(f"matrix: expected shape (..., 3, 3), got {matrix.shape}")
    return _rowwise(_core.rotation.from_matrix, matrix.reshape((*matrix.shape[:-2], 9)), 9)


def continued(frames: ArrayLike) -> Array:
    """(n, 4) frames with the signs chosen so that no neighbours differ by more than pi."""
    frames = np.array(frames, dtype=np.float64)
    flips = np.einsum("ij,ij->i", frames[1:], frames[:-1]) < 0
    frames[1:] *= np.where(np.cumsum(flips) % 2 == 1, -1.0, 1.0)[:, None]
    return frames


def as_frames(frames: ArrayLike, name: str) -> Array:
    """Frames given as quaternions (n, 4) or matrices (n, 3, 3), as quaternions."""
    array = np.asarray(frames, dtype=np.float64)
    if array.ndim == 3 and array.shape[1:] == (3, 3):
        return from_matrix(array)
    if array.ndim == 2 and array.shape[1] == 4:
        return array
    raise ValueError(
        f"{name}: expected quaternions of shape (n, 4) or rotation matrices of shape (n, 3, 3), "
        f"got shape {array.shape}"
    )


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
    v = np.asarray(values, dtype=np.float64)
    if v.shape != (3,) or not np.isfinite(v).all() or not v.any():
        raise ValueError(f"{name}: expected a vector of 3 finite numbers, not zero, got {values!r}")
    v = v / np.abs(v).max()  # so that squares neither overflow nor vanish
    return v / np.linalg.norm(v)
