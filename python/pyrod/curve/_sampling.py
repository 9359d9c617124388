"""Lengths of edges, and values along a curve: one for all, one per place, or a function."""

from __future__ import annotations

from math import isfinite
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import pyrod._core as _core
from pyrod.base.arrays import Array, array, number, transposed
from pyrod.base.immutable import frozen

MOST_EDGES = 10**8  # their unknowns are counted in 32 bits


def edge_lengths(length: float | ArrayLike, edges: float | None) -> Array:
    """Lengths of so many equal edges, or as given; read-only."""
    if edges is None:
        return frozen(np.atleast_1d(array(length, "length")))
    n = number(edges, "edges")
    if not (isfinite(n) and n == int(n) and 1 <= n <= MOST_EDGES):
        raise ValueError(
            f"edges: must be a whole number, at least 1 and at most {MOST_EDGES:g}, got {edges}"
        )
    if type(length) is not float and array(length, "length").size != 1:
        raise ValueError("edges: give None together with the lengths of the edges")
    total = length if type(length) is float else array(length, "length").item()
    if not (isfinite(total) and total > 0):
        raise ValueError(f"length: must be positive, got {total!r}")
    out = np.empty(int(n))
    out.fill(total / int(n))
    out.setflags(write=False)
    return out


def natural_edges(length: Any, curvature: Any) -> float:
    """As many that the rod at rest turns little from edge to edge."""
    length = number(length, "length")
    if not callable(curvature) and array(curvature, "curvature").ndim > 1:
        raise ValueError("curvature: one per vertex needs edges; give their number, or a function")
    return _core.natural_edges(length, along(curvature, 1, "curvature", "vertex"))


def along(values: Any, count: int, name: str, place: str) -> Any:
    """(3,) for all, (count, 3) one per place, or a function of arc length of three numbers."""
    if callable(values):
        return lambda s: _shaped(array(values(s), name), name)
    return _shaped(array(values, name), name, count, place)


def _shaped(made: Array, name: str, count: int | None = None, place: str = "") -> Array:
    if made.shape == (3,) or (count is not None and made.shape == (count, 3)):
        return made
    many = "" if count is None else f", or {count} times 3 (one per {place})"
    raise ValueError(
        f"{name}: expected 3 numbers{many}, got shape {made.shape}{transposed(made, 3)}"
    )


def sampled(values: Any, at: Array, name: str, place: str) -> Array:
    """(len(at), 3) from one vector, one per place, or a function of arc length."""
    told = along(values, len(at), name, place)
    made = [told(s) for s in at] if callable(told) else told
    return np.array(np.broadcast_to(made, (len(at), 3)))
