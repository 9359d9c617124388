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
Edges = tuple[Array, Array]
"""(n, 3) starts and ends."""


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
    return _sliding(arc, first, last)


def _sliding(arc: Polyline, first: NDArray[np.intp], last: NDArray[np.intp]) -> Array:
    """Sums over the pairs of edges in [first, last), which move on; each pair comes in once and
    goes once."""
    edges = _ends_of_edges(arc)
    writhe, start, end = 0.0, int(first[0]), int(first[0])
    found = np.empty(len(first))
    for j, (new_start, new_end) in enumerate(zip(first.tolist(), last.tolist(), strict=True)):
        for number_ in range(end, new_end):
            writhe += _with_others(arc, edges, number_, start, number_)
        end = new_end
        for number_ in range(start, new_start):
            writhe -= _with_others(arc, edges, number_, number_ + 1, end)
        start = new_start
        found[j] = writhe
    return found


def _with_others(arc: Polyline, edges: Edges, one: int, first: int, last: int) -> float:
    """Crossings of one edge with those of a stretch, whose numbers go round."""
    n = arc.edges
    others = np.arange(first, last) % n
    one %= n
    others = others[~_neighbours(arc, one, others)]
    return float(_signed(_some_of(edges, np.array([one])), _some_of(edges, others)).sum())


# Pairs of edges -----------------------------------------------------------------------------------


def _both(
    a: Union[Polyline, ArrayLike], b: Union[Polyline, ArrayLike, None]
) -> tuple[Polyline, Polyline]:
    first = as_polyline(a, "a", closed=False)
    return first, first if b is None else as_polyline(b, "b", closed=False)


def _by_rows(a: Polyline, b: Polyline, same: bool) -> Iterator[tuple[NDArray[np.intp], Array]]:
    """Some rows of the map at a time, and which they are."""
    of_a, of_b = _ends_of_edges(a), _ends_of_edges(b)
    numbers = np.arange(b.edges)
    step = max(1, _AT_ONCE // b.edges)
    for at in range(0, a.edges, step):
        rows = np.arange(at, min(at + step, a.edges))
        met = _neighbours(a, rows[:, None], numbers) if same else None
        yield rows, _signed(_some_of(of_a, rows), of_b, met)


def _ends_of_edges(arc: Polyline) -> Edges:
    return arc.positions[: arc.edges], np.roll(arc.positions, -1, axis=0)[: arc.edges]


def _some_of(edges: Edges, numbers: NDArray[np.intp]) -> Edges:
    return edges[0][numbers], edges[1][numbers]


def _neighbours(
    arc: Polyline, one: int | NDArray[np.intp], others: NDArray[np.intp]
) -> NDArray[np.bool_]:
    """Whether edges share a vertex."""
    away = np.abs(one - others)
    return away <= 1 if not arc.closed else np.minimum(away, arc.edges - away) <= 1


def _signed(a: Edges, b: Edges, without: NDArray[np.bool_] | None = None) -> Array:
    """(n, m) solid angle of each pair over 2 pi, as in curve/link.hpp; 0 for pairs left out."""
    corners = [b[i][None] - a[j][:, None] for i, j in ((0, 0), (0, 1), (1, 1), (1, 0))]
    lengths = [np.linalg.norm(c, axis=-1) for c in corners]
    with np.errstate(divide="ignore", invalid="ignore"):
        A, B, C, D = (c / h[..., None] for c, h in zip(corners, lengths, strict=True))
        normal = np.cross((a[1] - a[0])[:, None], (b[1] - b[0])[None])
        V = -np.einsum("nmi,nmi->nm", corners[0], normal)
        AC, scale = _dot(A, C), lengths[0] * lengths[2]
        z1 = 1 + _dot(A, B) + _dot(B, C) + AC + 1j * V / (scale * lengths[1])
        z2 = 1 + AC + _dot(C, D) + _dot(A, D) + 1j * V / (scale * lengths[3])
        found = np.copysign(np.angle(z1 * z2), V) / np.pi
    if without is not None:
        found[without] = 0.0
    if np.isnan(found).any():
        i = int(np.argwhere(np.isnan(found))[0, 0])
        raise ValueError(
            f"positions: the point {a[0][i]} is on both edges of a pair, so that crossings cannot "
            "be counted; move the curve apart there"
        )
    return found


def _dot(a: Array, b: Array) -> Array:
    return np.asarray(np.einsum("nmi,nmi->nm", a, b))
