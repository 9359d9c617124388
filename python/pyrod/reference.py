"""Exact solutions from JSON files, as scenes.

A folder of such files comes with the source of pyrod (``tests/reference``, where a README explains
the format); other solvers can be tested against it, and pyrod against other files of the same form.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from pathlib import Path
from typing import Any

import numpy as np

from pyrod._along import Model
from pyrod._immutable import Array
from pyrod.equilibrium import Equilibrium
from pyrod.rod import Rod
from pyrod.rotation import conjugate, multiply
from pyrod.scene import (
    Clamp,
    DistributedForce,
    DistributedMoment,
    Force,
    Load,
    Moment,
    Scene,
    Space,
)
from pyrod.section import Section

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

    data: dict[str, Any]

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

    def sampled(self, key: str) -> Array:
        """r, q, n or m at the sample points."""
        return np.array(self.data[key], dtype=float)

    def along(self, key: str) -> Callable[[float], Array]:
        """K0, f or l as a function of arc length."""
        value = np.array(self.data.get(key, [0, 0, 0]), dtype=float)
        slope = np.array(self.data.get(key + "_slope", [0, 0, 0]), dtype=float)
        return lambda s: value + slope * s

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

    def scene(self, edges: int, space: Space | None = None) -> Scene:
        """The case on equal edges, in the simplest of its spaces unless another is named.

        Raises `NotPossible` for what this version does not know.
        """
        start, end = self.data["bc"]["s0"], self.data["bc"]["sL"]
        if start["type"] != "clamped":
            raise NotPossible(f"start is {start['type']}, not clamped")
        if end["type"] != "dead":
            raise NotPossible(f"end is {end['type']}, not free under dead loads")
        rod = Rod.precurved(
            self.data["L"], edges, self.section(), self.along("K0"), _MODELS[self.data["model"]]
        )
        loads: list[Load] = [
            Force(end["n"]),
            Moment(end["m"]),
            DistributedForce(self.along("f")),
            DistributedMoment(self.along("l")),
        ]
        return Scene(rod, Clamp(start["r"], start["q"]), loads, space or self.spaces[0])

    def errors(self, result: Equilibrium) -> dict[str, float]:
        """Largest differences to the exact solution at the samples, relative to its size."""
        step, rest = divmod(result.scene.rod.edges, self.intervals)
        if rest:
            raise ValueError(f"result: its edges must be a multiple of {self.intervals}")
        turn = multiply(conjugate(self.sampled("q")), result.vertex_frames[::step])
        angle = 2 * np.arctan2(np.linalg.norm(turn[:, 1:], axis=1), np.abs(turn[:, 0]))

        def relative(computed: Array, key: str, scale: float = 0.0) -> float:
            exact = self.sampled(key)
            scale = max(scale, float(np.abs(exact).max()))
            return float(np.abs(computed[::step] - exact).max()) / (scale or 1.0)

        energy = self.data["energy"]
        return {
            "positions": relative(result.positions, "r", self.data["L"]),
            "frames": float(angle.max()),
            "forces": relative(result.vertex_force, "n"),
            "moments": relative(result.moment, "m"),
            "energy": abs(result.energy - energy) / (energy or 1.0),
        }


def load(path: str | Path) -> list[Case]:
    """The sampled rods of a folder, or of one file; tables and plain curves are left out."""
    path = Path(path)
    files = sorted(path.glob("*.json")) if path.is_dir() else [path]
    cases = [json.loads(file.read_text()) for file in files]
    return [Case(data) for data in cases if "bc" in data]
