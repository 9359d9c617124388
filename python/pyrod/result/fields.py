"""The quantities of a rod in equilibrium as one table: for plots, colours, files and tables."""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np

from pyrod.base.immutable import Array
from pyrod.base.words import meant, shortly
from pyrod.result.rods import RodEquilibrium
from pyrod.rotation import to_matrix

Carrier = Literal["vertex", "edge"]

SPACE = ("x", "y", "z")
FRAME = ("1", "2", "3")
QUATERNION = ("qw", "qx", "qy", "qz")


class Kind(NamedTuple):
    """What a quantity is, whatever the rod."""

    label: str  #: in words
    symbol: str  #: as in docs/notation.md
    unit: str  #: SI
    place: Carrier  #: what has a row: vertices (n + 1) or edges (n)
    components: tuple[str, ...]  #: names of the columns; none of a scalar


KINDS = {
    "s": Kind("arc length", "s", "m", "vertex", ()),
    "positions": Kind("position", "r", "m", "vertex", SPACE),
    "vertex_frames": Kind("frame of the vertex", "q", "", "vertex", QUATERNION),
    "frames": Kind("frame", "q", "", "edge", QUATERNION),
    "a1": Kind("director a1", "a1", "", "vertex", SPACE),
    "a2": Kind("director a2", "a2", "", "vertex", SPACE),
    "a3": Kind("director a3", "a3", "", "vertex", SPACE),
    "K": Kind("curvature and twist", "K", "1/m", "vertex", FRAME),
    "K_before": Kind("curvature and twist, before", "K", "1/m", "vertex", FRAME),
    "Gamma": Kind("shear and stretch", "Γ", "", "edge", FRAME),
    "force": Kind("section force", "n", "N", "edge", SPACE),
    "vertex_force": Kind("section force", "n", "N", "vertex", SPACE),
    "vertex_force_before": Kind("section force, before", "n", "N", "vertex", SPACE),
    "material_force": Kind("section force, material", "N", "N", "edge", FRAME),
    "moment": Kind("section moment", "m", "N m", "vertex", SPACE),
    "moment_before": Kind("section moment, before", "m", "N m", "vertex", SPACE),
    "material_moment": Kind("section moment, material", "M", "N m", "vertex", FRAME),
    "backbone_force": Kind("force of the backbone", "n_b", "N", "vertex", SPACE),
    "load": Kind("load", "f", "N", "vertex", SPACE),
}
"""All quantities by name: those of `RodEquilibrium`, and the directors at the vertices."""


class Field(NamedTuple):
    """A quantity of one rod."""

    name: str
    kind: Kind
    values: Array  #: (rows,) or (rows, components)

    @property
    def at_vertices(self) -> Array:
        """Values at the vertices; those of edges are means of neighbours, at the ends theirs."""
        return self.values if self.kind.place == "vertex" else between_edges(self.values)

    @property
    def magnitude(self) -> Array:
        """(rows,) the values of a scalar, or the Euclidean norms of the rows."""
        return self.values if self.values.ndim == 1 else np.linalg.norm(self.values, axis=1)


def between_edges(values: Array) -> Array:
    """At vertices, (n + 1, ...), of what edges have: means of neighbours, at the ends theirs."""
    v = values
    return np.concatenate([v[:1], (v[:-1] + v[1:]) / 2, v[-1:]])


def field(rod: RodEquilibrium, name: str) -> Field:
    """One quantity of a rod.

    Raises
    ------
    ValueError
        There is no quantity of that name; those that are, are told.
    """
    if name not in KINDS:
        raise ValueError(
            f"quantity: expected one of {', '.join(KINDS)}, got {shortly(name)}"
            f"{meant(str(name), KINDS)}"
        )
    if name in ("a1", "a2", "a3"):
        values = to_matrix(rod.vertex_frames)[:, :, int(name[1]) - 1]
    else:
        values = getattr(rod, name)
    return Field(name, KINDS[name], values)


def fields(rod: RodEquilibrium) -> dict[str, Field]:
    """All quantities of a rod, in the order of the table."""
    return {name: field(rod, name) for name in KINDS}
