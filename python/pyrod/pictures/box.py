"""The box that a picture shows."""

from __future__ import annotations

import numpy as np

from pyrod.base.immutable import Array


def box(points: Array) -> tuple[Array, Array]:
    """Lowest and highest corner, (3,) each, of a box around (p, 3) points that is not flat."""
    low, high = points.min(axis=0), points.max(axis=0)
    centre, size = (low + high) / 2, high - low
    size = np.maximum(size, size.max() / 4)
    return centre - size / 2, centre + size / 2
