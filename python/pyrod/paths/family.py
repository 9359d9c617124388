"""Scenes as functions of one number."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numpy.typing import ArrayLike

from pyrod.base.arrays import array, finite, number
from pyrod.base.words import listed, shortly
from pyrod.rotation import exp, multiply
from pyrod.scene.changes import changed, entries_of, part_keys
from pyrod.scene.scene import Scene, checked_scene
from pyrod.scene.supports import Spring

Family = Callable[[float], Scene] | tuple[Scene, str, ArrayLike]
VECTORS = ("force", "moment", "force_per_length", "moment_per_length", "acceleration")
"""Entries of loads that these are proportional to."""


class Scenes:
    """A scene for every value; made once for each, as long as that is the last.

    ``level`` : on edges halved so often, cut where loads act and functions jump; None: as they are.
    """

    def __init__(self, family: Family, level: int | None = None) -> None:
        self._entry: tuple[Scene, str, Any, Any] | None = None
        self._level = level
        self._make: Callable[[float], Scene]
        if callable(family):
            self._make = family
        else:
            self._entry = _line_of(family)
            self._make = self._changed
        self._last: tuple[float, Scene] | None = None

    @property
    def name(self) -> str:
        """Of what changes."""
        return "value" if self._entry is None else self._entry[1]

    def __call__(self, value: float) -> Scene:
        if self._last is None or self._last[0] != value:
            self._last = value, self._on_edges(checked_scene(self._make(value)))
        return self._last[1]

    def _on_edges(self, scene: Scene) -> Scene:
        return scene if self._level is None else scene._climbing.refined(self._level)

    @property
    def compiled(self) -> Any:
        """What the compiled solver takes: two scenes if others lie on their line, or a function."""
        if self._entry is not None and _is_line(*self._entry[:2]):
            first, second = (self._on_edges(self._changed(value)) for value in (0.0, 1.0))
            return first._compiled, second._compiled
        return lambda value: self(value)._compiled

    def _changed(self, value: float) -> Scene:
        assert self._entry is not None
        scene, path, old, direction = self._entry
        if path.split(".")[2] == "frame":
            return changed(scene, {path: multiply(old, exp(value * direction))})[0]
        return changed(scene, {path: old + value * direction})[0]


def _line_of(family: Any) -> tuple[Scene, str, Any, Any]:
    """The scene, the path, the value that is there, and the direction."""
    if not (isinstance(family, tuple) and len(family) == 3):
        raise TypeError(
            "family: expected a function of a number that makes a scene, or (scene, path, "
            f"direction), got {shortly(family)}"
        )
    scene, path, direction = checked_scene(family[0]), family[1], family[2]
    old = entry_of(scene, path)
    if isinstance(old, float):
        return scene, path, old, number(direction, "direction")
    shape = (3,) if path.endswith(".frame") else old.shape
    return scene, path, old, _checked_direction(direction, shape)


def entry_of(scene: Scene, path: str) -> Any:
    """The number or the numbers that a path leads to."""
    kind, which, *rest = part_keys(scene, path)
    part = getattr(scene, kind)[which]
    names = entries_of(type(part))  # type: ignore[arg-type]
    if not rest or rest[0] not in names:
        raise ValueError(
            f"{shortly(path)}: is no entry; a {type(part).__name__} has {listed(names)}"
        )
    old = getattr(part, rest[0])
    if callable(old):
        raise ValueError(f"{path}: is a function; give the family as a function of its parameter")
    if old is None:
        raise ValueError(f"{path}: is not told; give the scene one that it is counted from")
    old = array(old, path)
    if len(rest) == 1:
        return old if old.ndim else float(old)
    if len(rest) > 2 or not rest[1].isdecimal() or int(rest[1]) >= len(old):
        raise ValueError(f"{shortly(path)}: is no entry")
    return float(old[int(rest[1])])


def _checked_direction(direction: Any, shape: tuple[int, ...]) -> Any:
    value = finite(direction, "direction")
    if value.shape != shape:
        raise ValueError(f"direction: expected shape {shape}, got {value.shape}")
    if not value.any():
        raise ValueError("direction: is zero")
    return value


def _is_line(scene: Scene, path: str) -> bool:
    """Whether forces and gaps are proportional to the number."""
    kind, which, name, *_ = part_keys(scene, path)
    part = getattr(scene, kind)[which]
    if kind == "supports":
        return bool(name == "position" and not isinstance(part, Spring))
    moment = name.startswith("moment")
    return kind == "loads" and name in VECTORS and not (moment and part.follower)
