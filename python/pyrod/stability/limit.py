"""What a number on ever finer grids tends to, its error, and whether to trust that."""

from __future__ import annotations

from math import log2
from typing import NamedTuple

SAFE = 1.5
"""Times what was seen: errors that do not shrink evenly may be larger than their differences."""


class Limit(NamedTuple):
    """A number on grids each twice as fine as the one before, and what they tend to."""

    value: float
    error: float
    order: float | None
    """With which it converges, if that is not 2 and nothing was extrapolated; else None."""


def limit_of(values: list[float], errors: list[float]) -> Limit:
    """Of three numbers, or four, each with an error of its own.

    Errors of the grids are of second order: two grids give the limit, and the third the error of
    that. Differences that do not shrink by about 4 come from functions that are not smooth inside
    edges; then the error is taken from the differences, too. They may do so by chance: a fourth
    grid tells.
    """
    coarse, fine, finest = values[-3:]
    before, change = fine - coarse, finest - fine
    own = max(errors)
    if max(abs(before), abs(change)) <= 4 * own:  # as exact on each
        return Limit(finest, 2 * own, None)
    extrapolated = (4 * finest - fine) / 3
    error = abs(extrapolated - (4 * fine - coarse) / 3)
    ratios = [_shrinkage(three, own) for three in zip(values, values[1:], values[2:])]  # noqa: B905
    if 3.8 < ratios[-1] < 4.3 and all(3.5 < ratio < 4.6 for ratio in ratios):
        return Limit(extrapolated, error + 2 * own, None)
    rough = SAFE * max(abs(change), abs(before) / 4)
    if min(ratios) > 2:
        return Limit(extrapolated, max(error, rough) + 2 * own, None)
    order = log2(ratios[-1]) if ratios[-1] > 0 else 0.0
    return Limit(finest, max(2 * error, rough) + 2 * own, order)


def _shrinkage(values: tuple[float, ...], own: float) -> float:
    """How much smaller the second difference is than the first; 4 if that is their rounding."""
    coarse, fine, finest = values
    return (fine - coarse) / (finest - fine) if abs(finest - fine) > own else 4.0
