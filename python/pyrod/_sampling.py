"""Lengths of edges, and values along a curve: one for all, one per place, or a function."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pyrod._immutable import Array

MOST_EDGES = 10**8  # their unknowns are counted in 32 bits


def edge_lengths(length: float | ArrayLike, edges: int | None) -> Array:
    if edges is None:
        return np.atleast_1d(np.asarray(length, dtype=np.float64))
    if not (np.isfinite(edges) and edges == int(edges) and 1 <= edges <= MOST_EDGES):
        raise ValueError(
            f"edges: must be a whole number, at least 1 and at most {MOST_EDGES:g}, got {edges}"
        )
    if np.ndim(length) != 0:
        raise ValueError("edges: give None together with the lengths of the edges")
    if not (np.isfinite(length) and length > 0):  # type: ignore[operator]
        raise ValueError(f"length: must be positive, got {length!r}")
    return np.full(int(edges), length / int(edges))  # type: ignore[operator]


def sampled(values: Any, at: Array, name: str, place: str) -> Array:
    """(len(at), 3) from one vector, one per place, or a function of arc length."""
    if callable(values):
        values = [np.asarray(values(s), dtype=np.float64) for s in at]
    array = np.asarray(values, dtype=np.float64)
    if array.shape not in ((3,), (len(at), 3)):
        raise ValueError(
            f"{name}: expected 3 numbers, or {len(at)} times 3 (one per {place}), "
            f"got shape {array.shape}"
        )
    return np.array(np.broadcast_to(array, (len(at), 3)))


def cut(h: Array, at: Array) -> Array | None:
    """Lengths of the edges ``h`` with more vertices at arc lengths, or None if all are there.

    Within 1e-9 of an edge's length of a vertex there is one.
    """
    s = np.concatenate([[0.0], np.cumsum(h)])
    edge = np.clip(np.searchsorted(s, at, "right") - 1, 0, len(h) - 1)
    part = (at - s[edge]) / h[edge]
    new = (part > 1e-9) & (part < 1 - 1e-9)
    return np.diff(np.sort(np.concatenate([s, at[new]]))) if new.any() else None
