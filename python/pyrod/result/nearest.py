"""Values between those that are known, from the nearest of them; and the way of a screw."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pyrod.base.immutable import Array

Numbers = NDArray[np.int64]


class Near(NamedTuple):
    """Places whose values are taken from as many rows."""

    some: Numbers  #: which places, (j,)
    rows: Numbers  #: (j, count)
    ends: NDArray[np.bool_]  #: (j, count) where a row is the last before a jump
    weights: Array  #: (j, count), Lagrange's


def rows_near(
    x: Array, s: Array, edge: Numbers, first: Numbers, last: Numbers, points: int
) -> list[Near]:
    """For each place the nearest rows of those from first to last, whose values are at x."""
    found = []
    counts = np.minimum(last - first + 1, points)
    for count in np.unique(counts):
        some = np.flatnonzero(counts == count)
        begin = np.clip(edge[some] - (count - 2) // 2, first[some], last[some] - count + 1)
        rows = begin[:, None] + np.arange(count)
        found.append(Near(some, rows, rows == last[some, None], _weights(x[rows], s[some])))
    return found


def taken(near: list[Near], now: Array, before: Array) -> Array:
    """(k, 3) on the polynomials; ``before`` holds values just before where something jumps."""
    out = np.empty((sum(len(one.some) for one in near), now.shape[1]))
    for some, rows, ends, weights in near:
        values = now[rows]
        if before is not now:
            values[ends] = before[rows[ends]]
        out[some] = (weights[:, None, :] @ values)[:, 0]
    return out


def _weights(x: Array, s: Array) -> Array:
    """(k, count) of the values at x in those at s: Lagrange's, in their barycentric form."""
    apart = x[:, :, None] - x[:, None, :]
    apart[:, np.arange(x.shape[1]), np.arange(x.shape[1])] = 1.0
    off = s[:, None] - x
    met = off == 0
    weights = 1 / (apart.prod(axis=2) * np.where(met, 1.0, off))
    weights /= weights.sum(axis=1, keepdims=True)
    hit = met.any(axis=1)
    weights[hit] = met[hit]
    return weights


def screwed(turn: Array, along: Array) -> Array:
    """(k, 3) where a screw leads that turns by ``turn`` while it moves by ``along``."""
    angle = np.linalg.norm(turn, axis=1)[:, None]
    small = angle < 1e-3
    safe = np.where(small, 1.0, angle)
    a = np.where(small, 0.5 - angle**2 / 24, (1 - np.cos(safe)) / safe**2)
    b = np.where(small, 1 / 6 - angle**2 / 120, (safe - np.sin(safe)) / safe**3)
    across = np.cross(turn, along)
    return along + a * across + b * np.cross(turn, across)
