"""From a scene to a plain document."""

from __future__ import annotations

from typing import Any

from pyrod.document.rods import written
from pyrod.document.schema import SCENE, SHAPES, STIFFNESSES
from pyrod.rod.section import Section
from pyrod.scene.actuators import polygonal_tendon
from pyrod.scene.loads import sampled_load
from pyrod.scene.scene import Scene


def write(scene: Scene) -> dict[str, Any]:
    """A scene as dicts, lists, texts and numbers, in SI units; see docs/files.md.

    Functions of arc length are written as the values they have on the edges, those of tendons as
    the values at the vertices.
    """
    names = _Sections()
    keys = SCENE.keys
    out: dict[str, Any] = {"sections": names.tables}
    out["rods"] = [written(rod, names) for rod in scene.rods]
    if not names.tables:
        del out["sections"]
    if scene.space != keys["space"].default:
        out["space"] = scene.space
    loads = [
        sampled_load(load, scene.rods) if callable(load.acting) else load for load in scene.loads
    ]
    actuators = [polygonal_tendon(one, scene.rods) for one in scene.actuators]
    for name, parts in (
        ("supports", scene.supports),
        ("loads", loads),
        ("joints", scene.joints),
        ("actuators", actuators),
    ):
        if parts:
            out[name] = keys[name].type.write(parts)
    return out


class _Sections:
    """Names the sections that it is asked for; equal ones have one name."""

    def __init__(self) -> None:
        self.tables: dict[str, dict[str, Any]] = {}
        self._names: dict[Section, str] = {}

    def __call__(self, section: Section) -> str:
        if section not in self._names:
            name = self._names[section] = f"section{len(self._names) + 1}"
            self.tables[name] = _section_table(section)
        return self._names[section]


def _section_table(section: Section) -> dict[str, Any]:
    out = STIFFNESSES.write(section)
    if section.outline is not None:
        for shape, numbers in section.outline.to_dict().items():
            out[shape] = {
                key: SHAPES[shape].keys[key].type.write(value) for key, value in numbers.items()
            }
    return out
