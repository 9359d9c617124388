"""Lengths of edges, and values along a curve: one for all, one per place, or a function."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pyrod._arrays import Array, array, number, transposed

MOST_EDGES = 10**8  # their unknowns are counted in 32 bits


def edge_lengths(length: float | ArrayLike, edges: int | None) -> Array:
    lengths = array(length, "length")
    if edges is None:
        return np.atleast_1d(lengths)
    n = number(edges, "edges")
    if not (np.isfinite(n) and n == int(n) and 1 <= n <= MOST_EDGES):
        raise ValueError(
            f"edges: must be a whole number, at least 1 and at most {MOST_EDGES:g}, got {edges}"
        )
    if lengths.size != 1:
        raise ValueError("edges: give None together with the lengths of the edges")
    whole = lengths.item()
    if not (np.isfinite(whole) and whole > 0):
        raise ValueError(f"length: must be positive, got {whole!r}")
    return np.full(int(n), whole / int(n))


def sampled(values: Any, at: Array, name: str, place: str) -> Array:
    """(len(at), 3) from one vector, one per place, or a function of arc length."""
    if callable(values):
        values = [array(values(s), name) for s in at]
    made = array(values, name)
    if made.shape not in ((3,), (len(at), 3)):
        raise ValueError(
            f"{name}: expected 3 numbers, or {len(at)} times 3 (one per {place}), "
            f"got shape {made.shape}{transposed(made, 3)}"
        )
    return np.array(np.broadcast_to(made, (len(at), 3)))


def cut(h: Array, at: Array) -> Array | None:
    """Lengths of the edges ``h`` with more vertices at arc lengths, or None if all are there.

    Within 1e-9 of an edge's length of a vertex there is one.
    """
    s = np.concatenate([[0.0], np.cumsum(h)])
    edge = np.clip(np.searchsorted(s, at, "right") - 1, 0, len(h) - 1)
    part = (at - s[edge]) / h[edge]
    new = (part > 1e-9) & (part < 1 - 1e-9)
    near = np.diff(at, prepend=-np.inf) <= 1e-9 * h[edge]  # two places that differ by rounding
    new &= ~near
    return np.diff(np.sort(np.concatenate([s, at[new]]))) if new.any() else None
