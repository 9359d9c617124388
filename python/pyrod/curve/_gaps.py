"""Points with gaps: pieces between them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pyrod.base.arrays import Array, number, yes_or_no
from pyrod.curve._points import positions_of


def split_at_gaps(
    positions: ArrayLike, gap: float | None = None, closed: bool = False
) -> list[tuple[Array, NDArray[np.intp]]]:
    """The pieces of a curve of which points are missing, each with the indices of its points.

    Missing are rows with NaN, and those of which a masked array hides something. Pieces of less
    than two points are left out.

    Parameters
    ----------
    positions : (m, 3) or (m, 2) array [m]
        Vertices; masked arrays are welcome.
    gap : float [m]
        Steps longer than this are gaps, too. Default: none are.
    closed : bool
        Whether the last point is followed by the first, so that the piece there goes on.

    Returns
    -------
    list
        Of ``(positions, indices)``, all of them open; one with all points if nothing is missing.
    """
    closed = yes_or_no(closed, "closed")
    limit = np.inf if gap is None else number(gap, "gap")
    if not limit > 0:
        raise ValueError(f"gap: must be positive, got {limit}")
    r = _with_nan(positions)
    there = np.isfinite(r).all(axis=1)
    following = np.roll(r, -1, axis=0)
    with np.errstate(invalid="ignore"):
        step = np.linalg.norm(following - r, axis=1) <= limit
    joined = there & np.roll(there, -1) & step
    if not closed:
        joined[-1:] = False
    index = np.arange(len(r))
    if closed and not joined.all() and joined.any():
        index = np.roll(index, -(int(np.argmin(joined)) + 1))  # begins behind a gap
    cuts = np.flatnonzero(~joined[index]) + 1
    pieces = np.split(index, cuts[cuts < len(index)])
    return [(r[piece], piece) for piece in pieces if len(piece) > 1]


def _with_nan(positions: Any) -> Array:
    if isinstance(positions, np.ma.MaskedArray):
        positions = np.ma.filled(positions.astype(np.float64), np.nan)
    return positions_of(positions)[0]
