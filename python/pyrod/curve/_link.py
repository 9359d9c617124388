"""The link of two closed curves."""

from __future__ import annotations

from typing import Union

from numpy.typing import ArrayLike

from pyrod.base.arrays import whole
from pyrod.curve._arc import require_closed
from pyrod.curve._knots import nearest_whole
from pyrod.curve._polyline import Polyline, as_polyline


def linking_number(
    a: Union[Polyline, ArrayLike], b: Union[Polyline, ArrayLike], threads: int = 0
) -> int:
    """How often two closed polylines wind around each other, by Gauss's integral. O(n m).

    Positive for right-handed crossings.

    Parameters
    ----------
    a, b : `Polyline` or (n, 3) array [m]
        Positions are taken for those of closed ones.
    threads : int
        Default 0: as many as the machine has cores.

    Raises
    ------
    ValueError
        They meet.
    """
    a, b = as_polyline(a, "a", closed=True), as_polyline(b, "b", closed=True)
    require_closed(a, "linking_number")
    require_closed(b, "linking_number")
    return nearest_whole(a._arc.gauss_integral(b._arc, whole(threads, "threads")))
