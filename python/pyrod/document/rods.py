"""Rods in documents: by their sections and curvature, by a curve, or by arrays."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from pyrod.base.immutable import Array, frozen
from pyrod.curve import Polyline
from pyrod.curve._sampling import natural_edges
from pyrod.document.problems import Here
from pyrod.document.schema import MOST_EDGES, ROD, Jump
from pyrod.rod.along import EndOutlines, Sections
from pyrod.rod.law import NO_JUMPS, Jumps, Made, Table, table_of
from pyrod.rod.outline import Outline
from pyrod.rod.rod import Rod, on_other_edges, rod_of
from pyrod.rod.section import Section
from pyrod.scene.supports import placed_frame

_PLACE = {"name", "model", "position", "frame", "tangent", "normal", "vertices", "grid"}
ARRAYS = ("edge_lengths", "bending", "stretching", "K0")
_GIVEN = (*ARRAYS, "model", "mass_per_length")
FORMS = {
    "positions": ({"positions", "section"}, {"frames", "normal", "name", "model", "vertices"}),
    "bending": ({*ARRAYS, "model"}, {"mass_per_length", "jumps", "outlines", "corners", *_PLACE}),
    "edge_lengths": ({"edge_lengths", "section"}, {"curvature", *_PLACE}),
    "length": ({"length", "section"}, {"edges", "curvature", *_PLACE}),
}
"""For the key that tells how a rod is given: which others it needs, and which it may have."""


def check_form(values: dict[str, Any], here: Here) -> None:
    """Notes keys that are missing or do not go together."""
    form = next((key for key in FORMS if key in values), None)
    if form is None:
        return here.wrong('"length" is missing; or "edge_lengths", or "positions" of a curve')
    needed, allowed = FORMS[form]
    for key in sorted(needed - values.keys()):
        here.wrong(f'"{key}" is missing, which goes with "{form}": {ROD.keys[key].type.text}')
    for key in values:
        if key in ROD.keys and key not in needed | allowed:
            (here / key).wrong(f'does not go with "{form}"')
    if {"grid", "edges", "vertices"} <= values.keys():
        (here / "grid").wrong('does not go with "edges" and "vertices"')
    return None


# Reading ------------------------------------------------------------------------------------------


def made(values: dict[str, Any], sections: dict[str, Section]) -> Rod:
    """The rod that a table tells."""
    section = _sections(values.get("section"), sections)
    if "positions" in values:
        rod = _curve(values, section)
    elif "bending" in values:
        rod = _of_arrays(values)
    else:
        rod = _natural(values, section)
    if "positions" not in values:
        rod = _placed_as_told(rod, values)
    if "grid" in values:
        kept = None if rod._compiled.kept is None else list(values.get("vertices", ()))
        return _graded(rod, values["grid"], kept)
    return rod.with_vertices(_on(rod, values["vertices"])) if "vertices" in values else rod


def _placed_as_told(rod: Rod, values: dict[str, Any]) -> Rod:
    frame = placed_frame(values.get("frame"), values.get("tangent"), values.get("normal"))
    return rod.placed(values.get("position"), frame)


def _sections(names: Any, sections: dict[str, Section]) -> Sections:
    return [sections[name] for name in names] if isinstance(names, list) else sections.get(names)  # type: ignore[return-value]


def _curve(values: dict[str, Any], section: Sections) -> Rod:
    positions, frames = values["positions"], values.get("frames")
    if frames is None:
        frames = Polyline(positions).bishop(values.get("normal")).frames
    elif "normal" in values:
        raise ValueError("normal: give either it or frames")
    return Rod.from_curve(positions, frames, section, values.get("model"))


def _of_arrays(values: dict[str, Any]) -> Rod:
    rod = Rod(**{name: values[name] for name in _GIVEN if name in values})
    law = replace(
        table_of(rod),
        shapes=_shapes(values.get("outlines", {}), rod.edges),
        corners=values.get("corners", False),
        jumps=_jumps(values["jumps"], rod) if "jumps" in values else NO_JUMPS,
    )
    return rod_of(law.compiled(rod.model, rod.placement, False), law, rod.placement)


def outline_of(shape: dict[str, Any]) -> Outline | None:
    """The outline that a table such as { circle = { radius = 1 } } tells."""
    return Outline.from_dict(shape) if shape else None


def _shapes(shapes: Any, edges: int) -> tuple[EndOutlines, ...]:
    if isinstance(shapes, dict):
        one = outline_of(shapes)
        return ((one, one),) * edges if one else ()
    if [len(pair) for pair in shapes] != [2] * edges:
        raise ValueError(f"outlines: expected {edges} pairs, one per edge, or one table")
    return tuple((outline_of(a), outline_of(b)) for a, b in shapes)


def _jumps(jumps: list[dict[str, Any]], rod: Rod) -> Jumps:
    at = [jump["vertex"] for jump in jumps]
    if sorted(set(at)) != at or at[-1:] >= [rod.edges]:
        raise ValueError(f"jumps: expected inner vertices in their order, got {at}")
    sides = [[(j["bending"][i], j["K0"][i]) for i in (0, 1)] for j in jumps]
    return at, np.reshape(sides, (len(at), 4, 3))


def _natural(values: dict[str, Any], section: Sections) -> Rod:
    length, curvature = values.get("length"), values.get("curvature", np.zeros(3))
    edges = values.get("edges")
    if length is None:
        length = values["edge_lengths"]
    elif edges is None and natural_edges(length, curvature) > MOST_EDGES:
        raise ValueError(f"curvature: a rod so long needs more than {MOST_EDGES:g} edges")
    return Rod.precurved(length, edges, section, curvature, values.get("model"))


def _on(rod: Rod, places: Array) -> Array:
    if not ((places >= 0) & (places <= rod.length * (1 + 1e-12))).all():
        raise ValueError(f"vertices: expected arc lengths in [0, {rod.length:g}]")
    return places


def _graded(rod: Rod, grid: Array, kept: list[float] | None) -> Rod:
    if not ((grid > 0).all() and abs(grid.sum() - rod.length) <= 1e-6 * rod.length):
        raise ValueError(f"grid: expected positive lengths of edges, {rod.length:g} together")
    return on_other_edges(rod, grid, kept)


# Writing ------------------------------------------------------------------------------------------


def written(rod: Rod, name_of: Any) -> dict[str, Any]:
    """The table of a rod; ``name_of`` names a section."""
    law = rod._law
    if type(law) is Made and not callable(law.section) and not callable(law.curvature):
        values, base = _by_law(rod, law, name_of), law.base
    else:
        table = law if isinstance(law, Table) else table_of(rod)
        jumps = table.jumps if table is law else rod._compiled.jumps
        values, base = _by_arrays(table, rod.model, jumps), table.base
    if not np.array_equal(base, rod.edge_lengths) and not _regraded(rod, law):
        values["grid"] = rod.edge_lengths
    position, frame = rod.placement
    if position.any():
        values["position"] = position
    if not np.array_equal(frame, [1, 0, 0, 0]):
        values["frame"] = frame
    return {name: ROD.keys[name].type.write(value) for name, value in values.items()}


def _by_law(rod: Rod, law: Made, name_of: Any) -> dict[str, Any]:
    many = not isinstance(law.section, Section)
    names = [name_of(one) for one in law.section] if many else name_of(law.section)  # type: ignore[union-attr]
    values: dict[str, Any] = {"section": names, "model": rod.model}
    length = _whole_length(law.base)
    if length is None:
        values["edge_lengths"] = law.base
    else:
        values["length"] = length
        kept = rod._compiled.kept
        if kept is None:
            values["edges"] = len(law.base)
        elif kept:
            values["vertices"] = np.array(kept)
    if np.any(law.curvature):  # type: ignore[arg-type]
        values["curvature"] = frozen(law.curvature)  # type: ignore[arg-type]
    return values


def _regraded(rod: Rod, law: Any) -> bool:
    """Whether the vertices that are kept lead to the same edges when the scene is read."""
    kept = rod._compiled.kept
    if kept is None:
        return False
    fresh = Rod.precurved(law.base.sum(), None, law.section, law.curvature, rod.model)
    return np.array_equal(fresh.with_vertices(kept).edge_lengths, rod.edge_lengths)


def _whole_length(h: Array) -> float | None:
    """The length of which these are equal parts."""
    near = h[0] * len(h)
    for length in (float(f"{near:.15g}"), near, np.nextafter(near, 0), np.nextafter(near, np.inf)):
        if (h == length / len(h)).all():
            return float(length)
    return None


def _by_arrays(table: Table, model: str, jumps: Jumps) -> dict[str, Any]:
    arrays = table.base, table.bending, table.stretching, table.K0
    values: dict[str, Any] = dict(zip(ARRAYS, arrays, strict=True), model=model)
    if table.mass.any():
        values["mass_per_length"] = table.mass
    if any(x is not None for ends in table.shapes for x in ends):
        pairs = [[{} if x is None else x.to_dict() for x in ends] for ends in table.shapes]
        one = pairs[0][0]
        values["outlines"] = one if all(x == one for pair in pairs for x in pair) else pairs
    if table.corners:
        values["corners"] = True
    at, sides = jumps
    if at:
        values["jumps"] = [
            Jump(j, side[[0, 2]], side[[1, 3]]) for j, side in zip(at, sides, strict=True)
        ]
    return values
