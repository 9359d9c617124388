"""What a hard case consists of, and measures that many of them share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import numpy as np
from support import REFERENCE

import pyrod
from pyrod.reference import Case, load
from pyrod.rotation import conjugate, exp, rotate

Array = np.ndarray
Result = pyrod.Equilibrium


@dataclass(frozen=True)
class Hard:
    """A scene on any grid, and what its equilibrium is like."""

    name: str
    scene: Callable[[int], pyrod.Scene]  #: of n edges to a rod
    n: int  #: edges of the table
    error: Callable[[Result], float]  #: relative to the exact value
    known: str  #: where the exact value is from
    index: int | None = 0  #: None: not determined
    #: The error on every grid; 0: falls with the square of the edges' length
    on_every_grid: float = 0.0
    #: Below this the error need not fall any more: what the exact value leaves out
    floor: float = 1e-11
    start: Callable[[int], Array] | None = None  #: frames
    stable: bool = True
    iterations: int = 50  #: at most
    unit: float = 1.0  #: EI/L
    long: bool = False
    beyond: str = ""  #: why the solver does not reach it
    also: Callable[[Result], None] = field(default=lambda result: None)  #: more to assert

    def __str__(self) -> str:
        return self.name

    def solve(self, n: int | None = None) -> Result:
        n = n or self.n
        start = self.start(n) if self.start else None
        return pyrod.solve(self.scene(n), start=start, stable=self.stable)


@cache
def reference(name: str) -> Case:
    return load(REFERENCE / f"{name}.json")[0]


def positions(name: str) -> Callable[[Result], float]:
    """Largest error of the positions of a reference case."""
    return lambda result: reference(name).errors(result)["positions"]


def energy(exact: float) -> Callable[[Result], float]:
    return lambda result: abs(result.energy / exact - 1)


def from_reference(exact: str, space: str, n: int, **more: Any) -> Hard:
    """A reference case, solved from its scene alone unless told otherwise."""
    case = reference(exact)
    more = {"name": f"{exact}, {space}", "unit": stiffness(case), **more}
    scene = lambda edges: case.scene(edges, space)  # noqa: E731
    return Hard(scene=scene, n=n, error=positions(exact), known="reference", **more)


def stiffness(case: Case) -> float:
    section = case.section()
    return float(np.max((section(0.0) if callable(section) else section).bending)) / case.data["L"]


def first_integral(result: Result) -> float:
    """Spread of M.C^-1 M/2 + N3 + N.C^-1 N/2 along straight rods without distributed loads.

    Only of a solution of the continuous rod is it constant; relative to its largest term.
    """
    return max(_spread(rod) for rod in result.rods)


def _spread(of: pyrod.RodEquilibrium, inner: slice = slice(1, -1)) -> float:
    M, N = of.material_moment, rotate(conjugate(of.vertex_frames), of.vertex_force)
    bending = (M**2 / of.rod.bending / 2).sum(axis=1)
    C = np.full(3, np.inf) if of.rod.model == "inextensible" else of.rod.stretching[0]
    whole = (bending + N[:, 2] + (N**2 / C / 2).sum(axis=1))[inner]
    return float(np.ptp(whole) / max(np.abs(N[inner, 2]).max(), bending[inner].max()))


def planar_frames(angles: Array) -> Array:
    """Frames that turn about e2 from a3 = e3, a1 = e1."""
    return exp(np.outer(angles, (0.0, 1.0, 0.0)))


def centres(n: int) -> Array:
    return (np.arange(n) + 0.5) / n


def mirrored(frames: Array) -> Array:
    """Frames of a planar shape reflected in the line of e3."""
    return frames * np.array([1.0, 1.0, -1.0, 1.0])
