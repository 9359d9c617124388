"""Names of what is told of an equilibrium, and their derivatives by name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from pyrod.base.arrays import finite
from pyrod.base.immutable import Array
from pyrod.base.words import listed, shortly
from pyrod.scene.scene import Scene

OF_RODS = ("positions", "frames", "vertex_frames", "rotations", "K", "moment", "Gamma", "force")
"""Of every rod. Frames change by rotation vectors in their own components."""
ENDS = {"tip": ("positions", -1), "tip_frame": ("vertex_frames", -1)}
"""Names of single rows."""


class Told(dict[str, Any]):
    """Arrays by the paths of what they belong to: ``told["rods.0.positions"]``.

    Of a scene with one rod ``told["positions"]`` will do. ``told["tip"]`` is the last position.
    """

    def __init__(self, arrays: Mapping[str, Any], scene: Scene) -> None:
        super().__init__(arrays)
        self._scene = scene

    def __missing__(self, name: str) -> Any:
        path, row = resolved(self._scene, name)
        return self[path] if row is None else self[path][row]


def resolved(scene: Scene, name: str) -> tuple[str, int | None]:
    """The whole path of a name, and the row that it means; None: all."""
    if not isinstance(name, str):
        raise TypeError(f"output: expected a name, got {shortly(name)}")
    parts = name.split(".")
    if len(parts) == 1 and (parts[0] in OF_RODS or parts[0] in ENDS):
        if len(scene.rods) != 1:
            raise ValueError(
                f"output: the scene has {len(scene.rods)} rods; say rods.0.{name}, or another"
            )
        parts = ["rods", "0", name]
    whole = ".".join(parts)
    if whole in _OF_SCENES:
        return whole, None
    if len(parts) == 3 and parts[1].isdecimal():
        kind, number, what = parts
        if kind == "rods" and int(number) < len(scene.rods):
            if what in ENDS:
                array, row = ENDS[what]
                return f"rods.{number}.{array}", row
            if what in OF_RODS:
                return whole, None
        if kind == "reactions" and int(number) < len(scene.supports) and what in _REACTION:
            return whole, None
        if kind == "tendons" and int(number) < len(scene.actuators) and what in _TENDON:
            return whole, None
    known = [*OF_RODS, *ENDS, *_OF_SCENES, "reactions.0.force", "reactions.0.moment"]
    raise ValueError(f"output: there is no {shortly(name)}; there are {listed(known)}")


_REACTION = ("force", "moment")
_OF_SCENES = ("energy", "multipliers")
_TENDON = ("length", "tension")


def weights_of(scene: Scene, given: Mapping[str, Any], shapes: Mapping[str, Any]) -> dict[str, Any]:
    """Weights by whole paths, in whole arrays."""
    out: dict[str, Any] = {}
    for name, value in given.items():
        path, row = resolved(scene, name)
        if path == "energy" or path.startswith("tendons."):
            out[path] = out.get(path, 0.0) + float(finite(value, name))
            continue
        array = out.setdefault(path, np.zeros(np.shape(shapes[path])))
        part = finite(value, name)
        place = array if row is None else array[row]
        if part.shape != place.shape:
            raise ValueError(f"{name}: expected shape {place.shape}, got {part.shape}")
        place += part
    return out


def one_weight(scene: Scene, name: str, shapes: Mapping[str, Any], entry: int) -> dict[str, Any]:
    """Of one number of an output, which is 1."""
    path, row = resolved(scene, name)
    if path == "energy" or path.startswith("tendons."):
        return {path: 1.0}
    array: Array = np.zeros(np.shape(shapes[path]))
    place = array if row is None else array[row]
    place.reshape(-1)[entry] = 1.0
    return {path: array}
