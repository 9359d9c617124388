"""Changes of a scene, named by paths, as changes of the numbers of its network."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property
from typing import Any

import numpy as np

import pyrod._core as _core
from pyrod.base.arrays import array
from pyrod.base.immutable import Array
from pyrod.base.words import shortly
from pyrod.linear.lift import Lift
from pyrod.rotation import exp, multiply
from pyrod.scene.changes import changed, entries_of, part_keys
from pyrod.scene.loads import Load
from pyrod.scene.scene import Scene

FIELDS = ("bending", "stretching", "K0")
"""Arrays of rods whose derivatives are known all at once."""
_MOST = 2_000_000
"""Numbers that are kept for one entry, once they are known."""
_STENCIL = ((1, 45 / 60), (2, -9 / 60), (3, 1 / 60))
"""Sixth order: all numbers of networks are polynomials in those of scenes, or as smooth. It is
these few numbers that are differenced, not equilibria."""


def slope(numbers: Callable[[float], Array], step: float, here: Array, name: str) -> Array:
    """Of all numbers of scenes on a line, where they are ``here``."""
    sides = [(numbers(k * step), numbers(-k * step)) for k, _ in _STENCIL]
    ahead, behind = sides[0]
    if np.abs((ahead + behind) / 2 - here).max() > np.abs(ahead - behind).max():
        raise ValueError(
            f"{name}: has no derivative here, as the scene jumps with it: say what joints "
            "and supports hold"
        )
    return sum(  # type: ignore[return-value]
        weight / step * (a - b) for (a, b), (_, weight) in zip(sides, _STENCIL, strict=True)
    )


class Entry:
    """An entry of a scene that may change, by its path."""

    def __init__(
        self,
        scene: Scene,
        compiled: _core.Linearised,
        path: str,
        first: Scene | None = None,
        level: int = 0,
    ) -> None:
        """``first``: the scene of which this is one with every edge cut in 2^level; arrays along
        rods are those of that one."""
        self.scene, self.path = scene, path
        self._compiled = compiled
        self.kind, self.which, *rest = part_keys(scene, path)
        if not rest:
            raise ValueError(f"{shortly(path)}: is no number; name one of what it has")
        self.name, self.component = rest[0], rest[1:]
        self.is_frame = self.kind == "supports" and self.name == "frame"
        self.is_turns = self.kind == "supports" and self.name == "turns"
        self.value = self._value()
        self._lift = self._lift_from(first, level) if first and level else None
        shape = self._lift.shape if self._lift else np.shape(self.value)
        self.shape = (3,) if self.is_frame else shape
        self.size = int(np.prod(self.shape))

    def _value(self) -> Any:
        part = getattr(self.scene, self.kind)[self.which]
        value: Any = getattr(part, self.name, None)
        if self.kind == "supports" and value is None and self.name in ("position", "frame"):
            position, frame = self.scene._compiled.held(self.which)
            value = position if self.name == "position" else frame
        if self.is_frame and self.component:
            raise ValueError(f"{self.path}: frames change by rotation vectors, as a whole")
        unfit = value is None or isinstance(value, (str, bool)) or callable(value)
        if unfit or (self.name == "at" and self.kind != "joints"):
            raise ValueError(f"{shortly(self.path)}: has no derivative")
        value = array(value, self.path)
        if not self.component:
            return value
        changed(self.scene, {self.path: 0.0})  # refuses what is no component
        return np.asarray(value[int(self.component[0])])

    def _lift_from(self, first: Scene, level: int) -> Lift | None:
        if not np.ndim(self.value) or self.kind != "rods":
            return None
        return Lift(first.rods[self.which], self.name, level)

    @property
    def is_of_one_grid(self) -> bool:
        """Whether it is an array along a rod that finer edges do not know."""
        if self.kind == "rods":
            return bool(self.component)
        return len(self.shape) > 1

    @cached_property
    def unit(self) -> float:
        """How large changes of it are that count."""
        rods = self.scene.rods
        length = max(rod.length for rod in rods)
        if self.is_frame or self.is_turns:
            return 1.0
        if self.kind == "supports" and self.name == "position":
            return length
        value = np.abs(self.value[np.isfinite(self.value)])
        largest = float(value.max(initial=0.0))
        if self.kind == "rods":
            return max(largest, 1 / length) if self.name == "K0" else largest or 1.0
        moment = max(float(rod.bending.max()) / rod.length for rod in rods)
        return max(largest, moment / length**2)

    def numbers(self, direction: Any) -> Array:
        """The change of all numbers along a change of this entry."""
        v = array(direction, self.path)
        if v.shape != self.shape:
            raise ValueError(f"{self.path}: expected shape {self.shape}, got {v.shape}")
        return self._lifted(v)

    def _lifted(self, v: Array) -> Array:
        fine = self._lift.up(v) if self._lift else v
        return self._of_rod(fine) if self.is_direct else self._differenced(fine)

    @cached_property
    def is_direct(self) -> bool:
        """Whether the array of a rod does nothing but what it does to the cells and edges.

        Supports and joints may stand where rods are at rest, and so depend on it.
        """
        if not (self.kind == "rods" and self.name in FIELDS and not self.component):
            return False
        v = np.sin(np.arange(1.0, self.value.size + 1)).reshape(self.value.shape)
        if self.scene.space == "planar":  # where other components do nothing
            v = v * ([1, 0, 1] if self.name == "stretching" else [0, 1, 0])
        direct, all_of_it = self._of_rod(v), self._differenced(v)
        besides = all_of_it[direct == 0]
        close = np.abs(direct - all_of_it).max() <= 1e-9 * np.abs(direct).max(initial=0.0)
        return bool(close and not besides.any())  # what it does not touch stays to the last bit

    def _of_rod(self, v: Array) -> Array:
        rod = self.scene.rods[self.which]
        arrays = [np.zeros(np.shape(getattr(rod, name))) for name in FIELDS]
        arrays[FIELDS.index(self.name)] = v
        return self._compiled.of_rod(self.which, *arrays)

    def _differenced(self, v: Array) -> Array:
        size = float(np.abs(v).max(initial=0.0))
        if size == 0:
            return 0 * self._compiled.numbers(self.scene._compiled)
        for shorter in (1.0, 0.01):  # a taut rod reaches no farther
            try:
                return self._slope(v, shorter * self._step() / size)
            except ValueError:
                continue
        return self._slope(v, 1e-4 * self._step() / size)

    def _slope(self, v: Array, step: float) -> Array:
        here = self._compiled.numbers(self.scene._compiled)
        return slope(lambda t: self._at(t * v), step, here, self.path)

    def _step(self) -> float:
        """How far this entry goes, at the most, for its effect to be seen."""
        if self.is_frame or self.is_turns:
            return 0.03
        if self.kind == "rods" and self.name in ("edge_lengths", "bending", "stretching"):
            finite = self.value[np.isfinite(self.value)]
            return 0.003 * float(finite.min()) if finite.size else 1.0
        if self.kind == "rods" and not self.value.any():
            return 0.05 / self.scene.rods[self.which].length
        return 0.05 * (float(np.abs(self.value).max(initial=0.0)) or 1.0)

    def _at(self, change: Array) -> Array:
        path, value = self.path, self.value if self.is_frame else self.value + change
        if self.is_turns:
            path = f"supports.{self.which}.frame"
            value = self._turned([0, 0, 2 * np.pi * change])
        elif self.is_frame:
            value = self._turned(change)
        new = value if np.ndim(value) else float(value)
        return self._compiled.numbers(changed(self.scene, {path: new})[0]._compiled)

    def _turned(self, by: Any) -> Array:
        frame = self.scene._compiled.held(self.which)[1]
        return multiply(frame, exp(np.array(by, dtype=float)))

    def gradient(self, numbers: Array) -> Array:
        """From the gradient in all numbers."""
        if self.is_direct:
            field = self._compiled.to_rod(self.which, numbers)[FIELDS.index(self.name)]
            return self._lift.down(field) if self._lift else field
        units = self._kept_units if self.size * numbers.size <= _MOST else self.units()
        out = [np.nan if unit is None else numbers @ unit for unit in units]
        return np.array(out).reshape(self.shape)

    @cached_property
    def _kept_units(self) -> list[Array | None]:
        return list(self.units())

    def units(self) -> Iterator[Array | None]:
        """The changes of all numbers for each of its own; None for what leaves the plane, and for
        what pulls at a rod that is as long as it can be."""
        for i in range(self.size):
            unit = np.zeros(self.size)
            unit[i] = 1.0
            try:
                yield self._lifted(unit.reshape(self.shape))
            except ValueError as refused:
                taut = "cannot stretch" in str(refused)
                if not (taut or leaves_plane(self.scene, refused)):
                    raise
                yield None


def acting_name(load: Load) -> str:
    """Of what acts, the first thing that the load consists of."""
    return next(iter(entries_of(type(load))))


def leaves_plane(scene: Scene, refused: ValueError) -> bool:
    """Whether that was what a planar scene refuses."""
    return scene.space == "planar" and "spatial" in str(refused)


def all_paths(scene: Scene) -> list[str]:
    """What has derivatives, and is no array along a rod but for those known all at once."""
    out = [f"rods.{i}.{name}" for i in range(len(scene.rods)) for name in FIELDS]
    for i, load in enumerate(scene.loads):
        if not callable(load.acting) and np.ndim(load.acting) <= 1:
            out.append(f"loads.{i}.{acting_name(load)}")
    for i, support in enumerate(scene.supports):
        out.append(f"supports.{i}.position")
        if support.holds_frame:
            out.append(f"supports.{i}.frame")
    for i, actuator in enumerate(scene.actuators):
        out.append(f"actuators.{i}.{'tension' if actuator.length is None else 'length'}")
    return out
