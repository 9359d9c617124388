"""Crossings of pairs of edges: maps of them, means over all views, writhe of stretches."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pyrod.base.arrays import Array, number, whole
from pyrod.curve._polyline import Polyline, as_polyline

_AT_ONCE = 500_000
"""Pairs of edges that are looked at in one go."""
_MOST = 20_000
"""Edges whose map still fits into a memory: 3.2 GB."""
Numbers = NDArray[np.intp]
Edges = tuple[Array, Array]
"""(..., 3) starts and ends."""


def gauss_integral(
    a: Union[Polyline, ArrayLike], b: Union[Polyline, ArrayLike], threads: int = 0
) -> float:
    """Gauss's integral of two curves, open or closed: how often they wind around each other.

    Exact for polygons; whole (`linking_number`) where both are closed, for others the mean over
    all views of half the signed crossings. O(n m).

    Parameters
    ----------
    a, b : `Polyline` or (n, 3) array [m]
        Positions are taken for those of open ones.
    threads : int
        Default 0: as many as the machine has cores.

    Raises
    ------
    ValueError
        They meet.
    """
    a, b = as_polyline(a, "a", closed=False), as_polyline(b, "b", closed=False)
    return float(a._compiled.gauss_integral(b._compiled, whole(threads, "threads")))


def crossings(a: Union[Polyline, ArrayLike], b: Union[Polyline, ArrayLike, None] = None) -> Array:
    """The map of crossings: how often each edge of a curve is seen to cross each of another.

    Means over all views, with the sign of the crossing. Of one curve with itself half of the sum
    is the `Polyline.writhe`, of two curves it is `gauss_integral`.

    Parameters
    ----------
    a, b : `Polyline` or (n, 3) array [m]
        Positions are taken for those of open ones. Default of b: the first again.

    Returns
    -------
    (n, m) array
        Symmetric if there is one curve; edges that share a vertex do not cross.

    Raises
    ------
    ValueError
        They meet; more than 20000 edges, whose map takes gigabytes.
    """
    first, second = _both(a, b)
    if max(first.edges, second.edges) > _MOST:
        raise ValueError(
            f"crossings: a map of {first.edges} by {second.edges} edges is too large; take "
            "local_writhe, average_crossing_number or gauss_integral, which make none"
        )
    return np.vstack([rows for _, rows in _by_rows(first, second, first is second)])


def average_crossing_number(
    a: Union[Polyline, ArrayLike], b: Union[Polyline, ArrayLike, None] = None
) -> float:
    """How many crossings of a curve with itself, or with another, the mean of all views has.

    The sum of `crossings` without their signs. O(n m).

    Parameters
    ----------
    a, b : `Polyline` or (n, 3) array [m]
        As for `crossings`.
    """
    first, second = _both(a, b)
    total = sum(float(np.abs(rows).sum()) for _, rows in _by_rows(first, second, first is second))
    return total / 2 if first is second else total


def local_writhe(arc: Polyline, window: float) -> Array:
    """Writhe of the stretch of a given length around each vertex; large in plectonemes and coils.

    A stretch has the edges whose centres are within half the window of the vertex along the arc,
    at ends of open arcs as many as there are. O(n m) for m edges in a window.

    Parameters
    ----------
    arc : `Polyline`
    window : float [m]
        Less than the length of a closed arc.
    """
    window = number(window, "window")
    most = arc.length if arc.closed else np.inf
    if not 0 < window < most:
        raise ValueError(f"window: must be positive and less than {most:g}, got {window}")
    centres, at = arc.centre_arc_lengths, arc.arc_lengths
    if arc.closed:
        centres = np.concatenate([centres + turn * arc.length for turn in (-1, 0, 1)])
    first = np.searchsorted(centres, at - window / 2)
    last = np.searchsorted(centres, at + window / 2, side="right")
    e = np.arange(first[0], last[-1])
    comes = np.searchsorted(last, e, side="right")  # the stretch that has it first
    come = _with_stretches(arc, e, first[np.maximum(comes - 1, 0)], e)
    gone = np.arange(first[0], first[-1])
    goes = np.searchsorted(first, gone, side="right")
    go = _with_stretches(arc, gone, gone + 1, last[goes])
    n = len(at)
    change = np.bincount(comes, come, minlength=n) - np.bincount(goes, go, minlength=n)
    return np.asarray(np.cumsum(change))


def _with_stretches(arc: Polyline, one: Numbers, first: Numbers, last: Numbers) -> Array:
    """Crossings of edges with those of a stretch each, [first, last), whose numbers go round."""
    edges, n, counts = _ends_of_edges(arc), arc.edges, last - first
    ends = np.cumsum(counts)
    found = np.zeros(len(one))
    start = 0
    while start < len(one):
        stop = int(np.searchsorted(ends, ends[start] + _AT_ONCE, side="right"))
        stop = max(stop, start + 1)
        row = np.repeat(np.arange(start, stop), counts[start:stop])
        place = np.arange(len(row)) + (ends[start] - counts[start]) - (ends - counts)[row]
        a, b = one[row] % n, (first[row] + place) % n
        apart = ~_neighbours(arc, a, b)
        row, a, b = row[apart], a[apart], b[apart]
        signed = _checked(_signed(_some_of(edges, a), _some_of(edges, b)), edges[0][a])
        found += np.bincount(row, signed, minlength=len(one))
        start = stop
    return found


# Pairs of edges -----------------------------------------------------------------------------------


def _both(
    a: Union[Polyline, ArrayLike], b: Union[Polyline, ArrayLike, None]
) -> tuple[Polyline, Polyline]:
    first = as_polyline(a, "a", closed=False)
    return first, first if b is None else as_polyline(b, "b", closed=False)


def _by_rows(a: Polyline, b: Polyline, same: bool) -> Iterator[tuple[Numbers, Array]]:
    """Some rows of the map at a time, and which they are."""
    of_a, of_b = _ends_of_edges(a), _ends_of_edges(b)
    numbers = np.arange(b.edges)
    step = max(1, _AT_ONCE // b.edges)
    for at in range(0, a.edges, step):
        rows = np.arange(at, min(at + step, a.edges))
        start, end = _some_of(of_a, rows)
        found = _signed((start[:, None], end[:, None]), of_b)
        if same:
            found[_neighbours(a, rows[:, None], numbers)] = 0.0
        yield rows, _checked(found, start)


def _ends_of_edges(arc: Polyline) -> Edges:
    return arc.positions[: arc.edges], np.roll(arc.positions, -1, axis=0)[: arc.edges]


def _some_of(edges: Edges, numbers: Numbers) -> Edges:
    return edges[0][numbers], edges[1][numbers]


def _neighbours(arc: Polyline, one: Numbers, others: Numbers) -> NDArray[np.bool_]:
    """Whether edges share a vertex."""
    away = np.abs(one - others)
    return away <= 1 if not arc.closed else np.minimum(away, arc.edges - away) <= 1


def _signed(a: Edges, b: Edges) -> Array:
    """Solid angle of each pair over 2 pi, as in curve/link.hpp: (...), or NaN where they meet."""
    corners = [b[i] - a[j] for i, j in ((0, 0), (0, 1), (1, 1), (1, 0))]
    lengths = [np.linalg.norm(c, axis=-1) for c in corners]
    with np.errstate(divide="ignore", invalid="ignore"):
        A, B, C, D = (c / h[..., None] for c, h in zip(corners, lengths, strict=True))
        V = -_dot(corners[0], np.cross(a[1] - a[0], b[1] - b[0]))
        AC, scale = _dot(A, C), lengths[0] * lengths[2]
        z1 = 1 + _dot(A, B) + _dot(B, C) + AC + 1j * V / (scale * lengths[1])
        z2 = 1 + AC + _dot(C, D) + _dot(A, D) + 1j * V / (scale * lengths[3])
        return np.asarray(np.copysign(np.angle(z1 * z2), V) / np.pi)


def _checked(found: Array, starts: Array) -> Array:
    """No crossing is NaN; a row for each start of an edge."""
    met = np.isnan(found)
    if met.any():
        raise ValueError(
            f"positions: the edge from {starts[np.argwhere(met)[0, 0]]} has a vertex of another on "
            "it, so that crossings cannot be counted; move the curve apart there"
        )
    return found


def _dot(a: Array, b: Array) -> Array:
    return np.asarray(np.einsum("...i,...i->...", a, b))
