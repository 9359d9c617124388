"""Columns at and beyond their critical loads."""

from __future__ import annotations

from collections.abc import Callable
from math import asin, pi, sin, sqrt

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipk

from hard.case import Array, Hard, Result, centres, from_reference, planar_frames
from pyrod import Clamp, Force, Rod, Scene, Section

EI = Section(EI1=1.5, EI2=1.0, GJ=0.8)


def sine(mode: int, amplitude: float) -> Callable[[int], Array]:
    return lambda n: planar_frames(amplitude * np.cos(mode * pi * centres(n)))


def amplitude(ratio: float) -> float:
    """End angle of the elastica at P/Pcr = (2 K/pi)^2: a start in the right mode, of its size.

    From a small sine, Newton's method goes back to the straight column, an equilibrium as well.
    """
    m = brentq(lambda m: (2 * ellipk(m) / pi) ** 2 - ratio, 1e-12, 1 - 1e-12, xtol=1e-15)
    return 2 * asin(sqrt(m))


def buckled(mode: int, label: str) -> Hard:
    ratio = float(label)
    # Where the ends have met and passed each other (ratio 2.18), the thrust turns the rod around.
    index = mode - 1 if ratio < 2.18 else mode
    return from_reference(
        f"P3_pin_m{mode}_{label}",
        "planar",
        4096 if label == "1.0001" else 128,
        start=sine(mode, amplitude(ratio)),
        stable=False,
        index=index,
        name=f"column, mode {mode}, P/Pcr = {label}",
    )


def at_bifurcation(n: int) -> Scene:
    """Pushed with exactly the critical load of n edges, (4 EI/h^2) sin^2(pi/4n)."""
    load = (2 * n * sin(pi / (4 * n))) ** 2
    return Scene(Rod.straight(1.0, n, EI), Clamp(), [Force((0.0, 0.0, -load))])


def off_axis(result: Result) -> float:
    return float(np.abs(result.positions[:, :2]).max())


COLUMNS = [
    *(buckled(mode, label) for mode in (1, 2, 3) for label in ("1.0001", "1.01", "1.5", "5")),
    Hard(
        "column at its critical load",
        at_bifurcation,
        128,
        off_axis,
        "exact on the grid",
        index=None,
        stable=False,
        on_every_grid=1e-12,
        unit=1.5,
    ),
]
