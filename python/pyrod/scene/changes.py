"""Scenes with other values of some entries, which are named by their paths: ``loads.0.force.2``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from inspect import signature
from typing import Any

import numpy as np

from pyrod.base.arrays import array, number
from pyrod.base.words import listed, shortly
from pyrod.rod.rod import Rod
from pyrod.scene.loads import LoadAlong
from pyrod.scene.scene import Scene

KINDS = ("rods", "supports", "joints", "loads", "actuators")
PLACES = ("at", "rod", "points", "start", "end", "offset")
"""Entries that decide where rods have vertices."""
Parts = dict[str, dict[int, Any]]
"""Parts of a scene by kind and number."""


def changed(scene: Scene, values: Mapping[str, Any]) -> tuple[Scene, Parts | None]:
    """The scene with other values of these entries.

    And its new parts, if they are all that has changed; else None: rods or places are others.
    """
    new, moved = _new_parts(scene, values)
    entries = {kind: getattr(scene, kind) for kind in KINDS}
    given = _uncut(scene, new)
    if moved:
        if given is not None and "rods" not in new:
            entries.update(rods=given[0], loads=given[1], actuators=given[2])
        return Scene(space=scene.space, **_replaced(entries, new)), None
    made = object.__new__(Scene)  # the compiled solver checks the parts as it takes them
    made.__dict__.update(_replaced(entries, new), space=scene.space)
    if given is not None:
        made.__dict__.update(given=given)
    return made, new


def _uncut(scene: Scene, new: Parts) -> tuple[tuple[Any, ...], ...] | None:
    """Rods, loads and actuators without vertices of places; None: rows belong to these vertices."""
    rods, loads, actuators = scene.as_given()
    if rods is scene.rods:
        return None
    parts = _replaced({"loads": loads, "actuators": actuators}, new)
    rows = [load.acting for load in parts["loads"] if isinstance(load, LoadAlong)]
    rows += [actuator.offset for actuator in parts["actuators"]]
    if any(getattr(values, "ndim", 1) > 1 for values in rows):
        return None
    return rods, parts["loads"], parts["actuators"]


def _replaced(entries: dict[str, Any], new: Parts) -> dict[str, Any]:
    """The entries with these parts in them."""
    for kind in new.keys() & entries:
        parts = list(entries[kind])
        for which, part in new[kind].items():
            parts[which] = part
        entries[kind] = tuple(parts)
    return entries


def _new_parts(scene: Scene, values: Mapping[str, Any]) -> tuple[Parts, bool]:
    """New parts, and whether rods may get other vertices. What one part gets, it gets at once."""
    new: Parts = {}
    edits: dict[tuple[str, int], dict[str, Any]] = {}
    moved = False
    for path, value in values.items():
        kind, which, *rest = part_keys(scene, path)
        old = new.get(kind, {}).get(which) or getattr(scene, kind)[which]
        if rest:
            edited = edits.setdefault((kind, which), {})
            edited[rest[0]] = _new_entry(old, edited, path, value, *rest)
        else:
            new.setdefault(kind, {})[which] = value
            edits.pop((kind, which), None)
        moved = moved or not rest or kind == "rods" or rest[0] in PLACES
    for (kind, which), edited in edits.items():
        parts = new.setdefault(kind, {})
        parts[which] = _with_entries(parts.get(which) or getattr(scene, kind)[which], edited)
    return new, moved


def part_keys(scene: Scene, path: str) -> list[Any]:
    """Kind, number, and the rest of the path, of which the first is a name."""
    if not isinstance(path, str):
        raise TypeError(f"changes: paths are strings, got {shortly(path)}")
    kind, _, rest = path.partition(".")
    if kind not in KINDS:
        raise ValueError(f"{shortly(path)}: is no entry; a scene has {listed(KINDS)}")
    word, dot, rest = rest.partition(".")
    parts = getattr(scene, kind)
    if not word.isdecimal() or int(word) >= len(parts):
        there = listed(range(len(parts))) if parts else "none"
        raise ValueError(f"{shortly(path)}: is no entry; of {kind} there are {there}")
    return [kind, int(word), *rest.split(".")] if dot else [kind, int(word)]


def _new_entry(
    part: Any, edited: Mapping[str, Any], path: str, value: Any, name: str, *component: str
) -> Any:
    """The new value of what a part has, or that with another component."""
    names = entries_of(type(part))  # type: ignore[arg-type]
    if name not in names or len(component) > 1:
        raise ValueError(
            f"{shortly(path)}: is no entry; a {type(part).__name__} has {listed(names)}"
        )
    if not component:
        return value
    return _with_component(edited.get(name, getattr(part, name)), path, component[0], value)


def _with_entries(part: Any, values: Mapping[str, Any]) -> Any:
    if isinstance(part, Rod):
        return replace(part, **values)
    names = entries_of(type(part))  # type: ignore[arg-type]
    made = type(part)(**{**{name: getattr(part, name) for name in names}, **values})
    for name, value in values.items():
        if isinstance(value, bool) and getattr(made, name) is not value:
            raise ValueError(f"{name}: stays {not value} for all else that the part has: {made}")
    return made


@cache
def entries_of(kind: type) -> tuple[str, ...]:
    """What a part takes and has."""
    has = kind.__dataclass_fields__  # type: ignore[attr-defined]
    return tuple(name for name in signature(kind).parameters if name in has)


def _with_component(old: Any, path: str, component: str, value: Any) -> Any:
    if isinstance(old, (tuple, list)):
        old = array(old, path)
    if not isinstance(old, np.ndarray) or old.ndim != 1:
        raise ValueError(f"{shortly(path)}: has no components; give it as a whole")
    if not component.isdecimal() or int(component) >= len(old):
        raise ValueError(f"{shortly(path)}: is no entry; its components are 0 to {len(old) - 1}")
    new = old.copy()
    new[int(component)] = number(value, path)
    return new


def are_entries(scene: Scene, paths: Mapping[str, Any]) -> bool:
    """Whether these are entries of the scene's parts, whatever their values."""
    try:
        for path in paths:
            kind, which, *rest = part_keys(scene, path)
            _new_entry(getattr(scene, kind)[which], {}, path, 0.0, *rest)
    except (ValueError, TypeError):
        return False
    return True
