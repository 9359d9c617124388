"""Results as tables for spreadsheets."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from pyrod.result.equilibrium import Equilibrium
from pyrod.result.fields import KINDS, Field, fields

LEFT_OUT = ("frames",)
"""Means of quaternions of edges are no frames; those of the vertices are there."""


def columns(name: str) -> list[str]:
    """Headers of a quantity, with units: "x [m]", "K_1 [1/m]"."""
    kind = KINDS[name]
    unit = f" [{kind.unit}]" if kind.unit else ""
    if name == "positions":
        return [f"{component}{unit}" for component in kind.components]
    return [f"{name}_{component}{unit}" for component in kind.components] or [f"{name}{unit}"]


def save_csv(result: Equilibrium, path: Path) -> None:
    """One row per vertex, rod after rod; values of edges are means of neighbours there."""
    names = [name for name in KINDS if name not in LEFT_OUT]
    with path.open("w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["rod", *(header for name in names for header in columns(name))])
        for number, rod in enumerate(result.rods):
            known = fields(rod)
            table = np.column_stack([_columns(known[name]) for name in names])
            rows.writerows([number, *row] for row in table.tolist())


def _columns(field: Field) -> np.ndarray:
    return field.at_vertices.reshape(len(field.at_vertices), -1)
