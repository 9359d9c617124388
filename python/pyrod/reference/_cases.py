"""Exact solutions as scenes."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from math import gcd, inf
from pathlib import Path
from typing import Any

import numpy as np

from pyrod.base.folders import folder as _installed
from pyrod.base.immutable import Array
from pyrod.reference import _notes as notes
from pyrod.result.equilibrium import Equilibrium
from pyrod.rod.rod import Rod
from pyrod.rod.section import Model, Section
from pyrod.rotation import conjugate, exp, log, multiply, rotate
from pyrod.scene.loads import DistributedForce, DistributedMoment, Force, Load, Moment
from pyrod.scene.scene import Scene, Space
from pyrod.scene.supports import Clamp, Hinge, Pivot, Slider, Support

_MODELS: dict[str, Model] = {
    "cosserat": "cosserat",
    "extensible_kirchhoff": "extensible",
    "inextensible_kirchhoff": "inextensible",
}


class NotPossible(Exception):
    """This version cannot build the case, for the reason given."""


@dataclass(frozen=True)
class Case:
    """A sampled exact solution."""

    data: dict[str, Any]  #: what its file holds

    def __str__(self) -> str:
        return self.data["id"]

    @property
    def spaces(self) -> tuple[Space, ...]:
        """Spaces in which the case is solved."""
        return ("planar", "spatial") if self.data["planar"] else ("spatial",)

    @property
    def intervals(self) -> int:
        """Number of equal intervals between the samples."""
        return len(self.data["s"]) - 1

    @property
    def found_alone(self) -> bool:
        """Whether it is what a solve finds from the scene; else give it a `start`."""
        return notes.found_alone(str(self), self.data["values"].get("stability_index"))

    @property
    def first_edges(self) -> int | None:
        """Edges to begin with if a tolerance is given; None if those that `pyrod.solve` chooses."""
        return notes.first_edges(str(self), self.found_alone)

    @property
    def rounding(self) -> float:
        """Errors below this are rounding, magnified by the case."""
        return notes.rounding(str(self))

    def nearest(self, result: Equilibrium) -> Case:
        """The case itself, or of a circle of solutions the one that is nearest to the result."""
        if not str(self).startswith(tuple(notes.CIRCLES)):
            return self
        moved = notes.turned_to({key: self.sampled(key) for key in "rqnm"}, result)
        return Case({**self.data, **moved})

    def sampled(self, key: str) -> Array:
        """r, q, n or m at the sample points."""
        return np.array(self.data[key], dtype=float)

    def along(self, key: str) -> Callable[[float], Array]:
        """K0, f or l as a function of arc length."""
        value = np.array(self.data.get(key, [0, 0, 0]), dtype=float)
        slope = np.array(self.data.get(key + "_slope", [0, 0, 0]), dtype=float)
        return lambda s: value + slope * s

    def _given(self, key: str) -> Array | Callable[[float], Array]:
        """The same as scenes are given it: one vector where it does not vary."""
        function = self.along(key)
        return function if np.any(self.data.get(key + "_slope", 0.0)) else function(0.0)

    def section(self) -> Section | Callable[[float], Section]:
        """The section, or a function of arc length if a stiffness varies."""

        def at(s: float) -> Section:
            def value(entry: float | list[float] | None) -> float:
                if entry is None:
                    return inf
                return entry[0] + entry[1] * s if isinstance(entry, list) else entry

            names = ("EI1", "EI2", "GJ", "GA1", "GA2", "EA")
            return Section(*(value(self.data["stiffness"][name]) for name in names))

        varies = any(isinstance(v, list) for v in self.data["stiffness"].values())
        return at if varies else at(0.0)

    def scene(self, edges: int | None, space: Space | None = None) -> Scene:
        """The case on equal edges (None: those that `pyrod.solve` chooses).

        In the simplest of its spaces unless another is named.
        Raises `NotPossible` for what this version does not know.
        """
        space = space or self.spaces[0]
        rod = Rod.precurved(
            self.data["L"], edges, self.section(), self._given("K0"), _MODELS[self.data["model"]]
        )
        start, end = self.data["bc"]["s0"], self.data["bc"]["sL"]
        loads: list[Load] = [
            DistributedForce(self._given("f")),
            DistributedMoment(self._given("l")),
        ]
        if start["type"] == "clamped":
            supports: list[Support] = [Clamp(start["r"], start["q"])]
        elif start["type"] == "pinned":
            supports = [_pinned(space, start["r"], None, "start")]
        else:
            raise NotPossible(f"start is {start['type']}")
        if end["type"] == "clamped":
            supports.append(Clamp(end["r"], end["q"], at="end", turns=self._turns()))
        elif end["type"] == "pinned_roller":
            supports.append(_pinned(space, self.data["r"][-1], (0.0, 0.0, 1.0), "end"))
            loads.append(Force(np.array([0.0, 0.0, end["n_axial"]])))
        elif end["type"] in ("dead", "follower"):
            follows = end["type"] == "follower"
            names = ("N", "M") if follows else ("n", "m")
            loads += [
                Force(end[names[0]], follower=follows),
                Moment(end[names[1]], follower=follows),
            ]
        else:
            raise NotPossible(f"end is {end['type']}")
        return Scene(rod, supports, loads, space)

    def _turns(self) -> int:
        """Full turns about a3 from start to end, besides what the end frames tell."""
        if np.any(self.data.get("K0", 0.0)):
            return 0  # as the rest shape has them
        q = self.sampled("q")
        turn = log(multiply(conjugate(q[:-1]), q[1:]))
        told = log(_nearer(multiply(conjugate(q[0]), q[-1])))
        return round((turn[:, 2].sum() - told[2]) / (2 * np.pi))

    def start(self, edges: int) -> Array:
        """(edges, 4) frames of the exact solution at the centres of equal edges.

        Between the samples by cubics whose slopes are the curvatures that belong to the moments.
        """
        q, h = self.sampled("q"), self.data["L"] / self.intervals
        x = (np.arange(edges) + 0.5) * self.intervals / edges
        j = np.minimum(x.astype(int), self.intervals - 1)
        u = log(multiply(conjugate(q[:-1]), q[1:]))
        K = self._curvatures()
        across = np.cross(u, K[1:])
        first, last = h * K[:-1], h * (K[1:] + across / 2 + np.cross(u, across) / 12)
        t = (x - j)[:, None]
        turn = t**2 * (3 - 2 * t) * u[j] + t * (1 - t) * ((1 - t) * first[j] - t * last[j])
        return multiply(q[j], exp(turn))

    def _curvatures(self) -> Array:
        """K at the samples, from the moments."""
        section = self.section()
        s = np.array(self.data["s"], dtype=float)
        C = np.array([(section(x) if callable(section) else section).bending for x in s])
        M = rotate(conjugate(self.sampled("q")), self.sampled("m"))
        return np.array([self.along("K0")(x) for x in s]) + M / C

    def errors(self, result: Equilibrium) -> dict[str, float]:
        """Largest differences to the exact solution, relative to its size, at those of its equally
        spaced samples that are vertices, too."""
        common = gcd(result.scene.rod.edges, self.intervals)
        step, skip = result.scene.rod.edges // common, self.intervals // common
        turn = multiply(conjugate(self.sampled("q")[::skip]), result.vertex_frames[::step])
        angle = 2 * np.arctan2(np.linalg.norm(turn[:, 1:], axis=1), np.abs(turn[:, 0]))

        def relative(computed: Array, key: str, scale: float = 0.0) -> float:
            exact = self.sampled(key)
            scale = max(scale, float(np.abs(exact).max()))
            return float(np.abs(computed[::step] - exact[::skip]).max()) / (scale or 1.0)

        energy = self.data["energy"]
        return {
            "positions": relative(result.positions, "r", self.data["L"]),
            "frames": float(angle.max()),
            "forces": relative(result.vertex_force, "n"),
            "moments": relative(result.moment, "m"),
            "energy": abs(result.energy - energy) / (energy or 1.0),
        }


def _pinned(
    space: Space, position: Any, along: tuple[float, float, float] | None, at: Any
) -> Support:
    """A pin about e2: in space, what is planar must not turn about its own chord."""
    if space == "spatial":
        return Pivot((0.0, 1.0, 0.0), position, at=at, along=along)
    return Hinge(position, at=at) if along is None else Slider(along, position=position, at=at)


def _nearer(q: Array) -> Array:
    return -q if q[0] < 0 else q


def folder() -> Path:
    """The folder of exact solutions that an installed pyrod brings along, for `load`.

    Raises
    ------
    FileNotFoundError
        Pyrod is not installed but imported from its source folder
    """
    return _installed("_reference")


def load(path: str | Path) -> list[Case]:
    """The sampled rods of a folder, or of one file; tables and plain curves are left out."""
    path = Path(path)
    files = sorted(path.glob("*.json")) if path.is_dir() else [path]
    cases = [json.loads(file.read_text()) for file in files]
    return [Case(data) for data in cases if "bc" in data]
