"""Vibration about an equilibrium."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from pyrod.base.immutable import Array
from pyrod.linear.grid import Grid
from pyrod.linear.inertia import Inertia, Rotary
from pyrod.linear.motions import AnyArray, Motions, by_rod, checked_count
from pyrod.linear.rungs import Rungs
from pyrod.linear.spectrum import largest

_ROUNDING = 1e-6
"""Of growth beside frequency, or the other way round: where two modes meet, rounding makes so much
of it."""


@dataclass(frozen=True, eq=False, repr=False)
class Modes(Motions):
    """Small vibrations: masses of rods and bodies, lumped, on their linear response.

    With accelerations as dead loads, u = w^2 C M u, where C is the compliance of the vertices. Of
    loads without a potential C is not symmetric, and motions may grow: as exp(2 pi growth t), with
    oscillations they flutter. Then ``shapes`` and ``frames`` are complex: their real part moves as
    exp(2 pi i frequency t).

    ``shapes`` have the sum of m ``|u|^2``, and of what turns, one.
    """

    frequencies: Array = field(kw_only=True)  #: (k,) [Hz], the lowest first
    growth: Array = field(kw_only=True)
    """(k,) [1/s] of motions as exp(growth t); not zero only where loads have no potential."""
    errors: Array | None = field(default=None, kw_only=True)
    """(k,) estimates of the errors of the frequencies [Hz], if the result has a tolerance. Then the
    frequencies are what those of finer and finer grids tend to; shapes are those of the first."""
    growth_errors: Array | None = field(default=None, kw_only=True)
    """(k,) the same of ``growth`` [1/s]."""

    @property
    def angular_frequencies(self) -> Array:
        """(k,) [rad/s]."""
        return 2 * np.pi * self.frequencies

    @property
    def stable(self) -> bool:
        """Whether none of these motions grows."""
        return not (self.growth > 0).any()

    def title(self, number: int) -> str:
        """Frequency, and how it grows, of one mode."""
        frequency, growth = self.frequencies[number], self.growth[number]
        words = f"{frequency:.4g} Hz" if frequency else "no oscillation"
        if growth:
            does = "decays" if growth < 0 else "flutters, grows" if frequency else "grows"
            words += f", {does} by {abs(growth):.4g}/s"
        return words

    def __repr__(self) -> str:
        told = "; ".join(self.title(i) for i in range(min(len(self.frequencies), 6)))
        more = len(self.frequencies) - 6
        return f"Modes({told}{f'; and {more} more' if more > 0 else ''})"


def modes_of(rungs: Rungs, count: int, rotary: Rotary) -> Modes:
    """See `Linearised.modes`."""
    count = checked_count(count, "modes")
    if not rungs.climbs:
        return _vibrations(rungs.first, count, rotary)
    found: list[Modes] = []

    def of(grid: Grid) -> dict[str, Any]:
        found.append(_vibrations(grid, count, rotary))
        rates = zip(found[-1].frequencies, found[-1].growth, strict=True)
        return {f"{i}.{j}": rate for i, pair in enumerate(rates) for j, rate in enumerate(pair)}

    limits, errors = rungs.judged(of)
    told, off = (
        np.array([[float(of[f"{i}.{j}"]) for i in range(count)] for j in range(2)])
        for of in (limits, errors)
    )
    off = np.abs(told) * off
    return replace(
        found[0], frequencies=told[0], growth=told[1], errors=off[0], growth_errors=off[1]
    )


def _vibrations(grid: Grid, count: int, rotary: Rotary) -> Modes:
    """On one grid."""
    if grid.symmetric and grid.result.index != 0:
        raise ValueError(
            f"modes: the equilibrium is unstable, with index {grid.result.index}: it does not "
            "vibrate"
        )
    inertia = Inertia(grid, rotary)
    values, vectors = largest(inertia, inertia.size, count, grid.symmetric)
    if len(values) < count:
        raise ValueError(f"modes: there are fewer than {count} on these edges, {len(values)}")
    rates = _rates(values)
    sizes = np.abs(rates) / np.abs(rates).max()
    order = np.lexsort([-rates.real, sizes.round(9)])  # of a pair first the one that grows
    answers = [_answer(inertia, values[i], vectors[:, i], rates[i]) for i in order]
    shapes, frames = (by_rod(answers, len(grid.scene.rods), of) for of in ("positions", "frames"))
    return Modes(
        grid.result,
        shapes,
        frames,
        frequencies=rates.imag[order] / (2 * np.pi),
        growth=rates.real[order],
    )


def _rates(values: AnyArray) -> AnyArray:
    """s of motions as exp(s t), of eigenvalues -1/s^2: with s also -s is one, and is left out."""
    s = np.sqrt(-1 / values.astype(complex))
    s = np.where(s.imag < 0, -s, s)
    nothing = _ROUNDING * np.abs(s)
    s = np.where(np.abs(s.real) <= nothing, 1j * s.imag, s)
    return np.where(np.abs(s.imag) <= nothing, np.abs(s.real) + 0j, s)


def _answer(inertia: Inertia, value: Any, v: AnyArray, rate: complex) -> Mapping[str, Any]:
    """Displacements and turns of a mode: those under its own inertia."""
    flutters = rate.real != 0 and rate.imag != 0
    v = v * np.exp(-1j * np.angle(v[np.abs(v).argmax()])) if np.iscomplexobj(v) else v
    v = v / value
    told = inertia.answer(v.real.copy())
    if not flutters:
        return told
    other = inertia.answer(v.imag.copy())
    return {name: told[name] + 1j * other[name] for name in told if name.startswith("rods.")}
