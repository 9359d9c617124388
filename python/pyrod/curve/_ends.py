"""What values are told at the ends of an open arc that no tangent holds."""

from __future__ import annotations

from typing import Literal

import numpy as np

from pyrod.base.arrays import Array
from pyrod.base.words import shortly
from pyrod.curve._arc import Arc

Ends = Literal["free", "continued"]
"""What a free end of an open arc has: no turn, or the values of its neighbours."""


Spacing = Literal["even", "uneven"]
"""What an angle about an edge is divided by: the edge, or the way between its binormals."""


def torsion_lengths(arc: Arc, spacing: Spacing) -> Array:
    """(n,) the lengths of the edges; of uneven ones, those between the places of two binormals.

    A binormal belongs to the mean of the three vertices that tell it, or of those there are.
    """
    h = arc.edge_lengths
    if spacing == "even":
        return h
    if spacing != "uneven":
        raise ValueError(f"spacing: expected 'even' or 'uneven', got {shortly(spacing)}")
    if arc.closed:
        return (np.roll(h, 1) + h + np.roll(h, -1)) / 3
    return (np.append(0.0, h[:-1]) + h + np.append(h[1:], 0.0)) / 3


def with_ends(arc: Arc, values: Array, ends: Ends) -> Array:
    """Values at the vertices or of the edges; "continued" replaces those at free ends.

    They stay as they are where there is none to continue.
    """
    if ends not in ("free", "continued"):
        raise ValueError(f"ends: expected 'free' or 'continued', got {shortly(ends)}")
    start, end = arc.start_tangent is None, arc.end_tangent is None
    if ends == "free" or arc.closed or len(values) <= start + end:
        return values
    values = values.copy()
    if start:
        values[0] = values[1]
    if end:
        values[-1] = values[-2]
    return values


def is_torsion(arc: Arc, values: Array) -> bool:
    """Whether values are the torsion of the arc, which is 0 on the edges to free ends."""
    if arc.closed or values.ndim != 1:
        return False
    return any(
        np.array_equal(values, arc.torsion(measure, spacing=spacing))
        for measure in ("log", "chord", "cayley", "sauer")
        for spacing in ("even", "uneven")
    )
