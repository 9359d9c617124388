"""What drives rods from inside: tendons."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import isfinite
from typing import TYPE_CHECKING, Any, Union

import numpy as np
from numpy.typing import ArrayLike

import pyrod._core as _core
from pyrod.base.arrays import array, number, whole
from pyrod.base.immutable import Array, frozen
from pyrod.base.words import shortly
from pyrod.rod.rod import Rod
from pyrod.scene.part import Part

Offset = Union[Array, Callable[[float], ArrayLike]]


class Actuator(Part):
    """Base of what drives rods."""


@dataclass(frozen=True, eq=False)
class Tendon(Actuator):
    """A string along a rod, of given tension or of given length.

    It runs at an offset in the sections of the rod, without friction. Its end is anchored; at its
    start it is pulled with a tension, or held so that it has a length. The rod must keep its length
    (the inextensible model).

    Parameters
    ----------
    offset : (2,) or (n + 1, 2) array [m], or function
        From the axis of the rod along its directors a1 and a2: one for all, one per vertex of the
        rod, straight between these in the rod's own frames, or a function of arc length, which is
        asked once for each.
    tension : float [N]
        Positive.
    length : float [m]
        In its place: what it is long without tension. Then the tension is found; a tendon that
        would have to push is slack, and bears nothing.
    EA : float [N]
        With a length: its stiffness, by which it stretches; default: it does not.
    start, end : float [m]
        Arc lengths; default: the ends of the rod.
    rod : int
        Number of the rod it runs along.
    """

    offset: Offset
    tension: float | None = None
    length: float | None = None
    EA: float | None = None
    start: float | None = None
    end: float | None = None
    rod: int = 0
    _kind = _core.Tendon

    if TYPE_CHECKING:  # what is taken is more than what is kept

        def __init__(
            self,
            offset: ArrayLike | Callable[[float], ArrayLike],
            tension: float | None = None,
            length: float | None = None,
            EA: float | None = None,
            start: float | None = None,
            end: float | None = None,
            rod: int = 0,
        ) -> None: ...

    def __post_init__(self) -> None:
        if (self.tension is None) == (self.length is None):
            raise ValueError("tension: give a tendon its tension or its length")
        for name in ("tension", "length", "EA"):
            if getattr(self, name) is not None:
                self.__dict__[name] = _positive(getattr(self, name), name)
        if self.EA is not None and self.length is None:
            raise ValueError("EA: goes with the length of a tendon, not with its tension")
        self._set(rod=whole(self.rod, "rod"))
        for name in ("start", "end"):
            place = getattr(self, name)
            if place is not None:
                self.__dict__[name] = _arc_length(place, name)
        if not callable(self.offset):
            self._set(offset=_pairs(frozen(self.offset, "offset")))
        elif not isinstance(self.offset, _Once):
            self._set(offset=_Once(self.offset))

    @property
    def given(self) -> str:
        """The tension, or the length, in words."""
        if self.tension is not None:
            return f"{self.tension:.6g} N"
        return f"{self.length:.6g} m long"

    def offsets(self, s: Array) -> Array:
        """(len(s), 2) at these arc lengths; of one per vertex, at as many vertices."""
        if callable(self.offset):
            return np.array([self.offset(at) for at in s.tolist()])
        return np.array(np.broadcast_to(self.offset, (len(s), 2)))

    def on(self, given: tuple[Rod, ...], now: tuple[Rod, ...]) -> Tendon:
        """The same where rods have more vertices."""
        if callable(self.offset) or self.offset.ndim == 1 or self.rod >= len(given):
            return self
        before, behind = given[self.rod], now[self.rod]
        if behind is before or len(self.offset) != before.edges + 1:
            return self
        columns = [
            np.interp(behind.arc_lengths, before.arc_lengths, values) for values in self.offset.T
        ]
        return replace(self, offset=np.stack(columns, axis=1))

    def refuse_shape(self, rods: tuple[Rod, ...]) -> None:
        """Refuses rows that are not one per vertex of the rod."""
        if callable(self.offset) or self.offset.ndim == 1 or self.rod >= len(rods):
            return
        count = rods[self.rod].edges + 1
        if len(self.offset) != count:
            raise ValueError(
                f"offset: expected 2 numbers, or {count} times 2 (one per vertex), "
                f"got shape {self.offset.shape}"
            )


def sampled_tendon(tendon: Tendon, rods: tuple[Rod, ...]) -> Tendon:
    """The same with a function replaced by a table of it, exact where the rod's grid asks it."""
    if not isinstance(tendon.offset, _Once) or isinstance(tendon.offset.function, _Table):
        return tendon
    s = rods[tendon.rod].arc_lengths
    quarters = s[:-1, None] + np.diff(s)[:, None] * np.arange(4) / 4
    centres = quarters[:, 2]
    middles = (centres[1:] + centres[:-1]) / 2  # of cells: on even edges these are vertices
    uneven = middles[np.abs(middles - s[1:-1]) > 1e-9 * s[-1]]
    places = np.sort(np.concatenate([quarters.ravel(), s[-1:], uneven]))
    return replace(tendon, offset=_Table(places, tendon.offsets(places)))


def polygonal_tendon(tendon: Tendon, rods: tuple[Rod, ...]) -> Tendon:
    """The same with a function replaced by its values at the vertices, straight between these."""
    if not callable(tendon.offset):
        return tendon
    return replace(tendon, offset=tendon.offsets(rods[tendon.rod].arc_lengths))


class _Once:
    """A function of arc length that is asked once for each, whatever else of a tendon changes."""

    def __init__(self, function: Callable[[float], ArrayLike]) -> None:
        self.function = function
        self._known: dict[float, Array] = {}

    def __call__(self, s: float) -> Array:
        known = self._known.get(s)
        if known is None:
            known = self._known[s] = _pair(self.function(s))
        return known

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Once) and self.function == other.function

    def __hash__(self) -> int:
        return hash(self.function)

    def __reduce__(self) -> tuple[type, tuple[Any]]:
        return _Once, (self.function,)

    def __repr__(self) -> str:
        return repr(self.function)


@dataclass(frozen=True, eq=False)
class _Table:
    places: Array
    values: Array

    def __call__(self, s: float) -> Array:
        """Quartic through the five nearest places."""
        count = min(5, len(self.places))
        behind = int(np.searchsorted(self.places, s))
        first = min(max(behind - count // 2, 0), len(self.places) - count)
        at, values = (x[first : first + count] for x in (self.places, self.values))
        off = s - at
        if not off.all():
            return values[int(np.argmin(np.abs(off)))]
        weights = [
            np.prod(np.delete(off, i)) / np.prod(np.delete(at[i] - at, i)) for i in range(count)
        ]
        return np.array(weights) @ values


def _positive(value: Any, name: str) -> float:
    made = number(value, name)
    if not (isfinite(made) and made > 0):
        raise ValueError(f"{name}: must be positive and finite, got {made:g}")
    return made


def _arc_length(value: Any, name: str) -> float:
    if isinstance(value, str):
        raise ValueError(f"{name}: expected an arc length, or None, got {shortly(value)}")
    s = number(value, name)
    if not isfinite(s):
        raise ValueError(f"{name}: must be a finite arc length, got {s}")
    return s


def _pair(values: ArrayLike) -> Array:
    made = array(values, "offset")
    if made.shape != (2,):
        raise ValueError(f"offset: expected 2 numbers, got shape {made.shape}")
    return made


def _pairs(made: Array) -> Array:
    if made.shape != (2,) and not (made.ndim == 2 and made.shape[1] == 2):
        raise ValueError(
            f"offset: expected 2 numbers, or one row of 2 per vertex, got shape {made.shape}"
        )
    if not np.isfinite(made).all():
        raise ValueError(f"offset: expected finite numbers, got {shortly(made.tolist())}")
    return made
