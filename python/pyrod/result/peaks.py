"""The largest values along rods, between their vertices too, and where they are."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from pyrod.base.calls import spelled
from pyrod.base.immutable import Array, vector
from pyrod.base.words import meant
from pyrod.result.between import Between, Station
from pyrod.result.rods import RodEquilibrium
from pyrod.result.stresses import equivalent_stress, normal_stress, torsional_stress
from pyrod.result.told import Largest

SAMPLES = 6
"""Of each edge, among which peaks are looked for."""
CANDIDATES = 6
ROUNDS = 12
ROUNDING = 1e-12


class Quantity(NamedTuple):
    """What can be largest: never negative."""

    unit: str
    of: Callable[[RodEquilibrium, Station], Array]
    judged_by: str
    """What its error is told by in ``Accuracy.errors``."""


def _norms(rows: Array) -> Array:
    return np.linalg.norm(rows, axis=1)


def _bent(state: Station) -> Array:
    return _norms(state.material_moment[:, :2])


def _axial(state: Station) -> Array:
    return state.material_force[:, 2]


QUANTITIES = {
    "curvature": Quantity("1/m", lambda rod, at: _norms(at.K), "curvatures"),
    "bending": Quantity("1/m", lambda rod, at: _norms(at.K[:, :2]), "curvatures"),
    "twist": Quantity("1/m", lambda rod, at: np.abs(at.K[:, 2]), "curvatures"),
    "force": Quantity("N", lambda rod, at: _norms(at.force), "forces"),
    "tension": Quantity("N", lambda rod, at: np.maximum(_axial(at), 0), "forces"),
    "compression": Quantity("N", lambda rod, at: np.maximum(-_axial(at), 0), "forces"),
    "shear force": Quantity("N", lambda rod, at: _norms(at.material_force[:, :2]), "forces"),
    "moment": Quantity("N m", lambda rod, at: _norms(at.moment), "moments"),
    "bending moment": Quantity("N m", lambda rod, at: _bent(at), "moments"),
    "torque": Quantity("N m", lambda rod, at: np.abs(at.material_moment[:, 2]), "moments"),
    "strain": Quantity("", lambda rod, at: _norms(at.Gamma - [0, 0, 1]), "strains"),
    "stress": Quantity("Pa", normal_stress, "stress"),
    "torsional stress": Quantity("Pa", torsional_stress, "stress"),
    "equivalent stress": Quantity("Pa", equivalent_stress, "stress"),
}
_KNOWN = {"curvature": "largest_K", "force": "largest_force", "moment": "largest_moment"}
"""What a solve tells of the continuous rod."""


@spelled
def largest_of_rod(rod: RodEquilibrium, quantity: str) -> Largest:
    """The largest value of a quantity along a rod, between vertices too, and where it is.

    Parameters
    ----------
    rod : `RodEquilibrium`
        The rod.
    quantity : str
        "curvature" (with twist), "bending", "twist"; "force", "tension", "compression", "shear
        force"; "moment", "bending moment", "torque"; "strain" (the length of Gamma - e3); of
        sections with an outline "stress" (normal to the section, of either sign), of circles, tubes
        and rectangles "torsional stress", of circles and tubes "equivalent stress" (of normal and
        torsional stress, after von Mises).

    Returns
    -------
    Largest
        Without an error, which ``Equilibrium.largest`` tells, with ``rod=`` of one rod.

    Raises
    ------
    ValueError
        There is no such quantity, or the section has no outline, or one that does not tell it.
    """
    return largest_along(rod, quantity)


def largest_along(
    rod: RodEquilibrium, quantity: str, number: int = 0, scales: Mapping[str, float] | None = None
) -> Largest:
    """The same of a rod of this number; ``scales``: to what errors are relative, if it is known."""
    if quantity not in QUANTITIES:
        guess = meant(str(quantity), QUANTITIES) or f"; there are {', '.join(QUANTITIES)}"
        raise ValueError(f"quantity: there is no {quantity!r}{guess}")
    unit, of, judged_by = QUANTITIES[quantity]
    value, s, off = _peak(rod, lambda state: of(rod, state))
    known = _KNOWN.get("curvature" if quantity == "bending" and _untwisted(rod) else quantity)
    value = value if known is None else float(getattr(rod, known))
    error = None
    if rod.accuracy is not None and scales is not None:
        told = rod.accuracy.errors
        if known is not None:
            error = told["extremes"] * scales[judged_by]
        elif judged_by == "stress":
            error = off + _stress_of_errors(rod, of, s, told, scales)
        else:
            error = off + told[judged_by] * scales[judged_by]
    return Largest(quantity, value, unit, s, number, error)


def _untwisted(rod: RodEquilibrium) -> bool:
    return float(np.abs(rod.K[:, 2]).max()) <= ROUNDING * rod.largest_K


def _stress_of_errors(
    rod: RodEquilibrium,
    of: Callable[[RodEquilibrium, Station], Array],
    s: float,
    told: Mapping[str, float],
    scales: Mapping[str, float],
) -> float:
    """Stresses are homogeneous and convex: no error makes more than those of its parts."""
    state = Between(rod).at(np.array([s]))
    force = told["forces"] * scales["forces"]
    state.__dict__["material_backbone_force"] = np.full((1, 3), force)
    state.__dict__["material_moment"] = np.full((1, 3), told["moments"] * scales["moments"])
    return float(of(rod, state)[0])


@spelled
def sag_of_rod(rod: RodEquilibrium, direction: ArrayLike | None = None) -> Largest:
    """How far a rod hangs off the chord between its ends, and where.

    Parameters
    ----------
    rod : `RodEquilibrium`
        The rod.
    direction : (3,) array
        Along which it is measured; default: across the chord, whichever way the rod goes.

    Returns
    -------
    Largest

    Raises
    ------
    ValueError
        The ends of the rod are in one place, or the direction is along the chord.
    """
    return sag_along(rod, direction)


def sag_along(
    rod: RodEquilibrium,
    direction: ArrayLike | None,
    number: int = 0,
    longest: float | None = None,
) -> Largest:
    """The same of a rod of this number; ``longest``: to what errors are relative, if known."""
    start, end = rod.positions[[0, -1]]
    chord = end - start
    length = float(np.linalg.norm(chord))
    if not length > 1e-9 * rod.rod.length:
        raise ValueError("sag: the ends of the rod are in one place, so that there is no chord")
    if direction is None:
        along = chord / length
        off = lambda r: r - np.outer(r @ along, along)  # noqa: E731
        heights: Callable[[Array], Array] = lambda r: _norms(off(r))  # noqa: E731
    else:
        down = vector(direction, "direction")
        down = down / (np.linalg.norm(down) or 1.0)
        across = chord - (chord @ down) * down
        if not (down.any() and np.linalg.norm(across) > 1e-9 * length):
            raise ValueError("direction: must not be zero, or along the chord between the ends")
        fall = float(chord @ down)
        heights = lambda r: r @ down - fall * (r @ across) / (across @ across)  # noqa: E731
    value, s, missed = _peak(rod, lambda state: heights(state.positions - start))
    error = None
    if rod.accuracy is not None and longest is not None:
        error = missed + longest * rod.accuracy.errors["positions"]
    return Largest("sag", value, "m", s, number, error)


def _peak(rod: RodEquilibrium, of: Callable[[Station], Array]) -> tuple[float, float, float]:
    """The largest value, where it is, and what it differs by if taken from fewer vertices."""
    fine = Between(rod)
    parts = np.linspace(0, 1, SAMPLES + 1)
    s = np.unique(rod.s[:-1, None] + np.diff(rod.s)[:, None] * parts)
    found: list[tuple[float, float, bool]] = []
    for before in (False, True):
        places = rod.s[fine.breaks] if before else s
        values = of(fine.at(places, before))
        for i in _peaks_of(values)[:CANDIDATES]:
            value, at = float(values[i]), float(places[i])
            if not before:
                value, at = _climbed(fine, of, places, int(i), value)
            found.append((value, at, before))
    most = max(value for value, _, _ in found)
    value, at, before = min(
        (one for one in found if one[0] >= most - ROUNDING * abs(most)), key=lambda one: one[1]
    )
    other = float(of(fine.of_fewer().at(np.array([at]), before))[0])
    return value, at, abs(value - other)


def _peaks_of(values: Array) -> Any:
    """Numbers of the local maxima, the highest first."""
    padded = np.concatenate([[-np.inf], values, [-np.inf]])
    tops = np.flatnonzero((values >= padded[:-2]) & (values >= padded[2:]))
    return tops[np.argsort(-values[tops], kind="stable")]


def _climbed(
    fine: Between, of: Callable[[Station], Array], places: Array, i: int, value: float
) -> tuple[float, float]:
    """Up from a sample to the peak between its neighbours, on edges on which nothing jumps."""
    at = float(places[i])
    low, high = places[max(i - 1, 0)], places[min(i + 1, len(places) - 1)]
    for _ in range(ROUNDS):
        tried = np.linspace(low, high, 9)
        found = of(fine.at(tried))
        k = int(np.argmax(found))
        if found[k] > value + ROUNDING * abs(value):
            value, at = float(found[k]), float(tried[k])
        low, high = tried[max(k - 1, 0)], tried[min(k + 1, 8)]
    return value, at
