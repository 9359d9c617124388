"""Places on rods: an end, an arc length, or one of these on a rod of several."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal, Union, get_args

import numpy as np

from pyrod.base.arrays import number_as
from pyrod.base.words import meant, shortly

End = Literal["start", "end"]
Place = Union[End, str, float, tuple[int, Union[End, str, float]]]
"""An end, an arc length [m], or a tuple (number of a rod, one of these); else it is rod 0."""


def checked(at: Place) -> Place:
    """The place as given, with numbers as floats; refuses what is none."""
    if isinstance(at, tuple):
        is_pair = len(at) == 2 and isinstance(at[0], (int, np.integer)) and at[0] >= 0
        where: Any = at[-1] if at else None
        if not is_pair or isinstance(where, tuple):
            raise ValueError(f"at: expected (number of the rod, place), got {shortly(at)}")
        return (int(at[0]), _on_one(where))
    return _on_one(at)


def _on_one(at: str | float) -> str | float:
    if isinstance(at, str):
        if at not in ("start", "end"):
            raise ValueError(
                f"at: expected 'start', 'end' or an arc length, got {shortly(at)}"
                f"{meant(at, get_args(End))}"
            )
        return at
    wanted = "expected 'start', 'end' or an arc length"
    s = number_as(at, "at", wanted)
    if not np.isfinite(s):
        raise ValueError(f"at: {wanted}, got {s}")
    return s


def on_rod(at: Place, lengths: Sequence[float]) -> tuple[int, float]:
    """The number of the rod, and the arc length on it; rods have these lengths."""
    number, place = at if isinstance(at, tuple) else (0, at)
    if number >= len(lengths):
        raise ValueError(f"at: there is no rod {number}, the scene has {len(lengths)}")
    length = lengths[number]
    if isinstance(place, str):
        return number, 0.0 if place == "start" else length
    if not -1e-12 * length <= place <= length * (1 + 1e-12):
        raise ValueError(f"at: must be an arc length on the rod, in [0, {length:g}], got {place:g}")
    return number, min(max(place, 0.0), length)
