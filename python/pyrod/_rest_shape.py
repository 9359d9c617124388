"""The curvature that a framed polyline has at rest."""

from __future__ import annotations

import numpy as np

from pyrod._immutable import Array
from pyrod.rotation import conjugate, continued, exp, log, multiply, rotate


def adapted(frames: Array, tangents: Array) -> Array:
    """Frames turned the shortest way so that a3 is the tangent, with continued signs."""
    if len(frames) != len(tangents):
        raise ValueError(f"frames: expected {len(tangents)}, one per edge, got {len(frames)}")
    a3 = rotate(frames, np.array([0.0, 0.0, 1.0]))
    axis = np.cross(a3, tangents)
    sine, cosine = np.linalg.norm(axis, axis=1), np.einsum("ij,ij->i", a3, tangents)
    angle = np.arctan2(sine, cosine)
    worst = int(np.argmax(angle))
    if angle[worst] > 0.5:
        raise ValueError(
            f"frames[{worst}]: a3 is {angle[worst]:.3g} rad away from the edge; the third director "
            "must point along the rod"
        )
    scale = np.divide(angle, sine, out=np.ones_like(sine), where=sine > 0)
    return continued(multiply(exp(axis * scale[:, None]), frames))


def rest_curvature(frames: Array, h: Array) -> tuple[Array, Array]:
    """K0 at the vertices, and the frame at the start."""
    n = len(h)
    K0 = np.zeros((n + 1, 3))
    if n > 1:
        turns = log(multiply(conjugate(frames[:-1]), frames[1:]))
        size = np.linalg.norm(turns, axis=1)
        worst = int(np.argmax(size))
        if size[worst] > np.pi - 1e-9:
            raise ValueError(
                f"frames[{worst + 1}]: turned by pi from the one before, so that the sense of the "
                "turn is lost; use more edges"
            )
        K0[1:n] = turns / ((h[1:] + h[:-1]) / 2)[:, None]
        K0[0], K0[n] = K0[1], K0[n - 1]
    return K0, multiply(frames[0], exp(-h[0] / 2 * K0[0]))
