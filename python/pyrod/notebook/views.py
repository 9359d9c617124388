"""What notebooks show of curves, rods, scenes and equilibria."""

from __future__ import annotations

from typing import Any

from pyrod.base.immutable import Array
from pyrod.curve import FramedCurve, Polyline
from pyrod.notebook.parts import (
    acting,
    actuator_rows,
    load_rows,
    points,
    shapes_at_rest,
    support_rows,
    view_of,
)
from pyrod.notebook.sketch import Sketch, svg
from pyrod.notebook.table import Row, page, several
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.rods import RodEquilibrium
from pyrod.result.tendons import ways
from pyrod.rod.rod import Rod
from pyrod.scene.scene import Scene


def rod_html(rod: Rod) -> str:
    """Model, grid and stiffnesses, and the shape at rest."""
    rows = [
        Row("model", rod.model),
        Row("length", rod.length, "m"),
        Row("edges", rod.edges),
        *(
            Row(name, _range(values[:, i]), unit)
            for values, names, unit in (
                (rod.bending, ("EI1", "EI2", "GJ"), "N m²"),
                (rod.stretching, ("GA1", "GA2", "EA"), "N"),
                (rod.K0, ("K0 about a1", "K0 about a2", "K0, twist"), "1/m"),
            )
            for i, name in enumerate(names)
        ),
        Row("mass per length", _range(rod.mass_per_length), "kg/m"),
    ]
    return page("Rod", rows, svg(Sketch([rod.at_rest()[0]])))


def scene_html(scene: Scene) -> str:
    """Rods, supports, joints and loads, and where they are at rest."""
    rests = shapes_at_rest(scene)
    sketch = Sketch(
        [r for r, _ in rests],
        (),
        points(scene, [r for r, _ in rests], held=True),
        acting(scene, rests),
        view_of(scene),
    )
    rows = [
        *several("rods", [_rod_row(i, rod) for i, rod in enumerate(scene.rods)]),
        *several("supports and joints", support_rows(scene)),
        *several("loads", load_rows(scene)),
        *several("actuators", actuator_rows(scene)),
        Row("space", scene.space),
    ]
    return page("Scene, at rest", rows, svg(sketch), sketch.left_out)


def equilibrium_html(result: Equilibrium) -> str:
    """How it was found and what is largest, and the shape; dashed: at rest."""
    return page("Equilibrium", _found(result), *pictured(result))


def pictured(result: Equilibrium, others: list[Array] | None = None) -> tuple[str, str]:
    """The shape and the loads, dashed other shapes or that at rest; and what is left out."""
    scene = result.scene
    shapes = [(rod.positions, rod.vertex_frames) for rod in result.rods]
    faint = [r for r, _ in shapes_at_rest(scene)] if others is None else others
    lines = [r for r, _ in shapes]
    marks = points(scene, lines, held=False)
    sketch = Sketch([*lines, *ways(result)], faint, marks, acting(scene, shapes), view_of(scene))
    return svg(sketch), sketch.left_out


def rod_equilibrium_html(rod: RodEquilibrium) -> str:
    """What is largest, and the shape; dashed: at rest."""
    rows = [
        Row("model", rod.rod.model),
        Row("length", rod.rod.length, "m"),
        Row("edges", rod.rod.edges),
        Row("energy", rod.energy, "J"),
        *_largest_values(rod),
        Row("end", rod.tip, "m"),
    ]
    return page("Rod in equilibrium", rows, svg(Sketch([rod.positions])))


def polyline_html(polyline: Polyline) -> str:
    """Its size, and the curve."""
    return page("Polyline", _size(polyline), svg(Sketch([_around(polyline)])))


def framed_html(curve: FramedCurve) -> str:
    """Its size and twist, and the curve."""
    rows = [*_size(curve.polyline), Row("twist", curve.twist, "turns")]
    return page("Framed curve", rows, svg(Sketch([_around(curve.polyline)])))


def _size(polyline: Polyline) -> list[Row]:
    kind = "closed" if polyline.closed else "open"
    return [
        Row("curve", kind),
        Row("edges", polyline.edges),
        Row("length", polyline.length, "m"),
    ]


def _around(polyline: Polyline) -> Array:
    """The vertices, back to the first if it is closed."""
    r = polyline.positions
    return r[[*range(len(r)), 0]] if polyline.closed else r


def _range(values: Array) -> Any:
    low, high = float(values.min()), float(values.max())
    return low if low == high else f"{low:.6g} to {high:.6g}"


def _rod_row(number: int, rod: Rod) -> Row:
    curved = "curved" if rod.K0.any() else "straight"
    return Row(f"rod {number}", f"{rod.length:.6g}, {rod.edges} edges, {rod.model}, {curved}", "m")


def _found(result: Equilibrium) -> list[Row]:
    one = len(result.rods) == 1
    rows = [Row("status", "converged" if result.converged else result.status)]
    rows += [] if result.converged else [Row("advice", result.advice)]
    rows += [Row("stability", _stability(result)), Row("energy", result.energy, "J")]
    rows += [
        *_largest_values(result),
        Row("end" if one else "end of the last rod", _tip(result), "m"),
    ]
    reactions = [
        row
        for i, reaction in enumerate(result.reactions)
        for row in (
            Row(f"reaction {i}, force", reaction.force, "N"),
            Row(f"reaction {i}, moment", reaction.moment, "N m"),
        )
    ]
    rows += several("of reactions", reactions)
    tendons = [
        Row(f"tendon {i}", f"{tendon.tension:.6g} N, {tendon.length:.6g}", "m")
        for i, tendon in enumerate(result.tendons)
    ]
    rows += several("of tendons", tendons)
    if result.lowest_eigenvalue is not None:
        rows.append(Row("lowest eigenvalue", result.lowest_eigenvalue, "N m"))
    if result.accuracy is not None:
        rows.append(Row("estimated error", result.accuracy.reached))
    if result.choice:
        rows.append(Row("model", result.choice))
    return [*rows, Row("iterations", result.iterations), Row("time", 1e3 * result.time, "ms")]


def _tip(result: Equilibrium) -> Array:
    return result.rods[-1].tip


def _largest_values(found: Equilibrium | RodEquilibrium) -> list[Row]:
    return [
        Row("largest curvature", found.largest_K, "1/m"),
        Row("largest section force", found.largest_force, "N"),
        Row("largest section moment", found.largest_moment, "N m"),
    ]


def _stability(result: Equilibrium) -> str:
    told = {None: "no potential", True: "stable"}.get(result.stable, f"index {result.index}")
    return told + (", neutral" if result.neutral else "")
