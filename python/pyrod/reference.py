"""Exact solutions from JSON files, as scenes: one loader for every case of the reference format.

A folder of such files is named by the environment variable PYROD_REFERENCE; the default is the
project's own copy, whose README explains the format.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from pathlib import Path
from typing import Any

import numpy as np

import pyrod

FOLDER = Path(os.environ.get("PYROD_REFERENCE", Path(__file__).parents[1] / "reference"))
MODELS = {
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
    def spaces(self) -> tuple[str, ...]:
        """Spaces in which the case is solved."""
        return ("planar", "spatial") if self.data["planar"] else ("spatial",)

    def sampled(self, key: str) -> np.ndarray:
        """r, q, n or m at the sample points."""
        return np.array(self.data[key], dtype=float)

    def along(self, key: str) -> Callable[[float], np.ndarray]:
        """K0, f or l as a function of arc length."""
        value = np.array(self.data.get(key, [0, 0, 0]), dtype=float)
        slope = np.array(self.data.get(key + "_slope", [0, 0, 0]), dtype=float)
        return lambda s: value + slope * s

    def section(self) -> pyrod.Section | Callable[[float], pyrod.Section]:
        """The section, or a function of arc length if a stiffness varies."""

        def at(s: float) -> pyrod.Section:
            def value(entry: float | list[float] | None) -> float:
                if entry is None:
                    return inf
                return entry[0] + entry[1] * s if isinstance(entry, list) else entry

            names = ("EI1", "EI2", "GJ", "GA1", "GA2", "EA")
            return pyrod.Section(*(value(self.data["stiffness"][name]) for name in names))

        varies = any(isinstance(v, list) for v in self.data["stiffness"].values())
        return at if varies else at(0.0)

    def scene(self, edges: int, space: str) -> pyrod.Scene:
        """The case on equal edges; raises NotPossible for what this version does not know."""
        start, end = self.data["bc"]["s0"], self.data["bc"]["sL"]
        if start["type"] != "clamped":
            raise NotPossible(f"start is {start['type']}, not clamped")
        if end["type"] != "dead":
            raise NotPossible(f"end is {end['type']}, not free under dead loads")
        rod = pyrod.Rod.precurved(
            self.data["L"], edges, self.section(), self.along("K0"), MODELS[self.data["model"]]
        )
        loads = [
            pyrod.Force(end["n"]),
            pyrod.Moment(end["m"]),
            pyrod.DistributedForce(self.along("f")),
            pyrod.DistributedMoment(self.along("l")),
        ]
        return pyrod.Scene(rod, pyrod.Clamp(start["r"], start["q"]), loads, space)

    def errors(self, result: pyrod.Equilibrium) -> dict[str, float]:
        """Largest differences to the exact solution at the samples, relative to its size."""
        step = result.scene.rod.edges // (len(self.data["s"]) - 1)
        turn = pyrod.rotation.multiply(
            pyrod.rotation.conjugate(self.sampled("q")), result.vertex_frames[::step]
        )
        angle = 2 * np.arctan2(np.linalg.norm(turn[:, 1:], axis=1), np.abs(turn[:, 0]))

        def relative(computed: np.ndarray, key: str, scale: float = 0.0) -> float:
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


def load(folder: Path = FOLDER) -> list[Case]:
    """All sampled rods of the folder; tables and plain curves are left out."""
    cases = [json.loads(path.read_text()) for path in sorted(folder.glob("*.json"))]
    return [Case(data) for data in cases if "bc" in data]
