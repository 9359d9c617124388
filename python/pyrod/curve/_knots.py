"""What is told of knots: nearest edges, and whole numbers."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pyrod.base.arrays import Array


class Approach(NamedTuple):
    """The two edges that come nearest to each other; infinitely far, -1 and -1 if there are
    none."""

    distance: float  #: [m]
    edge: int  #: number of the one
    other: int  #: number of the other


class Nearest(NamedTuple):
    """Where an arc is nearest to points; a row for each, or one if one was given."""

    s: Array  #: arc length of the place [m]
    distance: Array  #: [m]
    positions: Array  #: (m, 3) the places [m]
    edge: NDArray[np.intp]  #: numbers of the edges on which they are


def nearest_whole(value: float) -> int:
    """The whole number that a sum of angles must be."""
    if abs(value - round(value)) > 1e-6:
        raise ArithmeticError(
            f"expected a whole number, got {value}: edges come too near to each other for rounding"
        )
    return round(value)
