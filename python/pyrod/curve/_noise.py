"""What positions that were measured tell of their own errors."""

from __future__ import annotations

from math import comb

import numpy as np

from pyrod.base.arrays import Array
from pyrod.curve._arc import Arc

_ORDER = 5
"""Of the differences, in which a curve that is sampled finely leaves nothing but noise."""


def estimated_noise(arc: Arc) -> Array:
    """(3,) standard deviations [m] of the noise of the positions along x, y, z.

    Of noise that is independent from point to point, on edges of about equal length, short beside
    the radius of curvature: from fifth differences, where little else is left. What a curve really
    does between neighbouring points counts as noise.

    Raises
    ------
    ValueError
        Less than 12 vertices.
    """
    r = arc.positions
    if len(r) < 12:
        raise ValueError(f"estimated_noise: needs at least 12 vertices, got {len(r)}")
    if arc.closed:
        r = np.vstack([r, r[:_ORDER]])
    squares = np.diff(r, _ORDER, axis=0) ** 2
    return np.asarray(np.sqrt(squares.mean(axis=0) / comb(2 * _ORDER, _ORDER)))
