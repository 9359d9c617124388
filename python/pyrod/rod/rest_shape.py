"""The curvature that a framed polyline has at rest."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

import pyrod._core as _core
from pyrod.base.immutable import Array
from pyrod.curve import FramedCurve, Polyline
from pyrod.curve._reading import check_count, check_reading
from pyrod.rotation import as_frames, continued, exp, multiply


def ribbon(positions: ArrayLike, frames: ArrayLike | None) -> FramedCurve:
    """Frames turned the shortest way so that a3 is the tangent, with continued signs.

    Without any those that do not twist.
    """
    polyline = Polyline(positions)
    if frames is None:
        frames = polyline.bishop().frames
    q = as_frames(frames, "frames")
    check_count(q, polyline.edges, polyline.closed)
    check_reading(frames, q, polyline.tangents)
    q = _core.curve.adapted(q, polyline.tangents, 0.5)
    _core.curve.check_continued(q)
    return FramedCurve(polyline, continued(q))


def rest_curvature(shape: FramedCurve) -> tuple[Array, Array]:
    """K0 at the vertices, continued over the half edges at the ends; and the frame at the start."""
    K0 = np.array(shape.K)
    if len(K0) > 2:
        K0[0], K0[-1] = K0[1], K0[-2]
    half = shape.polyline.edge_lengths[0] / 2
    return K0, multiply(shape.frames[0], exp(-half * K0[0]))
