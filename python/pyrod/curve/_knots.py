"""Pairs of arcs, and whole numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Union

from numpy.typing import ArrayLike

from pyrod.base.arrays import whole as whole_number

if TYPE_CHECKING:
    from pyrod.curve._polyline import Polyline


class Approach(NamedTuple):
    """The two edges that come nearest to each other; infinitely far, -1 and -1 if there are
    none."""

    distance: float
    edge: int
    other: int


def linking_number(
    a: Union[Polyline, ArrayLike], b: Union[Polyline, ArrayLike], threads: int = 0
) -> int:
    """How often two closed polylines wind around each other, by Gauss's integral. O(n m).

    Positions are taken for those of closed ones. Raises ``ValueError`` where they meet. Positive
    for right-handed crossings.
    """
    a, b = as_polyline(a, "a", closed=True), as_polyline(b, "b", closed=True)
    a._require_closed("linking_number")
    b._require_closed("linking_number")
    return whole(a._arc.gauss_integral(b._arc, whole_number(threads, "threads")))


def as_polyline(given: Union[Polyline, ArrayLike], name: str, closed: bool) -> Polyline:
    """A polyline as it is, or made of positions."""
    from pyrod.curve._polyline import Polyline

    if isinstance(given, Polyline):
        return given
    try:
        return Polyline(given, closed=closed)
    except (ValueError, TypeError) as error:
        raise type(error)(f"{name}: expected a Polyline or positions; {error}") from None


def whole(value: float) -> int:
    """The whole number that a sum of angles must be."""
    if abs(value - round(value)) > 1e-6:
        raise ArithmeticError(
            f"expected a whole number, got {value}: edges come too near to each other for rounding"
        )
    return round(value)
