"""Where functions of arc length jump or have kinks, found from samples.

Fourth differences of samples a distance d apart fall with d^4 where a function is smooth, with d
at a kink, and not at all at a jump. Where they stand out they are followed to finer samples, until
their order tells what is there (docs/accuracy.md, "Where something jumps").
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from pyrod._immutable import Array

SAMPLES = 256
"""Intervals in which a function is looked at; four times as many where much stands out."""
DENSE = 24
"""Places that stand out, from which on there are more samples."""
MOST = 128
"""Jumps and kinks of one function that are told apart."""
SMALLEST = 1e-7
"""Fourth differences that stand out, relative to the largest value."""
ROUNDING = 3e-12
"""Fourth differences that may be rounding."""
APART = 1e-6
"""Of the length: places that are nearer are one."""
STRIP = 16
"""Intervals in which the neighbourhood of a place is looked at again."""

Function = Callable[[float], Any]


class Breaks(NamedTuple):
    """Arc lengths of jumps and kinks, and whether there are more than could be told apart."""

    at: tuple[float, ...] = ()
    unresolved: bool = False


def breaks_of(function: Function, length: float) -> Breaks:
    """The jumps, kinks and jumps of the second derivative inside [0, length]."""
    value = _scaled(function, length)
    if value is None:
        return Breaks()
    for intervals, most in ((SAMPLES, DENSE), (4 * SAMPLES, 4 * SAMPLES)):
        search = _Search(value, length)
        if search.look(0.0, length, intervals, most):
            break
    many = len(search.found) > MOST
    return Breaks(() if many else tuple(sorted(search.found)), many or search.unresolved)


def _scaled(function: Function, length: float) -> Callable[[float], Array] | None:
    """The function relative to its largest values, for each component; None: nothing to look at."""
    some = np.array([np.ravel(function(float(s))) for s in np.linspace(0, length, 17)], np.float64)
    size = np.abs(some).max(axis=0)
    if not np.isfinite(size).all():
        return None
    size[size == 0] = size.max() or 1.0
    return lambda s: np.ravel(np.asarray(function(float(s)), dtype=np.float64)) / size


_FOURTH = np.array([np.convolve(row, [1, -4, 6, -4, 1]) for row in np.eye(5)])
"""Fourth differences of nine samples."""


def _sizes(values: Array) -> Array:
    """The largest component of fourth differences, of each five neighbours."""
    return np.abs(np.diff(values, 4, axis=0)).max(axis=1)


class _Search:
    def __init__(self, value: Callable[[float], Array], length: float) -> None:
        self._value, self._length = value, length
        self._around: dict[float, float] = {}  # how far beside each place others were looked for
        self.unresolved = False

    @property
    def found(self) -> list[float]:
        return list(self._around)

    def look(self, a: float, b: float, intervals: int, most: int, depth: int = 0) -> bool:
        """Finds what is between a and b; False if more stands out than is worth following."""
        s = np.linspace(a, b, intervals + 1)
        sizes = _sizes(np.array([self._value(x) for x in s]))
        padded = np.concatenate([[0.0], sizes, [0.0]])
        peaks = (sizes > SMALLEST) & (sizes >= padded[:-2]) & (sizes >= padded[2:])
        if peaks.sum() > most:
            return False
        d = (b - a) / intervals
        for i in np.flatnonzero(peaks):
            if len(self._around) > MOST:
                break
            if (place := self._followed(float(s[i]), d)) is not None:
                self._keep(*place, d, depth)
        return True

    def _keep(self, x: float, width: float, d: float, depth: int) -> None:
        """Takes a place, and looks for others that it hides."""
        margin = APART * self._length + 2 * width
        if not margin < x < self._length - margin:
            return
        x = next((known for known in self._around if abs(x - known) < margin), float(x))
        if self._around.get(x, 0.0) >= d:
            return
        self._around[x] = d
        if depth == 2:
            return
        for a, b in ((x - 4 * d, x - margin), (x + margin, x + 4 * d)):
            a, b = max(a, 0.0), min(b, self._length)
            if b - a > 8 * margin:
                self.look(a, b, STRIP, STRIP, depth + 1)

    def _followed(self, s: float, d: float) -> tuple[float, float] | None:
        """What is between s and s + 4 d, and how exactly it is known; None: it is smooth."""
        values = np.array([self._value(s + i * d) for i in range(5)])
        sizes: list[float] = []
        while len(sizes) < 24:
            d /= 2
            finer = np.empty((9, values.shape[1]))
            finer[::2] = values
            finer[1::2] = [self._value(s + i * d) for i in (1, 3, 5, 7)]
            found = np.abs(_FOURTH @ finer).max(axis=1)
            k = int(found.argmax())
            s, values = s + k * d, finer[k : k + 5]
            sizes.append(float(found[k]))
            if sizes[-1] < ROUNDING or (order := _order(sizes)) > 2.6:
                return None
            if len(sizes) >= 6 and (place := self._told(order, sizes, s, d, values)) is not None:
                return place
        self.unresolved = True  # singular: it tends to no order
        return None

    def _told(
        self, order: float, sizes: list[float], s: float, d: float, values: Array
    ) -> tuple[float, float] | None:
        """The place of a jump, a kink or a jump of the second derivative, if it is clear by now."""
        if order < 0.3 and len(sizes) % 6 == 0:
            return self._jump(s, s + 4 * d, sizes[-1])
        if sizes[-1] < 100 * ROUNDING or (order > 1.6 and len(sizes) >= 12):
            return s + 2 * d, 2 * d
        if 0.8 < order < 1.3 and len(sizes) >= 10:
            return _meeting(s, d, values)
        return None

    def _jump(self, low: float, high: float, size: float) -> tuple[float, float] | None:
        """Halved until its ends are neighbours; None if it is none after all."""
        first, last = self._value(low), self._value(high)
        while high - low > 1e-15 * self._length:
            middle = (low + high) / 2
            at = self._value(middle)
            if np.abs(at - first).max() > np.abs(last - at).max():
                high, last = middle, at
            else:
                low, first = middle, at
        change = float(np.abs(last - first).max())
        return (high, 0.0) if change > size / 4 else None


def _order(sizes: list[float]) -> float:
    """The power of the distance with which the last sizes fall; 0: too few to say."""
    return float(np.log2(sizes[-4] / sizes[-1]) / 3) if len(sizes) >= 6 else 0.0


def _meeting(s: float, d: float, values: Array) -> tuple[float, float]:
    """Where the lines before and behind the kink between s and s + 4 d meet.

    The interval beside the kink that changes most in slope holds it.
    """
    slopes = np.diff(values, axis=0) / d
    component = int(np.argmax(np.abs(slopes[-1] - slopes[0])))
    first, last = slopes[0, component], slopes[-1, component]
    low, high = values[0, component], values[-1, component]
    if first == last:
        return s + 2 * d, 2 * d
    x = (high - low - last * 4 * d) / (first - last)
    return s + min(max(x, 0.0), 4 * d), 1e-3 * d


def functions_of(rod: Any, loads: Any, number: int) -> Iterator[tuple[str, Any, Function]]:
    """What depends on arc length along a rod: in words, what owns the function, and the function.

    ``number`` is that of the rod; loads of other rods are left out.
    """
    for i, load in enumerate(loads):
        along = getattr(load, "force_per_length", getattr(load, "moment_per_length", None))
        if callable(along) and load.rod == number:
            yield f"load {i}", load, along
    law = rod._law
    if callable(section := getattr(law, "section", None)):
        yield f"the section of rod {number}", law, lambda s: _numbers(section(s))
    if callable(curvature := getattr(law, "curvature", None)):
        yield f"the curvature of rod {number}", law, curvature


def _numbers(section: Any) -> Array:
    """What a solve takes of a section; rigid strains are zero compliances."""
    return np.concatenate([section.bending, 1 / section.stretching, [section.mass_per_length]])
