"""The outlines of the sections along a rod."""

from __future__ import annotations

from math import sqrt

import numpy as np

from pyrod.rod.law import within
from pyrod.rod.outline import Outline
from pyrod.rod.place import End, checked, on_rod
from pyrod.rod.rod import Rod

SIZE = 0.02  # of made-up outlines, over the length of the rod
THINNEST = 1 / 20  # height over width or the other way round, so that they can be seen


def outlines(rod: Rod) -> tuple[tuple[Outline, Outline], ...]:
    """Outlines at the start and at the end of each edge; made up where the section has none."""
    told = rod._law.outlines(rod.edge_lengths)
    if all(a is not None and b is not None for a, b in told):
        return told  # type: ignore[return-value]
    made = [_made_up(EI1, EI2, rod.length) for EI1, EI2, _ in rod.bending]
    return tuple((a or made[j], b or made[j + 1]) for j, (a, b) in enumerate(told))


def outline_at(rod: Rod, at: End | float) -> Outline:
    """The outline of the cross-section at a place.

    Between vertices it is linear; where sections jump it is that just behind.

    A section that was given by its stiffnesses has none (``Section.outline``). Then one is made
    up: the rectangle, a fiftieth of the rod's length in size, whose proportions have the ratio
    EI1/EI2; its thinner side is drawn no thinner than a twentieth of the other.

    Parameters
    ----------
    rod : `Rod`
        The rod.
    at : "start", "end" or float [m]
        A place, by its arc length.

    Raises
    ------
    ValueError
        The place is not on the rod.
    """
    s = on_rod(checked(at), [rod.length])[1]
    edge = int(np.clip(np.searchsorted(rod.arc_lengths, s, "right") - 1, 0, rod.edges - 1))
    part = (s - rod.arc_lengths[edge]) / rod.edge_lengths[edge]
    return within(outlines(rod)[edge], part)  # type: ignore[return-value]


def _made_up(EI1: float, EI2: float, length: float) -> Outline:
    """The rectangle with this ratio of stiffnesses: EI1/EI2 = (height/width)^2."""
    ratio = max(THINNEST, min(sqrt(EI1 / EI2), 1 / THINNEST))
    size = SIZE * length
    return Outline.rectangle(size / max(ratio, 1.0), size * min(ratio, 1.0))
