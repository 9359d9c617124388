"""Places on an arc: by arc length, and nearest to points."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pyrod.base.arrays import Array, array
from pyrod.curve._knots import Nearest
from pyrod.curve._points import positions_of
from pyrod.curve._polyline import Polyline

_AT_ONCE = 2_000_000
"""Pairs of points and edges that are looked at in one go."""


def at_arc_lengths(arc: Polyline, s: ArrayLike, values: ArrayLike | None = None) -> Array:
    """Points of the arc, or values given per vertex, by arc length.

    Linear on each edge; see `Polyline.smooth_curve` for the curve that bends.

    Parameters
    ----------
    arc : `Polyline`
    s : (...) array [m]
        From 0 to the length; that of a closed arc goes round.
    values : (k, ...) array
        One row for each of the k vertices, such as a column of the file from which they came;
        default: the positions. For values per edge take `Polyline.at_vertices` first.

    Raises
    ------
    ValueError
        Beyond the ends of an open arc.
    """
    x = arc.positions if values is None else array(values, "values")
    if x.shape[:1] != (len(arc.positions),):
        raise ValueError(
            f"values: expected {len(arc.positions)} rows (one per vertex), got shape {x.shape}"
        )
    edge, part = located(arc, array(s, "s"))
    start, end = x[edge], x[(edge + 1) % len(x)]
    part = part.reshape(part.shape + (1,) * (x.ndim - 1))
    return np.asarray(start + part * (end - start))


def located(arc: Polyline, s: Array) -> tuple[NDArray[np.intp], Array]:
    """Numbers of the edges, and which part of them is before the place."""
    length = arc.length
    if arc.closed:
        s = s % length
    slack = 1e-12 * length
    wrong = ~((s >= -slack) & (s <= length + slack))
    if wrong.any():
        raise ValueError(f"s: must be from 0 to the length {length:g}, got {s[wrong].ravel()[0]:g}")
    starts = arc.arc_lengths[: arc.edges]
    edge = np.clip(np.searchsorted(starts, s, side="right") - 1, 0, arc.edges - 1)
    return edge, np.clip((s - starts[edge]) / arc.edge_lengths[edge], 0.0, 1.0)


def nearest(arc: Polyline, points: ArrayLike) -> Nearest:
    """Where the arc is nearest to points: arc length, distance, place and edge. O(n m).

    Parameters
    ----------
    arc : `Polyline`
    points : (m, 3), (m, 2) or (3,) array [m]
        Two columns are taken for points of the plane z = 0.

    Returns
    -------
    Nearest
        Of several places as near, the first.
    """
    given = array(points, "points")
    one = given.ndim == 1
    p, _ = positions_of(given[None] if one else given, "points")
    if not np.isfinite(p).all():
        raise ValueError("points: expected finite numbers")
    rows = max(1, _AT_ONCE // arc.edges)
    pieces = [_nearest_of(arc, p[i : i + rows]) for i in range(0, len(p), rows)]
    found = Nearest(*(np.concatenate(part) for part in zip(*pieces, strict=True)))
    return Nearest(*(part[0] for part in found)) if one else found


def _nearest_of(arc: Polyline, p: Array) -> Nearest:
    a, vectors = arc.positions[: arc.edges], arc.edge_vectors
    gap = p[:, None] - a
    part = np.clip(np.einsum("mni,ni->mn", gap, vectors) / arc.edge_lengths**2, 0.0, 1.0)
    gap -= part[..., None] * vectors
    edge = np.argmin(np.einsum("mni,mni->mn", gap, gap), axis=1)
    row = np.arange(len(p))
    part = part[row, edge]
    return Nearest(
        arc.arc_lengths[edge] + part * arc.edge_lengths[edge],
        np.linalg.norm(gap[row, edge], axis=1),
        a[edge] + part[:, None] * vectors[edge],
        edge,
    )
