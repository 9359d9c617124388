"""What is told of knots: nearest edges, and whole numbers."""

from __future__ import annotations

from typing import NamedTuple


class Approach(NamedTuple):
    """The two edges that come nearest to each other; infinitely far, -1 and -1 if there are
    none."""

    distance: float  #: [m]
    edge: int  #: number of the one
    other: int  #: number of the other


def nearest_whole(value: float) -> int:
    """The whole number that a sum of angles must be."""
    if abs(value - round(value)) > 1e-6:
        raise ArithmeticError(
            f"expected a whole number, got {value}: edges come too near to each other for rounding"
        )
    return round(value)
