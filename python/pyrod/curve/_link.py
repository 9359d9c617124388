"""How curves wind around each other and themselves, and how near they come."""

from __future__ import annotations

from typing import Union

import numpy as np
from numpy.typing import ArrayLike

from pyrod.base.arrays import whole
from pyrod.curve._arc import require_closed
from pyrod.curve._crossings import gauss_integral
from pyrod.curve._knots import Approach, nearest_whole
from pyrod.curve._points import inflections
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
    return nearest_whole(gauss_integral(a, b, threads))


def frenet_link(arc: Polyline, threads: int = 0) -> int:
    """Linking number of a closed arc with its Frenet ribbon: writhe plus total torsion/2 pi.

    Counts the arc's own crossings. Raises ``ValueError`` where the binormal turns by pi within
    rounding, as at the inflections of a plane curve: there the ribbon has no sides. O(n^2).
    """
    require_closed(arc, "frenet_link")
    at = inflections(arc)
    if len(at):
        some = ", ".join(map(str, at[:8])) + (", ..." if len(at) > 8 else "")
        raise ValueError(
            f"frenet_link: on the edges {some} the binormal turns by pi within rounding, an "
            "inflection, where the Frenet ribbon has no link; take writhe, or closed_ribbon"
        )
    return nearest_whole(arc.writhe(threads) + arc.dihedral_angles.sum() / (2 * np.pi))


def self_approach(arc: Polyline, threads: int = 0) -> Approach:
    """Smallest distance between two parts of the arc that are not near along it. O(n^2).

    Two edges count if the way between their centres is more than one and a half times as long
    along the arc as it is straight: on a circle, if they are nearly opposite.
    """
    return Approach(*arc._compiled.self_approach(whole(threads, "threads")))


def approach(arc: Polyline, other: Union[Polyline, ArrayLike], threads: int = 0) -> Approach:
    """Smallest distance between an edge of this and an edge of another. O(n m).

    Parameters
    ----------
    arc : `Polyline`
    other : `Polyline` or (n, 3) array [m]
        Positions are taken for those of an open one.
    threads : int
        Default 0: as many as the machine has cores.
    """
    them = as_polyline(other, "other", closed=False)._compiled
    return Approach(*arc._compiled.approach(them, whole(threads, "threads")))


def holonomy(arc: Polyline) -> float:
    """Angle [rad] in (-pi, pi] by which parallel transport once around turns a frame.

    Equal to 2 pi times the writhe, up to whole turns.
    """
    require_closed(arc, "holonomy")
    return arc._compiled.holonomy()


def writhe(arc: Polyline, threads: int = 0) -> float:
    """Writhe, exact for the polygon. O(n^2), on all cores unless ``threads`` says how many.

    The same to the last bit for any number of threads. Raises ``ValueError`` where edges meet.
    """
    if not arc.closed and np.array_equal(arc.positions[0], arc.positions[-1]):
        raise ValueError(
            "positions: the last point is the first again; leave it out and make the polyline "
            "with closed=True"
        )
    return arc._compiled.writhe(whole(threads, "threads"))
