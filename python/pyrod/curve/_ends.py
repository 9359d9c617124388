"""What values are told at the ends of an open arc that no tangent holds."""

from __future__ import annotations

from typing import Literal

import numpy as np

from pyrod.base.arrays import Array
from pyrod.base.words import shortly
from pyrod.curve._arc import Arc

Ends = Literal["free", "continued"]
"""What a free end of an open arc has: no turn, or the values of its neighbours."""


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
        np.array_equal(values, arc.torsion(measure))
        for measure in ("log", "chord", "cayley", "sauer")
    )
