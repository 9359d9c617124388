"""The coarsest grid of a rod whose edges the solver chooses."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from pyrod._arrays import Array, array, number
from pyrod._sampling import sampled

COARSEST = 16
"""Edges of a rod that is straight at rest."""
TURN = 0.4
"""Most turn [rad] at rest from edge to edge."""


def natural_edges(length: Any, curvature: Any) -> int:
    """As many that the rod at rest turns little from edge to edge."""
    length = number(length, "length")
    if not (np.isfinite(length) and length > 0):
        raise ValueError(f"length: must be positive, got {length!r}")
    if not callable(curvature) and array(curvature, "curvature").ndim > 1:
        raise ValueError("curvature: one per vertex needs edges; give their number, or a function")
    K = sampled(curvature, np.linspace(0, length, 257), "curvature", "vertex")
    turn = length * np.linalg.norm(K, axis=1).max()
    if not np.isfinite(turn):
        raise ValueError("curvature: expected finite numbers")
    return max(COARSEST, 2 * int(np.ceil(turn / TURN / 2)))


def merged(breaks: Sequence[float], at: Array, length: float) -> tuple[float, ...]:
    """The breaks and more, in order; within 1e-9 of the length of one, or of an end, it is that."""
    kept = [0.0, *breaks, length]
    for s in at:
        if np.abs(np.subtract(kept, s)).min() > 1e-9 * length:
            kept.append(float(s))
    return tuple(sorted(kept[1 : len(breaks) + 1] + kept[len(breaks) + 2 :]))


def graded(length: float, breaks: Sequence[float], edges: int) -> Array:
    """About as many edges, equal between the breaks and at least two there, (n,) lengths."""
    ends = np.concatenate([[0.0], breaks, [length]])
    pieces = np.diff(ends)
    counts = np.maximum(2, np.rint(edges * pieces / length)).astype(int)
    return np.repeat(pieces / counts, counts)
