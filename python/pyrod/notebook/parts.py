"""Where the parts of a scene are, and what they are called."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields
from typing import Any

import numpy as np

from pyrod.base.immutable import Array
from pyrod.notebook.sketch import ISOMETRIC, Arrow, Mark, spread
from pyrod.notebook.table import Row, cell_text
from pyrod.rod.place import Place, on_rod
from pyrod.rod.rod import Rod
from pyrod.rotation import conjugate, exp, multiply, rotate, to_matrix
from pyrod.scene.scene import Scene

Shape = tuple[Array, Array]
"""Positions (n + 1, 3) and frames (n + 1, 4) of the vertices of a rod."""
ALONG = 7  # arrows of a load along a rod


def view_of(scene: Scene) -> Array:
    """(2, 3) what is right and up: a3 and a1 of the plane of a planar scene, as plots have them."""
    if scene.space != "planar":
        return ISOMETRIC
    return to_matrix(scene.plane[1]).T[[2, 0]]


def shapes_at_rest(scene: Scene) -> list[Shape]:
    """The rods without stress, each carried to where a support holds its cross-section."""
    shapes = []
    for rod in scene.rods:
        r, q = rod.at_rest()
        first = multiply(q[:1], exp(-rod.edge_lengths[0] / 2 * rod.K0[:1]))
        behind = multiply(q, exp(rod.edge_lengths[:, None] / 2 * rod.K0[1:]))
        shapes.append((r, np.vstack([first, behind])))
    lengths = [rod.length for rod in scene.rods]
    carried: set[int] = set()
    for support in scene.supports:
        number, s = on_rod(support.at, lengths)
        if support.holds_frame and number not in carried:
            carried.add(number)
            vertex = _nearest(scene, number, s)
            shapes[number] = _carried(shapes[number], vertex, support.position, support.frame)
    return shapes


def _carried(shape: Shape, vertex: int, position: Array | None, frame: Array | None) -> Shape:
    r, q = shape
    if position is None and frame is None:
        return shape
    turn = multiply(q[vertex] if frame is None else frame, conjugate(q[vertex]))
    to = r[vertex] if position is None else position
    return to + rotate(turn, r - r[vertex]), multiply(turn, q)


def _nearest(scene: Scene, number: int, s: float) -> int:
    return int(np.abs(scene.rods[number].arc_lengths - s).argmin())


def _point(scene: Scene, at: Place, shapes: Sequence[Array]) -> Array:
    """(3,) a place on rods of these shapes."""
    number, s = on_rod(at, [rod.length for rod in scene.rods])
    known = scene.rods[number].arc_lengths
    return np.array([np.interp(s, known, x) for x in shapes[number].T])


def points(scene: Scene, shapes: Sequence[Array], held: bool) -> list[Mark]:
    """Supports and joints; if the rods are not in equilibrium, supports are where they hold."""
    marks = []
    for support in scene.supports:
        at = _point(scene, support.at, shapes)
        if held and support.position is not None:
            at = support.position
        shape = "square" if support.holds_frame else "circle"
        marks.append(Mark(at, shape, _placed_in_words(support, support.at)))
    for joint in scene.joints:
        at = _point(scene, joint.points[0], shapes)
        marks.append(Mark(at, "diamond", f"Joint, {joint.kind}"))
    return marks


def acting(scene: Scene, shapes: Sequence[Shape]) -> list[Arrow]:
    """Forces and moments on rods of these shapes."""
    arrows: list[Arrow] = []
    for load in scene.loads:
        arrows += _load_arrows(load, scene, shapes)
    return arrows


def _load_arrows(load: Any, scene: Scene, shapes: Sequence[Shape]) -> list[Arrow]:
    name, value = _first_field(load)
    if not callable(value) and np.ndim(value) == 0:  # a mass, on which others act
        return []
    if hasattr(load, "at"):
        number, s = on_rod(load.at, [rod.length for rod in scene.rods])
        frame = shapes[number][1][_nearest(scene, number, s)]
        at = _point(scene, load.at, [r for r, _ in shapes])
        along = rotate(frame, value) if load.follower else value
        return [Arrow(at, along, _placed_in_words(load, load.at), name)]
    if not hasattr(load, "rod"):
        return [
            Arrow(r[len(r) // 2], value, type(load).__name__, name)
            for rod, (r, _) in zip(scene.rods, shapes, strict=True)
            if rod.mass_per_length.any()
        ]
    r, q = shapes[load.rod]
    return [
        Arrow(
            (r[i] + r[i + 1]) / 2,
            rotate(q[i], one) if load.follower else one,
            type(load).__name__,
            name,
        )
        for i, one in _along(value, scene.rods[load.rod])
    ]


def _first_field(load: Any) -> tuple[str, Any]:
    """What a load was made of first: a vector, rows of them, or a function; and its name."""
    name = fields(load)[0].name
    return name, getattr(load, name)


def _along(values: Any, rod: Rod) -> list[tuple[int, Array]]:
    """Some edges, and what acts on them per length."""
    chosen = spread(rod.edges, ALONG)
    if callable(values):
        centres = (rod.arc_lengths[1:] + rod.arc_lengths[:-1]) / 2
        return [(i, np.asarray(values(centres[i]), dtype=float)) for i in chosen]
    return [(i, values if values.ndim == 1 else values[i]) for i in chosen]


def support_rows(scene: Scene) -> list[Row]:
    """What holds and joins."""
    rows = [
        Row(f"support {i}", _placed_in_words(support, support.at))
        for i, support in enumerate(scene.supports)
    ]
    for i, joint in enumerate(scene.joints):
        places = "; ".join(_place(at) for at in joint.points)
        rows.append(Row(f"joint {i}", f"{joint.kind}: {places}"))
    return rows


def load_rows(scene: Scene) -> list[Row]:
    """What acts, in the units it was given in."""
    return [
        Row(f"load {i}", _load_in_words(load), UNITS.get(_first_field(load)[0], ""))
        for i, load in enumerate(scene.loads)
    ]


def actuator_rows(scene: Scene) -> list[Row]:
    """What drives the rods."""
    return [
        Row(f"tendon {i}", f"{tendon.given}, rod {tendon.rod}")
        for i, tendon in enumerate(scene.actuators)
    ]


UNITS = {
    "force": "N",
    "moment": "N m",
    "force_per_length": "N/m",
    "moment_per_length": "N",
    "acceleration": "m/s²",
    "mass": "kg",
}


def _load_in_words(load: Any) -> str:
    value = _first_field(load)[1]
    told = "a function" if callable(value) else cell_text(value)
    where = f", {_place(load.at)}" if hasattr(load, "at") else ""
    where += f", rod {load.rod}" if hasattr(load, "rod") else ""
    return f"{type(load).__name__} {told}{where}{', follower' if load.follower else ''}"


def _placed_in_words(thing: Any, at: Place) -> str:
    return f"{type(thing).__name__}, {_place(at)}"


def _place(at: Place) -> str:
    if isinstance(at, tuple):
        return f"rod {at[0]}, {_place(at[1])}"
    return at if isinstance(at, str) else f"{at:.6g} m"
