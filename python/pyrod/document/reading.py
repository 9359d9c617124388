"""From a plain document to a scene."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from pyrod._core import Options
from pyrod.document.problems import Found, Here, KeyPath
from pyrod.document.rods import check_form, made, outline_of
from pyrod.document.schema import OPTIONS, SCENE, SHAPES, STIFFNESSES
from pyrod.result.accuracy import checked_tolerance
from pyrod.rod.place import on_rod
from pyrod.rod.rod import Rod
from pyrod.rod.section import Material, Section
from pyrod.scene.scene import Scene

Values = dict[str, Any]


class Content(NamedTuple):
    """What a document tells."""

    scene: Scene
    options: dict[str, Any]  #: keywords of `pyrod.solve`, from the table "solve"
    title: str | None


def content(document: Values) -> Content:
    """All that a document tells.

    Raises
    ------
    Refused
        With all problems of keys, types, units and names; if there are none of these, with all
        values that the parts of the scene refuse.
    """
    found = Found(document)
    here = Here((), found)
    values = SCENE.read(document, here)
    _check_together(document, here)
    found.stop()
    assert values is not None  # else there were problems
    with np.errstate(all="ignore"):  # classes refuse what overflows
        scene = _scene(values, found)
    options: Values = {}
    with found.blamed("solve"):
        options = _options(values.get("solve", {}))
    found.stop()
    return Content(scene, options, values.get("title"))


# What goes together ------------------------------------------------------------------------------


def _check_together(document: Values, here: Here) -> None:
    """Rules for several keys of a table."""
    for path, section in _tables_of(document, "sections"):
        _check_section(section, Here(path, here.found))
    names: set[str] = set()
    for path, rod in _tables_of(document, "rods"):
        check_form(rod, Here(path, here.found))
        name = rod.get("name")
        if isinstance(name, str) and name in names:
            Here((*path, "name"), here.found).wrong(f'another rod is called "{name}", too')
        names |= {name} if isinstance(name, str) else set()


def _tables_of(document: Values, key: str) -> list[tuple[KeyPath, Values]]:
    many = document.get(key)
    items: Any = many.items() if isinstance(many, dict) else ()
    if isinstance(many, list):
        items = enumerate(many)
    return [((key, name), table) for name, table in items if isinstance(table, dict)]


def _check_section(values: Values, here: Here) -> None:
    shapes = [name for name in SHAPES if name in values]
    outright = [name for name in STIFFNESSES.keys if name in values]
    if len(shapes) > 1:
        (here / shapes[1]).wrong(f'does not go with "{shapes[0]}": a section has one shape')
    elif "material" in values and (not shapes or shapes[0] == "polygon"):
        here.wrong('a material needs a shape: "circle", "tube" or "rectangle"')
    elif "material" in values and outright:
        (here / outright[0]).wrong('does not go with "material", from which it follows')
    elif "material" not in values:
        for name in ("EI1", "EI2", "GJ"):
            if name not in values:
                here.wrong(f'"{name}" is missing; or give a shape and a "material"')


# Making what the values tell ----------------------------------------------------------------------


def _scene(values: Values, found: Found) -> Scene:
    materials: dict[str, Material] = {}
    sections: dict[str, Section] = {}
    rods: list[Rod] = []
    for name, table in values.get("materials", {}).items():
        with found.blamed("materials", name):
            materials[name] = Material(**table)
    found.stop()
    for name, table in values.get("sections", {}).items():
        with found.blamed("sections", name):
            sections[name] = _section(table, materials)
    found.stop()
    for number, table in enumerate(values["rods"]):
        with found.blamed("rods", number):
            rods.append(made(table, sections))
    found.stop()
    parts = {key: _parts(key, values.get(key, []), tuple(rods), found) for key in ACTING}
    found.stop()
    scene = None
    with found.blamed():
        scene = Scene(rods, space=values.get("space", "spatial"), **parts)
    found.stop()
    assert scene is not None
    return scene


ACTING = ("supports", "loads", "joints", "actuators")


def _section(values: Values, materials: dict[str, Material]) -> Section:
    values = dict(values)
    shape = next((name for name in SHAPES if name in values), None)
    numbers = values.pop(shape) if shape else {}
    if "material" in values:
        return getattr(Section, shape or "")(**numbers, material=materials[values["material"]])
    return Section(**values, outline=outline_of({shape: numbers} if shape else {}))


def _parts(key: str, tables: list[Any], rods: tuple[Rod, ...], found: Found) -> list[Any]:
    """Supports, loads or joints; places are checked here, where it is known whose they are."""
    out = []
    for number, table in enumerate(tables):
        with found.blamed(key, number):
            kind, values = table if isinstance(table, tuple) else (SCENE.keys[key].type.type, table)  # type: ignore[attr-defined]
            part = kind.make(**values)
            for place in _places(part):
                on_rod(place, [rod.length for rod in rods])
            out.append(part)
    return out


def _places(part: Any) -> tuple[Any, ...]:
    at = getattr(part, "at", None)
    return getattr(part, "points", () if at is None else (at,))


def _options(values: Values) -> Values:
    tuned = {key: value for key, value in values.items() if key in OPTIONS}
    out = {key: value for key, value in values.items() if key not in OPTIONS}
    checked_tolerance(out.get("tol"))
    if out.get("model") == "auto" and "tol" not in out:
        raise ValueError('model: "auto" needs "tol", the error that is allowed')
    return {**out, "options": Options(**tuned)} if tuned else out
